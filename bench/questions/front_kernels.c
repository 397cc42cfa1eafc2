/* front_kernels.c: how fast are the dense kernels of the factorization, by shape of the front? */
#define SL_STATIC
#include "sparse_local.h" /* with the implementation: this file uses its kernel tables */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Every call works on another front. As many fronts of a shape as fit into ARENA doubles (one,
 * if a front is larger) are filled with different numbers, copied from a master before each
 * round (not timed), and factored one after the other. So data come from the second-level cache,
 * as in a factorization, where a front has just been assembled, and no branch or cache line is
 * met twice in a round. Flops of a front: the sum over its columns of entries^2. */
enum {
    ARENA = 48 * 1024,
    SCRATCH = 8 * 8 * 128, /* sli_front_scratch */
    INVERSE = 3 * 8 * 8,   /* SLI_FRONT_RECIPROCALS; guards detect writes past the scratch */
    GUARDS = 64,
    WIDTHS = 8,
    BELOWS = 6,
    SIZES = 8,
    LAYOUTS = 3,
    MAX_SAMPLES = 2000,
    TILE = 8
};

static const double guard = 1.2345e300;

typedef struct arena {
    size_t size; /* doubles of one item */
    int count;   /* items */
    double *data, *master;
} arena;

/* Allocates with 64-byte alignment, as inside a factor. */
static double *aligned(size_t count) {
    void **raw = bench_alloc(count * sizeof(double) + 128, 1);
    unsigned char *block = (unsigned char *)(raw + 1);
    block += 64 - (uintptr_t)block % 64;
    memcpy(block - sizeof(void *), &raw, sizeof raw);
    return (double *)(void *)block;
}

static void aligned_free(double *block) {
    void **raw;
    memcpy(&raw, (unsigned char *)block - sizeof(void *), sizeof raw);
    free(raw);
}

static arena arena_create(size_t size) {
    arena a;
    a.size = (size + TILE - 1) / TILE * TILE;
    a.count = a.size < ARENA ? (int)(ARENA / a.size) : 1;
    a.data = aligned(a.size * (size_t)a.count);
    a.master = aligned(a.size * (size_t)a.count);
    memset(a.master, 0, a.size * (size_t)a.count * sizeof *a.master);
    return a;
}

static void arena_refill(arena *a) {
    memcpy(a->data, a->master, a->size * (size_t)a->count * sizeof *a->data);
}

static void arena_free(arena *a) {
    aligned_free(a->master);
    aligned_free(a->data);
}

/* ---- fronts ---- */

/* Layout of one item: panel, update matrix, pivots, magnitudes, in this order. */
typedef struct shape {
    sl_int w, u, rows; /* rows: of the tiles */
    size_t panel, update, pivots, magnitudes;
} shape;

static shape shape_of(sl_int w, sl_int u) {
    shape s = {w, u, TILE * sli_tiles(w + u), 0, 0, 0, 0};
    s.panel = (size_t)sli_panel_size(w, u);
    s.update = (size_t)sli_triangle_offset(sli_update_tiles(w, u));
    s.pivots = (size_t)(TILE * sli_tiles(w));
    s.magnitudes = (size_t)s.rows;
    return s;
}

/* Entry (i, j), i >= j >= w, of the update matrix. */
static double update_at(const shape *s, const double *update, sl_int i, sl_int j) {
    const sl_int whole = TILE * (s->w / TILE);
    return update[sli_panel_at(INT32_MAX, i - whole, j - whole)];
}

/* Fills a front that is positive definite: random entries below a dominant diagonal. */
static void fill_front(const shape *s, double *item, uint64_t *rng) {
    double *panel = item, *magnitude = item + s->panel + s->update + s->pivots;
    for (sl_int j = 0; j < s->w; j++) {
        for (sl_int i = j; i < s->w + s->u; i++) {
            panel[sli_panel_at(s->w, i, j)] =
                i == j ? s->w + s->u + bench_random_unit(rng) : bench_random_unit(rng);
        }
        magnitude[j] = fabs(panel[sli_panel_at(s->w, j, j)]);
    }
    bench_random_fill(rng, item + s->panel, s->update);
}

