/* deformer_relax.c: as-rigid-as-possible positions to convergence, by few solves with the factor */
#include "deformer_relax.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "arap_hessian.h"

enum { PAIRS = 8 }; /* of steps and changes of the gradient that are kept */

/* The Hessian is factored again after each step that moved a vertex by more than SETTLED
 * diagonals, and after RENEWED shorter ones: where it bends on the way, the last factor leads on
 * for hundreds. */
#define SETTLED 0.002
enum { RENEWED = 6 };

/* A step is doubled while this part of the slope is left at its end: along a direction where the
 * Hessian is close to indefinite its minimum says little about that of the energy. */
#define SLOPE_LEFT 0.3

typedef struct relaxation {
    deformer *d;
    size_t n3;                           /* 3 n */
    double *gradient, *direction, *from; /* n3 each */
    double *step[PAIRS], *change[PAIRS]; /* n3 each, of iteration k at k % PAIRS */
    double product[PAIRS];               /* step' change */
    int count;                           /* of pairs so far */
    double energy;
    double *halfway; /* n3: positions after half of the solves that are allowed */
    arap_hessian hessian;
    bool has_hessian; /* factored */
} relaxation;

static double dot(const double *a, const double *b, size_t n) {
    double sum = 0;
    for (size_t k = 0; k < n; k++) {
        sum += a[k] * b[k];
    }
    return sum;
}

/* The energy at d->Y, and half its gradient K u - (b(R) - K x), 0 at vertices that are held. */
static sl_status evaluate(relaxation *r) {
    deformer *d = r->d;
    const size_t n = (size_t)d->n;
    const sl_csc K = sl_matrix_view(d->K);
    r->energy = arap_surface_rotations(&d->arap, d->Y);
    arap_surface_forces(&d->arap, d->B);
    const sl_status status = sl_csc_multiply(&K, SL_AS_SYMMETRIC, r->gradient, n, d->Y, n, 3);
    for (size_t k = 0; k < r->n3; k++) {
        r->gradient[k] = d->is_held[k % n] ? 0 : r->gradient[k] - d->B[k];
    }
    return status;
}

/* direction = -H^-1 gradient by the two loops of L-BFGS, with the factor of K in the middle. */
static sl_status find_direction(relaxation *r) {
    double alpha[PAIRS], *q = r->d->B;
    const int oldest = r->count > PAIRS ? r->count - PAIRS : 0;
    memcpy(q, r->gradient, r->n3 * sizeof *q);
    for (int k = r->count - 1; k >= oldest; k--) {
        const int at = k % PAIRS;
        alpha[at] = dot(r->step[at], q, r->n3) / r->product[at];
        for (size_t j = 0; j < r->n3; j++) {
            q[j] -= alpha[at] * r->change[at][j];
        }
    }
    memset(r->direction, 0, r->n3 * sizeof *q);
    const sl_status status = r->has_hessian ? arap_hessian_solve(&r->hessian, r->direction, q)
                                            : deformer_solve_step(r->d, r->direction);
    for (int k = oldest; k < r->count && status == SL_OK; k++) {
        const int at = k % PAIRS;
        const double beta = dot(r->change[at], r->direction, r->n3) / r->product[at];
        for (size_t j = 0; j < r->n3; j++) {
            r->direction[j] += (alpha[at] - beta) * r->step[at][j];
        }
    }
    for (size_t j = 0; j < r->n3; j++) {
        r->direction[j] = -r->direction[j];
    }
    return status;
}

static double slope_of(const relaxation *r) {
    return 2 * dot(r->gradient, r->direction, r->n3);
}

/* Evaluates at t times the direction from the start of the step. */
static sl_status go_to(relaxation *r, double t) {
    for (size_t k = 0; k < r->n3; k++) {
        r->d->Y[k] = r->from[k] + t * r->direction[k];
    }
    return evaluate(r);
}

/* Doubles the full step, with the slope at its begin, while that lowers the energy. */
static sl_status lengthen(relaxation *r, double slope) {
    sl_status status = SL_OK;
    for (double t = 1; status == SL_OK && t < 1000 && slope_of(r) < SLOPE_LEFT * slope; t *= 2) {
        const double before = r->energy;
        status = go_to(r, 2 * t);
        if (status == SL_OK && !(r->energy < before)) {
            return go_to(r, t);
        }
    }
    return status;
}

/* Moves along the direction until the energy falls by a part of what the slope promises; keeps step
 * and change of the gradient. False: no step lowers it. */
static bool advance(relaxation *r) {
    double *step = r->step[r->count % PAIRS], *change = r->change[r->count % PAIRS];
    const double before = r->energy, slope = slope_of(r);
    memcpy(r->from, r->d->Y, r->n3 * sizeof *r->from);
    memcpy(change, r->gradient, r->n3 * sizeof *change);
    for (double t = 1; slope < 0 && t > 1e-10; t *= 0.5) {
        if (go_to(r, t) != SL_OK) {
            break;
        }
        if (r->energy <= before + 1e-4 * t * slope) {
            if (t == 1 && lengthen(r, slope) != SL_OK) {
                break;
            }
            for (size_t k = 0; k < r->n3; k++) {
                step[k] = r->d->Y[k] - r->from[k];
                change[k] = r->gradient[k] - change[k];
            }
            r->product[r->count % PAIRS] = dot(step, change, r->n3);
            r->hessian.soft = t == 1 ? r->hessian.soft / 2 : fmin(1, 2 * r->hessian.soft + 0.25);
            return true;
        }
    }
    memcpy(r->d->Y, r->from, r->n3 * sizeof *r->from);
    (void)evaluate(r);
    return false;
}

