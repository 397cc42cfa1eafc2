/* sequence_inverse.h: the calls of fuzz_sequence.c for the inverse, regions and null vectors */
#ifndef SL_FUZZ_SEQUENCE_INVERSE_H
#define SL_FUZZ_SEQUENCE_INVERSE_H

#include "sequence_model.h"

/* inverse[i + MOST * j] of a DOMINANT factor */
static void dense_inverse(const factor_t *f, double *inverse) {
    for (sl_int j = 0; j < order_of(f); j++) {
        double unit[MOST] = {0.0};
        unit[j] = 1.0;
        (void)dense_solve(f->v.a, order_of(f), unit, inverse + MOST * j);
    }
}

static void check_diagonal(const factor_t *f, const set_t *set, const double *d) {
    double inverse[ENTRIES];
    if (f->v.kind == DOMINANT) {
        dense_inverse(f, inverse);
        for (sl_int k = 0; k < set->count; k++) {
            const double expected = inverse[set->rows[k] + MOST * set->rows[k]];
            PROMISE(fabs(d[k] - expected) <= tolerance(f) * fabs(expected));
        }
    }
}

static void create_selected(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in);
    selected_t *z = &selected[take(in) % SELECTED];
    set_t set;
    double d[SET];
    if (!f->F) {
        return;
    }
    take_set(in, order_of(f), &set);
    sl_status status;
    if (form % 2 && z->Z) {
        status = sl_selected_refactor(z->Z, f->F, form % 4 == 1 ? work : NULL);
        if (z->analysis != f->analysis || !f->is_valid) {
            PROMISE(is_apart(status));
            return;
        }
    } else {
        const sl_options opt = threaded(form / 4 % 3);
        free_selected(z);
        status = sl_selected_create(&z->Z, f->F, rows_of(&set), set.count, &opt, NULL);
        PROMISE((z->Z != NULL) == (status == SL_OK));
        PROMISE(f->is_valid || is_apart(status));
    }
    PROMISE(status == SL_OK || no_memory(status) || !f->is_valid);
    if (status != SL_OK) {
        return;
    }
    z->analysis = f->analysis;
    z->is_float = f->is_float;
    memcpy(z->a, f->v.a, sizeof z->a);
    status = sl_selected_entries(z->Z, d, rows_of(&set), NULL, set.count, NULL);
    PROMISE(status == SL_OK || (form % 2 && status == SL_ERR_OTHER_PATTERN));
    if (status == SL_OK) {
        check_diagonal(f, &set, d);
    }
}

static void create_region(input_t *in) {
    const int which = take(in) % REGIONS, factor = take(in) % FACTORS, form = take(in);
    const int other = take(in) % (2 * SELECTED);
    region_t *r = &regions[which];
    const factor_t *f = &factors[factor];
    const selected_t *z = other < SELECTED && selected[other].Z ? &selected[other] : NULL;
    set_t set;
    if (!f->F) {
        return;
    }
    sl_status status;
    const int is_new = form % 2 == 0 || !r->R;
    if (is_new) {
        sl_options opt = options();
        take_set(in, order_of(f), &set);
        opt.region_bytes = form & 2 ? (size_t)take(in) * 40 : 0;
        free_region(which);
        status =
            sl_region_create(&r->R, f->F, rows_of(&set), set.count, z ? z->Z : NULL, &opt, NULL);
        PROMISE((r->R != NULL) == (status == SL_OK));
    } else {
        status = sl_region_refactor(r->R, f->F, z ? z->Z : NULL, form & 2 ? work : NULL);
    }
    if (no_memory(status)) {
        return;
    }
    if (!f->is_valid || (!is_new && r->analysis != f->analysis)) {
        PROMISE(is_apart(status));
    } else if (f->has_mass && order_of(f) > 0) {
        PROMISE(status == SL_ERR_UNSUPPORTED || (z && is_apart(status)));
    } else if (z && memcmp(z->a, f->v.a, sizeof z->a) != 0) {
        PROMISE(is_apart(status));
    } else { /* with pivots of both signs solves in it could lose digits */
        sl_stats stats;
        stats.factor = sl_factor_view(f->F).info;
        PROMISE(status == SL_OK || (z && is_apart(status)) ||
                (status == SL_ERR_INACCURATE && stats.factor.positive > 0 &&
                 stats.factor.negative > 0));
    }
    if (status == SL_ERR_INACCURATE && !is_new) { /* it has no numbers any more */
        free_region(which);
    }
    if (status == SL_OK) {
        r->analysis = f->analysis;
        r->factor = factor;
        memcpy(r->a, f->v.a, sizeof r->a);
    }
}

/* The size of an entry of the inverse, for tolerances. */
static double entry_size(const double *inverse, sl_int i, sl_int j) {
    return sqrt(fabs(inverse[i + MOST * i] * inverse[j + MOST * j])) + fabs(inverse[i + MOST * j]);
}

