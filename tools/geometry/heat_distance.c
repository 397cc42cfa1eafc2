/* heat_distance.c: geodesic distances and Voronoi cells by the heat method, global or local */
#include "heat_distance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double heat_options_patch_radius(const heat_options *r) {
    return r->radius > 0 ? r->radius * (r->margin > 0 ? r->margin : HEAT_MARGIN) : INFINITY;
}

sl_status heat_distance(heat_field *out, heat_solver *s, const sl_int *sources, sl_int count,
                        const heat_options *options) {
    static const heat_options everywhere = {0, 0, 0};
    const heat_options *r = options != NULL ? options : &everywhere;
    heat_patch patch;
    memset(out, 0, sizeof *out);
    if (!(r->radius >= 0) || !(r->margin >= 0)) {
        return SL_ERR_ARGUMENT;
    }
    sl_status status =
        heat_patch_create(&patch, s, sources, count, heat_options_patch_radius(r), false);
    if (status == SL_OK) {
        status = heat_patch_distance(out, &patch, sources, count, r->radius,
                                     r->solves > 0 ? r->solves : HEAT_SOLVES);
        heat_patch_free(&patch);
    }
    return status;
}

/* Assigns each vertex to site `which` if u is larger than its heat so far. */
static void keep_larger(sl_int *site, double *heat, const sl_int *vertices, sl_int n,
                        const double *u, sl_int which) {
    for (sl_int k = 0; k < n; k++) {
        sl_int v = vertices != NULL ? vertices[k] : k;
        if (u[k] > heat[v]) {
            heat[v] = u[k];
            site[v] = which;
        }
    }
}

/* Solves for 8 sites at a time, on the whole mesh. */
static sl_status cells_everywhere(sl_int *site, double *heat, heat_solver *s, const sl_int *sites,
                                  sl_int count, void (*progress)(double fraction)) {
    enum { BLOCK = 8 };
    size_t n = (size_t)s->m->n_vertices;
    double *U = (double *)malloc((BLOCK * n + 1) * sizeof *U), B[BLOCK * BLOCK];
    sl_status status = U != NULL ? SL_OK : SL_ERR_MEMORY;
    for (sl_int first = 0; first < count && status == SL_OK; first += BLOCK) {
        sl_int width = count - first < BLOCK ? count - first : BLOCK;
        for (sl_int k = 0; k < width * width; k++) {
            B[k] = k % width == k / width;
        }
        status = sl_local_solve(s->heat, sites + first, width, NULL, SL_ALL, U, n, B, (size_t)width,
                                width, s->work, NULL);
        for (sl_int k = 0; k < width && status == SL_OK; k++) {
            keep_larger(site, heat, NULL, (sl_int)n, U + n * (size_t)k, first + k);
        }
        if (progress != NULL) {
            progress((double)(first + width) / (double)count);
        }
    }
    free(U);
    return status;
}

/* Solves for one site on its graph ball. */
static sl_status cell_within(sl_int *site, double *heat, heat_solver *s, const sl_int *sites,
                             sl_int which, double radius, sl_off *touched) {
    graph_ball b;
    const double one = 1;
    if (!graph_ball_create(&b, &s->inc, sites + which, 1, radius)) {
        return SL_ERR_MEMORY;
    }
    double *u = (double *)malloc(((size_t)b.n + 1) * sizeof *u);
    sl_status status = SL_ERR_MEMORY;
    if (u != NULL) {
        status = sl_local_solve(s->heat, sites + which, 1, b.vertices, b.n, u, (size_t)b.n, &one, 1,
                                1, s->work, NULL);
    }
    if (status == SL_OK) {
        keep_larger(site, heat, b.vertices, b.n, u, which);
        *touched += b.n;
    }
    free(u);
    graph_ball_free(&b);
    return status;
}

sl_status heat_cells(sl_int *site, double *heat, heat_solver *s, const sl_int *sites, sl_int count,
                     double radius, sl_off *touched, void (*progress)(double fraction)) {
    sl_off sum = 0;
    if (!(radius >= 0) || !incidence_vertices_are_distinct(&s->inc, sites, count)) {
        return SL_ERR_ARGUMENT;
    }
    for (sl_int v = 0; v < s->m->n_vertices; v++) {
        site[v] = -1;
        heat[v] = HEAT_MIN;
    }
    sl_status status = SL_OK;
    if (radius == 0) {
        status = cells_everywhere(site, heat, s, sites, count, progress);
        sum = (sl_off)count * s->m->n_vertices;
    }
    for (sl_int k = 0; k < count && radius > 0 && status == SL_OK; k++) {
        status = cell_within(site, heat, s, sites, k, radius, &sum);
        if (progress != NULL) {
            progress((double)(k + 1) / (double)count);
        }
    }
    if (touched != NULL) {
        *touched = sum;
    }
    return status;
}
