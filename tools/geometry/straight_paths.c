/* straight_paths.c: straightens paths over the faces within the triangles that they cross */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "surface_search.h"

/* A triangle of a strip, and the edge across which it is entered; -1 -1 at the first one. */
typedef struct link {
    sl_int face, ends[2];
} link;

typedef struct strip {
    link *at;
    size_t count, capacity;
} strip;

/* A corner of a strip in the plane: the end of one or more of the edges that are crossed. */
typedef struct corner {
    double x, y, length;   /* of the path to it */
    sl_int vertex, before; /* the corner before it on that path; -1: the start */
    size_t first, last;    /* the links that are entered across an edge with this end */
} corner;

/* What straightening one path needs; the arrays grow with the longest one. */
typedef struct straightener {
    const surface_search *s;
    strip old, now;
    corner *corners;
    sl_int *queue; /* the funnel: corners from its left end over the apex to its right end */
    size_t room;   /* links for which corners and queue suffice */
    sl_int n_corners, end[2], apex;
    int64_t *points; /* of the path, from its end */
    size_t n_points, points_room;
    sl_int start;      /* where the strip starts: a vertex, or -1: within an edge of the curve */
    sl_int segment[2]; /* the ends of that edge */
    double from[3];    /* the start then */
} straightener;

/* ---- strips ---- */

static void *grown(void *array, size_t *capacity, size_t needed, size_t element) {
    if (array != NULL && needed <= *capacity) {
        return array;
    }
    *capacity = 2 * needed + 64;
    return realloc(array, *capacity * element); /* on failure the caller keeps the old one */
}

/* Adds a triangle; one that is entered from where the one before was entered cancels it. */
static bool add_link(strip *t, sl_int face, sl_int a, sl_int b) {
    if (t->count > 0 && t->at[t->count - 1].face == face) {
        return true;
    }
    if (t->count > 1 && t->at[t->count - 2].face == face) {
        t->count--;
        return true;
    }
    link *larger = (link *)grown(t->at, &t->capacity, t->count + 1, sizeof *larger);
    if (larger == NULL) {
        return false;
    }
    t->at = larger;
    const link l = {face, {a, b}};
    t->at[t->count++] = l;
    return true;
}

static int corner_of(const mesh *m, sl_int face, sl_int v) {
    const sl_int *f = m->faces + 3 * (size_t)face;
    return f[0] == v ? 0 : f[1] == v ? 1 : f[2] == v ? 2 : -1;
}

/* The triangle beyond the edge opposite to corner k of a face; -1: the edge has not two faces. */
static sl_int beyond(const surface_search *s, sl_int face, int k) {
    const sl_int e = s->edge_of[3 * face + k];
    const sl_int *side = s->side + s->begin[e];
    if (s->begin[e + 1] - s->begin[e] != 2) {
        return -1;
    }
    return side[side[0] / 3 == face] / 3;
}

/* The angle of a face at its corner k. */
static double angle_at(const mesh *m, sl_int face, int k) {
    const sl_int *f = m->faces + 3 * (size_t)face;
    const double *x = m->xyz + 3 * (size_t)f[k], *y = m->xyz + 3 * (size_t)f[(k + 1) % 3],
                 *z = m->xyz + 3 * (size_t)f[(k + 2) % 3];
    double yy = 0, zz = 0, yz = 0;
    for (int d = 0; d < 3; d++) {
        yy += (y[d] - x[d]) * (y[d] - x[d]);
        zz += (z[d] - x[d]) * (z[d] - x[d]);
        yz += (y[d] - x[d]) * (z[d] - x[d]);
    }
    return atan2(sqrt(fmax(0, yy * zz - yz * yz)), yz);
}

/* Turns around v from face `from` to face `to`, across the spoke to `spoke` first, and adds the
 * triangles to t unless t is NULL. Returns the sum of the angles between the two; INFINITY: the
 * border is in the way, or memory is short. */
