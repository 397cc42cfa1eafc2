/* block.h: dense blocks of A^-1: forward sweeps of all rows and columns, sums between sweeps */
#ifndef SLI_INVERSE_BLOCK_H
#define SLI_INVERSE_BLOCK_H

#include "inverse_kernels.h"
#include "pair_sums.h"
#include "column.h"

/* Sweeps of one side that are kept while those of the other side are computed one by one: 128
 * vectors. Each further pass over the other side costs about a tenth of the sums of a pass. */
#define SLI_BLOCK_KEPT 16

/* z = D^-1 y over the reach of a sweep; used for all sums with this sweep. */
static void sli_forward_divide(const sl_factor *F, const sli_forward *f, double *z) {
    sl_int s, k;
    for (s = 0; s < f->reach.count; s++) {
        const sli_step *step = &f->reach.steps[s];
        const double *d = F->D + step->column;
        for (k = 0; k < sli_step_columns(step); k++) {
            const ptrdiff_t at = (ptrdiff_t)(step->base + k) * f->lanes;
            sli_divide_lanes(z + at, f->y + at, d[k], f->lanes);
        }
    }
}

/* sums[8 i + j] = y_i' z_j over the columns that two sweeps share, for lane i of f and lane j of g;
 * z are the vectors of g divided by D. In plain C a block of 128 x 128 nearby vertices took 2.8
 * times as long as with the kernel. */
