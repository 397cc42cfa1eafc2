/* intro.h: what the library does, a quick start, notation, conventions, threads, references */
#ifndef SL_PUBLIC_INTRO_H
#define SL_PUBLIC_INTRO_H

/* sparse_local.h factors a sparse symmetric matrix once, P A P' = L D L', and then answers many
 * small questions from that factor: b is nonzero in a few rows, x is wanted in a few others. The
 * elimination tree determines which columns of L can matter. The answer is the same as that of a
 * full solve; its cost depends on the question and not on the size of the matrix [HDA17].
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
 *     sl_factor_solve(F, x, n, b, n, 1, NULL);           full solve
 *     sl_plan_create(&P, S, bset, nb, xset, nx, NULL, NULL);
 *     sl_plan_solve(P, F, x, nx, b, nb, 1, NULL);        local solve, any number of times
 *     sl_plan_free(P);  sl_factor_free(F);  sl_symbolic_free(S);
 *
 * Notation     A is n x n. perm[k] is the row of A that is pivot k; iperm is the inverse of perm.
 *              parent is the elimination tree, -1 at a root. L is unit lower triangular and stored
 *              in supernodal panels; D is diagonal. A reach is a set of columns closed under
 *              parent. nnz counts stored entries.
 * Conventions  Every function that can fail returns sl_status. On error, outputs are NULL or
 *              untouched. Options and stats may be NULL. Dense arguments are column-major with a
 *              leading dimension in elements; solves take row-major ones, too (SL_ROWS). Row
 *              numbers are the caller's, also in errors. A b-set comes before an x-set, and a
 *              length follows its array. The library never prints or aborts and has no mutable
 *              globals; for METIS, an option, see sl_symbolic_create. What is marked EXPERIMENTAL
 *              may change in any version; all else keeps its promises from 1.0 on.
 * Threads      An analysis, a plan, a selected inverse and a region are immutable after their
 *              creation; a factor is const during solves. Any number of threads may solve with one
 *              factor, each with its own sl_work.
 *
 * References
 *  [HDA17]   Herholz, Davis, Alexa: Localized solutions of sparse linear systems for geometry
 *            processing, 2017.
 *  [Davis06] Davis: Direct Methods for Sparse Linear Systems, 2006.
 *  [LDL05]   Davis: Algorithm 849: a concise sparse Cholesky factorization package, 2005.
 *  [FF56]    Ford, Fulkerson: Maximal flow through a network, 1956.
 *  [George73] George: Nested dissection of a regular finite element mesh, 1973.
 *  [FM82]    Fiduccia, Mattheyses: A linear-time heuristic for improving network partitions, 1982.
 *  [Liu90]   Liu: The role of elimination trees in sparse factorization, 1990.
 *  [MR85]    Miller, Reif: Parallel tree contraction and its application, 1985.
 *  [NP93]    Ng, Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers, 1993.
 *  [DR83]    Duff, Reid: The multifrontal solution of indefinite sparse symmetric linear equations,
 *            1983.
 *  [Liu92]   Liu: The multifrontal method for sparse matrix solution: theory and practice, 1992.
 *  [ET75]    Erisman, Tinney: On computing certain elements of the inverse of a sparse matrix,
 *            1975.
 *  [SelInv]  Lin, Yang, Meza, Lu, Ying, E: SelInv: selected inversion of a sparse symmetric matrix,
 *            2011.
 *  [ADD96]   Amestoy, Davis, Duff: An approximate minimum degree ordering algorithm. SIAM J. Matrix
 *            Anal. Appl. 17(4), 1996
 *  [AG89]    Ashcraft, Grimes: The influence of relaxed supernode partitions on the multifrontal
 *            method, 1989.
 *  [DH01]    Davis, Hager: Multiple-rank modifications of a sparse Cholesky factorization, 2001.
 *  [HA18]    Herholz, Alexa: Factor once: reusing Cholesky factorizations on sub-meshes, 2018.
 *  [Bie76]   Bierman: Measurement updating using the U-D factorization, 1976.
 *  [Hager89] Hager: Updating the inverse of a matrix, 1989.
 *  [Hi88]    Higham: FORTRAN codes for estimating the one-norm of a real or complex matrix, 1988.
 *  [Hi02]    Higham: Accuracy and Stability of Numerical Algorithms, 2nd edition, 2002.
 *  [Sk80]    Skeel: Iterative refinement implies numerical stability for Gaussian elimination,
 *            1980.
 *  [KK98]    Karypis, Kumar: A fast and high quality multilevel scheme for partitioning irregular
 *            graphs, 1998.
 */

#endif
