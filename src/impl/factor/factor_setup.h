/* factor_setup.h: allocates a factor without numbers from the options, and releases it */
#ifndef SLI_FACTOR_FACTOR_SETUP_H
#define SLI_FACTOR_FACTOR_SETUP_H

#include "../base/options.h"
#include "../kernels/dispatch.h"
#include "factor_layout.h"
#include "growth.h"

/* What is wrong with the options of a factorization, which are not NULL, or NULL. Only
 * SL_PIVOTS_NONZERO goes with regularization, which replaces what the others refuse or skip. */
static const char *sli_factor_choices_wrong(const sl_options *opt) {
    return (unsigned)opt->method > (unsigned)SL_METHOD_SUPERNODAL
               ? "options.method is not a value of sl_method"
           : sli_storage_needs(opt->storage) == NULL
               ? "options.storage is not a value of sl_storage"
           : (unsigned)opt->pivots > (unsigned)SL_PIVOTS_SKIP_NULL
               ? "options.pivots is not a value of sl_pivots"
           : opt->null_tolerance != opt->null_tolerance ? "options.null_tolerance is NaN"
           : opt->consistency_tolerance != opt->consistency_tolerance
               ? "options.consistency_tolerance is NaN"
           : opt->growth_limit != opt->growth_limit ? "options.growth_limit is NaN"
           : opt->error_limit != opt->error_limit   ? "options.error_limit is NaN"
           : !(opt->regularization >= 0.0) || !sli_is_finite(opt->regularization)
               ? "options.regularization is below 0 or not finite"
           : opt->regularization != 0.0 && opt->pivots != SL_PIVOTS_NONZERO
               ? "options.regularization needs options.pivots = SL_PIVOTS_NONZERO"
           : opt->null_vector_count < 0 || opt->null_vector_count > SLI_NULL_VECTORS_MAX
               ? "options.null_vector_count is below 0 or above 32"
           : opt->null_vector_count > 1 && opt->null_vector == NULL ? "options.null_vector is NULL"
                                                                    : NULL;
}

/* The same of options that may be NULL, and with those that all calls read. */
static const char *sli_factor_options_wrong(const sl_options *opt) {
    const char *wrong = sli_options_wrong(opt, SLI_READS_FACTOR | SLI_READS_ISA);
    return wrong != NULL || opt == NULL ? wrong : sli_factor_choices_wrong(opt);
}

/* A limit of the options: 0 is the default, and what is negative is no limit. */
SLI_INLINE double sli_limit(double option, double limit) {
    return option == 0.0 ? limit : option < 0.0 ? (double)INFINITY : option;
}

/* The option that gives this limit again. (Without a difference of infinities, which may trap.) */
SLI_INLINE double sli_limit_option(double limit) {
    return limit <= DBL_MAX ? limit : -1.0;
}

/* Sets the rules for null pivots and the limits. The arrays among the options are copied later, by
 * sli_factor_rules_fill. */
static void sli_factor_rules(sl_factor *F, const sl_options *opt) {
    const double null = opt == NULL ? 0.0 : opt->null_tolerance;
    const double consistency = opt == NULL ? 0.0 : opt->consistency_tolerance;
    const sl_int vectors = opt == NULL ? 0 : (sl_int)opt->null_vector_count;
    F->null.calls = sli_singular_of(opt != NULL && opt->pivots == SL_PIVOTS_SKIP_NULL);
    F->rule.null_tolerance = null == 0.0 ? sli_null_tolerance(F->S->n) : null;
    F->rule.regularization = opt == NULL ? 0.0 : opt->regularization;
    F->rule.replaces = sli_skips_nulls(F) || F->rule.regularization != 0.0;
    F->null.vectors = sli_skips_nulls(F) ? sli_max(vectors, 1) : 1;
    F->null.consistency = consistency == 0.0 ? 1e-6 : consistency;
    F->null.is_centered = sli_skips_nulls(F) && opt->mass != NULL;
    F->limits.is_definite = opt != NULL && opt->pivots == SL_PIVOTS_POSITIVE;
    F->limits.growth = sli_limit(opt == NULL ? 0.0 : opt->growth_limit,
                                 sli_is_float(F) ? SLI_GROWTH_LIMIT_FLOAT : SLI_GROWTH_LIMIT);
    F->limits.error = sli_limit(opt == NULL ? 0.0 : opt->error_limit, 1e-8);
}

