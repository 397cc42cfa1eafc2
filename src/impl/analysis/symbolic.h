/* symbolic.h: the analysis, from the pattern of A to the places of L */
#ifndef SLI_SYMBOLIC_H
#define SLI_SYMBOLIC_H

#include "counts.h"
#include "fronts.h"
#include "graph.h"
#include "order.h"
#include "structure.h"
#include "supernodes.h"

/* What the analysis needs only while it runs. Rows are numbered three times: as in A, in the order
 * that was asked for (rows, columns), and in the postorder of the supernodes that comes of it
 * (everything else). */
typedef struct sli_analysis {
    sl_int n;
    sli_half rows, columns;
    sli_groups groups;
    sl_int *perm;                       /* n: the order asked for */
    sl_int *old_of, *new_of;            /* n: from the last numbering to the one before, and back */
    sl_int *parent, *counts, *super_of; /* n each */
    sl_int *scratch;                    /* 5n */
    uint64_t *list;                     /* 2n */
    sli_nest nest;                      /* n each: the tree of separators, by rows of A */
} sli_analysis;

static void sli_analysis_layout(sli_analysis *w, sli_block *b, sl_int rows, sl_int nnz) {
    const uint64_t n = (uint64_t)rows; /* 5 n may pass 2^32 */
    w->n = rows;
    w->rows.begin = SLI_TAKE(b, sl_int, n + 1);
    w->rows.to = SLI_TAKE(b, sl_int, nnz);
    w->rows.from = SLI_TAKE(b, sl_int, nnz);
    w->columns.begin = SLI_TAKE(b, sl_int, n + 1);
    w->columns.to = SLI_TAKE(b, sl_int, nnz);
    w->perm = SLI_TAKE(b, sl_int, n);
    w->old_of = SLI_TAKE(b, sl_int, n);
    w->new_of = SLI_TAKE(b, sl_int, n);
    w->parent = SLI_TAKE(b, sl_int, n);
    w->counts = SLI_TAKE(b, sl_int, n);
    w->super_of = SLI_TAKE(b, sl_int, n);
    w->scratch = SLI_TAKE(b, sl_int, 5 * n);
    w->groups.first = SLI_TAKE(b, sl_int, n + 1);
    w->groups.parent = SLI_TAKE(b, sl_int, n);
    w->groups.width = SLI_TAKE(b, sl_int, n);
    w->groups.below = SLI_TAKE(b, sl_int, n);
    w->groups.zeros = SLI_TAKE(b, double, n);
    w->groups.group = SLI_TAKE(b, sl_int, n);
    w->list = SLI_TAKE(b, uint64_t, 2 * n);
    w->nest.of = SLI_TAKE(b, sl_int, n);
    w->nest.parent = SLI_TAKE(b, sl_int, n + 1);
}

static void sli_symbolic_layout(sl_symbolic *S, sli_block *b, sl_off rows, sl_off entries) {
    const size_t n = (size_t)S->n, supers = (size_t)S->n_supers;
    (void)sli_take(b, 1, sizeof(sl_symbolic));
    S->perm = SLI_TAKE(b, sl_int, n);
    S->iperm = SLI_TAKE(b, sl_int, n);
    S->parent = SLI_TAKE(b, sl_int, n);
    S->counts = SLI_TAKE(b, sl_int, n);
    S->super_of = SLI_TAKE(b, sl_int, n);
    S->super_first = SLI_TAKE(b, sl_int, supers + 1);
    S->super_parent = SLI_TAKE(b, sl_int, supers);
    S->rows_begin = SLI_TAKE(b, sl_off, supers + 1);
    S->rows = SLI_TAKE(b, sl_int, rows);
    S->panel_begin = SLI_TAKE(b, sl_off, supers + 1);
    S->steps = SLI_TAKE(b, sli_step, supers);
    S->descendant = SLI_TAKE(b, sl_int, supers);
    S->places = SLI_TAKE(b, sl_int, rows);
    S->map_begin = SLI_TAKE(b, sl_off, supers + 1);
    S->map_from = SLI_TAKE(b, sl_int, entries);
    S->map_to = SLI_TAKE(b, sl_off, entries);
    S->part_of = SLI_TAKE(b, sl_int, S->n_parts > 0 ? n : 0);
    S->part_parent = SLI_TAKE(b, sl_int, S->n_parts);
    S->part_level = SLI_TAKE(b, sl_int, S->n_parts);
}