static void invert(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in);
    sl_work *W = form % 2 ? work : NULL;
    set_t rows, columns;
    double out[SET], block[SET * SET], inverse[ENTRIES];
    if (!f->F) {
        return;
    }
    take_set(in, order_of(f), &rows);
    take_set(in, order_of(f), &columns);
    const sl_int pairs = rows.count < columns.count ? rows.count : columns.count;
    const sl_status expected = f->is_valid ? SL_OK : SL_ERR_STALE;
    const int is_known = f->is_valid && f->v.kind == DOMINANT;
    memset(inverse, 0, sizeof inverse);
    if (is_known) {
        dense_inverse(f, inverse);
    }
    sl_status status = sl_inverse_diagonal(f->F, out, rows_of(&rows), rows.count, W, NULL);
    PROMISE(status == expected || no_memory(status));
    if (status == SL_OK) {
        check_diagonal(f, &rows, out);
    }
    status = sl_inverse_pairs(f->F, out, rows.rows, columns.rows, pairs, W, NULL);
    PROMISE(status == expected || no_memory(status));
    for (sl_int k = 0; status == SL_OK && is_known && k < pairs; k++) {
        const sl_int i = rows.rows[k], j = columns.rows[k];
        PROMISE(fabs(out[k] - inverse[i + MOST * j]) <= tolerance(f) * entry_size(inverse, i, j));
    }
    status = sl_inverse_block(f->F, block, SET, rows.rows, rows.count, columns.rows, columns.count,
                              W, NULL);
    PROMISE(status == expected || no_memory(status));
    for (sl_int l = 0; is_known && l < columns.count; l++) {
        for (sl_int k = 0; k < rows.count; k++) {
            const sl_int i = rows.rows[k], j = columns.rows[l];
            const double value = inverse[i + MOST * j], most = entry_size(inverse, i, j);
            PROMISE(status != SL_OK || fabs(block[k + SET * l] - value) <= tolerance(f) * most);
        }
    }
}

static void query(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    double log_abs_det = 0.0, sign = 0.0, rcond = -1.0, B[MOST * RHS], X[MOST * RHS], b[MOST];
    sl_int count = -1, rows[MOST];
    sl_stats stats;
    if (!f->F) {
        return;
    }
    const analysis_t *s = &analyses[f->analysis];
    const sl_csc A = view(s, f->v.x);
    const sl_status expected = f->is_valid ? SL_OK : SL_ERR_STALE;
    PROMISE(sl_factor_pivot_rows(f->F, SL_PIVOT_NULL, rows, NULL, MOST, &count) == expected);
    PROMISE(sl_factor_logdet(f->F, &log_abs_det, &sign) == expected);
    for (sl_int k = 0; k < MOST * RHS; k++) {
        B[k] = k < MOST ? take_eighths(in) : B[k - MOST] * 0.5 + 1.0;
        X[k] = 0.0;
    }
    sl_status status = sl_factor_rcond(f->F, &A, &rcond, work);
    PROMISE(status == expected || no_memory(status));
    const sl_int nrhs = take(in) % (RHS + 1);
    const sl_status refined = sl_factor_refine(f->F, &A, X, MOST, B, MOST, nrhs, 8, work, &stats);
    if (expected == SL_OK && refined == SL_ERR_INACCURATE) { /* inconsistent, or wild */
        PROMISE(f->v.kind != DOMINANT && !(stats.refine.backward_error <= 1e-8));
    } else {
        PROMISE(refined == expected || no_memory(refined));
    }
    if (f->is_valid && is_singular(f->v.kind)) {
        PROMISE(count == nullity_of(&f->v, s->n));
        PROMISE(status != SL_OK || (s->n == 0 ? rcond == 1.0 : rcond == 0.0));
    } else if (f->is_valid && f->v.kind == DOMINANT) {
        memset(b, 0, sizeof b);
        const double det = dense_solve(f->v.a, s->n, b, b);
        PROMISE(count == 0 && sign == (det < 0.0 ? -1.0 : 1.0));
        PROMISE(fabs(log_abs_det - log(fabs(det))) <= 1e-11 * (1.0 + fabs(log_abs_det)));
        PROMISE(status != SL_OK || (rcond > 0.0 && rcond <= 1.0 + 1e-9));
        PROMISE(refined != SL_OK || stats.refine.backward_error <= 4e-15);
        for (sl_int r = 0; refined == SL_OK && r < nrhs; r++) {
            check_solution(f, X + MOST * r, B + MOST * r, 1e-11);
        }
    }
    status = sl_factor_defects(f->F, X, MOST, B, MOST, nrhs, work);
    PROMISE(status == expected || no_memory(status));
}

#endif
