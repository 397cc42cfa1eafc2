/* fuzz_solve.c: takes a small matrix (often malformed), options and sets from any bytes and calls
 * with them; local solves must equal full solves */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "sparse_local.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
    TRANSPOSE,
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
        c->for_factor.null_pivots = SL_NULL_PIVOT_SKIP;
        c->for_factor.mass = more & 1 ? c->mass : NULL;
        c->for_factor.consistency_tolerance = more & 2 ? -1.0 : more & 4 ? more / 64.0 : 0.0;
        for (sl_int k = 0; more & 1 && k < c->A.n_cols; k++) {
            c->mass[k] = take_value(in);
        }
        if (more & 8) { /* one null vector or two */
            c->for_factor.null_vector = c->vectors;
            c->for_factor.null_vector_count = (size_t)(more / 16 % 3);
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
    static const sl_storage storages[7] = {
        SL_STORAGE_DOUBLE,       SL_STORAGE_FLOAT,  SL_STORAGE_FLOAT_FRONTS, SL_STORAGE_COMPLEX,
        SL_STORAGE_FLOAT_FRONTS, SL_STORAGE_DOUBLE, SL_STORAGE_DOUBLE};
    return storages[last / ((int)STAGES * (int)PARTS) % 7];
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

/* Puts b on bset, column-major with leading dimension MOST, into all rows and solves in full. */
static sl_status solve_full(case_t *c, const sl_factor *F) {
    memset(c->full, 0, sizeof c->full);
    for (sl_int r = 0; r < c->nrhs; r++) {
        for (sl_int k = 0; k < c->nb; k++) {
            c->full[c->bset[k] + MOST * r] += c->B[k + MOST * r]; /* a row may repeat */
        }
    }
    return sl_factor_solve(F, c->full, MOST, c->full, MOST, c->nrhs, NULL);
}

/* What a solve with good arguments may return: values are wild, and solutions may overflow. */
static int is_answer(sl_status status) {
    return status == SL_OK || status == SL_ERR_INCONSISTENT || status == SL_ERR_NOT_FINITE;
}

/* Calls without a plan, and what they say about the factor. */
static void query(case_t *c, const sl_factor *F, sl_work *W) {
    sl_int count = -1;
    double rcond = -1.0, defects[MOST * RHS];
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    if (c->part == CONDITION) {
        PROMISE(sl_factor_rcond(F, &c->A, &rcond, W) == SL_OK && rcond >= 0.0);
    } else if (c->part == DEFECTS) {
        sl_factor_stats(F, &stats);
        PROMISE(sl_factor_pivot_rows(F, SL_PIVOT_NULL, NULL, NULL, 0, &count) == SL_OK &&
                count == stats.factor.null);
        PROMISE(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, NULL, NULL, 0, &count) == SL_OK);
        PROMISE(count == stats.factor.regularized);
        PROMISE(sl_factor_defects(F, defects, MOST, c->B, MOST, c->nrhs, W) == SL_OK);
    } else if (c->part == REFINE) {
        const sl_status refined =
            sl_factor_refine(F, &c->A, c->full, MOST, c->B, MOST, c->nrhs, 3, W, &stats);
        PROMISE(refined == (stats.refine.backward_error <= 1e-8 ? SL_OK : SL_ERR_INACCURATE));
    }
}

static void compare(const case_t *c) {
    for (sl_int r = 0; r < c->nrhs; r++) {
        for (sl_int k = 0; k < c->nx; k++) {
            const double local = c->X[k + MOST * r], full = c->full[c->xset[k] + MOST * r];
            PROMISE(local == full || (local != local && full != full));
        }
    }
}

/* Solves in a region that holds both sets. Without a boundary it must give the same bits. With a
 * boundary, and with values as extreme as these, it must only return. */
