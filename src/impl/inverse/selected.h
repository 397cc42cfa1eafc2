/* selected.h: the selected inverse: the panels that a descent of a list of supernodes leaves */
#ifndef SLI_SELECTED_H
#define SLI_SELECTED_H

#include "../public/selected.h"
#include "descent_run.h"
#include "factor.h"
#include "work.h"

struct sl_selected {
    sl_allocator allocator;
    sl_threads threads;
    const sl_factor *F;  /* Z is its inverse, and .. */
    uint64_t generation; /* .. of these numbers of it */
    sli_descent descent; /* its list, its analysis */
    sl_off *begin;       /* count + 1: the panels, in doubles */
    double *Z;
    size_t bytes;
};

static void sli_selected_layout(sl_selected *Z, sli_block *b) {
    (void)sli_take(b, 1, sizeof(sl_selected));
    Z->begin = SLI_TAKE(b, sl_off, (uint64_t)Z->descent.forest.count + 1);
    sli_descent_layout(&Z->descent, b);
    Z->bytes = b->used;
}

/* Rows of A as columns of L, ascending, for a reach. */
static sl_status sli_selected_sort(const sl_symbolic *S, const sl_int *set, sl_int count,
                                   uint64_t *seeds, uint64_t *scratch, sl_stats *stats) {
    sl_int k;
    for (k = 0; k < count; k++) {
        if (set[k] < 0 || set[k] >= S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, set[k], -1, 0.0);
        }
        seeds[k] = sli_keyed(S->iperm[set[k]], 0);
    }
    sli_sort(seeds, count, scratch);
    return SL_OK;
}

/* Arrays of a draft's list, filled for its seeds, NULL for all. */
static sl_status sli_selected_plan(sl_selected **out, sl_selected *draft, const uint64_t *seeds,
                                   sl_int n_seeds) {
    const sl_symbolic *S = draft->descent.S;
    sli_block temporary = {NULL, 0, 0}, kept = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int k;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_selected_layout(draft, &kept);
        status = pass == 0 ? sli_block_alloc(&kept, &draft->allocator) : SL_OK;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_descent_layout_planning(&draft->descent, &temporary);
        status = pass == 0 ? sli_block_alloc(&temporary, &draft->allocator) : SL_OK;
    }
    if (status == SL_OK) {
        sli_descent_plan(&draft->descent, seeds, n_seeds);
        draft->begin[0] = 0;
        for (k = 0; k < draft->descent.forest.count; k++) {
            const sl_int s = draft->descent.supers[k];
            draft->begin[k + 1] = draft->begin[k] + (S->panel_begin[s + 1] - S->panel_begin[s]);
        }
        *out = (sl_selected *)(void *)kept.base;
        **out = *draft;
    } else {
        sli_free(&draft->allocator, kept.base);
    }
    sli_free(&draft->allocator, temporary.base);
    return status;
}

/* The object, all but its numbers. */
static sl_status sli_selected_list(sl_selected **out, const sl_factor *F, const sl_int *set,
                                   sl_int count, const sl_options *opt, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sli_block b = {NULL, 0, 0};
    uint64_t *seeds = NULL, *scratch = NULL;
    sl_selected draft;
    sl_status status = SL_OK;
    sl_int supers = S->n_supers;
    int pass;
    memset(&draft, 0, sizeof draft);
    draft.allocator = sli_allocator(opt);
    draft.threads = opt == NULL || opt->threads.count == 0 ? F->threads : opt->threads;
    for (pass = 0; pass < 2 && status == SL_OK && set != NULL; pass++) {
        seeds = SLI_TAKE(&b, uint64_t, count);
        scratch = SLI_TAKE(&b, uint64_t, count);
        status = pass == 0 ? sli_block_alloc(&b, &draft.allocator) : SL_OK;
    }
    if (status == SL_OK && set != NULL) {
        status = sli_selected_sort(S, set, count, seeds, scratch, stats);
    }
    if (status == SL_OK) {
        if (set != NULL) {
            sli_reach R;
            sli_reach_measure(S, seeds, count, &R);
            supers = R.count;
        }
        draft.descent = sli_descent_of(S, supers, sli_workers(&draft.threads));
        status = sli_selected_plan(out, &draft, seeds, count);
    }
    sli_free(&draft.allocator, b.base);
    return status;
}

