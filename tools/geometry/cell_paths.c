/* cell_paths.c: moves vertices of Voronoi cells to sites that paths over the faces show nearer */
#include "cell_paths.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is known of the vertices before the searches from single sites. */
typedef struct vertices {
    sl_int n;
    double *length; /* n: to the nearest site */
    double *width;  /* n: what another site may be farther */
    sl_int *origin; /* n: the nearest site */
    sl_int *begin;  /* sites + 1: the disputed vertices of site k are list[begin[k]] .. */
    sl_int *list;   /* vertices whose cell is not that of the nearest site, by cell */
} vertices;

static bool allocate(vertices *v, sl_int n, sl_int sites) {
    size_t room = (size_t)n + 1;
    v->n = n;
    v->length = (double *)malloc(room * sizeof *v->length);
    v->width = (double *)malloc(room * sizeof *v->width);
    v->origin = (sl_int *)malloc(room * sizeof *v->origin);
    v->list = (sl_int *)malloc(room * sizeof *v->list);
    v->begin = (sl_int *)calloc((size_t)sites + 2, sizeof *v->begin);
    return v->length != NULL && v->width != NULL && v->origin != NULL && v->list != NULL &&
           v->begin != NULL;
}

static void release(vertices *v) {
    free(v->begin);
    free(v->list);
    free(v->origin);
    free(v->width);
    free(v->length);
}

static bool is_disputed(const vertices *v, const sl_int *cell, sl_int k) {
    return cell[k] >= 0 && isfinite(v->length[k]) && cell[k] != v->origin[k];
}

/* Sorts the disputed vertices by cell. */
static void sort_disputed(vertices *v, const sl_int *cell, sl_int sites) {
    for (sl_int k = 0; k < v->n; k++) {
        if (is_disputed(v, cell, k)) {
            v->begin[cell[k] + 2]++;
        }
    }
    for (sl_int k = 0; k < sites; k++) {
        v->begin[k + 2] += v->begin[k + 1];
    }
    for (sl_int k = 0; k < v->n; k++) {
        if (is_disputed(v, cell, k)) {
            v->list[v->begin[cell[k] + 1]++] = k;
        }
    }
}

/* Decides on the disputed vertices of a site: paths from it that are longer than needed to keep
 * them are not followed. */
static bool decide(cell_correction *c, sl_int *cell, const vertices *v, surface_search *three,
                   const sl_int *sites, sl_int site) {
    double limit = 0;
    for (sl_int p = v->begin[site]; p < v->begin[site + 1]; p++) {
        const sl_int k = v->list[p];
        limit = fmax(limit, v->length[k] + v->width[k]);
    }
    if (!surface_search_run(three, sites + site, 1, 2 * limit)) {
        return false;
    }
    const double *own = surface_search_lengths(three);
    for (sl_int p = v->begin[site]; p < v->begin[site + 1]; p++) {
        const sl_int k = v->list[p];
        double excess = own[k] - v->length[k];
        c->farther = fmax(c->farther, isfinite(excess) ? excess : limit);
        if (excess > v->width[k]) {
            cell[k] = v->origin[k];
            c->moved++;
        } else {
            c->remains = fmax(c->remains, excess);
            c->mean_gap += excess;
            c->disputed++;
        }
    }
    return true;
}

bool cell_paths_correct(cell_correction *c, sl_int *cell, surface_search *one,
                        surface_search *three, sl_int n_vertices, const sl_int *sites, sl_int count,
                        double radius, double slack, void (*progress)(double fraction)) {
    vertices v;
    double limit = radius > 0 ? radius : INFINITY;
    memset(c, 0, sizeof *c);
    memset(&v, 0, sizeof v);
    bool ok = allocate(&v, n_vertices, count) && surface_search_run(one, sites, count, limit) &&
              surface_search_run(three, sites, count, limit);
    for (sl_int k = 0; k < n_vertices && ok; k++) {
        double coarse = surface_search_lengths(one)[k];
        v.length[k] = surface_search_lengths(three)[k];
        v.origin[k] = surface_search_origins(three)[k];
        v.width[k] = slack + (isfinite(coarse) ? 0.5 * (coarse - v.length[k]) : 0);
        if (cell[k] < 0 && radius == 0 && isfinite(v.length[k])) {
            cell[k] = v.origin[k];
            c->given++;
        }
    }
    if (ok) {
        sort_disputed(&v, cell, count);
    }
    for (sl_int site = 0; site < count && ok; site++) {
        ok = v.begin[site] == v.begin[site + 1] || decide(c, cell, &v, three, sites, site);
        if (progress != NULL) {
            progress((double)(site + 1) / (double)count);
        }
    }
    c->mean_gap = c->disputed > 0 ? c->mean_gap / c->disputed : 0;
    release(&v);
    return ok;
}