static sli_front front_of(const shape *s, double *item) {
    static double reciprocals[INVERSE];
    static const sli_pivot_rule no_rule; /* all zero: no pivot is replaced */
    sli_front f = {0};
    f.panel = item;
    f.width = s->w;
    f.below = s->u;
    f.update = item + s->panel;
    f.D = f.update + s->update;
    f.magnitude = f.D + s->pivots;
    f.pairs = NULL;
    f.E = NULL;
    f.reciprocals = reciprocals;
    f.rule = &no_rule;
    f.column = 0;
    return f;
}

static void run_front(const sli_kernels *kernels, const shape *s, double *item, double *scratch) {
    const sli_front f = front_of(s, item);
    sli_front_eliminate(&kernels->front, &f, scratch);
    sli_front_update(&kernels->front, &f, scratch);
}

/* Entry (i, j) of A - L D L', from the columns in the panel. */
static double residual_at(const shape *s, const double *before, const double *after, sl_int i,
                          sl_int j) {
    const double *D = after + s->panel + s->update;
    const sl_int last = j < s->w ? j : s->w;
    double sum = 0, unit = j < s->w && i == j ? 1 : 0;
    for (sl_int k = 0; k < last; k++) {
        sum += after[sli_panel_at(s->w, i, k)] * D[k] * after[sli_panel_at(s->w, j, k)];
    }
    if (j < s->w) {
        const double l = unit > 0 ? 1 : after[sli_panel_at(s->w, i, j)];
        return before[sli_panel_at(s->w, i, j)] - sum - l * D[j];
    }
    return update_at(s, before + s->panel, i, j) - sum - update_at(s, after + s->panel, i, j);
}

/* Checks random entries of the last item, and that nothing was written past the scratch. */
static void check_front(bench_run *run, const sli_kernels *kernels, const shape *s, arena *a,
                        double *scratch) {
    const size_t at = a->size * (size_t)(a->count - 1);
    uint64_t rng = 31;
    double worst = 0;
    int guarded = 1;
    for (int k = 0; k < GUARDS; k++) {
        scratch[SCRATCH + k] = guard;
    }
    arena_refill(a);
    run_front(kernels, s, a->data + at, scratch);
    for (int k = 0; k < 500; k++) {
        sl_int i = bench_random_below(&rng, s->w + s->u);
        sl_int j = bench_random_below(&rng, i + 1);
        if (k < s->w) {
            i = j = k;
        }
        worst = fmax(worst, fabs(residual_at(s, a->master + at, a->data + at, i, j)));
    }
    for (int k = 0; k < GUARDS; k++) {
        guarded &= !(scratch[SCRATCH + k] < guard) && !(scratch[SCRATCH + k] > guard);
    }
    bench_expect(run, worst <= 1e-13 * (s->w + s->u + 10) && guarded,
                 "front %d, %d below, %s: A - L D L' is %.2g%s", (int)s->w, (int)s->u,
                 bench_isa_name(kernels->isa), worst, guarded ? "" : ", scratch overrun");
}

typedef struct timing {
    bench_sample sample; /* seconds per call */
    double gflops, share;
} timing;

static timing time_front(bench_run *run, const sli_kernels *kernels, const shape *s) {
    static double times[MAX_SAMPLES];
    timing t;
    double flops = 0, *scratch = aligned(SCRATCH + GUARDS);
    arena a = arena_create(s->panel + s->update + s->pivots + s->magnitudes);
    uint64_t rng = 77;
    for (int k = 0; k < a.count; k++) {
        fill_front(s, a.master + a.size * (size_t)k, &rng);
    }
    check_front(run, kernels, s, &a, scratch);
    for (sl_int k = 0; k < s->w; k++) {
        flops += (double)(s->w + s->u - k) * (s->w + s->u - k);
    }
    const double begin = bench_now();
    int count = 0;
    while (count < MAX_SAMPLES && (count < 3 || bench_now() - begin < run->seconds / 40)) {
        arena_refill(&a);
        const double start = bench_now();
        for (int k = 0; k < a.count; k++) {
            run_front(kernels, s, a.data + a.size * (size_t)k, scratch);
        }
        times[count++] = (bench_now() - start) / a.count;
    }
    t.sample = bench_sample_of(times, count);
    t.gflops = flops / t.sample.median * 1e-9;
    t.share = flops / t.sample.median / bench_peak(kernels->isa);
    arena_free(&a);
    aligned_free(scratch);
    return t;
}

