/* constraints_capacitance.h: the sweeps of pins, and the factor of their capacitance matrix */
#ifndef SLI_CONSTRAINTS_CAPACITANCE_H
#define SLI_CONSTRAINTS_CAPACITANCE_H

#include "../inverse/block.h"
#include "constraints_nulls.h"

/* Clears the null pivots of an equality's trees in a vector. */
static void sli_pin_clear_nulls(const sl_constraints *P, const sli_pin *pin, const sli_reach *R,
                                double *y, sl_int lanes) {
    sl_int k;
    for (k = 0; k < pin->n_nulls; k++) {
        const ptrdiff_t at = sli_reach_index_of(R, P->F->null.pivots[pin->nulls[k]]);
        if (at != -1) {
            SLI_ZERO(y + at * lanes, lanes);
        }
    }
}

/* y := L^-1 P c, u := D^-1 y */
static void sli_pin_sweep(const sl_constraints *P, sli_pin *pin, double *scratch) {
    const sl_factor *F = P->F;
    const sl_symbolic *S = F->S;
    sli_forward f;
    sl_int k;
    SLI_ZERO(pin->y, pin->R.columns);
    for (k = 0; k < pin->count; k++) {
        pin->y[sli_reach_index_of(&pin->R, S->iperm[pin->rows[k]])] += pin->values[k];
    }
    sli_forward_sweep(F, SLI_NRHS_1, &pin->R, pin->y, scratch);
    sli_pin_clear_nulls(P, pin, &pin->R, pin->y, 1);
    f.reach = pin->R;
    f.lanes = 1;
    f.y = pin->y;
    sli_forward_divide(F, &f, pin->u);
}

static void sli_pin_free(const sl_constraints *P, sli_pin *pin) {
    sli_free(&P->allocator, pin->nulls);
    sli_free(&P->allocator, pin);
}

/* An equality as it is given: c has `count` entries, `values` in these rows of A. */
typedef struct sli_equality {
    const sl_int *rows;
    const double *values;
    sl_int count;
} sli_equality;

SLI_INLINE sli_equality sli_equality_of(const sl_int *rows, const double *values, sl_int count) {
    sli_equality e;
    e.rows = rows;
    e.values = values;
    e.count = count;
    return e;
}

/* Makes the object of an equality whose sorted rows are `set` and reach R, without y and u. */
static sl_status sli_pin_new(sli_pin **out, const sl_constraints *P, sli_set *set, sl_int count,
                             const sli_reach *R) {
    sli_pin pin;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    SLI_CLEAR(pin);
    pin.count = count;
    SLI_LAYOUT(&b, &P->allocator, status) {
        *out = (sli_pin *)sli_take(&b, 1, sizeof **out);
        sli_set_layout_reach(set, &b, R);
        pin.rows = SLI_TAKE(&b, sl_int, count);
        pin.values = SLI_TAKE(&b, double, count);
        pin.y = SLI_TAKE(&b, double, R->columns);
        pin.u = SLI_TAKE(&b, double, R->columns);
    }
    if (status == SL_OK) {
        const sl_int *unused;
        **out = pin;
        sli_set_fill(P->F->S, set, &(*out)->R, &unused);
    }
    return status;
}

/* Copies an equality in the order of its sorted rows, scaled, so that squares are no zeros. */
static void sli_pin_fill(sli_pin *pin, const sli_equality *e, const uint64_t *order) {
    double most = 0.0;
    sl_int k;
    for (k = 0; k < e->count; k++) {
        most = fmax(most, fabs(e->values[k]));
    }
    (void)frexp(most, &pin->exponent);
    pin->exponent = 1 - pin->exponent;
    for (k = 0; k < e->count; k++) {
        pin->rows[k] = e->rows[sli_value(order[k])];
        pin->values[k] = ldexp(e->values[sli_value(order[k])], pin->exponent);
    }
}

