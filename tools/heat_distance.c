/* heat_distance.c: geodesic distances by the heat method, whole or within a radius, and cells of the nearest site */
#include "heat_distance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ball.h"
#include "flat_face.h"
#include "laplacian.h"
#include "part.h"
#include "patch_solver.h"

#define COLD 1e-290 /* below this, differences of heat are rounding */

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

/* B = div X: at vertex i of a face with X, weights w and corners x_j, x_k: w_k (x_i - x_j) X + w_j (x_i - x_k) X.
 * Returns the faces without X. */
static sl_int divergence(double *B, const mesh *m, const double *u) {
    sl_int cold = 0;
    memset(B, 0, (size_t)m->n_vertices * sizeof *B);
    for (sl_int f = 0; f < m->n_faces; f++) {
        const sl_int *face = m->faces + 3 * (size_t)f;
        flat_face flat = flat_face_of(m, face);
        laplacian_face measure = laplacian_of_face(m, face);
        double largest = 0, X[2] = {0, 0};
        for (int k = 0; k < 3; k++) {
            largest = fmax(largest, fabs(u[face[k]]));
        }
        if (largest > COLD && flat.x[1][0] > 0 && flat.x[2][1] > 0) {
            double along = (u[face[1]] - u[face[0]]) / largest / flat.x[1][0];
            double up = (u[face[2]] - u[face[0]]) / largest - along * flat.x[2][0];
            up /= flat.x[2][1];
            double length = hypot(along, up);
            if (length > 0 && isfinite(length)) {
                X[0] = -along / length;
                X[1] = -up / length;
            }
        }
        cold += X[0] == 0 && X[1] == 0;
        for (int k = 0; k < 3; k++) { /* the edge opposite to corner k, from i to j */
            int i = (k + 1) % 3, j = (k + 2) % 3;
            double flow = measure.weight[k] * ((flat.x[i][0] - flat.x[j][0]) * X[0] +
                                               (flat.x[i][1] - flat.x[j][1]) * X[1]);
            B[face[i]] += flow;
            B[face[j]] -= flow;
        }
    }
    return cold;
}

static sl_int root_of(sl_int *up, sl_int v) {
    while (up[v] != v) {
        up[v] = up[up[v]];
        v = up[v];
    }
    return v;
}

/* Shifts the distances of each connected piece so that the smallest of its sources is 0, and marks what no face joins
 * to a source by NaN. up, low: scratch of n. The sources are the first vertices of the part. */
static void shift_pieces(double *d, const mesh *m, sl_int n_sources, sl_int *up, double *low) {
    for (sl_int v = 0; v < m->n_vertices; v++) {
        up[v] = v;
        low[v] = INFINITY;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        sl_int a = root_of(up, m->faces[k]);
        sl_int b = root_of(up, m->faces[k / 3 * 3 + (k + 1) % 3]);
        up[a] = b;
    }
    for (sl_int v = 0; v < n_sources; v++) {
        sl_int root = root_of(up, v);
        low[root] = fmin(low[root], d[v]);
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        double zero = low[root_of(up, v)];
        d[v] = isfinite(zero) ? fmax(0, d[v] - zero) : NAN;
    }
}

/* Everything on the part around the sources; u, d: n each. */
static sl_status solve_part(heat_field *out, heat_solver *s, const part *p, const sl_int *sources,
                            sl_int count, int solves, double *u, double *d) {
    size_t n = (size_t)p->m.n_vertices, nb = (size_t)count;
    patch_solver poisson;
    sl_int *up = (sl_int *)malloc((n + 1) * sizeof *up);
    double *B = (double *)malloc((n + nb + 1) * sizeof *B);
    sl_status status = up != NULL && B != NULL ? SL_OK : SL_ERR_MEMORY;
    memset(&poisson, 0, sizeof poisson);
    if (status == SL_OK) {
        for (size_t k = 0; k < nb; k++) {
            B[k] = 1;
        }
        status = sl_local_solve(s->heat, u, n, p->vertices, (sl_int)n, B, nb, sources, count, 1,
                                s->work, &out->heat_stats);
    }
    if (status == SL_OK) {
        out->cold = divergence(B, &p->m, u);
        status = patch_solver_create(&poisson, s->S, s->poisson, p);
    }
    if (status == SL_OK) {
        out->solves = solves;
        out->poisson_stats = poisson.stats;
        status = patch_solver_part(&poisson, d, B, 1, 1e-10, &out->solves);
    }
    if (status == SL_OK) {
        shift_pieces(d, &p->m, count, up, B);
    }
    patch_solver_free(&poisson);
    free(B);
    free(up);
    return status;
}

