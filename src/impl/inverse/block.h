/* inverse_block.h: dense blocks of A^-1: every row and column swept forward, then all sums between two sweeps */
#ifndef SLI_INVERSE_BLOCK_H
#define SLI_INVERSE_BLOCK_H

#include "inverse.h"

/* Sweeps that are kept while the other side passes by: 128 vectors. One more pass then costs a tenth
 * or so of the sums between them. */
#define SLI_KEPT 16

/* z = D^-1 y over the whole reach of a sweep: once for all that it meets. */
static void sli_forward_weigh(const sl_factor *F, const sli_forward *f, double *z) {
    sl_int s, k;
    for (s = 0; s < f->reach.count; s++) {
        const sli_step *step = &f->reach.steps[s];
        const double *d = F->D + step->column;
        for (k = 0; k < sli_step_columns(step); k++) {
            const ptrdiff_t at = (ptrdiff_t)(step->base + k) * f->lanes;
            sli_weigh(z + at, f->y + at, d[k], f->lanes);
        }
    }
}

/* sums[8 i + j] = y_i' z_j over the columns that two sweeps share, lane i of f, and lane j of g, whose
 * weighed vectors are z. In plain C a block of 128 x 128 near-by vertices took 2.8 times as long. */
static void sli_cross_sums(const sl_factor *F, const sli_forward *f, const sli_forward *g,
                           const double *z, double *sums) {
    sli_meeting m = sli_meeting_of(&f->reach, &g->reach);
    sl_int k, i, j;
    memset(sums, 0, SLI_LANES_MAX * SLI_LANES_MAX * sizeof(double));
    while (sli_meet(&m)) {
        const double *y = f->y + (ptrdiff_t)m.in_a * f->lanes;
        const double *x = z + (ptrdiff_t)m.in_b * g->lanes;
        if (f->lanes == SLI_LANES_MAX && g->lanes == SLI_LANES_MAX) {
            F->kernels->products(m.count, y, x, sums);
            continue;
        }
        for (k = 0; k < m.count; k++, y += f->lanes, x += g->lanes) {
            for (i = 0; i < f->lanes; i++) {
                for (j = 0; j < g->lanes; j++) {
                    sums[SLI_LANES_MAX * i + j] -= y[i] * x[j];
                }
            }
        }
    }
    for (k = 0; k < SLI_LANES_MAX * SLI_LANES_MAX; k++) {
        sums[k] = -sums[k];
    }
}

/* A group with its sweep, and which of the sorted requests it answers. */
typedef struct sli_swept {
    sli_group group;
    sli_forward forward;
    sl_int first, taken;
} sli_swept;

/* One block: `kept` is the side with fewer requests. */
typedef struct sli_inverse_block {
    const sl_factor *F;
    double *Z;
    size_t kept_stride, passing_stride; /* of Z, from one request of a side to the next */
    void (*put)(void *to, sl_int row, sl_int column,
                double z); /* takes entries in place of Z; or NULL */
    void *to;
    int is_symmetric; /* both sides are one: kept serves as passing */
    sli_requests kept, passing;
    sli_swept sweeps[SLI_KEPT], pass;
    double *weighed; /* of the group that passes by */
    sli_room kept_room, passing_room;
} sli_inverse_block;

static void sli_block_lay_requests(void *block, sli_block *b) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    sli_requests_layout(&q->kept, b);
    if (!q->is_symmetric) {
        sli_requests_layout(&q->passing, b);
    }
}

static void sli_block_group(void *block) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    memset(&q->kept_room, 0, sizeof q->kept_room);
    memset(&q->passing_room, 0, sizeof q->passing_room);
    sli_requests_group(&q->kept, &q->kept_room);
    if (!q->is_symmetric) {
        sli_requests_group(&q->passing, &q->passing_room);
    } else if (q->kept.n_groups > SLI_KEPT) {
        q->passing_room = q->kept_room;
    }
}

static void sli_block_lay_sweeps(void *block, sli_block *b) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    const sli_room *kept = &q->kept_room, *passing = &q->passing_room;
    const sl_int count = sli_min(q->kept.n_groups, SLI_KEPT);
    sli_room both = *kept;
    sl_int k;
    both.rows = passing->rows > both.rows ? passing->rows : both.rows;
    both.scratch = passing->scratch > both.scratch ? passing->scratch : both.scratch;
    q->weighed =
        SLI_TAKE(b, double, passing->values > kept->values ? passing->values : kept->values);
    sli_forward_layout(&q->pass.forward, b, passing);
    sli_forward_layout_run(&q->pass.forward, b, &both);
    for (k = 0; k < count; k++) {
        sli_forward_layout(&q->sweeps[k].forward, b, kept);
        q->sweeps[k].forward.rows = q->pass.forward.rows;
        q->sweeps[k].forward.scratch = q->pass.forward.scratch;
    }
}

/* Sweeps the group of `taken` requests that starts at the k-th. */
static void sli_swept_make(sli_swept *s, const sl_factor *F, const sli_requests *r, sl_int k,
                           sl_int taken, sl_stats *stats) {
    s->first = k;
    s->taken = taken;
    sli_group_again(r, k, taken, &s->group);
    sli_forward_group(&s->forward, F, &s->group, stats);
}

