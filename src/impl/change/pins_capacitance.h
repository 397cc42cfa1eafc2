/* pins_capacitance.h: the sweeps of pins, and the factor of their capacitance matrix */
#ifndef SLI_CHANGE_PINS_CAPACITANCE_H
#define SLI_CHANGE_PINS_CAPACITANCE_H

#include "pins_types.h"

/* The null pivot of the tree of a reach, which is not empty. Null pivots without a known null
 * vector, or several in one tree, are not supported. */
static sl_status sli_pin_null(const sl_factor *F, const sli_reach *R, sl_int *null) {
    const sl_int last = R->count - 1;
    sl_int s, first, count;
    *null = -1;
    if (F->n_nulls == 0) {
        return SL_OK;
    }
    for (s = 0; s < last; s++) {
        if (R->steps[s].up == -1) { /* an equality over several trees */
            return SL_ERR_UNSUPPORTED;
        }
    }
    s = F->S->super_of[R->steps[last].column];
    first = sli_lower_bound(F->nulls, F->n_nulls, F->S->super_first[F->S->first_descendant[s]]);
    count = sli_lower_bound(F->nulls, F->n_nulls, F->S->super_first[s + 1]) - first;
    if (count == 0) {
        return SL_OK;
    }
    *null = F->nulls[first];
    return count > 1 || F->null_vectors > 1 || F->g[*null] == 0.0 ? SL_ERR_UNSUPPORTED : SL_OK;
}

/* y := L^-1 P c, and z' c. */
static sl_status sli_pin_sweep(const sl_pins *P, sli_pin *pin, double *scratch) {
    const sl_factor *F = P->F;
    const sl_symbolic *S = F->S;
    sl_status status;
    sl_int k;
    memset(pin->y, 0, (size_t)pin->R.columns * sizeof(double));
    for (k = 0; k < pin->count; k++) {
        pin->y[sli_reach_index_of(&pin->R, S->iperm[pin->rows[k]])] += pin->values[k];
    }
    sli_forward_sweep(F, SLI_NRHS_1, pin->R.count, pin->R.steps, pin->R.rows, pin->y, scratch);
    pin->z = 0.0;
    status = sli_pin_null(F, &pin->R, &pin->null);
    if (status == SL_OK && pin->null != -1) {
        for (k = 0; k < pin->count; k++) {
            pin->z += pin->values[k] * F->z[S->iperm[pin->rows[k]]];
        }
        pin->z /= F->z[pin->null];
        pin->y[sli_reach_index_of(&pin->R, pin->null)] = pin->z;
    }
    return status;
}

/* Makes an equality. */
static sl_status sli_pin_create(sli_pin **out, const sl_pins *P, const sl_int *rows,
                                const double *values, sl_int count, sl_stats *stats) {
    const sl_symbolic *S = P->F->S;
    sli_block seeds = {NULL, 0, 0}, kept = {NULL, 0, 0};
    sli_set set = sli_set_of(S, rows, count);
    sli_reach R;
    sli_pin *pin = NULL;
    double *scratch = NULL;
    const sl_int *unused;
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_set_layout_seeds(&set, &seeds);
        scratch = SLI_TAKE(&seeds, double, sli_sweep_scratch(S->tallest, S->widest, 1));
        status = pass == 0 ? sli_block_alloc(&seeds, &P->allocator) : SL_OK;
    }
    status = status == SL_OK ? sli_set_sort(S, &set, stats) : status;
    if (status == SL_OK) {
        sli_set_measure(S, &set, &R);
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        pin = (sli_pin *)sli_take(&kept, 1, sizeof *pin);
        sli_set_layout_reach(&set, &kept, &R);
        if (pass == 1) {
            memset(pin, 0, sizeof *pin);
        }
        {
            sl_int *copy = SLI_TAKE(&kept, sl_int, count);
            double *x = SLI_TAKE(&kept, double, count);
            double *y = SLI_TAKE(&kept, double, R.columns);
            if (pass == 1) {
                pin->rows = copy;
                pin->values = x;
                pin->y = y;
            }
        }
        status = pass == 0 ? sli_block_alloc(&kept, &P->allocator) : SL_OK;
    }
    if (status == SL_OK) {
        pin->count = count;
        memcpy(pin->rows, rows, (size_t)count * sizeof *rows);
        memcpy(pin->values, values, (size_t)count * sizeof *values);
        sli_set_fill(S, &set, &pin->R, &unused);
        status = sli_pin_sweep(P, pin, scratch);
        *out = pin;
    }
    if (status != SL_OK) {
        sli_free(&P->allocator, kept.base);
        *out = NULL;
    }
    sli_free(&P->allocator, seeds.base);
    return status;
}

