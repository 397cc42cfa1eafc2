/* adjacency.c: neighbors of mesh vertices or matrix rows, breadth-first search, components */
#include "adjacency.h"

#include <stdlib.h>
#include <string.h>

void adjacency_free(adjacency *a) {
    if (a != NULL) {
        free(a->begin);
        free(a->neighbor);
        memset(a, 0, sizeof *a);
    }
}

static bool adjacency_allocate(adjacency *a, sl_int n, sl_off count) {
    a->n = n;
    a->begin = (sl_off *)calloc((size_t)n + 2, sizeof *a->begin);
    a->neighbor = (sl_int *)malloc(((size_t)count + 1) * sizeof *a->neighbor);
    if (a->begin == NULL || a->neighbor == NULL) {
        adjacency_free(a);
        return false;
    }
    return true;
}

/* The graph is built in two passes over the edges. The first counts the neighbors of v in
 * begin[v+2]. After prefix sums the second stores them: begin[v+1] is the next free position of v,
 * and its end once all edges are stored. */
static void count_edge(adjacency *a, sl_int u, sl_int v) {
    if (u != v) {
        a->begin[u + 2]++;
        a->begin[v + 2]++;
    }
}

static void store_edge(adjacency *a, sl_int u, sl_int v) {
    if (u != v) {
        a->neighbor[a->begin[u + 1]++] = v;
        a->neighbor[a->begin[v + 1]++] = u;
    }
}

static void sum_counts(adjacency *a) {
    for (sl_int v = 0; v < a->n; v++) {
        a->begin[v + 2] += a->begin[v + 1];
    }
}

/* Sorts all lists by transposing the symmetric structure, then removes duplicates. */
static bool sort_and_deduplicate(adjacency *a) {
    adjacency sorted = {0, NULL, NULL};
    if (!adjacency_allocate(&sorted, a->n, a->begin[a->n])) {
        return false;
    }
    memcpy(sorted.begin + 1, a->begin, ((size_t)a->n + 1) * sizeof *sorted.begin);
    for (sl_int v = 0; v < a->n; v++) {
        for (sl_off p = a->begin[v]; p < a->begin[v + 1]; p++) {
            sorted.neighbor[sorted.begin[a->neighbor[p] + 1]++] = v;
        }
    }
    sl_off kept = 0;
    for (sl_int v = 0; v < a->n; v++) {
        sl_off from = kept;
        for (sl_off p = sorted.begin[v]; p < sorted.begin[v + 1]; p++) {
            if (kept == from || a->neighbor[kept - 1] != sorted.neighbor[p]) {
                a->neighbor[kept++] = sorted.neighbor[p];
            }
        }
        a->begin[v] = from;
    }
    a->begin[a->n] = kept;
    adjacency_free(&sorted);
    return true;
}

static bool finish(adjacency *a) {
    if (!sort_and_deduplicate(a)) {
        adjacency_free(a);
        return false;
    }
    return true;
}

bool adjacency_from_mesh(adjacency *out, const mesh *m) {
    memset(out, 0, sizeof *out);
    size_t corners = 3 * (size_t)m->n_faces;
    if (!mesh_faces_are_in_range(m)) {
        return false;
    }
    if (!adjacency_allocate(out, m->n_vertices, 2 * (sl_off)corners)) {
        return false;
    }
    for (const sl_int *f = m->faces; f < m->faces + corners; f += 3) {
        count_edge(out, f[0], f[1]);
        count_edge(out, f[1], f[2]);
        count_edge(out, f[2], f[0]);
    }
    sum_counts(out);
    for (const sl_int *f = m->faces; f < m->faces + corners; f += 3) {
        store_edge(out, f[0], f[1]);
        store_edge(out, f[1], f[2]);
        store_edge(out, f[2], f[0]);
    }
    return finish(out);
}

bool adjacency_from_matrix(adjacency *out, const sl_csc *A) {
    memset(out, 0, sizeof *out);
    if (sl_csc_check(A, NULL) != SL_OK || A->n_rows != A->n_cols ||
        !adjacency_allocate(out, A->n_cols, 2 * (sl_off)A->p[A->n_cols])) {
        return false;
    }
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            count_edge(out, A->i[p], j);
        }
    }
    sum_counts(out);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            store_edge(out, A->i[p], j);
        }
    }
    return finish(out);
}

/* As adjacency_bfs, but leaves the found vertices marked in seen. */
static sl_int search(sl_int *patch, sl_int count, const adjacency *a, sl_int start,
                     unsigned char *seen) {
    if (count <= 0 || start < 0 || start >= a->n) {
        return 0;
    }
    sl_int found = 1;
    patch[0] = start;
    seen[start] = 1;
    for (sl_int head = 0; head < found && found < count; head++) {
        sl_int v = patch[head];
        for (sl_off p = a->begin[v]; p < a->begin[v + 1] && found < count; p++) {
            sl_int w = a->neighbor[p];
            if (!seen[w]) {
                seen[w] = 1;
                patch[found++] = w;
            }
        }
    }
    return found;
}

sl_int adjacency_bfs(sl_int *patch, sl_int count, const adjacency *a, sl_int start,
                     unsigned char *seen) {
    sl_int found = search(patch, count, a, start, seen);
    for (sl_int k = 0; k < found; k++) {
        seen[patch[k]] = 0;
    }
    return found;
}

sl_int adjacency_components(sl_int *component, sl_int *sizes, const adjacency *a) {
    size_t n = (size_t)a->n;
    sl_int *patch = (sl_int *)malloc((n + 1) * sizeof *patch);
    unsigned char *seen = (unsigned char *)calloc(n + 1, 1);
    sl_int components = -1;
    if (patch != NULL && seen != NULL) {
        components = 0;
        for (sl_int v = 0; v < a->n; v++) {
            if (seen[v]) {
                continue;
            }
            sl_int found = search(patch, a->n, a, v, seen);
            for (sl_int k = 0; k < found; k++) {
                component[patch[k]] = components;
            }
            if (sizes != NULL) {
                sizes[components] = found;
            }
            components++;
        }
    }
    free(patch);
    free(seen);
    return components;
}
