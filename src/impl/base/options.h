/* options.h: initializes options and checks them in every call */
#ifndef SLI_BASE_OPTIONS_H
#define SLI_BASE_OPTIONS_H

#include "../../public/options.h"
#include "base.h"
#include "status.h"

/* Groups of options that a call may read besides the allocator and the threads. */
enum {
    SLI_READS_NOTHING = 0,
    SLI_READS_TRIANGLE = 1,
    SLI_READS_ANALYSIS = 2, /* the ordering and the options that orderings read */
    SLI_READS_FACTOR = 4,
    SLI_READS_REGION = 8,
    SLI_READS_REGION_BYTES = 16,
    SLI_READS_ISA = 32
};

SL_API void sl_options_init(sl_options *opt, size_t size) {
    if (opt != NULL && size >= sizeof opt->size) {
        memset(opt, 0, size);
        opt->size = size;
    }
}

#if defined(SL_VERIFY)
/* The groups in which an option differs from its default. */
static int sli_options_set(const sl_options *opt) {
    const int analysis = opt->ordering != 0 || opt->relaxation != 0 || opt->perm != NULL ||
                         opt->block_size != 0 || opt->purpose != 0;
    const int factor = opt->method != 0 || opt->pivots != 0 || opt->null_tolerance != 0.0 ||
                       opt->mass != NULL || opt->consistency_tolerance != 0.0 ||
                       opt->regularization != 0.0 || opt->signs != NULL ||
                       opt->null_vector != NULL || opt->growth_limit != 0.0 ||
                       opt->error_limit != 0.0 || opt->null_vector_count != 0 || opt->storage != 0;
    return (opt->isa != 0 ? SLI_READS_ISA : 0) | (opt->triangle != 0 ? SLI_READS_TRIANGLE : 0) |
           (analysis ? SLI_READS_ANALYSIS : 0) | (factor ? SLI_READS_FACTOR : 0) |
           (opt->region != NULL ? SLI_READS_REGION : 0) |
           (opt->region_bytes != 0 ? SLI_READS_REGION_BYTES : 0);
}
#endif

/* What is wrong with options, or NULL: the size of the struct, an option unknown to this library,
 * an incomplete allocator, or the number of threads. reads: the groups that the call reads. An
 * option that is set but not read is a mistake of the caller; SL_VERIFY builds refuse it. */
SLI_NOINLINE static const char *sli_options_wrong(const sl_options *opt, int reads) {
    size_t k;
    int is_unknown;
    if (opt == NULL) {
        return NULL;
    }
    is_unknown = 0;
    for (k = 0; k < sizeof opt->reserved / sizeof opt->reserved[0]; k++) {
        is_unknown |= opt->reserved[k] != 0;
    }
    if (opt->size != 0 && opt->size != sizeof *opt) {
        return "options.size is not that of the library: sl_options_init sets it";
    }
    if (is_unknown) {
        return "a reserved field of options is not 0: sl_options_init sets all fields";
    }
#if defined(SL_VERIFY)
    if ((sli_options_set(opt) & ~reads) != 0) {
        return "an option is set that the call does not read";
    }
#else
    (void)reads;
#endif
    if ((opt->allocator.allocate == NULL) != (opt->allocator.release == NULL)) {
        return "options.allocator has only one of its two functions";
    }
#if !defined(SL_PTHREADS) && !defined(_OPENMP)
    if (opt->threads.count > 1 && opt->threads.run == NULL) {
        return sli_needs_threads;
    }
#endif
    return opt->threads.count < 0 ? "options.threads.count is below 0" : NULL;
}

/* The threads of the options; none without options. */
SLI_INLINE const sl_threads *sli_threads_of(const sl_options *opt) {
    static const sl_threads sli_no_threads = {0, NULL, NULL};
    return opt == NULL ? &sli_no_threads : &opt->threads;
}

#endif
