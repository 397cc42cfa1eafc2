/* groups.h: unit vectors taken up to 8 at a time over one reach, as many as pay, and swept forward together */
#ifndef SLI_GROUPS_H
#define SLI_GROUPS_H

#include "sweep.h"

#define SLI_LANES_MAX 8
#define SLI_REQUESTS_MAX 64 /* of one group: 8 columns make 36 pairs; more are repetitions */

/* Time of a sweep of 1, 2, 4, 8 lanes over so many entries, its reach compiled before it, in that of
 * one lane: measured on grids of 1e4 to 1e6 vertices (Zen 4); NEON, which was not, as AVX2. */
static const double sli_lanes_cost[][SLI_LANES_COUNT] = {{1.0, 1.3, 1.9, 3.3},  /* of any other */
                                                         {1.0, 1.2, 3.8, 8.6},  /* plain C */
                                                         {1.0, 1.3, 1.9, 3.3},  /* AVX2 */
                                                         {1.0, 1.2, 1.9, 2.1}}; /* AVX-512 */

/* The row of an instruction set in tables of costs. */
SLI_INLINE int sli_isa_row(sl_isa isa) {
    return isa == SL_ISA_SCALAR ? 1 : isa == SL_ISA_AVX2 ? 2 : isa == SL_ISA_AVX512 ? 3 : 0;
}

/* Columns of L that share a reach, a lane each. */
typedef struct sli_group {
    sl_int count;
    uint64_t seeds[SLI_LANES_MAX]; /* the columns, ascending: the k-th has lane k */
    sli_reach size;                /* as sli_reach_add counts it; not compiled */
} sli_group;

/* The lane of a column, or the one it would take. */
SLI_INLINE sl_int sli_group_lane(const sli_group *g, sl_int column) {
    sl_int at = 0;
    while (at < g->count && sli_key(g->seeds[at]) < column) {
        at++;
    }
    return at;
}

/* Takes a column in; 0 where no lane is left. S NULL: its path is not counted. */
static int sli_group_add(sli_group *g, sl_int column, const sl_symbolic *S) {
    const sl_int at = sli_group_lane(g, column);
    sl_int k;
    if (at < g->count && sli_key(g->seeds[at]) == column) {
        return 1;
    }
    if (g->count == SLI_LANES_MAX) {
        return 0;
    }
    if (S != NULL) {
        sli_reach_add(S, column, at > 0 ? sli_key(g->seeds[at - 1]) : -1,
                      at < g->count ? sli_key(g->seeds[at]) : -1, &g->size);
    }
    for (k = g->count++; k > at; k--) {
        g->seeds[k] = g->seeds[k - 1];
    }
    g->seeds[at] = sli_keyed(column, 0);
    return 1;
}

/* Entries of the inverse that are asked for, near-by ones side by side. */
typedef struct sli_requests {
    const sl_symbolic *S;
    const double *lanes_cost;
    const sl_int *rows, *columns; /* count each; one array: columns of the inverse, or its diagonal.
                                     NULL: 0, 1, 2, ... */
    sl_int count;
    sl_int n_groups;
    uint64_t *order; /* count: a key, and the request's place in the caller's order */
    uint64_t *taken; /* count: scratch of the sort; then how many requests each group takes */
} sli_requests;

static sli_requests sli_requests_of(const sl_factor *F, const sl_int *rows, const sl_int *columns,
                                    sl_int count) {
    sli_requests r;
    memset(&r, 0, sizeof r);
    r.S = F->S;
    r.lanes_cost = sli_lanes_cost[sli_isa_row(F->kernels->isa)];
    r.rows = rows;
    r.columns = columns;
    r.count = count;
    return r;
}

SLI_INLINE sl_int sli_request_row(const sli_requests *r, sl_int k) {
    return r->S->iperm[r->rows == NULL ? k : r->rows[k]];
}

SLI_INLINE sl_int sli_request_column(const sli_requests *r, sl_int k) {
    return r->S->iperm[r->columns == NULL ? k : r->columns[k]];
}

static void sli_requests_layout(sli_requests *r, sli_block *b) {
    r->order = SLI_TAKE(b, uint64_t, r->count);
    r->taken = SLI_TAKE(b, uint64_t, r->count);
}

/* The lower 15 bits, with room for another bit before each. */
SLI_INLINE uint32_t sli_widen_bits(uint32_t a) {
    a = (a | a << 8) & 0x00ff00ffu;
    a = (a | a << 4) & 0x0f0f0f0fu;
    a = (a | a << 2) & 0x33333333u;
    return (a | a << 1) & 0x55555555u;
}

/* Sorts requests: single columns by themselves, as they are numbered in postorder. Pairs along a
 * Z-curve through (larger, smaller), so that near-by requests are near-by in both. */
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
    sli_sort(r->order, r->count, r->taken);
}

/* Adds both columns of the k-th of the sorted requests to a group; 0 where no lane is left. */
SLI_INLINE int sli_group_request(sli_group *g, const sli_requests *r, sl_int k,
                                 const sl_symbolic *S) {
    const sl_int at = sli_value(r->order[k]);
    return sli_group_add(g, sli_request_row(r, at), S) &&
           sli_group_add(g, sli_request_column(r, at), S);
}

