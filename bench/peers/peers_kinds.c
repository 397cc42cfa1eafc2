/* peers_kinds.c: from the matrix to a factor on many kinds of small systems, against the peers */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/graph_kinds.h"
#include "peers.h"
#include "peers_ldl.h"

/* Ordering, analysis and factorization of a matrix that is new to every library: this library with
 * its defaults and for one factor; CHOLMOD with nothing set; CHOLMOD with METIS; Eigen with AMD.
 * The orderings alone are compared with METIS_NodeND (by default) and with AMD (for one factor).
 * Times are the least processor times of calls in turn: these systems take milliseconds, and
 * whatever else runs on the machine would be a large part of them. What a call allocates is
 * released after its time is taken. */
enum {
    OURS,
    OURS_ONE,
    CHOLMOD,
    CHOLMOD_METIS,
    EIGEN,
    METIS_ORDER,
    AMD_ORDER,
    CONTENDERS,
    /* parts of the first two */
    ORDER = CONTENDERS,
    ANALYZE,
    FACTOR,
    ORDER_ONE,
    TIMES
};

/* Ratios: times of the fastest peer to ours, times of the other ordering to ours, and entries of L
 * and path weights of ours to theirs. The worst ratio of times is the least, of sizes the largest.
 */
typedef enum ratio {
    RATIO_TIME,
    RATIO_TIME_ONE,
    RATIO_ORDER,
    RATIO_ORDER_ONE,
    RATIO_NNZ,
    RATIO_PATH,
    RATIO_NNZ_ONE,
    RATIOS
} ratio;

enum { MIN_CALLS = 2, MAX_ROUNDS = 100 };

static const sl_int largest_quick = 25000;

typedef struct job {
    bench_run *run;
    bench_system system; /* without a factor and a graph */
    double *b, *x;
    sl_int *perm;                        /* of AMD */
    double least[TIMES];                 /* seconds */
    double spent[CONTENDERS];            /* seconds of all calls */
    double ours[RATIOS], theirs[RATIOS]; /* sizes; the ratios of times are not set */
    int passed;
} job;

static void keep(job *j, int what, double seconds) {
    j->least[what] = j->least[what] > 0 ? fmin(j->least[what], seconds) : seconds;
}

static void check(job *j, const double *x, const char *method) {
    j->passed &= bench_check_residual(j->run, &j->system, x, j->b, 1, method);
}

