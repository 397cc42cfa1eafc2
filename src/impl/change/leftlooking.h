/* leftlooking.h: refactors after local changes, left-looking over the supernodes they reach */
#ifndef SLI_CHANGE_LEFTLOOKING_H
#define SLI_CHANGE_LEFTLOOKING_H

#include "../../public/change.h"
#include "../analysis/reach.h"
#include "../factor/factor.h"
#include "gather.h"

/* Are all pivots that were skipped before still null, or judged by the tolerance? New null pivots
 * are in the reach of the changes, unless they are anchors. */
static int sli_nulls_remain(const sl_factor *F) {
    sl_int m, k;
    for (k = 0; F->null.vectors > 1 && k < F->S->n; k++) {
        if (F->rule.kinds[k] == SLI_PIVOT_NULL && !sli_is_skipped(F, k)) {
            return 0;
        }
    }
    for (m = 0; F->null.mode == SL_NULL_PIVOT_SKIP && m < F->null.count; m++) {
        if (F->rule.kinds[F->null.pivots[m]] >= SLI_PIVOT_KEPT) {
            return 0;
        }
    }
    return 1;
}

/* All but p->buffer, which is the buffer of the factor, and the seeds. */
static void sli_left_work_layout(sli_left_work *p, sli_block *b, const sl_symbolic *S) {
    p->local = SLI_TAKE(b, sl_int, S->n);
    p->relative = SLI_TAKE(b, sl_int, S->tallest);
}

/* Recomputes supernode s from A and its descendants. Descendants are visited parents first, and
 * whole subtrees are skipped: where a supernode has no row among the columns of s, none of its
 * descendants has one. */
static sl_status sli_left_factor(sl_factor *F, const sli_left_work *p, const sli_source *from,
                                 sl_int s, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sli_front f = sli_double_front_of(F, s, 0);
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int start = S->super_first[s], end = S->super_first[s + 1];
    sl_int k, d;
    sl_status status;
    for (k = 0; k < f.width; k++) {
        p->local[start + k] = k;
    }
    for (k = 0; k < f.below; k++) {
        p->local[rows[k]] = f.width + k;
    }
    memset(f.panel, 0, (size_t)sli_panel_size(f.width, f.below) * sizeof(double));
    status = sli_double_front_load(F, from, &f, failure);
    if (status != SL_OK) {
        return status;
    }
    for (d = s - 1; d >= S->first_descendant[s];) {
        const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
        const sl_int first = sli_lower_bound(of, below, start);
        sli_descendant by;
        by.super = d;
        by.first = first;
        by.last = first + sli_lower_bound(of + first, below - first, end);
        if (first < by.last) {
            /* the update stack is empty: no other update matrix exists now */
            sli_left_update(F, p, &f, &by, (double *)F->work.stack);
            sli_left_magnitudes(F, p, &f, &by);
            d--;
        } else {
            d = S->first_descendant[d] - 1;
        }
    }
    sli_front_eliminate(&F->kernels->front, &f, F->work.buffer);
    return sli_double_front_check(F, &f, failure);
}

/* Recomputes every supernode on the paths from the seeds to the roots. */
static sl_status sli_left_factor_all(sl_factor *F, const sli_left_work *p, const sli_source *from,
                                     sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sl_int k = 0, s, next;
    while (k < p->n_seeds && status == SL_OK) {
        s = S->super_of[sli_key(p->seeds[k])];
        next = sli_next_seed(S, p->seeds, p->n_seeds, &k);
        for (; s != -1 && s < next && status == SL_OK; s = S->super_parent[s]) {
            status = sli_left_factor(F, p, from, s, failure);
        }
    }
    return status;
}

/* Lists the columns of L that hold the entries of the given columns of A, ascending. Returns how
 * many; one may occur several times. */
static sl_int sli_changed_seeds(const sl_symbolic *S, const sl_csc *A, const sl_int *columns,
                                sl_int count, uint64_t *seeds, uint64_t *scratch) {
    sl_int k, p, total = 0;
    for (k = 0; k < count; k++) {
        const sl_int j = S->iperm[columns[k]];
        sl_int last = INT32_MAX;
        for (p = A->p[columns[k]]; p < A->p[columns[k] + 1]; p++) {
            const sl_int seed = sli_min(j, S->iperm[A->i[p]]);
            if (seed != last) { /* most entries of a column share the seed of the one before */
                seeds[total++] = sli_keyed(seed, 0);
                last = seed;
            }
        }
    }
    sli_sort(seeds, total, scratch);
    return total;
}

