/* parts.h: L, D, L' and the permutation applied one by one: half solves, products, samples */
#ifndef SL_PUBLIC_PARTS_H
#define SL_PUBLIC_PARTS_H

#include "solve.h"
#include "plan.h"

/** The factors of P A P' = L D L', to be combined by |. */
typedef enum sl_part {
    SL_PART_P = 1,      /* from the order of A to that of the pivots: row k of P b is b(perm[k]) */
    SL_PART_L = 2,      /* unit lower triangular */
    SL_PART_D = 4,      /* diagonal, or with 2x2 blocks */
    SL_PART_SQRT_D = 8, /* D^(1/2), in place of D; of factors without negative pivots only */
    SL_PART_LT = 16,    /* L' */
    SL_PART_PT = 32     /* P', from the order of the pivots to that of A */
} sl_part;

/** X = P' L'^-1 D^-1 L^-1 P B with only those factors that are given; the others count as I.
 *
 *  | SL_PART_...                | X                                                              |
 *  |----------------------------|----------------------------------------------------------------|
 *  | P, L                       | the forward half of a solve                                    |
 *  | D, LT, PT, or only LT, PT  | the backward half                                              |
 *  | P, L, D, LT, PT            | the solution of A X = B                                        |
 *  | L, or D, or LT             | one of the three solves, in the order of the pivots            |
 *  | SQRT_D, LT, PT             | samples of covariance A^-1 if B is standard normal             |
 *  | P, L, SQRT_D               | whitened B: independent, of variance 1, if its covariance is A |
 *
 *  Parts applied one after the other give the bits of sl_factor_solve, but consistency is not
 *  checked and options.mass not used. Skipped null pivots count as 0, and dividing by them gives 0:
 *  D^-1 is the pseudo-inverse. With several null vectors a component (options.null_vector_count),
 *  null pivots are not the last ones, and P' L D L' P differs from A in their rows and columns.
 *
 *  With a plan it is one half of a local solve. Forward: SL_PART_P, SL_PART_L and perhaps one of
 *  SL_PART_D and SL_PART_SQRT_D. B has the rows of the b-set; X has the b_columns rows that the
 *  sweep reaches (sl_plan_columns), and all others are 0. Backward: SL_PART_LT, SL_PART_PT and
 *  perhaps one of the two. B has the x_columns rows that the x-set depends on; X has those of the
 *  x-set. The results are the rows of the full call, bit for bit.
 *
 *  F      [in]   factor of A, n x n.
 *  plan   [in]   over the analysis of F, without a region; NULL: all rows.
 *  parts  [in]   any of sl_part, but not both SL_PART_D and SL_PART_SQRT_D; 0 copies B. With a plan
 *                those above.
 *  X      [out]  n x nrhs, leading dimension ldx; in the order of A with SL_PART_PT, else of the
 *                pivots. May be B itself (then ldx = ldb). On error untouched.
 *  B      [in]   n x nrhs, leading dimension ldb; in the order of A with SL_PART_P, else of the
 *                pivots.
 *  nrhs   [in]   number of right-hand sides, 0 or more.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STALE; SL_ERR_PIVOT: SL_PART_SQRT_D with a negative
 *           pivot; SL_ERR_UNSUPPORTED: SL_PART_SQRT_D with 2x2 pivots, or a plan in a region;
 *           SL_ERR_MISMATCH: a plan of another analysis; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     2 nnz_panels flops per right-hand side for each of L and L'; O(n) for the others. On a
 *           plan 2 b_entries or 2 x_entries flops; nothing O(n).
 *  Threads  any number at once on one F, each with its own W.
 *  Example  tests/core/test_parts.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_solve_part(const sl_factor *F, const sl_plan *plan,
                                                     unsigned parts, double *X, size_t ldx,
                                                     const double *B, size_t ldb, sl_int nrhs,
                                                     sl_work *W);

/** X = P' L D L' P B with only those factors that are given; the others count as I.
 *
 *  L + PT undoes P + L of sl_factor_solve_part, and LT undoes LT. L + SQRT_D + PT makes samples of
 *  covariance A. All parts together give A B, or (A + E) B if regularization changed pivots.
 *
 *  Arguments, Returns, Threads  as sl_factor_solve_part without a plan.
 *  Cost     2 nnz_panels flops per right-hand side for each of L and L', in plain C: 13 to 27 times
 *           as long as the solve.
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_multiply_part(const sl_factor *F, unsigned parts,
                                                        double *X, size_t ldx, const double *B,
                                                        size_t ldb, sl_int nrhs, sl_work *W);

/** The columns of L that one sweep of a plan visits, ascending: the rows of half solves.
 *
 *  part      [in]   SL_PART_L: the forward sweep; SL_PART_LT: the backward sweep.
 *  columns   [out]  the first min(capacity, *count) of them; may be NULL if capacity = 0.
 *  capacity  [in]   length of columns.
 *  count     [out]  how many there are: b_columns or x_columns of stats.plan.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_UNSUPPORTED: a plan in a region.  Cost  O(count).
 */
SL_API SL_WARN_UNUSED sl_status sl_plan_columns(const sl_plan *P, sl_part part, sl_int *columns,
                                                sl_int capacity, sl_int *count);

#endif
