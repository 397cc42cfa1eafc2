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
    for (m = e->first; m < e->last; m++) {       /* branches untested: no complex matrix is a sum */
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
#endif
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

#if !SLF_SINGLE && !SLF_HALF
/* Adds -l d l' to a front, in rows first .. last-1 of the column l, which has these relative
 * indices, and what it adds to the diagonal to the magnitudes. */
static void sli_plain_assemble(const sli_front *f, const double *l, double d,
                               const sl_int *relative, sl_int first, sl_int last) {
    const sl_int w = f->width, whole = w / SLI_TILE;
    double *magnitude = f->magnitude; /* in registers: what is stored may change f */
    double *const panel = f->panel, *const update = f->update;
    sl_int r, k;
    for (r = first; r < last; r++) {
        const uint32_t row = (uint32_t)relative[r], lane = row % SLI_TILE;
        const sl_int tile = (sl_int)(row / SLI_TILE);
        const double x = l[r] * d;
        double *to = panel + sli_tile_offset(w, tile) + lane;
        for (k = 0; k <= r && relative[k] < w; k++) {
            to[SLI_TILE * (ptrdiff_t)relative[k]] -= x * l[k];
        }
        if (k <= r) {
            to = update + sli_triangle_offset(tile - whole) + lane;
            for (; k <= r; k++) {
                to[SLI_TILE * (ptrdiff_t)(relative[k] - SLI_TILE * whole)] -= x * l[k];
            }
        }
        magnitude[row] += fabs(x * l[r]);
    }
}

/* Plain column s in double. */
SLI_INLINE double *sli_plain_column(const sl_factor *F, sl_int s, sl_int worker) {
    return F->schedule.is_plain[s] != SLI_PLAIN_PASSED ? (double *)F->values + F->S->steps[s].panel
                                                       : sli_double_update_matrix(F, s, worker);
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

/* The mark of a plain column with these entries, in their order, and the largest magnitude, as sets
 * of bits: the order is the same, and NaN come last. */
SLI_INLINE uint64_t sli_plain_mark(const double *x, const sl_int *at, sl_int count, double *most) {
    uint64_t mark = SLI_MARK_BEGIN, place = SLI_HASH_2, largest = 0;
    sl_int m;
    for (m = 0; m < count; m++, place += SLI_HASH_3) {
        uint64_t bits;
        memcpy(&bits, &x[at[m]], sizeof bits);
        mark += sli_mark_bits(bits, place);
        bits &= UINT64_MAX >> 1;
        largest = bits > largest ? bits : largest;
    }
    memcpy(most, &largest, sizeof largest);
    return mark;
}

/* Can a factorization take runs of plain columns? */
SLI_INLINE int sli_plain_runs(const sl_factor *F, const sli_source *from) {
    return from->A != NULL && F->work.copied == NULL &&
           F->history.marks != NULL && /* branches untested: of a restriction, none is direct */
           !F->rule.replaces;
}

/* What a run of plain columns reads and writes: copies of F and its analysis, as a compiler cannot
 * know that numbers that are stored do not change these addresses. */
typedef struct sli_plain_work {
    const double *x;   /* of A */
    const sl_int *at;  /* the first entry of the column in the map */
    const sl_int *low; /* first descendants */
    const sli_step *steps;
    const unsigned char *is_plain;
    sli_extent *extents;
    uint64_t *marks;
    double *L, *D;
    double tolerance;
} sli_plain_work;

/* Computes plain column s, which has so many rows below. Returns 0 if it is not regular. */
SLI_ALWAYS_INLINE int sli_plain_regular(const sl_factor *F, const sli_plain_work *w, sl_int s,
                                        sl_int below, sl_int worker) {
    const sl_int first = w->low[s], k = w->steps[s].column;
    const double *x = w->x;
    const sl_int *at = w->at;
    double *l = w->L + w->steps[s].panel, pivot = 0.0 + x[*at], magnitude = fabs(pivot), size;
    sli_extent *extent = &w->extents[s];
    sl_int c, m;
    w->marks[s] = sli_plain_mark(x, at, below + 1, &extent->entry);
    for (c = s - 1; c >= first; c = w->low[c] - 1) {
        if (w->is_plain[c]) {
            const double own = w->L[w->steps[c].panel + 1];
            const double product = own * w->D[w->steps[c].column] * own;
            pivot -= product;
            magnitude += fabs(product);
        } else {
            sli_plain_take(F, c, worker, &pivot, &magnitude);
        }
    }
    *l = 0.0;
    for (m = 1; m <= below; m++) {
        l[m] = (0.0 + x[at[m]]) / pivot; /* no -0, as in a sum of entries */
    }
    size = fabs(pivot);
    w->D[k] = pivot;
    extent->magnitude = magnitude;
    extent->pivot = k;
    extent->suspects = 0;
    return (size > w->tolerance * magnitude) & (size <= DBL_MAX) & (extent->entry <= DBL_MAX);
}

/* Computes plain columns from supernode s up to `last` while each is regular: its entries of A are
 * its rows one by one, as most are, and there is nothing to refuse and nothing to replace. Returns
 * the supernode after them. What it leaves is computed again from the start. */
SLI_NOINLINE static sl_int sli_plain_run(const sl_factor *F, const double *x, sl_int s, sl_int last,
                                         sl_int worker) {
    const sl_symbolic *S = F->S;
    sli_plain_work w;
    w.x = x;
    w.at = S->scatter_from + S->scatter_begin[s];
    w.low = S->first_descendant;
    w.steps = S->steps;
    w.is_plain = F->schedule.is_plain;
    w.extents = F->extents;
    w.marks = F->history.marks;
    w.L = (double *)F->values;
    w.D = F->D;
    w.tolerance = F->rule.null_tolerance > 0.0 ? F->rule.null_tolerance : 0.0;
    for (; s <= last && w.is_plain[s] == SLI_PLAIN_DIRECT; s++) {
        const sl_int below = w.steps[s].below;
        const int is_regular = below == 1 ? sli_plain_regular(F, &w, s, 1, worker)
                                          : sli_plain_regular(F, &w, s, below, worker);
        if (!is_regular) {
            break;
        }
        w.at += 1 + below;
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
    memset(l, 0, (size_t)(1 + below) * sizeof(double));
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
#endif

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
        const sl_int first = t0 == 0 ? 0 : sli_lower_bound(relative, child->below, SLI_TILE * t0);
        const sl_int last =
            t1 == tiles ? child->below : sli_lower_bound(relative, child->below, SLI_TILE * t1);
        const SLF_VALUE *from, *magnitude;
        sl_off magnitudes;
#if !SLF_SINGLE && !SLF_HALF
        if (F->schedule.is_plain[c]) {
            sli_plain_assemble(f, sli_plain_column(F, c, worker) + 1, F->D[child->column], relative,
                               first, last);
            continue;
        }
#endif
        from = SLF_NAME(update_matrix)(F, c, worker);
        magnitudes = child->width % SLI_TILE +
                     sli_triangle_offset(sli_update_tiles(child->width, child->below));
        magnitude = from + (magnitudes >> SLF_HALF);
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
    if (f->width == 1) {
        memcpy((SLF_VALUE *)F->values + F->S->steps[f->super].panel, f->single.panel,
               (size_t)(1 + f->below) * sizeof(SLF_VALUE));
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
    } else if (f->width == 1 && F->type->store == NULL) { /* branches untested: see above */
        memcpy((double *)F->values + F->S->steps[f->super].panel, f->panel,
               (size_t)(1 + f->below) * sizeof(double));
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

#if !SLF_SINGLE && !SLF_HALF
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
#if !SLF_SINGLE && !SLF_HALF
        if (F->schedule.is_plain[s] == SLI_PLAIN_DIRECT && sli_plain_runs(F, from)) {
            s = sli_plain_run(F, from->A->x, s, last, worker);
            if (s > last) {
                break;
            }
        }
#endif
        if (sli_is_copied(F, s)) {
            F->work.copied->copy(F, s, worker);
#if !SLF_SINGLE && !SLF_HALF
        } else if (F->schedule.is_plain[s]) {
            status = sli_plain_factor(F, from, s, worker, failure);
        } else if (sli_is_short(F, s)) {
            status = sli_short_factor(F, from, s, worker, failure);
#endif
        } else {
            status = SLF_NAME(front_factor)(F, from, s, worker, failure);
        }
    }
    return status;
}
