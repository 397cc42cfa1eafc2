/* rank_vectors.h: rank-k changes: the state; the vectors, checked, sorted, measured by passes */
#ifndef SLI_CHANGE_RANK_VECTORS_H
#define SLI_CHANGE_RANK_VECTORS_H

#include "../factor/costs.h"
#include "update.h"

/* A rank-k change in progress. */
typedef struct sli_rank {
    sli_update u;                             /* first: its passes */
    const sl_symbolic *S;                     /* of the factor */
    const sl_int *entry_rows, *entry_columns; /* a change given by entries */
    const double *deltas;
    sl_int n_entries;
    int is_balanced; /* the entries are split by the scales of their rows */
    sl_stats *stats;
    sl_status status;
    sl_int count;    /* vectors that change something */
    sl_int updates;  /* those of the sign of the pivots: they come first */
    int has_trial;   /* its only pass may fail: it is tried first */
    int has_log;     /* a later pass may fail, growth may become too large, or numbers overflow */
    sl_int logged;   /* steps in the log */
    double flops;    /* entries of L that the passes change, times their vectors' cost */
    double pivots;   /* pivots that they change, times their vectors */
    sl_off entries;  /* entries of L that the passes change */
    sli_reach whole; /* of all vectors */
    uint64_t *seeds, *scratch, *whole_seeds; /* vectors: first pivot and number */
    sl_int *ends;                            /* for each vector: of the pass that begins with it */
    double *log, *log_D, *log_loss;
    uint64_t *log_marks;
    sli_extent *log_extents;
    sli_step *log_steps;

    /* a change given by entries, as vectors */
    sl_csc V;
    sl_int *p, *i;
    double *x, *sigma, *diagonal;
    uint64_t *order, *order_scratch;
} sli_rank;

/* Up to so many entries of L a copy takes less time than a trial: it stays in the caches. */
#define SLI_RANK_LOGGED (1 << 19)

/* Beyond these sizes of pivots and changes, numbers of a pass may overflow. */
#define SLI_RANK_LARGE 1e100
#define SLI_RANK_SMALL 1e-100

/* Can F have rank-one changes? In float each one would round all of its columns again. */
static int sli_rank_is_suited(const sl_factor *F) {
    return F->E == NULL && F->null.count == 0 && F->type->storage == SL_STORAGE_DOUBLE;
}

/* May F be changed in place? */
static sl_status sli_rank_check(const sl_factor *F) {
    sl_status status = sli_factor_has_numbers(F);
    status = status == SL_OK ? sli_factor_may_change(F) : status;
    if (status != SL_OK || sli_rank_is_suited(F)) {
        return status;
    }
    return sli_refuse(SL_ERR_UNSUPPORTED, F->E != NULL ? "an update with 2x2 pivots"
                                          : F->null.count > 0
                                              ? "an update with null pivots"
                                              : "an update of L in float or complex");
}

/* Checks vector v: its entries are finite, and its rows are below each other in L. */
SLI_COLD static sl_status sli_rank_check_vector(const sli_rank *q, sl_int v, sl_int first) {
    const sl_symbolic *S = q->S;
    const sl_csc *V = q->u.V;
    const double sigma = q->u.sigma == NULL ? 1.0 : q->u.sigma[v];
    sl_int s, p, at;
    if (!sli_is_finite(sigma)) {
        return sli_fail_at(q->stats, SL_ERR_NOT_FINITE, -1, v, sigma, "sigma is not finite");
    }
    s = first < S->n ? S->super_of[first] : -1;
    for (p = V->p[v]; p < V->p[v + 1]; p++) {
        const sl_int k = S->iperm[V->i[p]];
        const sl_int *rows = s == -1 ? NULL : S->rows + S->rows_begin[s];
        if (!sli_is_finite(V->x[p])) {
            return sli_fail_at(q->stats, SL_ERR_NOT_FINITE, V->i[p], v, V->x[p],
                               "an entry of V is not finite");
        }
        if (V->x[p] == 0.0 || sigma == 0.0 || k < S->super_first[s + 1]) {
            continue;
        }
        at = sli_lower_bound(rows, S->steps[s].below, k);
        if (at == S->steps[s].below || rows[at] != k) {
            return sli_fail_at(q->stats, SL_ERR_OTHER_PATTERN, V->i[p], S->perm[first], 0.0,
                               "L has no such entry: the changed matrix has more entries");
        }
    }
    return SL_OK;
}