static sl_status allocate(heat_field *out, size_t n) {
    out->vertices = (sl_int *)malloc((n + 1) * sizeof *out->vertices);
    out->distance = (double *)malloc((n + 1) * sizeof *out->distance);
    out->heat = (double *)malloc((n + 1) * sizeof *out->heat);
    out->path = (double *)malloc((n + 1) * sizeof *out->path);
    return out->vertices != NULL && out->distance != NULL && out->heat != NULL && out->path != NULL
               ? SL_OK
               : SL_ERR_MEMORY;
}

/* The ball comes nearest first, so the sources stand first in it, in an order of their own. */
static sl_status solve_ball(heat_field *out, heat_solver *s, const ball *b, sl_int count,
                            const heat_reach *reach) {
    part p;
    if (!part_span(&p, &s->around, b->vertices, b->n, NULL, 0)) {
        return SL_ERR_MEMORY;
    }
    sl_status status = allocate(out, (size_t)b->n);
    if (status == SL_OK) {
        status =
            solve_part(out, s, &p, b->vertices, count,
                       reach->solves > 0 ? reach->solves : HEAT_SOLVES, out->heat, out->distance);
    }
    out->n_ball = b->n;
    for (sl_int k = 0; k < b->n && status == SL_OK; k++) {
        out->negative += out->heat[k] < 0;
    }
    for (sl_int k = 0; k < b->n && status == SL_OK; k++) {
        double d = out->distance[k];
        if (!isnan(d) && (reach->radius == 0 || d <= reach->radius)) {
            out->vertices[out->n] = b->vertices[k];
            out->heat[out->n] = out->heat[k];
            out->path[out->n] = b->along_edges[k];
            out->distance[out->n++] = d;
        }
    }
    part_free(&p);
    return status;
}

/* Is every vertex in range and there once? */
static bool are_distinct(heat_solver *s, const sl_int *vertices, sl_int count) {
    sl_int marked = 0;
    bool ok = count >= 0;
    for (; ok && marked < count; marked++) {
        sl_int v = vertices[marked];
        if (v < 0 || v >= s->m->n_vertices || s->around.place[v] >= 0) {
            ok = false;
            break;
        }
        s->around.place[v] = marked;
    }
    for (sl_int k = 0; k < marked; k++) {
        s->around.place[vertices[k]] = -1;
    }
    return ok;
}

sl_status heat_distance(heat_field *out, heat_solver *s, const sl_int *sources, sl_int count,
                        const heat_reach *reach) {
    static const heat_reach everywhere = {0, 0, 0};
    const heat_reach *r = reach != NULL ? reach : &everywhere;
    ball b;
    memset(out, 0, sizeof *out);
    if (count < 1 || !(r->radius >= 0) || !(r->margin >= 0) || !are_distinct(s, sources, count)) {
        return SL_ERR_ARGUMENT;
    }
    double wide = r->radius > 0 ? r->radius * (r->margin > 0 ? r->margin : HEAT_MARGIN) : INFINITY;
    if (!ball_find(&b, &s->around, sources, count, wide)) {
        return SL_ERR_MEMORY;
    }
    sl_status status = solve_ball(out, s, &b, count, r);
    ball_free(&b);
    if (status != SL_OK) {
        heat_field_free(out);
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
    if (!(radius >= 0) || !are_distinct(s, sites, count)) {
        return SL_ERR_ARGUMENT;
    }
    for (sl_int v = 0; v < s->m->n_vertices; v++) {
        site[v] = -1;
        most[v] = COLD;
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
