/* restrict.h: the factor of a principal submatrix, from that of the whole matrix */
#ifndef SL_PUBLIC_RESTRICT_H
#define SL_PUBLIC_RESTRICT_H

#include "options.h"
#include "stats.h"

/** Factors A[R, R], the matrix of the rows and columns R of A, from a factor of A.
 *
 *  This is the system of a part of a mesh with zero Dirichlet values around it. Columns of L are
 *  kept whose supernode and all its descendants are in R; they are copied without the rows that are
 *  not in R. The others are analyzed and computed again, in the order of A; nothing is ordered. If
 *  fewer than 40 % of the columns could be kept, all are analyzed and computed
 *  (stats.restriction.is_anew). The same happens if F has several null vectors or stores L in
 *  another way than SL_STORAGE_DOUBLE. G has the storage of F; but with SL_STORAGE_COMPLEX, L of G
 *  is in double if rows 2j and 2j+1 of A do not follow each other in rows.
 *
 *  G and S do not depend on F, which may change or be released. Their row k is row rows[k] of A.
 *  Plans, full, half and local solves, pins, entries of the inverse, selected inverses and regions
 *  work as with any factor. The numbers stay as they are: refactorizations, changes and saving give
 *  SL_ERR_STATE. What compares a matrix with the analyzed pattern gives SL_ERR_PATTERN: refinement,
 *  sl_factor_rcond, another factor over S. Where a supernode lost rows, parent and counts of
 *  sl_symbolic_view are an ancestor of the parent and an upper bound.
 *
 *  G refuses null pivots, also if F skips them: a singular Laplacian is regular without one of the
 *  rows of each component. A component that is in R as a whole gives SL_ERR_PIVOT. Only
 *  null_tolerance decides which other pivots are null. The rest of F's options apply to G:
 *  instruction set, null_tolerance, regularization with its signs, growth_limit, error_limit.
 *
 *  S      [out]  the analysis, or NULL on error; release with sl_symbolic_free after G.
 *  G      [out]  the factor, or NULL on error; release with sl_factor_free.
 *  F      [in]   a factor of A.
 *  A      [in]   the matrix that F was computed from. Read only in the columns of R that are
 *                computed again; its pattern is not compared with the analyzed one.
 *  rows   [in]   count rows of A in 0..n-1, any order, no duplicates.
 *  opt    [in]   allocator; may be NULL.
 *  stats  [out]  restriction, factor; errors are in rows of A; may be NULL.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also a row out of range or given twice (error.row);
 *           SL_ERR_PATTERN: A differs in size or number of entries from the analyzed matrix, or
 *           error.column of it is malformed; SL_ERR_PIVOT, SL_ERR_NOT_FINITE, SL_ERR_INACCURATE: as
 *           sl_factor_create; SL_ERR_STATE: F has no numbers; SL_ERR_UNSUPPORTED: F has 2x2
 *           pivots or is a restriction itself; SL_ERR_TOO_LARGE; SL_ERR_MEMORY.
 *  Cost     linear in the entries of A in R and the rows of supernodes in R, a copy of the kept
 *           entries of L, and the flops of the other columns. For a disc of 1e4 vertices in a grid
 *           of 1e6, 80 % of the columns are kept, but the others have half of the flops, and the
 *           Schur complements of the kept ones another fifth. The call then takes 0.58 of the time
 *           of analyzing and factoring A[R, R] in a given order, and 0.44 for half of the grid.
 *           Where nothing is kept, it takes 0.8 to 0.93 times as long as extracting, analyzing and
 *           factoring A[R, R] in that order (bands, lines, spirals), and 0.6 to 0.83 times for
 *           random rows. If A[R, R] is available already, it takes 0.9 to 1.1 times as long, and
 *           1.15 to 1.45 times for 1 to 10 % of 1e6 rows at random: reading A is the difference.
 *  Threads  reads F; one thread.
 *  Source   [HA18]
 *  Example  tests/core/test_restrict.c
 */
SL_API SL_WARN_UNUSED sl_status sl_factor_restrict(sl_symbolic **S, sl_factor **G,
                                                   const sl_factor *F, const sl_csc *A,
                                                   const sl_int *rows, sl_int count,
                                                   const sl_options *opt, sl_stats *stats);

#endif
