/* patch_system.c: a breadth-first patch of a system: its boundary and its submatrix */
#include <stdlib.h>
#include <string.h>

#include "bench.h"

/* Stores both triangles of A(vertices, vertices), so that conjugate gradients can gather by
 * column. */
static sl_matrix *submatrix(const bench_system *system, const sl_int *vertices, sl_int size) {
    const sl_csc *A = &system->A;
    sl_int *local_index = system->local_index;
    size_t room = 0, count = 0;
    for (sl_int k = 0; k < size; k++) {
        local_index[vertices[k]] = k;
        room += 2 * (size_t)(A->p[vertices[k] + 1] - A->p[vertices[k]]);
    }
    sl_int *i = bench_alloc(room, sizeof *i), *j = bench_alloc(room, sizeof *j);
    double *x = bench_alloc(room, sizeof *x);
    for (sl_int k = 0; k < size; k++) {
        for (sl_int p = A->p[vertices[k]]; p < A->p[vertices[k] + 1]; p++) {
            sl_int row = local_index[A->i[p]];
            if (row < 0) {
                continue;
            }
            i[count] = row;
            j[count] = k;
            x[count++] = A->x[p];
            if (row != k) {
                i[count] = k;
                j[count] = row;
                x[count++] = A->x[p];
            }
        }
    }
    sl_matrix *matrix;
    bench_must(sl_matrix_from_triplets(&matrix, size, size, (sl_off)count, i, j, x, NULL, NULL),
               "patch matrix");
    for (sl_int k = 0; k < size; k++) {
        local_index[vertices[k]] = -1;
    }
    free(x);
    free(j);
    free(i);
    return matrix;
}

static void find_boundary(bench_patch *patch, const bench_system *system) {
    const adjacency *graph = &system->graph;
    for (sl_int k = 0; k < patch->size; k++) {
        system->seen[patch->vertices[k]] = 1;
    }
    for (sl_int k = 0; k < patch->size; k++) {
        sl_int v = patch->vertices[k];
        for (sl_off p = graph->begin[v]; p < graph->begin[v + 1]; p++) {
            if (!system->seen[graph->neighbor[p]]) {
                patch->boundary[patch->n_boundary] = v;
                patch->boundary_index[patch->n_boundary++] = k;
                break;
            }
        }
    }
    for (sl_int k = 0; k < patch->size; k++) {
        system->seen[patch->vertices[k]] = 0;
    }
}

bench_patch bench_patch_create(const bench_system *system, sl_int seed, sl_int size) {
    bench_patch patch;
    memset(&patch, 0, sizeof patch);
    patch.vertices = bench_alloc((size_t)size, sizeof *patch.vertices);
    patch.boundary = bench_alloc((size_t)size, sizeof *patch.boundary);
    patch.boundary_index = bench_alloc((size_t)size, sizeof *patch.boundary_index);
    patch.size = adjacency_bfs(patch.vertices, size, &system->graph, seed, system->seen);
    find_boundary(&patch, system);
    patch.matrix = submatrix(system, patch.vertices, patch.size);
    patch.A = sl_matrix_view(patch.matrix);
    return patch;
}

bench_patch bench_patch_of(const bench_system *system, const sl_int *vertices, sl_int size) {
    bench_patch patch;
    memset(&patch, 0, sizeof patch);
    patch.vertices = bench_alloc((size_t)size, sizeof *patch.vertices);
    memcpy(patch.vertices, vertices, (size_t)size * sizeof *vertices);
    patch.size = size;
    patch.matrix = submatrix(system, patch.vertices, patch.size);
    patch.A = sl_matrix_view(patch.matrix);
    return patch;
}

void bench_patch_free(bench_patch *patch) {
    sl_matrix_free(patch->matrix);
    free(patch->boundary_index);
    free(patch->boundary);
    free(patch->vertices);
    memset(patch, 0, sizeof *patch);
}

int bench_patch_pick(bench_patch *out, int count, const bench_system *system, sl_int size) {
    uint64_t rng = 77;
    int found = 0;
    for (int attempt = 0; attempt < 8 * count && found < count; attempt++) {
        out[found] = bench_patch_create(system, bench_random_below(&rng, system->n), size);
        if (out[found].size == size && out[found].n_boundary > 0) {
            found++;
        } else {
            bench_patch_free(&out[found]);
        }
    }
    return found;
}
