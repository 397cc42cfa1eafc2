/* mesh_stats.c: counts and measures of a triangle mesh: components, boundary, defects, angles */
#include "mesh_stats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A side of a face, from one corner to the next. All sides between the same two vertices form an
 * edge. */
typedef struct side {
    sl_int low, high;
    bool forward; /* runs from low to high */
} side;

static int by_ends(const void *a, const void *b) {
    const side *x = (const side *)a, *y = (const side *)b;
    if (x->low != y->low) {
        return x->low < y->low ? -1 : 1;
    }
    return x->high < y->high ? -1 : x->high > y->high;
}

/* Union-find with path halving. Tarjan, van Leeuwen: Worst-case analysis of set union algorithms,
 * 1984. */
static size_t root_of(size_t *parent, size_t k) {
    while (parent[k] != k) {
        parent[k] = parent[parent[k]];
        k = parent[k];
    }
    return k;
}

static void join(size_t *parent, size_t a, size_t b) {
    parent[root_of(parent, a)] = root_of(parent, b);
}

/* The number of classes with a marked root. */
static sl_int count_roots(size_t *parent, const unsigned char *marked, size_t n) {
    sl_int count = 0;
    for (size_t k = 0; k < n; k++) {
        count += marked[k] && root_of(parent, k) == k;
    }
    return count;
}

static const double *position(const mesh *m, sl_int v) {
    return m->xyz + 3 * (size_t)v;
}

static double distance(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Groups the sorted sides into edges. Union-find over the vertices counts the boundary loops. */
static bool measure_edges(mesh_stats *f, const mesh *m, size_t *parent, unsigned char *marked) {
    size_t count = 0, n = (size_t)m->n_vertices;
    side *sides = (side *)malloc((3 * (size_t)m->n_faces + 1) * sizeof *sides);
    if (sides == NULL) {
        return false;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        sl_int a = m->faces[k], b = m->faces[k % 3 == 2 ? k - 2 : k + 1];
        if (a != b) {
            side s = {a < b ? a : b, a < b ? b : a, a < b};
            sides[count++] = s;
        }
    }
    qsort(sides, count, sizeof *sides, by_ends);
    for (size_t v = 0; v < n; v++) {
        parent[v] = v;
        marked[v] = 0;
    }
    double sum = 0;
    f->edge_min = HUGE_VAL;
    for (size_t k = 0, end; k < count; k = end) {
        for (end = k + 1; end < count && by_ends(&sides[k], &sides[end]) == 0;) {
            end++;
        }
        double length = distance(position(m, sides[k].low), position(m, sides[k].high));
        sum += length;
        f->edge_min = fmin(f->edge_min, length);
        f->edge_max = fmax(f->edge_max, length);
        f->edges++;
        f->nonmanifold_edges += end - k > 2;
        f->inconsistent_edges += end - k == 2 && sides[k].forward == sides[k + 1].forward;
        if (end - k == 1) {
            f->boundary_edges++;
            marked[sides[k].low] = marked[sides[k].high] = 1;
            join(parent, (size_t)sides[k].low, (size_t)sides[k].high);
        }
    }
    f->boundary_loops = count_roots(parent, marked, n);
    f->edge_mean = f->edges > 0 ? sum / (double)f->edges : 0;
    f->edge_min = f->edges > 0 ? f->edge_min : 0;
    free(sides);
    return true;
}

/* An edge as seen from its end `at`, in one face. */
typedef struct spoke {
    sl_int at, other;
    size_t corner; /* the corner of the face at `at`, 3 face + 0..2 */
} spoke;

static int by_spoke(const void *a, const void *b) {
    const spoke *x = (const spoke *)a, *y = (const spoke *)b;
    if (x->at != y->at) {
        return x->at < y->at ? -1 : 1;
    }
    return x->other < y->other ? -1 : x->other > y->other;
}

/* Counts components and non-manifold vertices. Two corners at a vertex belong to the same fan if
 * their faces share an edge there; a vertex with more than one fan is not manifold. */
static bool measure_vertices(mesh_stats *f, const mesh *m, size_t *parent, unsigned char *marked) {
    size_t corners = 3 * (size_t)m->n_faces, n = (size_t)m->n_vertices;
    spoke *spokes = (spoke *)malloc((2 * corners + 1) * sizeof *spokes);
    size_t *fan = (size_t *)malloc((corners + 1) * sizeof *fan);
    sl_int *fans = (sl_int *)calloc(n + 1, sizeof *fans);
    bool ok = spokes != NULL && fan != NULL && fans != NULL;
    for (size_t v = 0; ok && v < n; v++) {
        parent[v] = v;
        marked[v] = 0;
    }
    for (size_t k = 0; ok && k < corners; k++) {
        size_t first = k - k % 3;
        fan[k] = k;
        marked[m->faces[k]] = 1;
        join(parent, (size_t)m->faces[k], (size_t)m->faces[first]);
        for (size_t end = 0; end < 2; end++) {
            spoke s = {m->faces[k], m->faces[first + (k - first + 1 + end) % 3], k};
            spokes[2 * k + end] = s;
        }
    }
    if (ok) {
        qsort(spokes, 2 * corners, sizeof *spokes, by_spoke);
        for (size_t k = 1; k < 2 * corners; k++) {
            if (by_spoke(&spokes[k - 1], &spokes[k]) == 0) {
                join(fan, spokes[k - 1].corner, spokes[k].corner);
            }
        }
        for (size_t k = 0; k < corners; k++) {
            fans[m->faces[k]] += root_of(fan, k) == k;
        }
        for (size_t v = 0; v < n; v++) {
            f->nonmanifold_vertices += fans[v] > 1;
            f->used_vertices += marked[v];
        }
        f->components = count_roots(parent, marked, n);
    }
    free(fans);
    free(fan);
    free(spokes);
    return ok;
}

/* The angle at a, in degrees. */
static double angle(const double *a, const double *b, const double *c) {
    double u[3], v[3], n[3];
    for (int d = 0; d < 3; d++) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
    }
    for (int d = 0; d < 3; d++) {
        n[d] = u[(d + 1) % 3] * v[(d + 2) % 3] - u[(d + 2) % 3] * v[(d + 1) % 3];
    }
    double sine = hypot(hypot(n[0], n[1]), n[2]);
    return atan2(sine, u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) * 180 / 3.14159265358979323846;
}

