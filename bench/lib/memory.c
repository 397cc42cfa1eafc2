/* memory.c: what an analysis and a factor take, and the most that they have at once, by a counting allocator */
#include <stdlib.h>
#include <string.h>

#include "bench.h"

typedef struct meter {
    size_t now, most;
} meter;

enum { HEAD = 16 }; /* keeps malloc's alignment */

static void *meter_allocate(void *context, size_t bytes) {
    meter *m = context;
    unsigned char *block = bytes > SIZE_MAX - HEAD ? NULL : malloc(bytes + HEAD);
    if (!block) {
        return NULL;
    }
    memcpy(block, &bytes, sizeof bytes);
    m->now += bytes;
    m->most = m->now > m->most ? m->now : m->most;
    return block + HEAD;
}

static void meter_release(void *context, void *block) {
    meter *m = context;
    size_t bytes;
    memcpy(&bytes, (unsigned char *)block - HEAD, sizeof bytes);
    m->now -= bytes;
    free((unsigned char *)block - HEAD);
}

bench_memory bench_memory_of(const bench_system *system, sl_options options) {
    meter m = {0, 0};
    bench_memory y;
    sl_symbolic *S;
    sl_factor *F;
    y.panels = 8 * (double)system->stats.nnz_panels;
    y.matrix = 12 * (double)system->A.p[system->n] + 4 * (double)system->n;
    options.allocator.allocate = meter_allocate;
    options.allocator.release = meter_release;
    options.allocator.context = &m;
    bench_must(sl_symbolic_create(&S, &system->A, &options, NULL), "analysis");
    y.analysis_peak = (double)m.most;
    y.analysis = (double)m.now;
    bench_must(sl_factor_create(&F, S, &system->A, &options, NULL), "factor");
    y.factor = (double)m.now - y.analysis;
    y.peak = (double)m.most;
    sl_factor_free(F);
    sl_symbolic_free(S);
    return y;
}
