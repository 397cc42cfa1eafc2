/* bilinear.h: bilinear forms c' A^-1 b: a forward sweep, then a sum over columns weighted by 1/D */
#ifndef SLI_INVERSE_BILINEAR_H
#define SLI_INVERSE_BILINEAR_H

#include "../../public/inverse.h"
#include "row_sets.h"
#include "unit_vectors.h"
#include "../solve/work.h"

/* z = y / d in every lane, by one division and products with the quotient. If 1/d overflows or is
 * denormal, each lane is divided by d. */
SLI_ALWAYS_INLINE void sli_divide_lanes(double *z, const double *y, double d, sl_int lanes) {
    const double inverse = 1.0 / d, size = fabs(inverse);
    sl_int k;
    if (size >= DBL_MIN && size <= DBL_MAX) {
        for (k = 0; k < lanes; k++) {
            z[k] = y[k] * inverse;
        }
    } else {
        for (k = 0; k < lanes; k++) {
            z[k] = y[k] / d;
        }
    }
}

/* sums[m] = y_i' D^-1 y_j over the columns of a sweep, with lanes i = first[m] and j = second[m].
 */
static void sli_pair_sums(const sl_factor *F, const sli_forward *f, sl_int count,
                          const sl_int *first, const sl_int *second, double *sums) {
    sl_int s, k, m;
    for (m = 0; m < count; m++) {
        sums[m] = 0.0;
    }
    for (s = 0; s < f->reach.count; s++) {
        const sli_step *step = &f->reach.steps[s];
        const double *d = F->D + step->column, *y = f->y + (ptrdiff_t)step->base * f->lanes;
        for (k = 0; k < sli_step_columns(step); k++, y += f->lanes) {
            double z[SLI_LANES_MAX];
            sli_divide_lanes(z, y, d[k], f->lanes);
            for (m = 0; m < count; m++) { /* sum(m) += y(k, i) / d(k) y(k, j) */
                sums[m] += z[first[m]] * y[second[m]];
            }
        }
    }
}

/* Clears the inverse group: nothing requested yet. */
static void sli_inverse_clear_stats(sl_stats *stats) {
    if (stats != NULL) {
        SLI_CLEAR(stats->inverse);
    }
}

/* One call: c and b are two lanes of one sweep over the joint reach of both sets, or one lane if
 * they are the same vector. */
typedef struct sli_bilinear {
    const sl_factor *F;
    const sl_int *set[2]; /* of c, of b; NULL: all rows */
    const double *values[2];
    sl_int count[2];
    sl_int vectors;            /* 1 or 2 */
    uint64_t *seeds, *scratch; /* count[0] + count[1] each; 0 if a set is NULL */
    sli_forward forward;
} sli_bilinear;

/* Does the sweep read all of L? */
SLI_INLINE int sli_bilinear_is_dense(const sli_bilinear *q) {
    return q->set[0] == NULL || q->set[1] == NULL;
}

static void sli_bilinear_layout_seeds(void *form, sli_block *b) {
    sli_bilinear *q = (sli_bilinear *)form;
    const uint64_t count =
        sli_bilinear_is_dense(q) ? 0 : (uint64_t)q->count[0] + (uint64_t)q->count[1];
    q->seeds = SLI_TAKE(b, uint64_t, count);
    q->scratch = SLI_TAKE(b, uint64_t, count);
}

/* Sorts the columns of both sets, each with its index in the concatenated sets, and measures their
 * reach. */
static void sli_bilinear_measure(void *form) {
    sli_bilinear *q = (sli_bilinear *)form;
    const sl_symbolic *S = q->F->S;
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k;
    if (sli_bilinear_is_dense(q)) {
        q->forward.reach = sli_reach_all(S);
        return;
    }
    for (k = 0; k < total; k++) {
        q->seeds[k] = sli_keyed(S->iperm[k < nc ? q->set[0][k] : q->set[1][k - nc]], k);
    }
    sli_sort(q->seeds, total, q->scratch);
    sli_reach_measure(S, q->seeds, total, &q->forward.reach);
}

