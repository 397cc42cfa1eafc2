/* arpack_pairs.h: eigenpairs of a Laplacian by ARPACK, with our factor as its solver */
#ifndef BENCH_ARPACK_PAIRS_H
#define BENCH_ARPACK_PAIRS_H

#include "sparse_local.h"

/** The problem L x = lambda M x: L positive semidefinite, M diagonal and positive. */
typedef struct eigen_problem {
    sl_csc L;           /* lower triangle, n x n */
    const double *mass; /* n: the diagonal of M */
    const sl_factor *F; /* of M + shift L; 1 / shift should be about the smallest eigenvalues */
    double shift;
    double tolerance; /* of the eigenvalues 1 / (lambda + 1 / shift), relative; 0: rounding */
} eigen_problem;

/** The smallest eigenvalues and what they cost. */
typedef struct eigen_pairs {
    sl_int n, count;
    double *values;  /* count, ascending */
    double *vectors; /* n x count, leading dimension n; x' M x = 1 */
    sl_int solves;   /* with F */
    sl_int restarts;
} eigen_pairs;

/** Computes them by implicitly restarted Lanczos iterations with (L + M / shift)^-1 M, in a basis
 *  of twice as many vectors. Exits with a message on an error of ARPACK.
 *
 *  count  [in]  1..n-1.
 */
eigen_pairs eigen_pairs_create(const eigen_problem *problem, sl_int count);
void eigen_pairs_free(eigen_pairs *pairs);

/** The largest residual |L x - lambda M x| / ((lambda + 1 / shift) |M x|), with |y|^2 = y' M^-1 y,
 *  and the largest deviation of x' M y from 0 or 1. */
void eigen_pairs_errors(double *residual, double *orthogonality, const eigen_problem *problem,
                        const eigen_pairs *pairs);

/** The diagonal of (M + t L)^-1 as far as the first `count` pairs know it: the sum of
 *  x_i^2 / (1 + t lambda). */
void eigen_pairs_diagonal(double *out, const eigen_pairs *pairs, sl_int count, double t);

#endif
