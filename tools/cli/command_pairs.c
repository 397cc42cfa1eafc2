/* command_pairs.c: heat exchanged by pairs of vertices, by three methods */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "tools/cli/heat_system.h"
#include "tools/draw/plot.h"

static const options_usage usage = {
    "pairs", "MESH", 1, 1, "Computes the heat exchanged by pairs of vertices, by three methods."};

static const options_manual manual = {
    "The heat that vertex i receives from vertex j is entry (i, j) of (M + t L)^-1. Each entry is "
    "computed by a local solve over one tree (both sweeps visit the paths of i and j), by a local "
    "solve over two trees (the forward sweep visits the path of j, the backward sweep that of i), "
    "and by sl_inverse_pairs, which takes all pairs in one call. MESH may also be a file of "
    "sparse-local save, whose name ends in .slf.",
    "Median microseconds per pair of each method, the speedup of two trees over one, and the "
    "largest relative difference of the values. --csv has columns "
    "from,to,heat,one_tree_s,two_trees_s. --svg is a histogram of the speedups.",
    "hills:200x200 --count 10000 --svg speedup.svg\nbunny.obj --from 17 --to 100-200 --csv "
    "heat.csv"};

enum { BINS = 40, ROUNDS = 3 };

static const double bin_width = 0.1;

typedef struct pair_times {
    double *one_tree, *two_trees; /* seconds of each pair, best of ROUNDS */
    double together;              /* seconds of all pairs in one call, best of ROUNDS */
} pair_times;

/* x_one, x_two: the heat at i, computed over one tree and over two trees. */
static void solve_pairs(double *x_one, double *x_two, pair_times *times, const sl_factor *F,
                        const sl_int *i, const sl_int *j, sl_int count) {
    sl_work *W = NULL;
    app_must(sl_work_create(&W, NULL), "workspace", NULL);
    for (sl_int k = 0; k < count; k++) {
        const double b[2] = {1, 0};
        const sl_int both[2] = {j[k], i[k]};
        sl_int n_both = i[k] == j[k] ? 1 : 2;
        double x[2];
        app_progress("pairs", (double)k / count);
        times->one_tree[k] = times->two_trees[k] = HUGE_VAL;
        for (int round = 0; round < ROUNDS; round++) {
            double begin = app_now();
            app_must(sl_local_solve(F, both, n_both, both, n_both, x, 2, b, 2, 1, W, NULL),
                     "one tree", NULL);
            double middle = app_now();
            app_must(sl_local_solve(F, &j[k], 1, &i[k], 1, &x_two[k], 1, b, 1, 1, W, NULL),
                     "two trees", NULL);
            double end = app_now();
            times->one_tree[k] = fmin(times->one_tree[k], middle - begin);
            times->two_trees[k] = fmin(times->two_trees[k], end - middle);
        }
        x_one[k] = x[n_both - 1];
    }
    app_progress_end();
    sl_work_free(W);
}

