/* reached.h: refactors after local changes: keeps the supernodes that they do not reach */
#ifndef SLI_CHANGE_REACHED_H
#define SLI_CHANGE_REACHED_H

#include "../../public/change.h"
#include "../factor/factor.h"
#include "kept.h"

/* Are all pivots that were skipped before still null, or judged by the tolerance? New null pivots
 * are in the reach of the changes, unless they are anchors. */
static int sli_nulls_remain(const sl_factor *F) {
    sl_int m, k;
    for (k = 0; F->null.vectors > 1 && k < F->S->n; k++) {
        if (F->rule.kinds[k] == SLI_PIVOT_NULL && !sli_is_skipped(F, k)) {
            return 0;
        }
    }
    for (m = 0; m < F->null.count; m++) {
        if (F->rule.kinds[F->null.pivots[m]] >= SLI_PIVOT_KEPT) {
            return 0;
        }
    }
    return 1;
}

/* Column k of L is reached, and all columns on its path to the root. */
static void sli_reached_mark(const sl_symbolic *S, sl_int *from, sl_int k) {
    sl_int s;
    for (s = S->super_of[k]; s != -1 && from[s] != -1; s = S->super_parent[s]) {
        from[s] = -1;
    }
}

/* Refactors F, where the values of `from` differ from those of the kept numbers only in what is
 * reached. If the null pivots do not remain, all of L is computed. */
static sl_status sli_reached_numbers(sl_factor *F, const sli_kept *p, const sli_source *from,
                                     double started, sl_stats *stats) {
    sli_failure failure;
    SLI_CLEAR(failure);
    if (sli_skips_nulls(F) && F->null.calls->prepare(F, from, &failure) == SL_OK &&
        !sli_nulls_remain(F)) {
        return sli_factor_numbers(F, from, started, stats);
    }
    if (failure.status == SL_OK) {
        F->work.copied = &p->copied;
        (void)sli_multifrontal(F, from, &failure);
        F->work.copied = NULL;
    }
    if (failure.status == SL_OK && sli_null_is_suspected(F)) {
        return sli_factor_numbers(F, from, started, stats);
    }
    return sli_factor_done(F, from, &failure, started, stats);
}

/* What has changed in a matrix: columns, and the columns of L that hold the changed entries,
 * ascending, or NULL: all entries of the columns. */
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
    status = sli_argument(F == NULL                            ? "F is NULL"
                          : c->count < 0                       ? "count is below 0"
                          : c->count > 0 && c->columns == NULL ? "columns is NULL"
                                                               : NULL);
    status = status == SL_OK ? sli_factor_may_change(F) : status;
    status = status == SL_OK ? sli_factor_fits(F, A) : status;
    if (status != SL_OK) {
        return status;
    }
    for (k = 0, *entries = 0; k < c->count; k++) {
        if (c->columns[k] < 0 || c->columns[k] >= F->S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, c->columns[k], -1, sli_min(c->columns[k], 0),
                               "a column is out of range");
        }
        *entries += (uint64_t)(A->p[c->columns[k] + 1] - A->p[c->columns[k]]);
    }
    return SL_OK;
}

/* from: n_supers; -1 marks what the changes reach, the others keep their numbers. */
static void sli_changes_mark(const sli_changes *c, const sl_symbolic *S, const sl_csc *A,
                             sl_int *from) {
    sl_int k, p;
    for (k = 0; k < S->n_supers; k++) {
        from[k] = k;
    }
    for (k = 0; k < c->n_seeds; k++) {
        sli_reached_mark(S, from, sli_key(c->seeds[k]));
    }
    for (k = 0; k < c->count && c->seeds == NULL; k++) {
        const sl_int j = S->iperm[c->columns[k]];
        for (p = A->p[c->columns[k]]; p < A->p[c->columns[k] + 1]; p++) {
            sli_reached_mark(S, from, sli_min(j, S->iperm[A->i[p]]));
        }
    }
}

/* May columns of F be kept? Else all of it is computed again. */
static int sli_reached_is_suited(const sl_factor *F) {
    return F->method == SL_METHOD_SUPERNODAL && F->type->storage == SL_STORAGE_DOUBLE &&
           F->type->accepts == NULL;
}

/* Computes the columns of L that the changes reach, or all where they are no local ones. */
static sl_status sli_reached_refactor(sl_factor *F, const sl_csc *A, const sli_changes *c,
                                      sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source source = sli_source_matrix(A);
    sli_block b = {NULL, 0}, room = {NULL, 0};
    sli_kept kept;
    uint64_t entries = 0;
    sl_int *from = NULL, k;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_changes_check(F, A, c, &entries, stats);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    if (!sli_reached_is_suited(F) || entries >= (uint64_t)sli_nnz(A)) {
        return sl_factor_refactor(F, A, stats);
    }
    status = sli_factor_prepare(F, 0);
    SLI_LAYOUT(&b, &F->allocator, status) {
        from = SLI_TAKE(&b, sl_int, F->S->n_supers);
    }
    if (status == SL_OK) {
        sli_changes_mark(c, F->S, A, from);
        kept = sli_kept_of(F, from, NULL, 1);
        status = sli_kept_room(&kept, F, &room);
    }
    if (status == SL_OK) {
        sli_factor_begin(F);
        for (k = 0; k < c->count; k++) {
            const sl_int p = A->p[c->columns[k]], q = A->p[c->columns[k] + 1];
            F->identity = sli_hash_ints(F->identity, &c->columns[k], 1);
            F->identity = sli_hash_words(F->identity, A->x + p, q - p);
        }
        for (k = 0; F->history.known != NULL && k < F->S->n_supers; k++) {
            F->history.known[k] &= from[k] != -1; /* it loses what it has lost */
        }
        status = sli_reached_numbers(F, &kept, &source, started, stats);
        F->history.high = F->stats.factor.entry_max;
        F->history.scale = F->history.lowest = F->history.checked =
            fmin(F->history.high, F->stats.factor.pivot_max);
    }
    sli_free(&F->allocator, room.base);
    sli_free(&F->allocator, b.base);
    return sli_report(stats, status);
}

#endif
