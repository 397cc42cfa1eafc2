/* symbolic_build.h: from an order of the rows to the analysis: tree, supernodes, all arrays */
#ifndef SLI_ANALYSIS_SYMBOLIC_BUILD_H
#define SLI_ANALYSIS_SYMBOLIC_BUILD_H

#include "structure.h"
#include "supernode_order.h"

/* What the ordering fills comes first. Then follows memory that the ordering may use until it is
 * done: a graph and a quotient graph need some 64 n + 18 nnz bytes. */
SLI_NOINLINE static void sli_analysis_layout(sli_analysis *w, sli_block *b, sl_int rows,
                                             sl_int nnz) {
    const uint64_t n = (uint64_t)rows; /* 5 n may exceed 2^32 */
    size_t begin, end;
    w->n = rows;
    w->column = SLI_CUT(b, sl_int, sli_max(nnz, rows + 1));
    w->perm = SLI_CUT(b, sl_int, rows);
    w->scratch = SLI_CUT(b, sl_int, 5 * n);
    w->septree.node_of = SLI_CUT(b, sl_int, rows);
    w->septree.parent = SLI_CUT(b, sl_int, rows + 1);
    w->ordered = b->used;
    w->columns.begin = SLI_CUT(b, sl_int, rows + 1);
    w->columns.entry = SLI_CUT(b, sl_int, SLI_ENTRY * (uint64_t)nnz);
    w->old_of = SLI_CUT(b, sl_int, rows);
    w->new_of = SLI_CUT(b, sl_int, rows);
    w->parent = SLI_CUT(b, sl_int, rows); /* sli_pattern_fill uses 7 n from here on */
    w->choice.parent = w->parent;         /* the ordering of a forest needs none of this memory */
    w->counts = SLI_CUT(b, sl_int, rows);
    w->super_of = SLI_CUT(b, sl_int, rows);
    w->amalgamation.first = SLI_CUT(b, sl_int, rows + 1);
    w->amalgamation.parent = SLI_CUT(b, sl_int, rows);
    w->amalgamation.width = SLI_CUT(b, sl_int, rows);
    w->amalgamation.below = SLI_CUT(b, sl_int, rows);
    begin = b->used; /* two phases use the same memory in turn */
    w->room = SLI_CUT(b, sl_int, SLI_ANALYSIS_ROOM(n) * (uint64_t)sli_max(w->workers, 1));
    end = b->used;
    b->used = begin;
    w->amalgamation.zeros = SLI_CUT(b, sl_off, rows);
    w->amalgamation.cost = SLI_CUT(b, sl_off, rows);
    w->amalgamation.merged_into = SLI_CUT(b, sl_int, rows);
    w->amalgamation.apart = SLI_CUT(b, sl_int, rows);
    w->list = SLI_CUT(b, uint64_t, 2 * n);
    b->used = b->used > end ? b->used : end;
    if (w->pairs != NULL) {
        w->amalgamation.is_tied = SLI_TAKE(b, unsigned char, n);
        w->is_first = SLI_TAKE(b, unsigned char, n);
        w->earlier = SLI_TAKE(b, sl_int, n);
    }
    w->spare = SLI_CUT(b, sl_int, 3 * (uint64_t)nnz + 512);
}

/* All arrays. A saved analysis has them in this order (save/format.h). */
static void sli_symbolic_layout(sl_symbolic *S, sli_block *b, sl_off rows, sl_off entries) {
    const sl_int n = S->n, supers = S->n_supers;
    S->perm = SLI_CUT(b, sl_int, n);
    S->iperm = SLI_CUT(b, sl_int, n);
    S->parent = SLI_CUT(b, sl_int, n);
    S->counts = SLI_CUT(b, sl_int, n);
    S->super_of = SLI_CUT(b, sl_int, n);
    S->super_first = SLI_CUT(b, sl_int, supers + 1);
    S->super_parent = SLI_CUT(b, sl_int, supers);
    S->rows_begin = SLI_CUT(b, sl_off, supers + 1);
    S->rows = SLI_CUT(b, sl_int, rows);
    S->panel_begin = SLI_CUT(b, sl_off, supers + 1);
    S->steps = SLI_CUT(b, sli_step, supers);
    S->first_descendant = SLI_CUT(b, sl_int, supers);
    S->pairs = SLI_CUT(b, unsigned char, S->n_pairs > 0 ? n : 0);
    S->relative = SLI_CUT(b, sl_int, rows);
    S->scatter_begin = SLI_CUT(b, sl_off, supers + 1);
    S->scatter_from = SLI_CUT(b, sl_int, entries);
    S->scatter_to = SLI_CUT(b, sl_off, entries);
    S->node_of = SLI_CUT(b, sl_int, S->n_nodes > 0 ? n : 0);
    S->node_parent = SLI_CUT(b, sl_int, S->n_nodes);
    S->node_level = SLI_CUT(b, sl_int, S->n_nodes);
}

