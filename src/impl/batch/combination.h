/* combination.h: factorization of a weighted sum of value arrays in the order of the scatter map */
#ifndef SLI_BATCH_COMBINATION_H
#define SLI_BATCH_COMBINATION_H

#include "../../public/several.h"
#include "../factor/factor.h"

/* Describes a sum as the source of a factorization; checks its arguments. */
static sl_status sli_source_of_sum(const sl_symbolic *S, const double *coefficients,
                                   const double *const *values, sl_int terms, sli_source *from) {
    sl_int t;
    if (terms < 0 || (terms > 0 && (coefficients == NULL || values == NULL))) {
        return SL_ERR_ARGUMENT;
    }
    for (t = 0; t < terms; t++) {
        if (values[t] == NULL && S->scatter_begin[S->n_supers] > 0) {
            return SL_ERR_ARGUMENT;
        }
    }
    from->A = NULL;
    from->values = values;
    from->coefficients = coefficients;
    from->terms = terms;
    return SL_OK;
}

SL_API sl_status sl_factor_create_combination(sl_factor **out, const sl_symbolic *S,
                                              const double *coefficients,
                                              const double *const *values, sl_int terms,
                                              const sl_options *opt, sl_stats *stats) {
    sli_source from;
    sl_status status;
    sli_stats_clear_error(stats);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (S == NULL || !sli_factor_options_are_valid(opt)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_source_of_sum(S, coefficients, values, terms, &from);
    return status == SL_OK ? sli_factor_create_from(out, S, &from, opt, stats) : status;
}

SL_API sl_status sl_factor_refactor_combination(sl_factor *F, const double *coefficients,
                                                const double *const *values, sl_int terms,
                                                sl_stats *stats) {
    const double started = sli_seconds();
    sli_source from;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (!sli_factor_may_change(F)) {
        return SL_ERR_STATE;
    }
    status = sli_source_of_sum(F->S, coefficients, values, terms, &from);
    status = status == SL_OK ? sli_factor_prepare(F) : status;
    if (status != SL_OK) {
        return status;
    }
    sli_factor_begin(F);
    return sli_factor_numbers(F, &from, started, stats);
}

#endif
