/* edit.h: sl_symbolic_edit: the analysis of an edited matrix from that of the matrix before */
#ifndef SLI_EDIT_H
#define SLI_EDIT_H

#include "../../public/edit.h"
#include "../analysis/same_pattern.h"
#include "edit_join.h"

/* Beyond this share of active rows an order of its own is as fast. */
#define SLI_EDIT_MOST_ACTIVE 0.25

/* A new order is made if L has so many times the entries that are expected of one. */
#define SLI_EDIT_DUE 1.1

/* Checks what can be checked before the matrices are read. */
static sl_status sli_edit_arguments(const sl_symbolic *S, const sl_csc *A, const sl_csc *B,
                                    const sl_int *new_of, const sl_options *opt) {
    sl_status status = sli_argument(S == NULL                    ? "S is NULL"
                                    : A == NULL                  ? "A is NULL"
                                    : B == NULL                  ? "B is NULL"
                                    : S->n > 0 && new_of == NULL ? "new_of is NULL"
                                                                 : sli_symbolic_options_wrong(opt));
    if (status == SL_OK && (S->is_pivoted || S->nnz_input < 0)) {
        status = sli_refuse(SL_ERR_UNSUPPORTED, S->is_pivoted
                                                    ? "an analysis of sl_symbolic_create_pivoted"
                                                    : "an analysis of sl_factor_submatrix");
    }
    return status == SL_OK ? sli_pattern_check(S, A, 0) : status;
}

/* Finds the rows whose columns are analyzed again and their order. *is_local := 0 if all rows
 * should get a new order. */
static sl_status sli_edit_find(sli_edit *e, int *is_local, const sl_allocator *a, sl_stats *stats) {
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int j;
    int layer;
    *is_local = 0;
    SLI_LAYOUT(&b, a, status) {
        sli_edit_layout(e, &b);
    }
    e->blocks[0] = b.base;
    status = status == SL_OK ? sli_edit_rows(e, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_edit_match(e);
    for (j = 0; j < e->n; j++) {
        e->n_changed += e->is_active[j];
    }
    if (e->n_changed > SLI_EDIT_MOST_ACTIVE * e->n) {
        return SL_OK;
    }
    for (layer = 1; layer < SLI_EDIT_LAYERS; layer++) {
        sli_edit_grow(e, layer);
    }
    sli_edit_list(e);
    status = sli_edit_neighbors(e, a);
    if (status != SL_OK || !sli_edit_place_all(e)) {
        return status;
    }
    sli_edit_weigh(e);
    status = sli_edit_separate(e, a);
    if (status != SL_OK) {
        return status;
    }
    sli_edit_mark(e);
    sli_edit_collect(e);
    *is_local = 1;
    return sli_edit_order(e, a);
}

/* Analyzes B in the order that was found: only its fresh columns again. */
static sl_status sli_edit_analyze(sl_symbolic **out, sli_edit *e, const sl_options *opt,
                                  const sl_allocator *a, double started, sl_stats *stats) {
    const double ordered = sli_seconds();
    sli_edit_join j;
    sl_stats found;
    sl_status status;
    SLI_CLEAR(j);
    SLI_CLEAR(found);
    j.e = e;
    found.symbolic.triangle = e->triangle;
    status = sli_edit_analyze_fresh(e, &j.r, opt == NULL ? SL_RELAXATION_DEFAULT : opt->relaxation,
                                    a, &found);
    found.symbolic.seconds_tree = sli_seconds() - ordered;
    if (status == SL_OK) {
        status = sli_edit_join_make(out, &j, a, &found);
    }
    if (status == SL_OK) {
        sl_symbolic_info *info = &(*out)->stats.symbolic;
        info->seconds_order = ordered - started;
        info->seconds_analyze = sli_seconds() - ordered;
        info->seconds_structure = info->seconds_analyze - info->seconds_tree;
        if (stats != NULL) {
            stats->symbolic = *info;
        }
    }
    sli_restriction_free(&j.r, a);
    sli_free(a, j.block);
    return status;
}

/* Compares the entries of L with those of the last new order. */
static void sli_edit_count(sl_symbolic *T, const sli_edit *e, int is_anew, double started,
                           sl_edit_info *info) {
    const sl_symbolic *S = e->S;
    const sl_symbolic_info *now = &T->stats.symbolic, *before = &S->stats.symbolic;
    memset(info, 0, sizeof *info);
    info->is_anew = is_anew;
    info->changed = e->n_changed;
    info->moved = is_anew ? 0 : e->moved;
    info->reordered = is_anew ? e->n : e->n_grouped;
    info->computed = is_anew ? e->n : e->n_fresh;
    info->growth = 1.0;
    if (!is_anew) {
        T->ordered_l = S->ordered_l > 0 ? S->ordered_l : before->nnz_l;
        T->ordered_a = S->ordered_a > 0 ? S->ordered_a : before->nnz_a;
    }
    if (!is_anew && T->ordered_a > 0 && now->nnz_a > 0) {
        info->growth = ((double)now->nnz_l / (double)T->ordered_l) /
                       ((double)now->nnz_a / (double)T->ordered_a);
    }
    info->is_due = info->growth > SLI_EDIT_DUE;
    info->seconds = sli_seconds() - started;
}

SL_API sl_status sl_symbolic_edit(sl_symbolic **out, const sl_symbolic *S, const sl_csc *A,
                                  const sl_csc *B, const sl_int *new_of, const sl_options *opt,
                                  sl_stats *stats) {
    const double started = sli_seconds();
    const sl_allocator a = sli_allocator(opt);
    sli_edit e;
    sl_edit_info info;
    sl_status status;
    int is_local = 0, k;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK ? sli_edit_arguments(S, A, B, new_of, opt) : status;
    status = status == SL_OK ? sl_csc_check(B, stats) : status;
    if (status == SL_OK) {
        status = sli_argument(B->n_rows != B->n_cols ? "B is not square"
                                                     : sli_order_options_wrong(opt, B->n_cols));
    }
    SLI_CLEAR(e);
    if (status == SL_OK) {
        e.S = S;
        e.A = A;
        e.B = B;
        e.new_of = new_of;
        e.n = B->n_cols;
        status = sli_csc_triangle(B, sli_triangle_scan(B), &e.triangle, opt, stats);
    }
    status = status == SL_OK ? sli_edit_find(&e, &is_local, &a, stats) : status;
    if (status == SL_OK) {
        status = is_local ? sli_edit_analyze(out, &e, opt, &a, started, stats)
                          : sl_symbolic_create(out, B, opt, stats);
    }
    if (status == SL_OK) {
        sli_edit_count(*out, &e, !is_local, started, &info);
        if (stats != NULL) {
            stats->edit = info;
        }
    }
    for (k = 0; k < 3; k++) {
        sli_free(&a, e.blocks[k]);
    }
    return sli_report(stats, status);
}

#endif
