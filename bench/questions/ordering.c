/* ordering.c: what does an ordering cost and what is it worth, beside METIS_NodeND: time, fill, flops, path weights? */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../tools/dataset.h"
#include "../tools/grid.h"
#include "bench.h"

#include <metis.h>

/* METIS's figures are means over some of its seeds, of which one alone scatters by several percent. Times are the
 * processor seconds that the library reports for the ordering, graph and all, the least of the repetitions; those of
 * METIS are for the same graph. The path weight of a row is the sum of the counts from its column to the root: what a
 * local solve at that row reads, without relaxation. In shuffled systems rows have random numbers. `Set-up` is ordering,
 * analysis and first factorization together. */
enum { SEEDS = 3, MAX_REPEATS = 5, BIG = 300000 };

typedef struct worth {
    double seconds, nnz, flops, path_mean, path_most;
} worth;

typedef struct way {
    const char *name;
    sl_ordering ordering;
    int has_points;
} way;

static const way ways[] = {{"FAST", SL_ORDERING_FAST, 0},
                           {"FAST, coordinates", SL_ORDERING_FAST, 1},
                           {"QUALITY", SL_ORDERING_QUALITY, 0}};

enum { WAYS = sizeof ways / sizeof *ways };

/* Sums over meshes, for the means at the end: small ones and those of 1e5 vertices. */
typedef struct sums {
    worth ratio[2][WAYS];
    int count[2][WAYS];
} sums;

static worth worth_of(const sl_csc *A, const sl_options *opt) {
    sl_symbolic *S;
    sl_stats stats;
    bench_must(sl_symbolic_create(&S, A, opt, &stats), "analysis");
    const sl_symbolic_view_t v = sl_symbolic_view(S);
    worth y = {stats.seconds_order, (double)stats.nnz_l, stats.flops, 0, 0};
    double *path = bench_alloc((size_t)v.n, sizeof *path);
    for (sl_int k = v.n; k-- > 0;) {
        path[k] = (double)v.counts[k] + (v.parent[k] == -1 ? 0 : path[v.parent[k]]);
        y.path_mean += path[k] / (double)v.n;
        y.path_most = path[k] > y.path_most ? path[k] : y.path_most;
    }
    free(path);
    sl_symbolic_free(S);
    return y;
}

/* Is only the least asked of a matrix? What takes METIS minutes in all is for BENCH=full. */
static int is_short(const bench_run *run, const sl_csc *A) {
    return run->size != BENCH_FULL && A->n_cols > BIG;
}

/* Means over seeds, the least time. */
static worth metis_worth(const bench_run *run, const sl_csc *A) {
    const int seeds = run->size == BENCH_QUICK || is_short(run, A) ? 1 : SEEDS;
    worth sum = {1e30, 0, 0, 0, 0};
    idx_t metis[METIS_NOPTIONS];
    sl_int wishes[METIS_NOPTIONS];
    for (int seed = 0; seed < seeds; seed++) {
        sl_options opt;
        memset(&opt, 0, sizeof opt);
        METIS_SetDefaultOptions(metis);
        metis[METIS_OPTION_SEED] = seed == 0 ? -1 : seed;
        for (int k = 0; k < METIS_NOPTIONS; k++) {
            wishes[k] = (sl_int)metis[k];
        }
        opt.ordering = SL_ORDERING_METIS;
        opt.metis_options = wishes;
        const worth y = worth_of(A, &opt);
        sum.seconds = y.seconds < sum.seconds ? y.seconds : sum.seconds;
        sum.nnz += y.nnz / seeds;
        sum.flops += y.flops / seeds;
        sum.path_mean += y.path_mean / seeds;
        sum.path_most += y.path_most / seeds;
    }
    return sum;
}

static void add_row(bench_report *report, const bench_system *system, const char *what,
                    const char *method, const worth *y, double baseline) {
    bench_row row = {.what = what,
                     .method = method,
                     .time = {1, y->seconds, y->seconds, y->seconds},
                     .baseline = baseline};
    bench_report_row(report, system, &row);
}

/* One matrix in every ordering. points: n x 3, or NULL. */
static void one_matrix(bench_run *run, bench_report *report, const bench_system *system,
                       const sl_csc *A, const double *points, const char *what, sums *all) {
    const worth metis = metis_worth(run, A);
    add_row(report, system, what, "METIS_NodeND", &metis, metis.seconds);
    for (int k = 0; k < WAYS; k++) {
        sl_options opt;
        memset(&opt, 0, sizeof opt);
        opt.ordering = ways[k].ordering;
        if (opt.ordering == SL_ORDERING_QUALITY && is_short(run, A)) {
            continue;
        }
        if (ways[k].has_points) {
            opt.coordinates = points;
            opt.dimensions = 3;
            if (!points) {
                continue;
            }
        }
        worth y = worth_of(A, &opt);
        const int repeats = ways[k].ordering == SL_ORDERING_QUALITY || run->size == BENCH_QUICK ? 1
                            : A->n_cols > BIG                                                   ? 2
                                              : MAX_REPEATS;
        for (int r = 1; r < repeats; r++) {
            const worth again = worth_of(A, &opt);
            bench_expect(run, again.nnz == y.nnz && again.path_mean == y.path_mean,
                         "%s: the same call gives another order", system->name);
            y.seconds = again.seconds < y.seconds ? again.seconds : y.seconds;
        }
        const worth ratio = {y.seconds / metis.seconds, y.nnz / metis.nnz, y.flops / metis.flops,
                             y.path_mean / metis.path_mean, y.path_most / metis.path_most};
        add_row(report, system, what, ways[k].name, &y, metis.seconds);
        bench_report_note(report,
                          "%-14s   of METIS: time %.3f, nnz(L) %.3f, flops %.3f, path weight mean "
                          "%.3f, largest %.3f",
                          "", ratio.seconds, ratio.nnz, ratio.flops, ratio.path_mean,
                          ratio.path_most);
        worth *sum = &all->ratio[A->n_cols >= 99000][k];
        sum->seconds += ratio.seconds;
        sum->nnz += ratio.nnz;
        sum->flops += ratio.flops;
        sum->path_mean += ratio.path_mean;
        sum->path_most += ratio.path_most;
        all->count[A->n_cols >= 99000][k]++;
    }
}

