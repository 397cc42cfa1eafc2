/* memory.c: memory that an analysis and a factor keep, and their peak, by a counting allocator */
#include <stdlib.h>
#include <string.h>

#include "bench.h"

typedef struct memory_meter {
    size_t now, peak;
} memory_meter;

enum { HEAD = 16 }; /* a multiple of the alignment of malloc */

static void *meter_allocate(void *context, size_t bytes) {
    memory_meter *m = context;
    unsigned char *block = bytes > SIZE_MAX - HEAD ? NULL : malloc(bytes + HEAD);
    if (!block) {
        return NULL;
    }
    memcpy(block, &bytes, sizeof bytes);
    m->now += bytes;
    m->peak = m->now > m->peak ? m->now : m->peak;
    return block + HEAD;
}

static void meter_release(void *context, void *block) {
    memory_meter *m = context;
    size_t bytes;
    memcpy(&bytes, (unsigned char *)block - HEAD, sizeof bytes);
    m->now -= bytes;
    free((unsigned char *)block - HEAD);
}

bench_memory bench_memory_of(const bench_system *system, sl_options options) {
    memory_meter m = {0, 0};
    bench_memory y;
    sl_symbolic *S;
    sl_factor *F;
    y.panels = 8 * (double)system->stats.symbolic.nnz_panels;
    y.matrix = 12 * (double)system->A.p[system->n] + 4 * (double)system->n;
    options.allocator.allocate = meter_allocate;
    options.allocator.release = meter_release;
    options.allocator.context = &m;
    bench_must(sl_symbolic_create(&S, &system->A, &options, NULL), "analysis");
    y.analysis_peak = (double)m.peak;
    y.analysis = (double)m.now;
    bench_must(sl_factor_create(&F, S, &system->A, &options, NULL), "factor");
    y.factor = (double)m.now - y.analysis;
    y.peak = (double)m.peak;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return y;
}
