/* unwrap_part.c: cuts a part of a surface open and lays it out by one of the methods of unwrap */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/geometry/layout_conformal.h"
#include "tools/geometry/layout_descent.h"
#include "tools/mesh/sheet_cut.h"
#include "unwrap.h"

/* A part is cut further, to where its conformal layout shrinks most, while that shrinks a length
 * there to less than this part of the mean; at most so often. */
#define LEAST_SCALE 0.01
enum { FURTHER_CUTS = 12 };

void unwrap_part_free(unwrap_part *p) {
    layout_free(&p->l);
    layout_boundary_free(&p->boundary);
    sheet_free(&p->s);
    free(p->uv);
    free(p->pinned);
    free(p->place);
    memset(p, 0, sizeof *p);
}

/* Finds boundary and measures of the sheet as it is now. */
static void prepare(unwrap_part *p) {
    layout_boundary_free(&p->boundary);
    layout_free(&p->l);
    free(p->uv);
    p->uv = app_alloc(2 * (size_t)p->s.m.n_vertices, sizeof *p->uv);
    if (!layout_boundary_find(&p->boundary, &p->s)) {
        app_die("out of memory for the boundary of %d faces", (int)p->s.m.n_faces);
    }
    app_must(layout_create(&p->l, &p->s.m), "system of the layout", NULL);
}

/* The layout on a circle, with equal weights where others flip a face. */
static void lay_on_circle(unwrap_part *p) {
    for (int k = WEIGHTS_POSITIVE; k <= WEIGHTS_EQUAL; k++) {
        app_must(layout_on_circle(p->uv, &p->s, &p->boundary, (layout_weights)k),
                 "layout on a circle", NULL);
        layout_normalize(&p->l, p->uv);
        if (layout_flipped(&p->l, p->uv) == 0) {
            return;
        }
    }
}

/* ---- pins ---- */

/* The pins among the vertices of the part. Copies of a vertex that is cut are all pinned. */
static void find_pins(const unwrap_command *cmd, unwrap_part *p) {
    const size_t n = (size_t)p->s.m.n_vertices;
    if (cmd->pin_u == NULL) {
        return;
    }
    p->pinned = app_alloc(n, sizeof *p->pinned);
    p->place = app_alloc(2 * n, sizeof *p->place);
    for (sl_int v = 0; v < p->s.m.n_vertices; v++) {
        const double u = cmd->pin_u[p->s.vertex[v]], w = cmd->pin_v[p->s.vertex[v]];
        if (isfinite(u) && isfinite(w)) {
            p->place[2 * p->n_pinned] = u;
            p->place[2 * p->n_pinned + 1] = w;
            p->pinned[p->n_pinned++] = v;
        }
    }
}

/* Without two pins: the two ends of the longest way across the boundary, at their distance. */
static void pin_two(unwrap_part *p) {
    const sl_int *loop = p->boundary.vertex + p->boundary.begin[p->boundary.outer];
    const sl_int count =
        p->boundary.begin[p->boundary.outer + 1] - p->boundary.begin[p->boundary.outer];
    sl_int ends[2] = {loop[0], loop[count / 2]};
    double distance = 0;
    for (int turn = 0; turn < 4; turn++) { /* the farthest one of the other */
        const double *from = p->s.m.xyz + 3 * (size_t)ends[(turn + 1) % 2];
        for (sl_int k = 0; k < count; k++) {
            const double *x = p->s.m.xyz + 3 * (size_t)loop[k];
            const double d = hypot(hypot(x[0] - from[0], x[1] - from[1]), x[2] - from[2]);
            if (d > distance) {
                distance = d;
                ends[turn % 2] = loop[k];
            }
        }
    }
    for (int k = 0; k < 2; k++) {
        p->l.fixed[ends[k]] = 1;
        p->uv[2 * ends[k]] = k * (distance > 0 ? distance : 1);
        p->uv[2 * ends[k] + 1] = 0;
    }
}

/* Returns a vertex at which the digits do not suffice, because the conformal layout shrinks there
 * too much; -1: there is none. */
static sl_int find_lscm(unwrap_part *p, sl_int n_pinned) {
    const size_t n = (size_t)p->s.m.n_vertices;
    memset(p->uv, 0, 2 * n * sizeof *p->uv);
    memset(p->l.fixed, 0, n);
    for (sl_int k = 0; k < n_pinned; k++) {
        p->l.fixed[p->pinned[k]] = 1;
        memcpy(p->uv + 2 * (size_t)p->pinned[k], p->place + 2 * (size_t)k, 2 * sizeof *p->uv);
    }
    if (n_pinned < 2) {
        pin_two(p);
    }
    const sl_status status = layout_lscm(&p->l, p->uv);
    p->converged = true;
    if (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE || status == SL_ERR_NOT_FINITE) {
        const sl_int row = p->l.stats.error.row;
        return row >= 0 && row < 2 * p->s.m.n_vertices ? row / 2 : 0;
    }
    app_must(status, "factor of the conformal energy", &p->l.stats);
    return -1;
}

static void by_lscm(unwrap_part *p, sl_int n_pinned) {
    if (find_lscm(p, n_pinned) >= 0) {
        app_die("a conformal layout of this surface shrinks parts of it beyond the digits of "
                "numbers; --method slim does not");
    }
}

/* ---- cuts ---- */

/* A vertex of the face that has shrunk most; -1: none has shrunk below LEAST_SCALE. */
static sl_int most_shrunk(const unwrap_part *p) {
    double least = LEAST_SCALE * LEAST_SCALE, J[4];
    sl_int found = -1;
    for (sl_int f = 0; f < p->s.m.n_faces; f++) {
        const double area = fabs(layout_jacobian(J, &p->l, p->uv, f));
        if (area < least) {
            least = area;
            found = p->s.m.faces[3 * f];
        }
    }
    return found;
}

