/* solve_case.h: what fuzz_solve.c takes from an input: a matrix, options, sets and values */
#ifndef SL_FUZZ_SOLVE_CASE_H
#define SL_FUZZ_SOLVE_CASE_H

#include <stdint.h>
#include <string.h>

#include "sparse_local.h"

/* Sizes are small so that runs are short: two tiles of 8 rows, two blocks of 8 right-hand sides. */
enum { MOST = 16, ENTRIES = 128, RHS = 9 };

/* What a run does, chosen by the last byte of the input: full and local solves with one factor, and
 * one kind of further calls. A run of everything would take five times as long and find no more:
 * most combinations of inputs and parts are independent. */
typedef enum stage_t { FIRST, REFACTORED, CHANGED, STAGES } stage_t;
typedef enum part_t {
    SOLVES,
    SHOT,
    REFINED_SHOT,
    IN_REGION,
    IN_SMALL_REGION,
    REFINE,
    CONDITION,
    DEFECTS,
    CONVERT,
    EDIT,
    PARTS
} part_t;

typedef struct input_t {
    const uint8_t *at, *end;
} input_t;

static int take(input_t *in) {
    return in->at < in->end ? *in->at++ : 0;
}

/* a row in 0..n-1, occasionally one just outside */
static sl_int take_row(input_t *in, sl_int n) {
    const int byte = take(in);
    return byte == 255 ? n : byte == 254 ? -1 : n > 0 ? byte % n : 0;
}

/* Small integers and eighths, so that exact cancellation is frequent, with some extreme values. */
static double take_value(input_t *in) {
    static const double odd[8] = {1e300, -1e300, 1e-300, 0.0, 1.0 / 3.0, 5e-324, -1.0, 1e16};
    const int byte = take(in);
    return byte >= 248 ? odd[byte - 248] : (byte - 120) / 8.0;
}

typedef struct case_t {
    sl_csc A;
    sl_int p[MOST + 1], i[ENTRIES], perm[MOST], bset[MOST], xset[MOST];
    sl_int signs[MOST];
    double x[ENTRIES], B[MOST * RHS], full[MOST * RHS], X[MOST * RHS], mass[MOST];
    double vectors[2 * MOST];
    sl_int nb, nx, nrhs;
    stage_t stage;
    part_t part;
    sl_options for_analysis, for_factor;
} case_t;

static void take_matrix(case_t *c, input_t *in) {
    const int form = take(in);
    const int size = take(in);
    const sl_int n = size < 128 ? size % 9 : size % (MOST + 1); /* often one tile */
    sl_off stored = 0;
    c->A.n_rows = form & 1 ? n : n + (form & 2 ? 1 : 0);
    c->A.n_cols = n;
    c->p[0] = form >= 250 ? -1 : 0;
    for (sl_int j = 0; j < n; j++) {
        const sl_int count = take(in) % 8;
        /* A strong diagonal, so that factorizations often succeed. */
        if (form & 4 && stored < ENTRIES) {
            c->i[stored] = j;
            c->x[stored++] = (take(in) % 2 ? 1 : -1) * (40.0 + j);
        }
        for (sl_int k = 0; k < count && stored < ENTRIES; k++) {
            sl_int row = take_row(in, n);
            if (form & 8 && row < j) { /* lower triangle only */
                row = n - 1 - row % (n - j);
            }
            c->i[stored] = row;
            c->x[stored++] = take_value(in);
        }
        c->p[j + 1] = (sl_int)stored;
    }
    /* Column pointers out of order. The last one stays valid because the arrays end there. */
    if (form >= 240 && n > 1) {
        c->p[1 + take(in) % (n - 1)] = take(in) * 8 - 64;
    }
    c->A.p = c->p;
    c->A.i = c->i;
    c->A.x = form & 16 ? NULL : c->x;
}

/* Runs the tasks one after the other, the last first. */
static void run_backwards(void *context, sl_int count, void (*body)(void *data, sl_int k),
                          void *data) {
    (void)context;
    for (sl_int k = count - 1; k >= 0; k--) {
        body(data, k);
    }
}

/* Options for null pivots: refused, skipped with or without weights, regularized; and whether
 * growth has a limit. */