/* Copies the arrays that the rules refer to, into pivot order. */
static sl_status sli_factor_rules_fill(sl_factor *F, const sl_options *opt, sl_stats *stats) {
    const sl_symbolic *S = F->S;
    sl_int i;
    if (F->rule.regularization != 0.0 && opt->signs == NULL && S->is_pivoted) {
        memset(F->rule.signs, 0, (size_t)S->n); /* any sign is right */
    } else if (F->rule.regularization != 0.0 && opt->signs == NULL) {
        F->rule.signs = NULL;
    } else if (F->rule.regularization != 0.0) {
        for (i = 0; i < S->n; i++) {
            if (opt->signs[i] < -1 || opt->signs[i] > 1) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, i, -1, (double)opt->signs[i],
                                   "options.signs has a value other than -1, 0 and 1");
            }
            F->rule.signs[S->iperm[i]] = (signed char)opt->signs[i];
        }
    }
    return sli_skips_nulls(F) ? F->null.calls->fill(F, opt, stats) : SL_OK;
}

/* Do more than 8 MB of update matrices wait for one parent, and 8 times as much as L has? One child
 * passes up less. */
static int sli_updates_exceed(const sl_symbolic *S) {
    const double room = 8.0 * (double)S->panel_begin[S->n_supers];
    const double most = room > 1e6 ? room : 1e6, height = 16.0 + S->tallest;
    const sl_int *low = S->first_descendant;
    double sum = 0.0;
    sl_int s, c;
    if (height * height * S->n_supers <= most) { /* no update matrix is larger */
        return 0;
    }
    for (s = 1; s < S->n_supers && sum <= most; s++) {
        sum = 0.0;
        for (c = s - 1; c >= low[s] && low[s - 1] > low[s]; c = low[c] - 1) {
            sum += sli_is_plain(S, c) ? 0.0 : (double)sli_update_size(&S->steps[c]);
        }
    }
    return sum > most;
}

/* Chooses the method. The supernodal one is faster unless update matrices fill the memory. */
static sl_method sli_method(const sl_symbolic *S, const sli_storage_type *type,
                            const sl_options *opt) {
    if (S->n_pairs > 0 || type->storage != SL_STORAGE_DOUBLE) {
        return SL_METHOD_SUPERNODAL; /* only fronts have 2x2 pivots, and L before it is stored */
    }
    if (opt != NULL && opt->method != SL_METHOD_AUTO) {
        return opt->method;
    }
    return sli_updates_exceed(S) ? SL_METHOD_UP_LOOKING : SL_METHOD_SUPERNODAL;
}

SL_API void sl_factor_free(sl_factor *F) {
    if (F != NULL && sli_is_last(&F->borrowers)) {
        const sl_allocator a = F->allocator;
        sli_free(&a, F->history.loss);
        sli_free(&a, F->scratch);
        sli_symbolic_return(F->S);
        sli_free(&a, F);
    }
}

/* Sets the kernels, unless F has them, and the threads of a factor that has its analysis and its
 * method. */
static sl_status sli_factor_use(sl_factor *F, const sl_options *opt) {
    F->schedule.workers = 1;
    if (opt != NULL && F->method == SL_METHOD_SUPERNODAL) {
        F->threads = opt->threads;
        F->schedule.workers = sli_min(sli_workers_for(&opt->threads, sli_schedule_flops(F->S)),
                                      sli_max(F->S->n_supers, 1));
    }
    if (F->kernels == NULL) {
        F->kernels = sli_kernels_select(opt == NULL ? SL_ISA_AUTO : opt->isa);
    }
    if (F->kernels == NULL) {
        return sli_refuse(SL_ERR_UNSUPPORTED, "options.isa is not that of this processor");
    }
    F->stats.factor.isa = F->kernels->isa;
    F->stats.factor.method = F->method;
    F->own = F->type->kernels(F->kernels);
    if (F->own.sweeps == NULL) { /* a saved factor, whose L cannot become double */
        return sli_refuse(SL_ERR_UNSUPPORTED, "options.isa has no kernels for L in float");
    }
    F->stats.factor.storage = F->type->storage;
    F->stats.factor.threads = F->schedule.workers;
    return SL_OK;
}

