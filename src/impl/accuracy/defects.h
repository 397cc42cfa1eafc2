/* defects.h: sl_factor_defects: by how much right-hand sides are inconsistent */
#ifndef SLI_ACCURACY_DEFECTS_H
#define SLI_ACCURACY_DEFECTS_H

#include "../../public/accuracy.h"
#include "../solve/sweep.h"

/* Y := the entries of L^-1 P B at the null pivots, in blocks of right-hand sides. */
static void sli_defects(const sl_factor *F, const sli_query *q, double *Y, size_t ldy,
                        const double *B, size_t ldb, sl_int nrhs, void *memory) {
    sl_int c, r, m;
    for (c = 0; c < nrhs; c += sli_min(8, nrhs - c)) {
        const sl_int block = sli_min(8, nrhs - c), lanes = (sl_int)1 << sli_lanes_kind(block);
        const sli_vectors v = sli_vectors_of(q, block, memory);
        sli_pack(q, F->kernels, v.y, B + (size_t)c * ldb, sli_dense_by_columns(ldb), lanes, block);
        if (F->null.vectors > 1) {
            (void)sli_null_dots(F, &q->forward, v.y, lanes, NULL, Y + (size_t)c * ldy, ldy, block);
        }
        sli_sweep_forward(F, q, &v, block);
        for (m = 0; m < F->null.count; m++) {
            const int is_known = F->null.vectors > 1 && sli_null_column(F, F->null.pivots[m]) != -1;
            for (r = 0; r < block && !is_known; r++) {
                Y[(size_t)m + (size_t)(c + r) * ldy] =
                    v.y[(ptrdiff_t)F->null.pivots[m] * lanes + r];
            }
        }
    }
}

SL_API sl_status sl_factor_defects(const sl_factor *F, double *Y, size_t ldy, const double *B,
                                   size_t ldb, sl_int nrhs, sl_work *W) {
    sli_block b = {NULL, 0, 0};
    sl_work own;
    sli_query q;
    sl_status status;
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_valid) {
        return SL_ERR_STATE;
    }
    status = sli_check_dense_columns(Y, ldy, F->null.count, B, ldb, F->S->n, nrhs);
    if (status != SL_OK || (Y == B && Y != NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (nrhs == 0 || F->null.count == 0) {
        return SL_OK;
    }
    q = sli_query_all(F->S);
    own = sli_work_own(&F->allocator);
    W = W == NULL ? &own : W;
    b.used = sli_vectors_bytes(&q, nrhs, 8);
    status = sli_work_block(W, &b);
    if (status == SL_OK) {
        sli_defects(F, &q, Y, ldy, B, ldb, nrhs, W->block);
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