static double turn_around(const surface_search *s, strip *t, sl_int v, sl_int from, sl_int spoke,
                          sl_int to) {
    const mesh *m = s->inc->m;
    const sl_off most = s->inc->begin[v + 1] - s->inc->begin[v];
    double sum = 0;
    sl_int face = from;
    for (sl_off k = 0; k < most; k++) {
        const sl_int *f = m->faces + 3 * (size_t)face;
        int other = 0; /* the corner that is neither v nor on the spoke */
        while (other < 3 && (f[other] == v || f[other] == spoke)) {
            other++;
        }
        const sl_int next = other < 3 ? beyond(s, face, other) : -1;
        if (next < 0 || corner_of(m, next, v) < 0 || (t != NULL && !add_link(t, next, v, spoke))) {
            return INFINITY;
        }
        if (next == to) {
            return sum;
        }
        sum += angle_at(m, next, corner_of(m, next, v));
        const sl_int *g = m->faces + 3 * (size_t)next;
        sl_int third = g[0];
        for (int c = 0; c < 3; c++) {
            third = g[c] != v && g[c] != spoke ? g[c] : third;
        }
        spoke = third;
        face = next;
    }
    return INFINITY;
}

/* Adds the way around vertex v to face `to`, on the side with the smaller angle. */
static bool pass_vertex(straightener *w, sl_int v, sl_int to) {
    const mesh *m = w->s->inc->m;
    const sl_int from = w->now.at[w->now.count - 1].face;
    const int k = corner_of(m, from, v);
    if (k < 0) { /* a link before has been cancelled: the strip is there already */
        return false;
    }
    const sl_int *f = m->faces + 3 * (size_t)from;
    const sl_int spokes[2] = {f[(k + 1) % 3], f[(k + 2) % 3]};
    const double angle[2] = {turn_around(w->s, NULL, v, from, spokes[0], to),
                             turn_around(w->s, NULL, v, from, spokes[1], to)};
    const int side = angle[1] < angle[0];
    return isfinite(angle[side]) && isfinite(turn_around(w->s, &w->now, v, from, spokes[side], to));
}

/* Makes the strip from points[first] back to points[last], which is a vertex on the way or the end
 * of the path. Returns where it ends: at `last`, or at a vertex that it cannot pass. */
static size_t make_strip(straightener *w, size_t first) {
    const surface_search *s = w->s;
    const mesh *m = s->inc->m;
    w->now.count = 0;
    for (size_t k = first; k > 0; k--) { /* the step from point k to point k - 1 */
        const int64_t at = w->points[k];
        const sl_int face = s->across[w->points[k - 1]];
        bool ok = true;
        if (k == first) {
            ok = add_link(&w->now, face, -1, -1);
        } else if (w->now.at[w->now.count - 1].face == face) {
            continue;
        } else if (at < m->n_vertices) {
            ok = pass_vertex(w, (sl_int)at, face);
        } else {
            const sl_int side = s->side[s->begin[(at - m->n_vertices) / s->points]];
            const sl_int *f = m->faces + side / 3 * 3;
            ok = add_link(&w->now, face, f[(side + 1) % 3], f[(side + 2) % 3]);
        }
        if (!ok) {
            return at < m->n_vertices ? k : SIZE_MAX;
        }
    }
    return 0;
}

/* Whether a face has the start on its border. */
static bool has_start(const straightener *w, sl_int face) {
    const mesh *m = w->s->inc->m;
    return w->start >= 0
               ? corner_of(m, face, w->start) >= 0
               : corner_of(m, face, w->segment[0]) >= 0 && corner_of(m, face, w->segment[1]) >= 0;
}

/* Drops triangles at both ends that the path need not enter: those before the last one of a run at
 * its start, and after the first one of a run at its end. */
static void trim(straightener *w, sl_int end) {
    const mesh *m = w->s->inc->m;
    strip *t = &w->now;
    size_t skipped = 0, kept = t->count;
    while (skipped + 1 < t->count && has_start(w, t->at[skipped + 1].face)) {
        skipped++;
    }
    while (kept > skipped + 1 && corner_of(m, t->at[kept - 2].face, end) >= 0) {
        kept--;
    }
    memmove(t->at, t->at + skipped, (kept - skipped) * sizeof *t->at);
    t->count = kept - skipped;
}

/* ---- the funnel ---- */

