/* heat_system.c: the factored diffusion operator M + t L of a mesh, and the options for its time */
#include "heat_system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "saved_file.h"
#include "tools/geometry/laplacian.h"

void heat_check_time(double t) {
    if (!(t > 0 && t <= 1e200)) {
        app_die("the time %g is not between 0 and 1e200", t);
    }
}

/* The diagonal matrix M; the caller frees *identity, which it borrows. */
static sl_csc mass_matrix(const heat_system *h, sl_int **identity) {
    *identity = app_alloc((size_t)h->n + 1, sizeof **identity);
    for (sl_int j = 0; j <= h->n; j++) {
        (*identity)[j] = j;
    }
    const sl_csc M = {h->n, h->n, *identity, *identity, h->mass};
    return M;
}

void heat_system_warn(const heat_system *h, const sl_factor *F, double t) {
    if (h->laplacian == NULL) {
        accuracy_warn(NULL, F, NULL);
        return;
    }
    sl_int *identity;
    sl_matrix *sum = NULL;
    const double one_and_t[2] = {1, t};
    const sl_csc terms[2] = {mass_matrix(h, &identity), sl_matrix_view(h->laplacian)};
    app_must(sl_matrix_sum(&sum, one_and_t, terms, 2, NULL, NULL), "M + t L", NULL);
    const sl_csc A = sl_matrix_view(sum);
    accuracy_warn(&h->faces, F, &A);
    sl_matrix_free(sum);
    free(identity);
}

void heat_system_analyze(heat_system *h, const mesh *m, const char *name, const sl_options *opt) {
    sl_int *identity;
    intrinsic a;
    memset(h, 0, sizeof *h);
    h->n = m->n_vertices;
    h->stats.error.row = -1;
    double begin = app_now();
    app_stage("assembling");
    h->mass = app_alloc((size_t)h->n, sizeof *h->mass);
    const mesh *surface = laplacian_choose(&a, m, name) ? &a.m : m;
    double share = surface == m ? 1 : a.share;
    if (!laplacian_cotangent_of(&h->laplacian, surface, a.lengths, share)) {
        app_die("out of memory for the Laplacian of %d vertices", (int)h->n);
    }
    laplacian_mass_of(h->mass, surface, a.lengths, share);
    h->faces = accuracy_of_faces(surface, a.lengths);
    intrinsic_free(&a);
    app_stage("analyzing");
    h->seconds_assemble = app_now() - begin;
    const sl_csc L = sl_matrix_view(h->laplacian), M = mass_matrix(h, &identity);
    app_must(sl_symbolic_create(&h->S, &L, opt, &h->stats), "analysis", &h->stats);
    begin = app_now();
    for (int k = 0; k < 2; k++) {
        h->terms[k] = app_alloc((size_t)h->stats.symbolic.nnz_a, sizeof *h->terms[k]);
    }
    app_must(sl_symbolic_scatter(h->S, h->terms[0], &M, NULL), "masses", NULL);
    app_must(sl_symbolic_scatter(h->S, h->terms[1], &L, NULL), "Laplacian", NULL);
    h->seconds_assemble += app_now() - begin;
    free(identity);
    app_progress_end();
}

void heat_system_create(heat_system *h, const mesh *m, double t, const char *laplacian,
                        const sl_options *opt) {
    heat_check_time(t);
    heat_system_analyze(h, m, laplacian, opt);
    const double one_and_t[2] = {1, t};
    const double *const terms[2] = {h->terms[0], h->terms[1]};
    app_stage_factor(h->stats.symbolic.flops);
    app_must(sl_factor_create_sums(&h->F, 1, h->S, one_and_t, terms, 2, opt, NULL, &h->stats),
             "factorization", &h->stats);
    h->t = t;
    app_progress_end();
    heat_system_warn(h, h->F, t);
}

/* Opens a saved factor. Its regions are not used. */
static void open_saved(heat_system *h, mesh *m, const char *path) {
    memset(h, 0, sizeof *h);
    memset(m, 0, sizeof *m);
    sl_saved_set set;
    saved_file_open(&set, path, SL_LOAD_CHECKED);
    h->S = set.symbolic;
    h->F = set.factor;
    h->selected = set.selected;
    set.symbolic = NULL;
    set.factor = NULL;
    set.selected = NULL;
    sl_saved_set_free(&set);
    h->stats.symbolic = sl_symbolic_view(h->S).info;
    h->stats.factor = sl_factor_view(h->F).info;
    h->stats.error.row = -1;
    h->n = m->n_vertices = h->stats.symbolic.n;
    h->t = NAN;
}

