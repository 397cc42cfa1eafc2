/* selected.h: the selected inverse: a top-down traversal that keeps every panel */
#ifndef SLI_INVERSE_SELECTED_H
#define SLI_INVERSE_SELECTED_H

#include "../../public/selected.h"
#include "loss.h"
#include "row_sets.h"
#include "traversal_run.h"
#include "unit_vectors.h"
#include "../factor/factor.h"
#include "../solve/work.h"

struct sl_selected {
    sl_allocator allocator;
    sl_threads threads;
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
    sli_block work = {NULL, 0}, kept = {NULL, 0};
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
        sli_borrow(&S->borrowers);
    } else {
        sli_free(&draft->allocator, kept.base);
    }
    sli_free(&draft->allocator, work.base);
    return status;
}

/* Makes the object for a set of rows, without its numbers. */
SLI_COLD static sl_status sli_selected_new(sl_selected **out, const sl_factor *F, const sl_int *set,
                                           sl_int count, const sl_options *opt, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sli_block b = {NULL, 0};
    uint64_t *seeds = NULL, *scratch = NULL;
    sl_selected draft;
    sl_status status = SL_OK;
    sl_int supers = S->n_supers;
    SLI_CLEAR(draft);
    draft.allocator = sli_allocator(opt);
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
        const double *from = f->front + sli_square_offset(h, t);
        const sl_int columns = sli_min(w, SLI_TILE * (t + 1)), rows = h - SLI_TILE * t;
        if (w == 1) { /* no padding, but zeros up to the next panel */
            const sl_off left = Z->begin[k + 1] - Z->begin[k] - SLI_TILE * (sl_off)t;
            memcpy(tile, from, (size_t)sli_min(rows, SLI_TILE) * sizeof *tile);
            if (rows <= SLI_TILE) {
                SLI_ZERO(tile + rows, left - rows);
            }
            continue;
        }
        memcpy(tile, from, SLI_TILE * (size_t)columns * sizeof *tile);
        for (j = 0; j < columns && rows < SLI_TILE; j++) { /* the rows of padding */
            memset(tile + SLI_TILE * (ptrdiff_t)j + rows, 0,
                   (size_t)(SLI_TILE - rows) * sizeof *tile);
        }
    }
}

/* A computation of the numbers. */
typedef struct sli_selected_run {
    sl_selected *Z;
    const sl_factor *F;
    sli_loss loss; /* with pivots of both signs */
    int is_lossy;  /* 1: a traversal would lose too much; columns are solved for instead */
    sli_traversal_run run;
    sli_capacity capacity; /* of the sweeps of columns */
    sli_forward forward;   /* of all workers */
} sli_selected_run;

static void sli_selected_layout_loss(void *context, sli_block *b) {
    sli_selected_run *q = (sli_selected_run *)context;
    q->is_lossy = 0;
    if (sli_has_both_signs(q->F)) {
        sli_loss_layout_traversal(&q->loss, b, q->F, &q->Z->traversal);
    }
}

/* Judges the loss, and measures the sweeps that take the place of a lossy traversal. */
static void sli_selected_judge(void *context) {
    sli_selected_run *q = (sli_selected_run *)context;
    const sl_symbolic *S = q->F->S;
    sl_int k;
    q->is_lossy = sli_has_both_signs(q->F) && !sli_loss_is_small(&q->loss);
    SLI_CLEAR(q->capacity);
    for (k = 0; k < q->loss.count && q->is_lossy; k++) {
        const sl_int first = S->super_first[q->loss.supers[k]];
        const uint64_t seed = sli_keyed(first, 0);
        sli_reach R;
        sli_reach_measure(S, &seed, 1, &R);
        sli_capacity_add(&q->capacity, &R, SLI_LANES_MAX);
        sli_capacity_add(&q->capacity, &R, 2); /* narrow sweeps need other scratch */
    }
}

static void sli_selected_layout_run(void *context, sli_block *b) {
    sli_selected_run *q = (sli_selected_run *)context;
    if (q->is_lossy) {
        sli_forward_layout_workers(&q->forward, b, &q->capacity, q->Z->traversal.schedule.workers);
    } else {
        sli_traversal_layout_run(&q->run, &q->Z->traversal, q->F->type->storage, b);
    }
}

static const sli_stage sli_selected_stages[2] = {{sli_selected_layout_loss, sli_selected_judge},
                                                 {sli_selected_layout_run, NULL}};

/* Solves for up to 8 columns of the inverse, from column j0 of the k-th supernode on, on their path
 * to the root, and copies what its panel holds. */
