/* heat_patch.c: a patch around some vertices, prepared for repeated heat-method distance queries */
#include "heat_patch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "planar_triangle.h"
#include "heat_sources.h"
#include "laplacian.h"
#include "pinned_poisson.h"

void heat_field_free(heat_field *f) {
    free(f->vertices);
    free(f->distance);
    free(f->heat);
    free(f->path);
    memset(f, 0, sizeof *f);
}

void heat_patch_free(heat_patch *h) {
    sl_region_free(h->heat_region);
    patch_solver_free(&h->poisson);
    submesh_free(&h->p);
    graph_ball_free(&h->b);
    free(h->sources);
    memset(h, 0, sizeof *h);
}

/* Creates the regions of both factors around the patch. */
static sl_status create_regions(heat_patch *h) {
    sl_status status = patch_solver_use_region(&h->poisson, h->s->poisson_S);
    if (status == SL_OK) {
        status =
            sl_region_create(&h->heat_region, h->s->heat, h->b.vertices, h->b.n, NULL, NULL, NULL);
    }
    return status;
}

sl_status heat_patch_create(heat_patch *out, heat_solver *s, const sl_int *sources, sl_int count,
                            double radius, bool in_region) {
    memset(out, 0, sizeof *out);
    if (count < 1 || !(radius >= 0) || !incidence_vertices_are_distinct(&s->inc, sources, count)) {
        return SL_ERR_ARGUMENT;
    }
    out->s = s;
    out->n_sources = count;
    out->sources = (sl_int *)malloc(((size_t)count + 1) * sizeof *out->sources);
    sl_status status = SL_ERR_MEMORY;
    if (out->sources != NULL && graph_ball_create(&out->b, &s->inc, sources, count, radius) &&
        submesh_from_vertices(&out->p, &s->inc, out->b.vertices, out->b.n, NULL, 0)) {
        memcpy(out->sources, sources, (size_t)count * sizeof *sources);
        status = patch_solver_create(&out->poisson, s->poisson_S, s->poisson, &out->p);
    }
    if (status == SL_OK && in_region) {
        status = create_regions(out);
    }
    if (status != SL_OK) {
        heat_patch_free(out);
    }
    return status;
}

/* What X is on a face: the direction in which heat falls; the one in which a distance rises; the
 * gradient of a distance, where it is longer than 1 its direction. */
typedef enum field_kind { DOWN_THE_HEAT, UP_THE_DISTANCE, AT_MOST_1 } field_kind;

/* B = div X. A face with corners x_i, x_j, x_k and weights w adds at its vertex i:
 *     w_k (x_i - x_j) X + w_j (x_i - x_k) X.
 * Returns the number of faces without X. */
static sl_int divergence(double *B, const submesh *p, const double *u, field_kind kind) {
    const mesh *m = &p->m;
    sl_int faces_without_gradient = 0;
    memset(B, 0, (size_t)m->n_vertices * sizeof *B);
    for (sl_int f = 0; f < m->n_faces; f++) {
        const sl_int *face = m->faces + 3 * (size_t)f;
        const double *lengths = p->lengths != NULL ? p->lengths + 3 * (size_t)f : NULL;
        planar_triangle flat =
            lengths != NULL ? planar_triangle_of_lengths(lengths) : planar_triangle_of(m, face);
        laplacian_face face_values =
            lengths != NULL ? laplacian_of_lengths(lengths) : laplacian_of_face(m, face);
        double largest = 0, X[2] = {0, 0};
        for (int k = 0; k < 3; k++) {
            largest = fmax(largest, fabs(u[face[k]]));
        }
        if (largest > HEAT_MIN && flat.x[1][0] > 0 && flat.x[2][1] > 0) {
            double along = (u[face[1]] - u[face[0]]) / largest / flat.x[1][0];
            double up = (u[face[2]] - u[face[0]]) / largest - along * flat.x[2][0];
            up /= flat.x[2][1];
            double length = hypot(along, up);
            double size = kind == DOWN_THE_HEAT ? -1 : 1;
            if (kind == AT_MOST_1) {
                size = fmin(1, length * largest);
            }
            if (length > 0 && isfinite(length)) {
                X[0] = size * along / length;
                X[1] = size * up / length;
            }
        }
        faces_without_gradient += X[0] == 0 && X[1] == 0;
        for (int k = 0; k < 3; k++) { /* the edge opposite to corner k, from i to j */
            int i = (k + 1) % 3, j = (k + 2) % 3;
            double flow = face_values.weight[k] * ((flat.x[i][0] - flat.x[j][0]) * X[0] +
                                                   (flat.x[i][1] - flat.x[j][1]) * X[1]);
            B[face[i]] += flow;
            B[face[j]] -= flow;
        }
    }
    return faces_without_gradient;
}