void heat_system_open(heat_system *h, mesh *m, const char *operand, const heat_time *time,
                      double default_area, const app_output *output) {
    if (!app_is_saved(operand)) {
        app_mesh(m, operand, true);
        heat_system_create(h, m, heat_time_value(time, m, default_area), time->laplacian, NULL);
        return;
    }
    if (time->time != 0 || time->scaled != 0 || time->area != 0) {
        app_die_usage("%s: has its own time", operand);
    }
    if (time->laplacian != NULL) {
        app_die_usage("%s: has its own Laplacian", operand);
    }
    app_refuse_weld(operand);
    if (output->out != NULL || output->png != NULL) {
        app_die_usage("%s: a saved factor has no mesh for --out and --png", operand);
    }
    open_saved(h, m, operand);
    heat_system_warn(h, h->F, h->t);
}

const char *heat_system_time(const heat_system *h) {
    static char text[40];
    (void)snprintf(text, sizeof text, "t = %.6g", h->t);
    return isnan(h->t) ? "t as it was saved" : text;
}

void heat_system_diagonal(const heat_system *h, double *values, const sl_int *vertices,
                          sl_int count) {
    sl_status status = SL_ERR_OTHER_PATTERN;
    if (h->selected != NULL) {
        status = sl_selected_entries(h->selected, values, vertices, NULL, count, NULL);
    }
    if (status == SL_ERR_OTHER_PATTERN) { /* there is none, or it does not have all of them */
        status = sl_inverse_diagonal(h->F, values, vertices, count, NULL, NULL);
    }
    app_must(status, "auto-diffusion", NULL);
}

void heat_system_factors(heat_system *h, sl_factor **factors, const double *t, sl_int count,
                         const sl_threads *threads) {
    const double *const terms[2] = {h->terms[0], h->terms[1]};
    double *coefficients = app_alloc(2 * (size_t)count, sizeof *coefficients);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.threads = *threads;
    for (sl_int k = 0; k < count; k++) {
        heat_check_time(t[k]);
        coefficients[2 * k] = 1;
        coefficients[2 * k + 1] = t[k];
    }
    bool again = count > 0 && factors[0] != NULL;
    app_must(again ? sl_factor_refactor_sums(factors, count, coefficients, terms, 2, &opt, NULL,
                                             &h->stats)
                   : sl_factor_create_sums(factors, count, h->S, coefficients, terms, 2, &opt, NULL,
                                           &h->stats),
             "factorization", &h->stats);
    free(coefficients);
}

void heat_system_free(heat_system *h) {
    sl_selected_free(h->selected);
    sl_factor_free(h->F);
    sl_symbolic_free(h->S);
    sl_matrix_free(h->laplacian);
    free(h->mass);
    free(h->terms[0]);
    free(h->terms[1]);
    memset(h, 0, sizeof *h);
}

double heat_area(const mesh *m) {
    double area = 0;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const double *a = m->xyz + 3 * (size_t)m->faces[3 * f],
                     *b = m->xyz + 3 * (size_t)m->faces[3 * f + 1],
                     *c = m->xyz + 3 * (size_t)m->faces[3 * f + 2];
        double n[3];
        for (int d = 0; d < 3; d++) {
            int e = (d + 1) % 3, g = (d + 2) % 3;
            n[d] = (b[e] - a[e]) * (c[g] - a[g]) - (b[g] - a[g]) * (c[e] - a[e]);
        }
        area += 0.5 * hypot(hypot(n[0], n[1]), n[2]);
    }
    return area;
}

double heat_time_value(const heat_time *h, const mesh *m, double default_area) {
    int given = (h->time != 0) + (h->scaled != 0) + (h->area != 0);
    laplacian_check(h->laplacian);
    if (given > 1) {
        app_die_usage("--time, --scaled-time, --area-time: give only one of them");
    }
    double edge = app_mean_edge_length(m);
    double t = h->time > 0                            ? h->time
               : h->scaled > 0                        ? h->scaled * edge * edge
               : h->area > 0                          ? h->area * heat_area(m)
               : default_area > 0 && heat_area(m) > 0 ? default_area * heat_area(m)
                                                      : edge * edge;
    if (!(t > 0) || !isfinite(t)) {
        app_die("no default time: the mean edge length is %g and the area %g; give --time", edge,
                heat_area(m));
    }
    heat_check_time(t);
    return t;
}
