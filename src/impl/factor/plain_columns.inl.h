/* plain_columns.inl.h: plain columns, in double: their pivots and L, and what they pass up */

/* Adds -l d l' to a front, in rows first .. last-1 of the column l, which has these relative
 * indices, and what it adds to the diagonal to the magnitudes. */
SLI_INLINE void sli_plain_assemble(const sli_front *f, const double *l, double d,
                                   const sl_int *relative, sl_int first, sl_int last) {
    const sl_int w = f->width, whole = (sl_int)((uint32_t)w / SLI_TILE);
    double *const magnitude = f->magnitude, *const panel = f->panel; /* in registers */
    double *const update = f->update;
    ptrdiff_t r, k, inside = 0; /* columns in the panel */
    while (inside < first && relative[inside] < w) {
        inside++;
    }
    for (r = first; r < last; r++) {
        const uint32_t row = (uint32_t)relative[r], lane = row % SLI_TILE;
        const sl_int tile = (sl_int)(row / SLI_TILE);
        const double x = l[r] * d, product = x * l[r];
        double *to;
        if ((sl_int)row < w) {
            to = panel + sli_triangle_offset(tile) + lane;
            for (k = 0; k < r; k++) {
                to[SLI_TILE * (ptrdiff_t)relative[k]] -= x * l[k];
            }
            to += SLI_TILE * (ptrdiff_t)row;
            inside++;
        } else {
            to = panel + sli_tile_offset(w, tile) + lane;
            for (k = 0; k < inside; k++) {
                to[SLI_TILE * (ptrdiff_t)relative[k]] -= x * l[k];
            }
            to = update + sli_triangle_offset(tile - whole) + lane;
            for (; k < r; k++) {
                to[SLI_TILE * (ptrdiff_t)(relative[k] - SLI_TILE * whole)] -= x * l[k];
            }
            to += SLI_TILE * ((ptrdiff_t)row - SLI_TILE * whole);
        }
        *to -= product;
        magnitude[row] += fabs(product);
    }
}

/* Plain column s in double. */
SLI_INLINE double *sli_plain_column(const sl_factor *F, sl_int s, sl_int worker) {
    return F->schedule.is_plain[s] != SLI_PLAIN_PASSED ? (double *)F->values + F->S->steps[s].panel
                                                       : sli_double_update_matrix(F, s, worker);
}

/* Adds what plain children c, the one before, ... pass up to rows from .. to-1 of a front. Returns
 * the first child that is not plain, or what is before all children. */
SLI_AT_LINE SLI_NOINLINE static sl_int sli_plain_children(const sl_factor *F, const sli_front *f,
                                                          sl_int c, sl_int worker, sl_int from,
                                                          sl_int to) {
    const sl_symbolic *S = F->S;
    const sl_int *low = S->first_descendant, end = low[f->super], rows = f->width + f->below;
    for (; c >= end && F->schedule.is_plain[c]; c = low[c] - 1) {
        const sl_int *relative = S->relative + S->rows_begin[c], below = S->steps[c].below;
        sli_plain_assemble(f, sli_plain_column(F, c, worker) + 1, F->D[S->steps[c].column],
                           relative, from == 0 ? 0 : sli_lower_bound(relative, below, from),
                           to >= rows ? below : sli_lower_bound(relative, below, to));
    }
    return c;
}

/* What child c with one row below adds to a plain column: *pivot changes, and *magnitude grows. */
SLI_INLINE void sli_plain_take(const sl_factor *F, sl_int c, sl_int worker, double *pivot,
                               double *magnitude) {
    const sli_step *child = &F->S->steps[c];
    if (F->schedule.is_plain[c]) {
        const double l = sli_plain_column(F, c, worker)[1];
        const double product = l * F->D[child->column] * l;
        *pivot -= product;
        *magnitude += fabs(product);
    } else { /* the one entry of its update matrix, and the magnitude */
        const double *from = sli_double_update_matrix(F, c, worker);
        const sl_int at = child->width % SLI_TILE;
        *pivot += from[(SLI_TILE + 1) * at];
        *magnitude += from[sli_triangle_offset(1) + at];
    }
}

/* Computes plain columns from supernode s up to `last` while each is direct, with nothing to refuse
 * and nothing to replace. Returns the first supernode that it leaves. */
