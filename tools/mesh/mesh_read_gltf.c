/* mesh_read_gltf.c: reads the triangles of all meshes in the scene of a glTF 2 file */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_file.h"
#include "mesh_build.h"

/* Nodes may repeat meshes. A file that asks for more elements than this for each of its bytes is
 * refused before memory runs out. */
enum { ELEMENTS_PER_BYTE = 64 };

/* Modes of primitives. */
enum { TRIANGLES = 4, STRIP = 5, FAN = 6 };

/* A vector x is placed at a[0] x_0 + a[1] x_1 + a[2] x_2 + a[3]. */
typedef struct placement {
    double a[4][3];
    bool is_identity;
} placement;

typedef struct gltf {
    gltf_file file;
    mesh_build *b;
    bool keeps_vertices; /* written by this program: vertices are not merged */
    bool *visited;       /* of the nodes */
    sl_int merged;
    int64_t others; /* primitives that are points or lines */
    int64_t primitives, textured, with_normals,
        colored; /* of triangles, and those that have these */
    /* the positions that the primitives of the current mesh have added: shared ones once */
    int64_t last_accessor;
    sl_int last_first;
} gltf;

static const cJSON *member(const cJSON *object, const char *name) {
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

static placement combine(const placement *outer, const placement *inner) {
    placement p = *outer;
    if (outer->is_identity) {
        return *inner;
    }
    for (int c = 0; c < 4; c++) {
        for (int d = 0; d < 3; d++) {
            p.a[c][d] = c == 3 ? outer->a[3][d] : 0;
            for (int k = 0; k < 3; k++) {
                p.a[c][d] += outer->a[k][d] * inner->a[c][k];
            }
        }
    }
    return p;
}

/* Whether the placement turns the surface inside out: triangles are then turned over. */
static bool is_reflection(const placement *p) {
    const double *x = p->a[0], *y = p->a[1], *z = p->a[2];
    return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
               x[2] * (y[0] * z[1] - y[1] * z[0]) <
           0;
}

/* The placement of a node in its parent: a matrix, or translation, rotation and scale. */
static bool read_placement(const gltf_file *f, int64_t node, placement *p) {
    const cJSON *object = f->nodes.item[node];
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (!gltf_numbers(f, object, "matrix", 16, "node", node, m) ||
        !gltf_numbers(f, object, "translation", 3, "node", node, t) ||
        !gltf_numbers(f, object, "rotation", 4, "node", node, q) ||
        !gltf_numbers(f, object, "scale", 3, "node", node, s)) {
        return false;
    }
    const bool has_matrix = member(object, "matrix") != NULL;
    p->is_identity = !has_matrix && member(object, "translation") == NULL &&
                     member(object, "rotation") == NULL && member(object, "scale") == NULL;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                            {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                            {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
    for (int c = 0; c < 4; c++) {
        for (int d = 0; d < 3; d++) {
            p->a[c][d] = has_matrix ? m[4 * c + d] : c == 3 ? t[d] : r[c][d] * s[c];
        }
    }
    return true;
}

/* Adds the positions of an accessor; `first`: the number of the first vertex. */
static bool add_positions(gltf *g, int64_t number, const placement *p, sl_int *first) {
    gltf_accessor a;
    if (number == g->last_accessor) {
        *first = g->last_first;
        return true;
    }
    if (!gltf_accessor_open(&g->file, &a, number)) {
        return false;
    }
    if (a.width != 3) {
        return input_error(g->b->in, "accessor %lld: positions are not VEC3", (long long)number);
    }
    *first = g->b->result.n_vertices;
    for (int64_t v = 0; v < a.count; v++) {
        double x[3], y[3];
        for (int d = 0; d < 3; d++) {
            x[d] = gltf_value(&a, v, d);
        }
        for (int d = 0; d < 3; d++) {
            y[d] = p->is_identity
                       ? x[d]
                       : p->a[0][d] * x[0] + p->a[1][d] * x[1] + p->a[2][d] * x[2] + p->a[3][d];
        }
        if (!mesh_build_vertex(g->b, y[0], y[1], y[2])) {
            return false;
        }
    }
    g->last_accessor = number;
    g->last_first = *first;
    return true;
}

/* Where the corners of a primitive are: those of an accessor, or all vertices in their order. */
typedef struct corners {
    gltf_accessor a;
    bool is_indexed;
    int64_t count;
    sl_int first;     /* the number of vertex 0 of the primitive */
    int64_t vertices; /* of the primitive */
} corners;

static bool add_corner(gltf *g, const corners *c, int64_t k) {
    const double v = c->is_indexed ? gltf_value(&c->a, k, 0) : (double)k;
    if (!(v >= 0 && v < (double)c->vertices)) {
        return input_error(g->b->in,
                           "face %lld: vertex %.0f (counted from 0) is out of range: the "
                           "primitive has %lld vertices",
                           (long long)g->b->polygons, v, (long long)c->vertices);
    }
    return mesh_build_corner(g->b, (int64_t)c->first + (int64_t)v);
}

/* Adds the triangle of three corners, in the other orientation if it is turned over. */
static bool add_triangle(gltf *g, const corners *c, const int64_t k[3], bool over) {
    return add_corner(g, c, k[0]) && add_corner(g, c, k[over ? 2 : 1]) &&
           add_corner(g, c, k[over ? 1 : 2]) && mesh_build_polygon(g->b);
}

static bool has_equal_corners(const corners *c, const int64_t k[3]) {
    double v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = c->is_indexed ? gltf_value(&c->a, k[i], 0) : (double)k[i];
    }
    return v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
}

static bool add_triangles(gltf *g, const corners *c, int64_t mode, bool over) {
    if (mode == TRIANGLES && c->count % 3 != 0) {
        return input_error(g->b->in, "a primitive of triangles has %lld corners",
                           (long long)c->count);
    }
    for (int64_t k = 2; k < c->count; k += mode == TRIANGLES ? 3 : 1) {
        /* of a strip, triangles with an equal pair of corners join parts of it */
        const int64_t triangle[3] = {mode == FAN ? 0 : k - 2, k - 1, k};
        const bool turned = over != (mode == STRIP && k % 2 == 1);
        if ((mode != STRIP || !has_equal_corners(c, triangle)) &&
            !add_triangle(g, c, triangle, turned)) {
            return false;
        }
    }
    return true;
}

/* Adds a primitive of mesh `number`. */
static bool add_primitive(gltf *g, const cJSON *primitive, int64_t number, const placement *p) {
    gltf_file *f = &g->file;
    const cJSON *attributes = member(primitive, "attributes");
    int64_t mode = TRIANGLES, positions = -1, indices = -1;
    corners c;
    memset(&c, 0, sizeof c);
    if (!gltf_integer(f, primitive, "mode", 7, "a primitive of mesh", number, &mode) ||
        !gltf_integer(f, primitive, "indices", f->accessors.count, "a primitive of mesh", number,
                      &indices) ||
        !gltf_integer(f, attributes, "POSITION", f->accessors.count, "a primitive of mesh", number,
                      &positions)) {
        return false;
    }
    mode = mode < 0 ? TRIANGLES : mode;
    if (mode < TRIANGLES || positions < 0) {
        g->others++;
        return true;
    }
    g->primitives++;
    g->textured += member(attributes, "TEXCOORD_0") != NULL;
    g->with_normals += member(attributes, "NORMAL") != NULL;
    g->colored += member(attributes, "COLOR_0") != NULL;
    if (!add_positions(g, positions, p, &c.first)) {
        return false;
    }
    c.vertices = g->b->result.n_vertices - c.first;
    c.count = c.vertices;
    c.is_indexed = indices >= 0;
    if (c.is_indexed) {
        if (!gltf_accessor_open(f, &c.a, indices)) {
            return false;
        }
        if (c.a.width != 1 || c.a.type == SCALAR_FLOAT) {
            return input_error(g->b->in, "accessor %lld: indices are not integers",
                               (long long)indices);
        }
        c.count = c.a.count;
    }
    return add_triangles(g, &c, mode, is_reflection(p));
}

/* Adds a mesh at a place and merges its vertices with equal coordinates: files repeat vertices
 * where normals, colors or texture coordinates differ. */
static bool add_mesh(gltf *g, int64_t number, const placement *p) {
    const int64_t bytes = (g->b->in->end - g->b->in->data) + g->file.loaded;
    const sl_int vertex = g->b->result.n_vertices, face = g->b->result.n_faces;
    gltf_list primitives;
    bool ok = gltf_list_open(&g->file, &primitives, g->file.meshes.item[number], "primitives");
    g->last_accessor = -1;
    for (int64_t k = 0; k < primitives.count && ok; k++) {
        ok = add_primitive(g, primitives.item[k], number, p);
        if (ok &&
            ((int64_t)g->b->result.n_vertices + g->b->result.n_faces) / ELEMENTS_PER_BYTE > bytes) {
            ok = input_error(g->b->in,
                             "nodes repeat meshes too often: more than %d elements for "
                             "each byte",
                             (int)ELEMENTS_PER_BYTE);
        }
    }
    free((void *)primitives.item);
    const sl_int before = g->b->result.n_vertices;
    ok = ok && (g->keeps_vertices || mesh_build_weld(g->b, vertex, face));
    g->merged += before - g->b->result.n_vertices;
    return ok;
}

/* A node that waits for its turn, with the placement of its parent. */
typedef struct waiting {
    int64_t node;
    placement parent;
} waiting;

/* A stack of nodes: each node enters it once at most. */
typedef struct waiting_nodes {
    waiting *at; /* room for all nodes */
    int64_t count;
} waiting_nodes;

/* Puts the nodes of an array on the stack, the first on top. */
static bool push_nodes(gltf *g, waiting_nodes *w, const cJSON *array, const placement *parent) {
    const int64_t before = w->count;
    if (array != NULL && !cJSON_IsArray(array)) {
        return input_error(g->b->in, "nodes or children are not an array");
    }
    for (const cJSON *e = array != NULL ? array->child : NULL; e != NULL; e = e->next) {
        const double node = cJSON_IsNumber(e) ? e->valuedouble : -1;
        if (!(node >= 0 && node < (double)g->file.nodes.count && node == floor(node))) {
            return input_error(g->b->in, "an element of nodes or children is not a node");
        }
        if (g->visited[(int64_t)node]) {
            return input_error(g->b->in, "node %.0f is used twice", node);
        }
        g->visited[(int64_t)node] = true;
        w->at[w->count].node = (int64_t)node;
        w->at[w->count++].parent = *parent;
    }
    for (int64_t k = before, last = w->count - 1; k < last; k++, last--) {
        const waiting swapped = w->at[k];
        w->at[k] = w->at[last];
        w->at[last] = swapped;
    }
    return true;
}

/* The meshes of all nodes below those on the stack, parents first. */
static bool add_nodes(gltf *g, waiting_nodes *w) {
    while (w->count > 0) {
        const waiting next = w->at[--w->count];
        const cJSON *node = g->file.nodes.item[next.node];
        placement own;
        int64_t number = -1;
        if (!read_placement(&g->file, next.node, &own) ||
            !gltf_integer(&g->file, node, "mesh", g->file.meshes.count, "node", next.node,
                          &number)) {
            return false;
        }
        own = combine(&next.parent, &own);
        if ((number >= 0 && !add_mesh(g, number, &own)) ||
            !push_nodes(g, w, member(node, "children"), &own)) {
            return false;
        }
    }
    return true;
}

/* Puts the roots on the stack: those of the scene, or without scenes the nodes without a parent. */
static bool push_roots(gltf *g, waiting_nodes *w, const placement *here) {
    gltf_file *f = &g->file;
    int64_t scene = -1;
    if (!gltf_integer(f, f->root, "scene", f->scenes.count, "document", 0, &scene)) {
        return false;
    }
    if (f->scenes.count > 0) {
        scene = scene < 0 ? 0 : scene;
        if (f->scenes.count > 1) {
            mesh_build_note(g->b, "has %lld scenes; scene %lld is read", (long long)f->scenes.count,
                            (long long)scene);
        }
        return push_nodes(g, w, member(f->scenes.item[scene], "nodes"), here);
    }
    for (int64_t k = 0; k < f->nodes.count; k++) { /* mark the children */
        const cJSON *children = member(f->nodes.item[k], "children");
        for (const cJSON *e = children != NULL ? children->child : NULL; e; e = e->next) {
            if (cJSON_IsNumber(e) && e->valuedouble >= 0 &&
                e->valuedouble < (double)f->nodes.count) {
                g->visited[(int64_t)e->valuedouble] = true;
            }
        }
    }
    for (int64_t k = f->nodes.count - 1; k >= 0; k--) {
        if (!g->visited[k]) {
            w->at[w->count].node = k;
            w->at[w->count++].parent = *here;
        }
    }
    for (int64_t k = 0; k < f->nodes.count; k++) {
        g->visited[k] = false;
    }
    for (int64_t k = 0; k < w->count; k++) {
        g->visited[w->at[k].node] = true;
    }
    return true;
}

static bool add_scene(gltf *g) {
    const placement here = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}, true};
    const size_t room = (size_t)g->file.nodes.count + 1;
    waiting_nodes w = {(waiting *)malloc(room * sizeof *w.at), 0};
    g->visited = (bool *)calloc(room, sizeof *g->visited);
    bool ok = (w.at != NULL && g->visited != NULL) || input_error(g->b->in, "out of memory");
    ok = ok && push_roots(g, &w, &here) && add_nodes(g, &w);
    for (int64_t k = 0; k < g->file.meshes.count && g->file.nodes.count == 0 && ok; k++) {
        ok = add_mesh(g, k, &here); /* a file without nodes */
    }
    free(g->visited);
    free(w.at);
    return ok;
}