static void front_table(bench_run *run, FILE *csv, const sli_kernels *kernels) {
    static const sl_int widths[WIDTHS] = {4, 8, 16, 32, 64, 128, 256, 512};
    static const sl_int belows[BELOWS] = {0, 8, 32, 128, 512, 1024};
    const char *isa = bench_isa_name(kernels->isa);
    printf("\nfront, %s: GFlop/s and share of the peak %.1f GFlop/s\n", isa,
           bench_peak(kernels->isa) * 1e-9);
    printf("  columns \\ rows below");
    for (int b = 0; b < BELOWS; b++) {
        printf("%7d     ", (int)belows[b]);
    }
    printf("\n");
    for (int c = 0; c < WIDTHS; c++) {
        printf("  %20d", (int)widths[c]);
        for (int b = 0; b < BELOWS; b++) {
            const shape s = shape_of(widths[c], belows[b]);
            if (kernels->isa == SL_ISA_SCALAR && run->size != BENCH_FULL &&
                (double)s.w * (s.w + s.u) * (s.w + s.u) > 1e8) {
                printf("%12s", "-");
                continue;
            }
            const timing t = time_front(run, kernels, &s);
            printf("%7.1f %3.0f%%", t.gflops, 100 * t.share);
            fflush(stdout);
            fprintf(csv, "front,%s,%d,%d,,%d,%.9g,%.9g,%.9g,%.4g,,%.4g\n", isa, (int)s.w, (int)s.u,
                    t.sample.count, t.sample.min, t.sample.median, t.sample.max, t.gflops, t.share);
        }
        printf("\n");
    }
}

/* ---- assemble ---- */

/* Relative indices of a child in a parent of w columns: consecutive from 0, consecutive from 3
 * (not aligned to a tile), or every third row on average. Half of them fall into the panel, half
 * into the update matrix. */
static const char *const layouts[LAYOUTS] = {"dense", "dense, 3 off", "scattered"};

typedef struct child {
    shape from, to;
    sl_int *relative;
} child;

static child child_create(sl_int u, int layout) {
    child c;
    uint64_t rng = 5;
    c.relative = bench_alloc((size_t)u, sizeof *c.relative);
    for (sl_int k = 0; k < u; k++) {
        c.relative[k] = layout == 0 ? k : layout == 1 ? k + 3 : 3 * k + bench_random_below(&rng, 3);
    }
    const sl_int w = c.relative[u / 2], rows = c.relative[u - 1] + 1;
    c.from = shape_of(TILE, u);
    c.to = shape_of(w > 0 ? w : 1, rows - (w > 0 ? w : 1));
    return c;
}

static double *entry_of(const child *c, double *item, sl_int i, sl_int j) {
    const sl_int whole = TILE * (c->to.w / TILE);
    return j < c->to.w ? item + sli_panel_at(c->to.w, i, j)
                       : item + c->to.panel + sli_panel_at(INT32_MAX, i - whole, j - whole);
}

static void run_assemble(const sli_kernels *kernels, const child *c, double *item) {
    const sli_front f = front_of(&c->to, item);
    const double *from = item + c->to.panel + c->to.update;
    kernels->front.assemble(&f, from, c->from.w % TILE, c->relative, c->from.u, 0, c->from.u);
}