static void sli_cross_sums(const sl_factor *F, const sli_forward *f, const sli_forward *g,
                           const double *z, double *sums) {
    sli_intersection m = sli_intersection_of(&f->reach, &g->reach);
    sl_int k, i, j;
    memset(sums, 0, SLI_LANES_MAX * SLI_LANES_MAX * sizeof(double));
    while (sli_intersection_next(&m)) {
        const double *y = f->y + (ptrdiff_t)m.in_a * f->lanes;
        const double *x = z + (ptrdiff_t)m.in_b * g->lanes;
        if (f->lanes == SLI_LANES_MAX && g->lanes == SLI_LANES_MAX) {
            sli_inverse_kernels_of(F->kernels->isa)->products(m.count, y, x, sums);
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

/* A block of right-hand sides with its sweep, and the sorted requests that it answers. */
typedef struct sli_swept_block {
    sli_rhs_block block;
    sli_forward forward;
    sl_int first, block_size;
} sli_swept_block;

/* One call: a dense block of the inverse, or all pairs of a set. `kept` is the side with fewer
 * requests. */
typedef struct sli_inverse_block {
    const sl_factor *F;
    double *Z;
    size_t kept_stride, streamed_stride; /* in Z, from one request of a side to the next */
    /* receives the entries instead of Z; NULL: Z */
    void (*write)(void *context, sl_int row, sl_int column, double z);
    void *context;
    int is_symmetric; /* both sides are the same: kept is used for both */
    sli_requests kept, streamed;
    sli_swept_block sweeps[SLI_BLOCK_KEPT], stream;
    double *divided; /* vectors of the streamed sweep, divided by D */
    sli_capacity kept_capacity, streamed_capacity;
} sli_inverse_block;

static void sli_inverse_block_layout_requests(void *block, sli_block *b) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    sli_requests_layout(&q->kept, b);
    if (!q->is_symmetric) {
        sli_requests_layout(&q->streamed, b);
    }
}

static void sli_inverse_block_partition(void *block) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    SLI_CLEAR(q->kept_capacity);
    SLI_CLEAR(q->streamed_capacity);
    sli_requests_partition(&q->kept, &q->kept_capacity);
    if (!q->is_symmetric) {
        sli_requests_partition(&q->streamed, &q->streamed_capacity);
    } else if (q->kept.n_blocks > SLI_BLOCK_KEPT) {
        q->streamed_capacity = q->kept_capacity;
    }
}

static void sli_inverse_block_layout_sweeps(void *block, sli_block *b) {
    sli_inverse_block *q = (sli_inverse_block *)block;
    const sli_capacity *kept = &q->kept_capacity, *streamed = &q->streamed_capacity;
    const sl_int count = sli_min(q->kept.n_blocks, SLI_BLOCK_KEPT);
    sli_capacity both = *kept;
    sl_int k;
    both.rows = streamed->rows > both.rows ? streamed->rows : both.rows;
    both.scratch = streamed->scratch > both.scratch ? streamed->scratch : both.scratch;
    q->divided =
        SLI_TAKE(b, double, streamed->values > kept->values ? streamed->values : kept->values);
    sli_forward_layout(&q->stream.forward, b, streamed);
    sli_forward_layout_run(&q->stream.forward, b, &both);
    for (k = 0; k < count; k++) {
        sli_forward_layout(&q->sweeps[k].forward, b, kept);
        q->sweeps[k].forward.rows = q->stream.forward.rows;
        q->sweeps[k].forward.scratch = q->stream.forward.scratch;
    }
}

/* Sweeps the block of block_size requests that starts at the k-th. */
SLI_NOINLINE static void sli_swept_block_make(sli_swept_block *s, const sl_factor *F,
                                              const sli_requests *r, sl_int k, sl_int block_size,
                                              sl_stats *stats) {
    s->first = k;
    s->block_size = block_size;
    sli_rhs_block_rebuild(r, k, block_size, &s->block);
    sli_forward_unit_vectors(&s->forward, F, &s->block, stats);
}

/* Writes every entry between two sweeps; the vectors of b are divided by D. */
static void sli_inverse_block_write(const sli_inverse_block *q, const sli_swept_block *a,
                                    const sli_swept_block *b) {
    const sli_requests *streamed = q->is_symmetric ? &q->kept : &q->streamed;
    SLI_ALIGNED(double sums[SLI_LANES_MAX * SLI_LANES_MAX]);
    sl_int i, j;
    sli_cross_sums(q->F, &a->forward, &b->forward, q->divided, sums);
    for (i = 0; i < a->block_size; i++) {
        const sl_int from = sli_value(q->kept.order[a->first + i]);
        const sl_int lane = sli_rhs_block_lane(&a->block, sli_request_row(&q->kept, from));
        for (j = 0; j < b->block_size; j++) {
            const sl_int context = sli_value(streamed->order[b->first + j]);
            const sl_int other = sli_rhs_block_lane(&b->block, sli_request_row(streamed, context));
            const sl_int low = a == b ? sli_min(lane, other) : lane;
            const sl_int high = a == b ? sli_max(lane, other) : other;
            const double sum = sums[SLI_LANES_MAX * low + high];
            if (q->write != NULL) {
                q->write(q->context, from, context, sum);
                continue;
            }
            q->Z[(size_t)from * q->kept_stride + (size_t)context * q->streamed_stride] = sum;
            if (q->is_symmetric) {
                q->Z[(size_t)context * q->kept_stride + (size_t)from * q->streamed_stride] = sum;
            }
        }
    }
}

/* Keeps the sweeps of one side in chunks, and streams the other side past each chunk. Of a
 * symmetric block only the sweeps at or after the chunk are streamed. */
static void sli_inverse_block_fill(sli_inverse_block *q, sl_stats *stats) {
    const sli_requests *streamed = q->is_symmetric ? &q->kept : &q->streamed;
    sl_int chunk, first = 0, k, m;
    for (chunk = 0; chunk < q->kept.n_blocks; chunk += SLI_BLOCK_KEPT) {
        const sl_int count = sli_min(SLI_BLOCK_KEPT, q->kept.n_blocks - chunk);
        sl_int at = 0;
        for (k = 0; k < count; k++) {
            const sl_int block_size = (sl_int)q->kept.block_size[chunk + k];
            sli_swept_block_make(&q->sweeps[k], q->F, &q->kept, first, block_size, stats);
            first += block_size;
        }
        for (k = 0; q->is_symmetric && k < count; k++) {
            sli_forward_divide(q->F, &q->sweeps[k].forward, q->divided);
            for (m = 0; m <= k; m++) {
                sli_inverse_block_write(q, &q->sweeps[m], &q->sweeps[k]);
            }
        }
        at = q->is_symmetric ? first : 0;
        for (k = q->is_symmetric ? chunk + count : 0; k < streamed->n_blocks; k++) {
            const sl_int block_size = (sl_int)streamed->block_size[k];
            sli_swept_block_make(&q->stream, q->F, streamed, at, block_size, stats);
            sli_forward_divide(q->F, &q->stream.forward, q->divided);
            for (m = 0; m < count; m++) {
                sli_inverse_block_write(q, &q->sweeps[m], &q->stream);
            }
            at += block_size;
        }
    }
}

static const sli_stage sli_inverse_block_stages[2] = {
    {sli_inverse_block_layout_requests, sli_inverse_block_partition},
    {sli_inverse_block_layout_sweeps, NULL}};

static sl_status sli_inverse_block_run(sli_inverse_block *q, sl_work *W, sl_stats *stats) {
    const sl_status status = sli_work_stages(W, sli_inverse_block_stages, 2, q);
    if (status == SL_OK) {
        sli_inverse_block_fill(q, stats);
    }
    return status;
}

/* A call for every entry between some rows in range. */
static sli_inverse_block sli_inverse_all_pairs_of(const sl_factor *F, const sl_int *rows,
                                                  sl_int count) {
    sli_inverse_block q;
    SLI_CLEAR(q);
    q.F = F;
    q.is_symmetric = 1;
    q.kept = q.streamed = sli_requests_of(F, rows, rows, count);
    return q;
}

/* Passes every entry between some rows, in range, to `write` with the indices of the two rows in
 * the set. An entry between two different sweeps is passed once, in either order. */
static sl_status sli_inverse_all_pairs(const sl_factor *F, const sl_int *rows, sl_int count,
                                       void (*write)(void *context, sl_int row, sl_int column,
                                                     double z),
                                       void *context, sl_work *W) {
    sli_inverse_block q = sli_inverse_all_pairs_of(F, rows, count);
    q.write = write;
    q.context = context;
    return count == 0 ? SL_OK : sli_inverse_block_run(&q, W, NULL);
}

SL_API sl_status sl_inverse_block(const sl_factor *F, double *Z, size_t ldz, const sl_int *rows,
                                  sl_int n_rows, const sl_int *columns, sl_int n_columns,
                                  sl_work *W, sl_stats *stats) {
    const int rows_are_streamed = n_rows > n_columns, is_empty = n_rows == 0 || n_columns == 0;
    sl_work own;
    sli_inverse_block q;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(F == NULL                                ? "F is NULL"
                          : n_rows < 0                             ? "n_rows is below 0"
                          : n_columns < 0                          ? "n_columns is below 0"
                          : n_rows > 0 && rows == NULL             ? "rows is NULL"
                          : n_columns > 0 && columns == NULL       ? "columns is NULL"
                          : !is_empty && Z == NULL                 ? "Z is NULL"
                          : !is_empty && (ldz & SL_ROW_MAJOR) != 0 ? "ldz is one of SL_ROWS"
                                                                   : NULL);
    if (status == SL_OK && !is_empty) {
        status = sli_dense_check("ldz is below n_rows", ldz, n_rows, n_columns);
    }
    status =
        status == SL_OK ? sli_check_entries(F, rows, n_rows, columns, n_columns, stats) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    sli_inverse_clear_stats(stats);
    if (F->null.count == 0 && !is_empty && (n_rows == 1) != (n_columns == 1)) {
        status = n_rows == 1 ? sli_entries_of_column(F, Z, SL_ROWS(ldz), columns, n_columns,
                                                     rows[0], W, stats)
                             : sli_entries_of_column(F, Z, ldz, rows, n_rows, columns[0], W, stats);
        return sli_report(stats, status);
    }
    SLI_CLEAR(q);
    q.F = F;
    q.Z = Z;
    q.is_symmetric = rows == columns && n_rows == n_columns;
    q.kept = rows_are_streamed ? sli_requests_of(F, columns, columns, n_columns)
                               : sli_requests_of(F, rows, rows, n_rows);
    q.streamed = rows_are_streamed ? sli_requests_of(F, rows, rows, n_rows)
                                   : sli_requests_of(F, columns, columns, n_columns);
    q.kept_stride = rows_are_streamed ? ldz : 1;
    q.streamed_stride = rows_are_streamed ? 1 : ldz;
    own = sli_work_own(&F->allocator);
    status = is_empty ? SL_OK : sli_inverse_block_run(&q, W == NULL ? &own : W, stats);
    sli_free(&own.allocator, own.block);
    return sli_report(stats, status);
}

#endif