/* Union-find with path halving. */
static sl_int root_of(sl_int *up, sl_int v) {
    while (up[v] != v) {
        up[v] = up[up[v]];
        v = up[v];
    }
    return v;
}

/* Shifts the distances of each connected piece so that the smallest one at its sources is 0.
 * Vertices that no face connects to a source get NaN. sources: local numbers. up, low: scratch of
 * n. */
static void shift_pieces(double *d, const mesh *m, const sl_int *sources, sl_int n_sources,
                         sl_int *up, double *low) {
    for (sl_int v = 0; v < m->n_vertices; v++) {
        up[v] = v;
        low[v] = INFINITY;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        sl_int a = root_of(up, m->faces[k]);
        sl_int b = root_of(up, m->faces[k / 3 * 3 + (k + 1) % 3]);
        up[a] = b;
    }
    for (sl_int k = 0; k < n_sources; k++) {
        sl_int root = root_of(up, sources[k]);
        low[root] = fmin(low[root], d[sources[k]]);
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        double zero = low[root_of(up, v)];
        d[v] = isfinite(zero) ? fmax(0, d[v] - zero) : NAN;
    }
}

/* Finds the local numbers of the sources. False: one is not in the patch, or is given twice. */
static bool find_local_sources(sl_int *local_sources, const heat_patch *h, const sl_int *sources,
                               sl_int count) {
    sl_int *local_index = h->s->inc.local_index;
    bool found = true;
    for (sl_int k = 0; k < h->b.n; k++) {
        local_index[h->b.vertices[k]] = k;
    }
    for (sl_int k = 0; k < count && found; k++) {
        found = sources[k] >= 0 && sources[k] < h->s->m->n_vertices && local_index[sources[k]] >= 0;
        if (found) {
            local_sources[k] = local_index[sources[k]];
            local_index[sources[k]] = -1;
        }
    }
    for (sl_int k = 0; k < h->b.n; k++) {
        local_index[h->b.vertices[k]] = -1;
    }
    return found;
}

/* Heat u on the patch, from 1 at one source, or such that u is 1 at all of several. given: scratch
 * of count. */
static sl_status solve_heat(heat_field *out, const heat_patch *h, const sl_int *sources,
                            sl_int count, double *u, double *given) {
    sl_plan *plan = NULL;
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.region = h->heat_region;
    given[0] = 1;
    sl_status status = sl_plan_create(&plan, h->s->S, sources, count, h->b.vertices, h->b.n, &opt,
                                      &out->heat_stats);
    if (status == SL_OK && count > 1) {
        status = heat_sources_balance(given, h->s, h->heat_region, sources, count);
    }
    if (status == SL_OK) {
        status =
            sl_plan_solve(plan, h->s->heat, u, (size_t)h->b.n, given, (size_t)count, 1, h->s->work);
    }
    sl_plan_free(plan);
    return status;
}

/* Distances d with all sources held at 0. Where two fronts meet at an angle, heat flows between
 * their directions, and d would rise there as fast as behind one of them. The directions of d are
 * better: X is taken from d once more, and then twice without lengthening its gradient. */
