/* vertex_pairs.c: are separate reaches of b and x faster than a joint one? */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* The histogram of [HDA17] section 5: random pairs (i, j) on a mesh of 2e5 vertices. Joint reach
 * ("joint reach" in the paper): both sweeps run over the paths of i and j, as if b and x had one
 * common set. Separate reaches ("separate reaches"): the forward sweep runs over the path of i, the
 * backward sweep over that of j. Both use the one-call solve, as in the paper: finding the paths
 * is included. A solve with b and x at the same vertex is timed too. */
enum { BINS = 30, REPEATS = 2 };

static const double bin_width = 0.1;

typedef struct pair {
    sl_int ij[2];
    double joint, separate; /* seconds */
    double x_joint, x_separate;
} pair;

static void solve_pair(const bench_system *system, pair *p, sl_work *W, sl_stats *reach) {
    const double b[2] = {1, 0};
    double x[2];
    double start = bench_now();
    bench_must(sl_local_solve(system->F, p->ij, 2, p->ij, 2, x, 2, b, 2, 1, W, &reach[0]),
               "joint reach");
    double middle = bench_now();
    bench_must(sl_local_solve(system->F, &p->ij[0], 1, &p->ij[1], 1, &p->x_separate, 1, b, 1, 1, W,
                              &reach[1]),
               "separate reaches");
    double end = bench_now();
    p->x_joint = x[1];
    p->joint = middle - start < p->joint ? middle - start : p->joint;
    p->separate = end - middle < p->separate ? end - middle : p->separate;
}

static void check_pair(bench_run *run, const bench_system *system, const pair *p) {
    size_t n = (size_t)system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    memset(b, 0, n * sizeof *b);
    b[p->ij[0]] = 1;
    bench_must(sl_factor_solve(system->F, x, n, b, n, 1, NULL), "full solve");
    bench_check_residual(run, system, x, b, 1, "full solve");
    bench_check_bits(run, system, &p->x_separate, &p->ij[1], 1, x, 1, "separate reaches");
    free(x);
    free(b);
}

static void print_histogram(const int *bins, int pairs) {
    int largest = 1, first = 0, last = BINS - 1;
    for (int k = 0; k < BINS; k++) {
        largest = bins[k] > largest ? bins[k] : largest;
    }
    while (first < last && bins[first] == 0) {
        first++;
    }
    while (last > first && bins[last] == 0) {
        last--;
    }
    printf("  speedup          share of the pairs\n");
    for (int k = first; k <= last; k++) {
        int stars = (60 * bins[k] + largest - 1) / largest;
        printf("  %4.1f .. %4.1f  %6.2f%%  %.*s\n", k * bin_width, (k + 1) * bin_width,
               100.0 * bins[k] / pairs, stars,
               "************************************************************");
    }
}

static void histogram(const bench_run *run, const pair *pairs, int count) {
    int bins[BINS] = {0};
    char path[512];
    bench_plot *plot = bench_plot_open(run, "pairs_histogram",
                                       "Random pairs: separate reaches against a joint one",
                                       "speedup", "share of the pairs", "");
    snprintf(path, sizeof path, "%s/pairs_histogram.csv", run->out_dir);
    FILE *csv = bench_create(path);
    for (int k = 0; k < count; k++) {
        int bin = (int)(pairs[k].joint / pairs[k].separate / bin_width);
        bins[bin < BINS ? bin : BINS - 1]++;
    }
    fprintf(csv, "from,to,pairs\n");
    for (int k = 0; k < BINS; k++) {
        fprintf(csv, "%.2f,%.2f,%d\n", k * bin_width, (k + 1) * bin_width, bins[k]);
        if (bins[k] > 0) {
            bench_plot_point(plot, "pairs", "boxes", (k + 0.5) * bin_width,
                             (double)bins[k] / count);
        }
    }
    bench_close(csv);
    print_histogram(bins, count);
    bench_plot_close(plot);
}

static void random_pairs(bench_run *run, bench_report *report, const bench_system *system) {
    int count = run->size == BENCH_QUICK ? 1000 : 10000, differ = 0, slower = 0;
    pair *pairs = bench_alloc((size_t)count, sizeof *pairs);
    double *times[2], *gain = bench_alloc((size_t)count, sizeof *gain);
    uint64_t rng = 2017;
    sl_stats mean[2];
    double entries[2] = {0, 0};
    sl_work *W;
    bench_must(sl_work_create(&W, NULL), "workspace");
    for (int c = 0; c < 2; c++) {
        times[c] = bench_alloc((size_t)count, sizeof **times);
    }
    for (int k = 0; k < count; k++) {
        pair *p = &pairs[k];
        p->joint = p->separate = 1e9;
        p->ij[0] = bench_random_below(&rng, system->n);
        do {
            p->ij[1] = bench_random_below(&rng, system->n);
        } while (p->ij[1] == p->ij[0] && system->n > 1);
        for (int r = 0; r < REPEATS; r++) {
            solve_pair(system, p, W, mean);
        }
        if (k < 10) {
            check_pair(run, system, p);
        }
        differ += !(p->x_joint == p->x_separate);
        times[0][k] = p->joint;
        times[1][k] = p->separate;
        gain[k] = p->joint / p->separate;
        slower += gain[k] < 1;
        for (int c = 0; c < 2; c++) {
            entries[c] += ((double)mean[c].plan.b_entries + (double)mean[c].plan.x_entries) / count;
        }
    }
    bench_expect(run, differ == 0, "%d of %d pairs differ between joint and separate reaches",
                 differ, count);
    bench_row row = {.what = "random pairs", .method = "separate reaches", .nrhs = 1};
    row.entries = entries[1];
    row.time = bench_sample_of(times[1], count);
    row.baseline = row.time.median;
    bench_report_row(report, system, &row);
    row.method = "joint reach";
    row.entries = entries[0];
    row.time = bench_sample_of(times[0], count);
    bench_report_row(report, system, &row);
    histogram(run, pairs, count);
    bench_sample gains = bench_sample_of(gain, count);
    bench_report_note(report,
                      "separate reaches are %.2f times as fast in the median, from %.2f to %.2f",
                      gains.median, gains.min, gains.max);
    bench_report_note(report,
                      "%.2f %% of the pairs are slower ([HDA17]: a small number of close pairs, "
                      "by a small margin)",
                      100.0 * slower / count);
    for (int c = 0; c < 2; c++) {
        free(times[c]);
    }
    free(gain);
    free(pairs);
    sl_work_free(W);
}

static void one_vertex(bench_run *run, bench_report *report, const bench_system *system) {
    bench_queries *q = bench_queries_vertices(system, 256, 1);
    double medians[BENCH_SOLVE_VARIANTS];
    (void)bench_solve_variants_time(run, report, q, "one vertex", medians);
    bench_queries_free(q);
}

void bench_vertex_pairs(bench_run *run) {
    static const double default_n = 2e5, quick_n = 5e4;
    const bench_system *system;
    if (bench_systems(run, run->size == BENCH_QUICK ? &quick_n : &default_n, 1, &system) == 1) {
        bench_report *report = bench_report_open(
            run, "vertex_pairs",
            "local solves between two vertices and at one ([HDA17] section 5, histogram)",
            "separate reaches; plan solve");
        one_vertex(run, report, system);
        random_pairs(run, report, system);
        bench_report_close(report);
    }
}
