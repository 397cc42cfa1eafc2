/* systems.c: the linear systems of the questions: grids, tori, volumes, mesh files */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/io/dataset.h"
#include "tools/mesh/grid.h"
#include "tools/geometry/polyharmonic.h"
#include "tools/geometry/laplacian.h"
#include "bench.h"

enum { MAX_SYSTEMS = 32 };

static bench_system *systems[MAX_SYSTEMS];
static int n_systems;

static const bench_system *find(const char *name) {
    for (int k = 0; k < n_systems; k++) {
        if (strcmp(systems[k]->name, name) == 0) {
            return systems[k];
        }
    }
    return NULL;
}

static void release(bench_system *system) {
    adjacency_free(&system->graph);
    free(system->seen);
    free(system->local_index);
    sl_factor_free(system->F);
    sl_symbolic_free(system->S);
    sl_matrix_free(system->matrix);
    free(system);
}

/* Analyzes and factors matrix, which then belongs to the system. NULL if rounding makes a pivot
 * unusable. */
static const bench_system *try_add_system(const char *name, sl_matrix *matrix) {
    if (n_systems == MAX_SYSTEMS) {
        bench_must(SL_ERR_TOO_LARGE, "adding a system");
    }
    bench_system *system = bench_alloc(1, sizeof *system);
    memset(system, 0, sizeof *system);
    snprintf(system->name, sizeof system->name, "%s", name);
    system->matrix = matrix;
    system->A = sl_matrix_view(matrix);
    system->n = system->A.n_rows;
    double start = bench_now();
    bench_must(sl_symbolic_create(&system->S, &system->A, NULL, &system->stats), name);
    const sl_status status =
        sl_factor_create(&system->F, system->S, &system->A, NULL, &system->stats);
    if (status == SL_ERR_PIVOT) {
        release(system);
        return NULL;
    }
    bench_must(status, name);
    if (!adjacency_from_matrix(&system->graph, &system->A)) {
        bench_must(SL_ERR_MEMORY, "creating the graph of a matrix");
    }
    system->seen = bench_alloc((size_t)system->n, sizeof *system->seen);
    system->local_index = bench_alloc((size_t)system->n, sizeof *system->local_index);
    memset(system->seen, 0, (size_t)system->n * sizeof *system->seen);
    memset(system->local_index, -1, (size_t)system->n * sizeof *system->local_index);
    bench_progress("[%s: analyzed and factored in %.2f s]\n", name, bench_now() - start);
    systems[n_systems++] = system;
    return system;
}

static const bench_system *add_system(const char *name, sl_matrix *matrix) {
    const bench_system *system = try_add_system(name, matrix);
    if (!system) {
        bench_must(SL_ERR_PIVOT, name);
    }
    return system;
}

/* t of M + t L: the square of a tenth of the diagonal of the bounding box, the length over which
 * every system smooths */
static double smoothing_time(const mesh *m) {
    double low[3] = {0, 0, 0}, high[3] = {0, 0, 0}, square = 0;
    for (sl_int v = 0; v < m->n_vertices; v++) {
        for (int c = 0; c < 3; c++) {
            double x = m->xyz[3 * (size_t)v + (size_t)c];
            low[c] = v == 0 || x < low[c] ? x : low[c];
            high[c] = v == 0 || x > high[c] ? x : high[c];
        }
    }
    for (int c = 0; c < 3; c++) {
        square += (high[c] - low[c]) * (high[c] - low[c]);
    }
    return 0.01 * square;
}

static const bench_system *add_mesh(const char *name, mesh *m) {
    sl_matrix *matrix;
    const double t = smoothing_time(m);
    if (!laplacian_system(&matrix, m, t)) {
        bench_must(SL_ERR_MEMORY, "assembling the matrix of a mesh");
    }
    mesh_free(m);
    const bench_system *system = add_system(name, matrix);
    systems[n_systems - 1]->t = t;
    return system;
}

static void make_grid(mesh *m, sl_int side) {
    if (!mesh_grid(m, side, side, 0.2, 1)) {
        bench_must(SL_ERR_MEMORY, "creating a grid");
    }
}