static void check_assemble(bench_run *run, const sli_kernels *kernels, const child *c, arena *a) {
    const double *from = a->master + c->to.panel + c->to.update;
    int passed = 1;
    arena_refill(a);
    run_assemble(kernels, c, a->data);
    for (sl_int j = 0; j < c->from.u; j++) {
        for (sl_int i = j; i < c->from.u; i++) {
            const double wanted = *entry_of(c, a->master, c->relative[i], c->relative[j]) +
                                  update_at(&c->from, from, TILE + i, TILE + j);
            const double got = *entry_of(c, a->data, c->relative[i], c->relative[j]);
            passed &= !(got < wanted) && !(got > wanted);
        }
    }
    bench_expect(run, passed, "assembly, %d rows, %s: wrong sums", (int)c->from.u,
                 bench_isa_name(kernels->isa));
}

static timing time_assemble(bench_run *run, const sli_kernels *kernels, const child *c,
                            double *bytes) {
    static double times[MAX_SAMPLES];
    timing t = {{0, 0, 0, 0}, 0, 0};
    arena a = arena_create(c->to.panel + c->to.update + c->from.update);
    uint64_t rng = 8;
    bench_random_fill(&rng, a.master, a.size * (size_t)a.count);
    check_assemble(run, kernels, c, &a);
    const double begin = bench_now();
    int count = 0;
    while (count < MAX_SAMPLES && (count < 3 || bench_now() - begin < run->seconds / 40)) {
        arena_refill(&a);
        const double start = bench_now();
        for (int k = 0; k < a.count; k++) {
            run_assemble(kernels, c, a.data + a.size * (size_t)k);
        }
        times[count++] = (bench_now() - start) / a.count;
    }
    t.sample = bench_sample_of(times, count);
    *bytes = 3 * 8.0 * c->from.u * (c->from.u + 1) / 2; /* child read, parent read and written */
    arena_free(&a);
    return t;
}

static void assemble_table(bench_run *run, FILE *csv, const sli_kernels *kernels) {
    static const sl_int sizes[SIZES] = {8, 16, 32, 64, 128, 256, 512, 1024};
    const char *isa = bench_isa_name(kernels->isa);
    printf("\nassemble, %s: GB/s, counting the child's triangle read and the parent's read and "
           "written\n  child's rows ",
           isa);
    for (int l = 0; l < LAYOUTS; l++) {
        printf("%14s", layouts[l]);
    }
    printf("\n");
    for (int k = 0; k < SIZES; k++) {
        printf("  %12d ", (int)sizes[k]);
        for (int l = 0; l < LAYOUTS; l++) {
            child c = child_create(sizes[k], l);
            double bytes;
            const timing t = time_assemble(run, kernels, &c, &bytes);
            printf("%14.1f", bytes / t.sample.median * 1e-9);
            fprintf(csv, "assemble,%s,%d,%d,%s,%d,%.9g,%.9g,%.9g,,%.4g,\n", isa, (int)c.to.w,
                    (int)sizes[k],
                    l == 0   ? "dense"
                    : l == 1 ? "shifted"
                             : "scattered",
                    t.sample.count, t.sample.min, t.sample.median, t.sample.max,
                    bytes / t.sample.median * 1e-9);
            free(c.relative);
        }
        printf("\n");
        fflush(stdout);
    }
}

void bench_front_kernels(bench_run *run) {
    enum { ISAS_ASKED = 32 };
    char path[512];
    snprintf(path, sizeof path, "%s/front_kernels.csv", run->out_dir);
    FILE *csv = bench_create(path);
    fprintf(csv, "kernel,isa,width,below,layout,count,min_s,median_s,max_s,gflop_per_s,gb_per_s,"
                 "peak_share\n");
    printf("\n== front_kernels: the dense kernels by shape, medians; every call works on another "
           "front, "
           "data in the\n   second-level cache if several fronts fit into %d kB, else one front "
           "refilled before each call\n",
           (int)(ARENA * sizeof(double) / 1024));
    for (int isa = ISAS_ASKED; isa >= SL_ISA_SCALAR; isa--) {
        const sli_kernels *kernels = sli_kernels_select((sl_isa)isa);
        if (kernels) {
            front_table(run, csv, kernels);
            assemble_table(run, csv, kernels);
        }
    }
    bench_close(csv);
}
