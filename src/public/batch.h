/* batch.h: many independent solves, with one factor or with several, spread over threads by one call */
#ifndef SL_PUBLIC_BATCH_H
#define SL_PUBLIC_BATCH_H

#include "types.h"

/** One solve of a batch: a plan and its right-hand sides, or a full solve. */
typedef struct sl_request {
    const sl_plan *plan; /* NULL: b known and x wanted everywhere, as in sl_factor_solve */
    double *X;           /* nx x nrhs (n x nrhs), leading dimension ldx elements */
    size_t ldx;
    const double *B; /* nb x nrhs (n x nrhs), leading dimension ldb elements */
    size_t ldb;
    int is_interleaved; /* 0: X and B column-major; else row-major, as in the calls named interleaved */
    sl_int
        nrhs; /* 0 or more; many right-hand sides are shared out in blocks of 8, like many requests */
    const sl_factor *factor; /* NULL: that of the call */
} sl_request;

/** Answers requests: the bits that sl_plan_solve and sl_factor_solve give, for any number of threads.
 *
 *  One plan on m factors of one analysis is m requests with that plan, each with its own factor and X, and with one B or
 *  each its own.
 *
 *  F         [in]      the factor of the requests that name none; NULL where all do. A plan belongs to the analysis of its
 *                      factor.
 *  requests  [in]      count of them; each X may be its own B (then ldx = ldb), and overlaps nothing else of the batch.
 *  threads   [in]      how many and whose; NULL: the calling thread alone.
 *  works     [in,out]  a workspace for each thread, threads->count of them (1 where that is 0), or NULL: allocated for
 *                      this call.
 *  failed    [out]     the request at fault, or -1; may be NULL. On error no X has been touched.
 *  Returns   SL_OK; SL_ERR_ARGUMENT, also for works that hold a NULL or one workspace twice; SL_ERR_STATE: failed
 *            factor, or a plan that sl_plan_solve refuses; SL_ERR_INCONSISTENT: as in sl_factor_solve; SL_ERR_TOO_LARGE;
 *            SL_ERR_MEMORY.
 *  Cost      that of the solves, shared out by the entries of L that each reads; threads times the largest workspace.
 *            Where right-hand sides have to be consistent, all of them are swept forward once more beforehand.
 *  Threads   as sl_plan_solve.
 *  Example   tests/test_batch.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests,
                                               sl_int count, const sl_threads *threads,
                                               sl_work *const *works, sl_int *failed);

#endif