/* Where a vertex is, or, for -1, the start. */
static const double *spot(const straightener *w, sl_int v) {
    return v >= 0 ? w->s->inc->m->xyz + 3 * (size_t)v : w->from;
}

static double apart(const straightener *w, sl_int a, sl_int b) {
    const double *p = spot(w, a), *q = spot(w, b);
    const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
    return sqrt(x * x + y * y + z * z);
}

static sl_int add_corner(straightener *w, double x, double y, sl_int vertex, size_t first) {
    const corner c = {x, y, 0, vertex, -1, first, first};
    w->corners[w->n_corners] = c;
    return w->n_corners++;
}

/* Twice the area of three corners; positive if the third is on the left. */
static double turn(const straightener *w, sl_int a, sl_int b, sl_int c) {
    const corner *p = w->corners + a, *q = w->corners + b, *r = w->corners + c;
    return (q->x - p->x) * (r->y - p->y) - (q->y - p->y) * (r->x - p->x);
}

/* Makes a corner the end of a side of the funnel, 0 on the left and 1 on the right. Its path leads
 * over the corner that is then next to it. */
static void extend_funnel(straightener *w, int side, sl_int c) {
    const sl_int out = side == 0 ? -1 : 1;
    const double sign = -out;
    sl_int *q = w->queue, end = w->end[side];
    while (end != w->apex && sign * turn(w, q[end - out], q[end], c) <= 0) {
        end -= out;
    }
    while (end == w->apex && w->apex != w->end[!side] &&
           sign * turn(w, q[w->apex], q[w->apex - out], c) <= 0) {
        w->apex -= out;
        end = w->apex;
    }
    const corner *before = w->corners + q[end];
    const double x = w->corners[c].x - before->x, y = w->corners[c].y - before->y;
    w->corners[c].before = q[end];
    w->corners[c].length = before->length + sqrt(x * x + y * y);
    w->end[side] = end + out;
    q[end + out] = c;
}

/* Where the third vertex of a triangle is in the plane, beyond the edge from corner a to corner b,
 * which has it on its right. */
static sl_int unfold(straightener *w, sl_int a, sl_int b, sl_int vertex, size_t link_after) {
    const corner p = w->corners[a], q = w->corners[b];
    const double edge = apart(w, p.vertex, q.vertex), to_a = apart(w, p.vertex, vertex);
    const double to_b = apart(w, q.vertex, vertex);
    const double ux = edge > 0 ? (q.x - p.x) / edge : 1, uy = edge > 0 ? (q.y - p.y) / edge : 0;
    const double along = edge > 0 ? 0.5 * (edge + (to_a - to_b) * ((to_a + to_b) / edge)) : 0;
    const double up = sqrt(fmax(0, (to_a - along) * (to_a + along)));
    return add_corner(w, p.x + along * ux + up * uy, p.y + along * uy - up * ux, vertex,
                      link_after);
}

static sl_int third_of(const mesh *m, const link *l) {
    const sl_int *f = m->faces + 3 * (size_t)l->face;
    sl_int third = f[0];
    for (int c = 0; c < 3; c++) {
        third = f[c] != l->ends[0] && f[c] != l->ends[1] ? f[c] : third;
    }
    return third;
}

/* Unfolds the strip and finds the shortest path in it; the end of the path is the last corner.
 * Returns its length; NAN: out of memory, or not a strip. */