/* Leaves the conformal layout of the sheet that is cut open, and then further, at most so often. */
static void cut_open(unwrap_part *p, int most) {
    sl_int more = 0;
    if (!sheet_open(&p->s, &p->cut)) {
        app_die("out of memory for the cuts of %d faces", (int)p->s.m.n_faces);
    }
    for (int k = 0; k == 0 || more > 0; k++) {
        p->cut += more;
        prepare(p);
        sl_int far = find_lscm(p, 0);
        if (far >= 0 && k == most) {
            lay_on_circle(p);
        }
        layout_normalize(&p->l, p->uv);
        far = k == most ? -1 : far >= 0 ? far : most_shrunk(p);
        more = 0;
        if (far >= 0 && !sheet_cut_to(&p->s, far, &more)) {
            app_die("out of memory for the cuts of %d faces", (int)p->s.m.n_faces);
        }
    }
}

/* ---- methods ---- */

static void by_scp(unwrap_part *p, int limit) {
    layout_spectrum how;
    lay_on_circle(p);
    app_must(layout_spectral(&p->l, p->uv, &p->boundary, limit, &how),
             "factor of the conformal energy", &p->l.stats);
    layout_normalize(&p->l, p->uv);
    p->energy = how.lambda;
    p->iterations = how.iterations;
    p->converged = how.change <= 1e-7;
}

static void show(const void *context, const layout_descent *now) {
    (void)context;
    if (options_verbose) {
        printf("           %d: energy %.9g\n", now->iterations, now->last);
    }
    app_progress("iterations", (double)now->iterations / (double)now->limit);
}

/* Descends from the layout as it is. */
static void descend(const unwrap_command *cmd, unwrap_part *p, int limit) {
    const layout_pins pins = {p->n_pinned, p->pinned, p->place};
    layout_descent d;
    memset(&d, 0, sizeof d);
    d.energy = cmd->method == UNWRAP_SLIM ? LAYOUT_SLIM : LAYOUT_ARAP;
    d.limit = limit;
    d.tolerance = cmd->tolerance;
    d.pins = p->n_pinned > 0 ? &pins : NULL;
    d.each = show;
    d.context = cmd;
    app_must(layout_descend(&p->l, p->uv, &d), "factor of the layout", &p->l.stats);
    app_progress_end();
    p->energy = d.last;
    p->iterations += d.iterations;
    p->converged = d.converged;
}

/* Starts from the conformal layout: one with pins, if there are at least two. For slim it is
 * replaced by the layout on a circle if it flips a face. */
static void by_descent(const unwrap_command *cmd, unwrap_part *p, int limit) {
    const bool is_slim = cmd->method == UNWRAP_SLIM;
    if (p->n_pinned >= 2) {
        by_lscm(p, p->n_pinned);
    }
    if (is_slim && layout_flipped(&p->l, p->uv) > 0) {
        p->from_tutte = true;
        lay_on_circle(p);
    }
    if (is_slim && layout_flipped(&p->l, p->uv) > 0) {
        p->converged = false; /* digits do not suffice, or edges with the same two ends */
        p->energy = INFINITY;
        return;
    }
    descend(cmd, p, limit);
}

/* A disk, with holes or without, that slim has laid out with cuts of its own is laid out without
 * them too, and keeps this layout unless its energy is higher by more than a hundredth. */
static void try_uncut(const unwrap_command *cmd, unwrap_part *p, sheet *uncut) {
    const double slack = 1.01;
    const int first = p->iterations + 20, limit = (int)cmd->iterations;
    unwrap_part other;
    memset(&other, 0, sizeof other);
    other.s = *uncut;
    memset(uncut, 0, sizeof *uncut);
    cut_open(&other, 0);
    if (other.cut == 0) {
        by_descent(cmd, &other, first < limit ? first : limit);
        if (other.energy < slack * p->energy && !other.converged && other.iterations < limit) {
            descend(cmd, &other, limit - other.iterations);
        }
    }
    if (other.cut == 0 && other.energy < slack * p->energy) {
        unwrap_part_free(p);
        *p = other;
        p->l.m = &p->s.m; /* which it borrows */
    } else {
        unwrap_part_free(&other);
    }
}

void unwrap_lay_out(const unwrap_command *cmd, unwrap_part *p) {
    sheet uncut;
    if (!sheet_take_part(&uncut, &p->s, 0)) {
        app_die("out of memory for %d faces", (int)p->s.m.n_faces);
    }
    cut_open(p, FURTHER_CUTS);
    find_pins(cmd, p);
    p->converged = true;
    switch (cmd->method) {
    case UNWRAP_SLIM:
    case UNWRAP_ARAP:
        by_descent(cmd, p, (int)cmd->iterations);
        if (cmd->method == UNWRAP_SLIM && p->n_pinned == 0 && p->cut > 0) {
            try_uncut(cmd, p, &uncut);
        }
        break;
    case UNWRAP_SCP:
        by_scp(p, (int)cmd->iterations);
        break;
    case UNWRAP_LSCM:
        by_lscm(p, p->n_pinned);
        break;
    case UNWRAP_HARMONIC:
        app_must(layout_on_circle(p->uv, &p->s, &p->boundary, WEIGHTS_COTANGENT),
                 "factor of the Laplacian", NULL);
        break;
    case UNWRAP_TUTTE:
        lay_on_circle(p);
        break;
    }
    sheet_free(&uncut);
    if (p->n_pinned == 0) {
        layout_normalize(&p->l, p->uv);
    }
    p->flipped = layout_flipped(&p->l, p->uv);
    p->q = distortion_of(&p->s.m, p->uv);
}