/* Tree, counts and supernodes in their final numbering. */
static void sli_analyse_tree(sli_analysis *w, const sl_options *opt, sl_stats *stats) {
    const sl_int n = w->n;
    sl_int *order = w->scratch, *more = w->scratch + n;
    sl_int k;
    sli_order_natural(n, w->old_of);
    sli_etree(n, &w->rows, w->parent, order);
    sli_postorder(w->parent, n, order, more, more + n);
    sli_relabel(order, n, w->old_of, w->new_of, w->parent, more);
    sli_counts(n, &w->columns, w->old_of, w->new_of, w->parent, w->counts, w->scratch);
    sli_fundamental(n, w->parent, w->counts, more, w->super_of, &w->groups);
    stats->supernodes_fundamental = w->groups.count;
    if (opt == NULL || opt->relaxation != SL_RELAXATION_NONE) {
        sli_relax(&w->groups, order, more, w->list, w->list + n);
    }
    order = (sl_int *)(void *)w->list; /* renumbering needs all of scratch */
    sli_renumber_groups(&w->groups, n, order, w->super_of, w->scratch);
    for (k = 0; k < n; k++) {
        w->scratch[k] = w->counts[order[k]];
    }
    if (n > 0) {
        memcpy(w->counts, w->scratch, (size_t)n * sizeof(sl_int));
    }
    sli_relabel(order, n, w->old_of, w->new_of, w->parent, w->scratch);
}

/* The figures that a user asks about. depth: n of scratch. */
static void sli_analyse_stats(const sl_symbolic *S, sl_int *depth, sl_stats *stats) {
    sl_int k;
    stats->n = S->n;
    stats->supernodes = S->n_supers;
    stats->nnz_panels = S->panel_begin[S->n_supers];
    for (k = S->n - 1; k >= 0; k--) {
        const double count = S->counts[k];
        depth[k] = S->parent[k] == -1 ? 1 : depth[S->parent[k]] + 1;
        stats->tree_height = sli_max(stats->tree_height, depth[k]);
        stats->components += S->parent[k] == -1;
        stats->nnz_l += S->counts[k];
        stats->flops += count * count;
    }
}

/* The tree of separators, whose nodes stand below their parents, by columns of L. */
static void sli_fill_parts(sl_symbolic *S, const sli_nest *nest) {
    sl_int k;
    for (k = 0; k < S->n && S->n_parts > 0; k++) {
        S->part_of[k] = nest->of[S->perm[k]];
    }
    for (k = S->n_parts - 1; k >= 0; k--) {
        S->part_parent[k] = nest->parent[k];
        S->part_level[k] = nest->parent[k] == -1 ? 0 : S->part_level[nest->parent[k]] + 1;
    }
}

/* Copies the tree out of the workspace and fills everything that hangs on it. */
static void sli_symbolic_fill(sl_symbolic *S, const sli_analysis *w, sl_stats *stats) {
    const size_t bytes = (size_t)S->n * sizeof(sl_int);
    sl_int s, k;
    for (k = 0; k < S->n; k++) {
        S->perm[k] = w->perm[w->old_of[k]];
        S->iperm[S->perm[k]] = k;
    }
    memcpy(S->parent, w->parent, bytes);
    memcpy(S->counts, w->counts, bytes);
    memcpy(S->super_of, w->super_of, bytes);
    memcpy(S->super_first, w->groups.first, ((size_t)S->n_supers + 1) * sizeof(sl_int));
    memcpy(S->super_parent, w->groups.parent, (size_t)S->n_supers * sizeof(sl_int));
    S->rows_begin[0] = 0;
    S->panel_begin[0] = 0;
    for (s = 0; s < S->n_supers; s++) {
        S->rows_begin[s + 1] = S->rows_begin[s] + w->groups.below[s];
        S->panel_begin[s + 1] =
            S->panel_begin[s] + sli_panel_size(w->groups.width[s], w->groups.below[s]);
    }
    /* list has 4n words of 4 bytes: the ends of the rows in one half, the marks in the other */
    sli_count_map(S, &w->columns, w->old_of);
    sli_fill_structure(S, &w->rows, w->old_of, w->new_of, (sl_off *)(void *)w->list,
                       (sl_int *)(void *)(w->list + S->n));
    sli_fill_steps(S);
    sli_fill_descendants(S);
    sli_fill_places(S, w->scratch);
    sli_fill_parts(S, &w->nest);
    sli_analyse_stats(S, w->scratch, stats);
}

