/* peers_ldl.h: an up-looking LDL' in the order of AMD, the algorithm of QDLDL: SuiteSparse's LDL */
#ifndef BENCH_PEERS_LDL_H
#define BENCH_PEERS_LDL_H

#include "sparse_local.h"

/** AMD's order of A, which stores its lower triangle. perm has n entries. Exits with a message on
 *  an error. */
void peer_amd_order(const sl_csc *A, sl_int *perm);

/** P A P' = L D L', with 1x1 pivots of any sign in the order given by AMD. */
typedef struct peer_ldl peer_ldl;

/** Orders and analyzes A, which stores its lower triangle and must outlive the result. Exits with a
 *  message on an error. */
peer_ldl *peer_ldl_create(const sl_csc *A);
void peer_ldl_free(peer_ldl *peer); /* NULL is allowed */

/** Computes L and D from the values of A. */
void peer_ldl_factor(peer_ldl *peer);

/** Solves A x = b; both have n entries. */
void peer_ldl_solve(peer_ldl *peer, double *x, const double *b);

/** Entries of L, the diagonal included. */
double peer_ldl_nnz(const peer_ldl *peer);

#endif
