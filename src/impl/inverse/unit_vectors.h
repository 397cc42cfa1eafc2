/* unit_vectors.h: forward sweeps of unit vectors, in blocks of up to 8 of similar reach */
#ifndef SLI_INVERSE_UNIT_VECTORS_H
#define SLI_INVERSE_UNIT_VECTORS_H

#include "../solve/sweep.h"
#include "../factor/costs.h"

#define SLI_LANES_MAX 8
/* per block: 8 columns make 36 pairs; more requests must be repetitions */
#define SLI_BLOCK_REQUESTS_MAX 64

/* A block of right-hand sides: unit vectors that share one forward sweep, one per lane. */
typedef struct sli_rhs_block {
    sl_int count;
    uint64_t seeds[SLI_LANES_MAX]; /* their columns of L, ascending; lane k has the k-th */
    sli_reach size;                /* of the joint reach, as sli_reach_add counts; not compiled */
} sli_rhs_block;

/* The lane of a column, or the lane that it would get. */
SLI_INLINE sl_int sli_rhs_block_lane(const sli_rhs_block *block, sl_int column) {
    sl_int at = 0;
    while (at < block->count && sli_key(block->seeds[at]) < column) {
        at++;
    }
    return at;
}

/* Adds a column; returns 0 if no lane is left. S NULL: the size of the reach is not updated. */
static int sli_rhs_block_add(sli_rhs_block *block, sl_int column, const sl_symbolic *S) {
    const sl_int at = sli_rhs_block_lane(block, column);
    sl_int k;
    if (at < block->count && sli_key(block->seeds[at]) == column) {
        return 1;
    }
    if (block->count == SLI_LANES_MAX) {
        return 0;
    }
    if (S != NULL) {
        sli_reach_add(S, column, at > 0 ? sli_key(block->seeds[at - 1]) : -1,
                      at < block->count ? sli_key(block->seeds[at]) : -1, &block->size);
    }
    for (k = block->count++; k > at; k--) {
        block->seeds[k] = block->seeds[k - 1];
    }
    block->seeds[at] = sli_keyed(column, 0);
    return 1;
}

/* Requested entries of the inverse, and their partition into blocks of nearby ones. */
typedef struct sli_requests {
    const sl_symbolic *S;
    const sli_kernels *kernels;
    /* count each, NULL: 0, 1, 2, ...; one array twice: columns or the diagonal of the inverse */
    const sl_int *rows, *columns;
    sl_int count;
    sl_int n_blocks;
    uint64_t *order; /* count: sort key, and index of the request in the caller's arrays */
    /* count: scratch of the sort, then the number of requests in each block */
    uint64_t *block_size;
} sli_requests;

/* The requests of a call on F; their order and blocks are not there yet. */
static sli_requests sli_requests_of(const sl_factor *F, const sl_int *rows, const sl_int *columns,
                                    sl_int count) {
    sli_requests r;
    SLI_CLEAR(r);
    r.S = F->S;
    r.kernels = F->kernels;
    r.rows = rows;
    r.columns = columns;
    r.count = count;
    return r;
}

/* The row of the k-th request, as a column of L. */
SLI_INLINE sl_int sli_request_row(const sli_requests *r, sl_int k) {
    return r->S->iperm[r->rows[k]];
}

/* The column of the k-th request, as a column of L. */
SLI_INLINE sl_int sli_request_column(const sli_requests *r, sl_int k) {
    return r->S->iperm[r->columns[k]];
}

static void sli_requests_layout(sli_requests *r, sli_block *b) {
    r->order = SLI_TAKE(b, uint64_t, r->count);
    r->block_size = SLI_TAKE(b, uint64_t, r->count);
}

/* Spreads the lower 15 bits: each gets a 0 bit before it. */
SLI_INLINE uint32_t sli_widen_bits(uint32_t a) {
    a = (a | a << 8) & 0x00ff00ffu;
    a = (a | a << 4) & 0x0f0f0f0fu;
    a = (a | a << 2) & 0x33333333u;
    return (a | a << 1) & 0x55555555u;
}