SLI_COLD static void sli_rank_layout_seeds(void *data, sli_block *b) {
    sli_rank *q = (sli_rank *)data;
    q->seeds = SLI_TAKE(b, uint64_t, q->u.V->n_cols);
    q->scratch = SLI_TAKE(b, uint64_t, q->u.V->n_cols);
    q->whole_seeds = SLI_TAKE(b, uint64_t, q->u.V->n_cols);
    q->ends = SLI_TAKE(b, sl_int, q->u.V->n_cols);
}

/* Is a pass of `count` vectors one path through the tree? */
SLI_INLINE int sli_rank_is_path(const sli_rank *q, sl_int count) {
    return count == 1 && q->u.sign != 0.0;
}

/* May numbers of a pass overflow? size: the largest change of an entry of A by one vector. */
static int sli_rank_may_overflow(const sli_rank *q, double size) {
    const sl_factor_info *info = &q->u.F->stats.factor;
    return !(size <= SLI_RANK_LARGE && info->pivot_max <= SLI_RANK_LARGE &&
             info->pivot_min >= SLI_RANK_SMALL);
}

/* Does a pass that may fail change a factor of which there is a copy, rather than after a trial?
 * Of one or two vectors a trial takes less time, but in plain C of one alone.
 * More than 4 do not fit in the registers unless each has 8 doubles, and a trial of them takes
 * longer. */
static int sli_rank_prefers_log(const sli_rank *q) {
    const sl_int width = q->u.F->kernels->width;
    const sl_off times = q->count > 4 && width < SLI_TILE ? 8 : 1;
    return q->count > (width == 1 ? 1 : 2) && q->whole.entries <= SLI_RANK_LOGGED * times;
}

/* Lists the vectors of a pass, updates first, and its seeds. */
SLI_NOINLINE static void sli_rank_group(const sli_rank *q, sl_int first, sl_int last, sl_int *group,
                                        uint64_t *seeds) {
    uint64_t unused[SLI_TILE];
    sl_int k;
    for (k = first; k < last; k++) {
        group[k - first] = sli_value(q->seeds[k]);
        seeds[k - first] = q->seeds[k];
    }
    sli_sort(seeds, last - first, unused);
}

/* The size of a path, or of several that are joined. */
typedef struct sli_rank_path {
    sl_off entries, columns;
} sli_rank_path;

/* Measures the path of column k up to where it meets that of supernode `other`: *below without the
 * supernode where they meet, *through with it; both are the whole path if they do not meet. */
static void sli_rank_climb(const sl_symbolic *S, sl_int k, sl_int other, sli_rank_path *below,
                           sli_rank_path *through) {
    sl_int s = S->super_of[k], tile = (k - S->super_first[s]) / SLI_TILE;
    int is_met = 0;
    through->entries = through->columns = 0;
    for (; s != -1 && !is_met; s = S->super_parent[s]) {
        const sli_step *step = &S->steps[s];
        *below = *through;
        through->entries += sli_entries_from(step->width, step->below, tile);
        through->columns += step->width;
        is_met = s >= other && S->first_descendant[s] <= other;
        tile = step->below > 0 ? S->relative[S->rows_begin[s]] / SLI_TILE : 0;
    }
    *below = is_met ? *below : *through;
}

/* Measures the path of vector k from that of the next one, *path. *added := what the next one adds
 * to it. */
