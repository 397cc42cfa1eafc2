/* fronts.inl.h: the fronts of the supernodal factorization, for one type of numbers */

/* Whoever includes this has defined
 *
 *  SLF_NAME(f)            the name of function f for this type
 *  SLF_VALUE              the type of the numbers of a front
 *  SLF_SINGLE             1: floats, and no 2x2 pivots; 0: doubles
 *  SLF_HALF               1: a front holds the first columns of pairs only; 0: all columns
 *  SLF_OF(f, array)       an array of front f
 *  SLF_BEGIN(F, s, w)     the front of supernode s, which worker w factors, without its update
 *                         matrix
 *
 * fronts_undef.inl.h undefines them. [DR83], [Liu92] */

/* The update matrix of supernode s, which this worker factors if it is within a task. */
SLI_INLINE SLF_VALUE *SLF_NAME(update_matrix)(const sl_factor *F, sl_int s, sl_int worker) {
    const sl_off begin = F->schedule.stack_begin[s], own = F->schedule.own;
    const sl_off at = begin < own ? begin + worker * own : begin;
    return (SLF_VALUE *)F->work.stack + (at >> SLF_HALF);
}

/* The front of supernode s, which this worker factors. */
SLI_INLINE sli_front SLF_NAME(front_of)(const sl_factor *F, sl_int s, sl_int worker) {
    sli_front f = SLF_BEGIN(F, s, worker);
    SLF_OF(&f, update) = SLF_NAME(update_matrix)(F, s, worker);
    return f;
}

/* Clears row tiles t0 .. t1-1 of a front. */
static void SLF_NAME(front_clear)(const sli_front *f, sl_int t0, sl_int t1) {
    const sl_int w = f->width, whole = w / SLI_TILE, u0 = sli_max(t0 - whole, 0);
    const sl_off from = sli_tile_offset(w, t0), size = sli_tile_offset(w, t1) - from;
    const sl_off at = sli_triangle_offset(u0), end = sli_triangle_offset(t1 - whole);
    memset(SLF_OF(f, panel) + (from >> SLF_HALF), 0,
           (size_t)(size >> SLF_HALF) * sizeof(SLF_VALUE));
    if (f->below > 0 && t1 > whole) {
        memset(SLF_OF(f, update) + (at >> SLF_HALF), 0,
               (size_t)((end - at) >> SLF_HALF) * sizeof(SLF_VALUE));
    }
}

/* Adds entries of the scatter map to the panel of supernode s, and records the largest magnitude.
 * marks: gets the mark of what is added, or NULL. */
SLI_ALWAYS_INLINE sl_status SLF_NAME(panel_add)(const sl_factor *F, sl_int s, SLF_VALUE *panel,
                                                const sli_loading *e, uint64_t *marks,
                                                sli_failure *failure) {
    const sl_off *to = F->S->scatter_to, begin = F->S->steps[s].panel;
    const sl_off ahead = F->S->scatter_begin[F->S->n_supers] - SLI_ENTRIES_AHEAD;
    const double *x = e->x;
    const sl_int *scatter_from = e->scatter_from;
    double largest = F->extents[s].entry;
    uint64_t mark = 0;
    sl_off m;
    for (m = e->first; m < e->last; m++) {
        if (scatter_from != NULL && m < ahead) { /* untested: constant */
            SLI_PREFETCH(x + scatter_from[m + SLI_ENTRIES_AHEAD], 0);
        }
        const double a =
            scatter_from != NULL ? x[scatter_from[m]] : x[m - e->first]; /* untested: constant */
        const double size = fabs(a);
#if SLF_SINGLE
        if (!(size <= SLI_SINGLE_MOST)) {
            return sli_fail(failure, sli_is_finite(a) ? SL_ERR_INACCURATE : SL_ERR_NOT_FINITE, s,
                            -1, m, a);
        }
        panel[to[m] - begin] += sli_single(a);
#else
        if (!(size <= DBL_MAX)) {
            return sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, m, a);
        }
#if SLF_HALF
        if ((to[m] & SLI_TILE) == 0) {
            panel[sli_half_at(to[m] - begin)] += a;
        }
#else
        panel[to[m] - begin] += a;
#endif
        if (marks != NULL) { /* untested: constant where entries are summed */
            mark += sli_mark_entry(a, to[m] - begin);
        }
#endif
        largest = size > largest ? size : largest;
    }
    F->extents[s].entry = largest;
    if (marks != NULL) { /* untested: the same */
        marks[s] += mark;
    }
    return SL_OK;
}