/* Sorts requests so that nearby ones follow each other: single columns by their number, which is a
 * postorder; pairs along a Z-order curve through (larger, smaller), so that neighbors are close in
 * both. */
static void sli_requests_sort(sli_requests *r) {
    sl_int k;
    int shift = 0;
    while ((r->S->n - 1) >> shift >= 1 << 15) {
        shift++;
    }
    for (k = 0; k < r->count; k++) {
        const sl_int i = sli_request_row(r, k), j = sli_request_column(r, k);
        const uint32_t high = (uint32_t)(sli_max(i, j) >> shift);
        const uint32_t low = (uint32_t)(sli_min(i, j) >> shift);
        const sl_int key =
            r->rows == r->columns ? i : (sl_int)(sli_widen_bits(high) << 1 | sli_widen_bits(low));
        r->order[k] = sli_keyed(key, k);
    }
    sli_sort(r->order, r->count, r->block_size);
}

/* Adds both columns of the k-th of the sorted requests to a block; returns 0 if no lane is left. */
SLI_INLINE int sli_rhs_block_add_request(sli_rhs_block *block, const sli_requests *r, sl_int k,
                                         const sl_symbolic *S) {
    const sl_int at = sli_value(r->order[k]);
    return sli_rhs_block_add(block, sli_request_row(r, at), S) &&
           sli_rhs_block_add(block, sli_request_column(r, at), S);
}

/* Forms the block that starts at the k-th of the sorted requests and returns its number of
 * requests: the one that minimizes the time per request. */
static sl_int sli_rhs_block_choose(const sli_requests *r, sl_int k, sli_rhs_block *best) {
    const sl_int from = k;
    double least = 0.0;
    sl_int block_size = 0;
    sli_rhs_block block;
    SLI_CLEAR(block);
    *best = block;
    for (; k < r->count && k - from < SLI_BLOCK_REQUESTS_MAX &&
           sli_rhs_block_add_request(&block, r, k, r->S);
         k++) {
        const double time = sli_cost_lanes(r->kernels, 1 << sli_lanes_kind(block.count)) *
                            (double)block.size.entries / (double)(k - from + 1);
        if (block_size == 0 || time <= least) {
            least = time;
            block_size = k - from + 1;
            *best = block;
        }
    }
    return block_size;
}

/* Forms the block again that starts at the k-th of the sorted requests and has block_size requests.
 */
SLI_NOINLINE static void sli_rhs_block_rebuild(const sli_requests *r, sl_int k, sl_int block_size,
                                               sli_rhs_block *block) {
    memset(block, 0, sizeof *block);
    for (; block_size > 0; block_size--, k++) {
        (void)sli_rhs_block_add_request(block, r, k, NULL);
    }
}

/* Array lengths that suffice for each of several sweeps. */
typedef struct sli_capacity {
    uint64_t steps, rows, values, scratch;
} sli_capacity;

/* Raises the lengths to those of one sweep. */
static void sli_capacity_add(sli_capacity *capacity, const sli_reach *R, sl_int lanes) {
    const uint64_t steps = (uint64_t)R->count, rows = (uint64_t)R->n_rows;
    const uint64_t values = (uint64_t)R->columns * (uint64_t)lanes;
    const uint64_t scratch = sli_sweep_scratch(R->tallest, R->widest, lanes);
    capacity->steps = steps > capacity->steps ? steps : capacity->steps;
    capacity->rows = rows > capacity->rows ? rows : capacity->rows;
    capacity->values = values > capacity->values ? values : capacity->values;
    capacity->scratch = scratch > capacity->scratch ? scratch : capacity->scratch;
}

/* Sorts requests, partitions them into blocks, and finds the capacity that their sweeps need.
 * Returns the time of the sweeps in the unit of costs.h; stops early when it reaches the limit.
 */
