/* vtk_grid.c: the surface of the cells of an unstructured grid of VTK */
#include "vtk_grid.h"

#include <stdlib.h>
#include <string.h>

/* Types of cells. */
enum {
    VERTEX = 1,
    POLY_LINE = 4, /* 1 .. 4: points and lines */
    TRIANGLE,
    STRIP,
    POLYGON,
    PIXEL,
    QUAD,
    TETRA,
    VOXEL,
    HEXAHEDRON,
    WEDGE,
    PYRAMID
};

/* The faces of solids by the corners of the cell; -1: the face is a triangle. */
typedef struct solid {
    int corners, faces;
    int face[6][4];
} solid;

static const solid solids[5] = {
    {4, 4, {{0, 1, 2, -1}, {0, 1, 3, -1}, {0, 2, 3, -1}, {1, 2, 3, -1}}},
    {8, 6, {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}},
    {8, 6, {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 2, 6, 5}}},
    {6, 5, {{0, 1, 2, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
    {5, 5, {{0, 1, 2, 3}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}};

/* A face of a solid: its vertices in ascending order (-1 first for a triangle), its cell, its
 * place in `solids`. */
typedef struct solid_face {
    sl_int key[4];
    const sl_int *cell;
    const int *face;
} solid_face;

static const solid *solid_of(sl_int type) {
    return type >= TETRA && type <= PYRAMID ? &solids[type - TETRA] : NULL;
}

static int by_key(const void *a, const void *b) {
    const sl_int *p = ((const solid_face *)a)->key, *q = ((const solid_face *)b)->key;
    for (int k = 0; k < 4; k++) {
        if (p[k] != q[k]) {
            return p[k] < q[k] ? -1 : 1;
        }
    }
    return 0;
}

/* The face of the corners `face` of a cell; NULL: all `count` corners of the cell. */
static solid_face face_of(const sl_int *cell, const int *face, int count) {
    solid_face s = {{-1, -1, -1, -1}, cell, face};
    for (int k = 0; k < count; k++) {
        sl_int v = face == NULL ? cell[k] : face[k] < 0 ? -1 : cell[face[k]];
        for (int i = 3; i >= 0; i--) { /* inserts v from the right */
            if (v > s.key[i]) {
                const sl_int smaller = s.key[i];
                s.key[i] = v;
                v = smaller;
            }
        }
    }
    return s;
}

/* Returns whether no cell is wrong, and counts what is in the grid. */
static bool check(mesh_build *b, const vtk_grid *g, size_t *n_faces, int64_t *n_lines,
                  int64_t *n_solids) {
    const sl_int *at = g->cells.at;
    if (g->types.count != (size_t)g->n_cells) {
        return input_error(b->in, "%lld CELLS but %lld CELL_TYPES", (long long)g->n_cells,
                           (long long)g->types.count);
    }
    for (int64_t k = 0; k < g->n_cells; k++, at += 1 + at[0]) {
        const sl_int type = g->types.at[k];
        const solid *s = solid_of(type);
        const int wanted = s != NULL                       ? s->corners
                           : type == TRIANGLE              ? 3
                           : type == PIXEL || type == QUAD ? 4
                                                           : 0;
        if (type < VERTEX || type > PYRAMID) {
            return input_error(b->in,
                               "cell %lld has type %d; only triangles, strips, polygons, "
                               "quadrilaterals and linear solids (types 1 to 14) are supported",
                               (long long)k, (int)type);
        }
        if (wanted > 0 && at[0] != wanted) {
            return input_error(b->in, "cell %lld of type %d has %d corners, not %d", (long long)k,
                               (int)type, (int)at[0], wanted);
        }
        *n_lines += type <= POLY_LINE;
        *n_solids += s != NULL;
        *n_faces += s != NULL ? (size_t)s->faces : 0;
    }
    return true;
}

/* All faces of solids, sorted. */
static void list_faces(const vtk_grid *g, solid_face *list, size_t n_faces) {
    const sl_int *at = g->cells.at;
    solid_face *next = list;
    for (int64_t k = 0; k < g->n_cells; k++, at += 1 + at[0]) {
        const solid *s = solid_of(g->types.at[k]);
        for (int i = 0; s != NULL && i < s->faces; i++) {
            *next++ = face_of(at + 1, s->face[i], 4);
        }
    }
    qsort(list, n_faces, sizeof *list, by_key);
}

/* Whether the face of a solid, in the order of its corners, is seen from inside. */
static bool is_inward(const mesh_build *b, const sl_int *cell, int corners, const int *face) {
    double x[3][3], center[3] = {0, 0, 0}, volume = 0;
    for (int k = 0; k < corners; k++) {
        for (int d = 0; d < 3; d++) {
            center[d] += b->result.xyz[3 * (size_t)cell[k] + (size_t)d] / corners;
        }
    }
    for (int k = 0; k < 3; k++) {
        for (int d = 0; d < 3; d++) {
            x[k][d] = b->result.xyz[3 * (size_t)cell[face[k]] + (size_t)d] - center[d];
        }
    }
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        volume += x[0][d] * (x[1][e] * x[2][f] - x[1][f] * x[2][e]);
    }
    return volume < 0;
}

/* Adds the faces of a solid that no second cell has. */
static bool add_solid(mesh_build *b, const sl_int *cell, const solid *s, const solid_face *list,
                      size_t n_faces) {
    for (int i = 0; i < s->faces; i++) {
        const int *face = s->face[i], corners = face[3] < 0 ? 3 : 4;
        const solid_face wanted = face_of(cell, face, 4);
        const solid_face *found =
            (const solid_face *)bsearch(&wanted, list, n_faces, sizeof *list, by_key);
        if ((found > list && by_key(found - 1, found) == 0) ||
            (found + 1 < list + n_faces && by_key(found + 1, found) == 0)) {
            continue;
        }
        const bool over = is_inward(b, cell, s->corners, face);
        for (int k = 0; k < corners; k++) {
            if (!mesh_build_corner(b, cell[face[over ? corners - 1 - k : k]])) {
                return false;
            }
        }
        if (!mesh_build_polygon(b)) {
            return false;
        }
    }
    return true;
}

static bool add_flat(mesh_build *b, const sl_int *at, sl_int type) {
    for (sl_int k = 1; k <= at[0]; k++) {
        const sl_int from = type == PIXEL && k > 2 ? 7 - k : k; /* 0 1 3 2 */
        if (!mesh_build_corner(b, at[from])) {
            return false;
        }
    }
    return type == STRIP ? mesh_build_strip(b) : mesh_build_polygon(b);
}

static bool add_cells(mesh_build *b, const vtk_grid *g, const solid_face *list, size_t n_faces) {
    const sl_int *at = g->cells.at;
    int64_t left_out = 0;
    for (int64_t k = 0; k < g->n_cells; k++, at += 1 + at[0]) {
        const sl_int type = g->types.at[k];
        const solid *s = solid_of(type);
        const bool may_be_face = type == TRIANGLE || type == QUAD || type == PIXEL;
        bool ok = true;
        if (s != NULL) {
            ok = add_solid(b, at + 1, s, list, n_faces);
        } else if (may_be_face && n_faces > 0) {
            const solid_face wanted = face_of(at + 1, NULL, (int)at[0]);
            const bool is_of_solid = bsearch(&wanted, list, n_faces, sizeof *list, by_key) != NULL;
            left_out += is_of_solid;
            ok = is_of_solid || add_flat(b, at, type);
        } else if (type >= TRIANGLE) {
            ok = add_flat(b, at, type);
        }
        if (!ok) {
            return false;
        }
    }
    if (left_out > 0) {
        mesh_build_note(b, "%lld faces are those of solid cells, and left out",
                        (long long)left_out);
    }
    return true;
}

bool vtk_grid_add_faces(mesh_build *b, const vtk_grid *g) {
    size_t n_faces = 0;
    int64_t n_lines = 0, n_solids = 0;
    b->in->line = 0;
    if (!check(b, g, &n_faces, &n_lines, &n_solids)) {
        return false;
    }
    solid_face *list = (solid_face *)malloc((n_faces + 1) * sizeof *list);
    if (list == NULL) {
        return input_error(b->in, "out of memory");
    }
    list_faces(g, list, n_faces);
    const bool ok = add_cells(b, g, list, n_faces);
    free(list);
    if (ok && n_solids > 0) {
        mesh_build_note(b, "the surface of %lld solid cells is read", (long long)n_solids);
    }
    if (ok && n_lines > 0) {
        mesh_build_note(b, "%lld cells are points or lines, and ignored", (long long)n_lines);
    }
    return ok;
}

void vtk_grid_free(vtk_grid *g) {
    free(g->cells.at);
    free(g->types.at);
    memset(g, 0, sizeof *g);
}
