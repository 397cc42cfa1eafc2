/* fixed.h: systems with rows fixed at given values: a factor of the free rows */
#ifndef SLI_FIXED_H
#define SLI_FIXED_H

#include "fixed_rows.h"

SL_API void sl_fixed_free(sl_fixed *D) {
    if (D != NULL) {
        const sl_allocator a = D->allocator;
        sl_factor_free(D->F);
        sl_symbolic_free(D->S);
        sl_matrix_free(D->M);
        sli_free(&a, D->from);
        sli_free(&a, D);
    }
}

/* Copies A[free, free], analyzes and factors it. arrays: those of the options. scratch: n + 1
 * elements. */
SLI_COLD static sl_status sli_fixed_factor(sl_fixed *D, const sl_csc *A,
                                           const sli_fixed_arrays *arrays, const sl_int *where,
                                           sl_int *scratch, sl_stats *stats) {
    sl_options analysis = D->analysis, factorization = D->factorization;
    sli_submatrix s;
    sl_csc view;
    sl_status status;
    analysis.perm = arrays->perm;
    analysis.block_size = sli_fixed_keeps_blocks(D, analysis.block_size) ? analysis.block_size : 0;
    factorization.signs = arrays->signs;
    factorization.mass = arrays->mass;
    factorization.null_vector = arrays->null_vector;
    s.A = A;
    s.triangle = D->triangle;
    s.is_folded = 1;
    s.count = D->n_free;
    s.where = where;
    status = sli_submatrix_make(&D->M, &D->from, &s, scratch, &D->allocator);
    if (status == SL_OK) {
        view = sl_matrix_view(D->M);
        status = sl_symbolic_create(&D->S, &view, &analysis, stats);
    }
    if (status == SL_OK) {
        status = sl_factor_create(&D->F, D->S, &view, &factorization, stats);
        status = sli_fixed_report(D, status, stats);
    }
    return status;
}

/* Splits the options of both steps, without their arrays. */
static void sli_fixed_options(sl_fixed *D, const sl_options *opt) {
    const sl_options none = sli_options_with(&D->allocator);
    sl_options *f = &D->factorization, *s = &D->analysis;
    *f = *s = none;
    if (opt == NULL) {
        return;
    }
    s->threads = f->threads = opt->threads;
    s->ordering = opt->ordering;
    s->relaxation = opt->relaxation;
    s->block_size = opt->block_size;
    s->purpose = opt->purpose;
    f->isa = opt->isa;
    f->method = opt->method;
    f->pivots = opt->pivots;
    f->null_tolerance = opt->null_tolerance;
    f->consistency_tolerance = opt->consistency_tolerance;
    f->regularization = opt->regularization;
    f->growth_limit = opt->growth_limit;
    f->error_limit = opt->error_limit;
    f->null_vector_count = opt->null_vector_count;
    f->storage = opt->storage;
}

/* Checks the arguments of a creation. */
static sl_status sli_fixed_check(const sl_csc *A, const sl_int *rows, sl_int count,
                                 const sl_options *opt, sl_stats *stats) {
    sl_status status = sl_csc_check(A, stats);
    if (status == SL_OK) {
        status = sli_argument(A->n_rows != A->n_cols           ? "A is not square"
                              : sli_nnz(A) > 0 && A->x == NULL ? "A.x is NULL"
                              : count < 0                      ? "count is below 0"
                              : count > 0 && rows == NULL
                                  ? "rows is NULL"
                                  : sli_options_wrong(opt, SLI_READS_ANALYSIS | SLI_READS_TRIANGLE |
                                                               SLI_READS_FACTOR | SLI_READS_ISA));
    }
    if (status == SL_OK && opt != NULL) {
        status = sli_argument(sli_factor_choices_wrong(opt));
    }
    return status == SL_OK && opt != NULL && opt->block_size != 0 &&
                   (opt->block_size < 0 || A->n_cols % opt->block_size != 0)
               ? sli_argument("options.block_size does not divide n")
               : status;
}

static void sli_fixed_layout(sl_fixed *D, sli_block *b) {
    (void)sli_take(b, 1, sizeof(sl_fixed));
    D->free_rows = SLI_TAKE(b, sl_int, D->n_free);
    D->fixed_rows = SLI_TAKE(b, sl_int, D->n_fixed);
    D->coupling_free = SLI_TAKE(b, sl_int, D->n_couplings);
    D->coupling_fixed = SLI_TAKE(b, sl_int, D->n_couplings);
    D->coupling_from = SLI_TAKE(b, sl_int, D->n_couplings);
    D->couplings = SLI_TAKE(b, double, D->n_couplings);
}

/* Makes the object without a factor. where := the numbers of the free rows, and -1 minus those of
 * the fixed ones. */
