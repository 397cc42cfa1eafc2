/* test.h: what every test program includes: cmocka, checks, a failing allocator, error bounds */
#ifndef SL_TEST_H
#define SL_TEST_H

/* cmocka needs these first, in this order. */
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sparse_local.h"

/* ---- statuses ---- */

static inline void test_status(sl_status got, sl_status wanted, const char *call, const char *file,
                               int line) {
    if (got != wanted) {
        print_error("%s\n    gave \"%s\" instead of \"%s\"\n", call, sl_status_string(got),
                    sl_status_string(wanted));
        _fail(file, line);
    }
}

#define SL_CHECK(call) test_status((call), SL_OK, #call, __FILE__, __LINE__)
#define SL_EXPECT(status, call) test_status((call), (status), #call, __FILE__, __LINE__)

/* Skips the test. run.sh prints the reason. */
#define TEST_SKIP(...) \
    do { \
        print_message("skipped: "); \
        print_message(__VA_ARGS__); \
        print_message("\n"); \
        skip(); \
    } while (0)

/* valgrind computes long double as double, and a fused 0 - 1 * 0 as -0 (version 3.19). */
static inline int under_valgrind(void) {
    volatile long double sum = 1.0L;
    sum += LDBL_EPSILON;
    return sum == 1.0L;
}

/* A file that may be written at any time. */
#if defined(_WIN32)
#define NOWHERE "NUL"
#elif defined(__wasi__)
#define NOWHERE "build/nowhere" /* there are no devices */
#else
#define NOWHERE "/dev/null"
#endif

/* Doubles of an array of values in the order of an analysis. */
static inline sl_int scatter_length(const sl_symbolic *S) {
    sl_stats stats;
    stats.symbolic = sl_symbolic_view(S).info;
    return (sl_int)stats.symbolic.nnz_a;
}

/* ---- memory: an allocator that counts, fails on demand and detects writes outside a block ---- */

typedef struct counter_t {
    size_t calls;       /* allocations requested, including the one that fails */
    size_t live_blocks; /* not released yet */
    size_t live_bytes;
    size_t total_bytes; /* sum over all allocations */
    size_t damaged;     /* blocks whose edge was overwritten */
    int64_t fail_at;    /* index of the call that fails, 0-based; -1: none */
} counter_t;

enum { COUNTER_EDGE = 16 };

typedef union counter_head_t {
    size_t bytes;
    unsigned char room[COUNTER_EDGE]; /* keeps the block aligned like malloc */
} counter_head_t;

static inline void *counter_allocate(void *context, size_t bytes) {
    counter_t *c = (counter_t *)context;
    int fails = c->fail_at >= 0 && c->calls == (size_t)c->fail_at;
    c->calls++;
    if (fails || bytes > SIZE_MAX - 2 * COUNTER_EDGE) {
        return NULL;
    }
    unsigned char *raw = (unsigned char *)malloc(bytes + 2 * COUNTER_EDGE);
    if (!raw) {
        return NULL;
    }
    ((counter_head_t *)(void *)raw)->bytes = bytes;
    /* All ones: a double that is read before it is written is a NaN, an index is -1. */
    memset(raw + COUNTER_EDGE, 0xFF, bytes);
    memset(raw + COUNTER_EDGE + bytes, 0xE7, COUNTER_EDGE);
    c->live_blocks++;
    c->live_bytes += bytes;
    c->total_bytes += bytes;
    return raw + COUNTER_EDGE;
}

static inline void counter_release(void *context, void *block) {
    counter_t *c = (counter_t *)context;
    unsigned char *raw = (unsigned char *)block - COUNTER_EDGE;
    size_t bytes = ((counter_head_t *)(void *)raw)->bytes;
    for (size_t k = 0; k < COUNTER_EDGE; k++) {
        if (raw[COUNTER_EDGE + bytes + k] != 0xE7) {
            c->damaged++;
            break;
        }
    }
    c->live_blocks--;
    c->live_bytes -= bytes;
    free(raw);
}

static inline counter_t counter_make(void) {
    counter_t c = {0, 0, 0, 0, 0, -1};
    return c;
}

static inline sl_options options_none(void) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    return opt;
}

static inline sl_options options_counted(counter_t *c) {
    sl_options opt = options_none();
    opt.allocator.allocate = counter_allocate;
    opt.allocator.release = counter_release;
    opt.allocator.context = c;
    return opt;
}

/* An empty workspace whose allocations are counted. Of the allocations from now on, number k
 * fails. */
static inline sl_work *work_failing(counter_t *c, int64_t k) {
    const sl_options opt = options_counted(c);
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, &opt));
    c->fail_at = (int64_t)c->calls + k;
    return W;
}

#define COUNTER_CLEAN(c) \
    do { \
        assert_int_equal((c)->live_blocks, 0); \
        assert_int_equal((c)->live_bytes, 0); \
        assert_int_equal((c)->damaged, 0); \
    } while (0)