/* Makes an equality; without y and u if is_swept is 0. */
static sl_status sli_pin_create(sli_pin **out, const sl_constraints *P, const sli_equality *e,
                                int is_swept, sl_stats *stats) {
    const sl_symbolic *S = P->F->S;
    sli_block seeds = {NULL, 0};
    sli_set set = sli_set_of(S, e->rows, e->count);
    sli_reach R;
    sli_pin *pin = NULL;
    double *scratch = NULL;
    sl_status status = SL_OK;
    sl_int row = -1;
    *out = NULL;
    SLI_LAYOUT(&seeds, &P->allocator, status) {
        sli_set_layout_seeds(&set, &seeds);
        scratch =
            SLI_TAKE(&seeds, double, is_swept ? sli_sweep_scratch(S->tallest, S->widest, 1) : 0);
    }
    status = status == SL_OK ? sli_set_sort(S, &set, stats) : status;
    if (status == SL_OK) {
        sli_set_measure(S, &set, &R);
        status = sli_pin_new(&pin, P, &set, e->count, &R);
    }
    if (status == SL_OK) {
        sli_pin_fill(pin, e, set.seeds);
        status = sli_pin_find_nulls(P, pin, &row);
        if (status == SL_OK) {
            *out = pin;
        } else {
            sli_pin_free(P, pin);
        }
        if (status == SL_OK && is_swept) {
            sli_pin_sweep(P, pin, scratch);
        }
    }
    sli_free(&P->allocator, seeds.base);
    return row == -1 ? status : sli_fail_at(stats, status, row, -1, 0.0, sli_nulls_unknown);
}

/* sums(r) := sum over the shared columns of u(k) x(k, r). x: the vector of a reach. */
static void sli_pin_dot(const sli_pin *pin, const sli_reach *R, const double *x, sl_int lanes,
                        double *sums) {
    sli_intersection m = sli_intersection_of(&pin->R, R);
    double chains[SLI_TILE] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    while (sli_intersection_next(&m)) {
        sli_chains_add(chains, pin->u + m.in_a, x + (ptrdiff_t)lanes * m.in_b, SLI_TILE, m.count,
                       lanes);
    }
    sli_chains_sum(chains, lanes, sums);
}

/* x += y f' in the shared columns. */
static void sli_pin_add(const sli_pin *pin, const sli_reach *R, double *x, sl_int lanes,
                        const double *f) {
    sli_intersection m = sli_intersection_of(&pin->R, R);
    sl_int k, r;
    while (sli_intersection_next(&m)) {
        for (k = 0; k < m.count; k++) {
            double *row = x + (ptrdiff_t)lanes * (m.in_b + k);
            for (r = 0; r < lanes; r++) {
                row[r] += pin->y[m.in_a + k] * f[r];
            }
        }
    }
}

/* Factors row k of K = L D L', of which row-major K holds L, with D on the diagonal. */
static void sli_capacitance_factor(double *K, size_t ld, sl_int k) {
    double *row = K + (size_t)k * ld;
    sl_int i;
    for (i = 0; i < k; i++) { /* row(i) = l(i) d(i) */
        row[i] -= sli_dot(K + (size_t)i * ld, row, i);
    }
    for (i = 0; i < k; i++) {
        const double x = row[i];
        row[i] = x / K[(size_t)i * ld + (size_t)i];
        row[k] -= x * row[i];
    }
}

/* Factors row k of the pins' K. A pin that depends on the others leaves a pivot of rounding
 * errors. */
static sl_status sli_constraints_factor(sl_constraints *P, sl_int k) {
    const double *d = &P->K[(size_t)k * (size_t)P->capacity + (size_t)k], own = *d;
    sli_capacitance_factor(P->K, (size_t)P->capacity, k);
    if (!sli_is_finite(*d)) {
        return sli_refuse(SL_ERR_NOT_FINITE, NULL); /* sli_constraints_refuse names the row */
    }
    return *d * P->sign > (64.0 + k) * 8.0 * DBL_EPSILON * fabs(own)
               ? SL_OK
               : sli_refuse(SL_ERR_PIVOT, NULL);
}

/* Refuses a row, or an equality of several rows, that sli_constraints_factor has refused. */
SLI_COLD static sl_status sli_constraints_refuse(const sl_constraints *P, sl_status status,
                                                 sl_int row, sl_int count, sl_stats *stats) {
    const char *what = status == SL_ERR_PIVOT ? "it depends on the other pins and equalities"
                                              : "numbers of F overflow in its solution";
    sl_int k;
    for (k = 0; k < P->n_pins && count == 1 && status == SL_ERR_PIVOT; k++) {
        if (P->pins[k]->count == 1 && P->pins[k]->rows[0] == row) {
            what = sli_pinned_twice;
        }
    }
    return sli_fail_at(stats, status, row, -1, 0.0, what);
}

/* Removes equality p: the rows below it take over what its column contributed, a rank-one update of
 * their factor. */