static double run_funnel(straightener *w, sl_int end) {
    const mesh *m = w->s->inc->m;
    const strip *t = &w->now;
    sl_int at[2]; /* the corners of the current edge, left and right */
    if (t->count == 1) {
        w->n_corners = 0;
        return apart(w, w->start, end);
    }
    if (t->count + 4 > w->room) {
        w->room = 2 * t->count + 64;
        free(w->corners);
        free(w->queue);
        w->corners = (corner *)malloc(w->room * sizeof *w->corners);
        w->queue = (sl_int *)malloc(2 * w->room * sizeof *w->queue);
    }
    if (w->corners == NULL || w->queue == NULL) {
        w->room = 0;
        return NAN;
    }
    w->n_corners = 0;
    w->apex = w->end[0] = w->end[1] = (sl_int)w->room;
    w->queue[w->apex] = add_corner(w, 0, 0, w->start, 0);
    const sl_int *ends = t->at[1].ends;
    at[1] = add_corner(w, apart(w, w->start, ends[1]), 0, ends[1], 1);
    /* the left one is seen from the right one and the start, so that it is counterclockwise */
    at[0] = unfold(w, at[1], 0, ends[0], 1);
    extend_funnel(w, 0, at[0]);
    extend_funnel(w, 1, at[1]);
    for (size_t k = 1; k + 1 < t->count; k++) {
        const sl_int c = unfold(w, at[1], at[0], third_of(m, &t->at[k]), k + 1);
        const sl_int *next = t->at[k + 1].ends;
        const sl_int right = w->corners[at[1]].vertex, left = w->corners[at[0]].vertex;
        const bool keeps_right = next[0] == right || next[1] == right;
        if (keeps_right == (next[0] == left || next[1] == left)) {
            return NAN;
        }
        at[!keeps_right] = c;
        extend_funnel(w, !keeps_right, c);
        w->corners[at[keeps_right]].last = k + 1;
    }
    extend_funnel(w, 0, unfold(w, at[1], at[0], end, t->count));
    return w->corners[w->n_corners - 1].length;
}

/* ---- bends ---- */

/* Whether the path, which bends at corner c on its way to corner `after`, is shorter on the other
 * side of the vertex there. */
static bool is_shorter_around(const straightener *w, sl_int c, sl_int after) {
    const double pi = acos(-1);
    const corner *p = w->corners + w->corners[c].before, *q = w->corners + c,
                 *r = w->corners + after;
    const double ax = q->x - p->x, ay = q->y - p->y, bx = r->x - q->x, by = r->y - q->y;
    const double bend = fabs(atan2(ax * by - ay * bx, ax * bx + ay * by));
    return w->s->angle[q->vertex] - pi - bend < pi * (1 - 1e-9);
}

/* Leads the strip around the other side of the vertices at which the path bends and would be
 * shorter there. Returns whether it changed; false as well if memory is short. */
static bool go_around(straightener *w) {
    const mesh *m = w->s->inc->m;
    const strip t = w->now;
    sl_int bends = 0, after = w->n_corners - 1;
    /* in the order of the path: the corners are turned into a list, by `before` */
    for (sl_int c = w->corners[after].before; c > 0; after = c, c = w->corners[c].before) {
        if (is_shorter_around(w, c, after)) {
            w->queue[bends++] = c;
        }
    }
    if (bends == 0) {
        return false;
    }
    w->now = w->old;
    w->old = t;
    w->now.count = 0;
    size_t k = 0;
    bool ok = true, changed = false;
    for (sl_int i = bends - 1; i >= -1 && ok; i--) {
        const corner *c = i >= 0 ? w->corners + w->queue[i] : NULL;
        const size_t first = c != NULL ? c->first : t.count;
        if (first < k || (c != NULL && k > 0 && first == k)) {
            continue; /* its triangles have just been replaced */
        }
        for (; k < first && ok; k++) {
            ok = add_link(&w->now, t.at[k].face, t.at[k].ends[0], t.at[k].ends[1]);
        }
        if (c == NULL || !ok) {
            break;
        }
        const sl_int from = t.at[first - 1].face, to = t.at[c->last].face;
        const sl_int *f = m->faces + 3 * (size_t)from, *used = t.at[first].ends;
        sl_int spoke = -1; /* of the two at the vertex, the one that the path does not cross */
        for (int e = 0; e < 3; e++) {
            spoke = f[e] != c->vertex && f[e] != used[0] && f[e] != used[1] ? f[e] : spoke;
        }
        const bool can_turn = spoke >= 0 && from != to &&
                              w->now.at[w->now.count - 1].face == from &&
                              isfinite(turn_around(w->s, NULL, c->vertex, from, spoke, to));
        if (can_turn) {
            ok = isfinite(turn_around(w->s, &w->now, c->vertex, from, spoke, to));
            k = c->last + 1;
            changed = true;
        }
    }
    return ok && changed;
}

/* ---- paths ---- */