static const bench_system *grid(double vertices) {
    char name[64];
    sl_int side = (sl_int)lround(sqrt(vertices));
    snprintf(name, sizeof name, "grid %dx%d", (int)side, (int)side);
    const bench_system *system = find(name);
    if (!system) {
        mesh m;
        make_grid(&m, side);
        system = add_mesh(name, &m);
    }
    return system;
}

const bench_system *bench_torus(double vertices) {
    char name[64];
    sl_int around = (sl_int)lround(sqrt(2.5 * vertices)); /* the ratio of the radii is 2.5 */
    sl_int tube = (sl_int)lround(vertices / around);
    snprintf(name, sizeof name, "torus %dx%d", (int)around, (int)tube);
    const bench_system *system = find(name);
    if (!system) {
        mesh m;
        if (!mesh_torus(&m, around, tube, 0.2, 1)) {
            bench_must(SL_ERR_MEMORY, "creating a torus");
        }
        system = add_mesh(name, &m);
    }
    return system;
}

const bench_system *bench_volume(sl_int side) {
    char name[64];
    snprintf(name, sizeof name, "volume %dx%dx%d", (int)side, (int)side, (int)side);
    const bench_system *system = find(name);
    if (!system) {
        sl_matrix *matrix;
        double tenth = 0.1 * (double)side;
        if (!grid_laplacian_3d(&matrix, side, side, side, 1 / (tenth * tenth))) {
            bench_must(SL_ERR_MEMORY, "assembling the matrix of a volume");
        }
        system = add_system(name, matrix);
    }
    return system;
}

static int read_mesh(mesh *m, const char *path) {
    char message[256];
    if (!mesh_read(m, path, message, sizeof message)) {
        bench_progress("bench: %s\n", message);
        return 0;
    }
    if (m->n_vertices == 0) {
        bench_progress("bench: %s has no vertices\n", dataset_basename(path));
        mesh_free(m);
        return 0;
    }
    return 1;
}

const bench_system *bench_mesh(const char *path) {
    char name[64];
    snprintf(name, sizeof name, "%s", dataset_basename(path));
    const bench_system *system = find(name);
    mesh m;
    if (!system && read_mesh(&m, path)) {
        system = add_mesh(name, &m);
    }
    return system;
}

const bench_system *bench_k_harmonic(const bench_run *run, double vertices, int k) {
    static const char *const kinds[] = {"harmonic", "biharmonic", "triharmonic"};
    char name[64];
    sl_int side = (sl_int)lround(sqrt(vertices));
    if (run->mesh_path) {
        snprintf(name, sizeof name, "%s %.40s", kinds[k - 1], dataset_basename(run->mesh_path));
    } else {
        snprintf(name, sizeof name, "%s %dx%d", kinds[k - 1], (int)side, (int)side);
    }
    const bench_system *system = find(name);
    if (!system) {
        mesh m;
        sl_matrix *matrix;
        if (!run->mesh_path) {
            make_grid(&m, side);
        } else if (!read_mesh(&m, run->mesh_path)) {
            return NULL;
        }
        if (!polyharmonic_system(&matrix, &m, k, pow(smoothing_time(&m), k))) {
            bench_must(SL_ERR_MEMORY, "assembling a k-harmonic matrix");
        }
        mesh_free(&m);
        system = try_add_system(name, matrix);
        if (!system) {
            printf("\n%s: rounding makes a pivot unusable, the matrix is singular to double "
                   "precision\n",
                   name);
        }
    }
    return system;
}

int bench_systems(const bench_run *run, const double *wanted, int count, const bench_system **out) {
    int found = 0;
    if (run->mesh_path) {
        out[0] = bench_mesh(run->mesh_path);
        return out[0] != NULL;
    }
    for (int k = 0; k < count; k++) {
        if (wanted[k] <= run->largest) {
            out[found++] = grid(wanted[k]);
        }
    }
    return found;
}

void bench_systems_free(void) {
    while (n_systems > 0) {
        release(systems[--n_systems]);
    }
}