/* Renumbers the tree and the counts: order[k] = the old number of column k. */
static void sli_analysis_reorder(sli_analysis *w, const sl_int *order) {
    sl_int k = 0;
    while (k < w->n && order[k] == k) {
        k++;
    }
    if (k == w->n) {
        return;
    }
    for (k = 0; k < w->n; k++) {
        w->scratch[k] = w->counts[order[k]];
    }
    SLI_COPY(w->counts, w->scratch, w->n);
    sli_relabel(order, w->n, w->old_of, w->new_of, w->parent, w->scratch);
}

/* Marks the supernodes whose last column is the first of a 2x2 pivot. */
static void sli_analysis_tie(sli_analysis *w) {
    sl_int s;
    for (s = 0; s < w->amalgamation.count; s++) {
        w->amalgamation.is_tied[s] = w->pairs[w->old_of[w->amalgamation.first[s + 1] - 1]];
    }
}

/* Splits supernodes so that each 2x2 pivot is in one tile. Its two columns have the same rows. */
static void sli_analysis_split(sli_analysis *w, sl_int *order) {
    sl_int k;
    for (k = 0; k < w->n; k++) {
        w->is_first[k] = w->pairs[w->old_of[k]];
        SLI_ASSERT(!w->is_first[k] || w->old_of[k + 1] == w->old_of[k] + 1);
    }
    for (k = w->n - 1; k >= 0; k--) {
        w->counts[k] = w->is_first[k] ? w->counts[k + 1] + 1 : w->counts[k];
    }
    if (sli_split_pairs(&w->amalgamation, w->parent, w->is_first, w->earlier, order, w->scratch)) {
        sli_analysis_reorder(w, order);
        for (k = 0; k < w->n; k++) {
            w->is_first[k] = w->pairs[w->old_of[k]];
        }
    }
}

/* Finds tree and counts. Returns whether the columns need no postorder. */
static int sli_analyze_columns(sli_analysis *w) {
    sl_int *sequence = (sl_int *)(void *)w->list;
    sli_tree_result result;
    sli_tree_job job;
    job.n = w->n;
    job.columns = &w->columns;
    job.parent = w->parent;
    job.counts = w->counts;
    job.list = w->spare;
    job.scratch = w->scratch;
    job.sequence = NULL;
    job.keeps_order = w->keeps_order;
    result = sli_tree_and_counts(&job);
    if (result == SLI_TREE_TOO_LONG) {
        sli_tree_sequence(&job, sequence, w->list + w->n);
        job.sequence = sequence;
        result = sli_tree_and_counts(&job);
    }
    return result == SLI_TREE_IN_ORDER;
}

/* Item 0 finds the supernodes and renumbers the columns to their final order. Item 1 needs neither,
 * but memory that the tree does not need any more. */