static double sli_requests_partition_within(sli_requests *r, sli_capacity *capacity, double limit) {
    double time = 0.0;
    sl_int k = 0;
    sli_requests_sort(r);
    for (r->n_blocks = 0; k < r->count && time < limit; r->n_blocks++) {
        sli_rhs_block block;
        const sl_int block_size = sli_rhs_block_choose(r, k, &block);
        const int kind = sli_lanes_kind(block.count);
        sli_capacity_add(capacity, &block.size, (sl_int)1 << kind);
        time += sli_cost_lanes(r->kernels, 1 << kind) * (double)block.size.entries;
        r->block_size[r->n_blocks] = (uint64_t)block_size;
        k += block_size;
    }
    return time;
}

static void sli_requests_partition(sli_requests *r, sli_capacity *capacity) {
    (void)sli_requests_partition_within(r, capacity, HUGE_VAL);
}

/* A forward sweep. reach, steps and y are its result; rows and scratch are used only while it runs.
 */
typedef struct sli_forward {
    sli_reach reach;
    int kind;
    sl_int lanes;
    sli_step *steps;
    double *y; /* reach.columns x lanes, interleaved */
    sl_int *rows;
    double *scratch;
} sli_forward;

static void sli_forward_layout(sli_forward *f, sli_block *b, const sli_capacity *capacity) {
    f->steps = SLI_TAKE(b, sli_step, capacity->steps);
    f->y = SLI_TAKE(b, double, capacity->values);
}

static void sli_forward_layout_run(sli_forward *f, sli_block *b, const sli_capacity *capacity) {
    f->rows = SLI_TAKE(b, sl_int, capacity->rows);
    f->scratch = SLI_TAKE(b, double, capacity->scratch);
}

/* Room for sweeps by several workers, and that of one of them. */
static void sli_forward_layout_workers(sli_forward *f, sli_block *b, const sli_capacity *capacity,
                                       sl_int workers) {
    const uint64_t count = (uint64_t)workers;
    const sli_capacity all = {capacity->steps * count, capacity->rows * count,
                              capacity->values * count, capacity->scratch * count};
    sli_forward_layout(f, b, &all);
    sli_forward_layout_run(f, b, &all);
}

static sli_forward sli_forward_of_worker(const sli_forward *all, const sli_capacity *capacity,
                                         sl_int worker) {
    sli_forward f = *all;
    f.steps += (ptrdiff_t)capacity->steps * worker;
    f.rows += (ptrdiff_t)capacity->rows * worker;
    f.y += (ptrdiff_t)capacity->values * worker;
    f.scratch += (ptrdiff_t)capacity->scratch * worker;
    return f;
}

/* Sets the number of lanes for some vectors and clears y over a compiled reach. */
SLI_NOINLINE static void sli_forward_clear(sli_forward *f, sl_int vectors) {
    f->kind = sli_lanes_kind(vectors);
    f->lanes = (sl_int)1 << f->kind;
    SLI_ZERO(f->y, (size_t)f->reach.columns * (size_t)f->lanes);
}

/* y := L^-1 y; adds the sweep to stats. */
static void sli_forward_run(sli_forward *f, const sl_factor *F, sl_stats *stats) {
    sli_forward_sweep(F, f->kind, &f->reach, f->y, f->scratch);
    if (stats != NULL) {
        stats->inverse.method = SL_INVERSE_FORWARD;
        stats->inverse.supernodes = sli_max(stats->inverse.supernodes, f->reach.count);
        stats->inverse.columns = sli_max(stats->inverse.columns, f->reach.columns);
        stats->inverse.entries += f->reach.entries;
    }
}

/* y := L^-1 times the unit vectors of a block, or 0 for those of null pivots that were skipped. */
static void sli_forward_unit_vectors(sli_forward *f, const sl_factor *F, const sli_rhs_block *block,
                                     sl_stats *stats) {
    sl_int k, at = 0;
    sli_reach_fill(F->S, block->seeds, block->count, f->steps, f->rows, &f->reach);
    sli_forward_clear(f, block->count);
    for (k = 0; k < block->count; k++) {
        const sl_int row = sli_reach_index(&f->reach, &at, sli_key(block->seeds[k]));
        f->y[(ptrdiff_t)row * f->lanes + k] =
            sli_is_skipped(F, sli_key(block->seeds[k])) ? 0.0 : 1.0;
    }
    sli_forward_run(f, F, stats);
}

#endif
