/* disk.c: is a part of a mesh a disk? its faces turned to one orientation, its boundary as a loop */
#include "disk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An edge of a face: from corner `from` to corner `to`, as the face stands. */
typedef struct side {
    sl_int low, high; /* its ends by number */
    sl_int face;
    sl_int from;
} side;

typedef struct inspection {
    disk *d;
    side *sides; /* 3 n_faces, sorted: the sides of an edge stand together */
    sl_int *
        next; /* 3 n_faces: the side of the same edge in the other face, -1: none; by 3 face + corner */
    sl_int *work; /* 3 n_faces + n_vertices + 2 */
    char *message;
    size_t message_size;
} inspection;

static int by_edge(const void *a, const void *b) {
    const side *s = (const side *)a, *t = (const side *)b;
    if (s->low != t->low) {
        return s->low < t->low ? -1 : 1;
    }
    if (s->high != t->high) {
        return s->high < t->high ? -1 : 1;
    }
    return (s->face > t->face) - (s->face < t->face);
}

void disk_free(disk *d) {
    part_free(&d->p);
    free(d->boundary);
    memset(d, 0, sizeof *d);
}

static sl_int mesh_vertex(const inspection *q, sl_int v) {
    return q->d->p.vertices[v];
}

static bool refuse(const inspection *q, const char *reason) {
    (void)snprintf(q->message, q->message_size, "the patch is no disk: %s", reason);
    return false;
}

static bool refuse_vertex(const inspection *q, const char *reason, sl_int v) {
    (void)snprintf(q->message, q->message_size, "the patch is no disk: %s vertex %d", reason,
                   (int)mesh_vertex(q, v));
    return false;
}

/* The side of face f that starts at its corner c. */
static sl_int side_from(const inspection *q, sl_int f, sl_int from) {
    const sl_int *face = q->d->p.m.faces + 3 * (size_t)f;
    return 3 * f + (face[0] == from ? 0 : face[1] == from ? 1 : 2);
}

/* Sorts the sides and pairs them up. */
static bool pair_sides(inspection *q) {
    const mesh *m = &q->d->p.m;
    size_t count = 3 * (size_t)m->n_faces;
    for (size_t k = 0; k < count; k++) {
        sl_int u = m->faces[k], v = m->faces[k / 3 * 3 + (k + 1) % 3];
        side s = {u < v ? u : v, u < v ? v : u, (sl_int)(k / 3), u};
        q->sides[k] = s;
        q->next[k] = -1;
    }
    qsort(q->sides, count, sizeof *q->sides, by_edge);
    for (size_t k = 0; k + 1 < count; k++) {
        const side *s = &q->sides[k], *t = s + 1;
        if (s->low != t->low || s->high != t->high) {
            continue;
        }
        if (k + 2 < count && t[1].low == s->low && t[1].high == s->high) {
            (void)snprintf(q->message, q->message_size,
                           "the patch is no disk: three faces at the edge of vertices %d and %d",
                           (int)mesh_vertex(q, s->low), (int)mesh_vertex(q, s->high));
            return false;
        }
        sl_int a = side_from(q, s->face, s->from), b = side_from(q, t->face, t->from);
        q->next[a] = b;
        q->next[b] = a;
    }
    return true;
}

/* Walks over all faces from face 0, and turns them as it comes: +1 as they stand, -1 turned over. */
static bool turn_faces(inspection *q) {
    sl_int n_faces = q->d->p.m.n_faces, found = 1;
    sl_int *queue = q->work, *turn = q->work + n_faces, *faces = q->d->p.m.faces;
    memset(turn, 0, (size_t)n_faces * sizeof *turn);
    queue[0] = 0;
    turn[0] = 1;
    for (sl_int head = 0; head < found; head++) {
        sl_int f = queue[head];
        for (sl_int c = 0; c < 3; c++) {
            sl_int other = q->next[3 * f + c];
            if (other < 0) {
                continue;
            }
            /* sides that run the same way belong to faces that stand differently */
            sl_int wanted = faces[3 * f + c] == faces[other] ? -turn[f] : turn[f];
            if (turn[other / 3] == 0) {
                turn[other / 3] = wanted;
                queue[found++] = other / 3;
            } else if (turn[other / 3] != wanted) {
                return refuse(q, "it has one side only, as a Moebius strip");
            }
        }
    }
    if (found < n_faces) {
        return refuse(q, "its faces are several pieces that share no edge");
    }
    for (sl_int f = 0; f < n_faces; f++) {
        if (turn[f] < 0) { /* sides 0 and 2 change their places: the pairs are not used any more */
            sl_int v = faces[3 * f + 1];
            faces[3 * f + 1] = faces[3 * f + 2];
            faces[3 * f + 2] = v;
        }
    }
    return true;
}

