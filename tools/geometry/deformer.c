/* deformer.c: deforms a mesh by handles, which are pins on one factor */
#include "deformer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "deformer_anew.h"
#include "deformer_mixed.h"
#include "laplacian.h"
#include "polyharmonic.h"
#include "tools/matrix/triplets.h"
#include "tools/mesh/adjacency.h"

void deformer_free(deformer *d) {
    sl_plan_free(d->near);
    sl_constraints_free(d->pins);
    sl_fixed_free(d->fixed);
    sl_factor_free(d->F);
    sl_symbolic_free(d->S);
    sl_work_free(d->W);
    sl_matrix_free(d->K);
    sl_matrix_free(d->L);
    deformer_mixed_free(d->mixed);
    free(d->mass);
    arap_surface_free(&d->arap);
    free(d->rest);
    free(d->Y);
    free(d->balance);
    free(d->B);
    free(d->U);
    free(d->G);
    free(d->held);
    free(d->target);
    free(d->is_held);
    free(d->component);
    free(d->n_held);
    free(d->mean);
    free(d->sizes);
    free(d->watched);
    memset(d, 0, sizeof *d);
}

/* ---- creation ---- */

static double *reals(size_t count) {
    return (double *)calloc(count + 1, sizeof(double));
}

static sl_int *integers(size_t count) {
    return (sl_int *)calloc(count + 1, sizeof(sl_int));
}

static bool allocate(deformer *d) {
    size_t n = (size_t)d->n;
    d->rest = reals(3 * n);
    d->Y = reals(3 * n);
    d->balance = reals(3 * n);
    d->B = reals(3 * n);
    d->U = reals(3 * n);
    d->G = reals(3 * n);
    d->target = reals(3 * n);
    d->held = integers(n);
    d->component = integers(n);
    d->is_held = (unsigned char *)calloc(n + 1, 1);
    return d->rest != NULL && d->Y != NULL && d->balance != NULL && d->B != NULL && d->U != NULL &&
           d->G != NULL && d->target != NULL && d->held != NULL && d->component != NULL &&
           d->is_held != NULL;
}

/* The components of the nonzero entries of K, as the factor sees them. */
static bool find_components(deformer *d) {
    triplets list = {0, 0, NULL, NULL, NULL};
    sl_matrix *nonzero = NULL;
    adjacency graph;
    const sl_csc K = sl_matrix_view(d->K);
    bool ok = true;
    for (sl_int j = 0; j < d->n && ok; j++) {
        for (sl_int p = K.p[j]; p < K.p[j + 1] && ok; p++) {
            ok = K.x[p] == 0 || triplets_add(&list, K.i[p], j, 1);
        }
    }
    if (!ok || triplets_finish(&nonzero, d->n, d->n, &list, false) != SL_OK) {
        triplets_free(&list);
        return false;
    }
    const sl_csc pattern = sl_matrix_view(nonzero);
    ok = adjacency_from_matrix(&graph, &pattern);
    sl_matrix_free(nonzero);
    d->sizes = integers((size_t)d->n);
    if (ok && d->sizes != NULL) {
        d->n_components = adjacency_components(d->component, d->sizes, &graph);
        ok = d->n_components >= 0;
    }
    adjacency_free(&graph);
    d->n_held = ok ? integers((size_t)d->n_components) : NULL;
    d->mean = ok ? reals(3 * (size_t)d->n_components) : NULL;
    return ok && d->sizes != NULL && d->n_held != NULL && d->mean != NULL;
}

static void measure(deformer *d) {
    size_t n = (size_t)d->n;
    double size[3] = {0, 0, 0};
    for (size_t c = 0; c < 3; c++) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (size_t v = 0; v < n; v++) {
            double x = d->m->xyz[3 * v + c];
            d->rest[c * n + v] = d->Y[c * n + v] = x;
            low = fmin(low, x);
            high = fmax(high, x);
        }
        size[c] = high > low ? high - low : 0;
    }
    d->diameter = hypot(hypot(size[0], size[1]), size[2]);
}

