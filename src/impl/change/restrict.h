/* restrict.h: sl_factor_restrict: the factor of A[R, R] from that of A */
#ifndef SLI_CHANGE_RESTRICT_H
#define SLI_CHANGE_RESTRICT_H

#include "../../public/restrict.h"
#include "../factor/leftlooking.h"
#include "restrict_anew.h"
#include "restrict_symbolic.h"

/* Copies the rows below of a panel of w columns, from a panel with rows that are not in R. keep:
 * for each of `count` rows its local row there, ascending. */
static void sli_restrict_rows(double *to, const double *from, sl_int w, const sl_int *keep,
                              sl_int count) {
    const sl_int tiles = sli_tiles(w + count);
    sl_int t, j, r;
    for (t = w / SLI_TILE; t < tiles; t++) {
        const double *at[SLI_TILE]; /* column 0 of each row */
        double *tile = to + sli_tile_offset(w, t);
        for (r = 0; r < SLI_TILE; r++) {
            const sl_int local = SLI_TILE * t + r, row = local < w           ? local
                                                         : local < w + count ? keep[local - w]
                                                                             : -1;
            at[r] = row == -1 ? NULL : from + sli_panel_at(w, row, 0);
        }
        for (j = 0; j < w; j++) {
            for (r = 0; r < SLI_TILE; r++) {
                tile[j * SLI_TILE + r] = at[r] == NULL ? 0.0 : at[r][j * SLI_TILE];
            }
        }
    }
}

/* Copies the numbers of kept supernode q. keep: scratch for its rows below. */
static void sli_restrict_copy(sl_factor *G, const sl_factor *F, sli_restriction *r, sl_int q,
                              sl_int *keep) {
    const sl_symbolic *S = F->S, *T = G->S;
    const sl_int s = r->kept[q], to = r->kept_new[q];
    const sli_step *step = &S->steps[s], *own = &T->steps[to];
    const sl_int w = step->width;
    const double *from = (const double *)F->values + step->panel;
    double *panel = (double *)G->values + own->panel;
    sl_int k, m;
    if (own->below == step->below) {
        memcpy(panel, from, (size_t)sli_panel_size(w, own->below) * sizeof(double));
    } else {
        for (k = 0, m = 0; k < own->below; k++, m++) {
            const sl_int rank = r->below[r->below_begin[q] + k];
            while (S->rows[S->rows_begin[s] + m] != r->R.columns[rank]) {
                m++;
            }
            keep[k] = w + m;
        }
        memcpy(panel, from, (size_t)sli_tile_offset(w, w / SLI_TILE) * sizeof(double));
        sli_restrict_rows(panel, from, w, keep, own->below);
    }
    r->copied += sli_panel_size(w, own->below);
    memcpy(G->D + own->column, F->D + step->column, (size_t)w * sizeof(double));
    if (F->rule.shifts != NULL) {
        memcpy(G->rule.shifts + own->column, F->rule.shifts + step->column,
               (size_t)w * sizeof(double));
    }
    G->extents[to] = F->extents[s];
    if (G->extents[to].pivot != -1) {
        G->extents[to].pivot += own->column - step->column;
    }
}

/* Adds the update of the root s of a kept subtree itself to its cleared update matrix. */
static void sli_restrict_update_own(const sl_factor *G, const sli_left_work *p, const sli_front *f,
                                    sl_int s, int has_one_sign) {
    sl_int k;
    sli_front_update(&G->kernels->fronts[0], f, G->buffer);
    for (k = 0; k < f->below && !has_one_sign; k++) {
        p->relative[k] = f->width + k;
    }
    if (!has_one_sign) {
        sli_left_magnitudes(G, p, f, s, 0, f->below);
    }
}

/* Computes the update matrix of a kept subtree with root s, from the panels of those of its
 * supernodes that have rows below s. update: room for the largest triangle of one. has_one_sign:
 * all kept pivots have one sign, so that the magnitudes are on the diagonal of the result. */
