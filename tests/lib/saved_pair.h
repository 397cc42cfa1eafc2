/* saved_pair.h: an analysis and a factor, saved and loaded as two pointers */
#ifndef SL_TEST_SAVED_PAIR_H
#define SL_TEST_SAVED_PAIR_H

#include "sparse_local.h"

#include <stdint.h>
#include <string.h>

/* The set of both. It is only read. */
static inline sl_saved_set pair_set(const sl_symbolic *S, const sl_factor *F) {
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    set.symbolic = (sl_symbolic *)(uintptr_t)S;
    set.factor = (sl_factor *)(uintptr_t)F;
    return set;
}

static inline sl_status pair_save_memory(void *memory, size_t *bytes, const sl_symbolic *S,
                                         const sl_factor *F) {
    const sl_saved_set set = pair_set(S, F);
    return sl_save(NULL, memory, bytes, &set, NULL);
}

static inline sl_status pair_save_file(const char *path, const sl_symbolic *S, const sl_factor *F,
                                       const sl_options *opt) {
    const sl_saved_set set = pair_set(S, F);
    return sl_save(path, NULL, NULL, &set, opt);
}

/* The set of a load of both or, if F is NULL, of the analysis. */
static inline sl_saved_set pair_wanted(sl_factor **F) {
    sl_saved_set set = pair_set(NULL, NULL);
    set.wanted = F != NULL ? SL_SAVED_FACTOR : SL_SAVED_ANALYSIS;
    return set;
}

/* Hands out what was loaded: NULL on error. */
static inline sl_status pair_take(sl_symbolic **S, sl_factor **F, const sl_saved_set *set,
                                  sl_status status) {
    *S = set->symbolic;
    if (F != NULL) {
        *F = set->factor;
    }
    return status;
}

static inline sl_status pair_load_memory(sl_symbolic **S, sl_factor **F, const void *memory,
                                         size_t bytes, unsigned checks, const sl_options *opt) {
    sl_saved_set set = pair_wanted(F);
    const sl_status status = sl_load(&set, NULL, memory, bytes, checks, opt);
    return pair_take(S, F, &set, status);
}

static inline sl_status pair_map_memory(sl_symbolic **S, sl_factor **F, const void *memory,
                                        size_t bytes, unsigned checks, const sl_options *opt) {
    sl_saved_set set = pair_wanted(F);
    const sl_status status = sl_load(&set, NULL, memory, bytes, checks | SL_LOAD_MAPPED, opt);
    return pair_take(S, F, &set, status);
}

static inline sl_status pair_load_file(sl_symbolic **S, sl_factor **F, const char *path,
                                       unsigned checks, const sl_options *opt) {
    sl_saved_set set = pair_wanted(F);
    const sl_status status = sl_load(&set, path, NULL, 0, checks, opt);
    return pair_take(S, F, &set, status);
}

static inline sl_status pair_map_file(sl_symbolic **S, sl_factor **F, const char *path,
                                      unsigned checks, const sl_options *opt) {
    sl_saved_set set = pair_wanted(F);
    const sl_status status = sl_load(&set, path, NULL, 0, checks | SL_LOAD_MAPPED, opt);
    return pair_take(S, F, &set, status);
}

#endif
