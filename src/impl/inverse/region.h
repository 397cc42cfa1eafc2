/* region.h: regions: creation, and their part of the inverse by sweeps or a selected inverse */
#ifndef SLI_INVERSE_REGION_H
#define SLI_INVERSE_REGION_H

#include "block.h"
#include "region_choose.h"
#include "region_ending.h"
#include "selected_query.h"

/* Fills what follows from the roots and the rows of the boundary: everything but the numbers. */
static void sli_region_index(sl_region *R) {
    const sl_symbolic *S = R->S;
    const sl_int n = R->extent.n_rows;
    sl_int k;
    sli_region_begin(R);
    R->extent.roots = R->roots;
    R->extent.rows = R->rows;
    R->begin[0] = 0;
    for (k = 0; k < n; k++) {
        R->requested[k] = S->perm[R->rows[k]];
        R->relative[k] = n + k;
    }
    for (k = 0; k < n; k += SLI_REGION_COLUMNS) {
        sl_off *begin = &R->begin[k / SLI_REGION_COLUMNS];
        begin[1] = begin[0] + sli_region_chunk_size(n - k);
    }
}

/* Fills the allocated object from the choice, all but its numbers. */
static void sli_region_from_choice(sl_region *R, const sli_choice *c) {
    const sl_symbolic *S = c->S;
    sl_int k, i, n_roots = 0, n_rows = 0;
    for (k = 0; k < c->reach.count; k++) {
        const sli_step *step = &c->steps[k];
        const sl_int s = S->super_of[step->column];
        if (c->is_inside[k]) {
            if (step->up == -1 || !c->is_inside[step->up]) {
                R->roots[n_roots++] = s;
            }
            continue;
        }
        for (i = 0; i < sli_step_columns(step); i++) {
            if (c->needed[step->base + i] > 0) {
                R->rows[n_rows++] = step->column + i;
            }
        }
    }
    SLI_ASSERT(n_roots == R->extent.n_roots && n_rows == R->extent.n_rows);
    sli_region_index(R);
    SLI_ZERO(R->Z, R->begin[sli_region_chunks(n_rows)]);
}

/* Chooses and makes the object, without its numbers. start: the choice without its arrays. */
SLI_COLD static sl_status sli_region_new(sl_region **out, const sli_choice *start,
                                         const sl_int *set, const sl_allocator *a,
                                         sl_stats *stats) {
    const sl_symbolic *S = start->S;
    sli_block seeds = {NULL, 0}, rest = {NULL, 0}, kept = {NULL, 0};
    sli_choice c = *start;
    sl_region draft;
    sl_status status = SL_OK;
    SLI_CLEAR(draft);
    SLI_LAYOUT(&seeds, a, status) {
        c.seeds = SLI_TAKE(&seeds, uint64_t, c.count);
        c.scratch = SLI_TAKE(&seeds, uint64_t, c.count);
    }
    status = status == SL_OK ? sli_choice_sort(&c, set, stats) : status;
    if (status == SL_OK) {
        sli_reach_measure(S, c.seeds, c.count, &c.reach);
    }
    SLI_LAYOUT(&rest, a, status) {
        sli_choice_layout_reach(&c, &rest);
    }
    if (status == SL_OK) {
        sli_choice_init(&c);
        sli_choice_sweep(&c);
        sli_choice_improve(&c);
        if (c.may_copy && c.boundary > 1) {
            sli_choice_single_subtree(&c);
        }
        draft.allocator = *a;
        draft.S = S;
        draft.extent.n_roots = c.n_roots;
        draft.extent.n_rows = c.boundary;
    }
    SLI_LAYOUT(&kept, a, status) {
        sli_region_layout(&draft, &kept);
    }
    if (status == SL_OK) {
        sli_region_from_choice(&draft, &c);
        *out = (sl_region *)(void *)kept.base;
        **out = draft;
        sli_borrow(&S->borrowers);
    }
    sli_free(a, rest.base);
    sli_free(a, seeds.base);
    return status;
}

