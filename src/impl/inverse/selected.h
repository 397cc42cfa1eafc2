/* selected.h: the selected inverse: a top-down traversal that keeps every panel */
#ifndef SLI_INVERSE_SELECTED_H
#define SLI_INVERSE_SELECTED_H

#include "../../public/selected.h"
#include "row_sets.h"
#include "traversal_run.h"
#include "../factor/factor.h"
#include "../solve/work.h"

struct sl_selected {
    sl_allocator allocator;
    sl_threads threads;
    sli_hash analysis;       /* the identity of the traversal's analysis */
    sli_numbers numbers;     /* Z is the inverse of these */
    sli_traversal traversal; /* of the supernodes that are kept */
    sl_off *begin;           /* count + 1: offsets of the panels, in doubles */
    double *Z;
    int is_mapped;    /* begin, Z and the list of supernodes are in mapped memory */
    int is_immutable; /* mapped, or of a file that this version reads in part */
    double seconds;   /* of the last computation, and of sl_selected_create its whole */
    size_t bytes;
};

static void sli_selected_layout(sl_selected *Z, sli_block *b) {
    (void)sli_take(b, 1, sizeof(sl_selected));
    Z->begin = SLI_TAKE(b, sl_off, (uint64_t)Z->traversal.forest.count + 1);
    sli_traversal_layout(&Z->traversal, b);
    Z->bytes = b->used;
}

/* Allocates the object with its index arrays and plans the traversal of the reach of seeds; seeds
 * NULL: of all supernodes. */
static sl_status sli_selected_plan(sl_selected **out, sl_selected *draft, const uint64_t *seeds,
                                   sl_int n_seeds) {
    const sl_symbolic *S = draft->traversal.S;
    sli_block work = {NULL, 0, 0}, kept = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int k;
    SLI_LAYOUT(&kept, &draft->allocator, status) {
        sli_selected_layout(draft, &kept);
    }
    SLI_LAYOUT(&work, &draft->allocator, status) {
        sli_traversal_layout_work(&draft->traversal, &work);
    }
    if (status == SL_OK) {
        sli_traversal_plan(&draft->traversal, seeds, n_seeds);
        draft->begin[0] = 0;
        for (k = 0; k < draft->traversal.forest.count; k++) {
            const sl_int s = draft->traversal.supers[k];
            draft->begin[k + 1] = draft->begin[k] + (S->panel_begin[s + 1] - S->panel_begin[s]);
        }
        *out = (sl_selected *)(void *)kept.base;
        **out = *draft;
    } else {
        sli_free(&draft->allocator, kept.base);
    }
    sli_free(&draft->allocator, work.base);
    return status;
}

/* Makes the object for a set of rows, without its numbers. */
static sl_status sli_selected_new(sl_selected **out, const sl_factor *F, const sl_int *set,
                                  sl_int count, const sl_options *opt, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sli_block b = {NULL, 0, 0};
    uint64_t *seeds = NULL, *scratch = NULL;
    sl_selected draft;
    sl_status status = SL_OK;
    sl_int supers = S->n_supers;
    memset(&draft, 0, sizeof draft);
    draft.allocator = sli_allocator(opt);
    draft.analysis = S->identity;
    draft.threads = opt == NULL || opt->threads.count == 0 ? F->threads : opt->threads;
    if (set != NULL) {
        SLI_LAYOUT(&b, &draft.allocator, status) {
            seeds = SLI_TAKE(&b, uint64_t, count);
            scratch = SLI_TAKE(&b, uint64_t, count);
        }
        status = status == SL_OK ? sli_sort_rows(S, set, count, seeds, scratch, stats) : status;
    }
    if (status == SL_OK) {
        if (set != NULL) {
            sli_reach R;
            sli_reach_measure(S, seeds, count, &R);
            supers = R.count;
        }
        draft.traversal = sli_traversal_of(S, supers, sli_traversal_workers(S, &draft.threads));
        status = sli_selected_plan(out, &draft, seeds, count);
    }
    sli_free(&draft.allocator, b.base);
    return status;
}