static sl_status factor(deformer *d) {
    size_t n = (size_t)d->n;
    const sl_csc K = sl_matrix_view(d->K);
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    /* forces are in balance to rounding, which is all that their sums are */
    opt.consistency_tolerance = -1;
    sl_status status = sl_symbolic_create(&d->S, &K, NULL, &d->stats);
    if (status == SL_OK) {
        status = sl_factor_create(&d->F, d->S, &K, &opt, &d->stats);
    }
    if (status == SL_OK) {
        status = sl_constraints_create(&d->pins, d->F, NULL);
    }
    if (status == SL_OK) {
        status = sl_work_create(&d->W, NULL);
    }
    if (status == SL_OK && d->method == DEFORM_ARAP) {
        status = sl_csc_multiply(&K, SL_AS_SYMMETRIC, d->balance, n, d->rest, n, 3);
    }
    return status;
}

sl_status deformer_create(deformer *out, const mesh *m, deform_method method) {
    memset(out, 0, sizeof *out);
    out->m = m;
    out->method = method;
    out->n = m->n_vertices;
    bool ok = method == DEFORM_ARAP
                  ? laplacian_cotangent(&out->K, m) && arap_surface_create(&out->arap, m)
                  : polyharmonic_energy(&out->K, m, 2) && laplacian_cotangent(&out->L, m);
    if (ok && method == DEFORM_BIHARMONIC) {
        out->mass = reals((size_t)out->n);
        ok = out->mass != NULL;
    }
    if (ok && method == DEFORM_BIHARMONIC) {
        laplacian_mass(out->mass, m);
    }
    ok = ok && allocate(out) && find_components(out);
    sl_status status = SL_ERR_MEMORY;
    if (ok) {
        measure(out);
        status = factor(out);
        out->squared = status == SL_OK;
    }
    if (method == DEFORM_BIHARMONIC && deformer_is_refusal(status)) {
        out->anew = true; /* the mixed system alone */
        status = out->W != NULL ? SL_OK : sl_work_create(&out->W, NULL);
    }
    if (status != SL_OK) {
        sl_stats stats = out->stats;
        deformer_free(out);
        out->stats = stats;
    }
    return status;
}

/* ---- handles ---- */

/* A vertex without faces, or whose faces have no area: its row of K is zero, and it has no pin. */
static bool is_alone(const deformer *d, sl_int vertex) {
    return d->sizes[d->component[vertex]] == 1;
}

/* Beyond so many pins the rows are fixed in a factor of the others. */
enum { MANY_PINS = 200 };

/* The handles have changed. */
static void forget_fixed(deformer *d) {
    sl_fixed_free(d->fixed);
    d->fixed = NULL;
    deformer_mixed_free(d->mixed);
    d->mixed = NULL;
    d->accurate = false;
}

/* Whether pins have lost all digits, as they do in parts of the mesh that are nearly degenerate. If
 * so, they are no longer used. */
static bool is_refused(deformer *d, sl_status status) {
    if (!d->anew && (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE)) {
        d->anew = d->refused = true;
    }
    return d->anew;
}

/* is_held while a set of vertices is held or released. */
enum { HELD = 1, CHANGING = 2 };

sl_status deformer_hold(deformer *d, const sl_int *vertices, sl_int count) {
    size_t n = (size_t)d->n;
    sl_int *added = d->held + d->n_pins, n_added = 0;
    for (sl_int k = 0; k < count; k++) {
        size_t v = (size_t)vertices[k];
        if (d->is_held[v]) {
            continue;
        }
        if (!is_alone(d, vertices[k])) {
            added[n_added++] = vertices[k];
        }
        d->is_held[v] = CHANGING;
        for (size_t c = 0; c < 3; c++) {
            d->target[3 * v + c] = d->Y[c * n + v];
        }
    }
    forget_fixed(d);
    d->anew = d->anew || d->n_pins + n_added > MANY_PINS;
    sl_status status =
        d->anew ? SL_OK : sl_constraints_add(d->pins, added, NULL, n_added, &d->stats);
    status = is_refused(d, status) ? SL_OK : status;
    d->n_pins += status == SL_OK ? n_added : 0;
    for (sl_int k = 0; k < count; k++) {
        if (d->is_held[vertices[k]] == CHANGING) {
            d->is_held[vertices[k]] = status == SL_OK ? HELD : 0;
            d->n_held[d->component[vertices[k]]] += status == SL_OK;
        }
    }
    return status;
}

void deformer_move(deformer *d, sl_int vertex, const double position[3]) {
    if (d->is_held[vertex]) {
        memcpy(d->target + 3 * (size_t)vertex, position, 3 * sizeof *position);
    }
}

