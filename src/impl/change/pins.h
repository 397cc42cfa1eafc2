/* pins.h: rows held at given values, and other equalities, without a change of the factor */
#ifndef SLI_CHANGE_PINS_H
#define SLI_CHANGE_PINS_H

#include "../../public/pins.h"
#include "../solve/plan.h"
#include "../solve/sweep.h"

/* Minimize x' A x / 2 - b' x with c_p' x = g_p for the columns c_p of a matrix C:
 *
 *     A x = b + C f,  K f = g - C' A^-1 b,  K = C' A^-1 C.
 *
 * With Y = L^-1 P C, kept in the reaches of its columns, K = Y' D^-1 Y, and C' A^-1 b = Y' D^-1 y
 * after the forward sweep y = L^-1 P b: a solve takes one forward and one backward sweep.
 *
 * In a singular component with null vector z, whose null pivot is N, let D(N) = delta. L is that of
 * a regular A + delta e e', e the unit vector of N. The solution of A is then that of this matrix
 * plus v z, where z' (b + C f) = 0, and v is the unknown that belongs to this equation. */

/* One equality. */
typedef struct sli_pin {
    sl_int null; /* the null pivot of its component; -1: none */
    double z;    /* z' c of the null vector, scaled to 1 at the null pivot; 0: none */
    sl_int count;
    sl_int *rows; /* count: the rows of c, and its entries */
    double *values;
    sli_reach R; /* of c */
    double *y;   /* R.columns: L^-1 P c */
} sli_pin;

struct sl_pins {
    sl_allocator allocator;
    const sl_factor *F; /* borrowed */
    sli_numbers numbers;
    double sign;      /* of all pivots */
    double delta;     /* takes the place of null pivots */
    double *divisors; /* n: D, with 1 at null pivots; NULL: there are none */
    sl_int count, capacity;
    sli_pin **pins;  /* capacity */
    double *K;       /* capacity x capacity, row-major: the factor L D L' of K, D on the diagonal */
    double *scratch; /* 2 capacity */
};

/* D^-1 of a column where null pivots are delta. */
SLI_INLINE double sli_pins_inverse(const sl_pins *P, sl_int column) {
    const double d = P->F->D[column];
    return 1.0 / (P->divisors != NULL && d == SLI_NULL_PIVOT ? P->delta : d);
}

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

/* Takes the numbers of F. */
static sl_status sli_pins_take(sl_pins *P) {
    const sl_factor *F = P->F;
    const sl_factor_info *info = &F->stats.factor;
    sl_int k;
    if (!F->is_valid) {
        return SL_ERR_STATE;
    }
    if (F->E != NULL || (info->positive > 0 && info->negative > 0)) {
        return SL_ERR_UNSUPPORTED;
    }
    P->sign = info->negative > 0 ? -1.0 : 1.0;
    P->delta = P->sign * (info->pivot_max > 0.0 ? info->pivot_max : 1.0);
    P->numbers = sli_numbers_of(F);
    for (k = 0; P->divisors != NULL && k < F->S->n; k++) {
        P->divisors[k] = F->D[k] == SLI_NULL_PIVOT ? 1.0 : F->D[k];
    }
    return SL_OK;
}

SL_API sl_status sl_pins_create(sl_pins **out, const sl_factor *F, const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sli_block b = {NULL, 0, 0};
    sl_pins *P = NULL;
    double *divisors = NULL;
    sl_status status = SL_OK;
    int pass;
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (F == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
        return SL_ERR_ARGUMENT;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        P = (sl_pins *)sli_take(&b, 1, sizeof *P);
        divisors = F->null_pivots == SL_NULL_PIVOT_SKIP ? SLI_TAKE(&b, double, F->S->n) : NULL;
        status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
    }
    if (status == SL_OK) {
        memset(P, 0, sizeof *P);
        P->allocator = a;
        P->F = F;
        P->divisors = divisors;
        status = sli_pins_take(P);
        if (status == SL_OK) {
            *out = P;
        } else {
            sl_pins_free(P);
        }
    }
    return status;
}

SL_API void sl_pins_free(sl_pins *P) {
    if (P != NULL) {
        const sl_allocator a = P->allocator;
        sl_int k;
        for (k = 0; k < P->count; k++) {
            sli_free(&a, P->pins[k]);
        }
        sli_free(&a, P->pins);
        sli_free(&a, P);
    }
}

