/* edit_system.c: a system M + t L that is edited at random places, and a factor that follows it */
#include "edit_system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app.h"
#include "solve_accuracy.h"
#include "tools/geometry/laplacian.h"

/* A place is looked for this many times. */
enum { TRIES = 200 };

/* Beyond these the factor is made anew while entries are outside of the analyzed pattern, where
 * sl_factor_change_entries cannot choose: changed entries, and the drift at which it refactors. */
enum { MOST_OUTSIDE = 256 };
static const double most_drift = 1e-11;

static void must(bool ok) {
    if (!ok) {
        app_die("out of memory");
    }
}

/* 0..1 */
static double random_share(edit_system *e) {
    return (double)(app_random(&e->random) >> 11) * 0x1p-53;
}

/* ---- creation ---- */

/* A new analysis and factor of the present matrix, whose entries outside of the pattern join it.
 * Zeros stay where pins will put their entries back. */
static void renew(edit_system *e) {
    sl_matrix *whole = NULL;
    edited_matrix fresh;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    must(edited_matrix_whole(&whole, &e->A, e->is_pinned));
    const sl_csc A = sl_matrix_view(whole);
    must(edited_matrix_create(&fresh, &A));
    app_must(sl_symbolic_create(&S, &A, NULL, &e->stats), "analysis", &e->stats);
    app_must(sl_factor_create(&F, S, &A, NULL, &e->stats), "factorization", &e->stats);
    sl_factor_free(e->F);
    sl_symbolic_free(e->S);
    edited_matrix_free(&e->A);
    e->A = fresh;
    e->S = S;
    e->F = F;
    sl_matrix_free(whole);
}

void edit_system_create(edit_system *out, const mesh *m, double t, sl_int patch, uint64_t seed) {
    const size_t n = (size_t)m->n_vertices;
    sl_matrix *system = NULL;
    memset(out, 0, sizeof *out);
    out->t = t;
    out->patch = patch;
    out->random = seed;
    must(laplacian_system(&system, m, t) && edge_flips_create(&out->faces, m));
    const sl_csc A = sl_matrix_view(system);
    must(edited_matrix_create(&out->A, &A));
    out->most_pins = m->n_vertices / 50 + 1;
    out->pins = app_alloc((size_t)out->most_pins, sizeof *out->pins);
    out->is_pinned = app_alloc(n, 1);
    out->near_pins = app_alloc(n, sizeof *out->near_pins);
    out->queue = app_alloc(n, sizeof *out->queue);
    out->seen = app_alloc(n, 1);
    app_must(sl_work_create(&out->W, NULL), "workspace", NULL);
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int k = A.p[j]; k < A.p[j + 1]; k++) {
            out->typical += A.i[k] == j ? 0 : fabs(A.x[k]) / (double)A.p[A.n_cols];
        }
    }
    const accuracy_faces faces = accuracy_of_faces(m, NULL);
    accuracy_warn(&faces, NULL, &A);
    sl_matrix_free(system);
    renew(out);
}

void edit_system_free(edit_system *e) {
    for (sl_int k = 0; k < e->n_pins; k++) {
        triplets_free(&e->pins[k].saved);
    }
    free(e->pins);
    free(e->is_pinned);
    free(e->near_pins);
    free(e->queue);
    free(e->seen);
    triplets_free(&e->springs);
    edge_flips_free(&e->faces);
    edited_matrix_free(&e->A);
    sl_factor_free(e->F);
    sl_symbolic_free(e->S);
    sl_work_free(e->W);
    memset(e, 0, sizeof *e);
}

/* ---- changes ---- */

/* Adds w to the weight of the edge (i, j). */
static void change_edge(entry_changes *changes, sl_int i, sl_int j, double w) {
    must(triplets_add(changes, i, i, w) && triplets_add(changes, j, j, w) &&
         triplets_add(changes, i, j, -w));
}

/* Whether an entry joins two vertices: what a flip leaves of an edge is rounding. */
static bool joins(const edit_system *e, double entry) {
    return fabs(entry) > 1e-12 * e->typical;
}

static bool are_free(const edit_system *e, const sl_int *vertices, int count) {
    bool free = true;
    for (int k = 0; k < count; k++) {
        free = free && !e->is_pinned[vertices[k]];
    }
    return free;
}

