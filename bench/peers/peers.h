/* peers.h: CHOLMOD and Eigen behind a few calls, each in its best setting for a given permutation */
#ifndef BENCH_PEERS_H
#define BENCH_PEERS_H

#include "../sparse_local.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Two CHOLMOD factors of one matrix over one permutation: supernodal LL' for whole solves, and simplicial LDL',
 *  packed, made beforehand, for solves with Bset. 32-bit interface. */
typedef struct peer_cholmod peer_cholmod;

/** A stores its lower triangle and must outlive the peer; ends the program on an error. */
peer_cholmod *peer_cholmod_create(const sl_csc *A, const sl_int *perm);
void peer_cholmod_free(peer_cholmod *peer);

/** Supernodal analysis once more, with its release. */
void peer_cholmod_analyse(peer_cholmod *peer);

/** Supernodal factorization again, same pattern; and the same of the simplicial one. */
void peer_cholmod_factor(peer_cholmod *peer);
void peer_cholmod_factor_simple(peer_cholmod *peer);

/** Other values of the same pattern, for the factorizations to come; x must outlive them. */
void peer_cholmod_values(peer_cholmod *peer, const double *x);

/** A first supernodal factorization, its memory included; ready, before each, drops the last one. */
void peer_cholmod_first_ready(peer_cholmod *peer);
void peer_cholmod_first(peer_cholmod *peer);

/** Solves with the supernodal factor; B is n x nrhs, leading dimension n; so is the result, which lives until the
 *  next call. The other one: with the simplicial factor. */
const double *peer_cholmod_solve(peer_cholmod *peer, const double *B, sl_int nrhs);
const double *peer_cholmod_solve_simple(peer_cholmod *peer, const double *B, sl_int nrhs);

/** Threads of OpenBLAS, which are all that CHOLMOD has; 1 after peer_cholmod_create. */
void peer_cholmod_threads(int count);

/** cholmod_solve2 with Bset on the simplicial factor, one right-hand side: b holds nb values at the rows bset, where
 *  x is wanted too. The result is indexed by row, valid on bset, and lives until the next call. */
const double *peer_cholmod_local(peer_cholmod *peer, const sl_int *bset, sl_int nb,
                                 const double *b);

/** Bytes that the supernodal analysis and factorization had at once, by CHOLMOD's own count; A is not among them. */
double peer_cholmod_peak(const peer_cholmod *peer);

/** Entries of the simplicial L. */
double peer_cholmod_nnz(const peer_cholmod *peer);

/** What its dense kernels run on: the name of OpenBLAS's core. */
const char *peer_cholmod_kernels(void);

/** Eigen's SimplicialLDLT with natural ordering of a matrix permuted beforehand. */
typedef struct peer_eigen peer_eigen;

/** C is the lower triangle of P A P'; ends the program on an error. Analysed, not factored. */
peer_eigen *peer_eigen_create(const sl_csc *C);
void peer_eigen_free(peer_eigen *peer);
void peer_eigen_analyse(peer_eigen *peer);
void peer_eigen_factor(peer_eigen *peer);

/** Solves C X = B; both n x nrhs, leading dimension n, in pivot order. */
void peer_eigen_solve(peer_eigen *peer, double *X, const double *B, sl_int nrhs);

#ifdef __cplusplus
}
#endif

#endif