/* A side without a partner runs along the boundary: once a vertex, and one loop in all. */
static bool find_loop(inspection *q, sl_int edges) {
    disk *d = q->d;
    const mesh *m = &d->p.m;
    sl_int *after = q->work, sides = 0, start = -1;
    for (sl_int v = 0; v < m->n_vertices; v++) {
        after[v] = -1;
    }
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        sl_int u = m->faces[k], v = m->faces[k / 3 * 3 + (k + 1) % 3];
        side key = {u < v ? u : v, u < v ? v : u, (sl_int)(k / 3), u};
        const side *s =
            (const side *)bsearch(&key, q->sides, 3 * (size_t)m->n_faces, sizeof key, by_edge);
        bool paired = (s > q->sides && s[-1].low == key.low && s[-1].high == key.high) ||
                      (s + 1 < q->sides + 3 * (size_t)m->n_faces && s[1].low == key.low &&
                       s[1].high == key.high);
        if (paired) {
            continue;
        }
        if (after[u] >= 0) {
            return refuse_vertex(q, "it touches itself at", u);
        }
        after[u] = v;
        start = start < 0 || u < start ? u : start;
        sides++;
    }
    if (sides == 0) {
        return refuse(q, "it is closed, without a boundary");
    }
    d->boundary = (sl_int *)malloc((size_t)sides * sizeof *d->boundary);
    if (d->boundary == NULL) {
        (void)snprintf(q->message, q->message_size, "out of memory");
        return false;
    }
    for (sl_int v = start; d->n_boundary == 0 || v != start; v = after[v]) {
        d->boundary[d->n_boundary++] = v;
    }
    if (d->n_boundary < sides) {
        return refuse(q, "it has more than one boundary, as a ring");
    }
    if (m->n_vertices - edges + m->n_faces != 1) {
        return refuse(q, "it has a handle, or touches itself at a vertex inside");
    }
    return true;
}

static bool inspect(inspection *q) {
    const mesh *m = &q->d->p.m;
    if (m->n_faces == 0) {
        return refuse(q, "no face has all its corners in it");
    }
    memset(q->work, 0, ((size_t)m->n_vertices + 1) * sizeof *q->work);
    for (size_t k = 0; k < 3 * (size_t)m->n_faces; k++) {
        q->work[m->faces[k]] = 1;
    }
    for (sl_int v = 0; v < m->n_vertices; v++) {
        if (!q->work[v]) {
            return refuse_vertex(q, "no face of it is at", v);
        }
    }
    if (!pair_sides(q)) {
        return false;
    }
    sl_int edges = 0;
    for (sl_int k = 0; k < 3 * m->n_faces; k++) {
        edges += q->next[k] < k; /* of a pair the later side counts, and -1 always */
    }
    return turn_faces(q) && find_loop(q, edges);
}

/* Makes the disk of d->p, whose boundary is yet to be found. */
static bool finish(disk *d, char *message, size_t message_size) {
    size_t sides = 3 * (size_t)d->p.m.n_faces;
    inspection q = {d, NULL, NULL, NULL, message, message_size};
    q.sides = (side *)malloc((sides + 1) * sizeof *q.sides);
    q.next = (sl_int *)malloc((sides + 1) * sizeof *q.next);
    q.work = (sl_int *)malloc((sides + (size_t)d->p.m.n_vertices + 2) * sizeof *q.work);
    bool ok = q.sides != NULL && q.next != NULL && q.work != NULL;
    if (ok) {
        ok = inspect(&q);
    } else {
        (void)snprintf(message, message_size, "out of memory");
    }
    free(q.sides);
    free(q.next);
    free(q.work);
    if (!ok) {
        disk_free(d);
    }
    return ok;
}

bool disk_of_list(disk *out, incidence *around, const sl_int *vertices, sl_int count, char *message,
                  size_t message_size) {
    memset(out, 0, sizeof *out);
    return part_span(&out->p, around, vertices, count, message, message_size) &&
           finish(out, message, message_size);
}

bool disk_of_faces(disk *out, incidence *around, const sl_int *vertices, sl_int n_vertices,
                   const sl_int *faces, sl_int n_faces, char *message, size_t message_size) {
    memset(out, 0, sizeof *out);
    if (!part_of_faces(&out->p, around, vertices, n_vertices, faces, n_faces)) {
        (void)snprintf(message, message_size, "out of memory");
        return false;
    }
    return finish(out, message, message_size);
}
