/* factor_layout.h: the arrays of a factor, and memory for its factorizations */
#ifndef SLI_FACTOR_FACTOR_LAYOUT_H
#define SLI_FACTOR_FACTOR_LAYOUT_H

#include "../../public/factor.h"
#include "../analysis/schedule.h"
#include "../analysis/symbolic.h"
#include "components.h"
#include "storage_type.h"

/* What a factorization leaves and solves read, and the options that the next one needs. has_mass:
 * there are weights. A saved factor has these arrays in this order (save/format.h). */
static void sli_factor_layout(sl_factor *F, sli_block *b, int has_mass) {
    const sl_symbolic *S = F->S;
    const size_t n = (size_t)S->n;
    F->D = SLI_CUT(b, double, S->n);
    if (S->n_pairs > 0) {
        F->E = SLI_TAKE(b, double, n);
    }
    if (S->n_pairs > 0 || has_mass) {
        F->divisors = SLI_TAKE(b, double, n);
    }
    F->extents = SLI_CUT(b, sli_extent, S->n_supers);
    if (F->rule.regularization != 0.0) {
        F->rule.signs = SLI_TAKE(b, signed char, n);
        F->rule.shifts = SLI_TAKE(b, double, n);
        F->rule.regularized = SLI_TAKE(b, sl_int, n);
    }
    if (sli_skips_nulls(F)) {
        F->null.calls->layout(F, b, has_mass);
    }
    F->values =
        sli_take(b, (uint64_t)(S->panel_begin[S->n_supers] >> F->type->half), F->type->value_bytes);
}

/* The pieces of scratch for panels that are not stored as they are computed: one a worker, and one
 * for a large front that they share. */
static void sli_factor_layout_panels(sl_factor *F, sli_block *b) {
    const sl_symbolic *S = F->S;
    const uint64_t workers = (uint64_t)F->schedule.workers + (F->schedule.workers > 1);
    sl_off room = 0;
    sl_int s;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int w = S->steps[s].width;
        if (sli_panel_is_copied(F, s)) {
            const sl_off size = sli_tile_offset(w, sli_last_tile(S, s) + 1);
            room = size > room ? size : room;
        }
    }
    F->work.panel_room = room;
    F->work.panels = SLI_CUT(b, double, workers *(uint64_t)F->work.panel_room);
}

/* The scratch of a factorization. */
static void sli_factor_layout_scratch(sl_factor *F, sli_block *b) {
    const sl_symbolic *S = F->S;
    const size_t n = (size_t)S->n, supers = (size_t)S->n_supers;
    const uint64_t workers = (uint64_t)F->schedule.workers;
    if (sli_skips_nulls(F)) {
        F->null.calls->layout_scratch(F, b);
    }
    if (F->method == SL_METHOD_SUPERNODAL) {
        const uint64_t rows = SLI_TILE * (uint64_t)sli_tiles(S->tallest);
        F->work.buffer = SLI_CUT(b, double, workers *(uint64_t)sli_front_scratch(S->widest));
        F->work.magnitude = SLI_CUT(b, double, workers *rows);
        F->work.reciprocals = SLI_CUT(b, double, workers *SLI_FRONT_RECIPROCALS);
        F->work.failures = SLI_CUT(b, sli_failure, workers);
        sli_factor_layout_panels(F, b);
        if (F->type->store == NULL) {
            F->history.marks = SLI_CUT(b, uint64_t, S->n_supers);
        }
    } else {
        F->work.buffer = SLI_TAKE(b, double, sli_sweep_scratch(S->tallest, 0, 1));
        F->row.x = SLI_TAKE(b, double, n);
        F->row.head = SLI_TAKE(b, sl_int, n);
        F->row.next = SLI_TAKE(b, sl_int, supers);
        F->row.position = SLI_TAKE(b, sl_int, supers);
        F->row.list = SLI_TAKE(b, uint64_t, supers);
        F->row.list_scratch = SLI_TAKE(b, uint64_t, supers);
    }
}

/* Allocates what a factorization needs besides L and D, unless F has it. A loaded factor gets it
 * with its first refactorization. A supernodal factorization is planned in other memory first:
 * fronts are assigned to workers, and the size of the update stack is known. is_new: in that of the
 * extents. */
static sl_status sli_factor_prepare(sl_factor *F, int is_new) {
    const sl_symbolic *S = F->S;
    const int has_fronts = F->method == SL_METHOD_SUPERNODAL;
    sli_schedule plan = F->schedule, p = plan;
    sli_block b = {NULL, 0}, t = {NULL, 0};
    sli_schedule_work w;
    uint64_t small[512];
    void *room = small;
    size_t planned = 0, bytes = sizeof small;
    sl_status status = SL_OK;
    if (F->scratch != NULL) {
        return SL_OK;
    }
    if (is_new && (size_t)S->n_supers * sizeof *F->extents > bytes) {
        room = F->extents;
        bytes = (size_t)S->n_supers * sizeof *F->extents;
    }
    SLI_CLEAR(w); /* compilers do not see that the layout fills it */
    if (has_fronts) {
        SLI_LAYOUT_IN(&t, &F->allocator, room, bytes, status) {
            sli_schedule_layout(&plan, &t, S->n_supers);
            planned = t.used;
            sli_schedule_work_layout(&w, &t, S->n_supers, plan.workers);
        }
        if (status == SL_OK) {
            sli_schedule_fill(&plan, S, F->type->store != NULL ? SLI_PLAIN_PASSED : SLI_PLAIN, &w);
        }
    }
    SLI_LAYOUT(&b, &F->allocator, status) {
        sli_factor_layout_scratch(F, &b);
        if (has_fronts) {
            F->work.stack = sli_take(&b, (uint64_t)(plan.stack >> F->type->half), sizeof(double));
            sli_schedule_layout_tops(&plan, S, &b);
            p = plan;
            p.workers = F->schedule.workers; /* those that have room */
            sli_schedule_layout(&p, &b, S->n_supers);
        }
    }
    sli_populate(&F->allocator, &b);
    if (status == SL_OK) {
        F->scratch = b.base;
        F->stats.factor.bytes += b.used;
        if (F->history.marks != NULL) {
            SLI_ZERO(F->history.marks, S->n_supers);
        }
        F->null.has_duplicates = sli_skips_nulls(F) && sli_map_has_duplicates(S);
        if (has_fronts) {
            memcpy(p.first, plan.first, planned);
            p.workers = plan.workers;
            sli_schedule_fill_tops(&p, S);
            F->schedule = p;
        }
    } else {
        F->history.marks = NULL;
    }
    sli_block_free(&t, &F->allocator, room);
    return status;
}

#endif
