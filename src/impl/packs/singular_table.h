/* singular_table.h: null spaces, if they are compiled in */
#ifndef SLI_PACKS_SINGULAR_TABLE_H
#define SLI_PACKS_SINGULAR_TABLE_H

#if defined(SL_NO_SINGULAR)

#include "../factor/null_space.h"

static const sli_singular *sli_singular_of(int skips_nulls) {
    (void)skips_nulls;
    return NULL;
}

static const char *sli_singular_missing(const sl_options *opt) {
    return opt == NULL ? NULL
           : opt->pivots == SL_PIVOTS_SKIP_NULL
               ? "options.pivots = SL_PIVOTS_SKIP_NULL: compiled with SL_NO_SINGULAR"
           : opt->mass != NULL ? "options.mass: compiled with SL_NO_SINGULAR"
           : opt->null_vector != NULL || opt->null_vector_count != 0
               ? "options.null_vector: compiled with SL_NO_SINGULAR"
           : opt->consistency_tolerance != 0.0
               ? "options.consistency_tolerance: compiled with SL_NO_SINGULAR"
               : NULL;
}

#else

#include "../singular/singular.h"

static const sli_singular *sli_singular_of(int skips_nulls) {
    return skips_nulls ? &sli_singular_calls : NULL;
}

static const char *sli_singular_missing(const sl_options *opt) {
    (void)opt;
    return NULL;
}

#endif

#endif
