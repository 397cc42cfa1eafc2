/* family.h: M + t L of a system for eight values of t, each in every form that a way to factor wants */
#ifndef BENCH_FAMILY_H
#define BENCH_FAMILY_H

#include "bench.h"

enum { FAMILY_TIMES = 8, FAMILY_TERMS = 2 };

/** The matrix of every system is M + s L, and L's rows sum to 0: the masses are the row sums, L what is left. t goes
 *  from s/16 to 8 s. */
typedef struct family {
    const bench_system *system;
    sl_csc M, L;                           /* a diagonal; the pattern of A */
    double *values[FAMILY_TERMS];          /* both spread */
    double c[FAMILY_TERMS * FAMILY_TIMES]; /* 1 and t */
    double *sums[FAMILY_TIMES];            /* M + t L, summed, for the pattern of A */
    double *by_hand;                       /* room for one more */
    sl_factor *F[FAMILY_TIMES];
    sl_threads threads; /* of the call at hand */
} family;

void family_make(family *f, const bench_system *system);
void family_free(family *f);

const double *const *family_values(const family *f);
const sl_factor *const *family_factors(const family *f);

/** M + t[k] L into by_hand, by one loop over A's entries. */
const double *family_sum(family *f, int k);

/* contenders; state is the family */
void family_call_summed_before(void *state);
void family_call_summed_by_hand(void *state);
void family_call_one_by_one(void *state);
void family_call_batch(void *state);

/** The factors of the batch have the bits of those of the sums. */
int family_check(bench_run *run, family *f);

#endif
