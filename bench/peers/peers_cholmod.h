/* peers_cholmod.h: what the files that call CHOLMOD share */
#ifndef BENCH_PEERS_CHOLMOD_H
#define BENCH_PEERS_CHOLMOD_H

#include <suitesparse/cholmod.h>

#include "peers.h"

typedef struct cholmod_solver {
    cholmod_common common;
    cholmod_factor *L;
    cholmod_dense *X, *Y, *E; /* kept from one solve to the next */
} cholmod_solver;

struct peer_cholmod {
    cholmod_sparse A;
    sl_int *perm;
    cholmod_solver supernodal, simplicial;
    cholmod_factor *analysis; /* supernodal, analyzed only */
    cholmod_factor *first;    /* supernodal, the latest first factorization */
    cholmod_dense *b;         /* n x 1, read only at Bset */
    double peak;              /* bytes of the supernodal analysis and factorization */
    cholmod_sparse *bset;     /* a column of n rows */
    cholmod_sparse *xset;
};

/** Exits with a message if a call of CHOLMOD has failed. */
void peer_must(int passed, const char *doing);

#endif
