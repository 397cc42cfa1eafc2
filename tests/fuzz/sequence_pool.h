/* sequence_pool.h: the objects of fuzz_sequence.c, what a dense model knows of each, and values for
 * them from the bytes of an input */
#ifndef SL_FUZZ_SEQUENCE_POOL_H
#define SL_FUZZ_SEQUENCE_POOL_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "sparse_local.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

enum { MOST = 12, ENTRIES = MOST * MOST, RHS = 9, SET = 2 * MOST };
enum { ANALYSES = 2, FACTORS = 3, PLANS = 3, SELECTED = 2, REGIONS = 2, REQUESTS = 3 };

typedef struct input_t {
    const uint8_t *at, *end;
} input_t;

static int take(input_t *in) {
    return in->at < in->end ? *in->at++ : 0;
}

/* ---- the pool: objects, and what the dense model knows of each ---- */

/* DOMINANT: strictly diagonally dominant, pivots of both signs. LAPLACIAN: null pivots are skipped.
 * WILD: anything, also values that are not finite; only equalities of bits are checked. RIGID: of
 * triangles, with the null vectors 1 and i in each component, of which there are two unless the
 * component is a single row; null pivots are skipped. */
typedef enum kind_t { DOMINANT = 0, LAPLACIAN, WILD, RIGID } kind_t;

enum { COLUMNS = 8 }; /* of null vectors: two for each component of 3 rows and more */

typedef struct analysis_t {
    sl_symbolic *S;
    sl_int n, p[MOST + 1], i[ENTRIES];
} analysis_t;

typedef struct values_t {
    kind_t kind;
    double x[ENTRIES]; /* in the order of the analyzed pattern */
    double a[ENTRIES]; /* dense, a[i + MOST * j] */
} values_t;

typedef struct factor_t {
    sl_factor *F;
    int analysis;
    int is_valid; /* it has numbers, those of v */
    int has_mass;
    int has_columns; /* it was given COLUMNS null vectors */
    int is_float;
    double mass[MOST];
    values_t v;
} factor_t;

/* Rows of a set; NULL is passed if it is all of them. */
typedef struct set_t {
    sl_int count, rows[SET];
    int is_all;
} set_t;

typedef struct plan_t {
    sl_plan *P;
    int analysis;
    int region; /* -1: solves go to the roots */
    set_t b, x;
} plan_t;

typedef struct selected_t {
    sl_selected *Z;
    int analysis;
    int is_float;      /* its factor */
    double a[ENTRIES]; /* the matrix that it is of; it may outlive its factor */
} selected_t;

typedef struct region_t {
    sl_region *R;
    int analysis, factor;
    double a[ENTRIES];
} region_t;

static analysis_t analyses[ANALYSES];
static factor_t factors[FACTORS];
static plan_t plans[PLANS];
static selected_t selected[SELECTED];
static region_t regions[REGIONS];
static sl_work *work;

/* ---- memory: after `left` more allocations all fail, until the call ends ---- */

static long blocks;    /* allocated now */
static long left;      /* negative: no allocation fails */
static int has_failed; /* an allocation of this call failed */

static void *allocate(void *context, size_t bytes) {
    (void)context;
    if (left == 0) {
        has_failed = 1;
        return NULL;
    }
    left -= left > 0;
    void *block = malloc(bytes > 0 ? bytes : 1);
    blocks += block != NULL;
    return block;
}

static void release(void *context, void *block) {
    (void)context;
    blocks--;
    free(block);
}

/* Returns whether a call failed for lack of memory, which it may only if an allocation failed. */
static int no_memory(sl_status status) {
    PROMISE(status != SL_ERR_MEMORY || has_failed);
    return status == SL_ERR_MEMORY;
}

/* Were objects refused that do not belong together, or whose numbers do not? */
static int is_apart(sl_status status) {
    return status == SL_ERR_MISMATCH || status == SL_ERR_STALE;
}

static void run_backwards(void *context, sl_int count, void (*body)(void *data, sl_int k),
                          void *data) {
    (void)context;
    for (sl_int k = count - 1; k >= 0; k--) {
        body(data, k);
    }
}

static sl_options options(void) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.allocator.allocate = allocate;
    opt.allocator.release = release;
    return opt;
}

static sl_options threaded(int count) {
    sl_options opt = options();
    opt.threads.count = count;
    opt.threads.run = run_backwards;
    return opt;
}

/* ---- releasing: what borrows an object goes before it ---- */

static void free_plan(plan_t *p) {
    sl_plan_free(p->P);
    p->P = NULL;
}

static void free_region(int which) {
    for (int k = 0; k < PLANS; k++) {
        if (plans[k].P && plans[k].region == which) {
            free_plan(&plans[k]);
        }
    }
    sl_region_free(regions[which].R);
    regions[which].R = NULL;
}

static void free_selected(selected_t *z) {
    sl_selected_free(z->Z);
    z->Z = NULL;
}

static void free_factor(int which) {
    for (int k = 0; k < REGIONS; k++) {
        if (regions[k].factor == which) {
            free_region(k);
        }
    }
    sl_factor_free(factors[which].F);
    factors[which].F = NULL;
}

static void free_analysis(int which) {
    for (int k = 0; k < FACTORS; k++) {
        if (factors[k].analysis == which) {
            free_factor(k);
        }
    }
    for (int k = 0; k < PLANS; k++) {
        if (plans[k].analysis == which) {
            free_plan(&plans[k]);
        }
    }
    for (int k = 0; k < REGIONS; k++) {
        if (regions[k].analysis == which) {
            free_region(k);
        }
    }
    for (int k = 0; k < SELECTED; k++) {
        if (selected[k].analysis == which) {
            free_selected(&selected[k]);
        }
    }
    sl_symbolic_free(analyses[which].S);
    analyses[which].S = NULL;
}

#endif
