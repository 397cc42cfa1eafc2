/* sheet.c: the faces of a mesh as oriented parts, each a manifold with a boundary */
#include "sheet.h"

#include <stdlib.h>
#include <string.h>

#include "edge_sides.h"

void sheet_free(sheet *s) {
    mesh_free(&s->m);
    free(s->corner);
    free(s->vertex);
    free(s->mate);
    free(s->part);
    memset(s, 0, sizeof *s);
}

/* Corner or side k + by of the face of corner or side c. */
static sl_int around(sl_int c, int by) {
    return c - c % 3 + (c + by) % 3;
}

sl_int sheet_from(const sheet *s, sl_int side) {
    return s->m.faces[around(side, 1)];
}

sl_int sheet_to(const sheet *s, sl_int side) {
    return s->m.faces[around(side, 2)];
}

static bool allocate(sheet *s, size_t n_faces) {
    s->m.faces = (sl_int *)malloc((3 * n_faces + 1) * sizeof(sl_int));
    s->corner = (sl_int *)malloc((3 * n_faces + 1) * sizeof(sl_int));
    s->mate = (sl_int *)malloc((3 * n_faces + 1) * sizeof(sl_int));
    s->part = (sl_int *)malloc((n_faces + 1) * sizeof(sl_int));
    return s->m.faces != NULL && s->corner != NULL && s->mate != NULL && s->part != NULL;
}

/* Takes the faces with three different vertices. */
static bool take_faces(sheet *s, const unsigned char *taken) {
    const mesh *w = s->whole;
    if (!allocate(s, (size_t)w->n_faces)) {
        return false;
    }
    s->m.n_vertices = w->n_vertices; /* until they are numbered */
    for (sl_int f = 0; f < w->n_faces; f++) {
        const sl_int *v = w->faces + 3 * (size_t)f;
        const bool repeated = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
        if (taken != NULL && !taken[f]) {
            continue;
        }
        s->left_out += repeated;
        for (sl_int k = 0; k < 3 && !repeated; k++) {
            s->corner[3 * s->m.n_faces + k] = 3 * f + k;
            s->m.faces[3 * s->m.n_faces + k] = v[k];
        }
        s->m.n_faces += !repeated;
    }
    return true;
}

static bool glue(sheet *s) {
    const size_t count = 3 * (size_t)s->m.n_faces;
    edge_side *sides = sorted_sides(&s->m);
    for (size_t k = 0; k < count && sides != NULL;) {
        const size_t end = end_of_edge(sides, k, count);
        const bool is_pair = end - k == 2;
        for (size_t at = k; at < end; at++) {
            s->mate[sides[at].side] = is_pair ? sides[2 * k + 1 - at].side : -1;
        }
        k = end;
    }
    free(sides);
    return sides != NULL;
}

/* Numbers the parts and marks the faces that must be turned over. Neighbors that cannot agree are
 * separated. */
static void walk_parts(sheet *s, unsigned char *turn, sl_int *queue) {
    memset(s->part, -1, (size_t)s->m.n_faces * sizeof *s->part);
    s->n_parts = 0;
    for (sl_int first = 0; first < s->m.n_faces; first++) {
        sl_int head = 0, tail = 0;
        if (s->part[first] >= 0) {
            continue;
        }
        s->part[first] = s->n_parts;
        queue[tail++] = first;
        while (head < tail) {
            const sl_int f = queue[head++];
            for (sl_int side = 3 * f; side < 3 * f + 3; side++) {
                const sl_int other = s->mate[side];
                if (other < 0) {
                    continue;
                }
                const sl_int g = other / 3;
                const unsigned char same = sheet_from(s, side) == sheet_from(s, other);
                if (s->part[g] < 0) {
                    s->part[g] = s->n_parts;
                    turn[g] = turn[f] ^ same;
                    queue[tail++] = g;
                } else if (turn[g] != (turn[f] ^ same)) {
                    s->mate[side] = s->mate[other] = -1;
                }
            }
        }
        s->n_parts++;
    }
}

static void swap(sl_int *a, sl_int *b) {
    const sl_int kept = *a;
    *a = *b;
    *b = kept;
}

/* Turns faces over: corners 1 and 2 change places, and so do the sides opposite to them. */
static void turn_over(sheet *s, const unsigned char *turn) {
    for (sl_int side = 0; side < 3 * s->m.n_faces; side++) {
        const sl_int other = s->mate[side];
        if (other >= 0 && turn[other / 3] && other % 3 > 0) {
            s->mate[side] = other - other % 3 + 3 - other % 3;
        }
    }
    for (sl_int f = 0; f < s->m.n_faces; f++) {
        if (turn[f]) {
            swap(&s->m.faces[3 * f + 1], &s->m.faces[3 * f + 2]);
            swap(&s->corner[3 * f + 1], &s->corner[3 * f + 2]);
            swap(&s->mate[3 * f + 1], &s->mate[3 * f + 2]);
        }
    }
}

