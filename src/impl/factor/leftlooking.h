/* leftlooking.h: refactors after local changes, left-looking over the supernodes they reach */
#ifndef SLI_FACTOR_LEFTLOOKING_H
#define SLI_FACTOR_LEFTLOOKING_H

#include "../analysis/reach.h"
#include "factor.h"

/* Scratch of a left-looking refactorization. */
typedef struct sli_left_work {
    /* n: the local row of each row of the current supernode; undefined for other rows */
    sl_int *local;
    /* rows of the tallest front: the relative indices of a descendant in the current supernode */
    sl_int *relative;
} sli_left_work;

static void sli_left_work_layout(sli_left_work *p, sli_block *b, const sl_symbolic *S) {
    p->local = SLI_TAKE(b, sl_int, S->n);
    p->relative = SLI_TAKE(b, sl_int, S->tallest);
}

/* Adds the update of descendant d to the front f of a supernode. Rows first, first+1, .. of d are
 * rows of f; the columns of the update are those before `last`. update: room for d's triangle. */
static void sli_left_update(const sl_factor *F, const sli_left_work *p, const sli_front *f,
                            sl_int d, sl_int first, sl_int last, double *update) {
    const sl_symbolic *S = F->S;
    const sl_int *rows = S->rows + S->rows_begin[d];
    sli_front from = sli_front_of(F, d, 0);
    const sl_int w = from.width, tiles = sli_front_tiles(&from);
    const sl_int c0 = (w + first) / SLI_TILE, c1 = sli_tiles(w + last);
    sl_int t, r;
    from.update = update;
    for (t = c0; t < tiles; t++) {
        memset(from.update + sli_triangle_offset(t - c0), 0,
               (size_t)sli_min(t + 1 - c0, c1 - c0) * SLI_TILE * SLI_TILE * sizeof(double));
    }
    F->kernels->fronts[0].update(&from, c0, c1, c0, tiles, F->buffer);
    for (r = first; r < from.below; r++) {
        p->relative[r - first] = p->local[rows[r]];
    }
    F->kernels->fronts[0].assemble(f, from.update, (w + first) % SLI_TILE, p->relative,
                                   last - first, 0, from.below - first);
}

/* Adds |l d l| of rows first .. last-1 of descendant d to the magnitudes of f. The relative indices
 * are those of its update. */
static void sli_left_magnitudes(const sl_factor *F, const sli_left_work *p, const sli_front *f,
                                sl_int d, sl_int first, sl_int last) {
    const sli_front from = sli_front_of(F, d, 0);
    const sl_int w = from.width;
    sl_int r, j;
    for (r = first; r < last; r++) {
        const double *l = from.panel + sli_panel_at(w, w + r, 0);
        double *magnitude = f->magnitude + p->relative[r - first];
        for (j = 0; j < w; j++, l += SLI_TILE) {
            if (from.pairs != NULL && from.pairs[j] == SLI_PAIR_FIRST) {
                const sli_pair size = sli_pair_absolute(from.D[j], from.D[j + 1], from.E[j]);
                *magnitude += sli_pair_gain(&size, l[0], l[SLI_TILE]);
            } else if (from.pairs == NULL || from.pairs[j] == SLI_PAIR_NONE) {
                *magnitude += fabs(*l * *l * from.D[j]);
            }
        }
    }
}

/* Recomputes supernode s from A and its descendants. Descendants are visited parents first, and
 * whole subtrees are skipped: where a supernode has no row among the columns of s, none of its
 * descendants has one. */
static sl_status sli_left_factor(sl_factor *F, const sli_left_work *p, const sli_source *from,
                                 sl_int s, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sli_front f = sli_front_of(F, s, 0);
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
    status = sli_front_load(F, from, &f, s, failure);
    if (status != SL_OK) {
        return status;
    }
    for (d = s - 1; d >= S->first_descendant[s];) {
        const sl_int *of = S->rows + S->rows_begin[d], below = S->steps[d].below;
        const sl_int first = sli_lower_bound(of, below, start);
        const sl_int last = first + sli_lower_bound(of + first, below - first, end);
        if (first < last) {
            /* the update stack is empty: no other update matrix exists now */
            sli_left_update(F, p, &f, d, first, last, F->stack);
            sli_left_magnitudes(F, p, &f, d, first, last);
            d--;
        } else {
            d = S->first_descendant[d] - 1;
        }
    }
    sli_front_eliminate(&F->kernels->fronts[0], &f, F->buffer);
    return sli_front_check(F, &f, s, failure);
}

/* Recomputes every supernode on the paths from the seeds to the roots. Seeds are columns of L in
 * ascending order. */
static sl_status sli_left_factor_all(sl_factor *F, const sli_left_work *p, const sli_source *from,
                                     const uint64_t *seeds, sl_int count, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sl_int k = 0, s, next;
    while (k < count && status == SL_OK) {
        s = S->super_of[sli_key(seeds[k])];
        next = sli_next_seed(S, seeds, count, &k);
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

SL_API sl_status sl_factor_refactor_changed(sl_factor *F, const sl_csc *A, const sl_int *columns,
                                            sl_int count, sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source from = sli_source_matrix(A);
    sli_left_work work;
    sli_block b = {NULL, 0, 0};
    uint64_t *seeds = NULL, *scratch = NULL, entries = 0;
    sli_failure failure;
    sl_status status;
    sl_int k;
    int pass;
    sli_stats_clear_error(stats);
    if (F == NULL || count < 0 || (count > 0 && columns == NULL)) {
        return SL_ERR_ARGUMENT;
    }
    status = F->is_immutable ? SL_ERR_STATE : sli_factor_fits(F, A);
    if (status != SL_OK) {
        return status;
    }
    for (k = 0; k < count; k++) {
        if (columns[k] < 0 || columns[k] >= F->S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, columns[k], -1, 0.0);
        }
        entries += (uint64_t)(A->p[columns[k] + 1] - A->p[columns[k]]);
    }
    if (F->method != SL_METHOD_SUPERNODAL || F->storage != SL_STORAGE_DOUBLE ||
        entries >= (uint64_t)sli_nnz(A)) {
        return sl_factor_refactor(F, A, stats);
    }
    status = sli_factor_prepare(F);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        seeds = SLI_TAKE(&b, uint64_t, entries);
        scratch = SLI_TAKE(&b, uint64_t, entries);
        sli_left_work_layout(&work, &b, F->S);
        status = pass == 0 ? sli_block_alloc(&b, &F->allocator) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    memset(&failure, 0, sizeof failure);
    sli_factor_begin(F);
    for (k = 0; k < count; k++) {
        const sl_int p = A->p[columns[k]], q = A->p[columns[k] + 1];
        F->identity = sli_hash_ints(F->identity, &columns[k], 1);
        F->identity = sli_hash_words(F->identity, A->x + p, q - p);
    }
    count = sli_changed_seeds(F->S, A, columns, count, seeds, scratch);
    if (F->null_pivots == SL_NULL_PIVOT_SKIP) {
        (void)sli_null_vectors_check(F, &from, &failure);
    }
    if (failure.status == SL_OK && !sli_nulls_remain(F)) {
        sli_free(&F->allocator, b.base);
        return sli_factor_numbers(F, &from, started, stats);
    }
    if (failure.status == SL_OK) {
        (void)sli_left_factor_all(F, &work, &from, seeds, count, &failure);
    }
    sli_free(&F->allocator, b.base);
    if (failure.status == SL_OK && sli_null_is_suspected(F)) {
        return sli_factor_numbers(F, &from, started, stats);
    }
    return sli_factor_done(F, &from, &failure, started, stats);
}

#endif