/* Copies row tiles of a front into the panel. */
static void sli_selected_visit(void *context, sl_int k, const sli_inverse_front *f, sl_int t0,
                               sl_int t1) {
    const sl_selected *Z = (const sl_selected *)context;
    const sl_int w = f->width, h = w + f->below;
    double *panel = Z->Z + Z->begin[k];
    sl_int t, j;
    for (t = t0; t < t1; t++) {
        double *tile = panel + sli_tile_offset(w, t);
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1)), rows = h - SLI_TILE * t;
        memcpy(tile, f->front + sli_square_offset(h, t), SLI_TILE * (size_t)columns * sizeof *tile);
        for (j = 0; j < columns && rows < SLI_TILE; j++) { /* the rows of padding */
            memset(tile + SLI_TILE * (ptrdiff_t)j + rows, 0,
                   (size_t)(SLI_TILE - rows) * sizeof *tile);
        }
    }
}

static void sli_selected_layout_run(void *context, sli_block *b) {
    sli_traversal_run *run = (sli_traversal_run *)context;
    sli_traversal_layout_run(run, run->traversal, run->F->type->storage, b);
}

static const sli_stage sli_selected_stage = {sli_selected_layout_run, NULL};

/* Computes the numbers with the caller's workspace or one for this call. F is valid and of the same
 * analysis. */
static sl_status sli_selected_fill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    const double started = sli_seconds();
    sl_work own = sli_work_own(&Z->allocator);
    sli_traversal_run run;
    sl_status status;
    memset(&run, 0, sizeof run);
    run.F = F;
    run.traversal = &Z->traversal;
    run.threads = &Z->threads;
    run.visit = sli_selected_visit;
    run.context = Z;
    status = sli_work_stages(W == NULL ? &own : W, &sli_selected_stage, 1, &run);
    if (status == SL_OK) {
        sli_traverse(&run);
        Z->numbers = sli_numbers_of(F);
        Z->seconds = sli_seconds() - started;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* Allocates the numbers. */
static sl_status sli_selected_alloc_values(sl_selected *Z) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    SLI_LAYOUT(&b, &Z->allocator, status) {
        Z->Z = SLI_TAKE(&b, double, Z->begin[Z->traversal.forest.count]);
    }
    Z->bytes += b.used;
    return status;
}

SL_API sl_status sl_selected_create(sl_selected **out, const sl_factor *F, const sl_int *set,
                                    sl_int count, const sl_options *opt, sl_stats *stats) {
    const double started = sli_seconds();
    sl_selected *Z = NULL;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (F == NULL || (set != NULL && count < 0) || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_inverse_check(F);
    if (status != SL_OK) {
        return status;
    }
    status = sli_selected_new(&Z, F, set, count, opt, stats);
    if (status == SL_OK) {
        status = sli_selected_alloc_values(Z);
    }
    if (status == SL_OK) {
        status = sli_selected_fill(Z, F, NULL);
    }
    if (status == SL_OK) {
        Z->seconds = sli_seconds() - started;
        sl_selected_stats(Z, stats);
        *out = Z;
    } else {
        sl_selected_free(Z);
    }
    return status;
}

SL_API sl_status sl_selected_refactor(sl_selected *Z, const sl_factor *F, sl_work *W) {
    if (Z == NULL || F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_valid || !sli_factor_is_over(F, Z->traversal.S, Z->analysis) || Z->is_immutable) {
        return SL_ERR_STATE;
    }
    return sli_selected_fill(Z, F, W);
}

SL_API void sl_selected_free(sl_selected *Z) {
    if (Z != NULL) {
        const sl_allocator a = Z->allocator;
        sli_free(&a, Z->is_mapped ? NULL : Z->Z);
        sli_free(&a, Z);
    }
}

#endif
