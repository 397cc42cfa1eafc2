/* batch.h: many independent solves by one call, distributed over threads */
#ifndef SL_PUBLIC_BATCH_H
#define SL_PUBLIC_BATCH_H

#include "solve.h"

/** One solve of a batch: a plan and its right-hand sides, or a full solve. */
typedef struct sl_request {
    const sl_plan *plan;     /* NULL: a full solve, as sl_factor_solve */
    double *X;               /* nx x nrhs (full: n x nrhs) */
    size_t ldx;              /* its leading dimension */
    const double *B;         /* nb x nrhs (full: n x nrhs) */
    size_t ldb;              /* its leading dimension */
    sl_int nrhs;             /* 0 or more; blocks of 8 are distributed like separate requests */
    const sl_factor *factor; /* NULL: the factor of the call */
} sl_request;

/** Solves all requests: the bits of sl_plan_solve and sl_factor_solve for any number of threads.
 *
 *  One plan on m factors of one analysis is m requests with that plan, each with its own factor and
 *  X, and with a common B or its own.
 *
 *  F         [in]      the factor of the requests that name none; NULL if all do. A plan needs a
 *                      factor of its analysis.
 *  requests  [in]      count requests. Each X may be its own B (then ldx = ldb) and overlaps
 *                      nothing else of the batch.
 *  opt       [in]      threads; NULL: the calling thread only.
 *  works     [in,out]  one workspace per thread, max(opt->threads.count, 1) of them, or NULL:
 *                      allocated for this call.
 *  failed    [out]     the request that caused the error, or -1; may be NULL. On error no X has
 *                      been written.
 *  Returns   SL_OK; SL_ERR_ARGUMENT: also if a workspace is NULL or given twice; SL_ERR_MISMATCH,
 *            SL_ERR_STALE: a factor or a plan that sl_plan_solve refuses; SL_ERR_INCONSISTENT: as
 *            in sl_factor_solve; SL_ERR_NOT_FINITE: the same, all requests are solved;
 *            SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost      that of the solves, distributed by the entries of L that each reads; one workspace of
 *            the largest size per thread. A batch that takes less than a tenth of a ms is left to
 *            one thread. If consistency is checked, all of B is read twice, with one more
 *            forward sweep where null vectors are not known.
 *  Threads   as sl_plan_solve.
 *  Example   tests/core/test_batch.c
 */
SL_API SL_WARN_UNUSED sl_status sl_batch_solve(const sl_factor *F, const sl_request *requests,
                                               sl_int count, const sl_options *opt,
                                               sl_work *const *works, sl_int *failed);

#endif