static void sli_restrict_update(const sl_factor *G, const sli_left_work *p, sl_int s,
                                int has_one_sign, double *update) {
    const sl_symbolic *S = G->S;
    const sli_front f = sli_front_of(G, s, 0);
    const sl_int *rows = S->rows + S->rows_begin[s];
    const sl_int whole = f.width / SLI_TILE, tiles = sli_front_tiles(&f);
    sl_int k, d;
    for (k = 0; k < f.below; k++) {
        p->local[rows[k]] = f.width + k;
    }
    for (k = 0; k < SLI_TILE * tiles; k++) {
        f.magnitude[k] = 0.0;
    }
    memset(f.update, 0,
           (size_t)sli_triangle_offset(sli_update_tiles(f.width, f.below)) * sizeof(double));
    sli_restrict_update_own(G, p, &f, s, has_one_sign);
    for (d = s - 1; d >= S->first_descendant[s];) {
        const sl_int below = S->steps[d].below;
        const sl_int first =
            sli_lower_bound(S->rows + S->rows_begin[d], below, S->super_first[s + 1]);
        if (first < below) {
            sli_left_update(G, p, &f, d, first, below, update);
            if (!has_one_sign) {
                sli_left_magnitudes(G, p, &f, d, first, below);
            }
            d--;
        } else { /* no descendant of d has a row below s either */
            d = S->first_descendant[d] - 1;
        }
    }
    for (k = f.width; k < f.width + f.below && has_one_sign; k++) {
        const sl_int tile = k / SLI_TILE - whole, column = k - SLI_TILE * whole;
        f.magnitude[k] =
            fabs(f.update[sli_triangle_offset(tile) + (sl_off)column * SLI_TILE + k % SLI_TILE]);
    }
    sli_front_hand_over(&f);
}

/* Scratch of the numbers. */
typedef struct sli_restrict_work {
    sli_left_work left;
    double *update;         /* the largest triangle of a kept supernode */
    unsigned char *is_kept; /* by supernode of G */
} sli_restrict_work;

static sl_status sli_restrict_work_make(sli_restrict_work *w, sli_block *b, const sl_symbolic *S,
                                        const sli_restriction *r, const sl_allocator *a) {
    sl_status status = SL_OK;
    sl_off most = 0;
    sl_int q;
    int pass;
    for (q = 0; q < r->n_kept; q++) {
        const sli_step *step = &S->steps[r->kept_new[q]];
        const sl_off size = sli_triangle_offset(sli_update_tiles(step->width, step->below));
        most = size > most ? size : most;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        sli_left_work_layout(&w->left, b, S);
        w->update = SLI_TAKE(b, double, most);
        w->is_kept = SLI_TAKE(b, unsigned char, S->n_supers);
        status = pass == 0 ? sli_block_alloc(b, a) : SL_OK;
    }
    return status;
}

/* Computes the new supernodes from A and from the update matrices of their children. */
static sl_status sli_restrict_eliminate(sl_factor *G, const sli_restrict_work *w, int has_one_sign,
                                        const sli_source *from, sli_failure *failure) {
    const sl_symbolic *S = G->S;
    sl_status status = SL_OK;
    sl_int s;
    for (s = 0; s < S->n_supers && status == SL_OK; s++) {
        if (!w->is_kept[s]) {
            status = sli_front_factor(G, from, s, 0, failure);
        } else if (S->super_parent[s] != -1 && !w->is_kept[S->super_parent[s]]) {
            sli_restrict_update(G, &w->left, s, has_one_sign, w->update);
        }
    }
    return status;
}