/* Sets the stiffness of spring k; 0 removes it. */
static void set_spring(edit_system *e, entry_changes *changes, size_t k, double stiffness) {
    triplets *s = &e->springs;
    change_edge(changes, s->i[k], s->j[k], stiffness - s->x[k]);
    s->x[k] = stiffness;
    if (stiffness == 0) {
        s->count--;
        s->i[k] = s->i[s->count];
        s->j[k] = s->j[s->count];
        s->x[k] = s->x[s->count];
    }
}

static void add_spring(edit_system *e, entry_changes *changes, sl_int i, sl_int j) {
    must(triplets_add(&e->springs, i, j, 0));
    set_spring(e, changes, e->springs.count - 1, e->typical * (0.1 + 3.9 * random_share(e)));
}

/* A spring at a random edge of the matrix; or, where there are some, a present one is changed or
 * removed. The three are equally likely, so that springs do not become more and more. */
static bool edit_weight(edit_system *e, entry_changes *changes) {
    for (int tries = 0; tries < TRIES; tries++) {
        const sl_int what = app_random_below(&e->random, 3);
        if (what > 0 && e->springs.count > 0) {
            const size_t k = (size_t)app_random_below(&e->random, (sl_int)e->springs.count);
            const sl_int ends[2] = {e->springs.i[k], e->springs.j[k]};
            if (are_free(e, ends, 2)) {
                const double changed = e->typical * (0.1 + 3.9 * random_share(e));
                set_spring(e, changes, k, what == 1 ? 0 : changed);
                return true;
            }
            continue;
        }
        const sl_int j = app_random_below(&e->random, e->A.n);
        const sl_int count = e->A.p[j + 1] - e->A.p[j];
        const sl_int k = e->A.p[j] + (count > 0 ? app_random_below(&e->random, count) : 0);
        const sl_int ends[2] = {j, count > 0 ? e->A.i[k] : j};
        if (ends[1] != j && joins(e, e->A.x[k]) && are_free(e, ends, 2)) {
            add_spring(e, changes, ends[1], j);
            return true;
        }
    }
    return false;
}

/* The first vertices of a breadth-first search over the entries of the matrix. */
static sl_int find_patch(edit_system *e) {
    triplets row = {0, 0, NULL, NULL, NULL};
    sl_int count = 1;
    e->queue[0] = app_random_below(&e->random, e->A.n);
    e->seen[e->queue[0]] = 1;
    for (sl_int at = 0; at < count && count < e->patch; at++) {
        row.count = 0;
        must(edited_matrix_row(&e->A, e->queue[at], &row));
        for (size_t k = 0; k < row.count && count < e->patch; k++) {
            if (!e->seen[row.j[k]]) {
                e->seen[row.j[k]] = 1;
                e->queue[count++] = row.j[k];
            }
        }
    }
    triplets_free(&row);
    return count;
}

/* Springs along all edges of a patch; or, where there are many, as many as a patch has are
 * removed. */
static bool edit_patch(edit_system *e, entry_changes *changes) {
    triplets row = {0, 0, NULL, NULL, NULL};
    if (e->springs.count > 8 * (size_t)e->patch) {
        for (size_t k = e->springs.count, left = 3 * (size_t)e->patch; k-- > 0 && left > 0;) {
            const sl_int ends[2] = {e->springs.i[k], e->springs.j[k]};
            if (are_free(e, ends, 2)) {
                set_spring(e, changes, k, 0);
                left--;
            }
        }
        return changes->count > 0;
    }
    const sl_int count = find_patch(e);
    for (sl_int at = 0; at < count; at++) {
        const sl_int v = e->queue[at];
        row.count = 0;
        must(edited_matrix_row(&e->A, v, &row));
        for (size_t k = 0; k < row.count; k++) {
            const sl_int ends[2] = {v, row.j[k]};
            if (row.j[k] < v && e->seen[row.j[k]] && are_free(e, ends, 2)) {
                add_spring(e, changes, v, row.j[k]);
            }
        }
    }
    for (sl_int at = 0; at < count; at++) {
        e->seen[e->queue[at]] = 0;
    }
    triplets_free(&row);
    return changes->count > 0;
}

static void release_pin(edit_system *e, entry_changes *changes, sl_int k) {
    edit_pin *pin = &e->pins[k];
    for (size_t s = 0; s < pin->saved.count; s++) {
        must(triplets_add(changes, pin->saved.i[s], pin->saved.j[s], pin->saved.x[s]));
        e->near_pins[pin->saved.j[s]]--;
    }
    e->is_pinned[pin->vertex] = 0;
    triplets_free(&pin->saved);
    *pin = e->pins[--e->n_pins];
}