/* Adds the matrix's entries to the cleared panel of supernode s. */
static sl_status SLF_NAME(panel_load)(const sl_factor *F, const sli_source *from, sl_int s,
                                      SLF_VALUE *panel, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sl_off end = S->scatter_begin[s + 1];
    sli_loading e;
    sl_status status = SL_OK;
    sli_panel_begin(F, s);
    e.first = S->scatter_begin[s];
    if (from->A != NULL) {
        e.x = from->A->x;
        e.scatter_from = S->scatter_from;
        e.last = end;
        return SLF_NAME(panel_add)(F, s, panel, &e, SLF_SINGLE ? NULL : F->history.marks, failure);
    }
    e.scatter_from = NULL;
    for (; e.first < end && status == SL_OK; e.first = e.last) {
        double sums[SLI_SUM_ENTRIES];
        e.last = end - e.first < SLI_SUM_ENTRIES ? end : e.first + SLI_SUM_ENTRIES;
        e.x = sums;
        sli_source_sum(from, e.first, (sl_int)(e.last - e.first), sums);
        status = SLF_NAME(panel_add)(F, s, panel, &e, NULL, failure);
    }
    return status;
}

/* Adds the matrix's entries to the cleared panel and starts the magnitudes of its diagonal with
 * them. */
static sl_status SLF_NAME(front_load)(sl_factor *F, const sli_source *from, const sli_front *f,
                                      sli_failure *failure) {
    SLF_VALUE *panel = SLF_OF(f, panel), *magnitude = SLF_OF(f, magnitude);
    const sl_status status = SLF_NAME(panel_load)(F, from, f->super, panel, failure);
    const sl_int w = f->width, rows = SLI_TILE * sli_front_tiles(f);
    sl_int k;
    for (k = 0; k < rows; k++) {
        magnitude[k] = 0;
    }
#if SLF_HALF
    for (k = 0; k < w; k += 2) {
        magnitude[k] = fabs(panel[sli_half_at(sli_panel_at(w, k, k))]);
    }
#else
    for (k = 0; k < w; k += SLI_TILE) {
        const SLF_VALUE *tile = panel + sli_panel_at(w, k, k);
        const sl_int columns = sli_min(SLI_TILE, w - k);
        sl_int r;
        for (r = 0; r < columns; r++) {
            magnitude[k + r] = (SLF_VALUE)fabs(tile[(SLI_TILE + 1) * r]);
        }
    }
#endif
    return status;
}

/* Extend-add: assembles the children's update matrices into row tiles t0 .. t1-1, the last child
 * first. */
static void SLF_NAME(front_assemble)(const sl_factor *F, const sli_front *f, sl_int worker,
                                     sl_int t0, sl_int t1) {
    const sl_symbolic *S = F->S;
    const sl_int tiles = sli_front_tiles(f);
    sl_int c, k;
    for (c = f->super - 1; c >= S->first_descendant[f->super]; c = S->first_descendant[c] - 1) {
        const sli_step *child = &S->steps[c];
        const sl_int *relative = S->relative + S->rows_begin[c];
        const SLF_VALUE *from = SLF_NAME(update_matrix)(F, c, worker);
        const sl_off magnitudes = child->width % SLI_TILE +
                                  sli_triangle_offset(sli_update_tiles(child->width, child->below));
        const SLF_VALUE *magnitude = from + (magnitudes >> SLF_HALF);
        const sl_int first = t0 == 0 ? 0 : sli_lower_bound(relative, child->below, SLI_TILE * t0);
        const sl_int last =
            t1 == tiles ? child->below : sli_lower_bound(relative, child->below, SLI_TILE * t1);
        F->front->assemble(f, from, child->width % SLI_TILE, relative, child->below, first, last);
        for (k = first; k < last; k += 1 + SLF_HALF) {
            SLF_OF(f, magnitude)[relative[k]] += magnitude[k >> SLF_HALF];
        }
    }
}