static void take_null_pivots(case_t *c, input_t *in, int which) {
    const int more = which > 0 ? take(in) : 0;
    if (which == 1) {
        c->for_factor.pivots = SL_PIVOTS_SKIP_NULL;
        c->for_factor.mass = more & 1 ? c->mass : NULL;
        c->for_factor.consistency_tolerance = more & 2 ? -1.0 : more & 4 ? more / 64.0 : 0.0;
        for (sl_int k = 0; more & 1 && k < c->A.n_cols; k++) {
            c->mass[k] = take_value(in);
        }
        if (more & 8) { /* one null vector or two */
            c->for_factor.null_vector = c->vectors;
            c->for_factor.null_vector_count = more / 16 % 3;
            for (sl_int k = 0; k < 2 * c->A.n_cols; k++) {
                c->vectors[k] = k < c->A.n_cols ? 1.0 : take_value(in);
            }
        }
    } else if (which == 2) {
        c->for_factor.regularization = more / 256.0;
        c->for_factor.signs = more & 1 ? c->signs : NULL;
        for (sl_int k = 0; more & 1 && k < c->A.n_cols; k++) {
            c->signs[k] = take(in) % 3 - 1;
        }
    }
    c->for_factor.growth_limit = c->nrhs % 2 ? -1.0 : 0.0;
}

/* How L is kept, which the last byte says: mostly in double. */
static sl_storage storage_of(int last) {
    static const sl_storage storages[4] = {SL_STORAGE_DOUBLE, SL_STORAGE_FLOAT, SL_STORAGE_COMPLEX,
                                           SL_STORAGE_DOUBLE};
    return storages[last / ((int)STAGES * (int)PARTS) % 4];
}

static void take_options(case_t *c, input_t *in) {
    /* CPUID takes as long as a run, so most runs do without. Unsupported ones end early */
    static const sl_isa isas[10] = {SL_ISA_SCALAR, SL_ISA_SCALAR, SL_ISA_AVX2, SL_ISA_AVX512,
                                    SL_ISA_SCALAR, SL_ISA_AUTO,   SL_ISA_AUTO, SL_ISA_NEON,
                                    SL_ISA_NEON,   SL_ISA_AUTO};
    static const sl_ordering orderings[6] = {SL_ORDERING_ND,      SL_ORDERING_METIS,
                                             SL_ORDERING_ND,      SL_ORDERING_GIVEN,
                                             SL_ORDERING_NATURAL, SL_ORDERING_MINDEG};
    const int choices = take(in), more = take(in);
    const sl_int n = c->A.n_cols;
    memset(&c->for_analysis, 0, sizeof c->for_analysis);
    memset(&c->for_factor, 0, sizeof c->for_factor);
    c->for_analysis.ordering = orderings[choices % 6];
    c->for_analysis.relaxation = (sl_relaxation)(choices / 4 % 2);
    c->for_factor.isa = isas[choices / 8 % 5 + (more == 9 ? 5 : 0)];
    c->for_factor.method = (sl_method)(choices / 40 % 3);
    c->for_factor.threads.count = more % 5;
    c->for_factor.threads.run = run_backwards;
    c->for_factor.null_tolerance = more < 64 ? 0.0 : more < 128 ? -1.0 : more / 256.0;
    c->for_analysis.perm = c->perm;
    for (sl_int k = 0; k < n; k++) {
        c->perm[k] = k;
    }
    for (sl_int k = 0; k + 1 < n; k++) {
        const sl_int with = k + take(in) % (n - k), keep = c->perm[k];
        c->perm[k] = c->perm[with];
        c->perm[with] = keep;
    }
    if (more == 7 && n > 0) {
        c->perm[0] = take_row(in, n); /* possibly a row twice */
    }
    c->nb = n > 0 ? take(in) % n : 0;
    c->nx = n > 0 ? take(in) % n : 0;
    c->nrhs = take(in) % (RHS + 1);
    for (sl_int k = 0; k < c->nb; k++) {
        c->bset[k] = more & 1 ? take_row(in, n) : c->perm[k];
    }
    for (sl_int k = 0; k < c->nx; k++) {
        c->xset[k] = more & 2 ? take_row(in, n) : c->perm[n - 1 - k];
    }
    for (sl_int q = 0; q < c->nb * c->nrhs; q++) {
        c->B[q % c->nb + MOST * (q / c->nb)] = take_value(in);
    }
    take_null_pivots(c, in, choices / 120);
}

#endif