static void sli_rank_walk(const sli_rank *q, sl_int k, sli_rank_path *path, sli_rank_path *added) {
    const sl_symbolic *S = q->S;
    const sl_int first = sli_key(q->seeds[k]);
    sli_rank_path below, through;
    if (k + 1 == q->count) {
        sli_rank_climb(S, first, S->n_supers, &below, path);
        return;
    }
    sli_rank_climb(S, sli_key(q->seeds[k + 1]), S->super_of[first], added, &through);
    path->entries -= through.entries;
    path->columns -= through.columns;
    sli_rank_climb(S, first, S->super_of[sli_key(q->seeds[k + 1])], &below, &through);
    path->entries += through.entries;
    path->columns += through.columns;
}

/* What begins a pass, in entries of a pass of one vector: on a path, and of several vectors. */
#define SLI_RANK_PATH 800.0
#define SLI_RANK_PASS 3000.0

/* The cost of a pass of `count` vectors over so many entries, in entries of a pass of one: they are
 * read and written once, and each vector adds half of that. */
static double sli_rank_cost(const sli_rank *q, sl_int count, sl_off entries) {
    const int is_path = sli_rank_is_path(q, count);
    const int lanes = is_path ? 1 : 1 << sli_update_kind(count);
    /* pivots of both signs: each entry is read again for its gain */
    const double entry = (is_path ? 1.0 : 1.0 + 0.5 * lanes) + (q->u.sign == 0.0 ? 2.0 : 0.0);
    return entry * (double)entries + (is_path ? SLI_RANK_PATH : SLI_RANK_PASS);
}

/* The passes from one vector on. A pass of k vectors reads and writes its entries once, with 4 k
 * flops each. */
typedef struct sli_rank_rest {
    double cost, flops, pivots;
    sl_off entries;
} sli_rank_rest;

/* *all := a pass of `count` vectors on a path, then *rest. */
static void sli_rank_prepend(const sli_rank *q, sl_int count, const sli_rank_path *path,
                             const sli_rank_rest *rest, sli_rank_rest *all) {
    const double lanes = (double)((sl_int)1 << sli_lanes_kind(count));
    all->cost = rest->cost + sli_rank_cost(q, count, path->entries);
    all->flops = rest->flops + 4.0 * (double)path->entries * lanes;
    all->pivots = rest->pivots + (double)path->columns * (double)count;
    all->entries = rest->entries + path->entries;
}

#define SLI_RANK_RING (2 * SLI_TILE)

/* Splits the vectors into passes, of neighbours in the order of the pivots. A pass computes all of
 * its vectors in all of its columns, and one vector takes a faster kernel: so only vectors that
 * share most of their paths share a pass. *best := a split that costs least. O(reach) */
static void sli_rank_split(const sli_rank *q, sli_rank_rest *best) {
    sli_rank_rest rest[SLI_RANK_RING];
    sli_rank_path added[SLI_RANK_RING], path = {0, 0}, joined, chosen;
    sl_int k, m;
    SLI_CLEAR(rest[q->count % SLI_RANK_RING]);
    for (k = q->count - 1; k >= 0; k--) {
        double least = DBL_MAX;
        sli_rank_walk(q, k, &path, &added[(k + 1) % SLI_RANK_RING]);
        joined = chosen = path;
        for (m = 1; m <= sli_min(SLI_TILE, q->count - k); m++) {
            const sl_int next = (k + m) % SLI_RANK_RING;
            const double cost = sli_rank_cost(q, m, joined.entries) + rest[next].cost;
            if (cost < least) {
                least = cost;
                chosen = joined;
                q->ends[k] = k + m;
            }
            if (k + m < q->count) {
                joined.entries += added[next].entries;
                joined.columns += added[next].columns;
            }
        }
        sli_rank_prepend(q, q->ends[k] - k, &chosen, &rest[q->ends[k] % SLI_RANK_RING],
                         &rest[k % SLI_RANK_RING]);
    }
    *best = rest[0];
}