static void solve_in_region(case_t *c, const sl_symbolic *S, const sl_factor *F, sl_status shot,
                            sl_status full, sl_work *W) {
    sl_int set[2 * MOST];
    sl_options opt;
    sl_region *R = NULL;
    sl_plan *P = NULL;
    sl_stats stats;
    const int has_boundary = c->part == IN_REGION;
    memset(&opt, 0, sizeof opt);
    memset(&stats, 0, sizeof stats);
    for (sl_int k = 0; k < c->nb + c->nx; k++) {
        set[k] = k < c->nb ? c->bset[k] : c->xset[k - c->nb];
    }
    opt.region_bytes = has_boundary ? 0 : 1;
    const sl_status status = sl_region_create(&R, F, set, c->nb + c->nx, NULL, &opt, &stats);
    /* solves with weights subtract a mean; beside pivots of both signs digits could be lost */
    PROMISE(status == SL_OK || status == SL_ERR_UNSUPPORTED ||
            (has_boundary && status == SL_ERR_INACCURATE));
    if (status != SL_OK) {
        return;
    }
    PROMISE(has_boundary || stats.region.boundary == 0);
    opt.region_bytes = 0;
    opt.region = R;
    PROMISE(sl_plan_create(&P, S, c->bset, c->nb, c->xset, c->nx, &opt, &stats) == SL_OK);
    PROMISE(stats.plan.in_region == 1);
    memset(c->X, 0, sizeof c->X);
    const sl_status inside = sl_plan_solve(P, F, c->X, MOST, c->B, MOST, c->nrhs, W);
    PROMISE(has_boundary ? is_answer(inside) : inside == shot);
    if (!has_boundary && full == SL_OK) {
        compare(c);
    }
    PROMISE(sl_region_refactor(R, F, NULL, W) == SL_OK);
    PROMISE(sl_plan_solve(P, F, c->X, MOST, c->B, MOST, c->nrhs, W) == inside);
    sl_plan_free(P);
    sl_region_free(R);
}

static void convert(const sl_factor *F) {
    double log_abs_det, sign;
    sl_matrix *L = NULL;
    PROMISE(sl_factor_logdet(F, &log_abs_det, &sign) == SL_OK);
    PROMISE(sl_factor_lower(&L, F, NULL) == SL_OK);
    const sl_csc view = sl_matrix_view(L);
    PROMISE(sl_csc_check(&view, NULL) == SL_OK);
    sl_matrix_free(L);
}

static void solve_parts(case_t *c, const sl_symbolic *S, sl_factor *F) {
    sl_plan *P = NULL;
    sl_work *W = NULL;
    PROMISE(sl_work_create(&W, NULL) == SL_OK);
    const sl_status planned = sl_plan_create(&P, S, c->bset, c->nb, c->xset, c->nx, NULL, NULL);
    PROMISE((P != NULL) == (planned == SL_OK));
    PROMISE(planned == SL_OK || planned == SL_ERR_ARGUMENT);
    if (P == NULL || c->part == SHOT) {
        const sl_status shot = sl_local_solve(F, c->bset, c->nb, c->xset, c->nx, c->X, MOST, c->B,
                                              MOST, c->nrhs, W, NULL);
        PROMISE(planned == shot || (planned == SL_OK && is_answer(shot)));
    }
    if (P) {
        const sl_status full = solve_full(c, F);
        if (full == SL_OK && c->part == SHOT) {
            compare(c);
        }
        memset(c->X, 0, sizeof c->X);
        const sl_status local = sl_plan_solve(P, F, c->X, MOST, c->B, MOST, c->nrhs, W);
        /* with an empty x-set nothing is checked; x may overflow in rows that are not wanted */
        PROMISE(full == local || c->nx == 0 || (full == SL_ERR_NOT_FINITE && local == SL_OK));
        if (full == SL_OK) {
            compare(c);
        }
        if (c->part == REFINED_SHOT) {
            const sl_status refined =
                sl_plan_solve_refined(P, F, c->X, MOST, c->B, MOST, c->nrhs, 3, W, NULL);
            /* a plan that lacks a regularized row is refused before anything is solved */
            PROMISE(refined == local || refined == SL_ERR_ARGUMENT ||
                    (local == SL_OK && (is_answer(refined) || refined == SL_ERR_INACCURATE)));
        }
        if (c->part == IN_REGION || c->part == IN_SMALL_REGION) {
            solve_in_region(c, S, F, local, full, W);
        }
    }
    query(c, F, W);
    if (c->part == CONVERT) {
        convert(F);
    }
    sl_work_free(W);
    sl_plan_free(P);
}