static double face_area(const double *a, const double *b, const double *c) {
    double x = angle(a, b, c) * 3.14159265358979323846 / 180;
    return 0.5 * distance(a, b) * distance(a, c) * sin(x);
}

static void measure_faces(mesh_stats *f, const mesh *m) {
    f->angle_min = HUGE_VAL;
    f->angle_max = -HUGE_VAL;
    for (size_t k = 0; k < (size_t)m->n_faces; k++) {
        const sl_int *v = m->faces + 3 * k;
        const double *x[3] = {position(m, v[0]), position(m, v[1]), position(m, v[2])};
        bool twice = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
        double area = twice ? 0 : face_area(x[0], x[1], x[2]);
        f->repeated_vertex_faces += twice;
        f->zero_area_faces += !twice && !(area > 0);
        f->area += area;
        for (int c = 0; c < 3; c++) {
            if (area > 0) {
                double here = angle(x[c], x[(c + 1) % 3], x[(c + 2) % 3]);
                f->angle_min = fmin(f->angle_min, here);
                f->angle_max = fmax(f->angle_max, here);
            }
            for (int d = 0; d < 3; d++) {
                f->box_min[d] = fmin(f->box_min[d], x[c][d]);
                f->box_max[d] = fmax(f->box_max[d], x[c][d]);
            }
        }
    }
    if (!(f->angle_min <= f->angle_max)) {
        f->angle_min = f->angle_max = NAN;
    }
}

bool mesh_stats_compute(mesh_stats *out, const mesh *m) {
    memset(out, 0, sizeof *out);
    if (!mesh_faces_are_in_range(m)) {
        return false;
    }
    for (int d = 0; d < 3; d++) {
        out->box_min[d] = m->n_faces > 0 ? HUGE_VAL : 0;
        out->box_max[d] = m->n_faces > 0 ? -HUGE_VAL : 0;
    }
    size_t n = (size_t)m->n_vertices;
    size_t *parent = (size_t *)malloc((n + 1) * sizeof *parent);
    unsigned char *marked = (unsigned char *)malloc(n + 1);
    bool ok = parent != NULL && marked != NULL && measure_edges(out, m, parent, marked) &&
              measure_vertices(out, m, parent, marked);
    if (ok) {
        measure_faces(out, m);
        out->euler = (sl_off)out->used_vertices - out->edges + m->n_faces;
    }
    free(marked);
    free(parent);
    return ok;
}