/* Computes all pairs in one call; returns seconds, best of ROUNDS. */
static double solve_together(double *entries, const sl_factor *F, const sl_int *i, const sl_int *j,
                             sl_int count) {
    double best = HUGE_VAL;
    sl_work *W = NULL;
    app_must(sl_work_create(&W, NULL), "workspace", NULL);
    for (int round = 0; round < ROUNDS; round++) {
        double begin = app_now();
        app_must(sl_inverse_pairs(F, entries, i, j, count, W, NULL), "entries", NULL);
        best = fmin(best, app_now() - begin);
    }
    sl_work_free(W);
    return best;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static double median(const double *values, sl_int count) {
    double *sorted = app_alloc((size_t)count, sizeof *sorted);
    memcpy(sorted, values, (size_t)count * sizeof *sorted);
    qsort(sorted, (size_t)count, sizeof *sorted, by_size);
    double middle = count > 0 ? sorted[count / 2] : 0;
    free(sorted);
    return middle;
}

static double mean(const double *values, sl_int count) {
    double sum = 0;
    for (sl_int k = 0; k < count; k++) {
        sum += values[k];
    }
    return count > 0 ? sum / count : 0;
}

static void draw_histogram(const char *path, const pair_times *times, sl_int count) {
    int bins[BINS] = {0}, first = BINS, last = -1;
    char message[512];
    plot *p = plot_create("Speedup of two trees over one tree, by pairs of vertices",
                          "time over one tree / time over two trees", "pairs", false, false);
    for (sl_int k = 0; k < count; k++) {
        int bin = (int)fmin(BINS - 1, times->one_tree[k] / times->two_trees[k] / bin_width);
        bins[bin]++;
        first = bin < first ? bin : first;
        last = bin > last ? bin : last;
    }
    for (int k = first; p != NULL && k <= last; k++) {
        if (!plot_add(p, "pairs", PLOT_BARS, (k + 0.5) * bin_width, bins[k])) {
            plot_free(p);
            p = NULL;
        }
    }
    if (p == NULL) {
        app_die("out of memory");
    }
    if (!plot_write(p, path, message, sizeof message)) {
        app_die("%s", message);
    }
    plot_free(p);
}

/* Pairs from two lists of equal length, or of one vertex with a list; without lists random pairs of
 * distinct vertices. */
static void choose_pairs(sl_int **i, sl_int **j, sl_int *count, const char *to, const char *from,
                         sl_int wanted, uint64_t seed, sl_int n) {
    sl_int n_to = 0, n_from = 0;
    if ((to == NULL) != (from == NULL)) {
        app_die_usage("--from and --to: give both or neither");
    }
    if (to == NULL) {
        *count = wanted;
        *i = app_alloc((size_t)wanted, sizeof **i);
        *j = app_alloc((size_t)wanted, sizeof **j);
        for (sl_int k = 0; k < wanted; k++) {
            (*i)[k] = app_random_below(&seed, n);
            do {
                (*j)[k] = app_random_below(&seed, n);
            } while (n > 1 && (*j)[k] == (*i)[k]);
        }
        return;
    }
    sl_int *first = app_vertices("from", from, n, seed, &n_from);
    sl_int *second = app_vertices("to", to, n, seed + 1, &n_to);
    if (n_from != n_to && n_from != 1 && n_to != 1) {
        app_die_usage("--from has %d vertices, --to has %d: expected equal numbers, or one of 1",
                      (int)n_from, (int)n_to);
    }
    *count = n_from > n_to ? n_from : n_to;
    *i = app_alloc((size_t)*count, sizeof **i);
    *j = app_alloc((size_t)*count, sizeof **j);
    for (sl_int k = 0; k < *count; k++) {
        (*i)[k] = second[n_to == 1 ? 0 : k];
        (*j)[k] = first[n_from == 1 ? 0 : k];
    }
    free(second);
    free(first);
}

/* Prints the measurements; returns the largest relative difference between the methods. */
static double report(const pair_times *times, const double *one, const double *two,
                     const double *entries, sl_int count) {
    double *gain = app_alloc((size_t)count, sizeof *gain), worst = 0;
    sl_int slower = 0;
    for (sl_int k = 0; k < count; k++) {
        gain[k] = times->one_tree[k] / times->two_trees[k];
        slower += gain[k] < 1;
        double size = fmax(fabs(two[k]), 1e-300);
        worst = fmax(worst, fmax(fabs(one[k] - two[k]), fabs(entries[k] - two[k])) / size);
    }
    app_detail("microseconds per pair, means: one tree %.2f, two trees %.2f, all in one call %.2f; "
               "medians: one tree %.2f, two trees %.2f\n",
               1e6 * mean(times->one_tree, count), 1e6 * mean(times->two_trees, count),
               count > 0 ? 1e6 * times->together / count : 0, 1e6 * median(times->one_tree, count),
               1e6 * median(times->two_trees, count));
    printf("Two trees are %.2f times as fast as one in the median, and slower for %.2f %% of the "
           "pairs.\n",
           median(gain, count), count > 0 ? 100.0 * slower / count : 0);
    app_detail("the methods differ by at most %.2g, relative to the value\n", worst);
    free(gain);
    return worst;
}

static void write_csv(const char *path, const sl_int *i, const sl_int *j, const double *heat,
                      const pair_times *times, sl_int count) {
    FILE *csv = app_create(path);
    fprintf(csv, "from,to,heat,one_tree_s,two_trees_s\n");
    for (sl_int k = 0; k < count; k++) {
        fprintf(csv, "%d,%d,%.17g,%.4g,%.4g\n", (int)j[k], (int)i[k], heat[k], times->one_tree[k],
                times->two_trees[k]);
    }
    app_close(csv);
}

int command_pairs(int argc, char **argv) {
    const char *operand = NULL, *to = NULL, *from = NULL, *csv = NULL, *histogram = NULL;
    sl_int count = 10000, seed = 1;
    heat_time time = {0, 0, 0, NULL};
    app_output none; /* of meshes and pictures */
    memset(&none, 0, sizeof none);
    const option options[] = {
        {OPTION_COUNT, "count", &count, "K", "number of random pairs (10000)"},
        {OPTION_COUNT, "seed", &seed, "S", "seed of the random pairs (1)"},
        {OPTION_TEXT, "from", &from, "VERTICES", "source vertices, in place of random pairs"},
        {OPTION_TEXT, "to", &to, "VERTICES",
         "target vertices: as many as sources, or one of the two lists has one vertex"},
        HEAT_TIME_OPTIONS(&time, "otherwise S = 1"),
        {OPTION_OUTPUT, "csv", &csv, "FILE", "write the heat and the times of each pair"},
        {OPTION_OUTPUT, "svg", &histogram, "FILE", "draw a histogram of the speedups"},
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    if (count > 100000000) {
        app_die_usage("--count: expected at most 100000000");
    }
    mesh m;
    heat_system h;
    sl_int *i = NULL, *j = NULL;
    heat_system_open(&h, &m, operand, &time, 0, &none);
    choose_pairs(&i, &j, &count, to, from, count, (uint64_t)seed, m.n_vertices);
    size_t size = (size_t)count;
    double *values = app_alloc(3 * size, sizeof *values); /* of the three methods */
    double *one = values, *two = values + size, *entries = values + 2 * size;
    pair_times times = {app_alloc(size, sizeof(double)), app_alloc(size, sizeof(double)), 0};
    solve_pairs(one, two, &times, h.F, i, j, count);
    times.together = solve_together(entries, h.F, i, j, count);
    printf("The heat between %d pairs of %d vertices, %s, is computed by three methods.\n",
           (int)count, (int)m.n_vertices, heat_system_time(&h));
    double worst = report(&times, one, two, entries, count);
    if (csv != NULL) {
        write_csv(csv, i, j, two, &times, count);
    }
    if (histogram != NULL) {
        draw_histogram(histogram, &times, count);
    }
    free(times.two_trees);
    free(times.one_tree);
    free(values);
    free(j);
    free(i);
    heat_system_free(&h);
    mesh_free(&m);
    return worst > 1e-8;
}
