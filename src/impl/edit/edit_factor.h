/* edit_factor.h: sl_factor_edit: the factor of an edited matrix from that of the matrix before */
#ifndef SLI_EDIT_FACTOR_H
#define SLI_EDIT_FACTOR_H

#include "../change/kept.h"
#include "../../public/edit.h"
#include "../factor/costs.h"
#include "../factor/factor.h"
#include "edit_match.h"
#include "../factor/panel_load.h"

/* A whole factorization is taken if the estimates differ by less. */
#define SLI_REUSE_SHARE 0.97
/* Where much has changed, few comparisons show that nothing is worth keeping: at first, so many
 * supernodes of each such number of them are compared. A comparison of all takes up to a tenth of
 * the time of a factorization, so it ends where so large a share of the flops is not saved: of
 * those that the sample shows, and of those that all comparisons show. */
#define SLI_REUSE_SAMPLE 8
#define SLI_REUSE_SAMPLED 128
#define SLI_REUSE_MOST_OF_SAMPLE 0.7
#define SLI_REUSE_MOST 0.9
/* In sli_reuse.from: not compared yet. */
#define SLI_REUSE_UNKNOWN (-2)

/* What is kept of F. A supernode of G is kept if a supernode of F has the same columns, rows and
 * entries and as many descendants, and if its own are kept. The rows may be in another order, as
 * ancestors may be. These descendants are those of the supernode of F: the first row below each
 * child in F is in the columns of its parent in G, as all others are among the rows below it. */
typedef struct sli_reuse {
    const sl_factor *F;
    sl_factor *G;
    const sl_csc *B;
    sli_kept kept;
    sl_int *from;             /* supernodes of G: that of F, or -1 */
    sl_int *columns;          /* columns of G: that of F, or -1 */
    sl_int *row_columns;      /* the same by rows of B */
    double flops, flops_anew; /* of the supernodes that are known to be computed; of all */
    sl_reuse_info info;
    void *blocks[2];
} sli_reuse;

/* Finds the columns of F that those of G were. */
static sl_status sli_reuse_begin(sli_reuse *r, const sl_int *new_of, sl_stats *stats) {
    const sl_symbolic *T = r->G->S;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_int k;
    SLI_LAYOUT(&b, &r->G->allocator, status) {
        r->from = SLI_TAKE(&b, sl_int, T->n_supers);
        r->columns = SLI_TAKE(&b, sl_int, T->n);
        r->row_columns = SLI_TAKE(&b, sl_int, T->n);
    }
    r->blocks[0] = b.base;
    if (status != SL_OK) {
        return status;
    }
    status = sli_edit_columns(r->F->S, new_of, T->n, r->row_columns, stats);
    for (k = 0; k < T->n; k++) {
        r->columns[k] = r->row_columns[T->perm[k]];
    }
    r->kept = sli_kept_of(r->F, r->from, r->columns, 0);
    return status;
}

/* Are pivots of both factors judged alike? Default tolerances count as equal. */
static int sli_reuse_is_suited(const sl_factor *F, const sl_factor *G) {
    const double a = F->rule.null_tolerance, b = G->rule.null_tolerance;
    return F->history.marks != NULL && G->history.marks != NULL && F->E == NULL && G->E == NULL &&
           F->type == G->type && G->type->accepts == NULL && F->null.calls == G->null.calls &&
           F->null.vectors == 1 && G->null.vectors == 1 &&
           F->rule.regularization == G->rule.regularization &&
           (a == b || (sli_tolerance_is_default(F) && sli_tolerance_is_default(G)));
}

/* Is column k of G treated as column j of F was? Kinds and signs of a semidefinite matrix depend on
 * the whole matrix. */
static int sli_reuse_is_alike(const sli_reuse *r, sl_int k, sl_int j) {
    const sli_pivot_rule *f = &r->F->rule, *g = &r->G->rule;
    const int before = f->signs == NULL ? 1 : f->signs[j];
    return before == (g->signs == NULL ? 1 : g->signs[k]) &&
           (f->kinds == NULL || f->kinds[j] == g->kinds[k]);
}

/* The supernode of F with the columns and rows of s, or -1. *is_moved := whether the rows are in
 * another order. */
static sl_int sli_reuse_candidate(const sli_reuse *r, sl_int s, int *is_moved) {
    const sl_symbolic *S = r->F->S, *T = r->G->S;
    const sli_step *own = &T->steps[s];
    const sl_int first = r->columns[own->column], there = first == -1 ? -1 : S->super_of[first];
    const sl_int *rows = T->rows + T->rows_begin[s], *of;
    sl_int k;
    if (there == -1 || S->super_first[there] != first || S->steps[there].width != own->width ||
        S->steps[there].below != own->below ||
        there - S->first_descendant[there] != s - T->first_descendant[s]) {
        return -1;
    }
    for (k = 0; k < own->width; k++) {
        if (r->columns[own->column + k] != first + k ||
            !sli_reuse_is_alike(r, own->column + k, first + k)) {
            return -1;
        }
    }
    of = S->rows + S->rows_begin[there];
    *is_moved = 0;
    for (k = 0; k < own->below; k++) {
        const sl_int row = r->columns[rows[k]];
        if (row != of[k]) {
            const sl_int at = sli_lower_bound(of, own->below, row);
            *is_moved = 1;
            if (at == own->below || of[at] != row) {
                return -1;
            }
        }
    }
    return there;
}