/* The group that starts at the k-th of the sorted requests: as many as make the time of one least. */
static sl_int sli_group_choose(const sli_requests *r, sl_int k, sli_group *best) {
    const sl_int from = k;
    double least = 0.0;
    sl_int taken = 0;
    sli_group g;
    memset(&g, 0, sizeof g);
    *best = g;
    for (; k < r->count && k - from < SLI_REQUESTS_MAX && sli_group_request(&g, r, k, r->S); k++) {
        const double time = r->lanes_cost[sli_lanes_kind(g.count)] * (double)g.size.entries /
                            (double)(k - from + 1);
        if (taken == 0 || time <= least) {
            least = time;
            taken = k - from + 1;
            *best = g;
        }
    }
    return taken;
}

/* The same group again: `taken` requests. */
static void sli_group_again(const sli_requests *r, sl_int k, sl_int taken, sli_group *g) {
    memset(g, 0, sizeof *g);
    for (; taken > 0; taken--, k++) {
        (void)sli_group_request(g, r, k, NULL);
    }
}

/* Room for any of several sweeps. */
typedef struct sli_room {
    uint64_t steps, rows, values, scratch;
} sli_room;

static void sli_room_add(sli_room *room, const sli_reach *R, sl_int lanes) {
    const uint64_t steps = (uint64_t)R->count, rows = (uint64_t)R->n_rows;
    const uint64_t values = (uint64_t)R->columns * (uint64_t)lanes;
    const uint64_t scratch = sli_scratch_size(R->tallest, R->widest, lanes);
    room->steps = steps > room->steps ? steps : room->steps;
    room->rows = rows > room->rows ? rows : room->rows;
    room->values = values > room->values ? values : room->values;
    room->scratch = scratch > room->scratch ? scratch : room->scratch;
}

/* Sorts and groups requests, and finds the room their sweeps need. Returns their time, as the costs of lanes are; ends
 * where it passes a limit. */
static double sli_requests_group_within(sli_requests *r, sli_room *room, double limit) {
    double time = 0.0;
    sl_int k = 0;
    sli_requests_sort(r);
    for (r->n_groups = 0; k < r->count && time < limit; r->n_groups++) {
        sli_group g;
        const sl_int taken = sli_group_choose(r, k, &g);
        const int kind = sli_lanes_kind(g.count);
        sli_room_add(room, &g.size, (sl_int)1 << kind);
        time += r->lanes_cost[kind] * (double)g.size.entries;
        r->taken[r->n_groups] = (uint64_t)taken;
        k += taken;
    }
    return time;
}

static void sli_requests_group(sli_requests *r, sli_room *room) {
    (void)sli_requests_group_within(r, room, HUGE_VAL);
}

/* A forward sweep: its reach and vector stay, the rest serves while it runs. */
typedef struct sli_forward {
    sli_reach reach;
    int kind;
    sl_int lanes;
    sli_step *steps;
    double *y; /* reach.columns x lanes, interleaved */
    sl_int *rows;
    double *scratch;
} sli_forward;

static void sli_forward_layout(sli_forward *f, sli_block *b, const sli_room *room) {
    f->steps = SLI_TAKE(b, sli_step, room->steps);
    f->y = SLI_TAKE(b, double, room->values);
}

static void sli_forward_layout_run(sli_forward *f, sli_block *b, const sli_room *room) {
    f->rows = SLI_TAKE(b, sl_int, room->rows);
    f->scratch = SLI_TAKE(b, double, room->scratch);
}

/* The number of lanes for so many vectors, and those all 0 over a compiled reach. */
static void sli_forward_clear(sli_forward *f, sl_int vectors) {
    f->kind = sli_lanes_kind(vectors);
    f->lanes = (sl_int)1 << f->kind;
    memset(f->y, 0, (size_t)f->reach.columns * (size_t)f->lanes * sizeof(double));
}

/* y := L^-1 y; says in stats what was read. */
static void sli_forward_run(sli_forward *f, const sl_factor *F, sl_stats *stats) {
    F->kernels->forward[f->kind](f->reach.count, f->reach.steps, f->reach.rows, F->L, f->y,
                                 f->scratch);
    if (stats != NULL) {
        stats->b_supernodes = sli_max(stats->b_supernodes, f->reach.count);
        stats->b_columns = sli_max(stats->b_columns, f->reach.columns);
        stats->b_entries += f->reach.entries;
    }
}

/* L^-1 times the unit vectors of a group. */
static void sli_forward_group(sli_forward *f, const sl_factor *F, const sli_group *g,
                              sl_stats *stats) {
    sl_int k, at = 0;
    sli_reach_fill(F->S, g->seeds, g->count, f->steps, f->rows, &f->reach);
    sli_forward_clear(f, g->count);
    for (k = 0; k < g->count; k++) {
        const sl_int place = sli_reach_place(&f->reach, &at, sli_key(g->seeds[k]));
        f->y[(ptrdiff_t)place * f->lanes + k] = 1.0;
    }
    sli_forward_run(f, F, stats);
}

#endif