static void sli_analyze_item(void *data, sl_int item, sl_int worker) {
    sli_analysis *w = (sli_analysis *)data;
    const sl_options *opt = w->opt;
    const sl_int n = w->n;
    sl_int *order = (sl_int *)(void *)w->list; /* the numbering needs all of scratch */
    sl_int *child = w->scratch, *more = w->scratch + n, *sequence = NULL, k;
    (void)worker;
    if (item == 1) {
        if (w->team != NULL && w->team->workers == 1 && w->columns.begin[n] / 5 < n) {
            w->spare = (sl_int *)(void *)w->amalgamation.zeros; /* has been used: item 0 is done */
        }
        sli_structure_sort(w);
        return;
    }
    sli_order_natural(n, w->old_of);
    sli_order_natural(n, w->new_of);
    for (k = 0; k < n && w->choice.has_tree; k++) {
        w->counts[k] = 1 + (w->parent[k] != -1);
    }
    if (w->choice.has_tree) {
        sli_find_other_children(n, w->parent, more);
    } else if (!w->is_in_order) { /* otherwise more is filled */
        sli_postorder(w->parent, NULL, n, order, child, more);
        sli_analysis_reorder(w, order);
        sequence = w->keeps_order ? w->new_of : NULL;
        sli_find_other_children(n, w->parent, more);
    }
    w->amalgamation.relaxes = opt == NULL || opt->relaxation != SL_RELAXATION_NONE;
    w->amalgamation.n = n;
    w->amalgamation.super_of = w->super_of;
    sli_fundamental(&w->amalgamation, w->parent, w->counts, more);
    w->found->symbolic.supernodes_fundamental = w->amalgamation.count;
    w->amalgamation.is_for_one_factor = opt != NULL && opt->purpose == SL_PURPOSE_ONE_FACTOR;
    if (w->pairs != NULL) {
        sli_analysis_tie(w);
    }
    w->amalgamation.merges = w->amalgamation.relaxes || w->pairs != NULL;
    if (w->amalgamation.merges) {
        sli_amalgamate(&w->amalgamation, child, more, w->list, w->list + n);
    }
    if (sli_number_supernodes(&w->amalgamation, sequence, !w->keeps_order, order,
                              w->scratch)) {
        sli_analysis_reorder(w, order);
    }
    if (w->pairs != NULL) {
        sli_analysis_split(w, order);
    }
}

/* Finds tree, counts and supernodes, and renumbers the columns to their final order. */
static void sli_analyze_tree(sli_analysis *w, const sl_options *opt, sl_stats *stats) {
    sli_team alone = sli_team_of(1);
    w->opt = opt;
    w->found = stats;
    w->keeps_order =
        opt != NULL && (opt->ordering == SL_ORDERING_GIVEN || opt->ordering == SL_ORDERING_NATURAL);
    w->is_in_order = w->choice.has_tree || sli_analyze_columns(w);
    sli_team_loop(w->team == NULL ? &alone : w->team, 2, NULL, sli_analyze_item, w);
}

/* The processor seconds since the last call. */
SLI_NOINLINE static double sli_analysis_lap(sli_analysis *w) {
    const double before = w->clock;
    w->clock = sli_seconds_for(w->clock_entries);
    return w->clock - before;
}

/* Fills the counts. depth: n of scratch. */
static void sli_analyze_stats(const sl_symbolic *S, sl_int *depth, sl_stats *stats) {
    sl_int k, height = 0, components = 0;
    sl_off nnz_l = 0;
    double flops = 0.0;
    for (k = S->n - 1; k >= 0; k--) {
        const double count = S->counts[k];
        const sl_int up = S->parent[k];
        depth[k] = up == -1 ? 1 : depth[up] + 1;
        height = sli_max(height, depth[k]);
        components += up == -1;
        nnz_l += S->counts[k];
        flops += count * count;
    }
    stats->symbolic.n = S->n;
    stats->symbolic.supernodes = S->n_supers;
    stats->symbolic.nnz_panels = S->panel_begin[S->n_supers];
    stats->symbolic.tree_height = height;
    stats->symbolic.components = components;
    stats->symbolic.nnz_l = nnz_l;
    stats->symbolic.flops = flops;
}

/* Copies the separator tree, indexed by columns of L. Parents have higher numbers. */
static void sli_fill_septree(sl_symbolic *S, const sli_septree *septree) {
    sl_int k;
    for (k = 0; k < S->n && S->n_nodes > 0; k++) {
        S->node_of[k] = septree->node_of[S->perm[k]];
    }
    for (k = S->n_nodes - 1; k >= 0; k--) {
        S->node_parent[k] = septree->parent[k];
        S->node_level[k] = septree->parent[k] == -1 ? 0 : S->node_level[septree->parent[k]] + 1;
    }
}

