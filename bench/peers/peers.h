/* peers.h: CHOLMOD and Eigen behind a few calls, in our permutation and with their own orderings */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include "sparse_local.h"

#ifdef __cplusplus
extern "C" {
#endif

/** CHOLMOD in its best setting for a given permutation. Two factors of one matrix: supernodal LL'
 *  for full solves, and simplicial LDL', packed, for solves with Bset. 32-bit interface.
 */
typedef struct peer_cholmod peer_cholmod;

/** A stores its lower triangle and must outlive the peer. Exits with a message on an error. */
peer_cholmod *peer_cholmod_create(const sl_csc *A, const sl_int *perm);
void peer_cholmod_free(peer_cholmod *peer);

/** The same for a Hermitian matrix with its values in turn, H->x. Right-hand sides and solutions
 *  are complex; peer_cholmod_local is for real ones. */
peer_cholmod *peer_cholmod_create_complex(const sl_hermitian *H, const sl_int *perm);

/** Repeats the supernodal analysis and releases it. */
void peer_cholmod_analyze(peer_cholmod *peer);

/** Repeats the supernodal or the simplicial factorization, same pattern. */
void peer_cholmod_factor(peer_cholmod *peer);
void peer_cholmod_factor_simplicial(peer_cholmod *peer);

/** Sets other values on the same pattern, for later factorizations; x must outlive them. */
void peer_cholmod_values(peer_cholmod *peer, const double *x);

/** A first supernodal factorization, allocation included. Call ready before each: it drops the last
 *  one.
 */
void peer_cholmod_first_ready(peer_cholmod *peer);
void peer_cholmod_first(peer_cholmod *peer);

/** Solves with the supernodal or the simplicial factor. B is n x nrhs, leading dimension n; so is
 *  the result, which is valid until the next call.
 */
const double *peer_cholmod_solve(peer_cholmod *peer, const double *B, sl_int nrhs);
const double *peer_cholmod_solve_simplicial(peer_cholmod *peer, const double *B, sl_int nrhs);

/** Number of threads of OpenBLAS; CHOLMOD has no others. 1 after peer_cholmod_create. */
void peer_cholmod_threads(int count);

/** cholmod_solve2 with Bset on the simplicial factor, one right-hand side. b holds nb values at the
 *  rows bset, which are also where x is wanted. The result is indexed by row, is valid on bset, and
 *  lasts until the next call.
 */
const double *peer_cholmod_local(peer_cholmod *peer, const sl_int *bset, sl_int nb,
                                 const double *b);

/** Peak memory in bytes of the supernodal analysis and factorization, by CHOLMOD's own count,
 *  without A.
 */
double peer_cholmod_peak(const peer_cholmod *peer);

/** Entries of the simplicial L. */
double peer_cholmod_nnz(const peer_cholmod *peer);

/** CHOLMOD's changes of a factor: updates, downdates and rows deleted and added, on a copy of the
 *  simplicial factor. CHOLMOD takes them in the order of the pivots; changes are prepared once, so
 *  that no time is spent on the permutation.
 */
typedef struct peer_change peer_change;

/** A must be the matrix of the peer, which must outlive the result, as must A. Room for `count`
 *  prepared updates and rows. */
peer_change *peer_change_create(peer_cholmod *peer, const sl_csc *A, int count);
void peer_change_free(peer_change *c);

/** Prepares update k: the sum over r of w (e_i - e_j)(e_i - e_j)' with i = rows[r], j = others[r];
 *  others NULL: w e_i e_i'. */
void peer_change_prepare(peer_change *c, int k, const sl_int *rows, const sl_int *others, int ranks,
                         double w);

/** cholmod_updown with update k. */
void peer_change_update(peer_change *c, int k, int is_update);

/** Prepares row k: the row and column of A. */
void peer_change_prepare_row(peer_change *c, int k, sl_int row);

/** cholmod_rowdel: row k of the matrix becomes that of the identity; cholmod_rowadd: it returns. */
void peer_change_delete_row(peer_change *c, int k);
void peer_change_add_row(peer_change *c, int k);

/** x(row) of the solution for b = e_row, by cholmod_solve2 with Bset. */
double peer_change_local(peer_change *c, sl_int row);

/** A full solve; valid until the next call. b has n entries. */
const double *peer_change_solve(peer_change *c, const double *b);

/** Name of the processor core that OpenBLAS chose its kernels for. */
const char *peer_cholmod_kernels(void);

/** CHOLMOD on the caller's matrix with an ordering that CHOLMOD computes itself. */
typedef struct peer_cholmod_own peer_cholmod_own;

typedef enum peer_cholmod_ordering {
    PEER_CHOLMOD_METIS,   /* one method: METIS; all else as cholmod_start leaves it */
    PEER_CHOLMOD_DEFAULTS /* nothing set: AMD, then METIS if AMD's fill is large */
} peer_cholmod_ordering;

/** cholmod_start, cholmod_analyze, cholmod_factorize. A stores its lower triangle and must outlive
 *  the peer. Exits with a message on an error.
 */
peer_cholmod_own *peer_cholmod_own_create(const sl_csc *A, peer_cholmod_ordering ordering);

/** Everything that create allocated, and cholmod_finish. NULL is allowed. */
void peer_cholmod_own_free(peer_cholmod_own *peer);

/** cholmod_factorize again, same matrix. */
void peer_cholmod_own_factor(peer_cholmod_own *peer);

/** B is n x nrhs, leading dimension n; so is the result, which is valid until the next call. */
const double *peer_cholmod_own_solve(peer_cholmod_own *peer, const double *B, sl_int nrhs);

/** Entries of L, and the operations of its factorization: the sum over columns of entries^2. */
double peer_cholmod_own_nnz(const peer_cholmod_own *peer);
double peer_cholmod_own_flops(const peer_cholmod_own *peer);

/** What CHOLMOD chose: the kind of factor, and the ordering by name. */
int peer_cholmod_own_is_supernodal(const peer_cholmod_own *peer);
const char *peer_cholmod_own_ordering(const peer_cholmod_own *peer);

/** Eigen's SimplicialLDLT with natural ordering, on a matrix that was permuted beforehand. */
typedef struct peer_eigen peer_eigen;

/** C is the lower triangle of P A P'. Analyses, does not factor. Exits with a message on an error.
 */
peer_eigen *peer_eigen_create(const sl_csc *C);
void peer_eigen_free(peer_eigen *peer);
void peer_eigen_analyze(peer_eigen *peer);
void peer_eigen_factor(peer_eigen *peer);

/** Solves C X = B; both n x nrhs, leading dimension n, in pivot order. */
void peer_eigen_solve(peer_eigen *peer, double *X, const double *B, sl_int nrhs);

/** Eigen's SimplicialLDLT with its defaults, AMD ordering included, on the caller's matrix. */
typedef struct peer_eigen_amd peer_eigen_amd;

/** A is copied and nothing is computed yet. */
peer_eigen_amd *peer_eigen_amd_create(const sl_csc *A);
void peer_eigen_amd_free(peer_eigen_amd *peer); /* NULL is allowed */

/** analyzePattern alone. Returns the operations of the factorization: the sum over columns of
 *  entries^2. */
double peer_eigen_amd_analyze(peer_eigen_amd *peer);

/** compute() with a new solver: ordering, analysis and factorization. */
void peer_eigen_amd_compute(peer_eigen_amd *peer);

/** factorize() again, same matrix; after compute. */
void peer_eigen_amd_factor(peer_eigen_amd *peer);

/** Solves A X = B; both n x nrhs, leading dimension n. */
void peer_eigen_amd_solve(peer_eigen_amd *peer, double *X, const double *B, sl_int nrhs);

/** Entries of L, the diagonal included; after compute. */
double peer_eigen_amd_nnz(const peer_eigen_amd *peer);

/** Eigen's SimplicialLDLT of complex numbers with its defaults, AMD ordering included. */
typedef struct peer_eigen_complex peer_eigen_complex;

/** H stores its lower triangle, with its values in turn, and is copied. Analyzes and factors. */
peer_eigen_complex *peer_eigen_complex_create(const sl_hermitian *H);
void peer_eigen_complex_free(peer_eigen_complex *peer);
void peer_eigen_complex_factor(peer_eigen_complex *peer);

/** Solves H x = b, one complex right-hand side. */
void peer_eigen_complex_solve(peer_eigen_complex *peer, double *x, const double *b);

#ifdef __cplusplus
}
#endif

#endif
