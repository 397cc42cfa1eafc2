/* command_adf.c: the auto-diffusion function, the diagonal of (M + t L)^-1 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "tools/cli/heat_system.h"

static const options_usage usage = {
    "adf", "MESH", 1, 1,
    "Computes the auto-diffusion function: the density of the heat left at its source vertex."};

static const options_manual manual = {
    "One unit of heat at a vertex i diffuses for a time t; the value is its density at i, heat per "
    "unit of area: entry (i, i) of A^-1, A = M + t L, with the lumped mass M and the cotangent "
    "Laplacian L, one implicit Euler step. hks has the same values at several times. Times M_ii, "
    "it is the share of the heat that remains at i. No eigenvectors are needed. For all vertices "
    "the whole diagonal is "
    "computed at once; for a list, each vertex costs its path in the elimination tree. A few full "
    "solves verify the values and provide the comparison. MESH may also be a file of sparse-local "
    "save, whose name ends in .slf.",
    "The time t, seconds of each phase, and the time of one full solve per vertex with the largest "
    "relative difference of the verified values. Up to 20 values are printed unless --csv is "
    "given; "
    "--csv has columns vertex,adf. The picture shows the logarithm of the values.",
    "star:6 --area-time 0.3 --png adf.png --csv adf.csv\nbunny.obj --at 17,100-200\nbunny.slf --at "
    "17"};

enum { SAMPLE = 5 };

/* Seconds of one full solve, the fastest of SAMPLE vertices, or of all; worst: largest relative
 * difference between the values and those of the full solves. */
static double compare_full(const double *values, const heat_system *h, const sl_int *vertices,
                           sl_int count, double *worst) {
    size_t n = (size_t)h->n;
    double *b = app_alloc(n, sizeof *b), *x = app_alloc(n, sizeof *x);
    double seconds = HUGE_VAL;
    sl_work *W = NULL;
    app_must(sl_work_create(&W, NULL), "workspace", NULL);
    *worst = 0;
    for (sl_int k = 0; k < SAMPLE && k < count; k++) {
        sl_int at = (sl_int)((int64_t)k * (count - 1) / (SAMPLE - 1)), v = vertices[at];
        b[v] = 1;
        double begin = app_now();
        app_must(sl_factor_solve(h->F, x, n, b, n, 1, W), "full solve", NULL);
        double end = app_now();
        seconds = end - begin < seconds ? end - begin : seconds;
        *worst = fmax(*worst, fabs(values[at] - x[v]) / fabs(x[v]));
        b[v] = 0;
    }
    sl_work_free(W);
    free(x);
    free(b);
    return count > 0 ? seconds : 0;
}

static void write_results(const app_output *output, const mesh *m, double t, const double *values,
                          const sl_int *vertices, sl_int count) {
    size_t n = (size_t)m->n_vertices;
    double *field = app_alloc(n, sizeof *field), *shown = app_alloc(n, sizeof *shown);
    FILE *csv = output->csv != NULL ? app_create(output->csv) : NULL;
    if (csv != NULL) {
        fprintf(csv, "vertex,adf\n");
    }
    for (size_t v = 0; v < n; v++) {
        field[v] = shown[v] = NAN;
    }
    for (sl_int k = 0; k < count; k++) {
        field[vertices[k]] = values[k];
        shown[vertices[k]] = values[k] > 0 ? log(values[k]) : NAN;
        if (csv != NULL) {
            fprintf(csv, "%d,%.17g\n", (int)vertices[k], values[k]);
        } else if (count <= 20) {
            printf("%d %.17g\n", (int)vertices[k], values[k]);
        }
    }
    if (csv != NULL) {
        app_close(csv);
    }
    const mesh_field fields[] = {{"adf", field}};
    const mesh_extra extra = {.fields = fields, .n_fields = 1};
    char title[80];
    (void)snprintf(title, sizeof title, "ln of adf,\nper area\nt = %.3g", t);
    render_style style = {.scalar = shown, .legend = title};
    app_range(&style.low, &style.high, m, shown);
    app_write(output, m, &extra, &style);
    free(shown);
    free(field);
}

int command_adf(int argc, char **argv) {
    const char *operand = NULL, *at = "all";
    heat_time time = {0, 0, 0, NULL};
    app_output output;
    memset(&output, 0, sizeof output);
    const option options[] = {
        {OPTION_TEXT, "at", &at, "VERTICES", "vertices: 3,17,100-200 or random:5 or all (all)"},
        HEAT_TIME_OPTIONS(&time, "otherwise A = 0.05"),
        APP_OUTPUT_OPTIONS(&output),
        APP_WELD_OPTION,
        {OPTION_END, NULL, NULL, NULL, NULL}};
    options_read(&usage, &manual, options, argc, argv, &operand);
    app_check_output(&output, output.out);
    mesh m;
    heat_system h;
    sl_int count = 0;
    heat_system_open(&h, &m, operand, &time, 0.05, &output);
    app_set_up(&output, &m, output.png != NULL);
    sl_int *vertices = app_vertices("at", at, m.n_vertices, 1, &count);
    double *values = app_alloc((size_t)count, sizeof *values);
    app_stage("auto-diffusion");
    bool all = strcmp(at, "all") == 0;
    double begin = app_now(), worst = 0;
    heat_system_diagonal(&h, values, all ? NULL : vertices, count);
    double seconds = app_now() - begin;
    app_progress_end();
    double full = compare_full(values, &h, vertices, count, &worst);
    printf("The auto-diffusion of %d of %d vertices, %s, is computed.\n", (int)count,
           (int)m.n_vertices, heat_system_time(&h));
    app_detail("seconds: order and analyze %.4g, factor %.4g, auto-diffusion %.4g\n",
               h.stats.symbolic.seconds_order + h.stats.symbolic.seconds_analyze,
               h.stats.factor.seconds, seconds);
    const int solves = count < SAMPLE ? (int)count : (int)SAMPLE;
    app_detail(
        "a full solve for each vertex would take %.4g s, %.0f times as long: estimated from %d "
        "solves, whose values differ by at most %.2g\n",
        full * count, seconds > 0 ? full * count / seconds : 0, solves, worst);
    write_results(&output, &m, h.t, values, vertices, count);
    free(values);
    free(vertices);
    heat_system_free(&h);
    mesh_free(&m);
    return worst > 1e-8;
}