static void sli_bilinear_layout_sweep(void *form, sli_block *b) {
    sli_bilinear *q = (sli_bilinear *)form;
    sli_capacity capacity = {0, 0, 0, 0};
    sli_capacity_add(&capacity, &q->forward.reach, q->vectors);
    if (sli_bilinear_is_dense(q)) { /* those of the analysis are used */
        capacity.steps = capacity.rows = 0;
    }
    sli_forward_layout(&q->forward, b, &capacity);
    sli_forward_layout_run(&q->forward, b, &capacity);
}

/* Adds b to the lane, unless its row has a null pivot. */
SLI_INLINE void sli_bilinear_add(const sli_bilinear *q, sl_int column, sl_int row, sl_int lane,
                                 double b) {
    if (!sli_is_skipped(q->F, column)) {
        q->forward.y[(ptrdiff_t)row * q->forward.lanes + lane] += b;
    }
}

/* Compiles the reach and scatters both vectors into the lanes. */
static void sli_bilinear_pack(sli_bilinear *q) {
    const sl_symbolic *S = q->F->S;
    sli_forward *f = &q->forward;
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k, lane, at = 0;
    if (!sli_bilinear_is_dense(q)) {
        sli_reach_fill(S, q->seeds, total, f->steps, f->rows, &f->reach);
        sli_forward_clear(f, q->vectors);
        for (k = 0; k < total; k++) {
            const sl_int row = sli_reach_index(&f->reach, &at, sli_key(q->seeds[k]));
            const sl_int from = sli_value(q->seeds[k]);
            lane = from >= nc;
            sli_bilinear_add(q, sli_key(q->seeds[k]), row, lane, q->values[lane][from - lane * nc]);
        }
        return;
    }
    f->reach = sli_reach_all(S);
    sli_forward_clear(f, q->vectors);
    for (lane = 0; lane < q->vectors; lane++) {
        for (k = 0; k < q->count[lane]; k++) {
            const sl_int column = S->iperm[q->set[lane] == NULL ? k : q->set[lane][k]];
            sli_bilinear_add(q, column, column, lane, q->values[lane][k]);
        }
    }
}

static const sli_stage sli_bilinear_stages[2] = {{sli_bilinear_layout_seeds, sli_bilinear_measure},
                                                 {sli_bilinear_layout_sweep, NULL}};

static sl_status sli_bilinear_run(sli_bilinear *q, double *out, sl_work *W, sl_stats *stats) {
    const sl_int first = 0, second = q->vectors - 1;
    const sl_status status = sli_work_stages(W, sli_bilinear_stages, 2, q);
    if (status == SL_OK) {
        sli_bilinear_pack(q);
        sli_forward_run(&q->forward, q->F, stats);
        sli_pair_sums(q->F, &q->forward, 1, &first, &second, out);
    }
    return status;
}

SL_API sl_status sl_inverse_bilinear(const sl_factor *F, double *out, const sl_int *bset,
                                     const double *b, sl_int nb, const sl_int *cset,
                                     const double *c, sl_int nc, sl_work *W, sl_stats *stats) {
    sl_work own;
    sli_bilinear q;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(F == NULL ? "F is NULL" : out == NULL ? "out is NULL" : NULL);
    if (status == SL_OK) {
        nc = cset == NULL ? F->S->n : nc;
        nb = bset == NULL ? F->S->n : nb;
        status = sli_argument(nc < 0                ? "nc is below 0"
                              : nb < 0              ? "nb is below 0"
                              : nc > 0 && c == NULL ? "c is NULL"
                              : nb > 0 && b == NULL ? "b is NULL"
                                                    : NULL);
    }
    if (status == SL_OK && cset != NULL && bset != NULL && nc > INT32_MAX - nb) {
        status = sli_refuse(SL_ERR_TOO_LARGE, "nb + nc exceeds 2^31 - 1");
    }
    status = status == SL_OK ? sli_check_entries(F, cset, nc, bset, nb, stats) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    sli_inverse_clear_stats(stats);
    if (nc == 0 || nb == 0) {
        *out = 0.0;
        return SL_OK;
    }
    SLI_CLEAR(q);
    q.F = F;
    q.set[0] = cset;
    q.set[1] = bset;
    q.values[0] = c;
    q.values[1] = b;
    q.count[0] = nc;
    q.count[1] = nb;
    q.vectors = cset == bset && c == b && nc == nb ? 1 : 2;
    own = sli_work_own(&F->allocator);
    status = sli_bilinear_run(&q, out, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return sli_report(stats, status);
}

#endif
