/* intro.h: what the library does, a quick start, which call for which question, references */
#ifndef SL_PUBLIC_INTRO_H
#define SL_PUBLIC_INTRO_H

/* sparse_local.h factors a sparse symmetric matrix once, P A P' = L D L', and then solves A x = b
 * where b is nonzero in a few rows and x is wanted in a few others. Such a local solve reads only
 * the columns of L on the paths from those rows to the roots of the elimination tree. Its answer
 * has the bits of a full solve [HDA17].
 *
 * Quick start (in one source file; link with -lm):
 *
 *     #define SPARSE_LOCAL_IMPLEMENTATION
 *     #include "sparse_local.h"
 *
 *     sl_csc A = {n, n, Ap, Ai, Ax};                     lower, upper or both triangles
 *     sl_symbolic *S;  sl_factor *F;  sl_plan *P;
 *     sl_symbolic_create(&S, &A, NULL, NULL);            once per pattern
 *     sl_factor_create(&F, S, &A, NULL, NULL);           once per matrix
 *     sl_factor_solve(F, x, n, b, n, 1, NULL);           full solve: x and b have n rows
 *     sl_plan_create(&P, S, bset, nb, xset, nx, NULL, NULL);    rows of b and rows of x
 *     sl_plan_solve(P, F, x, nx, b, nb, 1, NULL);        local solve, any number of times
 *     sl_local_solve(F, bset, nb, xset, nx, x, nx, b, nb, 1, NULL, NULL);       the same once
 *     sl_factor_refactor(F, &A, NULL);                   new values, same pattern; P stays valid
 *     sl_plan_free(P);  sl_factor_free(F);  sl_symbolic_free(S);
 *
 * The 1 is the number of right-hand sides; the NULLs are options, workspaces and statistics. These
 * calls are the core. Many others need the macro of their pack (packs.h).
 */

/* Which call for which question. In the core:
 *
 *  a matrix from triplets                         sl_matrix_from_triplets                csc.h
 *  the same pattern with new values               sl_factor_refactor                     factor.h
 *  x everywhere for b everywhere                  sl_factor_solve                        solve.h
 *  x in a few rows for b in a few rows, often     sl_plan_create, sl_plan_solve          plan.h
 *  the same once                                  sl_local_solve                         plan.h
 *  a part of a matrix                             sl_matrix_submatrix                    csc.h
 *  a singular Laplacian, an elastic body          options.pivots, mass, null_vector      options.h
 *  several processors                             options.threads                        options.h
 *  what failed, and where; counts and times       sl_stats                               stats.h
 *
 * In packs:
 *
 *  an indefinite or KKT system                    sl_symbolic_create_pivoted             pivots.h
 *  can the solution be trusted?                   sl_factor_refine, sl_factor_rcond      accuracy.h
 *  how far off is each answer?                    sl_factor_certify                      bounds.h
 *  a few entries of A changed                     sl_factor_change_entries               change.h
 *  A + V V'                                       sl_factor_rank_update                  change.h
 *  rows that stay fixed, b in the others          sl_fixed_create                        fixed.h
 *  rows held and released one by one              sl_constraints_create             constraints.h
 *  a part of A, with zero values around it        sl_factor_submatrix                 submatrix.h
 *  a mesh that is cut or remeshed in places       sl_symbolic_edit, sl_factor_edit       edit.h
 *  variances, entries of the inverse              sl_inverse_diagonal, sl_inverse_pairs  inverse.h
 *  the inverse on the whole pattern of L          sl_selected_create                     selected.h
 *  local solves in one part of a mesh, often      sl_region_create                       region.h
 *  L, D or L' alone, samples of covariance A^-1   sl_factor_solve_part                   parts.h
 *  the pseudo-inverse of a singular A             sl_factor_pseudo_inverse               pseudo.h
 *  many solves by one call                        sl_batch_solve                         batch.h
 *  M + t K for many t                             sl_factor_create_sums                  several.h
 *  a factor in a file, mapped without a copy      sl_save, sl_load                       save.h
 *  a complex Hermitian system                     sl_matrix_from_hermitian               complex.h
 *  a matrix from a file                           sl_matrix_read                         files.h
 */

