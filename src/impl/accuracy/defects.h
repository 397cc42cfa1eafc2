/* defects.h: sl_factor_defects: by how much right-hand sides are inconsistent */
#ifndef SLI_ACCURACY_DEFECTS_H
#define SLI_ACCURACY_DEFECTS_H

#include "../../public/accuracy.h"
#include "../solve/sweep.h"

/* Y := z' b for the null vectors that are known, where components have several; Y is rhs->X. */
static void sli_defects_known(const sl_factor *F, const sli_packed *b, const sli_rhs *rhs) {
    const sli_reach *R = b->R;
    const sli_dense at = sli_dense_of(rhs->ldx);
    sl_int first = 0, s, r;
    for (s = 0; s < R->count && F->null.vectors > 1; s++) {
        sli_null_dot dot;
        if (R->steps[s].up != -1) {
            continue;
        }
        dot.next = sli_null_first(F, R, s);
        while (F->null.calls->next_dot(F, b, first, s, &dot)) {
            for (r = 0; r < rhs->nrhs; r++) {
                rhs->X[(size_t)dot.number * at.row + (size_t)r * at.column] = dot.sums[r];
            }
        }
        first = s + 1;
    }
}

/* Y := the entries of L^-1 P B at the null pivots, in blocks of right-hand sides; Y is rhs->X. */
static void sli_defects(const sl_factor *F, const sli_query *q, const sli_rhs *rhs, void *memory) {
    const sli_dense at = sli_dense_of(rhs->ldx);
    sl_int c, r, m;
    for (c = 0; c < rhs->nrhs; c += sli_min(8, rhs->nrhs - c)) {
        const sli_rhs block = sli_rhs_part(rhs, c, sli_min(8, rhs->nrhs - c));
        const sl_int lanes = (sl_int)1 << sli_lanes_kind(block.nrhs);
        const sli_vectors v = sli_vectors_of(q, block.nrhs, memory);
        const sli_packed b = sli_packed_of(&q->forward, v.y, lanes);
        sli_pack(F, q, v.y, &block);
        sli_defects_known(F, &b, &block);
        sli_sweep_forward(F, q, &v, block.nrhs);
        for (m = 0; m < F->null.count; m++) {
            const int is_known = F->null.vectors > 1 && sli_null_column(F, F->null.pivots[m]) != -1;
            for (r = 0; r < block.nrhs && !is_known; r++) {
                block.X[(size_t)m * at.row + (size_t)r * at.column] =
                    v.y[(ptrdiff_t)F->null.pivots[m] * lanes + r];
            }
        }
    }
}

SL_API sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy, const double *B,
                                   size_t ldb, sl_int nrhs, sl_work *W) {
    const sli_rhs rhs = sli_rhs_of(Y, ldy, B, ldb, nrhs);
    sli_block b = {NULL, 0};
    sl_work own;
    sli_query q;
    sl_status status;
    status = F == NULL ? sli_argument("F is NULL") : sli_factor_has_numbers(F);
    status = status == SL_OK ? sli_singular_needed() : status;
    status = status == SL_OK ? sli_rhs_check(&rhs, F->null.count, F->S->n) : status;
    if (status == SL_OK && Y == B && Y != NULL) {
        status = sli_argument("Y is B");
    }
    if (status != SL_OK || nrhs == 0 || F->null.count == 0) {
        return status;
    }
    q = sli_query_all(F->S);
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    b.used = sli_vectors_bytes(&q, nrhs, 8);
    status = sli_work_block(W, &b);
    if (status == SL_OK) {
        sli_defects(F, &q, &rhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