bool mesh_read_gltf(mesh_build *b) {
    gltf g;
    memset(&g, 0, sizeof g);
    g.b = b;
    bool ok = gltf_open(&g.file, b->in);
    if (ok) {
        const cJSON *maker = member(member(g.file.root, "asset"), "generator");
        g.keeps_vertices = cJSON_IsString(maker) && strcmp(maker->valuestring, "sparse-local") == 0;
        ok = add_scene(&g);
    }
    if (ok && g.primitives > 1) {
        mesh_build_leave(b, "the division into %lld primitives", (long long)g.primitives);
    }
    if (ok && member(g.file.root, "materials") != NULL) {
        mesh_build_leave(b, "materials");
    }
    if (ok && g.textured > 0) {
        mesh_build_leave(b, "texture coordinates");
    }
    if (ok && g.with_normals > 0) {
        mesh_build_leave(b, "normals");
    }
    if (ok && g.colored > 0) {
        mesh_build_leave(b, "colors");
    }
    if (ok && g.others > 0) {
        mesh_build_note(b, "%lld primitives are points or lines, and ignored", (long long)g.others);
    }
    if (ok && g.merged > 0) {
        mesh_build_note(b,
                        "%d vertices had the coordinates of others of their mesh and were "
                        "merged with them",
                        (int)g.merged);
    }
    gltf_close(&g.file);
    return ok;
}