static bool orient(sheet *s) {
    unsigned char *turn = (unsigned char *)calloc((size_t)s->m.n_faces + 1, 1);
    sl_int *queue = (sl_int *)malloc(((size_t)s->m.n_faces + 1) * sizeof *queue);
    const bool ok = turn != NULL && queue != NULL;
    if (ok) {
        walk_parts(s, turn, queue);
        turn_over(s, turn);
    }
    free(queue);
    free(turn);
    return ok;
}

/* The corner at the same vertex in the next face, counterclockwise; -1 beyond a boundary. */
static sl_int next_corner(const sheet *s, sl_int corner) {
    const sl_int other = s->mate[around(corner, 1)];
    return other < 0 ? -1 : around(other, 1);
}

/* The same clockwise. */
static sl_int previous_corner(const sheet *s, sl_int corner) {
    const sl_int other = s->mate[around(corner, 2)];
    return other < 0 ? -1 : around(other, 2);
}

bool sheet_renumber(sheet *s) {
    const sl_int corners = 3 * s->m.n_faces;
    const size_t room = (size_t)corners + 1;
    sl_int *vertex = (sl_int *)malloc(room * sizeof *vertex), n = 0;
    double *xyz = (double *)malloc(3 * room * sizeof *xyz);
    if (vertex == NULL || xyz == NULL) {
        free(vertex);
        free(xyz);
        return false;
    }
    memset(s->m.faces, -1, room * sizeof *s->m.faces);
    for (sl_int first = 0; first < corners; first++) {
        if (s->m.faces[first] >= 0) {
            continue;
        }
        vertex[n] = s->whole->faces[s->corner[first]];
        memcpy(xyz + 3 * (size_t)n, s->whole->xyz + 3 * (size_t)vertex[n], 3 * sizeof *xyz);
        for (sl_int c = first; c >= 0 && s->m.faces[c] < 0; c = next_corner(s, c)) {
            s->m.faces[c] = n;
        }
        for (sl_int c = previous_corner(s, first); c >= 0 && s->m.faces[c] < 0;
             c = previous_corner(s, c)) {
            s->m.faces[c] = n;
        }
        n++;
    }
    free(s->vertex);
    free(s->m.xyz);
    s->vertex = vertex;
    s->m.xyz = xyz;
    s->m.n_vertices = n;
    return true;
}

/* Glues two boundary sides that are a loop by themselves: two of the faces of an edge with three or
 * more that are connected all around its ends. */
static void close_slits(sheet *s) {
    for (sl_int side = 0; side < 3 * s->m.n_faces; side++) {
        const sl_int next = s->mate[side] < 0 ? sheet_next_boundary(s, side) : side;
        if (next != side && sheet_next_boundary(s, next) == side) {
            s->mate[side] = next;
            s->mate[next] = side;
        }
    }
}

bool sheet_create(sheet *out, const mesh *whole, const unsigned char *taken) {
    memset(out, 0, sizeof *out);
    out->whole = whole;
    if (!mesh_faces_are_in_range(whole) || whole->n_faces > INT32_MAX / 3 ||
        !take_faces(out, taken) || !glue(out) || !orient(out) || !sheet_renumber(out)) {
        sheet_free(out);
        return false;
    }
    close_slits(out);
    return true;
}

bool sheet_take_part(sheet *out, const sheet *s, sl_int part) {
    const size_t nf = (size_t)s->m.n_faces;
    sl_int *number = (sl_int *)malloc((nf + 1) * sizeof *number), count = 0;
    memset(out, 0, sizeof *out);
    out->whole = s->whole;
    for (sl_int f = 0; f < s->m.n_faces && number != NULL; f++) {
        number[f] = s->part[f] == part ? count++ : -1;
    }
    bool ok = number != NULL && allocate(out, (size_t)count);
    for (size_t side = 0; side < 3 * nf && ok; side++) {
        if (number[side / 3] >= 0) {
            const size_t here = 3 * (size_t)number[side / 3] + side % 3;
            const sl_int other = s->mate[side];
            out->corner[here] = s->corner[side];
            out->mate[here] = other < 0 ? -1 : 3 * number[other / 3] + other % 3;
            out->part[here / 3] = 0;
        }
    }
    out->m.n_faces = ok ? count : 0;
    out->n_parts = 1;
    ok = ok && sheet_renumber(out);
    free(number);
    if (!ok) {
        sheet_free(out);
    }
    return ok;
}

sl_int sheet_next_boundary(const sheet *s, sl_int side) {
    sl_int next = around(side, 1);
    while (s->mate[next] >= 0) {
        next = around(s->mate[next], 1);
    }
    return next;
}

sl_int sheet_boundary(const sheet *s, sl_int *loops, sl_int *begin) {
    const sl_int sides = 3 * s->m.n_faces;
    unsigned char *seen = (unsigned char *)calloc((size_t)sides + 1, 1);
    sl_int count = 0, n_loops = 0;
    if (seen == NULL) {
        return -1;
    }
    for (sl_int first = 0; first < sides; first++) {
        if (s->mate[first] >= 0 || seen[first]) {
            continue;
        }
        begin[n_loops++] = count;
        for (sl_int side = first; !seen[side]; side = sheet_next_boundary(s, side)) {
            seen[side] = 1;
            loops[count++] = sheet_from(s, side);
        }
    }
    begin[n_loops] = count;
    free(seen);
    return n_loops;
}