sl_status deformer_release(deformer *d, const sl_int *vertices, sl_int count) {
    sl_int n_pins = d->n_pins, n_gone = 0, n_left = 0;
    sl_int *gone = malloc(((size_t)n_pins + 1) * sizeof *gone);
    for (sl_int k = 0; k < count; k++) {
        d->is_held[vertices[k]] = d->is_held[vertices[k]] ? CHANGING : 0;
    }
    for (sl_int k = 0; k < n_pins && gone != NULL; k++) {
        if (d->is_held[d->held[k]] == CHANGING) {
            gone[n_gone++] = k;
        }
    }
    sl_status status = gone != NULL ? SL_OK : SL_ERR_MEMORY;
    forget_fixed(d);
    if (status == SL_OK && !d->anew) {
        status = sl_constraints_release(d->pins, gone, n_gone, &d->stats);
    }
    for (sl_int k = 0; k < n_pins && status == SL_OK; k++) {
        if (d->is_held[d->held[k]] != CHANGING) {
            d->held[n_left++] = d->held[k];
        }
    }
    d->n_pins = status == SL_OK ? n_left : n_pins;
    for (sl_int k = 0; k < count; k++) {
        if (d->is_held[vertices[k]] == CHANGING) {
            d->is_held[vertices[k]] = status == SL_OK ? 0 : HELD;
            d->n_held[d->component[vertices[k]]] -= status == SL_OK;
        }
    }
    free(gone);
    return status;
}

/* ---- steps ---- */

double deformer_rotations(deformer *d) {
    return d->method == DEFORM_ARAP ? arap_surface_rotations(&d->arap, d->Y) : 0;
}

/* G(k, c) = displacement of pin k. */
static void gather_pins(deformer *d) {
    size_t n = (size_t)d->n, count = (size_t)d->n_pins;
    for (size_t k = 0; k < count; k++) {
        size_t v = (size_t)d->held[k];
        for (size_t c = 0; c < 3; c++) {
            d->G[c * n + k] = d->target[3 * v + c] - d->rest[c * n + v];
        }
    }
}

/* Moves components without held vertices so that their mean stays that of d->Y. */
static void keep_means(deformer *d) {
    size_t n = (size_t)d->n;
    if (d->method != DEFORM_ARAP) {
        return;
    }
    memset(d->mean, 0, 3 * (size_t)d->n_components * sizeof *d->mean);
    for (size_t k = 0; k < 3 * n; k++) {
        size_t part = (size_t)d->component[k % n];
        d->mean[3 * part + k / n] += (d->Y[k] - d->rest[k] - d->U[k]) / (double)d->sizes[part];
    }
    for (size_t k = 0; k < 3 * n; k++) {
        size_t part = (size_t)d->component[k % n];
        d->U[k] += d->n_held[part] == 0 ? d->mean[3 * part + k / n] : 0;
    }
}

/* The displacement of vertex v in direction c, of which a solve computed u. */
static double displacement(const deformer *d, size_t v, size_t c, double u) {
    return d->is_held[v] && is_alone(d, (sl_int)v)
               ? d->target[3 * v + c] - d->rest[c * (size_t)d->n + v]
               : u;
}

/* Solves for displacements d->U with the right-hand side d->B and the displacements d->G of pins,
 * which are all 0 if at_rest. */
static sl_status solve_pinned(deformer *d, bool at_rest) {
    const size_t n = (size_t)d->n;
    sl_status status = SL_OK;
    if (!d->anew) {
        status = sl_constraints_solve(d->pins, NULL, d->U, n, d->B, n, d->G, n, 3, d->W);
    }
    return is_refused(d, status) ? deformer_solve_anew(d, at_rest) : status;
}

static sl_status step_pinned(void *context, deformer *d, double *X) {
    (void)context;
    return deformer_solve_step(d, X);
}

/* Biharmonic displacements d->U: by the factor of K and corrections, or by the mixed system where K
 * has too few digits, with these handles and then with all others. */
static sl_status solve_biharmonic(deformer *d) {
    sl_status status = SL_OK;
    if (d->squared) {
        bool good = false;
        double first = INFINITY;
        status = solve_pinned(d, false);
        status = status == SL_OK ? deformer_correct(d, step_pinned, NULL, &first, &good) : status;
        d->squared = good || (status != SL_OK && !deformer_is_refusal(status));
        d->accurate = d->squared && first <= 1e-6;
    }
    return d->squared ? status : deformer_solve_mixed(d, false);
}

