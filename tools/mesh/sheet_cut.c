/* sheet_cut.c: cuts a part of a sheet along short paths until it is a disk, perhaps with holes */
#include "sheet_cut.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "path_heap.h"

/* The edges of a sheet as a graph, and shortest paths in it. An edge is its lower side. */
typedef struct paths {
    const sheet *s;
    sl_int *begin;      /* n + 2 */
    sl_int *edge;       /* those at vertex v are edge[begin[v]] .. edge[begin[v + 1] - 1] */
    double *length;     /* n: of the shortest path from the sources */
    sl_int *via;        /* n: the last edge of that path, -1 at a source */
    unsigned char *cut; /* 3 n_faces: 1 for edges to cut */
} paths;

static bool is_edge(const sheet *s, sl_int side) {
    return s->mate[side] < side; /* also -1 */
}

static double length_of(const sheet *s, sl_int side) {
    const double *a = s->m.xyz + 3 * (size_t)sheet_from(s, side);
    const double *b = s->m.xyz + 3 * (size_t)sheet_to(s, side);
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

static void paths_free(paths *p) {
    free(p->begin);
    free(p->edge);
    free(p->length);
    free(p->via);
    free(p->cut);
    memset(p, 0, sizeof *p);
}

static bool paths_create(paths *p, const sheet *s) {
    const size_t n = (size_t)s->m.n_vertices, sides = 3 * (size_t)s->m.n_faces;
    memset(p, 0, sizeof *p);
    p->s = s;
    p->begin = (sl_int *)calloc(n + 3, sizeof *p->begin);
    p->edge = (sl_int *)malloc((2 * sides + 1) * sizeof *p->edge);
    p->length = (double *)malloc((n + 1) * sizeof *p->length);
    p->via = (sl_int *)malloc((n + 1) * sizeof *p->via);
    p->cut = (unsigned char *)calloc(sides + 1, 1);
    if (p->begin == NULL || p->edge == NULL || p->length == NULL || p->via == NULL ||
        p->cut == NULL) {
        paths_free(p);
        return false;
    }
    for (sl_int e = 0; e < (sl_int)sides; e++) {
        p->begin[sheet_from(s, e) + 2] += is_edge(s, e);
        p->begin[sheet_to(s, e) + 2] += is_edge(s, e);
    }
    for (size_t v = 0; v < n; v++) {
        p->begin[v + 2] += p->begin[v + 1];
    }
    for (sl_int e = 0; e < (sl_int)sides; e++) {
        if (is_edge(s, e)) {
            p->edge[p->begin[sheet_from(s, e) + 1]++] = e;
            p->edge[p->begin[sheet_to(s, e) + 1]++] = e;
        }
    }
    return true;
}

static sl_int other_end(const sheet *s, sl_int edge, sl_int v) {
    return sheet_from(s, edge) == v ? sheet_to(s, edge) : sheet_from(s, edge);
}

/* Shortest paths from the vertices with is_source, or from one vertex. Returns the farthest vertex
 * that is reached; -1: out of memory. */
static sl_int find_paths(paths *p, const unsigned char *is_source, sl_int one) {
    path_heap heap = {NULL, 0, 0};
    sl_int far = -1;
    bool ok = true;
    for (sl_int v = 0; v < p->s->m.n_vertices; v++) {
        const bool here = is_source != NULL ? is_source[v] : v == one;
        p->length[v] = here ? 0 : INFINITY;
        p->via[v] = -1;
        ok = ok && (!here || path_heap_push(&heap, 0, v));
    }
    while (heap.count > 0 && ok) {
        const path_end top = path_heap_pop(&heap);
        const sl_int v = (sl_int)top.point;
        if (top.length > p->length[v]) {
            continue;
        }
        far = v; /* lengths ascend */
        for (sl_int k = p->begin[v]; k < p->begin[v + 1] && ok; k++) {
            const sl_int w = other_end(p->s, p->edge[k], v);
            const double length = top.length + length_of(p->s, p->edge[k]);
            if (length < p->length[w]) {
                p->length[w] = length;
                p->via[w] = p->edge[k];
                ok = path_heap_push(&heap, length, w);
            }
        }
    }
    free(heap.at);
    return ok ? far : -1;
}

/* Marks the path to v. */
static sl_int mark_path(paths *p, sl_int v) {
    sl_int count = 0;
    for (; p->via[v] >= 0; v = other_end(p->s, p->via[v], v)) {
        count += !p->cut[p->via[v]];
        p->cut[p->via[v]] = 1;
    }
    return count;
}

static sl_int root_of(sl_int *parent, sl_int k) {
    while (parent[k] != k) {
        parent[k] = parent[parent[k]];
        k = parent[k];
    }
    return k;
}

/* Takes back the cuts that would divide the sheet: loops are found as if holes were filled, and a
 * loop that passes a hole can have all edges of a few faces beside it. */
static bool keep_whole(paths *p) {
    const sheet *s = p->s;
    sl_int *parent = (sl_int *)malloc(((size_t)s->m.n_faces + 1) * sizeof *parent);
    for (sl_int f = 0; f < s->m.n_faces && parent != NULL; f++) {
        parent[f] = f;
    }
    for (int pass = 0; pass < 2 && parent != NULL; pass++) { /* uncut edges, then the others */
        for (sl_int e = 0; e < 3 * s->m.n_faces; e++) {
            const sl_int a = root_of(parent, e / 3);
            const sl_int b = s->mate[e] >= 0 ? root_of(parent, s->mate[e] / 3) : a;
            const bool is_cut = p->cut[e] || (s->mate[e] >= 0 && p->cut[s->mate[e]]);
            if (a != b && is_cut == (pass == 1)) {
                parent[a] = b;
                p->cut[e] = p->cut[s->mate[e]] = 0;
            }
        }
    }
    free(parent);
    return parent != NULL;
}

/* Separates the marked edges and numbers the vertices anew. */
static bool separate(sheet *s, paths *p, sl_int *edges) {
    if (!keep_whole(p)) {
        return false;
    }
    for (sl_int e = 0; e < 3 * s->m.n_faces; e++) {
        if (p->cut[e] && s->mate[e] >= 0) {
            s->mate[s->mate[e]] = -1;
            s->mate[e] = -1;
            ++*edges;
        }
    }
    return sheet_renumber(s);
}

/* ---- handles ---- */

/* Numbers the holes: hole[side] of boundary sides. Returns how many there are. */
static sl_int number_holes(const sheet *s, sl_int *hole) {
    sl_int count = 0;
    for (sl_int side = 0; side < 3 * s->m.n_faces; side++) {
        hole[side] = -1;
    }
    for (sl_int side = 0; side < 3 * s->m.n_faces; side++) {
        if (s->mate[side] >= 0 || hole[side] >= 0) {
            continue;
        }
        for (sl_int at = side; hole[at] < 0; at = sheet_next_boundary(s, at)) {
            hole[at] = count;
        }
        count++;
    }
    return count;
}

static int longest_first(const void *a, const void *b) {
    const path_end *x = (const path_end *)a, *y = (const path_end *)b;
    return x->length != y->length ? (x->length > y->length ? -1 : 1)
                                  : (x->point > y->point) - (x->point < y->point);
}

/* Marks the loops that are closed by edges neither in the tree of paths nor crossed by the dual
 * tree, which takes the edges of long loops first. Nodes of the dual tree: faces, then holes. */
static void mark_loops(paths *p, const sl_int *hole, sl_int *parent, path_end *rest) {
    const sheet *s = p->s;
    const sl_int sides = 3 * s->m.n_faces;
    size_t count = 0;
    for (sl_int e = 0; e < sides; e++) {
        const sl_int u = sheet_from(s, e), v = sheet_to(s, e);
        if (is_edge(s, e) && p->via[u] != e && p->via[v] != e) {
            const path_end loop = {p->length[u] + p->length[v] + length_of(s, e), e};
            rest[count++] = loop;
        }
    }
    qsort(rest, count, sizeof *rest, longest_first);
    for (size_t k = 0; k < count; k++) {
        const sl_int e = (sl_int)rest[k].point;
        const sl_int a = root_of(parent, e / 3);
        const sl_int b = root_of(parent, s->mate[e] >= 0 ? s->mate[e] / 3 : s->m.n_faces + hole[e]);
        if (a != b) {
            parent[a] = b;
        } else {
            p->cut[e] = 1;
            (void)mark_path(p, sheet_from(s, e));
            (void)mark_path(p, sheet_to(s, e));
        }
    }
}

/* Takes back cuts that end at a vertex inside: the common way of loops to their root. */
static void prune(paths *p, const unsigned char *on_boundary) {
    const sheet *s = p->s;
    for (sl_int first = 0; first < s->m.n_vertices; first++) {
        for (sl_int v = first; v >= 0 && !on_boundary[v];) {
            sl_int count = 0, last = -1;
            for (sl_int k = p->begin[v]; k < p->begin[v + 1]; k++) {
                count += p->cut[p->edge[k]];
                last = p->cut[p->edge[k]] ? p->edge[k] : last;
            }
            if (count != 1) {
                break;
            }
            p->cut[last] = 0;
            v = other_end(s, last, v);
        }
    }
}

static bool cut_handles(paths *p, const sl_int *hole, sl_int n_holes,
                        const unsigned char *on_boundary) {
    const size_t nodes = (size_t)p->s->m.n_faces + (size_t)n_holes;
    sl_int *parent = (sl_int *)malloc((nodes + 1) * sizeof *parent);
    path_end *rest = (path_end *)malloc((3 * (size_t)p->s->m.n_faces + 1) * sizeof *rest);
    const bool ok = parent != NULL && rest != NULL && find_paths(p, NULL, 0) >= 0;
    for (size_t k = 0; k < nodes && ok; k++) {
        parent[k] = (sl_int)k;
    }
    if (ok) {
        mark_loops(p, hole, parent, rest);
        prune(p, on_boundary);
    }
    free(rest);
    free(parent);
    return ok;
}

/* ---- spheres, and all together ---- */

/* Marks a path between two vertices far apart, of two edges at least. */
static bool cut_sphere(paths *p) {
    sl_int from = find_paths(p, NULL, 0);
    const sl_int to = from >= 0 ? find_paths(p, NULL, from) : -1;
    if (to < 0) {
        return false;
    }
    if (mark_path(p, to) < 2) {
        for (sl_int k = p->begin[to]; k < p->begin[to + 1]; k++) {
            if (other_end(p->s, p->edge[k], to) != from) {
                p->cut[p->edge[k]] = 1;
                break;
            }
        }
    }
    return true;
}

bool sheet_open(sheet *s, sl_int *edges) {
    paths p;
    const sl_int sides = 3 * s->m.n_faces;
    sl_int *hole = (sl_int *)malloc(((size_t)sides + 1) * sizeof *hole), n_edges = 0;
    unsigned char *on_boundary = (unsigned char *)calloc((size_t)s->m.n_vertices + 1, 1);
    *edges = 0;
    if (!paths_create(&p, s) || hole == NULL || on_boundary == NULL) {
        paths_free(&p);
        free(hole);
        free(on_boundary);
        return false;
    }
    for (sl_int e = 0; e < sides; e++) {
        n_edges += is_edge(s, e);
        on_boundary[sheet_from(s, e)] |= s->mate[e] < 0;
    }
    const sl_int n_holes = number_holes(s, hole);
    const sl_int euler = s->m.n_vertices - n_edges + s->m.n_faces;
    bool ok = true;
    if (euler + n_holes < 2) {
        ok = cut_handles(&p, hole, n_holes, on_boundary) && separate(s, &p, edges);
    } else if (n_holes == 0) {
        ok = cut_sphere(&p) && separate(s, &p, edges);
    }
    paths_free(&p);
    free(hole);
    free(on_boundary);
    return ok;
}

bool sheet_cut_to(sheet *s, sl_int vertex, sl_int *edges) {
    paths p;
    unsigned char *on_boundary = (unsigned char *)calloc((size_t)s->m.n_vertices + 1, 1);
    *edges = 0;
    bool ok = paths_create(&p, s) && on_boundary != NULL;
    for (sl_int e = 0; e < 3 * s->m.n_faces && ok; e++) {
        on_boundary[sheet_from(s, e)] |= s->mate[e] < 0;
    }
    ok = ok && find_paths(&p, on_boundary, -1) >= 0;
    if (ok) {
        (void)mark_path(&p, vertex);
        ok = separate(s, &p, edges);
    }
    paths_free(&p);
    free(on_boundary);
    return ok;
}
