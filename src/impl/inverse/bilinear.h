/* inverse.h: bilinear forms of A^-1: forward sweeps, then sums over common columns weighted by 1/D */
#ifndef SLI_INVERSE_H
#define SLI_INVERSE_H

#include "../public/inverse.h"
#include "groups.h"
#include "plan.h"

/* z = y / d in every lane, by one division. Where 1/d is out of range or short of digits, each for
 * itself. */
SLI_ALWAYS_INLINE void sli_weigh(double *z, const double *y, double d, sl_int lanes) {
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

/* sums[m] = y_i' D^-1 y_j over one sweep, for the lanes i = first[m], j = second[m]. */
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
            sli_weigh(z, y, d[k], f->lanes);
            for (m = 0; m < count; m++) { /* sum(m) += y(k, i) / d(k) y(k, j) */
                sums[m] += z[first[m]] * y[second[m]];
            }
        }
    }
}

/* Clears what a call says of its sweeps. */
static void sli_inverse_stats(sl_stats *stats) {
    if (stats != NULL) {
        sli_query none;
        memset(&none, 0, sizeof none);
        sli_query_stats(&none, stats);
        stats->bytes_plan = 0;
    }
}

/* Refuses rows out of range. */
static sl_status sli_check_rows(const sl_symbolic *S, const sl_int *rows, sl_int count,
                                int is_column, sl_stats *stats) {
    sl_int k;
    for (k = 0; k < count && rows != NULL; k++) {
        if (rows[k] < 0 || rows[k] >= S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, is_column ? -1 : rows[k],
                               is_column ? rows[k] : -1, 0.0);
        }
    }
    return SL_OK;
}

/* c' A^-1 b: two lanes over the reach of both sets, one where they are the same. */
typedef struct sli_bilinear {
    const sl_factor *F;
    const sl_int *set[2];
    const double *values[2];
    sl_int count[2];
    sl_int vectors;
    uint64_t *seeds, *scratch; /* count[0] + count[1] in all, unless a set is NULL */
    sli_forward forward;
} sli_bilinear;

SLI_INLINE int sli_bilinear_is_whole(const sli_bilinear *q) {
    return q->set[0] == NULL || q->set[1] == NULL;
}

static void sli_bilinear_lay_seeds(void *form, sli_block *b) {
    sli_bilinear *q = (sli_bilinear *)form;
    const uint64_t count =
        sli_bilinear_is_whole(q) ? 0 : (uint64_t)q->count[0] + (uint64_t)q->count[1];
    q->seeds = SLI_TAKE(b, uint64_t, count);
    q->scratch = SLI_TAKE(b, uint64_t, count);
}

/* The columns of both sets ascending, each with its place behind one another, and their reach. */
static void sli_bilinear_measure(void *form) {
    sli_bilinear *q = (sli_bilinear *)form;
    const sl_symbolic *S = q->F->S;
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k;
    if (sli_bilinear_is_whole(q)) {
        q->forward.reach = sli_reach_all(S);
        return;
    }
    for (k = 0; k < total; k++) {
        q->seeds[k] = sli_keyed(S->iperm[k < nc ? q->set[0][k] : q->set[1][k - nc]], k);
    }
    sli_sort(q->seeds, total, q->scratch);
    sli_reach_measure(S, q->seeds, total, &q->forward.reach);
}

static void sli_bilinear_lay_sweep(void *form, sli_block *b) {
    sli_bilinear *q = (sli_bilinear *)form;
    sli_room room = {0, 0, 0, 0};
    sli_room_add(&room, &q->forward.reach, q->vectors);
    if (sli_bilinear_is_whole(q)) { /* the analysis has them */
        room.steps = room.rows = 0;
    }
    sli_forward_layout(&q->forward, b, &room);
    sli_forward_layout_run(&q->forward, b, &room);
}

/* Both vectors into the sweep. */
static void sli_bilinear_pack(sli_bilinear *q) {
    const sl_symbolic *S = q->F->S;
    sli_forward *f = &q->forward;
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k, lane, at = 0;
    if (!sli_bilinear_is_whole(q)) {
        sli_reach_fill(S, q->seeds, total, f->steps, f->rows, &f->reach);
        sli_forward_clear(f, q->vectors);
        for (k = 0; k < total; k++) {
            const sl_int place = sli_reach_place(&f->reach, &at, sli_key(q->seeds[k]));
            const sl_int from = sli_value(q->seeds[k]);
            lane = from >= nc;
            f->y[(ptrdiff_t)place * f->lanes + lane] += q->values[lane][from - lane * nc];
        }
        return;
    }
    f->reach = sli_reach_all(S);
    sli_forward_clear(f, q->vectors);
    for (lane = 0; lane < q->vectors; lane++) {
        for (k = 0; k < q->count[lane]; k++) {
            const sl_int row = q->set[lane] == NULL ? k : q->set[lane][k];
            f->y[(ptrdiff_t)S->iperm[row] * f->lanes + lane] += q->values[lane][k];
        }
    }
}

static const sli_stage sli_bilinear_stages[2] = {{sli_bilinear_lay_seeds, sli_bilinear_measure},
                                                 {sli_bilinear_lay_sweep, NULL}};

static sl_status sli_inverse_form(sli_bilinear *q, double *out, sl_work *W, sl_stats *stats) {
    const sl_int first = 0, second = q->vectors - 1;
    const sl_status status = sli_work_stages(W, sli_bilinear_stages, 2, q);
    if (status == SL_OK) {
        sli_bilinear_pack(q);
        sli_forward_run(&q->forward, q->F, stats);
        sli_pair_sums(q->F, &q->forward, 1, &first, &second, out);
    }
    return status;
}

SL_API sl_status sl_inverse_bilinear(const sl_factor *F, double *out, const sl_int *cset,
                                     const double *c, sl_int nc, const sl_int *bset,
                                     const double *b, sl_int nb, sl_work *W, sl_stats *stats) {
    sl_work own;
    sli_bilinear q;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL || out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    nc = cset == NULL ? F->S->n : nc;
    nb = bset == NULL ? F->S->n : nb;
    if (nc < 0 || nb < 0 || (nc > 0 && c == NULL) || (nb > 0 && b == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    if (cset != NULL && bset != NULL && nc > INT32_MAX - nb) {
        return SL_ERR_TOO_LARGE;
    }
    status = sli_check_rows(F->S, cset, nc, 0, stats);
    status = status == SL_OK ? sli_check_rows(F->S, bset, nb, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_inverse_stats(stats);
    if (nc == 0 || nb == 0) {
        *out = 0.0;
        return SL_OK;
    }
    memset(&q, 0, sizeof q);
    q.F = F;
    q.set[0] = cset;
    q.set[1] = bset;
    q.values[0] = c;
    q.values[1] = b;
    q.count[0] = nc;
    q.count[1] = nb;
    q.vectors = cset == bset && c == b && nc == nb ? 1 : 2;
    own = sli_work_own(&F->allocator);
    status = sli_inverse_form(&q, out, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
