/* heat_distance.c: geodesic distances by the heat method, whole or within a radius, and cells of the nearest site */
#include "heat_distance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ball.h"
#include "heat_place.h"
#include "laplacian.h"

void heat_solver_free(heat_solver *s) {
    sl_factor_free(s->heat);
    sl_factor_free(s->poisson);
    sl_symbolic_free(s->S);
    sl_work_free(s->work);
    incidence_free(&s->around);
    memset(s, 0, sizeof *s);
}

static sl_status factor(sl_factor **out, sl_symbolic **S, const sl_matrix *A,
                        sl_definiteness definiteness) {
    const sl_csc view = sl_matrix_view(A);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.definiteness = definiteness;
    opt.consistency_tolerance = PATCH_SOLVER_CONSISTENCY;
    sl_status status = *S == NULL ? sl_symbolic_create(S, &view, NULL, NULL) : SL_OK;
    return status == SL_OK ? sl_factor_create(out, *S, &view, &opt, NULL) : status;
}

sl_status heat_solver_create(heat_solver *out, const mesh *m, double t) {
    sl_matrix *A = NULL, *L = NULL;
    memset(out, 0, sizeof *out);
    if (!(t > 0 && t <= 1e200)) {
        return SL_ERR_ARGUMENT;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        if (m->faces[k] < 0 || m->faces[k] >= m->n_vertices) {
            return SL_ERR_ARGUMENT;
        }
    }
    out->m = m;
    out->t = t;
    sl_status status = SL_ERR_MEMORY;
    if (incidence_create(&out->around, m) && laplacian_system(&A, m, t) &&
        laplacian_cotangent(&L, m)) {
        status = sl_work_create(&out->work, NULL);
    }
    if (status == SL_OK) {
        status = factor(&out->heat, &out->S, A, SL_DEFINITE);
    }
    if (status == SL_OK) {
        status = factor(&out->poisson, &out->S, L, SL_SEMIDEFINITE);
    }
    sl_matrix_free(A);
    sl_matrix_free(L);
    if (status != SL_OK) {
        heat_solver_free(out);
    }
    return status;
}

sl_status heat_solver_set_time(heat_solver *s, double t) {
    sl_matrix *A = NULL;
    if (!(t > 0 && t <= 1e200)) {
        return SL_ERR_ARGUMENT;
    }
    if (!laplacian_system(&A, s->m, t)) {
        return SL_ERR_MEMORY;
    }
    const sl_csc view = sl_matrix_view(A);
    sl_status status = sl_factor_refactor(s->heat, &view, NULL);
    sl_matrix_free(A);
    s->t = t;
    return status;
}

void heat_field_free(heat_field *f) {
    free(f->vertices);
    free(f->distance);
    free(f->heat);
    free(f->path);
    memset(f, 0, sizeof *f);
}

double heat_reach_width(const heat_reach *r) {
    return r->radius > 0 ? r->radius * (r->margin > 0 ? r->margin : HEAT_MARGIN) : INFINITY;
}

sl_status heat_distance(heat_field *out, heat_solver *s, const sl_int *sources, sl_int count,
                        const heat_reach *reach) {
    static const heat_reach everywhere = {0, 0, 0};
    const heat_reach *r = reach != NULL ? reach : &everywhere;
    heat_place place;
    memset(out, 0, sizeof *out);
    if (!(r->radius >= 0) || !(r->margin >= 0)) {
        return SL_ERR_ARGUMENT;
    }
    sl_status status = heat_place_create(&place, s, sources, count, heat_reach_width(r), false);
    if (status == SL_OK) {
        status = heat_place_distance(out, &place, sources, count, r->radius,
                                     r->solves > 0 ? r->solves : HEAT_SOLVES);
        heat_place_free(&place);
    }
    return status;
}

static void keep_most(sl_int *site, double *most, const sl_int *vertices, sl_int n, const double *u,
                      sl_int which) {
    for (sl_int k = 0; k < n; k++) {
        sl_int v = vertices != NULL ? vertices[k] : k;
        if (u[k] > most[v]) {
            most[v] = u[k];
            site[v] = which;
        }
    }
}

/* Up to 8 sites at once, x everywhere. */
static sl_status cells_everywhere(sl_int *site, double *most, heat_solver *s, const sl_int *sites,
                                  sl_int count, void (*tell)(double share)) {
    enum { BLOCK = 8 };
    size_t n = (size_t)s->m->n_vertices;
    double *U = (double *)malloc((BLOCK * n + 1) * sizeof *U), B[BLOCK * BLOCK];
    sl_status status = U != NULL ? SL_OK : SL_ERR_MEMORY;
    for (sl_int first = 0; first < count && status == SL_OK; first += BLOCK) {
        sl_int width = count - first < BLOCK ? count - first : BLOCK;
        for (sl_int k = 0; k < width * width; k++) {
            B[k] = k % width == k / width;
        }
        status = sl_local_solve(s->heat, U, n, NULL, 0, B, (size_t)width, sites + first, width,
                                width, s->work, NULL);
        for (sl_int k = 0; k < width && status == SL_OK; k++) {
            keep_most(site, most, NULL, (sl_int)n, U + n * (size_t)k, first + k);
        }
        if (tell != NULL) {
            tell((double)(first + width) / (double)count);
        }
    }
    free(U);
    return status;
}

static sl_status cell_within(sl_int *site, double *most, heat_solver *s, const sl_int *sites,
                             sl_int which, double radius, sl_off *touched) {
    ball b;
    const double one = 1;
    if (!ball_find(&b, &s->around, sites + which, 1, radius)) {
        return SL_ERR_MEMORY;
    }
    double *u = (double *)malloc(((size_t)b.n + 1) * sizeof *u);
    sl_status status = SL_ERR_MEMORY;
    if (u != NULL) {
        status = sl_local_solve(s->heat, u, (size_t)b.n, b.vertices, b.n, &one, 1, sites + which, 1,
                                1, s->work, NULL);
    }
    if (status == SL_OK) {
        keep_most(site, most, b.vertices, b.n, u, which);
        *touched += b.n;
    }
    free(u);
    ball_free(&b);
    return status;
}

sl_status heat_cells(sl_int *site, double *most, heat_solver *s, const sl_int *sites, sl_int count,
                     double radius, sl_off *touched, void (*tell)(double share)) {
    sl_off sum = 0;
    if (!(radius >= 0) || !incidence_are_distinct(&s->around, sites, count)) {
        return SL_ERR_ARGUMENT;
    }
    for (sl_int v = 0; v < s->m->n_vertices; v++) {
        site[v] = -1;
        most[v] = HEAT_COLD;
    }
    sl_status status = SL_OK;
    if (radius == 0) {
        status = cells_everywhere(site, most, s, sites, count, tell);
        sum = (sl_off)count * s->m->n_vertices;
    }
    for (sl_int k = 0; k < count && radius > 0 && status == SL_OK; k++) {
        status = cell_within(site, most, s, sites, k, radius, &sum);
        if (tell != NULL) {
            tell((double)(k + 1) / (double)count);
        }
    }
    if (touched != NULL) {
        *touched = sum;
    }
    return status;
}