static sl_status sli_fixed_new(sl_fixed **out, const sl_csc *A, const sl_int *rows, sl_fixed *draft,
                               sl_int *where, sl_stats *stats) {
    sli_block b = {NULL, 0};
    sl_fixed *D;
    sl_status status = SL_OK;
    sl_int k, free_row = 0;
    const sl_int bad = sli_rows_invert(rows, draft->n_fixed, draft->n, where);
    if (bad >= 0) {
        return sli_fail_at(stats, SL_ERR_ARGUMENT, rows[bad], -1, sli_min(rows[bad], 0),
                           "a row is out of range or given twice");
    }
    for (k = 0; k < draft->n; k++) {
        where[k] = where[k] < 0 ? free_row++ : -1 - where[k];
    }
    draft->n_free = free_row;
    draft->n_couplings = sli_fixed_couple(NULL, A, draft->triangle, where);
    SLI_LAYOUT(&b, &draft->allocator, status) {
        sli_fixed_layout(draft, &b);
    }
    if (status != SL_OK) {
        return status;
    }
    D = (sl_fixed *)(void *)b.base;
    *D = *draft;
    *out = D;
    for (k = 0; k < D->n_fixed; k++) {
        D->fixed_rows[k] = rows[k];
    }
    for (k = 0; k < D->n; k++) {
        if (where[k] >= 0) {
            D->free_rows[where[k]] = k;
        }
    }
    (void)sli_fixed_couple(D, A, D->triangle, where);
    D->info.n_free = D->n_free;
    D->info.couplings = D->n_couplings;
    status = sli_fixed_check_values(D, A, stats);
    if (status == SL_OK) {
        sli_fixed_copy_values(D, A);
    }
    return status;
}

/* Ends a creation or a refactorization. */
static void sli_fixed_done(sl_fixed *D, double started, sl_stats *stats) {
    D->info.seconds = sli_seconds() - started;
    if (stats != NULL) {
        stats->fixed = D->info;
    }
}

/* Makes the factor of the free rows. scratch: n + 1 elements. */
static sl_status sli_fixed_begin(sl_fixed *D, const sl_csc *A, const sl_options *opt,
                                 const sl_int *where, sl_int *scratch, sl_stats *stats) {
    const sl_options none = sli_options_with(&D->allocator);
    const sl_options *arrays_of = opt == NULL ? &none : opt;
    sli_block b = {NULL, 0};
    sli_fixed_arrays arrays;
    sl_status status = SL_OK;
    SLI_LAYOUT(&b, &D->allocator, status) {
        sli_fixed_arrays_layout(&arrays, &b, arrays_of, D->n_free);
    }
    if (status == SL_OK) {
        status = sli_fixed_arrays_fill(&arrays, D, arrays_of, where, scratch, stats);
        status = status == SL_OK ? sli_fixed_factor(D, A, &arrays, where, scratch, stats) : status;
        sli_free(&D->allocator, b.base);
    }
    return status;
}

SL_API sl_status sl_fixed_create(sl_fixed **out, const sl_csc *A, const sl_int *rows, sl_int count,
                                 const sl_options *opt, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_block b = {NULL, 0};
    sl_fixed draft, *D = NULL;
    sl_int *where = NULL, *scratch = NULL;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK ? sli_fixed_check(A, rows, count, opt, stats) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(draft);
    draft.allocator = sli_allocator(opt);
    draft.n = A->n_cols;
    draft.n_fixed = count;
    (void)sli_pattern_hash(A, &draft.pattern);
    sli_fixed_options(&draft, opt);
    status = sli_csc_triangle(A, sli_triangle_scan(A), &draft.triangle, opt, stats);
    SLI_LAYOUT(&b, &draft.allocator, status) {
        where = SLI_TAKE(&b, sl_int, draft.n);
        scratch = SLI_TAKE(&b, sl_int, (uint64_t)draft.n + 1);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    status = sli_fixed_new(&D, A, rows, &draft, where, stats);
    status = status == SL_OK ? sli_fixed_begin(D, A, opt, where, scratch, stats) : status;
    sli_free(&draft.allocator, b.base);
    if (status == SL_OK) {
        sli_fixed_done(D, started, stats);
        *out = D;
    } else {
        sl_fixed_free(D);
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_fixed_refactor(sl_fixed *D, const sl_csc *A, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_hash pattern;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(D == NULL                 ? "D is NULL"
                          : !sli_csc_has_pattern(A) ? "A is NULL, or has no size, p or i"
                                                    : NULL);
    if (status == SL_OK &&
        (A->n_rows != D->n || A->n_cols != D->n || !sli_pattern_hash(A, &pattern) ||
         !sli_hash_equals(pattern, D->pattern))) {
        status = sli_refuse(SL_ERR_OTHER_PATTERN, "A has another pattern than at the creation");
    }
    if (status == SL_OK) {
        status = sli_argument(sli_nnz(A) > 0 && A->x == NULL ? "A.x is NULL" : NULL);
    }
    status = status == SL_OK ? sli_fixed_check_values(D, A, stats) : status;
    if (status == SL_OK) {
        const sl_csc view = sl_matrix_view(D->M);
        sli_fixed_copy_values(D, A);
        status = sl_factor_refactor(D->F, &view, stats);
        status = sli_fixed_report(D, status, stats);
    }
    if (status == SL_OK) {
        sli_fixed_done(D, started, stats);
        D->is_stale = 0;
    } else if (D != NULL) {
        D->is_stale |= status == SL_ERR_PIVOT || status == SL_ERR_NOT_FINITE ||
                       status == SL_ERR_INACCURATE || status == SL_ERR_UNSUPPORTED;
    }
    return sli_report(stats, status);
}

#endif