static sl_status sli_symbolic_make(sl_symbolic **out, const sl_csc *A, const sl_options *opt,
                                   sli_analysis *w, const sl_allocator *a, sl_stats *stats) {
    double started;
    sl_symbolic draft;
    sli_block b = {NULL, 0, 0};
    sl_off rows = 0;
    sl_int s;
    int pass;
    sl_status status;
    started = sli_seconds();
    status = sli_order(A, stats->triangle, opt, w->perm, w->scratch, &w->nest, a, stats);
    stats->seconds_order = sli_seconds() - started;
    if (status != SL_OK) {
        return status;
    }
    started = sli_seconds();
    for (s = 0; s < w->n; s++) {
        w->scratch[w->perm[s]] = s;
    }
    sli_halves_fill(A, stats->triangle, w->scratch, &w->rows, &w->columns);
    stats->nnz_a = w->rows.begin[w->n];
    stats->seconds_tree = -sli_seconds();
    sli_analyse_tree(w, opt, stats);
    stats->seconds_tree += sli_seconds();
    memset(&draft, 0, sizeof draft);
    draft.allocator = *a;
    draft.n = A->n_cols;
    draft.n_supers = w->groups.count;
    draft.n_parts = w->nest.count;
    draft.nnz_input = sli_nnz(A);
    draft.fingerprint = sli_fingerprint(A);
    for (s = 0; s < w->groups.count; s++) {
        rows += w->groups.below[s];
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_symbolic_layout(&draft, &b, rows, stats->nnz_a);
        stats->bytes_symbolic = b.used;
        status = pass == 0 ? sli_block_alloc(&b, a) : SL_OK;
    }
    if (status != SL_OK) {
        return status;
    }
    stats->seconds_structure = -sli_seconds();
    sli_symbolic_fill(&draft, w, stats);
    stats->seconds_structure += sli_seconds();
    stats->seconds_analyse += sli_seconds() - started;
    draft.stats = *stats;
    *out = (sl_symbolic *)(void *)b.base;
    **out = draft;
    return SL_OK;
}

/* Copies the symbolic group from one struct to the other. */
static void sli_symbolic_stats_copy(const sl_stats *from, sl_stats *to) {
    to->n = from->n;
    to->triangle = from->triangle;
    to->nnz_a = from->nnz_a;
    to->nnz_l = from->nnz_l;
    to->nnz_panels = from->nnz_panels;
    to->flops = from->flops;
    to->supernodes = from->supernodes;
    to->supernodes_fundamental = from->supernodes_fundamental;
    to->tree_height = from->tree_height;
    to->components = from->components;
    to->seconds_order = from->seconds_order;
    to->seconds_analyse = from->seconds_analyse;
    to->seconds_tree = from->seconds_tree;
    to->seconds_structure = from->seconds_structure;
    to->bytes_symbolic = from->bytes_symbolic;
}

SL_API sl_status sl_symbolic_create(sl_symbolic **out, const sl_csc *A, const sl_options *opt,
                                    sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const double started = sli_seconds();
    sli_analysis w;
    sli_block b = {NULL, 0, 0};
    sl_stats found;
    sl_status status;
    int pass;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    status = sl_csc_check(A, stats);
    if (status != SL_OK) {
        return status;
    }
    if (A->n_rows != A->n_cols || !sli_allocator_is_whole(opt) ||
        (opt != NULL && opt->relaxation != SL_RELAXATION_DEFAULT &&
         opt->relaxation != SL_RELAXATION_NONE)) {
        return SL_ERR_ARGUMENT;
    }
    memset(&w, 0, sizeof w);
    memset(&found, 0, sizeof found);
    sli_stats_clear_error(&found);
    status = sli_csc_triangle(A, &found.triangle, opt, stats);
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_analysis_layout(&w, &b, A->n_cols, sli_nnz(A));
        status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
    }
    if (status == SL_OK) {
        found.seconds_analyse = sli_seconds() - started;
        status = sli_symbolic_make(out, A, opt, &w, &a, &found);
        if (stats != NULL && status == SL_OK) {
            sli_symbolic_stats_copy(&found, stats);
        } else if (stats != NULL) {
            stats->error_row = found.error_row;
        }
        sli_free(&a, b.base);
    }
    return status;
}

SL_API void sl_symbolic_free(sl_symbolic *S) {
    if (S != NULL) {
        const sl_allocator a = S->allocator;
        sli_free(&a, S);
    }
}

SL_API void sl_symbolic_stats(const sl_symbolic *S, sl_stats *stats) {
    sli_stats_clear_error(stats);
    if (S != NULL && stats != NULL) {
        sli_symbolic_stats_copy(&S->stats, stats);
    }
}

SL_API sl_symbolic_view_t sl_symbolic_view(const sl_symbolic *S) {
    sl_symbolic_view_t v;
    memset(&v, 0, sizeof v);
    if (S != NULL) {
        v.n = S->n;
        v.n_supers = S->n_supers;
        v.perm = S->perm;
        v.iperm = S->iperm;
        v.parent = S->parent;
        v.counts = S->counts;
        v.super_first = S->super_first;
        v.super_of = S->super_of;
        v.super_parent = S->super_parent;
        v.rows_begin = S->rows_begin;
        v.rows = S->rows;
        v.panel_begin = S->panel_begin;
        v.n_parts = S->n_parts;
        v.part_of = S->n_parts > 0 ? S->part_of : NULL;
        v.part_parent = S->n_parts > 0 ? S->part_parent : NULL;
        v.part_level = S->n_parts > 0 ? S->part_level : NULL;
    }
    return v;
}

#endif