/* The largest distance between positions, in diagonals. */
static double farthest(const double *A, const double *B, const deformer *d) {
    const size_t n = (size_t)d->n;
    double most = 0;
    for (size_t v = 0; v < n; v++) {
        most =
            fmax(most, hypot(hypot(A[v] - B[v], A[n + v] - B[n + v]), A[2 * n + v] - B[2 * n + v]));
    }
    return most / d->diameter;
}

/* Factors the Hessian at the present rotations. Where that fails, as on nearly degenerate faces,
 * the matrix of the global step serves. */
static sl_status renew(relaxation *r) {
    const deformer *d = r->d;
    sl_status status = SL_OK;
    if (r->hessian.a == NULL) {
        unsigned char *fixed = (unsigned char *)malloc((size_t)d->n + 1);
        for (sl_int v = 0; v < d->n && fixed != NULL; v++) {
            const sl_int part = d->component[v];
            fixed[v] = d->n_held[part] == 0 || d->sizes[part] == 1 ? 2 : d->is_held[v] ? 1 : 0;
        }
        status = fixed != NULL ? arap_hessian_create(&r->hessian, &d->arap, fixed) : SL_ERR_MEMORY;
        free(fixed);
        r->hessian.soft = 1;
    }
    r->has_hessian = status == SL_OK && arap_hessian_factor(&r->hessian, d->Y) == SL_OK;
    r->count = 0; /* pairs of another Hessian mislead */
    return status;
}

static sl_status iterate(relaxation *r, double tolerance, int limit, deformer_rest *how) {
    int small = 0, renewed = 0; /* at this solve */
    bool again = false;         /* the last direction led nowhere */
    sl_status status = SL_OK;
    how->moved = 1;
    memcpy(r->halfway, r->d->Y, r->n3 * sizeof *r->halfway);
    while (status == SL_OK && !how->converged && how->solves < limit) {
        const double before = r->energy;
        if (!again && (how->moved > SETTLED || how->solves - renewed >= RENEWED)) {
            status = renew(r);
            renewed = how->solves;
        }
        if (how->solves == limit / 2) {
            memcpy(r->halfway, r->d->Y, r->n3 * sizeof *r->halfway);
        }
        status = status == SL_OK ? find_direction(r) : status;
        how->solves++;
        if (status == SL_OK && !advance(r)) { /* the global step is a way down if there is one */
            how->converged = again || (r->count == 0 && !r->has_hessian);
            r->has_hessian = false;
            r->count = 0;
            again = true;
            continue;
        }
        const int at = r->count % PAIRS;
        how->moved = farthest(r->d->Y, r->from, r->d);
        const bool is_small =
            how->moved <= 1e-14 || /* where the energy is 0 it is rounding */
            (how->moved <= tolerance && before - r->energy <= tolerance * fabs(before));
        small = is_small ? small + 1 : 0;
        how->converged = small >= 2;
        again = false;
        /* a pair without curvature would not leave a descent direction */
        r->count = r->product[at] > 1e-14 * dot(r->step[at], r->step[at], r->n3) ? r->count + 1 : 0;
    }
    how->energy = r->energy;
    how->lately = how->converged ? 0 : farthest(r->d->Y, r->halfway, r->d);
    return status;
}

/* Moves the held vertices to their targets and the others along, by the Hessian at the present
 * rotations: for small motions the answer, for large ones good for the rotations. */
static sl_status start(relaxation *r) {
    deformer *d = r->d;
    const size_t n = (size_t)d->n;
    double range = 0;
    (void)deformer_rotations(d);
    sl_status status = renew(r);
    if (status == SL_OK && !r->has_hessian) {
        return deformer_solve(d);
    }
    for (size_t k = 0; k < r->n3; k++) {
        r->direction[k] = d->is_held[k % n] ? d->target[3 * (k % n) + k / n] - d->Y[k] : 0;
    }
    status = status == SL_OK ? arap_hessian_solve(&r->hessian, r->direction, NULL) : status;
    for (size_t k = 0; k < r->n3 && status == SL_OK; k++) {
        d->Y[k] += r->direction[k];
        range += fabs(d->Y[k]);
    }
    r->has_hessian = false;
    return status == SL_OK && !isfinite(range) ? SL_ERR_NOT_FINITE : status;
}

sl_status deformer_relax(deformer *d, double tolerance, int limit, deformer_rest *how) {
    relaxation r;
    memset(&r, 0, sizeof r);
    memset(how, 0, sizeof *how);
    r.d = d;
    r.n3 = 3 * (size_t)d->n;
    double *room = (double *)malloc((4 + 2 * PAIRS) * r.n3 * sizeof *room);
    if (room == NULL) {
        return SL_ERR_MEMORY;
    }
    r.gradient = room;
    r.direction = room + r.n3;
    r.from = room + 2 * r.n3;
    r.halfway = room + (3 + 2 * PAIRS) * r.n3;
    for (int k = 0; k < PAIRS; k++) {
        r.step[k] = room + (3 + (size_t)k) * r.n3;
        r.change[k] = room + (3 + PAIRS + (size_t)k) * r.n3;
    }
    sl_status status = start(&r);
    how->solves++;
    status = status == SL_OK ? evaluate(&r) : status;
    status = status == SL_OK ? iterate(&r, tolerance, limit, how) : status;
    arap_hessian_free(&r.hessian);
    free(room);
    return status;
}
