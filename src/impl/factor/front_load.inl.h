/* front_load.inl.h: where a front is, and the entries of A that it begins with */

/* The update matrix of supernode s, which this worker factors if it is within a task. */
SLI_INLINE double *SLF_NAME(update_matrix)(const sl_factor *F, sl_int s, sl_int worker) {
    const sl_off begin = F->schedule.stack_begin[s], own = F->schedule.own;
    const sl_off at = begin < own ? begin + worker * own : begin;
    return (double *)F->work.stack + (at >> SLF_HALF);
}

/* The front of supernode s, which this worker factors. */
SLI_INLINE sli_front SLF_NAME(front_of)(const sl_factor *F, sl_int s, sl_int worker) {
    sli_front f = sli_front_in_double(F, s, worker);
    f.update = SLF_NAME(update_matrix)(F, s, worker);
    return f;
}

/* Clears row tiles t0 .. t1-1 of a front. */
static void SLF_NAME(front_clear)(const sli_front *f, sl_int t0, sl_int t1) {
    const sl_int w = f->width, whole = w / SLI_TILE, u0 = sli_max(t0 - whole, 0);
    const sl_off from = sli_tile_offset(w, t0), size = sli_tile_offset(w, t1) - from;
    const sl_off at = sli_triangle_offset(u0), end = sli_triangle_offset(t1 - whole);
    memset(f->panel + (from >> SLF_HALF), 0, (size_t)(size >> SLF_HALF) * sizeof(double));
    if (f->below > 0 && t1 > whole) {
        memset(f->update + (at >> SLF_HALF), 0, (size_t)((end - at) >> SLF_HALF) * sizeof(double));
    }
}

/* Adds entries of the scatter map to the panel of supernode s, and records the largest magnitude.
 * marks: gets the mark of what is added, or NULL. */
SLI_ALWAYS_INLINE sl_status SLF_NAME(panel_add)(const sl_factor *F, sl_int s, double *panel,
                                                const sli_loading *e, uint64_t *marks,
                                                sli_failure *failure) {
    const sl_off *to = F->S->scatter_to, begin = F->S->steps[s].panel;
    const sl_off ahead = F->S->scatter_begin[F->S->n_supers] - SLI_ENTRIES_AHEAD;
    const double *x = e->x;
    const sl_int *scatter_from = e->scatter_from;
    double largest = F->extents[s].entry;
    uint64_t mark = 0;
    sl_off m;
    for (m = e->first; m < e->last; m++) {       /* branches untested: no complex matrix is a sum */
        if (scatter_from != NULL && m < ahead) { /* untested: constant */
            SLI_PREFETCH(x + scatter_from[m + SLI_ENTRIES_AHEAD], 0);
        }
        const double a =
            scatter_from != NULL ? x[scatter_from[m]] : x[m - e->first]; /* untested: constant */
        const double size = fabs(a);
        if (!(size <= DBL_MAX)) { /* branches untested: the same */
            return sli_fail(failure, SL_ERR_NOT_FINITE, s, -1, m, a);
        }
#if SLF_HALF
        if ((to[m] & SLI_TILE) == 0) { /* branches untested: the same */
            panel[sli_half_at(to[m] - begin)] += a;
        }
#else
        panel[to[m] - begin] += a;
#endif
        if (marks != NULL) { /* untested: constant where entries are summed */
            mark += sli_mark_entry(a, to[m] - begin);
        }
        largest = size > largest ? size : largest; /* branches untested: the same */
    }
    F->extents[s].entry = largest;
    if (marks != NULL) { /* untested: the same */
        marks[s] += mark;
    }
    return SL_OK;
}

/* Adds the matrix's entries to the cleared panel of supernode s. */
static sl_status SLF_NAME(panel_load)(const sl_factor *F, const sli_source *from, sl_int s,
                                      double *panel, sli_failure *failure) {
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
        return SLF_NAME(panel_add)(F, s, panel, &e, F->history.marks, failure);
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
    double *panel = f->panel, *magnitude = f->magnitude;
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
        const double *tile = panel + sli_panel_at(w, k, k);
        const sl_int columns = sli_min(SLI_TILE, w - k);
        sl_int r;
        for (r = 0; r < columns; r++) {
            magnitude[k + r] = fabs(tile[(SLI_TILE + 1) * r]);
        }
    }
#endif
    return status;
}
