/* fronts.inl.h: the fronts of the supernodal factorization, of real or of complex matrices */

/* Whoever includes this has defined
 *
 *  SLF_NAME(f)            the name of function f
 *  SLF_HALF               1: a front holds the first columns of pairs only; 0: all columns
 *
 * fronts_undef.inl.h undefines them. [DR83], [Liu92] */

#include "front_load.inl.h"
#if !SLF_HALF
#include "plain_columns.inl.h"
#endif

/* Extend-add: assembles the children's update matrices into row tiles t0 .. t1-1, the last child
 * first. */
static void SLF_NAME(front_assemble)(const sl_factor *F, const sli_front *f, sl_int worker,
                                     sl_int t0, sl_int t1) {
    const sl_symbolic *S = F->S;
    const sl_int tiles = sli_front_tiles(f);
    sl_int c, k;
    for (c = f->super - 1;; c = S->first_descendant[c] - 1) {
#if !SLF_HALF
        c = sli_plain_children(F, f, c, worker, SLI_TILE * t0, SLI_TILE * t1);
#endif
        if (c < S->first_descendant[f->super]) {
            break;
        }
        const sli_step *child = &S->steps[c];
        const sl_int *relative = S->relative + S->rows_begin[c];
        const sl_int first = t0 == 0 ? 0 : sli_lower_bound(relative, child->below, SLI_TILE * t0);
        const sl_int last =
            t1 == tiles ? child->below : sli_lower_bound(relative, child->below, SLI_TILE * t1);
        const sl_off magnitudes = child->width % SLI_TILE +
                                  sli_triangle_offset(sli_update_tiles(child->width, child->below));
        const double *from = SLF_NAME(update_matrix)(F, c, worker);
        const double *magnitude = from + (magnitudes >> SLF_HALF);
        F->own.front->assemble(f, from, child->width % SLI_TILE, relative, child->below, first,
                               last);
        for (k = first; k < last; k += 1 + SLF_HALF) {
            f->magnitude[relative[k]] += magnitude[k >> SLF_HALF];
        }
    }
}

/* Stores the magnitudes of the rows below, or of pairs of them, next to the update matrix, for the
 * parent. */
static void SLF_NAME(front_hand_over)(const sli_front *f) {
    const sl_int tiles = sli_update_tiles(f->width, f->below), rows = SLI_TILE * tiles;
    const double *from = f->magnitude + SLI_TILE * (ptrdiff_t)(f->width / SLI_TILE);
    double *to = f->update + (sli_triangle_offset(tiles) >> SLF_HALF);
    sl_int k;
    for (k = 0; k < rows; k += 1 + SLF_HALF) {
#if SLF_HALF
        to[k / 2] = from[k] + from[k + 1];
#else
        to[k] = from[k];
#endif
    }
}

/* Ends a front: refuses pivots that are not finite, and null pivots that were not replaced; stores
 * the panel unless it is where it belongs. */
static sl_status SLF_NAME(front_check)(const sl_factor *F, const sli_front *f,
                                       sli_failure *failure) {
    sl_status status = SL_OK;
    const sl_int count = sli_front_is_regular(F, f, f->super) ? 0 : f->width;
    sl_int k;
    for (k = 0; k < count && status == SL_OK; k++) {
        status =
            f->pairs != NULL && f->pairs[k] != SLI_PAIR_NONE
                ? sli_check_pair(F, f->super, f->column + k, f->magnitude + k, failure)
                : sli_check_pivot(F, f->super, f->column + k, f->D[k], f->magnitude[k], failure);
    }
    if (status == SL_OK && F->type->store != NULL) {
        status = F->type->store(F, f, failure);
    } else if (f->width == 1 && F->type->store == NULL) { /* branches untested: see above */
        SLI_COPY((double *)F->values + F->S->steps[f->super].panel, f->panel, 1 + f->below);
    }
    return status;
}

/* Hands over and checks a front that workers share. */
static sl_status SLF_NAME(front_finish)(const sl_factor *F, const sli_front *f,
                                        sli_failure *failure) {
    SLF_NAME(front_hand_over)(f);
    return SLF_NAME(front_check)(F, f, failure);
}

#if !SLF_HALF
/* The front of a column with up to 7 rows below: l is the column, the tile its update matrix, with
 * row r of the front in row and column r. */
typedef struct sli_short {
    double *l, *tile, *magnitude;
} sli_short;

/* Adds what child c passes up. Its first row below is the column. */
SLI_INLINE void sli_short_assemble(const sl_factor *F, const sli_short *f, sl_int c,
                                   sl_int worker) {
    const sli_step *child = &F->S->steps[c];
    const sl_int *relative = F->S->relative + F->S->rows_begin[c];
    const sl_int below = child->below, skipped = child->width % SLI_TILE;
    const double *update, *magnitude;
    sl_int r, k;
    if (F->schedule.is_plain[c]) { /* -l d l' */
        const double *l = sli_plain_column(F, c, worker) + 1, d = F->D[child->column];
        for (r = 0; r < below; r++) {
            const sl_int row = relative[r];
            const double x = l[r] * d;
            f->l[row] -= x * l[0];
            for (k = 1; k <= r; k++) {
                f->tile[SLI_TILE * relative[k] + row] -= x * l[k];
            }
            f->magnitude[row] += fabs(x * l[r]);
        }
        return;
    }
    update = sli_double_update_matrix(F, c, worker);
    magnitude = update + sli_triangle_offset(sli_tiles(skipped + below)) + skipped;
    for (r = 0; r < below; r++) {
        const sl_int row = relative[r], at = skipped + r;
        const double *from =
            update + sli_triangle_offset(at / SLI_TILE) + SLI_TILE * skipped + at % SLI_TILE;
        f->l[row] += from[0];
        for (k = 1; k <= r; k++) {
            f->tile[SLI_TILE * relative[k] + row] += from[SLI_TILE * k];
        }
        f->magnitude[row] += magnitude[r];
    }
}

