/* peers_steps.h: one system factored by this library and by its peers, and the steps timed on it */
#ifndef BENCH_PEERS_STEPS_H
#define BENCH_PEERS_STEPS_H

#include "bench/lib/bench.h"
#include "peers.h"

enum { PEERS_MAX_RHS = 64, PEERS_THREADS = 2 };

/** One system, factored by every library. Unless a field says otherwise, the permutation is the one
 *  that our analysis ended with; Eigen receives a permuted matrix and permuted vectors, so that it
 *  permutes nothing.
 */
typedef struct comparison {
    const bench_system *system; /* with the kernels of the best instruction set */
    bench_system avx2;   /* the same with AVX2 forced; F is NULL if AVX2 is the best or absent */
    sl_options given;    /* our permutation as a given one */
    sl_factor *F;        /* for refactorizations */
    sl_factor *first;    /* the latest first factorization */
    sl_factor *threaded; /* refactors on PEERS_THREADS */
    sl_symbolic *S;      /* the latest analysis */
    peer_cholmod *cholmod;
    peer_eigen *eigen;                  /* NULL if its factorization would take minutes */
    double eigen_analyze, eigen_first;  /* seconds of its analysis, of its first factorization */
    peer_cholmod_own *cholmod_metis;    /* in an ordering of its own; during one step */
    peer_cholmod_own *cholmod_defaults; /* from peers_order_to_factor on */
    peer_eigen_amd *eigen_defaults;     /* the same; NULL if it would take too long */
    double eigen_defaults_flops;
    double one_factor_flops; /* of this library's factor for SL_PURPOSE_ONE_FACTOR */
    sl_matrix *permuted;
    int is_brief; /* large and not BENCH=full: fewer repetitions and steps */
    sl_int nrhs;
    double *B, *X; /* n x max_rhs */
    sl_work *W;
    const double *answer;      /* CHOLMOD's latest solution */
    bench_sample best_full[3]; /* [nrhs], CHOLMOD's fastest full solve; count 0: not timed */
} comparison;

comparison *comparison_create(const bench_run *run, const bench_system *system, sl_int max_rhs);
void comparison_free(comparison *cmp);

/** A contender and its line in the table. */
typedef struct timed_row {
    const char *method;
    void (*call)(void *);
    void *state;
    int batch; /* 0 means 1 */
    int is_peer;
    sl_isa isa;
    sl_int threads;
    double entries, flops;
    int passes;
    void (*ready)(void *);
    bench_sample sample; /* count > 0: timed already, only to be printed */
} timed_row;

/** Times the rows that have no sample yet, side by side, for about the given number of seconds. */
void peers_time(double seconds, timed_row *rows, int count);

/** Prints a line for each row. The ratio's baseline is in seconds; 0 means the median of the first
 *  row. reach may be NULL. Returns the baseline. */
double peers_report(bench_report *report, const comparison *cmp, const char *what, sl_int nrhs,
                    const timed_row *rows, int count, const sl_stats *reach, double baseline);

/** peers_time, then peers_report. */
double peers_race(double seconds, bench_report *report, const comparison *cmp, const char *what,
                  sl_int nrhs, timed_row *rows, int count, const sl_stats *reach, double baseline);

/** One timed call, for what takes seconds. */
bench_sample peers_time_once(void (*call)(void *), void *state);

/** A sample of one time. */
bench_sample peers_one_sample(double seconds);

/** Waits until the threads of OpenBLAS, which spin for a while after their work, sleep. state is
 *  not read.
 */
void peers_wait_idle(void *state);

/** Analysis, first factorization, refactorization, on one thread and on two (peers_factor.c). Needs
 *  the factors that peers_order_to_factor leaves.
 */
void peers_factor(bench_run *run, bench_report *report, comparison *cmp);

/** Ordering, analysis and first factorization together (peers_order_to_factor.c). */
void peers_order_to_factor(bench_run *run, bench_report *report, comparison *cmp);

/** A full solve with nrhs right-hand sides (peers_solve.c). */
void peers_solve(bench_run *run, bench_report *report, comparison *cmp, sl_int nrhs);

/** Local solves: one vertex, a pair of vertices, patches (peers_local.c). */
void peers_local(bench_run *run, bench_report *report, comparison *cmp);

/** Updates, downdates and pins, on factors of their own (peers_change.c). */
void peers_change(bench_run *run, bench_report *report, comparison *cmp);

/** Entries of the inverse, on and off the diagonal (peers_inverse.c). */
void peers_inverse(bench_run *run, bench_report *report, comparison *cmp);

#endif
