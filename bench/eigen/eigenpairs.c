/* eigenpairs.c: how many digits of auto-diffusion do eigenpairs give, and at what time? */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "arpack_pairs.h"
#include "bench/lib/bench.h"
#include "bench/lib/shifted_systems.h"

/* With L x = lambda M x and x' M x = 1, the diagonal of (M + t L)^-1 is the sum of
 * x_i^2 / (1 + t lambda) over all n pairs. Usually those of the 300 smallest eigenvalues are taken,
 * as in [HDA17] section 5, which reports 39 s. The others count only as 1 / lambda, so that digits
 * come slowly. Heat kernel signatures are that diagonal at several times, here the range of
 * sparse-local hks: 4 ln 10 / lambda_300 to 4 ln 10 / lambda_2, by Weyl's law. The kernel with
 * exp(-t lambda) in place of 1 / (1 + t lambda) is another quantity, for which few pairs are enough
 * and which no diagonal of an inverse gives.
 *
 * ARPACK iterates with one of our factors. Its time includes that factorization and the sums; the
 * analysis is shared. Its tolerance is 1e-8, far below what is left out. The exact diagonals need a
 * refactorization for each time. All is done by one thread, and times are processor times of single
 * runs (the exact ones: medians). */
enum { TIMES = 8, COUNTS = 5, REPEATED = 5 };

static const sl_int counts[COUNTS] = {10, 30, 100, 300, 1000};

typedef struct surface {
    const bench_system *system;
    shifted_systems split; /* M and t L */
    sl_factor *F;
    sl_work *W;
    double shift;    /* of the factor that ARPACK uses, in units of the system's t */
    double c[TIMES]; /* the times of the signatures, in the same unit */
    double *adf;     /* n: exact */
    double *hks;     /* n x TIMES: exact */
    double *sum;     /* n: from eigenpairs */
    double *error;   /* n */
} surface;

static double processor_time(void) {
    return (double)clock() / CLOCKS_PER_SEC;
}

static surface surface_create(const bench_system *system) {
    const double pi = 3.14159265358979323846;
    const size_t n = (size_t)system->n;
    surface s;
    memset(&s, 0, sizeof s);
    s.system = system;
    shifted_systems_make(&s.split, system);
    bench_must(sl_factor_create(&s.F, system->S, &system->A, NULL, NULL), "factor");
    bench_must(sl_work_create(&s.W, NULL), "workspace");
    s.adf = bench_alloc(n, sizeof *s.adf);
    s.hks = bench_alloc(n * TIMES, sizeof *s.hks);
    s.sum = bench_alloc(n, sizeof *s.sum);
    s.error = bench_alloc(n, sizeof *s.error);
    double area = 0;
    for (size_t i = 0; i < n; i++) {
        area += s.split.M.x[i];
    }
    s.shift = area / (4 * pi) / system->t; /* about 1 / lambda_1 */
    for (int k = 0; k < TIMES; k++) {
        s.c[k] = 4 * log(10) * s.shift / 300 * pow(150, (double)k / (TIMES - 1));
    }
    return s;
}

static void surface_free(surface *s) {
    free(s->error);
    free(s->sum);
    free(s->hks);
    free(s->adf);
    sl_work_free(s->W);
    sl_factor_free(s->F);
    shifted_systems_free(&s->split);
}

static void refactor(surface *s, double c) {
    const double coefficients[SHIFTED_TERMS] = {1, c};
    bench_must(sl_factor_refactor_sums(&s->F, 1, coefficients, shifted_systems_values(&s->split),
                                       SHIFTED_TERMS, NULL, NULL, NULL),
               "refactor");
}

static void exact(double *out, surface *s, double c) {
    refactor(s, c);
    bench_must(sl_inverse_diagonal(s->F, out, NULL, SL_ALL, s->W, NULL), "diagonal");
}

static void exact_adf(surface *s) {
    exact(s->adf, s, 1);
}

static void exact_hks(surface *s) {
    for (int k = 0; k < TIMES; k++) {
        exact(s->hks + (size_t)k * (size_t)s->system->n, s, s->c[k]);
    }
}