/* Has supernode s the entries that the one of F was computed from? Marks it in G. A run of plain
 * columns leaves no marks in F: they are the same if they give the same numbers, and F has not been
 * changed by other ways, which leave bounds of the entries and magnitudes. */
static int sli_reuse_is_same(const sli_reuse *r, sl_int s, sl_int there, int is_moved) {
    const sl_factor *F = r->F;
    const sl_symbolic *S = F->S, *T = r->G->S;
    const sl_int w = T->steps[s].width, below = T->steps[s].below, *of = S->rows;
    const sl_off begin = T->steps[s].panel, least = T->scatter_begin[0] + SLI_ENTRIES_AHEAD;
    const double *l = (const double *)F->values + S->steps[there].panel;
    const double d = F->D[S->steps[there].column];
    const int has_mark = F->schedule.is_plain[there] != SLI_PLAIN_DIRECT || sli_skips_nulls(F) ||
                         sli_is_regularized(F, S->steps[there].column);
    int is_same = has_mark || r->G->schedule.is_plain[s] == SLI_PLAIN_DIRECT;
    uint64_t mark = SLI_MARK_BEGIN, before = SLI_MARK_BEGIN;
    double pivot = 0.0, entry = 0.0, magnitude;
    sl_int tile = sli_last_tile(T, s), k, j;
    sl_off m;
    of += S->rows_begin[there];
    for (m = T->scatter_begin[s + 1] - 1; m >= T->scatter_begin[s]; m--) {
        const double a = r->B->x[T->scatter_from[m]];
        sl_off at = T->scatter_to[m] - begin;
        if (m >= least) {
            SLI_PREFETCH(r->B->x + T->scatter_from[m - SLI_ENTRIES_AHEAD], 0);
        }
        mark += sli_mark_entry(a, at);
        if (is_moved) {
            sli_scatter_map_pivots(T, s, m, &tile, &k, &j);
            j -= T->super_first[s];
            k = k < T->super_first[s + 1] ? k - T->super_first[s]
                                          : w + sli_lower_bound(of, below, r->columns[k]);
            at = sli_panel_at(w, k, j);
            before += sli_mark_entry(a, at);
        }
        pivot = 0.0 + a; /* at the end */
        entry = fabs(a) > entry ? fabs(a) : entry;
        is_same &= has_mark || at == 0 || l[at] == pivot / d;
    }
    r->G->history.marks[s] = mark;
    if (has_mark) {
        return F->history.marks[there] == (is_moved ? before : mark);
    }
    magnitude = fabs(pivot);
    for (j = there - 1; j >= S->first_descendant[there]; j = S->first_descendant[j] - 1) {
        sli_plain_take(F, j, 0, &pivot, &magnitude);
    }
    return is_same && pivot == d && F->extents[there].entry == entry &&
           F->extents[there].magnitude == magnitude;
}

/* Counts the flops of what is kept and of what is not. Returns whether to keep is faster. */
static int sli_reuse_choose(sli_reuse *r) {
    const sl_symbolic *T = r->G->S;
    sl_reuse_info *info = &r->info;
    const double flop = sli_cost_flop(r->G->kernels);
    sl_int s, supers = 0, visits = 0;
    double cost;
    info->flops = r->flops;
    for (s = 0; s < T->n_supers; s++) {
        const sl_int up = T->super_parent[s];
        if (r->from[s] == -1) {
            visits++;
            continue;
        }
        supers++;
        info->kept += T->steps[s].width;
        info->entries += T->panel_begin[s + 1] - T->panel_begin[s];
        if (up != -1 && r->from[up] == -1) {
            info->flops += sli_kept_flops(T, s, &visits);
        }
    }
    info->computed = T->n - info->kept;
    /* a kept supernode is found and copied, its entries are read and written */
    cost = flop * info->flops + SLI_COST_FRONT * visits + SLI_COST_FRONT / 4.0 * supers +
           2.0 * (double)info->entries;
    return cost < SLI_REUSE_SHARE * (flop * r->flops_anew + SLI_COST_FRONT * (double)T->n_supers);
}