/* Stores the magnitudes of the rows below, or of pairs of them, next to the update matrix, for the
 * parent. */
static void SLF_NAME(front_hand_over)(const sli_front *f) {
    const sl_int tiles = sli_update_tiles(f->width, f->below), rows = SLI_TILE * tiles;
    const SLF_VALUE *from = SLF_OF(f, magnitude) + SLI_TILE * (ptrdiff_t)(f->width / SLI_TILE);
    SLF_VALUE *to = SLF_OF(f, update) + (sli_triangle_offset(tiles) >> SLF_HALF);
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
    sl_int k;
#if SLF_SINGLE
    for (k = 0; k < f->width && status == SL_OK; k++) {
        status = sli_check_single(F, f, k, failure);
    }
#else
    const sl_int count = sli_front_is_regular(F, f, f->super) ? 0 : f->width;
    for (k = 0; k < count && status == SL_OK; k++) {
        status =
            f->pairs != NULL && f->pairs[k] != SLI_PAIR_NONE
                ? sli_check_pair(F, f->super, f->column + k, f->magnitude + k, failure)
                : sli_check_pivot(F, f->super, f->column + k, f->D[k], f->magnitude[k], failure);
    }
    if (status == SL_OK && F->type->store != NULL) {
        status = F->type->store(F, f, failure);
    }
#endif
    return status;
}

/* Hands over and checks a front that workers share. */
static sl_status SLF_NAME(front_finish)(const sl_factor *F, const sli_front *f,
                                        sli_failure *failure) {
    SLF_NAME(front_hand_over)(f);
    return SLF_NAME(front_check)(F, f, failure);
}

/* Factors the front of supernode s on one worker. */
static sl_status SLF_NAME(front_factor)(sl_factor *F, const sli_source *from, sl_int s,
                                        sl_int worker, sli_failure *failure) {
    sli_front f = SLF_NAME(front_of)(F, s, worker);
    const sl_int tiles = sli_front_tiles(&f);
    double *scratch = F->work.buffer + (ptrdiff_t)worker * sli_front_scratch(F->S->widest);
    sl_status status;
    f.is_small = tiles == 1 && f.pairs == NULL && !SLF_HALF;
#if !SLF_SINGLE
    if (f.is_small) {
        sli_front_clear_small(&f);
    } else
#endif
    {
        SLF_NAME(front_clear)(&f, 0, tiles);
    }
    status = SLF_NAME(front_load)(F, from, &f, failure);
    if (status != SL_OK) {
        return status;
    }
    SLF_NAME(front_assemble)(F, &f, worker, 0, tiles);
    sli_front_eliminate(F->front, &f, scratch);
    sli_front_update(F->front, &f, scratch);
    SLF_NAME(front_hand_over)(&f);
    return SLF_NAME(front_check)(F, &f, failure);
}

/* Factors or copies supernodes first .. last on one worker. */
static sl_status SLF_NAME(factor)(sl_factor *F, const sli_source *from, sl_int first, sl_int last,
                                  sl_int worker, sli_failure *failure) {
    sl_status status = SL_OK;
    sl_int s;
    for (s = first; s <= last && status == SL_OK; s++) {
        if (sli_is_copied(F, s)) {
            F->work.copied->copy(F, s, worker);
        } else {
            status = SLF_NAME(front_factor)(F, from, s, worker, failure);
        }
    }
    return status;
}