static bench_sample repeat(surface *s, void (*call)(surface *s)) {
    double times[REPEATED];
    call(s); /* warm-up */
    for (int k = 0; k < REPEATED; k++) {
        times[k] = -processor_time();
        call(s);
        times[k] += processor_time();
    }
    return bench_sample_of(times, REPEATED);
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Relative errors of a sum of pairs. Most of what is missing is the same at all vertices, so that
 * differences between them are better known: `beside` is the median error after the mean of what is
 * missing, which only the exact result gives, has been added. */
typedef struct sum_errors {
    double median, largest, beside;
} sum_errors;

static sum_errors errors_of(surface *s, const eigen_pairs *pairs, double c, const double *wanted) {
    const sl_int n = s->system->n;
    sum_errors e = {0, 0, 0};
    double missing = 0;
    eigen_pairs_diagonal(s->sum, pairs, pairs->count, c);
    for (sl_int i = 0; i < n; i++) {
        missing += (wanted[i] - s->sum[i]) / n;
    }
    for (int beside = 1; beside >= 0; beside--) {
        for (sl_int i = 0; i < n; i++) {
            s->error[i] = fabs(s->sum[i] + beside * missing - wanted[i]) / wanted[i];
        }
        qsort(s->error, (size_t)n, sizeof *s->error, by_value);
        e.median = s->error[n / 2];
        e.largest = s->error[n - 1];
        e.beside = beside ? e.median : e.beside;
    }
    return e;
}

/* The pairs with their time, which has the factorization in it; checked. */
static int find_pairs(eigen_pairs *pairs, double *seconds, bench_run *run, surface *s, sl_int count,
                      double tolerance) {
    const eigen_problem problem = {s->split.L, s->split.M.x, s->F, s->shift, tolerance};
    const double limit = fmax(1e-9, 10 * tolerance);
    double residual, orthogonality;
    *seconds = -processor_time();
    refactor(s, s->shift);
    *pairs = eigen_pairs_create(&problem, count);
    *seconds += processor_time();
    eigen_pairs_errors(&residual, &orthogonality, &problem, pairs);
    int passed = bench_expect(run, residual <= limit && orthogonality <= 1e-9,
                              "%s, %d eigenpairs: residual %g, deviation from orthogonality %g",
                              s->system->name, (int)count, residual, orthogonality);
    for (sl_int k = 1; k < count; k++) {
        passed &= bench_expect(run, pairs->values[k - 1] <= pairs->values[k],
                               "%s: eigenvalue %d is above the next one", s->system->name, (int)k);
    }
    return passed;
}

/* On a small mesh: with all pairs the sum is the diagonal. ARPACK finds n - 1 of them; the last one
 * follows from the inverse of M, which is the sum of all x x', and from the trace. */
static int check_small(bench_run *run) {
    surface s = surface_create(bench_torus(200));
    const sl_int n = s.system->n;
    const sl_csc L = s.split.L;
    eigen_pairs pairs;
    double seconds, last = 0, largest = 0;
    int passed = find_pairs(&pairs, &seconds, run, &s, n - 1, 0);
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = L.p[j]; p < L.p[j + 1]; p++) {
            last += L.i[p] == j ? L.x[p] / s.split.M.x[j] : 0;
        }
    }
    for (sl_int k = 0; k < n - 1; k++) {
        last -= pairs.values[k];
    }
    exact_adf(&s);
    eigen_pairs_diagonal(s.sum, &pairs, n - 1, 1);
    eigen_pairs_diagonal(s.error, &pairs, n - 1, 0);
    for (sl_int i = 0; i < n; i++) {
        const double sum = s.sum[i] + (1 / s.split.M.x[i] - s.error[i]) / (1 + last);
        largest = fmax(largest, fabs(sum - s.adf[i]) / s.adf[i]);
    }
    passed &= bench_expect(run, largest <= 1e-9 && last >= pairs.values[n - 2],
                           "%s: the sum over all eigenpairs differs by %g from the diagonal",
                           s.system->name, largest);
    eigen_pairs_free(&pairs);
    surface_free(&s);
    return passed;
}

/* Where the results go. */
typedef struct outputs {
    bench_report *report;
    bench_plot *plot;
    FILE *errors; /* CSV */
} outputs;

