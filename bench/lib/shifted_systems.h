/* shifted_systems.h: M + t L of a system for eight t, as each way to factor needs it */
#ifndef BENCH_SHIFTED_SYSTEMS_H
#define BENCH_SHIFTED_SYSTEMS_H

#include "bench.h"

enum { SHIFTED_COUNT = 8, SHIFTED_TERMS = 2 };

/** The matrix of every system is M + s L, and the rows of L sum to 0: so the row sums of A are the
 *  masses M, and A - M is s L. t goes from s/16 to 8 s.
 */
typedef struct shifted_systems {
    const bench_system *system;
    sl_csc M, L;                             /* M is diagonal; L has the pattern of A */
    double *values[SHIFTED_TERMS];           /* M and L as sl_symbolic_scatter gives them */
    double c[SHIFTED_TERMS * SHIFTED_COUNT]; /* the coefficients 1 and t of every sum */
    double *sums[SHIFTED_COUNT];             /* values of M + t L on the pattern of A */
    double *sum;                             /* values of one more sum */
    sl_factor *F[SHIFTED_COUNT];
    sl_threads threads; /* of the next batch call */
} shifted_systems;

void shifted_systems_make(shifted_systems *f, const bench_system *system);
void shifted_systems_free(shifted_systems *f);

const double *const *shifted_systems_values(const shifted_systems *f);

/** Computes M + t[k] L into sum, in one loop over the entries of A, and returns it. */
const double *shifted_systems_sum(shifted_systems *f, int k);

/* contenders; state is a shifted_systems * */
void shifted_call_presummed(void *state);
void shifted_call_summed_by_hand(void *state);
void shifted_call_one_by_one(void *state);
void shifted_call_batch(void *state);

/** Checks that the factors of the batch equal those of the presummed matrices bit for bit. */
int shifted_systems_check(bench_run *run, shifted_systems *f);

#endif