SL_API sl_status sl_pins_add_equality(sl_pins *P, const sl_int *rows, const double *values,
                                      sl_int count, sl_stats *stats) {
    sli_pin *pin = NULL;
    sl_status status;
    sl_int k;
    sli_stats_clear_error(stats);
    if (P == NULL || count < 1 || rows == NULL || values == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (!P->F->is_valid || !sli_numbers_are_of(&P->numbers, P->F)) {
        return SL_ERR_STATE;
    }
    for (k = 0; k < count; k++) {
        if (!sli_is_finite(values[k])) {
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, rows[k], -1, values[k]);
        }
    }
    status = sli_pins_grow(P);
    status = status == SL_OK ? sli_pin_create(&pin, P, rows, values, count, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    status = sli_pins_append(P, pin);
    if (status != SL_OK) {
        sli_free(&P->allocator, pin);
        return sli_fail_at(stats, status, rows[0], -1, 0.0);
    }
    P->pins[P->count++] = pin;
    return SL_OK;
}

SL_API sl_status sl_pins_add(sl_pins *P, sl_int row, sl_stats *stats) {
    const double one = 1.0;
    return sl_pins_add_equality(P, &row, &one, 1, stats);
}

SL_API sl_status sl_pins_release(sl_pins *P, sl_int index) {
    sli_pin *pin;
    if (P == NULL || index < 0 || index >= P->count) {
        return SL_ERR_ARGUMENT;
    }
    pin = P->pins[index];
    sli_pins_remove(P, index);
    sli_free(&P->allocator, pin);
    return SL_OK;
}

SL_API sl_int sl_pins_count(const sl_pins *P) {
    return P == NULL ? 0 : P->count;
}

SL_API sl_status sl_pins_refactor(sl_pins *P) {
    sli_block b = {NULL, 0, 0};
    double *scratch = NULL;
    sl_status status;
    sl_int count, k;
    int pass;
    if (P == NULL) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_pins_take(P);
    P->numbers.generation = 0; /* until all of them are there */
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        scratch = SLI_TAKE(&b, double, sli_sweep_scratch(P->F->S->tallest, P->F->S->widest, 1));
        status = pass == 0 ? sli_block_alloc(&b, &P->allocator) : SL_OK;
    }
    count = P->count;
    P->count = 0;
    for (k = 0; k < count && status == SL_OK; k++) {
        status = sli_pin_sweep(P, P->pins[k], scratch);
        status = status == SL_OK ? sli_pins_append(P, P->pins[k]) : status;
        P->count++;
    }
    P->count = count;
    P->numbers.generation = status == SL_OK ? P->F->generation : 0;
    sli_free(&P->allocator, b.base);
    return status;
}

/* ---- solves ---- */

/* Arrays of a solve. */
typedef struct sli_pins_work {
    unsigned char *memory; /* of the sweeps */
    double *f;             /* count x lanes: g - C' A^-1 b, then f */
    double *v;             /* count x lanes: v, in the first row of each singular component */
    double *h, *z;         /* count: K^-1 z of a component, z */
} sli_pins_work;

static void sli_pins_layout(sli_pins_work *w, sli_block *b, const sl_pins *P, const sli_query *q,
                            sl_int nrhs) {
    w->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(q, nrhs, 8), 1);
    w->f = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->count);
    w->v = SLI_TAKE(b, double, SLI_TILE *(uint64_t)P->count);
    w->h = SLI_TAKE(b, double, P->count);
    w->z = SLI_TAKE(b, double, P->count);
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

/* Makes z' (b + C f) 0 in the component of pin p, the first one there: f -= K^-1 z v. y: after the
 * forward sweep; at the null pivot it is z' b. */
static void sli_pins_balance(const sl_pins *P, const sli_query *q, const sli_pins_work *w, sl_int p,
                             const double *y, sl_int lanes) {
    const sl_int null = P->pins[p]->null, at = sli_reach_index_of(&q->forward, null);
    double *v = w->v + p * lanes;
    double s = 0.0;
    sl_int k, r;
    for (k = 0; k < P->count; k++) {
        w->z[k] = w->h[k] = P->pins[k]->null == null ? P->pins[k]->z : 0.0;
    }
    sli_pins_apply(P, w->h, 1);
    for (r = 0; r < lanes; r++) {
        v[r] = at == -1 ? 0.0 : y[(ptrdiff_t)at * lanes + r];
    }
    for (k = 0; k < P->count; k++) {
        s += w->z[k] * w->h[k];
        for (r = 0; r < lanes; r++) {
            v[r] += w->z[k] * w->f[k * lanes + r];
        }
    }
    for (r = 0; r < lanes; r++) {
        v[r] = s != 0.0 ? v[r] / s : 0.0;
    }
    for (k = 0; k < P->count; k++) {
        for (r = 0; r < lanes; r++) {
            w->f[k * lanes + r] -= w->h[k] * v[r];
        }
    }
}

/* Is pin p the first one of a singular component? */
static int sli_pins_is_first(const sl_pins *P, sl_int p) {
    sl_int k = 0;
    while (P->pins[k]->null != P->pins[p]->null) {
        k++;
    }
    return k == p && P->pins[p]->null != -1;
}