sl_status deformer_solve(deformer *d) {
    size_t n = (size_t)d->n;
    double range = 0;
    if (d->method == DEFORM_ARAP) {
        arap_surface_forces(&d->arap, d->B);
        for (size_t k = 0; k < 3 * n; k++) {
            d->B[k] -= d->balance[k];
        }
    }
    gather_pins(d);
    const sl_status status =
        d->method == DEFORM_BIHARMONIC ? solve_biharmonic(d) : solve_pinned(d, false);
    if (status != SL_OK) {
        return status;
    }
    keep_means(d);
    for (size_t k = 0; k < 3 * n; k++) {
        d->U[k] = displacement(d, k % n, k / n, d->U[k]);
        range += fabs(d->U[k]);
    }
    if (!isfinite(range)) {
        return SL_ERR_NOT_FINITE;
    }
    for (size_t k = 0; k < 3 * n; k++) {
        d->Y[k] = d->rest[k] + d->U[k];
    }
    return SL_OK;
}

/* Subtracts the mean of U on components without held vertices. */
static void remove_means(deformer *d) {
    const size_t n = (size_t)d->n;
    memset(d->mean, 0, 3 * (size_t)d->n_components * sizeof *d->mean);
    for (size_t k = 0; k < 3 * n; k++) {
        const size_t part = (size_t)d->component[k % n];
        d->mean[3 * part + k / n] += d->U[k] / (double)d->sizes[part];
    }
    for (size_t k = 0; k < 3 * n; k++) {
        const size_t part = (size_t)d->component[k % n];
        d->U[k] -= d->n_held[part] == 0 ? d->mean[3 * part + k / n] : 0;
    }
}

sl_status deformer_solve_step(deformer *d, double *X) {
    const size_t n = (size_t)d->n;
    memset(d->G, 0, 3 * n * sizeof *d->G);
    const sl_status status = solve_pinned(d, true);
    if (status == SL_OK) {
        remove_means(d);
    }
    for (size_t k = 0; k < 3 * n && status == SL_OK; k++) {
        X[k] = d->is_held[k % n] ? 0 : d->U[k];
    }
    return status;
}

sl_status deformer_watch(deformer *d, const sl_int *vertices, sl_int count) {
    if (d->method != DEFORM_BIHARMONIC) {
        return SL_ERR_UNSUPPORTED;
    }
    sl_int *copy = integers((size_t)count);
    sl_plan *plan = NULL;
    sl_status status =
        copy == NULL ? SL_ERR_MEMORY
                     : sl_plan_create(&plan, d->S, vertices, 0, vertices, count, NULL, &d->stats);
    if (status != SL_OK) {
        free(copy);
        return status;
    }
    memcpy(copy, vertices, (size_t)count * sizeof *copy);
    free(d->watched);
    sl_plan_free(d->near);
    d->watched = copy;
    d->n_watched = count;
    d->near = plan;
    return SL_OK;
}

sl_status deformer_solve_watched(deformer *d, double *Y) {
    size_t n = (size_t)d->n, count = (size_t)d->n_watched;
    gather_pins(d);
    /* whether K has the digits is seen once, by a solution everywhere */
    sl_status status = d->accurate ? SL_OK : solve_biharmonic(d);
    const bool is_full = !d->accurate;
    gather_pins(d);
    if (status == SL_OK && !d->anew && !is_full) {
        status = sl_constraints_solve(d->pins, d->near, Y, count, d->B, 0, d->G, n, 3, d->W);
    }
    if (is_full || is_refused(d, status)) {
        status = is_full ? status : deformer_solve_anew(d, false);
        for (size_t k = 0; k < 3 * count && status == SL_OK; k++) {
            Y[k] = d->U[k / count * n + (size_t)d->watched[k % count]];
        }
    }
    for (size_t k = 0; k < 3 * count && status == SL_OK; k++) {
        size_t v = (size_t)d->watched[k % count], at = k / count * n + v;
        bool is_free = d->n_held[d->component[v]] == 0;
        Y[k] = d->rest[at] + displacement(d, v, k / count, is_free ? 0 : Y[k]);
    }
    return status;
}