/* ---- starts on a curve ---- */

/* Finds where the strip of points[k] starts. At a source in an edge of the curve, or at the end of
 * one in the first triangle, the start may slide along that edge. */
static void find_start(straightener *w, size_t k) {
    const surface_search *s = w->s;
    const int64_t at = w->points[k];
    const sl_int n = s->inc->m->n_vertices, face = s->across[w->points[k - 1]];
    w->start = at < n ? (sl_int)at : -1;
    if (at >= n) {
        surface_search_ends(w->segment, s, (sl_int)((at - n) / s->points));
        surface_search_place(w->from, s, at);
    }
    for (int c = 0; c < 3 && w->start >= 0 && s->is_curve != NULL && s->length[at] == 0; c++) {
        const sl_int edge = s->edge_of[3 * face + c];
        surface_search_ends(w->segment, s, edge);
        if (s->is_curve[edge] && (w->segment[0] == at || w->segment[1] == at)) {
            memcpy(w->from, spot(w, w->start), sizeof w->from);
            w->start = -1;
        }
    }
}

/* The point of the edge of the curve, as a share of the way from its first end to its second, that
 * is nearest to the first corner of the path, or to its end in the first triangle. NAN: unknown. */
static double foot(const straightener *w, sl_int end) {
    const double *a = spot(w, w->segment[0]), *b = spot(w, w->segment[1]);
    double along = 0, square = 0;
    for (int d = 0; d < 3; d++) {
        along += (w->from[d] - a[d]) * (b[d] - a[d]);
        square += (b[d] - a[d]) * (b[d] - a[d]);
    }
    if (w->n_corners == 0) {
        const double *x = spot(w, end);
        along = 0;
        for (int d = 0; d < 3; d++) {
            along += (x[d] - a[d]) * (b[d] - a[d]);
        }
        return fmin(1, fmax(0, along / square));
    }
    sl_int first = w->n_corners - 1;
    while (w->corners[first].before > 0) {
        first = w->corners[first].before;
    }
    /* the start is the origin of the plane; corners 1 and 2 are those of the edge that is crossed
     * first, of which one is an end of the curve's */
    const corner *c = w->corners + first, *e = w->corners + 1;
    if (e->vertex != w->segment[0] && e->vertex != w->segment[1]) {
        e++;
    }
    const double length = sqrt(e->x * e->x + e->y * e->y);
    if (e->vertex == w->segment[0]) {
        along -= sqrt(square) * (c->x * e->x + c->y * e->y) / length;
    } else if (e->vertex == w->segment[1]) {
        along += sqrt(square) * (c->x * e->x + c->y * e->y) / length;
    } else {
        return NAN;
    }
    return length > 0 ? fmin(1, fmax(0, along / square)) : e->vertex == w->segment[1];
}

/* Moves the start along its edge of the curve to where the path is at a right angle to it, as far
 * as the edge goes. Returns whether it moved by more than a hundredth of the edge. */
static bool slide(straightener *w, sl_int end) {
    const double share = w->start < 0 ? foot(w, end) : NAN;
    const double *a = spot(w, w->segment[0]), *b = spot(w, w->segment[1]);
    double moved = 0, square = 0;
    if (isnan(share)) {
        return false;
    }
    for (int d = 0; d < 3; d++) {
        const double x = a[d] + share * (b[d] - a[d]);
        moved += (x - w->from[d]) * (x - w->from[d]);
        square += (b[d] - a[d]) * (b[d] - a[d]);
        w->from[d] = x;
    }
    w->start = share == 0 ? w->segment[0] : share == 1 ? w->segment[1] : -1;
    return w->start >= 0 || moved > 1e-4 * square;
}

/* The length of the straightened path from start to end, in the strip. It ends with the round that
 * takes off less than a fiftieth of a triangle. */
static double straighten_strip(straightener *w, sl_int end) {
    enum { ROUNDS = 8, SLIDES = 3 };
    const double least = 0.02;
    double shortest = INFINITY, before = INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        trim(w, end);
        double length = run_funnel(w, end);
        for (int k = 0; k < SLIDES && isfinite(length) && slide(w, end); k++) {
            trim(w, end);
            length = run_funnel(w, end);
        }
        before = shortest;
        shortest = length < shortest ? length : shortest;
        if (!(length < before - least * length / (double)w->now.count) || w->n_corners == 0 ||
            !go_around(w)) {
            break;
        }
    }
    return shortest;
}

