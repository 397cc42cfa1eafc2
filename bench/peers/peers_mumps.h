/* peers_mumps.h: MUMPS, sequential, for definite matrices in a given order; orders of Scotch */
#ifndef BENCH_PEERS_MUMPS_H
#define BENCH_PEERS_MUMPS_H

#include "sparse_local.h"

typedef struct peer_mumps peer_mumps;

/** Analyzes A, which stores its lower triangle and must outlive the result, in the order whose
 *  inverse permutation is iperm; without pivoting. Exits with a message on an error, as do the
 *  calls below. */
peer_mumps *peer_mumps_create(const sl_csc *A, const sl_int *iperm);
void peer_mumps_free(peer_mumps *peer); /* NULL is allowed */

/** Computes the factor from the values of A. */
void peer_mumps_factor(peer_mumps *peer);

/** Solves A X = B in place; n x nrhs, leading dimension n. */
void peer_mumps_solve(peer_mumps *peer, double *X, sl_int nrhs);

/** x := column `row` of A^-1, by a sparse right-hand side; n entries. */
void peer_mumps_column(peer_mumps *peer, double *x, sl_int row);

/** out[k] := entry (rows[k], rows[k]) of A^-1, by its selected entries of the inverse (ICNTL(30)),
 *  `block` of them at a time. rows ascend. */
void peer_mumps_diagonal(peer_mumps *peer, double *out, const sl_int *rows, sl_int count,
                         sl_int block);

/** The order of SCOTCH_graphOrder with its default strategy: perm[k] is the row of pivot k. */
void peer_scotch_order(const sl_csc *A, sl_int *perm);

#endif