/* sums(r) += sum over the shared columns of a(k) D(k)^-1 x(k, r). x: the vector of a reach. */
static void sli_pin_dot(const sl_pins *P, const sli_pin *pin, const sli_reach *R, const double *x,
                        sl_int lanes, double *sums) {
    sli_intersection m = sli_intersection_of(&pin->R, R);
    sl_int k, r;
    while (sli_intersection_next(&m)) {
        for (k = 0; k < m.count; k++) {
            const double a = pin->y[m.in_a + k] * sli_pins_inverse(P, m.column + k);
            const double *row = x + (ptrdiff_t)lanes * (m.in_b + k);
            for (r = 0; r < lanes; r++) {
                sums[r] += a * row[r];
            }
        }
    }
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

/* Appends the last of P->count + 1 equalities to the factor of K. A pin that depends on the others
 * leaves a pivot of rounding errors. */
static sl_status sli_pins_append(sl_pins *P, const sli_pin *pin) {
    const sl_int k = P->count;
    const size_t ld = (size_t)P->capacity;
    double *row = P->K + (size_t)k * ld, own = 0.0, d;
    sl_int i, j;
    sli_pin_dot(P, pin, &pin->R, pin->y, 1, &own);
    d = own;
    for (i = 0; i < k; i++) {
        row[i] = 0.0;
        sli_pin_dot(P, P->pins[i], &pin->R, pin->y, 1, &row[i]);
        for (j = 0; j < i; j++) { /* row(i) = l(i) d(i) */
            row[i] -= P->K[(size_t)i * ld + (size_t)j] * row[j];
        }
    }
    for (i = 0; i < k; i++) {
        const double x = row[i];
        row[i] = x / P->K[(size_t)i * ld + (size_t)i];
        d -= x * row[i];
    }
    row[k] = d;
    if (!sli_is_finite(d)) {
        return SL_ERR_NOT_FINITE;
    }
    return d * P->sign > (64.0 + k) * 8.0 * DBL_EPSILON * fabs(own) ? SL_OK : SL_ERR_PIVOT;
}

/* Removes equality p: the rows below it take over what its column contributed, a rank-one update of
 * their factor. */
static void sli_pins_remove(sl_pins *P, sl_int p) {
    const size_t ld = (size_t)P->capacity;
    double *w = P->scratch, alpha = P->K[(size_t)p * ld + (size_t)p];
    sl_int i, j;
    for (i = p + 1; i < P->count; i++) {
        w[i] = P->K[(size_t)i * ld + (size_t)p];
    }
    for (j = p + 1; j < P->count; j++) {
        double *at = &P->K[(size_t)j * ld + (size_t)j];
        const double y = w[j], d = *at, e = d + alpha * y * y, b = alpha * y / e;
        alpha *= d / e;
        *at = e;
        for (i = j + 1; i < P->count; i++) {
            double *l = &P->K[(size_t)i * ld + (size_t)j];
            w[i] -= y * *l;
            *l += b * w[i];
        }
    }
    for (i = p; i + 1 < P->count; i++) {
        double *to = P->K + (size_t)i * ld;
        const double *from = to + ld;
        memmove(to, from, (size_t)p * sizeof *to);
        memmove(to + p, from + p + 1, (size_t)(i + 1 - p) * sizeof *to);
        P->pins[i] = P->pins[i + 1];
    }
    P->count--;
}

/* Makes room for one more equality. */
static sl_status sli_pins_grow(sl_pins *P) {
    const sl_int capacity = P->capacity < 4 ? 8 : 2 * P->capacity;
    sli_block b = {NULL, 0, 0};
    sli_pin **pins = NULL;
    double *K = NULL, *scratch = NULL;
    sl_status status = SL_OK;
    sl_int i;
    int pass;
    if (P->count < P->capacity) {
        return SL_OK;
    }
    SLI_ASSERT(P->capacity <= INT32_MAX / 4); /* a larger K has 2^61 bytes */
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        pins = SLI_TAKE(&b, sli_pin *, capacity);
        K = SLI_TAKE(&b, double, (uint64_t)capacity *(uint64_t)capacity);
        scratch = SLI_TAKE(&b, double, 2 * (uint64_t)capacity);
        status = pass == 0 ? sli_block_alloc(&b, &P->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    for (i = 0; i < P->count; i++) {
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

/* f := K^-1 f, lanes numbers in each row. */
static void sli_pins_apply(const sl_pins *P, double *f, sl_int lanes) {
    const size_t ld = (size_t)P->capacity;
    sl_int i, j, r;
    for (i = 0; i < P->count; i++) {
        for (j = 0; j < i; j++) {
            for (r = 0; r < lanes; r++) {
                f[i * lanes + r] -= P->K[(size_t)i * ld + (size_t)j] * f[j * lanes + r];
            }
        }
    }
    for (i = P->count - 1; i >= 0; i--) {
        for (r = 0; r < lanes; r++) {
            f[i * lanes + r] /= P->K[(size_t)i * ld + (size_t)i];
        }
        for (j = i + 1; j < P->count; j++) {
            for (r = 0; r < lanes; r++) {
                f[i * lanes + r] -= P->K[(size_t)j * ld + (size_t)i] * f[j * lanes + r];
            }
        }
    }
}

#endif