/* Compares supernode s with that of F, but not its children. */
SLI_HOT static void sli_reuse_compare(sli_reuse *r, sl_int s) {
    int is_moved;
    const sl_int there = sli_reuse_candidate(r, s, &is_moved);
    if (there != -1 && sli_reuse_is_same(r, s, there, is_moved)) {
        r->from[s] = there;
        return;
    }
    for (; s != -1 && r->from[s] != -1; s = r->G->S->super_parent[s]) { /* nor are its ancestors */
        r->from[s] = -1;
        r->flops += sli_front_flops(&r->G->S->steps[s]);
    }
}

/* Finds the subtrees to keep. Returns whether that is faster than to compute them. */
static int sli_reuse_find(sli_reuse *r) {
    const sl_symbolic *T = r->G->S;
    sl_int s;
    int is_sample;
    for (s = 0; s < T->n_supers; s++) {
        r->from[s] = SLI_REUSE_UNKNOWN;
        r->flops_anew += sli_front_flops(&T->steps[s]);
    }
    r->info.flops_anew = r->flops_anew;
    for (is_sample = 1; is_sample >= 0; is_sample--) {
        for (s = 0; s < T->n_supers; s++) {
            if (r->from[s] == SLI_REUSE_UNKNOWN &&
                is_sample == (s % SLI_REUSE_SAMPLED < SLI_REUSE_SAMPLE)) {
                sli_reuse_compare(r, s);
            }
            if (r->flops >
                (is_sample ? SLI_REUSE_MOST_OF_SAMPLE : SLI_REUSE_MOST) * r->flops_anew) {
                return 0;
            }
        }
    }
    return sli_reuse_choose(r);
}

/* Computes the columns that are not kept. */
static sl_status sli_reuse_run(sli_reuse *r, const sli_source *from, sli_failure *failure) {
    sli_block b = {NULL, 0};
    const sl_status status = sli_kept_room(&r->kept, r->G, &b);
    r->blocks[1] = b.base;
    if (status != SL_OK) {
        return status;
    }
    sli_factor_identify(r->G, from);
    r->G->identity = sli_hash_words(r->G->identity, &r->F->identity, 2);
    r->G->work.copied = &r->kept.copied;
    (void)sli_multifrontal(r->G, from, failure);
    r->G->work.copied = NULL;
    return SL_OK;
}

/* Computes the numbers of G. */
static sl_status sli_reuse_numbers(sli_reuse *r, sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source from = sli_source_matrix(r->B);
    sli_failure failure;
    int is_suited = sli_reuse_is_suited(r->F, r->G), keeps = 0;
    sl_status status;
    SLI_CLEAR(failure);
    sli_factor_begin(r->G);
    if (is_suited && sli_skips_nulls(r->G)) {
        is_suited = r->G->null.calls->prepare(r->G, &from, &failure) == SL_OK;
    }
    keeps = is_suited && sli_reuse_find(r);
    status = keeps ? sli_reuse_run(r, &from, &failure) : SL_OK;
    if (status != SL_OK) {
        return status;
    }
    r->info.reason = is_suited ? SL_CHANGE_CHEAPEST : SL_CHANGE_UNSUITED;
    if (keeps && (failure.status != SL_OK || sli_null_is_suspected(r->G))) {
        keeps = 0; /* B may be singular: its factorization decides */
        r->info.reason = SL_CHANGE_REFUSED;
    }
    r->info.is_anew = !keeps;
    if (!keeps) {
        r->info.kept = 0;
        r->info.entries = 0;
        r->info.computed = r->G->S->n;
        r->info.flops = r->info.flops_anew;
    }
    return keeps ? sli_factor_done(r->G, &from, &failure, started, stats)
                 : sli_factor_numbers(r->G, &from, started, stats);
}

SL_API sl_status sl_factor_edit(sl_factor **out, const sl_factor *F, const sl_symbolic *S,
                                const sl_csc *B, const sl_int *new_of, const sl_options *opt,
                                sl_stats *stats) {
    const double started = sli_seconds();
    sli_reuse r;
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    if (status == SL_OK) {
        status = sli_argument(F == NULL   ? "F is NULL"
                              : S == NULL ? "S is NULL"
                                          : sli_factor_options_wrong(opt));
    }
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status == SL_OK && F->S->n > 0 && new_of == NULL) {
        status = sli_argument("new_of is NULL");
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(r);
    r.F = F;
    r.B = B;
    status = sli_pattern_check(S, B, 1);
    status = status == SL_OK ? sli_factor_new(&r.G, S, opt, NULL, stats) : status;
    status = status == SL_OK ? sli_reuse_begin(&r, new_of, stats) : status;
    status = status == SL_OK ? sli_reuse_numbers(&r, stats) : status;
    if (r.G != NULL) {
        sli_free(&r.G->allocator, r.blocks[0]);
        sli_free(&r.G->allocator, r.blocks[1]);
    }
    if (status == SL_OK) {
        *out = r.G;
        r.info.seconds = sli_seconds() - started;
        if (stats != NULL) {
            stats->reuse = r.info;
        }
    } else {
        sl_factor_free(r.G);
    }
    return sli_report(stats, status);
}

#endif