/* Memory of the tests themselves; aborts if there is none. */
static inline void *test_array(size_t count, size_t size) {
    void *block = calloc(count ? count : 1, size);
    if (!block) {
        print_error("the test itself is out of memory: %lu x %lu bytes\n", (unsigned long)count,
                    (unsigned long)size);
        abort();
    }
    return block;
}

static inline double *test_reals(size_t count) {
    return (double *)test_array(count, sizeof(double));
}

static inline sl_int *test_ints(size_t count) {
    return (sl_int *)test_array(count, sizeof(sl_int));
}

/* What a call with several threads and no pool gives. */
#if defined(SL_PTHREADS) || defined(_OPENMP)
#define WITHOUT_POOL SL_OK
#else
#define WITHOUT_POOL SL_ERR_UNSUPPORTED
#endif

/* ---- the options that a call reads: under SL_VERIFY it refuses all others ---- */

/* The options for sl_symbolic_create. */
static inline sl_options options_for_analysis(const sl_options *from) {
    sl_options opt = options_none();
    if (from) {
        opt = *from;
        opt.isa = SL_ISA_AUTO;
        opt.method = SL_METHOD_AUTO;
        opt.pivots = SL_PIVOTS_NONZERO;
        opt.null_tolerance = opt.consistency_tolerance = opt.regularization = 0;
        opt.growth_limit = opt.error_limit = 0;
        opt.mass = opt.null_vector = NULL;
        opt.null_vector_count = 0;
        opt.storage = SL_STORAGE_DOUBLE;
        opt.signs = NULL;
    }
    return opt;
}

/* The options for sl_factor_create. */
static inline sl_options options_for_factor(const sl_options *from) {
    sl_options opt = options_none();
    if (from) {
        opt = *from;
        opt.ordering = SL_ORDERING_ND;
        opt.relaxation = SL_RELAXATION_DEFAULT;
        opt.triangle = SL_TRIANGLE_NONE;
        opt.perm = NULL;
        opt.block_size = 0;
        opt.purpose = SL_PURPOSE_MANY_SOLVES;
    }
    return opt;
}

/* The allocator and the threads; region for sl_plan_create, region_bytes for sl_region_create. */
static inline sl_options options_for_rest(const sl_options *from, int plan, int region) {
    sl_options opt = options_none();
    if (from) {
        opt.allocator = from->allocator;
        opt.threads = from->threads;
        opt.region = plan ? from->region : NULL;
        opt.region_bytes = region ? from->region_bytes : 0;
    }
    return opt;
}

#define FOR_PLAN(opt) ((const sl_options[1]){options_for_rest(opt, 1, 0)})
#define FOR_REGION(opt) ((const sl_options[1]){options_for_rest(opt, 0, 1)})
#define FOR_OTHERS(opt) ((const sl_options[1]){options_for_rest(opt, 0, 0)})
#define FOR_ANALYSIS(opt) ((const sl_options[1]){options_for_analysis(opt)})
#define FOR_FACTOR(opt) ((const sl_options[1]){options_for_factor(opt)})

/* ---- orderings ---- */

/* The last value of sl_ordering. */
enum { ORDERING_LAST = SL_ORDERING_MINDEG };

/* Is this an ordering, and compiled in? */
static inline int ordering_is_present(sl_ordering ordering) {
#if !defined(SL_METIS) || defined(SL_NO_METIS)
    return ordering != SL_ORDERING_METIS && ordering != (sl_ordering)2;
#else
    return ordering != (sl_ordering)2;
#endif
}

/* The analysis of A in natural order. */
static inline sl_symbolic *analyze_natural(const sl_csc *A, sl_relaxation relaxation) {
    sl_options opt = options_none();
    sl_symbolic *S = NULL;
    opt.ordering = SL_ORDERING_NATURAL;
    opt.relaxation = relaxation;
    SL_CHECK(sl_symbolic_create(&S, A, &opt, NULL));
    return S;
}

/* ---- instruction sets ---- */

static inline int isa_is_present(sl_isa isa) {
    static const sl_int p[2] = {0, 1}, i[1] = {0};
    static const double x[1] = {2.0};
    const sl_csc one = {1, 1, p, i, x};
    sl_options opt = options_none();
    sl_symbolic *S = analyze_natural(&one, SL_RELAXATION_DEFAULT);
    sl_factor *F = NULL;
    opt.isa = isa;
    sl_status status = sl_factor_create(&F, S, &one, &opt, NULL);
    assert_true(status == SL_OK || status == SL_ERR_UNSUPPORTED);
    assert_true((F != NULL) == (status == SL_OK));
    sl_factor_free(F);
    sl_symbolic_free(S);
    return status == SL_OK;
}

/* Values of sl_isa that are asked for, and at most how many of them a machine has. */
enum { ISAS_ASKED = 32, ISAS_PRESENT = 6 };