/* Sets x at the null pivots: v in a component with pins, 0 in the others. */
static void sli_pins_shift(const sl_pins *P, const sli_query *q, const sli_pins_work *w, double *x,
                           sl_int lanes) {
    sl_int m, p, at;
    for (m = 0; m < P->F->n_nulls; m++) {
        at = sli_reach_index_of(&q->backward, P->F->nulls[m]);
        if (at != -1) {
            memset(x + (ptrdiff_t)at * lanes, 0, (size_t)lanes * sizeof(double));
        }
    }
    for (p = 0; p < P->count; p++) {
        if (sli_pins_is_first(P, p)) {
            at = sli_reach_index_of(&q->backward, P->pins[p]->null);
            if (at != -1) {
                memcpy(x + (ptrdiff_t)at * lanes, w->v + p * lanes, (size_t)lanes * sizeof(double));
            }
        }
    }
}

/* Solves one block of up to 8 right-hand sides. */
static void sli_pins_block(const sl_pins *P, const sli_query *q, const sli_pins_work *w, double *X,
                           sli_dense x_at, const double *B, sli_dense b_at, const double *G,
                           size_t ldg, sl_int nrhs) {
    const sl_factor *F = P->F;
    const sli_vectors v = sli_vectors_of(q, nrhs, w->memory);
    const int kind = sli_lanes_kind(nrhs);
    const sl_int lanes = (sl_int)1 << kind;
    sl_int p, r;
    sli_pack(q, F->kernels, v.y, B, b_at, lanes, nrhs);
    sli_sweep_forward(F, q, &v, nrhs);
    for (p = 0; p < P->count; p++) {
        double sums[SLI_TILE] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
        sli_pin_dot(P, P->pins[p], &q->forward, v.y, lanes, sums);
        for (r = 0; r < lanes; r++) {
            w->f[p * lanes + r] = r < nrhs ? G[(size_t)p + ldg * (size_t)r] - sums[r] : 0.0;
        }
    }
    sli_pins_apply(P, w->f, lanes);
    for (p = 0; p < P->count; p++) {
        if (sli_pins_is_first(P, p)) {
            sli_pins_balance(P, q, w, p, v.y, lanes);
        }
    }
    if (!q->is_shared) {
        sli_sweep_transfer(q, v.y, v.x, lanes);
    }
    for (p = 0; p < P->count; p++) {
        sli_pin_add(P->pins[p], &q->backward, v.x, lanes, w->f + p * lanes);
    }
    sli_pins_shift(P, q, w, v.x, lanes);
    sli_backward_sweep(F, kind, q->backward.count, q->backward.steps,
                       q->backward.rows + q->backward.n_rows,
                       P->divisors != NULL ? P->divisors : F->D, v.x, v.scratch);
    sli_unpack(q, F->kernels, X, x_at, v.x, lanes, nrhs);
}

SL_API sl_status sl_pins_solve(const sl_pins *P, const sl_plan *plan, double *X, size_t ldx,
                               const double *B, size_t ldb, const double *G, size_t ldg,
                               sl_int nrhs, sl_work *W) {
    sli_block counted = {NULL, 0, 0};
    sli_pins_work w;
    sli_query all;
    const sli_query *q = plan == NULL ? &all : &plan->query;
    sl_work own;
    sl_status status;
    sl_int r;
    if (P == NULL) {
        return SL_ERR_ARGUMENT;
    }
    all = sli_query_all(P->F->S);
    status = sli_check_dense(X, ldx, q->nx, B, ldb, q->nb, SLI_COLUMN_MAJOR, nrhs);
    if (status != SL_OK || (nrhs > 0 && P->count > 0 && (G == NULL || ldg < (size_t)P->count))) {
        return SL_ERR_ARGUMENT;
    }
    if (!sli_numbers_are_of(&P->numbers, P->F) || !sli_query_fits(q, P->F)) {
        return SL_ERR_STATE;
    }
    if (q->region != NULL) {
        return SL_ERR_UNSUPPORTED;
    }
    if (nrhs == 0 || q->nx == 0) {
        return SL_OK;
    }
    own = sli_work_own(&P->allocator);
    W = W == NULL ? &own : W;
    sli_pins_layout(&w, &counted, P, q, nrhs);
    status = sli_work_block(W, &counted);
    if (status == SL_OK) {
        sli_pins_layout(&w, &counted, P, q, nrhs);
        for (r = 0; r < nrhs; r += 8) {
            const sl_int block = sli_min(8, nrhs - r);
            sli_pins_block(P, q, &w, X + (size_t)r * ldx, sli_dense_of(SLI_COLUMN_MAJOR, ldx),
                           q->nb == 0 ? B : B + (size_t)r * ldb,
                           sli_dense_of(SLI_COLUMN_MAJOR, ldb),
                           P->count == 0 ? G : G + (size_t)r * ldg, ldg, block);
        }
    }
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