static void one_count(bench_run *run, const outputs *o, surface *s, sl_int count,
                      const double baseline[2]) {
    const size_t n = (size_t)s->system->n;
    char what[40];
    eigen_pairs pairs;
    double seconds, sums[2];
    bench_progress("[%s: %d eigenpairs]\n", s->system->name, (int)count);
    if (find_pairs(&pairs, &seconds, run, s, count, 1e-8)) {
        sums[0] = processor_time();
        eigen_pairs_diagonal(s->sum, &pairs, count, 1);
        sums[0] = processor_time() - sums[0];
        sums[1] = TIMES * sums[0];
        for (int q = 0; q < 2; q++) {
            double time = seconds + sums[q];
            snprintf(what, sizeof what, "%d eigenpairs", (int)count);
            bench_row row = {.what = q == 0 ? "auto-diffusion" : "signature x 8",
                             .method = what,
                             .is_peer = 1,
                             .time = bench_sample_of(&time, 1),
                             .baseline = baseline[q]};
            bench_report_row(o->report, s->system, &row);
        }
        static const char *const names[3] = {"auto-diffusion", "signature, shortest time",
                                             "signature, longest time"};
        const sum_errors e[3] = {errors_of(s, &pairs, 1, s->adf),
                                 errors_of(s, &pairs, s->c[0], s->hks),
                                 errors_of(s, &pairs, s->c[TIMES - 1], s->hks + (TIMES - 1) * n)};
        fprintf(o->errors, "%d,%.9g,%d", (int)count, seconds + sums[0], (int)pairs.solves);
        for (int q = 0; q < 3; q++) {
            bench_report_note(o->report,
                              "%-14s   %s: relative error %.2g (median), %.2g (largest); %.2g "
                              "beside a constant",
                              "", names[q], e[q].median, e[q].largest, e[q].beside);
            fprintf(o->errors, ",%.9g,%.9g,%.9g", e[q].median, e[q].largest, e[q].beside);
            bench_plot_point(o->plot, names[q], "linespoints", count, e[q].median);
        }
        fprintf(o->errors, "\n");
        bench_report_note(o->report,
                          "%-14s   %d solves; the last term of a sum of exp(-t lambda) is %.2g at "
                          "the shortest time",
                          "", (int)pairs.solves, exp(-s->c[0] * pairs.values[count - 1]));
    }
    eigen_pairs_free(&pairs);
}

static void one_system(bench_run *run, const outputs *o, const bench_system *system) {
    surface s = surface_create(system);
    const sl_int most = run->size == BENCH_QUICK ? 30 : run->size == BENCH_FULL ? 1000 : 300;
    const bench_sample times[2] = {repeat(&s, exact_adf), repeat(&s, exact_hks)};
    const double baseline[2] = {times[0].median, times[1].median};
    for (int q = 0; q < 2; q++) {
        bench_row row = {.what = q == 0 ? "auto-diffusion" : "signature x 8",
                         .method = "refactor + diagonal",
                         .time = times[q],
                         .baseline = baseline[q]};
        bench_report_row(o->report, system, &row);
    }
    for (int k = 0; k < COUNTS && counts[k] <= most && counts[k] < system->n / 4; k++) {
        one_count(run, o, &s, counts[k], baseline);
    }
    surface_free(&s);
}

void bench_eigenpairs(bench_run *run) {
    if (!check_small(run)) {
        return;
    }
    outputs o;
    char path[512];
    snprintf(path, sizeof path, "%s/eigenpairs_errors.csv", run->out_dir);
    o.errors = bench_create(path);
    fprintf(o.errors,
            "pairs,seconds,solves,adf_median,adf_largest,adf_beside,short_median,short_largest,"
            "short_beside,long_median,long_largest,long_beside\n");
    o.report = bench_report_open(
        run, "eigenpairs",
        "auto-diffusion and heat kernel signatures of every vertex by eigenpairs (ARPACK)",
        "refactor + diagonal");
    o.plot = bench_plot_open(run, "eigenpairs", "Auto-diffusion by eigenpairs", "eigenpairs",
                             "median relative error", "xy");
    one_system(run, &o,
               run->mesh_path ? bench_mesh(run->mesh_path)
                              : bench_torus(run->size == BENCH_QUICK ? 5e3 : 53e3));
    bench_plot_close(o.plot);
    bench_report_close(o.report);
    bench_close(o.errors);
}
