/* inverse.h: entries and bilinear forms of A^-1: forward sweeps, then sums over common columns weighted by 1/D */
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

/* A workspace for one call, where the caller has none. */
static sl_work sli_work_own(const sl_factor *F) {
    sl_work own;
    own.allocator = F->allocator;
    own.block = NULL;
    own.size = 0;
    return own;
}

/* The base of W, grown to what a layout has counted, for its second run. */
static sl_status sli_work_lay(sl_work *W, sli_block *b, size_t at_least) {
    const sl_status status =
        b->overflow ? SL_ERR_TOO_LARGE
                    : sli_work_grow(W, b->used > at_least ? b->used : at_least + (at_least == 0));
    b->base = (unsigned char *)W->block;
    b->used = 0;
    return status;
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

/* The sums that the sorted requests k .. k+taken-1, one group, ask for. */
static void sli_pairs_answer(const sl_factor *F, const sli_requests *r, const sli_forward *f,
                             const sli_group *g, sl_int k, sl_int taken, double *out) {
    sl_int first[SLI_REQUESTS_MAX], second[SLI_REQUESTS_MAX], m;
    double sums[SLI_REQUESTS_MAX];
    for (m = 0; m < taken; m++) {
        const sl_int at = sli_value(r->order[k + m]);
        first[m] = sli_group_lane(g, sli_request_row(r, at));
        second[m] = sli_group_lane(g, sli_request_column(r, at));
    }
    sli_pair_sums(F, f, taken, first, second, sums);
    for (m = 0; m < taken; m++) {
        out[sli_value(r->order[k + m])] = sums[m];
    }
}

/* Sorts and groups requests in W and lays out the sweep. The room is known only once they are grouped:
 * where W is too small for it, it grows and they are sorted again. */
static sl_status sli_inverse_prepare(sli_requests *r, sli_forward *f, sl_work *W) {
    size_t bytes = 0;
    for (;;) {
        sli_block b = {NULL, 0, 0};
        sli_room room = {0, 0, 0, 0};
        sl_status status;
        sli_requests_layout(r, &b);
        status = sli_work_lay(W, &b, bytes);
        if (status != SL_OK) {
            return status;
        }
        sli_requests_layout(r, &b);
        sli_requests_group(r, &room);
        sli_forward_layout(f, &b, &room);
        sli_forward_layout_run(f, &b, &room);
        if (b.overflow) {
            return SL_ERR_TOO_LARGE;
        }
        if (b.used <= W->size) {
            return SL_OK;
        }
        bytes = b.used;
    }
}

/* Entries one by one. */
static sl_status sli_inverse_entries(const sl_factor *F, double *out, sli_requests *r, sl_work *W,
                                     sl_stats *stats) {
    sli_forward f;
    sl_int k = 0, m;
    const sl_status status = sli_inverse_prepare(r, &f, W);
    if (status != SL_OK) {
        return status;
    }
    for (m = 0; m < r->n_groups; m++) {
        const sl_int taken = (sl_int)r->taken[m];
        sli_group g;
        sli_group_again(r, k, taken, &g);
        sli_forward_group(&f, F, &g, stats);
        sli_pairs_answer(F, r, &f, &g, k, taken, out);
        k += taken;
    }
    return SL_OK;
}

static sl_status sli_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                                   const sl_int *columns, sl_int count, sl_work *W,
                                   sl_stats *stats) {
    sl_work own;
    sli_requests r;
    sl_status status;
    if (count < 0 || (count > 0 && out == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_check_rows(F->S, rows, count, 0, stats);
    status = status == SL_OK ? sli_check_rows(F->S, columns, count, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_inverse_stats(stats);
    r = sli_requests_of(F, rows, columns, count);
    own = sli_work_own(F);
    status = count == 0 ? SL_OK : sli_inverse_entries(F, out, &r, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

SL_API sl_status sl_inverse_diagonal(const sl_factor *F, double *out, const sl_int *rows,
                                     sl_int count, sl_work *W, sl_stats *stats) {
    sli_stats_clear_error(stats);
    return F == NULL
               ? SL_ERR_ARGUMENT
               : sli_inverse_pairs(F, out, rows, rows, rows == NULL ? F->S->n : count, W, stats);
}

/* Grows W so that sl_inverse_diagonal of these rows allocates nothing. */
static sl_status sli_inverse_reserve(const sl_factor *F, const sl_int *rows, sl_int count,
                                     sl_work *W) {
    sli_requests r = sli_requests_of(F, rows, rows, rows == NULL ? F->S->n : count);
    sli_forward f;
    return sli_inverse_prepare(&r, &f, W);
}

SL_API sl_status sl_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                                  const sl_int *columns, sl_int count, sl_work *W,
                                  sl_stats *stats) {
    sli_stats_clear_error(stats);
    return F == NULL || (count > 0 && (rows == NULL || columns == NULL))
               ? SL_ERR_ARGUMENT
               : sli_inverse_pairs(F, out, rows, columns, count, W, stats);
}

/* c' A^-1 b: two lanes over the reach of both sets, one where they are the same. */
typedef struct sli_bilinear {
    const sl_int *set[2];
    const double *values[2];
    sl_int count[2];
    sl_int vectors;
    uint64_t *seeds, *scratch; /* count[0] + count[1] in all, unless a set is NULL */
} sli_bilinear;

static void sli_bilinear_layout(sli_bilinear *q, sli_block *b) {
    const int is_whole = q->set[0] == NULL || q->set[1] == NULL;
    const uint64_t count = is_whole ? 0 : (uint64_t)q->count[0] + (uint64_t)q->count[1];
    q->seeds = SLI_TAKE(b, uint64_t, count);
    q->scratch = SLI_TAKE(b, uint64_t, count);
}

/* The columns of both sets ascending, each with its place behind one another, and their reach. */
static void sli_bilinear_measure(const sl_symbolic *S, sli_bilinear *q, sli_reach *R) {
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k;
    if (q->set[0] == NULL || q->set[1] == NULL) {
        *R = sli_reach_all(S);
        return;
    }
    for (k = 0; k < total; k++) {
        q->seeds[k] = sli_keyed(S->iperm[k < nc ? q->set[0][k] : q->set[1][k - nc]], k);
    }
    sli_sort(q->seeds, total, q->scratch);
    sli_reach_measure(S, q->seeds, total, R);
}

/* Both vectors into the sweep. */
static void sli_bilinear_pack(const sl_symbolic *S, const sli_bilinear *q, sli_forward *f) {
    const sl_int nc = q->count[0], total = nc + (q->vectors == 2 ? q->count[1] : 0);
    sl_int k, lane, at = 0;
    if (q->set[0] != NULL && q->set[1] != NULL) {
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

static sl_status sli_inverse_form(const sl_factor *F, double *out, sli_bilinear *q, sl_work *W,
                                  sl_stats *stats) {
    const int is_whole = q->set[0] == NULL || q->set[1] == NULL;
    const sl_int first = 0, second = q->vectors - 1;
    size_t bytes = 0;
    sli_forward f;
    for (;;) {
        sli_block b = {NULL, 0, 0};
        sli_room room = {0, 0, 0, 0};
        sl_status status;
        sli_bilinear_layout(q, &b);
        status = sli_work_lay(W, &b, bytes);
        if (status != SL_OK) {
            return status;
        }
        sli_bilinear_layout(q, &b);
        sli_bilinear_measure(F->S, q, &f.reach);
        sli_room_add(&room, &f.reach, q->vectors);
        room.steps = is_whole ? 0 : room.steps; /* the analysis has them */
        room.rows = is_whole ? 0 : room.rows;
        sli_forward_layout(&f, &b, &room);
        sli_forward_layout_run(&f, &b, &room);
        if (b.overflow) {
            return SL_ERR_TOO_LARGE;
        }
        if (b.used <= W->size) {
            break;
        }
        bytes = b.used;
    }
    sli_bilinear_pack(F->S, q, &f);
    sli_forward_run(&f, F, stats);
    sli_pair_sums(F, &f, 1, &first, &second, out);
    return SL_OK;
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
    q.set[0] = cset;
    q.set[1] = bset;
    q.values[0] = c;
    q.values[1] = b;
    q.count[0] = nc;
    q.count[1] = nb;
    q.vectors = cset == bset && c == b && nc == nb ? 1 : 2;
    own = sli_work_own(F);
    status = sli_inverse_form(F, out, &q, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
