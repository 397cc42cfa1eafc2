/* alloc.h: the allocator: 64-byte aligned blocks, cut into arrays with overflow checks */
#ifndef SLI_BASE_ALLOC_H
#define SLI_BASE_ALLOC_H

#include "options.h"
#include "status.h"

#define SLI_ALIGN ((size_t)64) /* a cache line, and the widest register */

/* Blocks of at least this size ask the system for huge pages. With a factor of 34 to 410 MB, full
 * solves took 20 to 23 % less time, refactorizations 3 %. */
#define SLI_HUGE_BLOCK ((size_t)4 << 20)
#define SLI_PAGE ((size_t)65536) /* a multiple of the page sizes of systems */
#define SLI_SMALL_PAGE ((size_t)4096)

#if defined(SLI_HUGE_PAGES)
/* A block that does not get what it is advised for works as well. errno is unchanged. */
SLI_INLINE void sli_advise(void *block, size_t bytes, int advice) {
    const int keep = errno;
    (void)sli_madvise(block, bytes, advice);
    errno = keep;
}
#endif

/* Asks for huge pages. */
SLI_INLINE void sli_advise_huge_pages(void *block, size_t bytes) {
#if defined(SLI_HUGE_PAGES)
    if (block != NULL && bytes >= SLI_HUGE_BLOCK) { /* untested: memory that ends */
        const size_t skipped = (SLI_PAGE - (uintptr_t)block % SLI_PAGE) % SLI_PAGE;
        sli_advise((char *)block + skipped, (bytes - skipped) / SLI_PAGE * SLI_PAGE,
                   SLI_HUGE_PAGES);
    }
#else
    (void)block;
    (void)bytes;
#endif
}

SLI_INLINE void *sli_malloc_default(void *context, size_t bytes) {
    void *block = malloc(bytes);
    (void)context;
    sli_advise_huge_pages(block, bytes);
    return block;
}

SLI_INLINE void sli_free_default(void *context, void *block) {
    (void)context;
    free(block);
}

/* The caller's allocator; by default malloc and free. */
SLI_NOINLINE static sl_allocator sli_allocator(const sl_options *opt) {
    sl_allocator a;
    if (opt != NULL && opt->allocator.allocate != NULL && opt->allocator.release != NULL) {
        return opt->allocator;
    }
    a.allocate = sli_malloc_default;
    a.release = sli_free_default;
    a.context = NULL;
    return a;
}

/* Default options with the allocator a. */
SLI_NOINLINE static sl_options sli_options_with(const sl_allocator *a) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.allocator = *a;
    return opt;
}

/* Returns bytes > 0 of aligned memory, or NULL. The pointer from the allocator is stored just
 * before the block. */
SLI_INLINE void *sli_alloc(const sl_allocator *a, size_t bytes) {
    unsigned char *raw, *block;
    if (bytes > SIZE_MAX - SLI_ALIGN - sizeof(void *)) {
        return NULL;
    }
    raw = (unsigned char *)a->allocate(a->context, bytes + SLI_ALIGN + sizeof(void *));
    if (raw == NULL) {
        return NULL;
    }
    block = raw + sizeof(void *);
    block += (SLI_ALIGN - (size_t)((uintptr_t)block % SLI_ALIGN)) % SLI_ALIGN;
    memcpy(block - sizeof(void *), &raw, sizeof(void *));
    return block;
}

SLI_NOINLINE static void sli_free(const sl_allocator *a, void *block) {
    void *raw;
    if (block != NULL) {
        memcpy(&raw, (unsigned char *)block - sizeof(void *), sizeof(void *));
        a->release(a->context, raw);
    }
}

/* A block that is cut into arrays. A layout function runs twice over it: with base NULL it only
 * counts, with the allocated block it returns the pointers. So every size is written once. If sizes
 * overflow, used becomes SIZE_MAX, which sli_work_grow refuses; sli_block_alloc refuses what is no
 * multiple of SLI_ALIGN. */
typedef struct sli_block {
    unsigned char *base;
    size_t used;
} sli_block;

/* The next array of count elements of size bytes; NULL while counting. count has 64 bits because
 * the counts of L may pass 2^32 where size_t has 32 bits. */
