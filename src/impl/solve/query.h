/* solve.h: full solves: the query in which everything is known and everything wanted */
#ifndef SLI_SOLVE_H
#define SLI_SOLVE_H

#include "sweep.h"

SL_API sl_status sl_factor_solve(const sl_factor *F, double *X, size_t ldx, const double *B,
                                 size_t ldb, sl_int nrhs, sl_work *W) {
    sli_query q;
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    q = sli_query_all(F->S);
    return sli_solve(F, &q, X, ldx, B, ldb, SLI_COLUMN_MAJOR, nrhs, W);
}

SL_API sl_status sl_factor_solve_interleaved(const sl_factor *F, double *X, size_t ldx,
                                             const double *B, size_t ldb, sl_int nrhs, sl_work *W) {
    sli_query q;
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    q = sli_query_all(F->S);
    return sli_solve(F, &q, X, ldx, B, ldb, SLI_INTERLEAVED, nrhs, W);
}

/* Room for the blocks of a query. */
static sl_status sli_work_reserve(sl_work *W, const sli_query *q, sl_int nrhs) {
    const size_t bytes = nrhs > 0 && q->nx > 0 ? sli_vectors_bytes(q, nrhs) : 0;
    return bytes == SIZE_MAX ? SL_ERR_TOO_LARGE : sli_work_grow(W, bytes);
}

SL_API sl_status sl_work_reserve_factor(sl_work *W, const sl_factor *F, sl_int nrhs) {
    sli_query q;
    if (W == NULL || F == NULL || nrhs < 0) {
        return SL_ERR_ARGUMENT;
    }
    q = sli_query_all(F->S);
    return sli_work_reserve(W, &q, nrhs);
}

#endif