/* Notation     A is n x n. perm[k] is the row of A that is pivot k; iperm is the inverse of perm.
 *              parent is the elimination tree, -1 at a root. L is unit lower triangular and stored
 *              in supernodal panels; D is diagonal. A reach is a set of columns closed under
 *              parent. nnz counts stored entries.
 * Conventions  Every function that can fail returns sl_status. On error, outputs are NULL or
 *              untouched, and sl_error_text says why. Options and stats may be NULL. So may W, a
 *              workspace: the call then allocates one for itself. Each kind of object has a call
 *              that releases it, such as sl_factor_free, which accepts NULL. Dense arguments are
 *              column-major with a leading dimension in elements, or row-major by SL_ROWS(ld).
 *              Row numbers are the caller's, also in errors. The rows of b come before the rows of
 *              x, and each array before its length. A list of rows that is NULL means all rows with
 *              the length SL_ALL, which needs NULL, or n, and no row with 0; any other length is
 *              refused. The library never prints or aborts.
 *              Threads share no mutable globals: each keeps its last error, and with
 *              SL_NO_THREAD_LOCAL nothing. For METIS, an option, see sl_symbolic_create. What is
 *              marked EXPERIMENTAL may change in any version; all else keeps its promises from 1.0
 *              on.
 * Lifetimes    An object keeps what it was made from: a factor, a plan, a region and a selected
 *              inverse their analysis, a plan its region, pins their factor. So all of them may be
 *              freed in any order, and on any threads with gcc, clang and MSVC; other compilers
 *              have no atomic counters. Memory and allocators of the caller, and views of arrays,
 *              are not kept.
 * Threads      An analysis, a plan, a selected inverse and a region are immutable after their
 *              creation; a factor is const during solves. Any number of threads may solve with one
 *              factor, each with its own sl_work. A call needs exclusive use of objects and arrays
 *              that it takes without const, except for one that it frees. The others may be read by
 *              any number of calls at once.
 * Manual       tools/docs/NAME.md in the repository, and the page NAME.html that make docs writes:
 *              details and measurements that a contract leaves out.
 */

/* References
 *  [ADD96]    Amestoy, Davis, Duff: An approximate minimum degree ordering algorithm, 1996.
 *  [AG89]     Ashcraft, Grimes: The influence of relaxed supernode partitions on the multifrontal
 *             method, 1989.
 *  [Bie76]    Bierman: Measurement updating using the U-D factorization, 1976.
 *  [Davis06]  Davis: Direct Methods for Sparse Linear Systems, 2006.
 *  [Dek71]    Dekker: A floating-point technique for extending the available precision, 1971.
 *  [DH01]     Davis, Hager: Multiple-rank modifications of a sparse Cholesky factorization, 2001.
 *  [DR83]     Duff, Reid: The multifrontal solution of indefinite sparse symmetric linear
 *             equations, 1983.
 *  [ET75]     Erisman, Tinney: On computing certain elements of the inverse of a sparse matrix,
 *             1975.
 *  [FF56]     Ford, Fulkerson: Maximal flow through a network, 1956.
 *  [FM82]     Fiduccia, Mattheyses: A linear-time heuristic for improving network partitions, 1982.
 *  [George73] George: Nested dissection of a regular finite element mesh, 1973.
 *  [HA18]     Herholz, Alexa: Factor once: reusing Cholesky factorizations on sub-meshes, 2018.
 *  [Hager89]  Hager: Updating the inverse of a matrix, 1989.
 *  [HDA17]    Herholz, Davis, Alexa: Localized solutions of sparse linear systems for geometry
 *             processing, 2017.
 *  [Hi88]     Higham: FORTRAN codes for estimating the one-norm of a real or complex matrix, 1988.
 *  [Hi02]     Higham: Accuracy and Stability of Numerical Algorithms, 2nd edition, 2002.
 *  [KK98]     Karypis, Kumar: A fast and high quality multilevel scheme for partitioning irregular
 *             graphs, 1998.
 *  [LDL05]    Davis: Algorithm 849: a concise sparse Cholesky factorization package, 2005.
 *  [Liu90]    Liu: The role of elimination trees in sparse factorization, 1990.
 *  [Liu92]    Liu: The multifrontal method for sparse matrix solution: theory and practice, 1992.
 *  [MR85]     Miller, Reif: Parallel tree contraction and its application, 1985.
 *  [NP93]     Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers,
 *             1993.
 *  [Ru06]     Rump: Verification of positive definiteness, 2006.
 *  [SelInv]   Lin, Yang, Meza, Lu, Ying, E: SelInv: selected inversion of a sparse symmetric
 *             matrix, 2011.
 *  [Sk80]     Skeel: Iterative refinement implies numerical stability for Gaussian elimination,
 *             1980.
 */

#endif
