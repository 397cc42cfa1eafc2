/* advice.h: what helps where a factorization was refused, as text */
#ifndef SLI_FACTOR_ADVICE_H
#define SLI_FACTOR_ADVICE_H

#include "factor_setup.h"
#include "pivot_suspects.h"

/* Why pivot k is null, as its connected part of A shows; NULL: not known. May overwrite L. */
SLI_COLD static const char *sli_advice_of_matrix(sl_factor *F, const sli_source *from, sl_int k) {
    const sl_symbolic *S = F->S;
    const int fits = sli_null_suspect_fits(F);
    void *room = fits ? F->values : sli_judge_memory(F, S->n, SLI_SUSPECT_ROW);
    sli_null_row *rows = (sli_null_row *)room;
    const char *what = NULL;
    if (rows != NULL) {
        double *most = (double *)(void *)(rows + S->n);
        sl_int *last = (sl_int *)(void *)(most + S->n);
        const sli_null_walk w = sli_null_walk_begin(S, 0, rows, NULL, NULL);
        sli_null_add_map(&w, S, from, NULL);
        sli_null_components(&w, S, NULL, last, most);
        if (rows[k].size == 0.0) {
            what = "the row is 0, as that of an isolated vertex. Set options.pivots = "
                   "SL_PIVOTS_SKIP_NULL, without sl_symbolic_create_pivoted: x is 0 there";
        } else if (most[last[k]] == 0.0) {
            what = "the rows of this connected part sum to 0, as in a Laplacian: x is unique up to "
                   "a constant. Set options.pivots = SL_PIVOTS_SKIP_NULL, without "
                   "sl_symbolic_create_pivoted, and options.mass if b does not sum to 0";
        }
    }
    if (fits) {
        sli_factor_clear_gaps(F);
    } else {
        sli_free(&F->allocator, room);
    }
    return what;
}

/* What helps where pivot k was refused because it is null. */
SLI_COLD static const char *sli_advice_null(sl_factor *F, const sli_source *from, sl_int k) {
    const char *what = sli_singular_of(1) == NULL
                           ? NULL
                           : sli_advice_of_matrix(F, from, k); /* branches untested: they are */
    return what != NULL ? what
           : F->rule.null_tolerance > sli_null_tolerance(F->S->n)
               ? "the pivot is within options.null_tolerance, which is above its default"
           : F->S->is_pivoted
               ? "A is singular to working precision; if it is semidefinite, options.pivots = "
                 "SL_PIVOTS_SKIP_NULL without sl_symbolic_create_pivoted"
               : "if A is regular, sl_symbolic_create_pivoted factors it; if it is semidefinite, "
                 "options.pivots = SL_PIVOTS_SKIP_NULL";
}

/* What helps where a factorization was refused at a pivot. */
SLI_COLD static const char *sli_advice(sl_factor *F, const sli_source *from, const sli_failure *f) {
    if (f->status != SL_ERR_PIVOT) {
        return f->status == SL_ERR_NOT_FINITE ? "a pivot is not finite: numbers of A overflow"
               : f->status == SL_ERR_UNSUPPORTED
                   ? "A has more null vectors than columns are given, options.null_vector_count"
               : F->stats.factor.growth <= F->limits.growth ? "float cannot hold L: options.storage"
               : F->S->is_pivoted ? "pivot growth exceeds options.growth_limit"
                                  : "sl_symbolic_create_pivoted avoids pivot growth";
    }
    return F->limits.is_definite && f->bound >= 0.0
               ? "SL_PIVOTS_POSITIVE: the pivot is not positive, and A not positive definite"
           : f->bound < 0.0 ? "there was no memory to judge the pivot"
           : !sli_skips_nulls(F) || sli_singular_of(1) == NULL /* branches untested: the same */
               ? sli_advice_null(F, from, f->pivot)
           : f->bound > 0.0 && f->value != 0.0 /* 0: one of two complex null vectors is missing */
               ? "the pivot has the wrong sign, beyond options.null_tolerance: "
                 "SL_PIVOTS_SKIP_NULL takes semidefinite matrices"
               : "A is indefinite, or options.null_vector or options.mass does not suit its null "
                 "vectors";
}

#endif