/* Calls with is_first check the result and measure sizes; their times are not kept. */
static void call_ours(job *j, int c, int is_first) {
    const size_t n = (size_t)j->system.n;
    sl_options opt;
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    memset(&opt, 0, sizeof opt);
    opt.purpose = c == OURS ? SL_PURPOSE_MANY_SOLVES : SL_PURPOSE_ONE_FACTOR;
    const double start = bench_processor_seconds();
    bench_must(sl_symbolic_create(&S, &j->system.A, &opt, &stats), "analysis");
    const double middle = bench_processor_seconds();
    bench_must(sl_factor_create(&F, S, &j->system.A, NULL, NULL), "factor");
    const double end = bench_processor_seconds(), order = stats.symbolic.seconds_order;
    j->spent[c] += end - start;
    if (is_first) {
        j->system.stats = stats;
        bench_must(sl_factor_solve(F, j->x, n, j->b, n, 1, NULL), "solve");
        check(j, j->x, c == OURS ? "ours" : "ours, one factor");
        j->ours[c == OURS ? RATIO_NNZ : RATIO_NNZ_ONE] = (double)stats.symbolic.nnz_l;
        if (c == OURS) {
            j->ours[RATIO_PATH] = bench_path_weight(S, NULL);
        }
    } else {
        keep(j, c, end - start);
        keep(j, c == OURS ? ORDER : ORDER_ONE, order);
        if (c == OURS) {
            keep(j, ANALYZE, middle - start - order);
            keep(j, FACTOR, end - middle);
        }
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void call_cholmod(job *j, int c, int is_first) {
    const double start = bench_processor_seconds();
    peer_cholmod_own *peer = peer_cholmod_own_create(
        &j->system.A, c == CHOLMOD ? PEER_CHOLMOD_DEFAULTS : PEER_CHOLMOD_METIS);
    const double seconds = bench_processor_seconds() - start;
    j->spent[c] += seconds;
    if (is_first) {
        check(j, peer_cholmod_own_solve(peer, j->b, 1), "CHOLMOD");
    } else {
        keep(j, c, seconds);
    }
    peer_cholmod_own_free(peer);
}

static void call_eigen(job *j, int is_first) {
    peer_eigen_amd *peer = peer_eigen_amd_create(&j->system.A);
    const double start = bench_processor_seconds();
    peer_eigen_amd_compute(peer);
    const double seconds = bench_processor_seconds() - start;
    j->spent[EIGEN] += seconds;
    if (is_first) {
        peer_eigen_amd_solve(peer, j->x, j->b, 1);
        check(j, j->x, "Eigen");
    } else {
        keep(j, EIGEN, seconds);
    }
    peer_eigen_amd_free(peer);
}

/* METIS through this library, which makes the same graph for its own ordering; AMD on A. */
static void call_order(job *j, int c, int is_first) {
    sl_options opt;
    sl_symbolic *S;
    sl_stats stats;
    memset(&opt, 0, sizeof opt);
    opt.ordering = c == METIS_ORDER ? SL_ORDERING_METIS : SL_ORDERING_GIVEN;
    opt.perm = c == METIS_ORDER ? NULL : j->perm;
    const double start = bench_processor_seconds();
    if (c == AMD_ORDER) {
        peer_amd_order(&j->system.A, j->perm);
    }
    double seconds = bench_processor_seconds() - start;
    if (c == METIS_ORDER || is_first) {
        bench_must(sl_symbolic_create(&S, &j->system.A, &opt, &stats), "analysis");
        seconds = c == METIS_ORDER ? stats.symbolic.seconds_order : seconds;
        j->theirs[c == METIS_ORDER ? RATIO_NNZ : RATIO_NNZ_ONE] = (double)stats.symbolic.nnz_l;
        if (c == METIS_ORDER) {
            j->theirs[RATIO_PATH] = bench_path_weight(S, NULL);
        }
        sl_symbolic_free(S);
    }
    j->spent[c] += seconds;
    if (!is_first) {
        keep(j, c, seconds);
    }
}

static void call(job *j, int c, int is_first) {
    if (c <= OURS_ONE) {
        call_ours(j, c, is_first);
    } else if (c <= CHOLMOD_METIS) {
        call_cholmod(j, c, is_first);
    } else if (c == EIGEN) {
        call_eigen(j, is_first);
    } else {
        call_order(j, c, is_first);
    }
}

/* Rounds of all contenders in turn; one leaves when it has had its time. Returns whether the
 * results were right. */
static int measure(job *j) {
    const size_t n = (size_t)j->system.n;
    uint64_t rng = 21;
    j->passed = 1;
    j->b = bench_alloc(n, sizeof *j->b);
    j->x = bench_alloc(n, sizeof *j->x);
    j->perm = bench_alloc(n, sizeof *j->perm);
    bench_random_fill(&rng, j->b, n);
    for (int c = 0; c < CONTENDERS; c++) {
        call(j, c, 1);
    }
    for (int round = 0; round < MAX_ROUNDS && j->passed; round++) {
        for (int c = 0; c < CONTENDERS; c++) {
            if (round < MIN_CALLS || j->spent[c] < 1.5 * j->run->seconds) {
                call(j, c, 0);
            }
        }
    }
    free(j->b);
    free(j->x);
    free(j->perm);
    return j->passed;
}

/* ---- the table, the file and the picture ---- */

static const char *const peer_names[] = {"CHOLMOD defaults", "CHOLMOD METIS", "Eigen defaults"};
static const char peer_letters[] = "CMA";

typedef struct sums {
    double logarithm[RATIOS], worst[RATIOS];
    int count;
} sums;

static void add_to(sums *s, const double *ratios) {
    for (int r = 0; r < RATIOS; r++) {
        s->logarithm[r] += log(ratios[r]);
        s->worst[r] = s->count == 0   ? ratios[r]
                      : r < RATIO_NNZ ? fmin(s->worst[r], ratios[r])
                                      : fmax(s->worst[r], ratios[r]);
    }
    s->count++;
}

static void print_ratios(const double *ratios, char peer) {
    printf(" | %6.2f %c %6.2f | %6.2f %6.2f | %6.3f %6.3f | %6.3f\n", ratios[RATIO_TIME], peer,
           ratios[RATIO_TIME_ONE], ratios[RATIO_ORDER], ratios[RATIO_ORDER_ONE], ratios[RATIO_NNZ],
           ratios[RATIO_PATH], ratios[RATIO_NNZ_ONE]);
}

static void print_sums(const char *what, const sums *s) {
    double mean[RATIOS];
    for (int r = 0; r < RATIOS; r++) {
        mean[r] = exp(s->logarithm[r] / s->count);
    }
    printf("     %-10s %3d systems: mean  %49s", what, s->count, "");
    print_ratios(mean, ' ');
    printf("     %26s worst %49s", "", "");
    print_ratios(s->worst, ' ');
}

/* The ratios of a system, and its fastest peer. */
static int find_ratios(const job *j, double *ratios) {
    int best = CHOLMOD;
    for (int c = CHOLMOD; c <= EIGEN; c++) {
        best = j->least[c] < j->least[best] ? c : best;
    }
    ratios[RATIO_TIME] = j->least[best] / j->least[OURS];
    ratios[RATIO_TIME_ONE] = j->least[best] / j->least[OURS_ONE];
    ratios[RATIO_ORDER] = j->least[METIS_ORDER] / j->least[ORDER];
    ratios[RATIO_ORDER_ONE] = j->least[AMD_ORDER] / j->least[ORDER_ONE];
    for (int r = RATIO_NNZ; r < RATIOS; r++) {
        ratios[r] = j->ours[r] / j->theirs[r];
    }
    return best - CHOLMOD;
}

static void report(FILE *csv, const job *j, int k, const double *ratios, int best) {
    const bench_system *system = &j->system;
    const int shown[] = {ORDER, ANALYZE, FACTOR, OURS, ORDER_ONE, OURS_ONE};
    printf("  %2d %-19s %7d %8d |", k + 1, system->name, (int)system->n,
           (int)system->A.p[system->n]);
    for (int c = 0; c < 6; c++) {
        printf("%s %7.2f", c == 4 ? " |" : "", 1e3 * j->least[shown[c]]);
    }
    print_ratios(ratios, peer_letters[best]);
    fflush(stdout);
    fprintf(csv, "peers_kinds,\"%s\",\"%s\",%d,%d", kind_group_names[kind_group_of(k)],
            system->name, (int)system->n, (int)system->A.p[system->n]);
    for (int c = 0; c < TIMES; c++) {
        fprintf(csv, ",%.6g", j->least[c]);
    }
    fprintf(csv, ",\"%s\"", peer_names[best]);
    for (int r = 0; r < RATIOS; r++) {
        fprintf(csv, ",%.4g", ratios[r]);
    }
    fprintf(csv, "\n");
}

static FILE *open_table(const bench_run *run) {
    char path[512];
    snprintf(path, sizeof path, "%s/peers_kinds.csv", run->out_dir);
    FILE *csv = bench_create(path);
    fprintf(csv, "question,group,system,n,nnz_a,ours_s,one_s,cholmod_s,cholmod_metis_s,eigen_s,"
                 "metis_order_s,amd_order_s,order_s,analyze_s,factor_s,order_one_s,peer,ratio,"
                 "ratio_one,ratio_order,ratio_order_one,nnz_l,path,nnz_l_one\n");
    printf("\n== peers_kinds: from the matrix to a factor on many kinds of small systems\n"
           "   times: least processor times in ms, by default and for one factor\n"
           "   peer: time of the fastest peer / ours, by default and for one factor; C CHOLMOD, M "
           "CHOLMOD with METIS, A Eigen\n"
           "   order: time of METIS_NodeND / ours by default; of AMD / ours for one factor\n"
           "   nnz(L), path: entries of L and mean path weight / those with METIS; for one factor "
           "entries of L / those with AMD\n\n"
           "     %-19s %7s %8s | %7s %7s %7s %7s | %7s %7s | %6s   %6s | %6s %6s | %6s %6s | %6s\n",
           "system", "n", "nnz(A)", "order", "analyze", "factor", "all", "order", "all", "peer",
           "one", "order", "one", "nnz(L)", "path", "one");
    return csv;
}

/* What all systems add to. */
typedef struct results {
    FILE *csv;
    bench_plot *plot;
    sums groups[KIND_GROUPS], all;
    double one[KINDS]; /* RATIO_TIME_ONE; 0: not measured */
} results;

static void one_kind(bench_run *run, results *to, int k) {
    const kind_group group = kind_group_of(k);
    double ratios[RATIOS];
    job j;
    memset(&j, 0, sizeof j);
    j.run = run;
    j.system.matrix = kind_matrix(k);
    j.system.A = sl_matrix_view(j.system.matrix);
    j.system.n = j.system.A.n_cols;
    snprintf(j.system.name, sizeof j.system.name, "%s", kind_name(k));
    if ((run->size != BENCH_QUICK || j.system.n <= largest_quick) && measure(&j)) {
        const int best = find_ratios(&j, ratios);
        report(to->csv, &j, k, ratios, best);
        add_to(&to->groups[group], ratios);
        add_to(&to->all, ratios);
        bench_plot_point(to->plot, kind_group_names[group], "boxes", k + 1, ratios[RATIO_TIME]);
        to->one[k] = ratios[RATIO_TIME_ONE];
    }
    sl_matrix_free(j.system.matrix);
}

void bench_peers_kinds(bench_run *run) {
    results to;
    memset(&to, 0, sizeof to);
    to.csv = open_table(run);
    to.plot = bench_plot_open(run, "peers_kinds", "Matrix to factor: fastest peer / this library",
                              "row of the table", "ratio of times", "y");
    bench_machine_write(run, "peers_kinds");
    for (int k = 0; k < KINDS; k++) {
        one_kind(run, &to, k);
    }
    printf("\n");
    for (int g = 0; g < KIND_GROUPS; g++) {
        if (to.groups[g].count > 0) {
            print_sums(kind_group_names[g], &to.groups[g]);
        }
    }
    if (to.all.count > 0) {
        print_sums("all", &to.all);
    }
    for (int k = 0; k < KINDS; k++) { /* a logarithmic axis omits zeros */
        bench_plot_point(to.plot, "for one factor", "points", k + 1, to.one[k]);
    }
    bench_close(to.csv);
    bench_plot_close(to.plot);
}
