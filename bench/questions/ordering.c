/* ordering.c: what does an ordering cost and how good is it, against METIS_NodeND? */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/io/dataset.h"
#include "tools/mesh/grid.h"
#include "bench/lib/bench.h"

/* Times are the processor seconds that the library reports for the ordering, with its
 * graph, the minimum of the repetitions; those of METIS include the same graph. Shuffled systems
 * have their rows in random order.
 * "order to factor" is ordering, analysis and first factorization together. */
enum { MAX_REPEATS = 5, BIG = 300000 };

typedef struct quality {
    double seconds, nnz, flops, path_mean, path_largest;
} quality;

typedef struct variant {
    const char *name;
    sl_ordering ordering;
} variant;

static const variant variants[] = {{"ND", SL_ORDERING_ND}, {"MINDEG", SL_ORDERING_MINDEG}};

enum { VARIANTS = sizeof variants / sizeof *variants };

/* Sums of the ratios over meshes, for the means at the end: below 1e5 vertices and from there
 * on. */
typedef struct sums {
    quality ratio[2][VARIANTS];
    int count[2][VARIANTS];
} sums;

static quality quality_of(const sl_csc *A, const sl_options *opt) {
    sl_symbolic *S;
    sl_stats stats;
    bench_must(sl_symbolic_create(&S, A, opt, &stats), "analysis");
    quality y = {stats.symbolic.seconds_order, (double)stats.symbolic.nnz_l, stats.symbolic.flops,
                 0, 0};
    y.path_mean = bench_path_weight(S, &y.path_largest);
    sl_symbolic_free(S);
    return y;
}

/* Whether a matrix is large enough to skip all optional runs. Those take METIS minutes and are
 * for BENCH=full. */
static int is_short(const bench_run *run, const sl_csc *A) {
    return run->size != BENCH_FULL && A->n_cols > BIG;
}

static quality metis_quality(const sl_csc *A) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.ordering = SL_ORDERING_METIS;
    return quality_of(A, &opt);
}

static void add_row(bench_report *report, const bench_system *system, const char *what,
                    const char *method, const quality *y, double baseline) {
    bench_row row = {.what = what,
                     .method = method,
                     .time = {1, y->seconds, y->seconds, y->seconds},
                     .baseline = baseline};
    bench_report_row(report, system, &row);
}

/* Runs every ordering on one matrix. */
static void one_matrix(bench_run *run, bench_report *report, const bench_system *system,
                       const sl_csc *A, const char *what, sums *all) {
    const quality metis = metis_quality(A);
    add_row(report, system, what, "METIS_NodeND", &metis, metis.seconds);
    for (int k = 0; k < VARIANTS; k++) {
        sl_options opt;
        memset(&opt, 0, sizeof opt);
        opt.ordering = variants[k].ordering;
        quality y = quality_of(A, &opt);
        const int repeats = run->size == BENCH_QUICK ? 1 : A->n_cols > BIG ? 2 : MAX_REPEATS;
        for (int r = 1; r < repeats; r++) {
            const quality again = quality_of(A, &opt);
            bench_expect(run, again.nnz == y.nnz && again.path_mean == y.path_mean,
                         "%s: the same call gave another ordering", system->name);
            y.seconds = again.seconds < y.seconds ? again.seconds : y.seconds;
        }
        const quality ratio = {y.seconds / metis.seconds, y.nnz / metis.nnz, y.flops / metis.flops,
                               y.path_mean / metis.path_mean, y.path_largest / metis.path_largest};
        add_row(report, system, what, variants[k].name, &y, metis.seconds);
        bench_report_note(
            report,
            "%-14s   relative to METIS: time %.3f, nnz(L) %.3f, flops %.3f, path weight mean "
            "%.3f, largest %.3f",
            "", ratio.seconds, ratio.nnz, ratio.flops, ratio.path_mean, ratio.path_largest);
        quality *sum = &all->ratio[A->n_cols >= 99000][k];
        sum->seconds += ratio.seconds;
        sum->nnz += ratio.nnz;
        sum->flops += ratio.flops;
        sum->path_mean += ratio.path_mean;
        sum->path_largest += ratio.path_largest;
        all->count[A->n_cols >= 99000][k]++;
    }
}

/* Ordering, analysis and first factorization, with METIS and with the default ordering. */
typedef struct order_to_factor {
    const bench_system *system;
    sl_options options;
} order_to_factor;