static sl_status integrate_held(double *d, const heat_patch *h, const sl_int *local_sources,
                                sl_int count, double *B) {
    static const field_kind then[] = {UP_THE_DISTANCE, AT_MOST_1, AT_MOST_1};
    const sl_csc N = sl_matrix_view(h->poisson.N);
    pinned_poisson p;
    sl_status status = pinned_poisson_create(&p, &N, local_sources, count);
    if (status != SL_OK) {
        return status;
    }
    status = pinned_poisson_solve(&p, d, B);
    for (size_t k = 0; k < sizeof then / sizeof *then && status == SL_OK; k++) {
        (void)divergence(B, &h->p, d, then[k]);
        status = pinned_poisson_solve(&p, d, B);
    }
    pinned_poisson_free(&p);
    return status;
}

/* Distances from heat: by the factor of the mesh, and then shifted so that the least one of the
 * sources is 0; or, if there are several, with all of them held at 0. up, B: scratch of n; B is
 * div X. */
static sl_status integrate(heat_field *out, heat_patch *h, const sl_int *local_sources,
                           sl_int count, sl_int *up, double *B) {
    sl_status status = SL_ERR_PIVOT;
    out->poisson_stats = h->poisson.stats;
    if (count > 1 && out->solves > 1) {
        status = integrate_held(out->distance, h, local_sources, count, B);
        out->pinned = status == SL_OK;
    }
    if (status == SL_ERR_PIVOT) {
        status = patch_solver_solve_patch(&h->poisson, out->distance, B, 1, 1e-10, &out->solves);
        out->pinned = false;
    }
    if (status == SL_OK) {
        shift_pieces(out->distance, &h->p.m, local_sources, count, up, B);
    }
    return status;
}

/* Heat and distances on the whole patch. */
static sl_status solve(heat_field *out, heat_patch *h, const sl_int *sources, sl_int count,
                       int solves) {
    size_t n = (size_t)h->b.n;
    sl_int *up = (sl_int *)malloc((n + 1) * sizeof *up);
    sl_int *local_sources = (sl_int *)malloc(((size_t)count + 1) * sizeof *local_sources);
    double *B = (double *)malloc((n + (size_t)count + 1) * sizeof *B);
    sl_status status = up != NULL && local_sources != NULL && B != NULL ? SL_OK : SL_ERR_MEMORY;
    if (status == SL_OK && !find_local_sources(local_sources, h, sources, count)) {
        status = SL_ERR_ARGUMENT;
    }
    if (status == SL_OK) {
        status = solve_heat(out, h, sources, count, out->heat, B);
    }
    if (status == SL_OK) {
        out->faces_without_gradient = divergence(B, &h->p, out->heat, DOWN_THE_HEAT);
        out->solves = solves;
        status = integrate(out, h, local_sources, count, up, B);
    }
    free(B);
    free(local_sources);
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

/* Keeps the vertices whose distance is at most the radius. */
static void keep_near(heat_field *out, const heat_patch *h, double radius, bool with_paths) {
    for (sl_int k = 0; k < h->b.n; k++) {
        double d = out->distance[k];
        out->negative += out->heat[k] < 0;
        if (!isnan(d) && (radius == 0 || d <= radius)) {
            out->vertices[out->n] = h->b.vertices[k];
            out->heat[out->n] = out->heat[k];
            out->path[out->n] = with_paths ? h->b.path_length[k] : INFINITY;
            out->distance[out->n++] = d;
        }
    }
}

sl_status heat_patch_distance(heat_field *out, heat_patch *h, const sl_int *sources, sl_int count,
                              double radius, int solves) {
    memset(out, 0, sizeof *out);
    if (count < 1 || count > h->b.n || !(radius >= 0) || solves < 1) {
        return SL_ERR_ARGUMENT;
    }
    sl_status status = allocate(out, (size_t)h->b.n);
    if (status == SL_OK) {
        status = solve(out, h, sources, count, solves);
    }
    if (status != SL_OK) {
        heat_field_free(out);
        return status;
    }
    out->n_patch = h->b.n;
    keep_near(out, h, radius,
              count == h->n_sources &&
                  memcmp(sources, h->sources, (size_t)count * sizeof *sources) == 0);
    return SL_OK;
}