/* The clock for a factorization. */
SLI_INLINE double sli_factor_clock(const sl_symbolic *S) {
    return sli_seconds_for(S->panel_begin[S->n_supers]);
}

/* Clears what is between a panel of one column and the next panel: it is saved with L. */
static void sli_factor_clear_gaps(sl_factor *F) {
    const sli_step *step = F->S->steps, *last = step + F->S->n_supers;
    const sl_off *next = F->S->panel_begin;
    for (; step < last && F->S->widest > 1; step++) {
        const sl_off end = step->panel + 1 + step->below;
        next++;
        if (step->width == 1 && end < *next) {
            memset((char *)F->values + (size_t)end * F->type->value_bytes, 0,
                   (size_t)(*next - end) * F->type->value_bytes);
        }
    }
}

/* Creates a factor with its memory and its schedule, but without numbers. kernels: NULL: those of
 * the options, which take as long to choose under a hypervisor as a factor of 100 rows. */
static sl_status sli_factor_new(sl_factor **out, const sl_symbolic *S, const sl_options *opt,
                                const sli_kernels *kernels, sl_stats *stats) {
    const double started = sli_factor_clock(S);
    const sl_allocator a = sli_allocator(opt);
    const char *missing;
    sl_factor draft;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sli_clear(&draft, sizeof draft);
    draft.allocator = a;
    draft.S = S;
    draft.kernels =
        kernels != NULL ? kernels : sli_kernels_select(opt == NULL ? SL_ISA_AUTO : opt->isa);
    draft.type = sli_storage_type_of(opt == NULL ? SL_STORAGE_DOUBLE : opt->storage);
    if (draft.type == NULL) {                               /* untested: all packs are there */
        return sli_refuse(SL_ERR_UNSUPPORTED,               /* untested: the same */
                          sli_storage_needs(opt->storage)); /* untested: the same */
    }
    if (draft.kernels != NULL && draft.type->kernels(draft.kernels).sweeps == NULL) {
        draft.type = draft.type->in_double;
    }
    missing = sli_singular_missing(opt);
    if (missing != NULL) {                              /* untested: null spaces are there */
        return sli_refuse(SL_ERR_UNSUPPORTED, missing); /* untested: the same */
    }
    sli_factor_rules(&draft, opt);
    draft.method = sli_method(S, draft.type, opt);
    status =
        S->is_pivoted && sli_skips_nulls(&draft)
            ? sli_refuse(SL_ERR_UNSUPPORTED, "SL_PIVOTS_SKIP_NULL with an analysis for 2x2 pivots")
        : draft.type->suits != NULL ? draft.type->suits(&draft)
                                    : SL_OK;
    status = status == SL_OK ? sli_factor_use(&draft, opt) : status;
    SLI_LAYOUT(&b, &a, status) {
        (void)sli_take(&b, 1, sizeof(sl_factor));
        sli_factor_layout(&draft, &b, draft.null.is_centered);
        draft.stats.factor.bytes = b.used;
    }
    sli_populate(&a, &b);
    if (status == SL_OK) {
        sl_factor *F = (sl_factor *)(void *)b.base;
        sli_copy(F, &draft, sizeof draft);
        sli_borrow(&S->borrowers);
        sli_factor_clear_gaps(F);
        if (F->E != NULL) {
            SLI_ZERO(F->E, S->n);
        }
        status = sli_factor_prepare(F, 1);
        sli_clear(F->extents, (size_t)S->n_supers * sizeof *F->extents);
        status = status == SL_OK ? sli_factor_rules_fill(F, opt, stats) : status;
        F->stats.factor.seconds_setup = sli_factor_clock(S) - started;
        if (status == SL_OK) {
            *out = F;
        } else {
            sl_factor_free(F);
        }
    }
    return status;
}

#endif
