/* work.h: the workspace: one block of a thread's scratch that only grows */
#ifndef SLI_WORK_H
#define SLI_WORK_H

#include "../public/solve.h"
#include "alloc.h"

struct sl_work {
    sl_allocator allocator;
    void *block; /* size bytes, 64-byte aligned; contents live for one call */
    size_t size;
};

/* At least bytes of scratch; what was in it is lost. */
static sl_status sli_work_grow(sl_work *W, size_t bytes) {
    void *block;
    if (bytes <= W->size) {
        return SL_OK;
    }
    block = sli_alloc(&W->allocator, bytes);
    if (block == NULL) {
        return SL_ERR_MEMORY;
    }
    sli_free(&W->allocator, W->block);
    W->block = block;
    W->size = bytes;
    return SL_OK;
}

/* A workspace for one call: nothing yet, and its block to be released at the end. */
static sl_work sli_work_own(const sl_allocator *a) {
    sl_work own;
    own.allocator = *a;
    own.block = NULL;
    own.size = 0;
    return own;
}

/* The base of W, grown to what a layout has counted, for its second run. */
static sl_status sli_work_lay(sl_work *W, sli_block *b) {
    const sl_status status = b->overflow ? SL_ERR_TOO_LARGE : sli_work_grow(W, b->used);
    b->base = (unsigned char *)W->block;
    b->used = 0;
    return status;
}

/* A stage of a call on a workspace: lays its arrays out, then fills them; what q holds after the stages before it
 * tells how large they are. */
typedef struct sli_stage {
    void (*lay)(void *q, sli_block *b);
    void (*fill)(void *q); /* or NULL */
} sli_stage;

/* Runs stages. Where W is too small for one it grows, which loses what is in it, and they begin anew: none may write
 * to the caller's arrays. */
static sl_status sli_work_stages(sl_work *W, const sli_stage *stages, int count, void *q) {
    sli_block b = {(unsigned char *)W->block, 0, 0};
    int k = 0;
    while (k < count) {
        sli_block trial = {NULL, b.used, 0};
        stages[k].lay(q, &trial);
        if (trial.overflow) {
            return SL_ERR_TOO_LARGE;
        }
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
        stages[k].lay(q, &b);
        if (stages[k].fill != NULL) {
            stages[k].fill(q);
        }
        k++;
    }
    return SL_OK;
}

SL_API sl_status sl_work_create(sl_work **out, const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (!sli_allocator_is_whole(opt)) {
        return SL_ERR_ARGUMENT;
    }
    *out = (sl_work *)sli_alloc(&a, sizeof(sl_work));
    if (*out == NULL) {
        return SL_ERR_MEMORY;
    }
    **out = sli_work_own(&a);
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

#endif