/* Row tiles of a front to the panel. */
static void sli_selected_keep(void *to, sl_int k, const sli_dual *f, sl_int t0, sl_int t1) {
    const sl_selected *Z = (const sl_selected *)to;
    const sl_int w = f->width, h = w + f->below;
    double *panel = Z->Z + Z->begin[k];
    sl_int t, j;
    for (t = t0; t < t1; t++) {
        double *tile = panel + sli_tile_offset(w, t);
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1)), rows = h - SLI_TILE * t;
        memcpy(tile, f->front + sli_square_offset(h, t), SLI_TILE * (size_t)columns * sizeof *tile);
        for (j = 0; j < columns && rows < SLI_TILE; j++) { /* padding */
            memset(tile + SLI_TILE * (ptrdiff_t)j + rows, 0,
                   (size_t)(SLI_TILE - rows) * sizeof *tile);
        }
    }
}

static void sli_selected_lay(void *q, sli_block *b) {
    sli_descending *run = (sli_descending *)q;
    sli_descent_layout_run(run, run->d, b);
}

static const sli_stage sli_selected_stage = {sli_selected_lay, NULL};

/* The numbers, in the caller's workspace or in one for this call. F fits. */
static sl_status sli_selected_fill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    sl_work own = sli_work_own(&Z->allocator);
    sli_descending run;
    sl_status status;
    memset(&run, 0, sizeof run);
    run.F = F;
    run.d = &Z->descent;
    run.threads = &Z->threads;
    run.take = sli_selected_keep;
    run.to = Z;
    status = sli_work_stages(W == NULL ? &own : W, &sli_selected_stage, 1, &run);
    if (status == SL_OK) {
        sli_descend(&run);
        Z->F = F;
        Z->generation = F->generation;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* Room for the numbers. */
static sl_status sli_selected_room(sl_selected *Z) {
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    int pass;
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        Z->Z = SLI_TAKE(&b, double, Z->begin[Z->descent.forest.count]);
        Z->bytes += pass == 0 ? b.used : 0;
        status = pass == 0 ? sli_block_alloc(&b, &Z->allocator) : SL_OK;
    }
    return status;
}

static void sli_selected_stats(const sl_selected *Z, double started, sl_stats *stats) {
    if (stats != NULL) {
        sli_descent_stats(&Z->descent, stats);
        stats->z_entries = Z->begin[Z->descent.forest.count];
        stats->seconds_selected = sli_seconds() - started;
        stats->bytes_selected = Z->bytes;
    }
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
    if (F == NULL || (set != NULL && count < 0) || !sli_allocator_is_whole(opt) ||
        (opt != NULL && opt->threads.count < 0)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_good) {
        return SL_ERR_STATE;
    }
    status = sli_selected_list(&Z, F, set, count, opt, stats);
    if (status == SL_OK) {
        status = sli_selected_room(Z);
    }
    if (status == SL_OK) {
        status = sli_selected_fill(Z, F, NULL);
    }
    if (status == SL_OK) {
        sli_selected_stats(Z, started, stats);
        *out = Z;
    } else {
        sl_selected_free(Z);
    }
    return status;
}

SL_API sl_status sl_selected_refill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    if (Z == NULL || F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    return F->is_good && F->S == Z->descent.S ? sli_selected_fill(Z, F, W) : SL_ERR_STATE;
}

SL_API void sl_selected_free(sl_selected *Z) {
    if (Z != NULL) {
        const sl_allocator a = Z->allocator;
        sli_free(&a, Z->Z);
        sli_free(&a, Z);
    }
}

#endif