/* Notes the points of the path to v, from its end back to its source or to a vertex that is
 * straightened already and more than PIECE points away: there a bend costs little. */
static bool walk_back(straightener *w, sl_int v) {
    enum { PIECE = 64 };
    const surface_search *s = w->s;
    w->n_points = 0;
    for (int64_t p = v; p >= 0; p = s->parent[p]) {
        int64_t *larger =
            (int64_t *)grown(w->points, &w->points_room, w->n_points + 1, sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        w->points = larger;
        w->points[w->n_points++] = p;
        if (w->n_points > PIECE && p < s->inc->m->n_vertices && isfinite(s->straight[p])) {
            break;
        }
    }
    return true;
}

/* The length of the straightened path to v; at most that of the search. NAN: out of memory. */
static double straighten_path(straightener *w, sl_int v) {
    const surface_search *s = w->s;
    if (!walk_back(w, v)) {
        return NAN;
    }
    const int64_t root = w->points[w->n_points - 1];
    double sum = s->length[root] > 0 ? s->straight[root] : 0;
    for (size_t k = w->n_points - 1; k > 0;) {
        const size_t last = make_strip(w, k);
        if (last == SIZE_MAX) {
            return s->length[v];
        }
        find_start(w, k);
        const double length = straighten_strip(w, (sl_int)w->points[last]);
        const double before = s->length[w->points[last]] - s->length[w->points[k]];
        sum += length < before ? length : before;
        k = last;
    }
    return fmin(sum, s->length[v]);
}

/* Sums the angles around each vertex. */
static bool prepare(surface_search *s) {
    const mesh *m = s->inc->m;
    const size_t n = (size_t)m->n_vertices;
    s->angle = (double *)calloc(n + 1, sizeof *s->angle);
    s->straight = (double *)malloc((n + 1) * sizeof *s->straight);
    if (s->angle == NULL || s->straight == NULL) {
        return false;
    }
    for (sl_int k = 0; k < 3 * m->n_faces; k++) {
        s->angle[m->faces[k]] += angle_at(m, k / 3, k % 3);
    }
    for (sl_int k = 0; k < 3 * m->n_faces; k++) {
        for (int i = 1; i < 3 && beyond(s, k / 3, k % 3) < 0; i++) {
            s->angle[m->faces[k / 3 * 3 + (k + i) % 3]] = INFINITY;
        }
    }
    return true;
}

/* A vertex and the length of its path. */
typedef struct reached {
    double length;
    sl_int vertex;
} reached;

static int by_length(const void *a, const void *b) {
    const reached *p = (const reached *)a, *q = (const reached *)b;
    return p->length != q->length ? (p->length > q->length) - (p->length < q->length)
                                  : (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

const double *surface_search_straighten(surface_search *s, const sl_int *vertices, sl_int count) {
    straightener w;
    reached *order = (reached *)malloc(((size_t)count + 1) * sizeof *order);
    bool ok = order != NULL && (s->straight != NULL || prepare(s));
    memset(&w, 0, sizeof w);
    w.s = s;
    for (sl_int v = 0; v < s->inc->m->n_vertices && ok; v++) {
        s->straight[v] = INFINITY;
    }
    for (sl_int k = 0; k < count && ok; k++) {
        const reached r = {s->length[vertices[k]], vertices[k]};
        order[k] = r;
    }
    if (ok) {
        qsort(order, (size_t)count, sizeof *order, by_length);
    }
    for (sl_int k = 0; k < count && ok && isfinite(order[k].length); k++) {
        s->straight[order[k].vertex] = straighten_path(&w, order[k].vertex);
        ok = !isnan(s->straight[order[k].vertex]);
    }
    free(w.points);
    free(w.queue);
    free(w.corners);
    free(w.now.at);
    free(w.old.at);
    free(order);
    return ok ? s->straight : NULL;
}
