/* peers_steps.h: one system in the hands of this library and of its peers, and the steps that are timed on it */
#ifndef BENCH_PEERS_STEPS_H
#define BENCH_PEERS_STEPS_H

#include "bench.h"
#include "peers.h"

enum { PEERS_MOST_RHS = 64, PEERS_THREADS = 2 };

/** The permutation is the one that our analysis ended with. Eigen is given the permuted matrix and permuted vectors,
 *  so that it permutes nothing. */
typedef struct match {
    const bench_system *system; /* kernels of the best ISA */
    bench_system narrow; /* the same with AVX2 forced; F NULL where AVX2 is the best, or not here */
    sl_options given;    /* the same permutation */
    sl_factor *F, *first; /* for refactorizations, for first ones */
    sl_factor *threaded;  /* refactors on PEERS_THREADS */
    sl_symbolic *S;       /* the latest analysis */
    peer_cholmod *cholmod;
    peer_eigen *eigen;                 /* NULL where its factorization would take minutes */
    double eigen_analyse, eigen_first; /* seconds of its analysis, of its first factorization */
    sl_matrix *permuted;
    int is_brief; /* a large system, and not BENCH=full: fewer repetitions and steps */
    sl_int nrhs;
    double *B, *X; /* n x most_rhs */
    sl_work *W;
    const double *answer; /* CHOLMOD's last */
    bench_sample
        best_full[3]; /* [nrhs], CHOLMOD's best full solve of 1 and of 2; count 0: not timed */
} match;

match *match_create(const bench_run *run, const bench_system *system, sl_int most_rhs);
void match_free(match *m);

/** One contender and its row. */
typedef struct entry {
    const char *method;
    void (*call)(void *);
    void *state;
    int batch; /* 0 means 1 */
    int foreign;
    sl_isa isa;
    sl_int threads;
    double entries, flops;
    int passes;
    void (*ready)(void *);
    bench_sample sample; /* count > 0: timed before, the row alone is wanted */
} entry;

/** Races the entries for about so many seconds and prints a row for each; the first is the baseline. Leaves the times
 *  in sample. baseline: seconds; 0: the median of the first entry. Returns the baseline. */
double peers_race(double seconds, bench_report *report, const match *m, const char *what,
                  sl_int nrhs, entry *entries, int count, const sl_stats *reach, double baseline);

/** Waits until OpenBLAS's threads sleep, which spin for a while after their work. state is not read. */
void peers_nap(void *state);

/** Analysis, first factorization, refactorization, on one thread and on two (peers_factor.c). */
void peers_factor(bench_run *run, bench_report *report, match *m);

/** Order, analysis and first factorization, beside METIS and CHOLMOD (peers_setup.c). */
void peers_setup(bench_run *run, bench_report *report, match *m);

/** A full solve with so many right-hand sides (peers_solve.c). */
void peers_solve(bench_run *run, bench_report *report, match *m, sl_int nrhs);

/** Local solves: one vertex, a pair, patches (peers_local.c). */
void peers_local(bench_run *run, bench_report *report, match *m);

/** Entries of the inverse, diagonal ones and pairs (peers_inverse.c). */
void peers_inverse(bench_run *run, bench_report *report, match *m);

#endif
