/* remesh_patch.c: remeshes patches of a mesh, and numbers what remains */
#include <stdlib.h>
#include <string.h>

#include "edge_sides.h"
#include "remesh.h"

/* xorshift64*; [0, below) */
static sl_int random_below(uint64_t *state, sl_int below) {
    *state ^= *state >> 12;
    *state ^= *state << 25;
    *state ^= *state >> 27;
    return (sl_int)((*state * 2685821657736338717u >> 33) % (uint64_t)below);
}

/* The next side that begins at the same vertex, also past the border; `start` ends the round. */
static sl_int next_side(const remesh *r, sl_int s, sl_int start) {
    const sl_int next = r->faces.twin[side_after(side_after(s))];
    if (next >= 0) {
        return next == start ? -1 : next;
    }
    for (s = start; r->faces.twin[s] >= 0;) { /* backwards to the border */
        s = side_after(r->faces.twin[s]);
    }
    return s == start ? -1 : s;
}

sl_int remesh_patch(const remesh *r, sl_int center, sl_int count, sl_int *vertices,
                    unsigned char *seen) {
    sl_int head, tail = 0;
    if (count > 0 && r->side[center] >= 0) {
        vertices[tail++] = center;
        seen[center] = 1;
    }
    for (head = 0; head < tail; head++) {
        const sl_int start = r->side[vertices[head]];
        int rounds = 0;
        for (sl_int s = start; s >= 0 && tail < count && rounds < 64; rounds++) {
            const sl_int f = s / 3;
            for (sl_int k = 3 * f; k < 3 * f + 3 && tail < count; k++) {
                const sl_int v = r->faces.m.faces[k];
                if (!seen[v]) {
                    seen[v] = 1;
                    vertices[tail++] = v;
                }
            }
            s = next_side(r, s, start);
        }
    }
    for (head = 0; head < tail; head++) {
        seen[vertices[head]] = 0;
    }
    return tail;
}

static sl_int distance_from_6(sl_int valence) {
    return valence < 6 ? 6 - valence : valence - 6;
}

/* Flips a side if the valences of the four vertices around it are then closer to 6. */
static sl_int even_out(remesh *r, sl_int side) {
    sl_int corners[4], before = 0, after = 0;
    if (r->faces.m.faces[side] < 0 || !edge_flips_corners(corners, &r->faces, side)) {
        return 0;
    }
    for (int k = 0; k < 4; k++) {
        const sl_int valence = r->valence[corners[k]];
        before += distance_from_6(valence);
        after += distance_from_6(valence + (k < 2 ? -1 : 1));
    }
    return after < before ? remesh_flip(r, side) : 0;
}

/* A side of a vertex, that of the face at random; -1: the vertex was removed. */
static sl_int random_side(const remesh *r, sl_int v, uint64_t *random) {
    sl_int s = r->side[v];
    for (sl_int k = random_below(random, 6); s >= 0 && k > 0; k--) {
        const sl_int next = r->faces.twin[side_after(side_after(s))];
        s = next < 0 ? s : next;
    }
    return s;
}

sl_int remesh_vertices(remesh *r, const sl_int *vertices, sl_int count, uint64_t *random) {
    sl_int changes = 0;
    for (sl_int k = 0; k < count; k++) {
        const sl_int s = random_side(r, vertices[k], random), way = random_below(random, 3);
        if (s >= 0) {
            changes += way == 0 ? remesh_split(r, s) : way == 1 ? remesh_collapse(r, s) : 0;
        }
    }
    for (sl_int k = 0; k < 2 * count; k++) {
        const sl_int v = vertices[k % count], start = r->side[v];
        for (sl_int s = start, rounds = 0; s >= 0 && rounds < 12; rounds++) {
            const sl_int flipped = even_out(r, side_after(s)) + even_out(r, s);
            changes += flipped;
            s = flipped > 0 || r->side[v] != start ? -1 : next_side(r, s, start);
        }
    }
    return changes;
}

/* Moves the faces that are left to the front. */
static void compact_faces(remesh *r, const sl_int *new_of) {
    mesh *m = &r->faces.m;
    sl_int count = 0;
    sl_int *corners = m->faces, *twin = r->faces.twin;
    for (sl_int f = 0; f < m->n_faces; f++) {
        if (corners[3 * f] < 0) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            const sl_int from = 3 * f + k, to = 3 * count + k, other = twin[from];
            corners[to] = new_of[corners[from]];
            twin[to] = other;
            if (other >= 0) { /* later ones are still where they were, earlier ones are moved */
                twin[other] = to;
            }
        }
        count++;
    }
    m->n_faces = count;
}

void remesh_compact(remesh *r, sl_int *new_of) {
    mesh *m = &r->faces.m;
    sl_int count = 0;
    for (sl_int v = 0; v < m->n_vertices; v++) {
        const int stays = r->side[v] >= 0 || r->valence[v] > 0;
        new_of[v] = stays ? count : -1;
        if (stays) {
            memmove(m->xyz + 3 * (size_t)count, m->xyz + 3 * (size_t)v, 3 * sizeof(double));
            r->valence[count++] = r->valence[v];
        }
    }
    m->n_vertices = count;
    compact_faces(r, new_of);
    memset(r->side, 0xff, (size_t)count * sizeof(sl_int)); /* -1 */
    for (sl_int s = 0; s < 3 * m->n_faces; s++) {
        r->side[m->faces[side_after(s)]] = s;
    }
}