SLI_INLINE void *sli_take_inline(sli_block *b, uint64_t count, size_t size) {
    const size_t at = b->used, half = SIZE_MAX >> (4 * sizeof(size_t));
    size_t bytes = SIZE_MAX;
    if (count < half || /* the usual case needs no division; sizes are those of types */
        count <= (SIZE_MAX - SLI_ALIGN) / size) {
        bytes = ((size_t)count * size + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
    }
    if (bytes > SIZE_MAX - at) {
        b->used = SIZE_MAX;
        return NULL;
    }
    b->used += bytes;
    return b->base == NULL ? NULL : b->base + at;
}

/* The same as one function. It is called in 500 places: inlined, they were 25 kB of the object. */
SLI_AT_LINE SLI_NOINLINE static void *sli_take(sli_block *b, uint64_t count, size_t size) {
    void *array = sli_take_inline(b, count, size);
    b->used = b->used > SIZE_MAX / 2 ? SIZE_MAX : b->used; /* sli_cut may follow */
    return array;
}

/* Allocates what was counted and rewinds for the second run. At least one byte is allocated, so
 * that NULL means failure. */
SLI_NOINLINE static sl_status sli_block_alloc(sli_block *b, const sl_allocator *a) {
    if (b->used % SLI_ALIGN != 0) {
        return sli_refuse(SL_ERR_TOO_LARGE, "more memory than size_t counts");
    }
    b->base = (unsigned char *)sli_alloc(a, b->used > 0 ? b->used : 1);
    if (b->base == NULL) {
        return sli_no_memory();
    }
    b->used = 0;
    return SL_OK;
}

/* Asks for the pages of a block at once, not one by one as they are touched, if all will be, they
 * are many, and malloc has just got them from the system: it then begins so many bytes into a page,
 * as one in 64 of the others does. First factors of 3,000 to 10,000 rows take 0.9 of the time. In
 * memory that is used again it would cost 3 percent, and huge pages do not need it. */
SLI_INLINE void sli_populate(const sl_allocator *a, const sli_block *b) {
#if defined(SLI_POPULATE)
    if (b->base != NULL && a->allocate == sli_malloc_default && b->used >= SLI_PAGE &&
        b->used < SLI_HUGE_BLOCK && (uintptr_t)b->base % SLI_SMALL_PAGE == SLI_ALIGN) {
        sli_advise(b->base - SLI_ALIGN, b->used, SLI_POPULATE);
    }
#else
    (void)a;
    (void)b;
#endif
}

/* The header of a loop over a layout, which takes arrays from the block b: it counts, then cuts the
 * memory that was allocated for it. status is SL_OK before the loop; an error ends it. */
#define SLI_LAYOUT(b, a, status) \
    for (int sli_pass = 0; sli_pass < 2 && (status) == SL_OK; \
         (status) = sli_pass++ == 0 ? sli_block_alloc((b), (a)) : SL_OK)

/* The same for memory of one call, of counts with 32 bits: it is in `room`, and is allocated only
 * if that is too small. So one run is enough for a small system. */
#define SLI_LAYOUT_IN(b, a, room, bytes, status) \
    for (int sli_pass = sli_block_begin((b), (room)); sli_pass < 2 && (status) == SL_OK; \
         sli_pass += 1 + ((b)->used <= (bytes) - SLI_ALIGN), \
             (status) = sli_pass == 1 ? sli_block_alloc((b), (a)) : SL_OK)

SLI_INLINE int sli_block_begin(sli_block *b, void *small) {
    b->base = (unsigned char *)small + (SLI_ALIGN - (uintptr_t)small % SLI_ALIGN) % SLI_ALIGN;
    return 0;
}

SLI_INLINE void sli_block_free(const sli_block *b, const sl_allocator *a, const void *small) {
    if ((uintptr_t)b->base - (uintptr_t)small >= SLI_ALIGN) {
        sli_free(a, b->base);
    }
}

/* The next array of count elements of a type. */
#define SLI_TAKE(b, type, count) ((type *)sli_take((b), (uint64_t)(count), sizeof(type)))
/* The same in calls that take a microsecond. */
#define SLI_TAKE_INLINE(b, type, count) \
    ((type *)sli_take_inline((b), (uint64_t)(count), sizeof(type)))

/* The same for blocks of sli_block_alloc that take a microsecond. With 64 bits no sum of such sizes
 * overflows: a count beyond all memory, which one of 32 bits never is, makes `used` odd. */
#if SIZE_MAX > UINT32_MAX
SLI_ALWAYS_INLINE void *sli_cut(sli_block *b, uint64_t count, size_t size, int is_long) {
    const size_t at = b->used;
    const size_t elements = is_long ? count : (uint32_t)count; /* branches untested: a constant */
    b->used += (elements * size + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
    b->used |= elements >> 47 != 0;
    return b->base == NULL ? NULL : b->base + at;
}
#define SLI_CUT(b, type, count) \
    ((type *)sli_cut((b), (uint64_t)(count), sizeof(type), sizeof(count) > 4))
#else
#define SLI_CUT SLI_TAKE
#endif

/* An arena: an allocator that gives the end of a block that its owner does not use yet, and turns
 * to another allocator when that is full. Memory that was just used costs no page faults. What is
 * released in reverse order is given again. For one thread at a time. */
typedef struct sli_arena {
    sl_allocator more;
    unsigned char *base;
    size_t used, size;
} sli_arena;

static void *sli_arena_allocate(void *context, size_t bytes) {
    sli_arena *l = (sli_arena *)context;
    const size_t before = l->used;
    unsigned char *block = l->base + before;
    if (bytes > l->size || l->size - bytes < before + 2 * SLI_ALIGN) {
        return l->more.allocate(l->more.context, bytes);
    }
    memcpy(block, &before, sizeof before);
    l->used = before + SLI_ALIGN + (bytes + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
    memcpy(block + sizeof before, &l->used, sizeof l->used);
    return block + SLI_ALIGN;
}

static void sli_arena_release(void *context, void *block) {
    sli_arena *l = (sli_arena *)context;
    unsigned char *at = (unsigned char *)block;
    size_t end;
    if ((uintptr_t)at - (uintptr_t)l->base >= l->size) {
        l->more.release(l->more.context, block);
        return;
    }
    memcpy(&end, at - SLI_ALIGN + sizeof end, sizeof end);
    if (end == l->used) { /* the last one */
        memcpy(&l->used, at - SLI_ALIGN, sizeof l->used);
    }
}

/* An arena of an allocated block from position `from` on. */
SLI_INLINE sl_allocator sli_arena_start(sli_arena *l, const sli_block *b, size_t from,
                                        const sl_allocator *more) {
    sl_allocator a;
    a.allocate = sli_arena_allocate;
    a.release = sli_arena_release;
    a.context = l;
    l->more = *more;
    l->base = b->base + from;
    l->used = 0;
    l->size = b->used - from;
    return a;
}

#endif
