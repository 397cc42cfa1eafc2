/* submatrix.h: sl_factor_submatrix: the factor of A[R, R] from that of A */
#ifndef SLI_EDIT_SUBMATRIX_FACTOR_H
#define SLI_EDIT_SUBMATRIX_FACTOR_H

#include "../../public/submatrix.h"
#include "../factor/factor.h"
#include "../change/kept.h"
#include "submatrix_symbolic.h"

/* Refuses a kept pivot that was skipped as null. */
static sl_status sli_submatrix_check(const sl_factor *F, const sli_restriction *r,
                                     sli_failure *failure) {
    sl_int q, k;
    for (q = 0; q < r->n_kept && F->null.count > 0; q++) {
        const sl_int s = r->kept[q];
        for (k = F->S->super_first[s]; k < F->S->super_first[s + 1]; k++) {
            if (sli_is_skipped(F, k)) {
                return sli_fail(failure, SL_ERR_PIVOT, r->kept_new[q],
                                r->column_of[r->first_rank[q] + k - F->S->super_first[s]], -1, 0.0);
            }
        }
    }
    return SL_OK;
}

/* Names the numbers that G keeps of F. from, columns: by supernodes and by columns of G. */
static void sli_submatrix_keep(const sl_factor *G, sli_restriction *r, sl_int *from,
                               sl_int *columns) {
    sl_int q, k;
    SLI_NONE(from, G->S->n_supers);
    for (q = 0; q < r->n_kept; q++) {
        const sl_int t = r->kept_new[q];
        from[t] = r->kept[q];
        r->copied += G->S->panel_begin[t + 1] - G->S->panel_begin[t];
    }
    for (k = 0; k < r->R.count; k++) {
        columns[r->column_of[k]] = r->R.columns[k];
    }
}

static sl_status sli_submatrix_numbers(sl_factor *G, const sl_factor *F, sli_restriction *r,
                                       sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source source = sli_source_matrix(&r->B);
    sli_kept kept;
    sli_failure failure;
    sli_block b = {NULL, 0}, room = {NULL, 0};
    sl_int *from = NULL, *columns = NULL;
    sl_status status = SL_OK;
    if (r->n_kept > 0) {
        SLI_LAYOUT(&b, &G->allocator, status) {
            from = SLI_TAKE(&b, sl_int, G->S->n_supers);
            columns = SLI_TAKE(&b, sl_int, G->S->n);
        }
    }
    kept = sli_kept_of(F, from, columns, 1);
    if (status == SL_OK && r->n_kept > 0) {
        sli_submatrix_keep(G, r, from, columns);
        status = sli_kept_room(&kept, G, &room);
    }
    if (status == SL_OK) {
        SLI_CLEAR(failure);
        sli_factor_begin(G);
        G->identity = sli_hash_words(F->identity, &G->S->identity, 2);
        G->work.copied = r->n_kept > 0 ? &kept.copied : NULL;
        G->history.drift = r->n_kept > 0 ? F->history.drift : 0.0;
        G->history.marks = NULL; /* no later factorization compares its entries */
        if (sli_submatrix_check(F, r, &failure) == SL_OK) {
            (void)sli_factor_eliminate(G, &source, &failure);
        } else {
            SLI_ZERO(G->D, G->S->n); /* the report counts pivots */
        }
        G->work.copied = NULL;
        status = sli_factor_done(G, &source, &failure, started, stats);
    }
    sli_free(&G->allocator, room.base);
    sli_free(&G->allocator, b.base);
    return status;
}

/* The options that give a factor over R the rules of F. signs: count of scratch. */
static sl_options sli_submatrix_options(const sl_factor *F, const sli_restriction *r,
                                        const sl_allocator *a, sl_int *signs) {
    sl_options opt = sli_options_with(a);
    sl_int k;
    opt.null_tolerance = sli_tolerance_option(F);
    opt.regularization = F->rule.regularization;
    opt.pivots = F->limits.is_definite ? SL_PIVOTS_POSITIVE : SL_PIVOTS_NONZERO;
    opt.growth_limit = sli_limit_option(F->limits.growth);
    opt.error_limit = sli_limit_option(F->limits.error);
    if (opt.regularization != 0.0 && F->rule.signs != NULL) {
        for (k = 0; k < r->R.count; k++) {
            signs[r->R.row_of[k]] = F->rule.signs[r->R.columns[k]];
        }
        opt.signs = signs;
    }
    return opt;
}

/* Creates the factor over its analysis. */
static sl_status sli_submatrix_factor(sl_factor **out, const sl_symbolic *S, const sl_factor *F,
                                      sli_restriction *r, const sl_options *rules,
                                      sl_stats *stats) {
    sl_options opt = *rules;
    sl_factor *G = NULL;
    sl_status status;
    opt.method = r->n_kept > 0 ? SL_METHOD_SUPERNODAL : SL_METHOD_AUTO;
    opt.storage = F->type->storage;
    if (F->type->keeps != NULL && !F->type->keeps(r->rows, r->R.count, S)) {
        opt.storage = SL_STORAGE_DOUBLE; /* A[R, R] is not complex, or not its order */
    }
    status = sli_factor_new(&G, S, &opt, F->kernels, stats);
    status = status == SL_OK ? sli_submatrix_numbers(G, F, r, stats) : status;
    if (status == SL_OK) {
        *out = G;
    } else {
        sl_factor_free(G);
    }
    return status;
}