SLI_NOINLINE static sl_int sli_plain_run(const sl_factor *F, const double *x, sl_int s,
                                         sl_int last) {
    const sl_symbolic *S = F->S;
    const double tolerance = F->rule.null_tolerance > 0.0 ? F->rule.null_tolerance : 0.0;
    const sl_int *at = S->scatter_from + S->scatter_begin[s], *low = S->first_descendant;
    const sli_step *steps = S->steps;
    const signed char *const signs = F->rule.signs;
    double *const L = (double *)F->values, *const D = F->D, *const shifts = F->rule.shifts;
    const sl_int *const ahead = S->scatter_from + S->scatter_begin[S->n_supers] - SLI_ENTRIES_AHEAD;
    sli_extent *extent = F->extents + s;
    for (; s <= last && F->schedule.is_plain[s] == SLI_PLAIN_DIRECT; s++, extent++) {
        const sli_step *step = &steps[s];
        double *l = L + step->panel, pivot = 0.0 + x[*at], magnitude = fabs(pivot);
        double entry = magnitude;
        const sl_int *end = ++at + step->below;
        ptrdiff_t c;
        if (at < ahead) { /* most have two entries */
            SLI_PREFETCH(x + at[SLI_ENTRIES_AHEAD - 1], 0);
            SLI_PREFETCH(x + at[SLI_ENTRIES_AHEAD], 0);
        }
        for (c = (ptrdiff_t)s - 1; c >= low[s]; c = (ptrdiff_t)low[c] - 1) {
            const double own = L[steps[c].panel + 1], product = own * D[steps[c].column] * own;
            pivot -= product;
            magnitude += fabs(product);
        }
        for (*l = 0.0; at < end; at++) {
            const double a = x[*at], size = fabs(a);
            if (!(size <= DBL_MAX)) {
                return s;
            }
            entry = entry > size ? entry : size;
            *++l = (0.0 + a) / pivot; /* no -0, as in a sum of entries */
        }
        if (!(fabs(pivot) > tolerance * magnitude)) { /* also if they are not finite */
            return s;
        }
        if (shifts != NULL) {
            if (pivot * (signs == NULL ? 1.0 : signs[step->column]) < 0.0) {
                return s;
            }
            shifts[step->column] = 0.0;
        }
        D[step->column] = pivot;
        extent->entry = entry;
        extent->magnitude = magnitude;
        extent->pivot = step->column;
        extent->suspects = 0;
    }
    return s;
}

/* Ends column s: refuses its pivot as sli_check_pivot does, and stores l unless it is in L.
 * magnitude: of all rows or, if it is plain, of the first one. */
SLI_NOINLINE static sl_status sli_column_end(const sl_factor *F, sl_int s, sl_int worker, double *l,
                                             const double *magnitude, sli_failure *failure) {
    const sl_int k = F->S->steps[s].column, below = F->S->steps[s].below;
    const sl_int end = SLI_TILE * sli_tiles(1 + below);
    sl_status status = sli_check_pivot(F, s, k, F->D[k], *magnitude, failure);
    if (status == SL_OK && F->type->store != NULL) {
        sli_front f = sli_front_in_double(F, s, worker);
        sl_int r;
        f.panel = l;
        for (r = 0; r < end; r++) {
            l[r] = r > below ? 0.0 : l[r];
            f.magnitude[r] =
                r > below || F->schedule.is_plain[s] ? fabs(l[r] * *f.D * l[r]) : magnitude[r];
        }
        status = F->type->store(F, &f, failure);
    }
    return status;
}

/* Computes plain column s: its pivot and its entries of L. */
static sl_status sli_plain_factor(sl_factor *F, const sli_source *from, sl_int s, sl_int worker,
                                  sli_failure *failure) {
    const sl_symbolic *S = F->S;
    const sli_step *step = &S->steps[s];
    const sl_int k = step->column, below = step->below;
    double *l = sli_plain_column(F, s, worker), pivot, magnitude;
    sl_int c, r;
    SLI_ZERO(l, 1 + below);
    if (sli_double_panel_load(F, from, s, l, failure) != SL_OK) {
        return failure->status;
    }
    pivot = *l;
    magnitude = fabs(pivot);
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        sli_plain_take(F, c, worker, &pivot, &magnitude);
    }
    pivot = F->rule.replaces ? sli_pivot_by_rule(&F->rule, k, pivot, magnitude) : pivot;
    F->D[k] = pivot;
    *l = 0.0;
    for (r = 1; r <= below; r++) {
        l[r] /= pivot;
    }
    return sli_column_end(F, s, worker, l, &magnitude, failure);
}
