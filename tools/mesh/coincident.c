/* coincident.c: vertices at the same place: counting them, and merging them */
#include "coincident.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Vertices that are kept, in lists by the hash of the cell that they are in. */
typedef struct cells {
    const double *xyz;
    double size;          /* of a cell, the tolerance; 0: each point is a cell */
    size_t mask;          /* lists, minus 1 */
    sl_int *first, *next; /* -1: none */
} cells;

static bool cells_open(cells *c, const mesh *m, double size) {
    size_t lists = 64, n = (size_t)m->n_vertices;
    while (lists < 2 * n) {
        lists *= 2;
    }
    c->xyz = m->xyz;
    c->size = size;
    c->mask = lists - 1;
    c->first = (sl_int *)malloc((lists + n) * sizeof *c->first);
    if (c->first == NULL) {
        return false;
    }
    c->next = c->first + lists;
    for (size_t k = 0; k < lists; k++) {
        c->first[k] = -1;
    }
    return true;
}

/* The list of the cell that is `step` cells away from the one of x. */
static sl_int *list_of(const cells *c, const double *x, const int step[3]) {
    uint64_t hash = 0;
    for (int d = 0; d < 3; d++) {
        /* + 0.0 turns a negative zero into a zero */
        const double cell = (c->size > 0 ? floor(x[d] / c->size) + step[d] : x[d]) + 0.0;
        uint64_t bits;
        memcpy(&bits, &cell, sizeof bits);
        hash = (hash ^ bits) * UINT64_C(0x9E3779B97F4A7C15);
        hash ^= hash >> 29;
    }
    return &c->first[(size_t)hash & c->mask];
}

static bool is_near(const cells *c, sl_int a, sl_int b) {
    const double *x = c->xyz + 3 * (size_t)a, *y = c->xyz + 3 * (size_t)b;
    double sum = 0;
    for (int d = 0; d < 3; d++) {
        sum += (x[d] - y[d]) * (x[d] - y[d]);
    }
    return c->size > 0 ? sum <= c->size * c->size : x[0] == y[0] && x[1] == y[1] && x[2] == y[2];
}

/* The lowest vertex that is kept and near v; -1 if there is none: v is kept now. */
static sl_int find_or_keep(cells *c, sl_int v) {
    static const int here[3] = {0, 0, 0};
    const double *x = c->xyz + 3 * (size_t)v;
    const int reach = c->size > 0 ? 13 : 0; /* 27 cells, or the one */
    sl_int found = -1;
    for (int k = -reach; k <= reach; k++) {
        const int step[3] = {(k + 13) % 3 - 1, (k + 13) / 3 % 3 - 1, (k + 13) / 9 - 1};
        for (sl_int u = *list_of(c, x, step); u >= 0; u = c->next[u]) {
            found = (found < 0 || u < found) && is_near(c, u, v) ? u : found;
        }
    }
    if (found < 0) {
        sl_int *list = list_of(c, x, here);
        c->next[v] = *list;
        *list = v;
    }
    return found;
}

sl_int coincident_count(const mesh *m) {
    cells c;
    bool *is_used = (bool *)calloc((size_t)m->n_vertices + 1, sizeof *is_used);
    sl_int count = -1;
    if (is_used != NULL && cells_open(&c, m, 0)) {
        count = 0;
        for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
            is_used[m->faces[k]] = true;
        }
        for (sl_int v = 0; v < m->n_vertices; v++) {
            count += is_used[v] && find_or_keep(&c, v) >= 0;
        }
        free(c.first);
    }
    free(is_used);
    return count;
}

/* Gives the faces the new numbers. Those of which two corners have become one are left out. */
static sl_int renumber_faces(mesh *m, const sl_int *number) {
    sl_int *to = m->faces, removed = 0;
    for (size_t f = 0; f < (size_t)m->n_faces; f++) {
        const sl_int *v = m->faces + 3 * f;
        const sl_int w[3] = {number[v[0]], number[v[1]], number[v[2]]};
        bool is_lost = false;
        for (int k = 0; k < 3; k++) {
            is_lost = is_lost || (v[k] != v[(k + 1) % 3] && w[k] == w[(k + 1) % 3]);
        }
        if (is_lost) {
            removed++;
        } else {
            memcpy(to, w, sizeof w);
            to += 3;
        }
    }
    m->n_faces -= removed;
    return removed;
}

bool coincident_merge(mesh *m, coincident_merged *merged, sl_int **map, double tolerance) {
    const size_t n = (size_t)m->n_vertices;
    double largest = 0;
    cells c;
    if (map != NULL) {
        *map = NULL;
    }
    for (size_t k = 0; k < 3 * n; k++) {
        largest = fmax(largest, fabs(m->xyz[k]));
    }
    sl_int *number = (sl_int *)malloc((n + 1) * sizeof *number), kept = 0;
    if (number == NULL || !cells_open(&c, m, tolerance >= 0x1p-52 * largest ? tolerance : 0)) {
        free(number);
        return false;
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        const sl_int found = find_or_keep(&c, v);
        number[v] = found < 0 ? kept++ : number[found];
    }
    for (sl_int v = 0, next = 0; v < m->n_vertices; v++) {
        if (number[v] == next) { /* the first one of this number */
            memmove(m->xyz + 3 * (size_t)next, m->xyz + 3 * (size_t)v, 3 * sizeof *m->xyz);
            next++;
        }
    }
    const sl_int removed = renumber_faces(m, number);
    if (merged != NULL) {
        merged->vertices = m->n_vertices - kept;
        merged->faces = removed;
    }
    m->n_vertices = kept;
    free(c.first);
    if (map != NULL) {
        *map = number;
    } else {
        free(number);
    }
    return true;
}