/* Stores the entry of two rows of the boundary, given by their indices, in the lower triangle. */
static void sli_region_write(void *context, sl_int row, sl_int column, double z) {
    sl_region *R = (sl_region *)context;
    const sl_int low = sli_min(row, column), high = sli_max(row, column);
    const sl_int first = low - low % SLI_REGION_COLUMNS;
    const sl_int width = sli_min(SLI_REGION_COLUMNS, R->extent.n_rows - first);
    R->Z[R->begin[first / SLI_REGION_COLUMNS] +
         sli_panel_at(width, width + high - first, low - first)] = low == high ? -0.5 * z : -z;
}

/* Copies all entries from a selected inverse; returns 0 and changes nothing if one is missing
 * there. */
static int sli_region_copy(sl_region *R, const sl_selected *Z) {
    const sl_int *rows = R->extent.rows;
    sl_int i, j;
    int pass;
    for (pass = 0; pass < 2; pass++) {
        for (j = 0; j < R->extent.n_rows; j++) {
            for (i = j; i < R->extent.n_rows; i++) {
                const sl_off at = sli_selected_position(Z, rows[i], rows[j]);
                if (at == -1) {
                    return 0;
                }
                if (pass == 1) {
                    sli_region_write(R, i, j, Z->Z[at]);
                }
            }
        }
    }
    return 1;
}

/* The subtree of the k-th root, for the bound on what solves in the region lose. */
static sli_loss sli_region_loss(const sl_region *R, const sl_factor *F, sl_int k) {
    sli_loss q;
    SLI_CLEAR(q);
    q.F = F;
    q.limit = SLI_LOSS_REFUSED;
    q.first = R->S->first_descendant[R->roots[k]];
    q.count = R->roots[k] + 1 - q.first;
    return q;
}

/* Grows W to what the bounds need, before anything is written. */
static sl_status sli_region_reserve_loss(const sl_region *R, const sl_factor *F, sl_work *W) {
    sl_status status = SL_OK;
    sl_int k;
    for (k = 0; k < R->extent.n_roots && sli_has_both_signs(F) && status == SL_OK; k++) {
        sli_loss q = sli_region_loss(R, F, k);
        sli_block b = {NULL, 0};
        sli_loss_layout(&q, &b);
        status = sli_work_grow(W, b.used);
    }
    return status;
}

/* Do solves lose little when they end at the boundary? Its entries are known. */
static int sli_region_loss_is_small(const sl_region *R, const sl_factor *F, sl_work *W) {
    const sl_off entries = R->begin[sli_region_chunks(R->extent.n_rows)];
    double most = 0.0;
    sl_off at;
    sl_int k;
    int is_small = 1;
    for (at = 0; at < entries && sli_has_both_signs(F); at++) { /* of N: of Z, or half of it */
        most = fmax(most, 2.0 * fabs(R->Z[at]));
    }
    for (k = 0; k < R->extent.n_roots && sli_has_both_signs(F) && is_small; k++) {
        sli_loss q = sli_region_loss(R, F, k);
        sli_block b = {(unsigned char *)W->block, 0};
        sli_loss_layout(&q, &b);
        q.outside = R->S->super_parent[R->roots[k]] == -1 ? 0.0 : most;
        is_small = q.outside == 0.0 || sli_loss_is_small(&q);
    }
    return is_small;
}

/* Computes the numbers. F and Z are valid and belong to R. If solves in the region would lose too
 * much, R has no numbers. */
