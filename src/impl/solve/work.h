/* work.h: the workspace: one block of scratch memory that only grows */
#ifndef SLI_SOLVE_WORK_H
#define SLI_SOLVE_WORK_H

#include "../../public/solve.h"
#include "../base/alloc.h"

struct sl_work {
    sl_allocator allocator;
    sl_threads threads; /* of full solves */
    void *block;        /* size bytes, 64-byte aligned; contents live for one call */
    size_t size;
};

SLI_NOINLINE static sl_status sli_work_enlarge(sl_work *W, size_t bytes) {
    void *block = sli_alloc(&W->allocator, bytes);
    if (block == NULL) {
        return bytes == SIZE_MAX
                   ? sli_refuse(SL_ERR_TOO_LARGE, "the workspace exceeds what size_t counts")
                   : sli_no_memory();
    }
    sli_free(&W->allocator, W->block);
    W->block = block;
    W->size = bytes;
    return SL_OK;
}

/* Grows W to at least `bytes`, SIZE_MAX if sizes overflowed. Growing discards the contents. */
SLI_INLINE sl_status sli_work_grow(sl_work *W, size_t bytes) {
    return bytes <= W->size ? SL_OK : sli_work_enlarge(W, bytes);
}

/* An empty workspace for one call. The caller releases its block. */
SLI_NOINLINE static sl_work sli_work_own(const sl_allocator *a) {
    sl_work own;
    memset(&own, 0, sizeof own);
    own.allocator = *a;
    return own;
}

/* Grows W to what the layout in b has counted, and rewinds b to W's memory for the second run. */
SLI_NOINLINE static sl_status sli_work_block(sl_work *W, sli_block *b) {
    const sl_status status = sli_work_grow(W, b->used);
    b->base = (unsigned char *)W->block;
    b->used = 0;
    return status;
}

/* A stage of a call on a workspace: lays out its arrays, then fills them. What the earlier stages
 * left in q determines the sizes. */
typedef struct sli_stage {
    void (*layout)(void *q, sli_block *b);
    void (*fill)(void *q); /* or NULL */
} sli_stage;

/* Runs the stages in order. If W has to grow for one, its contents are lost and all stages start
 * over, so none may write to the caller's arrays. */
static sl_status sli_work_stages(sl_work *W, const sli_stage *stages, int count, void *q) {
    sli_block b = {(unsigned char *)W->block, 0};
    int k = 0;
    while (k < count) {
        sli_block trial = {NULL, b.used};
        stages[k].layout(q, &trial);
        if (trial.used > W->size) {
            const sl_status status = sli_work_grow(W, trial.used);
            if (status != SL_OK) {
                return status;
            }
            b.base = (unsigned char *)W->block;
            b.used = 0;
            k = 0;
            continue;
        }
        stages[k].layout(q, &b);
        if (stages[k].fill != NULL) {
            stages[k].fill(q);
        }
        k++;
    }
    return SL_OK;
}

SL_API sl_status sl_work_create(sl_work **out, const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sl_status status = sli_begin(out);
    status = status == SL_OK ? sli_argument(sli_options_wrong(opt, SLI_READS_NOTHING)) : status;
    if (status != SL_OK) {
        return status;
    }
    *out = (sl_work *)sli_alloc(&a, sizeof(sl_work));
    if (*out == NULL) {
        return sli_no_memory();
    }
    **out = sli_work_own(&a);
    if (opt != NULL) {
        (*out)->threads = opt->threads;
    }
    return SL_OK;
}

SL_API void sl_work_free(sl_work *W) {
    if (W != NULL) {
        const sl_allocator a = W->allocator;
        sli_free(&a, W->block);
        sli_free(&a, W);
    }
}

SL_API size_t sl_work_bytes(const sl_work *W) {
    return W == NULL ? 0 : W->size;
}

SL_API sl_status sl_work_reserve(sl_work *W, size_t bytes) {
    return W == NULL ? sli_argument("W is NULL") : sli_work_grow(W, bytes);
}

#endif