/* Hashes what determines the object: the identity of a factor begins with it. */
static void sli_fill_identity(sl_symbolic *S, sl_triangle triangle) {
    const sl_int kind = (sl_int)triangle;
    sl_int k;
    S->identity = sli_hash_ints(S->pattern, &kind, 1);
    S->identity = sli_hash_ints(S->identity, S->perm, S->n);
    S->identity = sli_hash_ints(S->identity, S->super_first, (sl_off)S->n_supers + 1);
    for (k = 0; k < S->n && S->n_pairs > 0; k++) {
        if (S->pairs[k] == SLI_PAIR_FIRST) {
            S->identity = sli_hash_ints(S->identity, &k, 1);
        }
    }
}

/* Copies the tree out of the scratch and fills everything that depends on it. */
static void sli_symbolic_fill(sl_symbolic *S, sli_analysis *w, sl_stats *stats) {
    const size_t bytes = (size_t)S->n * sizeof(sl_int);
    sl_int k;
    for (k = 0; k < S->n; k++) {
        S->perm[k] = w->perm[w->old_of[k]];
        S->iperm[S->perm[k]] = k;
    }
    sli_copy(S->parent, w->parent, bytes);
    memcpy(S->counts, w->counts, bytes);
    memcpy(S->super_of, w->super_of, bytes);
    for (k = 0; k < S->n && S->n_pairs > 0; k++) {
        S->pairs[k] = w->is_first[k]                ? SLI_PAIR_FIRST
                      : k > 0 && w->is_first[k - 1] ? SLI_PAIR_SECOND
                                                    : SLI_PAIR_NONE;
    }
    w->supers = (sli_structure_super *)(void *)S->steps; /* memory that has been used, or will be */
    sli_fill_structure(w, S);
    sli_fill_steps(S);
    sli_fill_plain(S);
    if (S->input != NULL) {
        memcpy(S->input, w->A->p, bytes + sizeof(sl_int));
        memcpy(S->input + S->n + 1, w->A->i, (size_t)S->nnz_input * sizeof(sl_int));
    }
    sli_fill_septree(S, &w->septree);
    sli_fill_identity(S, stats->symbolic.triangle);
    sli_analyze_stats(S, w->scratch, stats);
}

/* Creates the analysis from the tree. draft has its allocator and its pattern. */
static sl_status sli_symbolic_build(sl_symbolic **out, sl_symbolic *draft, sli_analysis *w,
                                    sl_stats *stats) {
    sli_block b = {NULL, 0};
    sl_off rows = 0;
    sl_int s, plain = 0;
    sl_status status = SL_OK;
    draft->n = w->n;
    draft->n_supers = w->amalgamation.count;
    draft->n_nodes = w->septree.count;
    for (s = 0; w->pairs != NULL && s < w->n; s++) {
        draft->n_pairs += w->pairs[s];
    }
    stats->symbolic.pairs = draft->n_pairs;
    stats->symbolic.nnz_a = w->columns.begin[w->n];
    for (s = 0; s < w->amalgamation.count; s++) {
        rows += w->amalgamation.below[s];
        plain += w->amalgamation.width[s] == 1;
    }
    SLI_LAYOUT(&b, &draft->allocator, status) {
        (void)sli_take(&b, 1, sizeof(sl_symbolic));
        sli_symbolic_layout(draft, &b, rows, stats->symbolic.nnz_a);
        if (sli_is_mostly_plain(plain, draft->n_supers)) {
            draft->plain = SLI_CUT(&b, sl_int, draft->n_supers);
            if (draft->nnz_input > 0 && !w->amalgamation.is_for_one_factor) {
                draft->input = SLI_CUT(&b, sl_int, (sl_off)w->n + 1 + draft->nnz_input);
            }
        }
        stats->symbolic.bytes = b.used;
    }
    if (status != SL_OK) {
        return status;
    }
    sli_symbolic_fill(draft, w, stats);
    stats->symbolic.seconds_structure = sli_analysis_lap(w);
    stats->symbolic.seconds_analyze += stats->symbolic.seconds_structure;
    draft->stats.symbolic = stats->symbolic;
    *out = (sl_symbolic *)(void *)b.base;
    sli_copy(*out, draft, sizeof *draft);
    return SL_OK;
}

#endif