static sl_status sli_region_fill(sl_region *R, const sl_factor *F, const sl_selected *Z,
                                 sl_work *W) {
    const double started = sli_seconds();
    sl_work own = sli_work_own(&R->allocator);
    sl_status status = SL_OK;
    int is_copied;
    W = W == NULL ? &own : W;
    status = sli_region_reserve_loss(R, F, W);
    is_copied = status == SL_OK && Z != NULL && sli_region_copy(R, Z);
    if (status == SL_OK && !is_copied) { /* an error comes before anything is written */
        status = sli_inverse_all_pairs(F, R->requested, R->extent.n_rows, sli_region_write, R, W);
    }
    if (status == SL_OK) {
        R->numbers = sli_numbers_of(F);
        R->is_copied = is_copied;
        if (!sli_region_loss_is_small(R, F, W)) {
            R->numbers.generation = 0;
            status = sli_refuse(SL_ERR_INACCURATE, "pivots of both signs: solves that end at the "
                                                   "boundary would lose too many digits");
        }
        R->seconds = sli_seconds() - started;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* Refuses a failed factor, a Z that is not of its present numbers, and centered solves: what
 * centering adds to b is not 0 outside of the region. */
static sl_status sli_region_check_factor(const sl_factor *F, const sl_selected *Z) {
    const sl_status status = sli_inverse_check(F);
    if (F->is_valid && Z != NULL && !sli_numbers_are_of(&Z->numbers, F)) {
        return sli_refuse(SL_ERR_STALE, "Z is not of the present F: sl_selected_refactor");
    }
    return status == SL_OK && F->null.is_centered
               ? sli_refuse(SL_ERR_UNSUPPORTED, "a region with options.mass")
               : status;
}

SL_API sl_status sl_region_create(sl_region **out, const sl_factor *F, const sl_int *set,
                                  sl_int count, const sl_selected *Z, const sl_options *opt,
                                  sl_stats *stats) {
    const double started = sli_seconds();
    const sl_allocator a = sli_allocator(opt);
    sl_region *R = NULL;
    sli_choice start;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    if (status == SL_OK) {
        status =
            sli_argument(F == NULL ? "F is NULL" : sli_options_wrong(opt, SLI_READS_REGION_BYTES));
    }
    status = status == SL_OK ? sli_list(&set, &count, F->S->n) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(start);
    start.S = F->S;
    start.count = count;
    start.may_copy = Z != NULL;
    start.bytes_max = opt == NULL ? 0 : opt->region_bytes;
    status = sli_region_check_factor(F, Z);
    status = status == SL_OK ? sli_region_new(&R, &start, set, &a, stats) : status;
    if (status == SL_OK) {
        status = sli_region_fill(R, F, Z, NULL);
        R->seconds = sli_seconds() - started;
    }
    if (status == SL_OK) {
        if (stats != NULL) {
            stats->region = sl_region_view(R).info;
        }
        *out = R;
    } else {
        sl_region_free(R);
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_region_refactor(sl_region *R, const sl_factor *F, const sl_selected *Z,
                                    sl_work *W) {
    sl_status status = sli_argument(R == NULL ? "R is NULL" : F == NULL ? "F is NULL" : NULL);
    if (status == SL_OK && F->S != R->S) {
        status = sli_refuse(SL_ERR_MISMATCH, "R and F are of different analyses");
    }
    if (status == SL_OK && R->is_immutable) {
        status = sli_refuse_mapped();
    }
    status = status == SL_OK ? sli_region_check_factor(F, Z) : status;
    if (status == SL_OK) {
        status = sli_region_fill(R, F, Z, W);
    }
    return status;
}

SL_API void sl_region_free(sl_region *R) {
    if (R != NULL && sli_is_last(&R->ending.borrowers)) {
        const sl_allocator a = R->allocator;
        sli_symbolic_return(R->S);
        sli_free(&a, R);
    }
}

SL_API sl_region_arrays sl_region_view(const sl_region *R) {
    sl_region_arrays v;
    sl_int k;
    SLI_CLEAR(v);
    if (R != NULL) {
        v.info.rows = R->extent.n_rows;
        for (k = 0; k < R->extent.n_roots; k++) {
            const sl_int s = R->roots[k], first = R->S->first_descendant[s];
            v.info.rows += R->S->super_first[s + 1] - R->S->super_first[first];
        }
        v.info.boundary = R->extent.n_rows;
        v.info.subtrees = R->extent.n_roots;
        v.info.entries = R->begin[sli_region_chunks(R->extent.n_rows)];
        v.info.is_copied = R->is_copied;
        v.info.seconds = R->seconds;
        v.info.bytes = R->bytes;
        v.symbolic = R->S;
        v.n_roots = R->extent.n_roots;
        v.roots = R->extent.roots;
        v.n_boundary = R->extent.n_rows;
        v.boundary = R->requested;
    }
    return v;
}

#endif