/* The analysis follows an edit: another matrix, in which some of the rows are new. */
static void edit(const case_t *c, const sl_symbolic *S, input_t *in) {
    static case_t only;
    case_t *next = &only;
    sl_symbolic *T = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    sl_int new_of[MOST + 1];
    memset(next, 0, sizeof *next);
    take_matrix(next, in);
    take_options(next, in);
    for (sl_int k = 0; k <= MOST; k++) {
        const int byte = take(in);
        new_of[k] = byte < 128 && k < next->A.n_cols ? k : byte == 200 ? take_row(in, MOST) : -1;
    }
    const sl_status status = sl_symbolic_edit(&T, S, &c->A, &next->A, new_of, NULL, &stats);
    PROMISE((T != NULL) == (status == SL_OK));
    if (T != NULL) {
        PROMISE(sl_csc_check(&next->A, NULL) == SL_OK && stats.symbolic.n == next->A.n_cols);
        if (sl_factor_create(&F, T, &next->A, &next->for_factor, NULL) == SL_OK) {
            next->part = SHOT;
            solve_parts(next, T, F);
        }
    }
    sl_factor_free(F);
    sl_symbolic_free(T);
}

/* Changes the first half of the columns and refactors only their reach. */
static void change_half(case_t *c, const sl_symbolic *S, sl_factor *F, input_t *in) {
    sl_int columns[MOST];
    const sl_int half = c->A.n_cols / 2;
    for (sl_int j = 0; j < half; j++) {
        columns[j] = j;
    }
    for (sl_int q = 0; q < c->p[half]; q++) {
        c->x[q] = take_value(in);
    }
    if (sl_factor_refactor_changed(F, &c->A, columns, half, NULL) == SL_OK) {
        solve_parts(c, S, F);
    }
}

/* New values on the same pattern, which may have no factor. */
static void refactor(case_t *c, const sl_symbolic *S, sl_factor *F, input_t *in) {
    for (sl_int q = 0; q < c->p[c->A.n_cols]; q++) {
        c->x[q] = take_value(in);
    }
    if (sl_factor_refactor(F, &c->A, NULL) != SL_OK) {
        PROMISE(sl_factor_solve(F, c->full, MOST, c->B, MOST, 1, NULL) == SL_ERR_STALE);
        return;
    }
    if (c->stage == REFACTORED) {
        solve_parts(c, S, F);
    } else {
        change_half(c, S, F, in);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    input_t in = {data, data};
    static case_t only;
    case_t *c = &only;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_matrix *T = NULL;
    if (size == 0) {
        return 0;
    }
    in.end = data + size;
    memset(c, 0, sizeof *c); /* a run depends on its input alone */
    c->stage = (stage_t)(data[size - 1] % STAGES);
    c->part = (part_t)(data[size - 1] / STAGES % PARTS);
    take_matrix(c, &in);
    take_options(c, &in);
    c->for_factor.storage = storage_of(data[size - 1]);
    const sl_status good = sl_csc_check(&c->A, NULL);
    if (c->part == TRANSPOSE) {
        PROMISE((sl_matrix_transpose(&T, &c->A, NULL) == SL_OK) == (good == SL_OK));
    }
    const sl_status status = sl_symbolic_create(&S, &c->A, &c->for_analysis, NULL);
    PROMISE((S != NULL) == (status == SL_OK));
    if (S) {
        PROMISE(good == SL_OK && c->A.n_rows == c->A.n_cols);
        if (c->part == EDIT) {
            edit(c, S, &in);
        }
        const sl_status made = sl_factor_create(&F, S, &c->A, &c->for_factor, NULL);
        PROMISE((F != NULL) == (made == SL_OK));
        if (F && c->stage == FIRST) {
            solve_parts(c, S, F);
        } else if (F) {
            refactor(c, S, F, &in);
        }
    }
    sl_matrix_free(T);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return 0;
}