/* Every entry between two groups, the second one weighed. */
static void sli_block_write(const sli_inverse_block *q, const sli_swept *a, const sli_swept *b) {
    const sli_requests *passing = q->is_symmetric ? &q->kept : &q->passing;
    SLI_ALIGNED(double sums[SLI_LANES_MAX * SLI_LANES_MAX]);
    sl_int i, j;
    sli_cross_sums(q->F, &a->forward, &b->forward, q->weighed, sums);
    for (i = 0; i < a->taken; i++) {
        const sl_int from = sli_value(q->kept.order[a->first + i]);
        const sl_int lane = sli_group_lane(&a->group, sli_request_row(&q->kept, from));
        for (j = 0; j < b->taken; j++) {
            const sl_int to = sli_value(passing->order[b->first + j]);
            const sl_int other = sli_group_lane(&b->group, sli_request_row(passing, to));
            const sl_int low = a == b ? sli_min(lane, other) : lane;
            const sl_int high = a == b ? sli_max(lane, other) : other;
            const double sum = sums[SLI_LANES_MAX * low + high];
            if (q->put != NULL) {
                q->put(q->to, from, to, sum);
                continue;
            }
            q->Z[(size_t)from * q->kept_stride + (size_t)to * q->passing_stride] = sum;
            if (q->is_symmetric) {
                q->Z[(size_t)to * q->kept_stride + (size_t)from * q->passing_stride] = sum;
            }
        }
    }
}

/* Kept groups in chunks; for each chunk all of the other side passes by. Of a symmetric block, only
 * what comes at or after the chunk. */
static void sli_block_fill(sli_inverse_block *q, sl_stats *stats) {
    const sli_requests *passing = q->is_symmetric ? &q->kept : &q->passing;
    sl_int chunk, first = 0, k, m;
    for (chunk = 0; chunk < q->kept.n_groups; chunk += SLI_KEPT) {
        const sl_int count = sli_min(SLI_KEPT, q->kept.n_groups - chunk);
        sl_int at = 0;
        for (k = 0; k < count; k++) {
            const sl_int taken = (sl_int)q->kept.taken[chunk + k];
            sli_swept_make(&q->sweeps[k], q->F, &q->kept, first, taken, stats);
            first += taken;
        }
        for (k = 0; q->is_symmetric && k < count; k++) {
            sli_forward_weigh(q->F, &q->sweeps[k].forward, q->weighed);
            for (m = 0; m <= k; m++) {
                sli_block_write(q, &q->sweeps[m], &q->sweeps[k]);
            }
        }
        at = q->is_symmetric ? first : 0;
        for (k = q->is_symmetric ? chunk + count : 0; k < passing->n_groups; k++) {
            const sl_int taken = (sl_int)passing->taken[k];
            sli_swept_make(&q->pass, q->F, passing, at, taken, stats);
            sli_forward_weigh(q->F, &q->pass.forward, q->weighed);
            for (m = 0; m < count; m++) {
                sli_block_write(q, &q->sweeps[m], &q->pass);
            }
            at += taken;
        }
    }
}

static const sli_stage sli_block_stages[2] = {{sli_block_lay_requests, sli_block_group},
                                              {sli_block_lay_sweeps, NULL}};

static sl_status sli_block_answer(sli_inverse_block *q, sl_work *W, sl_stats *stats) {
    const sl_status status = sli_work_stages(W, sli_block_stages, 2, q);
    if (status == SL_OK) {
        sli_block_fill(q, stats);
    }
    return status;
}

/* Every entry between some rows, in range, handed over by their numbers; those of two groups once, in either order. */
static sl_status sli_inverse_among(const sl_factor *F, const sl_int *rows, sl_int count,
                                   void (*put)(void *to, sl_int row, sl_int column, double z),
                                   void *to, sl_work *W) {
    sli_inverse_block q;
    memset(&q, 0, sizeof q);
    q.F = F;
    q.put = put;
    q.to = to;
    q.is_symmetric = 1;
    q.kept = q.passing = sli_requests_of(F, rows, rows, count);
    return count == 0 ? SL_OK : sli_block_answer(&q, W, NULL);
}

SL_API sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz, const sl_int *rows,
                                  sl_int n_rows, const sl_int *columns, sl_int n_columns,
                                  sl_work *W, sl_stats *stats) {
    const int rows_pass = n_rows > n_columns, is_empty = n_rows == 0 || n_columns == 0;
    sl_work own;
    sli_inverse_block q;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL || n_rows < 0 || n_columns < 0 || (n_rows > 0 && rows == NULL) ||
        (n_columns > 0 && columns == NULL) || (!is_empty && (Z == NULL || ldz < (size_t)n_rows))) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_check_rows(F->S, rows, n_rows, 0, stats);
    status = status == SL_OK ? sli_check_rows(F->S, columns, n_columns, 1, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_inverse_stats(stats);
    memset(&q, 0, sizeof q);
    q.F = F;
    q.Z = Z;
    q.is_symmetric = rows == columns && n_rows == n_columns;
    q.kept = rows_pass ? sli_requests_of(F, columns, columns, n_columns)
                       : sli_requests_of(F, rows, rows, n_rows);
    q.passing = rows_pass ? sli_requests_of(F, rows, rows, n_rows)
                          : sli_requests_of(F, columns, columns, n_columns);
    q.kept_stride = rows_pass ? ldz : 1;
    q.passing_stride = rows_pass ? 1 : ldz;
    own = sli_work_own(&F->allocator);
    status = is_empty ? SL_OK : sli_block_answer(&q, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return status;
}

#endif