/* Ends the creation of both objects. There is no matrix that they could be refactored with: the
 * numbers stay, and what a refactorization needs is released. */
static void sli_submatrix_done(sl_symbolic *S, sl_factor *G) {
    sl_factor counted = *G;
    sli_block b = {NULL, 0};
    sli_free(&G->allocator, G->scratch);
    G->scratch = NULL;
    (void)sli_take(&b, 1, sizeof(sl_factor));
    sli_factor_layout(&counted, &b, 0);
    G->stats.factor.bytes = b.used;
    G->is_immutable = 1;
    S->is_partial = 1;
    S->nnz_input = -1;
    SLI_ZERO(S->scatter_begin, S->n_supers + 1);
}

/* Reports an error, which F has in rows and columns of A[R, R], in those of A. */
static sl_status sli_submatrix_report(const sli_restriction *r, sl_status status, sl_stats *stats) {
    sl_error found = sli_found(stats, status);
    if (status == SL_ERR_NOT_FINITE && found.column != -1) { /* an entry of A or B */
        if (r->B_values != NULL) {
            found.column = r->rows[found.column];
        }
    } else if (found.row >= 0 && (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE ||
                                  status == SL_ERR_NOT_FINITE)) {
        found.row = r->rows[found.row];
    }
    return sli_fail_as(stats, status, &found);
}

SLI_COLD static sl_status sli_submatrix_run(sl_symbolic **S, sl_factor **G, const sl_factor *F,
                                            sli_restriction *r, const sl_allocator *a,
                                            sl_stats *stats) {
    const double started = sli_seconds();
    const sl_options rules = sli_submatrix_options(F, r, a, (sl_int *)(void *)r->scratch);
    sl_stats found;
    sl_status status;
    SLI_CLEAR(found);
    found.symbolic.triangle = F->S->stats.symbolic.triangle;
    status = sli_restriction_list(r, a, stats);
    if (status == SL_OK) {
        status =
            r->n_kept > 0 ? sli_joint_make(S, r, a, &found) : sli_restriction_make(S, r, a, &found);
    }
    sli_restriction_done(r, a);
    if (status == SL_OK) {
        (*S)->stats.symbolic.seconds_analyze = sli_seconds() - started;
        status = sli_submatrix_factor(G, *S, F, r, &rules, stats);
    }
    return status;
}

/* Checks F and what can be checked of A and rows before they are read. */
static sl_status sli_submatrix_arguments(const sl_factor *F, const sl_csc *A, const sl_int *rows,
                                         sl_int count, const sl_options *opt) {
    sl_status status =
        sli_argument(F == NULL                   ? "F is NULL"
                     : A == NULL                 ? "A is NULL"
                     : count < 0                 ? "count is below 0"
                     : count > 0 && rows == NULL ? "rows is NULL"
                                                 : sli_options_wrong(opt, SLI_READS_NOTHING));
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status == SL_OK && (F->E != NULL || F->S->nnz_input < 0)) {
        status = sli_refuse(SL_ERR_UNSUPPORTED, F->E != NULL ? "the restriction of 2x2 pivots"
                                                             : "the restriction of a restriction");
    }
    return status == SL_OK ? sli_pattern_check_size(F->S, A, 1) : status;
}

SL_API sl_status sl_factor_submatrix(sl_symbolic **S, sl_factor **G, const sl_factor *F,
                                     const sl_csc *A, const sl_int *rows, sl_int count,
                                     const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_restriction r;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(S == NULL ? "S is NULL" : G == NULL ? "G is NULL" : NULL);
    if (status == SL_OK) {
        *S = NULL;
        *G = NULL;
        status = sli_submatrix_arguments(F, A, rows, count, opt);
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(r);
    r.S = F->S;
    r.A = A;
    r.may_keep =
        F->type->storage == SL_STORAGE_DOUBLE && F->null.vectors <= 1 && !sli_updates_exceed(F->S);
    r.rows = rows;
    r.R.count = count;
    status = sli_restriction_begin(&r, &a, stats);
    if (status == SL_OK) {
        status = sli_submatrix_run(S, G, F, &r, &a, stats);
        if (status != SL_OK) {
            status = sli_submatrix_report(&r, status, stats);
        }
    }
    if (status == SL_OK) {
        sli_submatrix_done(*S, *G);
    } else {
        sl_symbolic_free(*S);
        *S = NULL;
    }
    if (status == SL_OK && stats != NULL) {
        sl_submatrix_info *info = &stats->submatrix;
        stats->factor.bytes = (*G)->stats.factor.bytes;
        info->is_anew = r.n_kept == 0 && count > 0;
        info->kept = count - r.n_fresh;
        info->computed = count - info->kept;
        info->entries = r.copied;
        info->seconds = sli_seconds() - started;
    }
    sli_restriction_free(&r, &a);
    return sli_report(stats, status);
}

#endif