/* Factors such a front in scalars: most of its time would be spent on calls, and on vectors with
 * few rows in them. */
static sl_status sli_short_factor(sl_factor *F, const sli_source *from, sl_int s, sl_int worker,
                                  sli_failure *failure) {
    const sli_step *step = &F->S->steps[s];
    const sl_int below = step->below;
    double x[SLI_TILE], pivot;
    sli_short f;
    sl_int c, r, k;
    f.l =
        F->type->store == NULL ? (double *)F->values + step->panel : sli_front_panel(F, s, worker);
    f.tile = sli_double_update_matrix(F, s, worker);
    f.magnitude = f.tile + SLI_TILE * SLI_TILE;
    for (r = 0; r <= below; r++) {
        f.l[r] = f.magnitude[r] = 0.0;
        for (k = 1; k <= r; k++) {
            f.tile[SLI_TILE * k + r] = 0.0;
        }
    }
    if (sli_double_panel_load(F, from, s, f.l, failure) != SL_OK) {
        return failure->status;
    }
    f.magnitude[0] = fabs(f.l[0]);
    for (c = s - 1; c >= F->S->first_descendant[s]; c = F->S->first_descendant[c] - 1) {
        sli_short_assemble(F, &f, c, worker);
    }
    pivot = F->rule.replaces ? sli_pivot_by_rule(&F->rule, step->column, f.l[0], f.magnitude[0])
                             : f.l[0];
    F->D[step->column] = pivot;
    f.l[0] = 0.0;
    for (r = 1; r <= below; r++) { /* l = x / d, then the update matrix -= l x' */
        x[r] = f.l[r];
        f.l[r] = x[r] / pivot;
        for (k = 1; k <= r; k++) {
            f.tile[SLI_TILE * k + r] -= f.l[r] * x[k];
        }
        f.magnitude[r] += fabs(f.l[r] * x[r]);
    }
    return sli_column_end(F, s, worker, f.l, f.magnitude, failure);
}
#endif

/* Factors the front of supernode s on one worker. */
static sl_status SLF_NAME(front_factor)(sl_factor *F, const sli_source *from, sl_int s,
                                        sl_int worker, sli_failure *failure) {
    sli_front f = SLF_NAME(front_of)(F, s, worker);
    const sl_int tiles = sli_front_tiles(&f);
    double *scratch = F->work.buffer + (ptrdiff_t)worker * sli_front_scratch(F->S->widest);
    sl_status status;
    f.is_small = tiles == 1 && f.pairs == NULL && !SLF_HALF;
    if (f.is_small) {
        sli_front_clear_small(&f);
    } else {
        SLF_NAME(front_clear)(&f, 0, tiles);
    }
    status = SLF_NAME(front_load)(F, from, &f, failure);
    if (status != SL_OK) {
        return status;
    }
    SLF_NAME(front_assemble)(F, &f, worker, 0, tiles);
    sli_front_eliminate(F->own.front, &f, scratch);
    sli_front_update(F->own.front, &f, scratch);
    SLF_NAME(front_hand_over)(&f);
    return SLF_NAME(front_check)(F, &f, failure);
}

/* Factors or copies supernodes first .. last on one worker. */
static sl_status SLF_NAME(factor)(sl_factor *F, const sli_source *from, sl_int first, sl_int last,
                                  sl_int worker, sli_failure *failure) {
    sl_status status = SL_OK;
    sl_int s;
    for (s = first; s <= last && status == SL_OK; s++) {
#if !SLF_HALF
        if (F->schedule.is_plain[s] == SLI_PLAIN_DIRECT && from->A != NULL &&
            F->work.copied == NULL &&
            F->history.marks != NULL && /* branches untested: of a restriction, none is direct */
            !sli_skips_nulls(F)) {
            s = sli_plain_run(F, from->A->x, s, last);
            if (s > last) {
                break;
            }
        }
#endif
        if (sli_is_copied(F, s)) {
            F->work.copied->copy(F, s, worker);
#if !SLF_HALF
        } else if (F->schedule.is_plain[s]) {
            status = sli_plain_factor(F, from, s, worker, failure);
        } else if (F->S->steps[s].width == 1 && F->S->steps[s].below < SLI_TILE) { /* in scalars */
            status = sli_short_factor(F, from, s, worker, failure);
#endif
        } else {
            status = SLF_NAME(front_factor)(F, from, s, worker, failure);
        }
    }
    return status;
}

/* Of a front that workers share, magnitudes and reciprocals are behind its update matrix. */
static sli_front SLF_NAME(shared)(const sl_factor *F, sl_int s, sl_int group) {
    sli_front f = SLF_NAME(front_of)(F, s, 0);
    f.magnitude = f.update + (sli_update_size(&F->S->steps[s]) >> SLF_HALF);
    f.reciprocals = f.magnitude + SLI_TILE * (ptrdiff_t)sli_front_tiles(&f) +
                    SLI_FRONT_RECIPROCALS * (ptrdiff_t)group;
    f.panel = sli_front_panel(F, s, F->schedule.workers);
    return f;
}

static const sli_fronts SLF_NAME(fronts) = {
    SLF_NAME(factor),         /* factor */
    SLF_NAME(shared),         /* shared */
    SLF_NAME(front_clear),    /* clear */
    SLF_NAME(front_load),     /* load */
    SLF_NAME(front_assemble), /* assemble */
    SLF_NAME(front_finish),   /* finish */
};