/* Refactors F, where the values of `from` differ from those of F in the seeds alone. If the null
 * pivots do not remain, all of L is computed. */
static sl_status sli_left_refactor(sl_factor *F, const sli_left_work *p, const sli_source *from,
                                   double started, sl_stats *stats) {
    sli_failure failure;
    memset(&failure, 0, sizeof failure);
    if (F->null.mode == SL_NULL_PIVOT_SKIP) {
        (void)sli_null_vectors_check(F, from, &failure);
    }
    if (failure.status == SL_OK && !sli_nulls_remain(F)) {
        return sli_factor_numbers(F, from, started, stats);
    }
    if (failure.status == SL_OK) {
        (void)sli_left_factor_all(F, p, from, &failure);
    }
    if (failure.status == SL_OK && sli_null_is_suspected(F)) {
        return sli_factor_numbers(F, from, started, stats);
    }
    return sli_factor_done(F, from, &failure, started, stats);
}

/* What has changed in a matrix: columns, and the columns of L that hold the changed entries,
 * ascending; NULL: all entries of the columns. */
typedef struct sli_changes {
    const sl_int *columns; /* count */
    sl_int count;
    const uint64_t *seeds; /* n_seeds */
    sl_int n_seeds;
} sli_changes;

/* Checks the columns. *entries := how many A has there. */
static sl_status sli_changes_check(const sl_factor *F, const sl_csc *A, const sli_changes *c,
                                   uint64_t *entries, sl_stats *stats) {
    sl_status status;
    sl_int k;
    if (F == NULL || c->count < 0 || (c->count > 0 && c->columns == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    status = F->is_immutable ? SL_ERR_STATE : sli_factor_fits(F, A);
    if (status != SL_OK) {
        return status;
    }
    for (k = 0, *entries = 0; k < c->count; k++) {
        if (c->columns[k] < 0 || c->columns[k] >= F->S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, c->columns[k], -1, 0.0);
        }
        *entries += (uint64_t)(A->p[c->columns[k] + 1] - A->p[c->columns[k]]);
    }
    return SL_OK;
}

/* sl_factor_refactor_changed. */
static sl_status sli_left_refactor_columns(sl_factor *F, const sl_csc *A, const sli_changes *c,
                                           sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source from = sli_source_matrix(A);
    sli_left_work work;
    sli_block b = {NULL, 0, 0};
    uint64_t *seeds = NULL, *scratch = NULL, entries = 0;
    sl_status status;
    sl_int k;
    sli_stats_clear_error(stats);
    status = sli_changes_check(F, A, c, &entries, stats);
    if (status != SL_OK) {
        return status;
    }
    if (F->method != SL_METHOD_SUPERNODAL || F->type->storage != SL_STORAGE_DOUBLE ||
        entries >= (uint64_t)sli_nnz(A)) {
        return sl_factor_refactor(F, A, stats);
    }
    status = sli_factor_prepare(F);
    SLI_LAYOUT(&b, &F->allocator, status) {
        seeds = SLI_TAKE(&b, uint64_t, entries);
        scratch = SLI_TAKE(&b, uint64_t, entries);
        sli_left_work_layout(&work, &b, F->S);
    }
    if (status != SL_OK) {
        return status;
    }
    work.buffer = F->work.buffer;
    sli_factor_begin(F);
    for (k = 0; k < c->count; k++) {
        const sl_int p = A->p[c->columns[k]], q = A->p[c->columns[k] + 1];
        F->identity = sli_hash_ints(F->identity, &c->columns[k], 1);
        F->identity = sli_hash_words(F->identity, A->x + p, q - p);
    }
    work.seeds = c->seeds;
    work.n_seeds = c->n_seeds;
    if (c->seeds == NULL) {
        work.seeds = seeds;
        work.n_seeds = sli_changed_seeds(F->S, A, c->columns, c->count, seeds, scratch);
    }
    status = sli_left_refactor(F, &work, &from, started, stats);
    F->history.scale = F->history.lowest =
        fmin(F->stats.factor.entry_max, F->stats.factor.pivot_max);
    sli_free(&F->allocator, b.base);
    return status;
}

SL_API sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A, const sl_int *columns,
                                            sl_int count, sl_stats *stats) {
    sli_changes c;
    c.columns = columns;
    c.count = count;
    c.seeds = NULL;
    c.n_seeds = 0;
    return sli_left_refactor_columns(F, A, &c, stats);
}

#endif