/* Pins a vertex none of whose neighbors is pinned, or releases one. */
static bool edit_pin_or_release(edit_system *e, entry_changes *changes) {
    if (e->n_pins == e->most_pins || (e->n_pins > 0 && app_random_below(&e->random, 2))) {
        release_pin(e, changes, app_random_below(&e->random, e->n_pins));
        return true;
    }
    for (int tries = 0; tries < TRIES; tries++) {
        const sl_int v = app_random_below(&e->random, e->A.n);
        edit_pin *pin = &e->pins[e->n_pins];
        memset(pin, 0, sizeof *pin);
        if (e->is_pinned[v] || e->near_pins[v] > 0) {
            continue;
        }
        must(edited_matrix_row(&e->A, v, &pin->saved));
        if (pin->saved.count == 0) {
            triplets_free(&pin->saved);
            continue;
        }
        pin->vertex = v;
        e->n_pins++;
        e->is_pinned[v] = 1;
        for (size_t s = 0; s < pin->saved.count; s++) {
            must(triplets_add(changes, v, pin->saved.j[s], -pin->saved.x[s]));
            e->near_pins[pin->saved.j[s]]++;
        }
        return true;
    }
    return false;
}

/* Adds the masses and weights of a face `sign` times. */
static void change_face(const edit_system *e, entry_changes *changes, sl_int f, double sign) {
    const sl_int *v = e->faces.m.faces + 3 * (size_t)f;
    const laplacian_face face = laplacian_of_face(&e->faces.m, v);
    for (int k = 0; k < 3; k++) {
        change_edge(changes, v[(k + 1) % 3], v[(k + 2) % 3], sign * e->t * face.weight[k]);
        must(triplets_add(changes, v[k], v[k], sign * face.area / 3));
    }
}

static bool edit_flip(edit_system *e, entry_changes *changes) {
    for (int tries = 0; tries < TRIES; tries++) {
        sl_int corners[4], pair[2];
        const sl_int side = app_random_below(&e->random, 3 * e->faces.m.n_faces);
        if (!edge_flips_corners(corners, &e->faces, side) || !are_free(e, corners, 4) ||
            joins(e, edited_matrix_get(&e->A, corners[2], corners[3]))) {
            continue;
        }
        change_face(e, changes, side / 3, -1);
        change_face(e, changes, e->faces.twin[side] / 3, -1);
        edge_flips_flip(pair, &e->faces, side);
        change_face(e, changes, pair[0], 1);
        change_face(e, changes, pair[1], 1);
        return true;
    }
    return false;
}

bool edit_system_edit(edit_system *e, edit_kind kind, entry_changes *changes) {
    static bool (*const edits[EDIT_KINDS])(edit_system *, entry_changes *) = {
        edit_weight, edit_patch, edit_pin_or_release, edit_flip};
    memset(changes, 0, sizeof *changes);
    if (!edits[kind](e, changes)) {
        return false;
    }
    must(edited_matrix_apply(&e->A, changes));
    return true;
}

/* ---- the factor ---- */

edit_way edit_system_follow(edit_system *e, const entry_changes *changes) {
    const sl_csc A = edited_matrix_view(&e->A);
    const sl_int count = (sl_int)changes->count;
    if (e->A.more.count == 0) {
        app_must(sl_factor_change_entries(e->F, &A, changes->i, changes->j, changes->x, count, e->W,
                                          &e->stats),
                 "change", &e->stats);
        return (edit_way)e->stats.change.method;
    }
    if (count <= MOST_OUTSIDE && e->stats.change.drift < most_drift) {
        const sl_status status = sl_factor_change_entries(e->F, NULL, changes->i, changes->j,
                                                          changes->x, count, e->W, &e->stats);
        if (status == SL_OK) {
            return EDIT_OUTSIDE;
        }
        if (status != SL_ERR_OTHER_PATTERN && status != SL_ERR_PIVOT) {
            app_must(status, "change of entries", &e->stats);
        }
    }
    renew(e);
    e->stats.change.drift = 0;
    e->stats.change.updates = 0;
    return EDIT_ANEW;
}

edit_check edit_system_check(edit_system *e) {
    sl_matrix *whole = NULL;
    must(edited_matrix_whole(&whole, &e->A, NULL));
    const sl_csc A = sl_matrix_view(whole);
    const edit_check check = edit_check_factor(&A, e->F, e->W, &e->random);
    sl_matrix_free(whole);
    return check;
}