/* Splits the vectors, measures the passes, and chooses how they are undone. may_fail: their
 * pivots; one pass may be tried first, several need a copy. */
static void sli_rank_plan(sli_rank *q, int may_fail) {
    const int prefers_log = sli_rank_prefers_log(q);
    const double least = (double)q->whole.entries + 2.0 * SLI_RANK_PATH; /* of two passes */
    sli_rank_rest none, best, one;
    sli_rank_path path;
    path.entries = q->whole.entries;
    path.columns = q->whole.columns;
    SLI_CLEAR(none);
    sli_rank_prepend(q, sli_min(q->count, SLI_TILE), &path, &none, &one);
    best = one;
    q->ends[0] = q->count;
    if (q->count > SLI_TILE || one.cost > least + SLI_RANK_PATH * (double)q->count) {
        sli_rank_split(q, &best);
    }
    /* Of both signs they are not in one order: its reach is less. */
    if (q->count <= SLI_TILE && one.cost <= best.cost) {
        best = one;
        q->ends[0] = q->count;
    }
    q->has_log |= may_fail && (q->ends[0] < q->count || prefers_log);
    q->has_trial = may_fail && !q->has_log; /* pivots that grow are not refused */
    q->flops = best.flops;
    q->pivots = best.pivots;
    q->entries = best.entries;
}

/* The largest change of an entry of the diagonal of A by vector v. */
static double sli_rank_size(const sl_csc *V, sl_int v, double sigma) {
    double most = 0.0;
    sl_int p;
    for (p = V->p[v]; p < V->p[v + 1]; p++) {
        most = fmax(most, fabs(V->x[p]));
    }
    return fabs(sigma) * most * most;
}

/* Checks and sorts the vectors, those of the sign of the pivots first, and measures their reach. */
static void sli_rank_sort(void *data) {
    sli_rank *q = (sli_rank *)data;
    const sl_symbolic *S = q->S;
    const sl_csc *V = q->u.V;
    double size = 0.0;
    sl_int v, rest = 0;
    q->count = 0;
    q->flops = q->pivots = 0.0;
    q->entries = 0;
    for (v = 0; v < V->n_cols && q->status == SL_OK; v++) {
        const double sigma = q->u.sigma == NULL ? 1.0 : q->u.sigma[v];
        const sl_int first = sli_update_first(S, V, v);
        q->status = sli_rank_check_vector(q, v, first);
        size = fmax(size, sli_rank_size(V, v, sigma));
        if (first < S->n && sigma != 0.0) {
            if (sigma * (q->u.sign < 0.0 ? -1.0 : 1.0) > 0.0) {
                q->seeds[q->count++] = sli_keyed(first, v);
            } else {
                q->whole_seeds[rest++] = sli_keyed(first, v);
            }
        }
    }
    SLI_CLEAR(q->whole);
    if (q->status != SL_OK) {
        q->count = 0; /* there are no passes */
        return;
    }
    q->updates = q->count;
    sli_sort(q->seeds, q->count, q->scratch);
    sli_sort(q->whole_seeds, rest, q->scratch);
    if (rest > 0) {
        SLI_COPY(q->seeds + q->count, q->whole_seeds, rest);
    }
    q->count += rest;
    if (q->count > 0) {
        SLI_COPY(q->whole_seeds, q->seeds, q->count);
    }
    sli_sort(q->whole_seeds, q->count, q->scratch);
    sli_reach_measure(S, q->whole_seeds, q->count, &q->whole);
    q->has_log = q->u.sign == 0.0 || sli_rank_may_overflow(q, size) ||
                 q->u.F->limits.growth < 2.0; /* else pivots of one sign do not exceed it */
    if (q->count > 0) {
        sli_rank_plan(q, rest > 0 && !q->has_log);
    }
}

#endif