static void sli_selected_solve(const sli_selected_run *q, sl_int worker, sl_int k, sl_int j0) {
    const sl_symbolic *S = q->F->S;
    const sl_int s = q->loss.supers[k], w = S->steps[s].width, h = w + S->steps[s].below;
    double *panel = q->Z->Z + q->Z->begin[k];
    sli_forward f = sli_forward_of_worker(&q->forward, &q->capacity, worker);
    sli_rhs_block block;
    sl_int j, r;
    block.count = sli_min(w - j0, SLI_LANES_MAX);
    for (j = 0; j < block.count; j++) {
        block.seeds[j] = sli_keyed(S->super_first[s] + j0 + j, 0);
    }
    sli_forward_unit_vectors(&f, q->F, &block, NULL);
    sli_backward_sweep(q->F, f.kind, &f.reach, q->F->D, f.y, f.scratch);
    for (r = j0; r < h; r++) {
        const sl_int row = r < w ? r - SLI_TILE * f.steps->first_tile : f.rows[r - w];
        for (j = 0; j < sli_min(block.count, r - j0 + 1); j++) {
            panel[sli_panel_at(w, r, j0 + j)] = f.y[(ptrdiff_t)row * f.lanes + j];
        }
    }
}

/* A worker takes every workers-th supernode. */
static void sli_selected_solve_worker(void *data, sl_int worker) {
    const sli_selected_run *q = (const sli_selected_run *)data;
    sl_int k, j;
    for (k = worker; k < q->loss.count; k += q->Z->traversal.schedule.workers) {
        for (j = 0; j < q->F->S->steps[q->loss.supers[k]].width; j += SLI_LANES_MAX) {
            sli_selected_solve(q, worker, k, j);
        }
    }
}

/* Entries in rows or columns of null pivots are 0; sweeps have divided by SLI_NULL_PIVOT. */
static void sli_selected_clear_nulls(const sl_selected *Z, const sl_factor *F) {
    const sl_symbolic *S = F->S;
    sl_int k, r, j;
    for (k = 0; k < Z->traversal.forest.count && F->null.count > 0; k++) {
        const sl_int s = Z->traversal.supers[k], w = S->steps[s].width;
        for (r = 0; r < w + S->steps[s].below; r++) {
            const sl_int row = r < w ? S->super_first[s] + r : S->rows[S->rows_begin[s] + r - w];
            const int is_null = sli_is_skipped(F, row);
            for (j = 0; j < sli_min(w, r + 1); j++) {
                if (is_null || sli_is_skipped(F, S->super_first[s] + j)) {
                    Z->Z[Z->begin[k] + sli_panel_at(w, r, j)] = 0.0;
                }
            }
        }
    }
}

/* Computes the numbers with the caller's workspace or one for this call. F is valid and of the same
 * analysis. */
static sl_status sli_selected_fill(sl_selected *Z, const sl_factor *F, sl_work *W) {
    const double started = sli_seconds();
    sl_work own = sli_work_own(&Z->allocator);
    sli_selected_run q;
    sl_status status;
    SLI_CLEAR(q);
    q.Z = Z;
    q.F = F;
    q.run.F = F;
    q.run.traversal = &Z->traversal;
    q.run.threads = &Z->threads;
    q.run.visit = sli_selected_visit;
    q.run.context = Z;
    status = sli_work_stages(W == NULL ? &own : W, sli_selected_stages, 2, &q);
    if (status == SL_OK && q.is_lossy) {
        SLI_ZERO(Z->Z, Z->begin[Z->traversal.forest.count]);
        sli_parallel(&Z->threads, Z->traversal.schedule.workers, sli_selected_solve_worker, &q);
    } else if (status == SL_OK) {
        sli_traverse(&q.run);
    }
    if (status == SL_OK) {
        sli_selected_clear_nulls(Z, F);
        Z->numbers = sli_numbers_of(F);
        Z->seconds = sli_seconds() - started;
    }
    sli_free(&own.allocator, own.block);
    return status;
}

/* Allocates the numbers. */
static sl_status sli_selected_alloc_values(sl_selected *Z) {
    sli_block b = {NULL, 0};
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
    status = sli_begin(out);
    if (status == SL_OK) {
        status = sli_argument(F == NULL ? "F is NULL" : sli_options_wrong(opt, SLI_READS_NOTHING));
    }
    status = status == SL_OK ? sli_list(&set, &count, F->S->n) : status;
    status = status == SL_OK ? sli_inverse_check(F) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
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
        if (stats != NULL) {
            stats->selected = sl_selected_view(Z).info;
        }
        *out = Z;
    } else {
        sl_selected_free(Z);
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_selected_refactor(sl_selected *Z, const sl_factor *F, sl_work *W) {
    sl_status status = sli_argument(Z == NULL ? "Z is NULL" : F == NULL ? "F is NULL" : NULL);
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status == SL_OK && F->S != Z->traversal.S) {
        status = sli_refuse(SL_ERR_MISMATCH, "Z and F are of different analyses");
    }
    if (status == SL_OK && Z->is_immutable) {
        status = sli_refuse_mapped();
    }
    return status == SL_OK ? sli_selected_fill(Z, F, W) : status;
}

SL_API void sl_selected_free(sl_selected *Z) {
    if (Z != NULL) {
        const sl_allocator a = Z->allocator;
        sli_symbolic_return(Z->traversal.S);
        sli_free(&a, Z->is_mapped ? NULL : Z->Z);
        sli_free(&a, Z);
    }
}

#endif