static void call_order_to_factor(void *state) {
    order_to_factor *s = state;
    sl_symbolic *S;
    sl_factor *F;
    bench_must(sl_symbolic_create(&S, &s->system->A, &s->options, NULL), "analysis");
    bench_must(sl_factor_create(&F, S, &s->system->A, &s->options, NULL), "factor");
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void time_order_to_factor(bench_run *run, bench_report *report, const bench_system *system) {
    order_to_factor both[2];
    bench_sample samples[2];
    memset(both, 0, sizeof both);
    both[0].system = both[1].system = system;
    both[0].options.ordering = SL_ORDERING_METIS;
    bench_contender contenders[2] = {{call_order_to_factor, &both[0], 1, NULL},
                                     {call_order_to_factor, &both[1], 1, NULL}};
    bench_race(samples, contenders, 2, run->seconds);
    for (int k = 0; k < 2; k++) {
        bench_row row = {.what = "order to factor",
                         .method = k ? "ND" : "METIS_NodeND",
                         .time = samples[k],
                         .baseline = samples[0].median};
        bench_report_row(report, system, &row);
    }
}

static void one_shuffled(bench_run *run, bench_report *report, const bench_system *system,
                         sums *all) {
    const size_t n = (size_t)system->n;
    sl_int *perm = bench_alloc(n, sizeof *perm);
    uint64_t rng = 3;
    sl_matrix *M;
    for (size_t k = 0; k < n; k++) {
        perm[k] = (sl_int)k;
    }
    for (sl_int k = system->n - 1; k > 0; k--) {
        const sl_int other = bench_random_below(&rng, k + 1), keep = perm[k];
        perm[k] = perm[other];
        perm[other] = keep;
    }
    bench_must(sl_matrix_submatrix(&M, &system->A, perm, system->A.n_cols, NULL, NULL),
               "permuting");
    const sl_csc A = sl_matrix_view(M);
    one_matrix(run, report, system, &A, "order, shuffled", all);
    sl_matrix_free(M);
    free(perm);
}

static void print_means(bench_report *report, const sums *all) {
    static const char *const sizes[2] = {"below 1e5", "from 1e5 on"};
    for (int big = 0; big < 2; big++) {
        for (int k = 0; k < VARIANTS; k++) {
            const quality *sum = &all->ratio[big][k];
            const double count = all->count[big][k];
            if (count > 0) {
                bench_report_note(report,
                                  "mean over %d systems, n %s, %s: time %.3f, nnz(L) %.3f, flops "
                                  "%.3f, path weight mean %.3f, largest %.3f",
                                  (int)count, sizes[big], variants[k].name, sum->seconds / count,
                                  sum->nnz / count, sum->flops / count, sum->path_mean / count,
                                  sum->path_largest / count);
            }
        }
    }
}

/* Runs all meshes of the data folder from 5000 vertices on, in a full run. */
static void data_meshes(bench_run *run, bench_report *report, sums *all) {
    dataset files;
    if (run->size != BENCH_FULL || run->mesh_path || !dataset_list(&files, NULL, "meshes")) {
        return;
    }
    for (size_t k = 0; k < files.count; k++) {
        mesh m;
        char message[256];
        if (mesh_read(&m, files.paths[k], message, sizeof message) && m.n_vertices >= 5000 &&
            m.n_faces >= m.n_vertices) {
            const bench_system *system = bench_mesh(files.paths[k]);
            if (system) {
                one_matrix(run, report, system, &system->A, "order", all);
            }
        }
        mesh_free(&m);
    }
    dataset_free(&files);
}

void bench_ordering(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6, 4e6};
    const bench_system *systems[4];
    int count = bench_systems(run, wanted, 4, systems);
    sums all;
    memset(&all, 0, sizeof all);
    bench_report *report =
        bench_report_open(run, "ordering", "orderings against METIS_NodeND", "METIS_NodeND");
    for (int k = 0; k < count; k++) {
        one_matrix(run, report, systems[k], &systems[k]->A, "order", &all);
        if (!is_short(run, &systems[k]->A)) {
            one_shuffled(run, report, systems[k], &all);
        }
        time_order_to_factor(run, report, systems[k]);
    }
    if (!run->mesh_path) {
        const bench_system *volume = bench_volume(run->size == BENCH_QUICK ? 20 : 40);
        sums volume_sums; /* the printed means are over meshes only */
        memset(&volume_sums, 0, sizeof volume_sums);
        one_matrix(run, report, volume, &volume->A, "order", &volume_sums);
        data_meshes(run, report, &all);
    }
    print_means(report, &all);
    bench_report_close(report);
}