typedef struct isa_list_t {
    int count;
    sl_isa isa[ISAS_PRESENT];
} isa_list_t;

/* Those that this machine has, ascending. The first is always scalar, the last the best. */
static inline isa_list_t isas_present(void) {
    isa_list_t list;
    memset(&list, 0, sizeof list);
    for (int isa = SL_ISA_SCALAR; isa < ISAS_ASKED; isa++) {
        if (isa_is_present((sl_isa)isa)) {
            assert_true(list.count < ISAS_PRESENT);
            list.isa[list.count++] = (sl_isa)isa;
        }
    }
    return list;
}

/* The last value of sl_storage, and those that serve any real matrix: the k-th one, in turn. */
enum { STORAGE_LAST = SL_STORAGE_COMPLEX, STORAGES = 2 };
static inline sl_storage storage_at(int k) {
    static const sl_storage real[STORAGES] = {SL_STORAGE_DOUBLE, SL_STORAGE_FLOAT};
    return real[k % STORAGES];
}

/* Does a factor keep L in float or as complex? Beside SIMD, plain C has no kernels for it. */
static inline int isa_keeps_storage(sl_isa isa) {
    return isa != SL_ISA_SCALAR || isas_present().count == 1;
}

/* Those with which it does. */
static inline isa_list_t isas_with_storages(void) {
    isa_list_t list = isas_present();
    if (list.count > 1) {
        list.count--;
        memmove(list.isa, list.isa + 1, (size_t)list.count * sizeof *list.isa);
    }
    return list;
}

/* ---- variants of the factorization: every method with every instruction set ---- */

typedef struct variant_list_t {
    int count;
    struct {
        sl_isa isa;
        sl_method method;
    } variant[2 * ISAS_PRESENT];
} variant_list_t;

static inline variant_list_t variants_present(void) {
    isa_list_t isas = isas_present();
    variant_list_t list;
    memset(&list, 0, sizeof list);
    for (int k = 0; k < isas.count; k++) {
        for (int method = SL_METHOD_UP_LOOKING; method <= SL_METHOD_SUPERNODAL; method++) {
            list.variant[list.count].isa = isas.isa[k];
            list.variant[list.count++].method = (sl_method)method;
        }
    }
    return list;
}

static inline void options_set_variant(sl_options *opt, const variant_list_t *variants, int k) {
    opt->isa = variants->variant[k].isa;
    opt->method = variants->variant[k].method;
}

/* ---- error bounds ---- */

/* A solve passes if ||b - A x|| / (||A|| ||x|| + ||b||) <= PASS_C n eps. The textbook bound for a
 * substitution and a dense LDL' of n columns is a small multiple of n eps times the pivot growth;
 * 10 covers both sweeps and growth near 1. */
#define PASS_C 10.0

static inline double pass_figure(sl_int n) {
    return PASS_C * (n > 0 ? (double)n : 1.0) * DBL_EPSILON;
}

/* Largest backward error of nrhs columns; NaN if one of them is. */
static inline double worst_backward(const sl_csc *A, const double *X, size_t ldx, const double *B,
                                    size_t ldb, sl_int nrhs) {
    size_t n = (size_t)A->n_rows;
    double *R = test_reals(n * (size_t)nrhs), *eta = test_reals((size_t)nrhs), worst = 0.0;
    SL_CHECK(sl_csc_residual(A, R, n ? n : 1, eta, X, ldx, B, ldb, nrhs));
    for (sl_int r = 0; r < nrhs; r++) {
        worst = eta[r] > worst || eta[r] != eta[r] ? eta[r] : worst;
        if (worst != worst) {
            break;
        }
    }
    free(R);
    free(eta);
    return worst;
}

#define BACKWARD_PASSES(A, X, ldx, B, ldb, nrhs) \
    do { \
        double worst_ = worst_backward((A), (X), (ldx), (B), (ldb), (nrhs)); \
        if (!(worst_ <= pass_figure((A)->n_rows))) { \
            print_error("backward error %.3g, allowed %.3g\n", worst_, pass_figure((A)->n_rows)); \
            fail(); \
        } \
    } while (0)

/* Equal values: the same bits, except that zeros of both signs are equal. NaN equals nothing. */
static inline int same_value(double a, double b) {
    return a == b;
}

/* Index of the first difference between two arrays, or -1. */
static inline int64_t first_difference(const double *a, const double *b, size_t count) {
    for (size_t k = 0; k < count; k++) {
        if (!same_value(a[k], b[k])) {
            return (int64_t)k;
        }
    }
    return -1;
}

#define SAME_VALUES(a, b, count) \
    do { \
        int64_t at_ = first_difference((a), (b), (count)); \
        if (at_ >= 0) { \
            print_error("differ at %ld: %.17g and %.17g\n", (long)at_, (a)[at_], (b)[at_]); \
            fail(); \
        } \
    } while (0)

#endif