static void sli_constraints_remove(sl_constraints *P, sl_int p) {
    const size_t ld = (size_t)P->capacity;
    double *y = P->scratch, *b = y + ld, alpha = P->K[(size_t)p * ld + (size_t)p];
    sl_int i, j;
    for (i = p + 1; i < P->n_pins; i++) { /* by rows: entries of a column are far apart */
        double *l = P->K + (size_t)i * ld, x = l[p], d = l[i];
        for (j = p + 1; j < i; j++) {
            x -= y[j] * l[j];
            l[j] += b[j] * x;
        }
        l[i] = d + alpha * x * x;
        y[i] = x;
        b[i] = alpha * x / l[i];
        alpha *= d / l[i];
    }
    for (i = p; i + 1 < P->n_pins; i++) {
        double *to = P->K + (size_t)i * ld;
        const double *from = to + ld;
        memmove(to, from, (size_t)p * sizeof *to);
        memmove(to + p, from + p + 1, (size_t)(i + 1 - p) * sizeof *to);
        P->pins[i] = P->pins[i + 1];
    }
    P->n_pins--;
}

/* Makes room for more equalities. */
static sl_status sli_constraints_grow(sl_constraints *P, sl_int more) {
    const sl_int capacity = sli_max(sli_max(8, 2 * P->capacity), P->n_pins + more);
    sli_block b = {NULL, 0};
    sli_pin **pins = NULL;
    double *K = NULL, *scratch = NULL;
    sl_status status = SL_OK;
    sl_int i;
    if (P->n_pins + more <= P->capacity) {
        return SL_OK;
    }
    SLI_ASSERT(P->capacity <= INT32_MAX / 4); /* a larger K has 2^61 bytes */
    SLI_LAYOUT(&b, &P->allocator, status) {
        pins = SLI_TAKE(&b, sli_pin *, capacity);
        K = SLI_TAKE(&b, double, (uint64_t)capacity *(uint64_t)capacity);
        scratch = SLI_TAKE(&b, double, 2 * (uint64_t)capacity);
    }
    if (status != SL_OK) {
        return status;
    }
    for (i = 0; i < P->n_pins; i++) {
        pins[i] = P->pins[i];
        memcpy(K + (size_t)i * (size_t)capacity, P->K + (size_t)i * (size_t)P->capacity,
               ((size_t)i + 1) * sizeof *K);
    }
    sli_free(&P->allocator, P->pins); /* the first array of its block */
    P->pins = pins;
    P->K = K;
    P->scratch = scratch;
    P->capacity = capacity;
    return SL_OK;
}

/* Adds an equality. On error P is as before. */
static sl_status sli_constraints_push(sl_constraints *P, const sli_equality *e, sl_stats *stats) {
    const sl_int at = P->n_pins;
    sli_pin *pin = NULL;
    sl_status status = sli_constraints_grow(P, 1);
    sl_int i;
    status = status == SL_OK ? sli_pin_create(&pin, P, e, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    P->pins[at] = pin;
    for (i = 0; i <= at; i++) {
        double *entry = P->K + (size_t)at * (size_t)P->capacity + (size_t)i;
        sli_pin_dot(P->pins[i], &pin->R, pin->y, 1, entry);
        *entry += sli_pin_nulls_dot(P->pins[i], pin) / P->delta;
    }
    status = sli_constraints_factor(P, at);
    if (status != SL_OK) {
        sli_pin_free(P, pin);
        return sli_constraints_refuse(P, status, e->rows[0], e->count, stats);
    }
    sli_constraints_count_nulls(P, pin, 1);
    P->n_pins++;
    return SL_OK;
}

/* f := K^-1 f, count rows of lanes numbers. */
SLI_HOT static void sli_capacitance_solve(const double *K, size_t ld, sl_int count, double *f,
                                          sl_int lanes) {
    sl_int i, j, r;
    for (i = 1; i < count; i++) {
        double chains[SLI_TILE] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, sums[SLI_TILE];
        sli_chains_add(chains, K + (size_t)i * ld, f, SLI_TILE, i, lanes);
        sli_chains_sum(chains, lanes, sums);
        for (r = 0; r < lanes; r++) {
            f[(ptrdiff_t)i * lanes + r] -= sums[r];
        }
    }
    for (i = count - 1; i >= 0; i--) {
        const double *l = K + (size_t)i * ld;
        double *x = f + (ptrdiff_t)i * lanes;
        for (r = 0; r < lanes; r++) {
            x[r] /= l[i];
        }
    }
    for (i = count - 1; i > 0; i--) {
        const double *l = K + (size_t)i * ld, *x = f + (ptrdiff_t)i * lanes;
        for (j = 0; j < i; j++) {
            for (r = 0; r < lanes; r++) {
                f[(ptrdiff_t)j * lanes + r] -= l[j] * x[r];
            }
        }
    }
}

static void sli_constraints_apply(const sl_constraints *P, double *f, sl_int lanes) {
    sli_capacitance_solve(P->K, (size_t)P->capacity, P->n_pins, f, lanes);
}

#endif