/* Refuses a kept pivot that was skipped as null. */
static sl_status sli_restrict_check(const sl_factor *F, const sli_restriction *r,
                                    sli_failure *failure) {
    sl_int q, k;
    for (q = 0; q < r->n_kept && F->n_nulls > 0; q++) {
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

static sl_status sli_restrict_numbers(sl_factor *G, const sl_factor *F, sli_restriction *r,
                                      sl_stats *stats) {
    const double started = sli_seconds();
    const sli_source from = sli_source_matrix(r->A);
    sli_restrict_work w;
    sli_failure failure;
    sli_block b = {NULL, 0, 0};
    sl_int q;
    sl_status status = sli_restrict_work_make(&w, &b, G->S, r, &G->allocator);
    if (status != SL_OK) {
        return status;
    }
    memset(&failure, 0, sizeof failure);
    memset(w.is_kept, 0, (size_t)G->S->n_supers);
    sli_factor_begin(G);
    G->identity = sli_hash_words(F->identity, &G->S->identity, 2);
    status = sli_restrict_check(F, r, &failure);
    for (q = 0; q < r->n_kept && status == SL_OK; q++) {
        w.is_kept[r->kept_new[q]] = 1;
        sli_restrict_copy(G, F, r, q, w.left.relative);
    }
    if (status == SL_OK) {
        const sl_factor_info *info = &F->stats.factor;
        (void)sli_restrict_eliminate(G, &w, info->positive == 0 || info->negative == 0, &from,
                                     &failure);
    }
    sli_free(&G->allocator, b.base);
    return sli_factor_done(G, &from, &failure, started, stats);
}

/* The options that give a factor over R the rules of F. signs: count of scratch. */
static sl_options sli_restrict_options(const sl_factor *F, const sli_restriction *r,
                                       const sl_allocator *a, sl_int *signs) {
    sl_options opt = sli_options_with(a);
    sl_int k;
    opt.isa = F->kernels->isa;
    opt.null_tolerance = F->rule.null_tolerance;
    opt.regularization = F->rule.regularization;
    opt.growth_limit = sli_is_finite(F->growth_limit) ? F->growth_limit : -1.0;
    opt.error_limit = sli_is_finite(F->error_limit) ? F->error_limit : -1.0;
    if (opt.regularization != 0.0 && F->rule.signs != NULL) {
        for (k = 0; k < r->R.count; k++) {
            signs[r->R.row_of[k]] = F->rule.signs[r->R.columns[k]];
        }
        opt.signs = signs;
    }
    return opt;
}

/* Creates the factor over an analysis that is joined already. */
static sl_status sli_restrict_factor(sl_factor **out, const sl_symbolic *S, const sl_factor *F,
                                     sli_restriction *r, const sl_options *rules, sl_stats *stats) {
    sl_options opt = *rules;
    sl_factor *G = NULL;
    sl_status status;
    opt.method = SL_METHOD_SUPERNODAL;
    status = sli_factor_new(&G, S, &opt, stats);
    status = status == SL_OK ? sli_restrict_numbers(G, F, r, stats) : status;
    if (status == SL_OK) {
        *out = G;
    } else {
        sl_factor_free(G);
    }
    return status;
}

/* Ends the creation of both objects. There is no matrix that they could be refactored with: the
 * numbers stay, and what a refactorization needs is released. */
static void sli_restrict_done(sl_symbolic *S, sl_factor *G) {
    sl_factor counted = *G;
    sli_block b = {NULL, 0, 0};
    sli_free(&G->allocator, G->stack);
    sli_free(&G->allocator, G->scratch);
    G->stack = NULL;
    G->scratch = NULL;
    (void)sli_take(&b, 1, sizeof(sl_factor));
    sli_factor_layout(&counted, &b, 0);
    G->stats.factor.bytes = b.used;
    G->is_immutable = 1;
    S->is_partial = 1;
    S->nnz_input = -1;
    memset(S->scatter_begin, 0, ((size_t)S->n_supers + 1) * sizeof(sl_off));
}

/* Reports an error in rows of A. A position in A[R, R] came from its extraction. */
static void sli_restrict_report(const sli_restriction *r, sl_status status, int is_anew,
                                sl_stats *stats) {
    const int is_entry = status == SL_ERR_NOT_FINITE && stats->error.column != -1;
    if (status == SL_ERR_PIVOT || status == SL_ERR_INACCURATE ||
        (status == SL_ERR_NOT_FINITE && (is_anew || !is_entry))) {
        stats->error.row = r->rows[stats->error.row];
        stats->error.column = stats->error.column == -1 ? -1 : r->rows[stats->error.column];
    }
}

/* Below this share of kept columns it is faster to extract A[R, R] and to analyze it. */
#define SLI_RESTRICT_KEPT 0.25

static sl_status sli_restrict_run(sl_symbolic **S, sl_factor **G, const sl_factor *F,
                                  sli_restriction *r, int is_anew, const sl_allocator *a,
                                  sl_stats *stats) {
    const double started = sli_seconds();
    const sl_options rules = sli_restrict_options(F, r, a, (sl_int *)(void *)r->scratch);
    sl_stats found;
    sl_status status;
    if (is_anew) {
        return sli_restrict_anew(S, G, r, &rules, stats);
    }
    memset(&found, 0, sizeof found);
    found.symbolic.triangle = F->S->stats.symbolic.triangle;
    status = sli_restriction_run(r, a, &found, stats);
    status = status == SL_OK ? sli_joint_make(S, r, a, &found) : status;
    if (status == SL_OK) {
        (*S)->stats.symbolic.seconds_analyze = sli_seconds() - started;
        status = sli_restrict_factor(G, *S, F, r, &rules, stats);
    }
    return status;
}

/* Checks F and what can be checked of A and rows before they are read. */
static sl_status sli_restrict_arguments(const sl_factor *F, const sl_csc *A, const sl_int *rows,
                                        sl_int count, const sl_options *opt) {
    if (F == NULL || A == NULL || count < 0 || (count > 0 && rows == NULL) ||
        !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
        return SL_ERR_ARGUMENT;
    }
    if (!F->is_valid || !sli_factor_is_over(F, F->S, F->analysis)) {
        return SL_ERR_STATE;
    }
    if (F->E != NULL || F->S->nnz_input < 0 || F->storage != SL_STORAGE_DOUBLE ||
        F->null_vectors > 1) {
        return SL_ERR_UNSUPPORTED;
    }
    if (A->n_cols > 0 && A->p == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (A->n_rows != F->S->n || A->n_cols != F->S->n || sli_nnz(A) != F->S->nnz_input) {
        return SL_ERR_PATTERN;
    }
    return sli_nnz(A) > 0 && (A->i == NULL || A->x == NULL) ? SL_ERR_ARGUMENT : SL_OK;
}

SL_API sl_status sl_factor_restrict(sl_symbolic **S, sl_factor **G, const sl_factor *F,
                                    const sl_csc *A, const sl_int *rows, sl_int count,
                                    const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    const double started = sli_seconds();
    sli_restriction r;
    sl_status status;
    int is_anew;
    sli_stats_clear_error(stats);
    if (S == NULL || G == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *S = NULL;
    *G = NULL;
    status = sli_restrict_arguments(F, A, rows, count, opt);
    if (status != SL_OK) {
        return status;
    }
    memset(&r, 0, sizeof r);
    r.S = F->S;
    r.A = A;
    r.rows = rows;
    r.R.count = count;
    status = sli_restriction_begin(&r, &a, stats);
    is_anew = count - r.n_fresh < SLI_RESTRICT_KEPT * count;
    if (status == SL_OK) {
        status = sli_restrict_run(S, G, F, &r, is_anew, &a, stats);
        if (stats != NULL) {
            sli_restrict_report(&r, status, is_anew, stats);
        }
    }
    if (status == SL_OK) {
        sli_restrict_done(*S, *G);
    } else {
        sl_symbolic_free(*S);
        *S = NULL;
    }
    if (status == SL_OK && stats != NULL) {
        sl_restrict_info *info = &stats->restriction;
        stats->factor.bytes = (*G)->stats.factor.bytes;
        info->is_anew = is_anew;
        info->kept = count - r.n_fresh;
        info->computed = count - info->kept;
        info->entries = r.copied;
        info->seconds = sli_seconds() - started;
    }
    sli_restriction_free(&r, &a);
    return status;
}

#endif
