/* compile.h: compiles a b-set and an x-set into a query: sorting, reaches, row indices */
#ifndef SLI_SOLVE_COMPILE_H
#define SLI_SOLVE_COMPILE_H

#include "../../public/plan.h"
#include "query.h"

/* A set of rows under compilation. rows NULL: all rows. */
typedef struct sli_set {
    const sl_int *rows;
    sl_int count;
    int repeats; /* some row is given more than once */
    /* seeds inside the subtrees, where the reach starts; the others are boundary rows */
    sl_int inside;
    const sli_region_extent *extent; /* where paths end; NULL: at the roots */
    /* count: the rows' columns of L, ascending, each with its position in the caller's order */
    uint64_t *seeds;
    uint64_t *scratch; /* count */
    sl_int *index;     /* count: where each of the caller's rows is in the vector */
    sli_step *steps;
    sl_int *row_index;    /* the indices of all steps' rows in the vector */
    unsigned char *marks; /* n_marks: of an ending, which parts of it the set uses */
    sl_int n_marks;
} sli_set;

static sli_set sli_set_of(const sl_symbolic *S, const sl_int *rows, sl_int count) {
    sli_set set;
    SLI_CLEAR(set);
    set.rows = rows;
    set.count = rows == NULL ? S->n : count;
    return set;
}

/* Lays out what sorting a set needs. */
static void sli_set_layout_seeds(sli_set *set, sli_block *b) {
    const size_t count = set->rows == NULL ? 0 : (size_t)set->count;
    set->seeds = SLI_TAKE_INLINE(b, uint64_t, count);
    set->scratch = SLI_TAKE_INLINE(b, uint64_t, count);
}

static void sli_set_layout_reach(sli_set *set, sli_block *b, const sli_reach *R) {
    if (set->rows != NULL) {
        set->index = SLI_TAKE_INLINE(b, sl_int, set->count);
        set->steps = SLI_TAKE_INLINE(b, sli_step, R->count);
        set->row_index = SLI_TAKE_INLINE(b, sl_int, R->n_rows);
        set->marks = SLI_TAKE_INLINE(b, unsigned char, set->n_marks);
    }
}

/* Sorts a set by column of L, and records whether a row repeats. Refuses rows out of range. */
static sl_status sli_set_sort(const sl_symbolic *S, sli_set *set, sl_stats *stats) {
    sl_int k;
    set->inside = set->count;
    set->extent = NULL;
    set->repeats = 0;
    if (set->rows == NULL) {
        return SL_OK;
    }
    for (k = 0; k < set->count; k++) {
        const sl_int i = set->rows[k];
        if (i < 0 || i >= S->n) {
            return sli_refuse_row(stats, i);
        }
        set->seeds[k] = sli_keyed(S->iperm[i], k);
    }
    sli_sort(set->seeds, set->count, set->scratch);
    for (k = 1; k < set->count; k++) {
        set->repeats |= sli_key(set->seeds[k - 1]) == sli_key(set->seeds[k]);
    }
    return SL_OK;
}

/* Measures the reach of a sorted set. */
static void sli_set_measure(const sl_symbolic *S, const sli_set *set, sli_reach *R) {
    if (set->rows == NULL) {
        *R = sli_reach_all(S);
    } else {
        sli_reach_measure_within(S, set->extent, set->seeds, set->inside, R);
    }
}

/* Compiles the reach of a set, and the index of each of the caller's rows in its vector. */
static void sli_set_fill(const sl_symbolic *S, sli_set *set, sli_reach *R, const sl_int **index) {
    sli_reach_arrays arrays;
    sl_int k, at = 0;
    if (set->rows == NULL) {
        *index = S->iperm;
        return;
    }
    arrays.steps = set->steps;
    arrays.rows = set->row_index;
    sli_reach_fill_within(S, set->extent, set->seeds, set->inside, &arrays, R);
    for (k = 0; k < set->inside; k++) {
        set->index[sli_value(set->seeds[k])] = sli_reach_index(R, &at, sli_key(set->seeds[k]));
    }
    for (; k < set->count; k++) {
        set->index[sli_value(set->seeds[k])] =
            R->columns - set->extent->n_rows +
            sli_extent_boundary(set->extent, sli_key(set->seeds[k]));
    }
    *index = set->index;
}

/* Do two compiled reaches have the same columns? */
static int sli_reach_equal(const sli_reach *a, const sli_reach *b) {
    sl_int k;
    if (a->count != b->count || a->columns != b->columns) {
        return 0;
    }
    for (k = 0; k < a->count && a->steps != b->steps; k++) {
        if (a->steps[k].column != b->steps[k].column) {
            return 0;
        }
    }
    return 1;
}

/* Compiles both sets, which are laid out and measured. Equal reaches share one vector, which saves
 * the transfer between the sweeps. */
static void sli_query_fill(sli_query *q, const sl_symbolic *S, const sli_ending *ending, sli_set *b,
                           sli_set *x) {
    q->S = S;
    q->ending = ending;
    q->nb = b->count;
    q->nx = x->count;
    q->b_repeats = b->repeats;
    sli_set_fill(S, b, &q->forward, &q->b_index);
    sli_set_fill(S, x, &q->backward, &q->x_index);
    q->is_shared = sli_reach_equal(&q->forward, &q->backward);
    if (ending != NULL) {
        ending->calls->finish(ending, q, b, x);
    }
}

static void sli_query_stats(const sli_query *q, sl_stats *stats) {
    const sl_int boundary = q->ending == NULL ? 0 : q->ending->rows;
    stats->plan.b_supernodes = q->forward.count;
    stats->plan.b_columns = q->forward.columns - boundary;
    stats->plan.b_entries = q->forward.entries;
    stats->plan.x_supernodes = q->backward.count;
    stats->plan.x_columns = q->backward.columns - boundary;
    stats->plan.x_entries = q->backward.entries;
    stats->plan.in_region = q->ending != NULL;
    stats->plan.region_entries = q->used.entries;
}

#endif
