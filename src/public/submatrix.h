/* submatrix.h: the factor of a principal submatrix, from that of the whole matrix */
#ifndef SL_PUBLIC_SUBMATRIX_H
#define SL_PUBLIC_SUBMATRIX_H

#include "options.h"
#include "stats.h"

/** Factors A[R, R], the matrix of the rows and columns R of A, from a factor of A.
 *
 *  This is the system of a part of a mesh with zero Dirichlet values around it. Columns of L are
 *  copied if their supernode and all its descendants are in R. The others are computed again, in
 *  the order of A; if fewer than 40 % could be copied, all are (stats.submatrix.is_anew).
 *
 *  G and S do not depend on F. Their row k is row rows[k] of A. They can be solved with, pinned and
 *  inverted as any factor. Refactorizations and changes give SL_ERR_READ_ONLY, saving
 *  SL_ERR_MISMATCH; what compares a matrix with the analyzed pattern gives SL_ERR_OTHER_PATTERN:
 *  refinement, sl_factor_rcond, another factor over S. G has the options and the storage of F, but
 *  refuses null pivots by null_tolerance: a component of a singular Laplacian that is in R as a
 *  whole gives SL_ERR_PIVOT.
 *
 *  S      [out]  the analysis.
 *  G      [out]  the factor.
 *  F      [in]   a factor of A.
 *  A      [in]   the matrix that F was computed from. Read only in the columns of R that are
 *                computed again; neither its pattern nor its two triangles are compared.
 *  rows   [in]   count rows of A in 0..n-1, any order, no duplicates.
 *  opt    [in]   allocator.
 *  stats  [out]  submatrix, factor; errors are in rows of A.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range or given twice (error.row);
 *           SL_ERR_OTHER_PATTERN: A differs in size, entries or triangle from the analyzed matrix;
 *           SL_ERR_MALFORMED: error.column of it is malformed; SL_ERR_PIVOT, _NOT_FINITE,
 *           _INACCURATE: as sl_factor_create; SL_ERR_STALE: F has no numbers; SL_ERR_UNSUPPORTED: F
 *           has 2x2 pivots or is a restriction itself; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     linear in the entries of A in R and the rows of supernodes in R, a copy of the kept
 *           entries of L, and the flops of the other columns: 0.44 to 1.45 of the time of analyzing
 *           and factoring A[R, R] in a given order. Below 1,000 rows sl_matrix_submatrix and new
 *           objects take less.
 *  Threads  reads F; one thread.
 *  Source   [HA18]
 *  Manual   tools/docs/changes.md
 *  Example  tests/core/test_submatrix.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_submatrix(sl_symbolic **S, sl_factor **G,
                                                    const sl_factor *F, const sl_csc *A,
                                                    const sl_int *rows, sl_int count,
                                                    const sl_options *opt, sl_stats *stats);

#endif