/* Order, analysis and first factorization, METIS's order against the default. */
typedef struct set_up {
    const bench_system *system;
    sl_options options;
} set_up;

static void call_set_up(void *state) {
    set_up *s = state;
    sl_symbolic *S;
    sl_factor *F;
    bench_must(sl_symbolic_create(&S, &s->system->A, &s->options, NULL), "analysis");
    bench_must(sl_factor_create(&F, S, &s->system->A, &s->options, NULL), "factor");
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void time_set_up(bench_run *run, bench_report *report, const bench_system *system) {
    set_up both[2];
    bench_sample samples[2];
    memset(both, 0, sizeof both);
    both[0].system = both[1].system = system;
    both[0].options.ordering = SL_ORDERING_METIS;
    bench_contender contenders[2] = {{call_set_up, &both[0], 1, NULL},
                                     {call_set_up, &both[1], 1, NULL}};
    bench_race(samples, contenders, 2, run->seconds);
    for (int k = 0; k < 2; k++) {
        bench_row row = {.what = "set-up",
                         .method = k ? "FAST" : "METIS_NodeND",
                         .time = samples[k],
                         .baseline = samples[0].median};
        bench_report_row(report, system, &row);
    }
}

static void one_shuffled(bench_run *run, bench_report *report, const bench_system *system,
                         sums *all) {
    const size_t n = (size_t)system->n;
    sl_int *perm = bench_alloc(n, sizeof *perm);
    uint64_t chance = 3;
    sl_matrix *M;
    for (size_t k = 0; k < n; k++) {
        perm[k] = (sl_int)k;
    }
    for (sl_int k = system->n - 1; k > 0; k--) {
        const sl_int other = bench_random_below(&chance, k + 1), keep = perm[k];
        perm[k] = perm[other];
        perm[other] = keep;
    }
    bench_must(sl_matrix_permute(&M, &system->A, perm, NULL), "permuting");
    const sl_csc A = sl_matrix_view(M);
    one_matrix(run, report, system, &A, NULL, "order, shuffled", all);
    sl_matrix_free(M);
    free(perm);
}

/* The points of a grid that systems.c made. */
static double *grid_points(sl_int n) {
    sl_int side = 1;
    mesh m;
    while (side * side < n) {
        side++;
    }
    if (side * side != n || !mesh_grid(&m, side, side, 0.2, 1)) {
        return NULL;
    }
    free(m.faces);
    return m.xyz;
}

static void print_means(bench_report *report, const sums *all) {
    static const char *const sizes[2] = {"below 1e5", "from 1e5 on"};
    for (int big = 0; big < 2; big++) {
        for (int k = 0; k < WAYS; k++) {
            const worth *sum = &all->ratio[big][k];
            const double count = all->count[big][k];
            if (count > 0) {
                bench_report_note(report,
                                  "mean over %d systems, n %s, %s: time %.3f, nnz(L) %.3f, flops "
                                  "%.3f, path weight mean %.3f, largest %.3f",
                                  (int)count, sizes[big], ways[k].name, sum->seconds / count,
                                  sum->nnz / count, sum->flops / count, sum->path_mean / count,
                                  sum->path_most / count);
            }
        }
    }
}

/* Meshes of the data folder from 5000 vertices on, in a full run. */
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
                one_matrix(run, report, system, &system->A, m.xyz, "order", all);
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
        bench_report_open(run, "ordering", "orderings beside METIS_NodeND", "METIS_NodeND");
    for (int k = 0; k < count; k++) {
        double *points = run->mesh_path ? NULL : grid_points(systems[k]->n);
        one_matrix(run, report, systems[k], &systems[k]->A, points, "order", &all);
        if (!is_short(run, &systems[k]->A)) {
            one_shuffled(run, report, systems[k], &all);
        }
        time_set_up(run, report, systems[k]);
        free(points);
    }
    if (!run->mesh_path) {
        const bench_system *volume = bench_volume(run->size == BENCH_QUICK ? 20 : 40);
        sums apart; /* the means are of meshes */
        memset(&apart, 0, sizeof apart);
        one_matrix(run, report, volume, &volume->A, NULL, "order", &apart);
        data_meshes(run, report, &all);
    }
    print_means(report, &all);
    bench_report_close(report);
}
