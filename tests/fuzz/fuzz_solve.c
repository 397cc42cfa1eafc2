/* fuzz_solve.c: takes a small matrix (often malformed), options and sets from any bytes and calls
 * with them; local solves must equal full solves */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "solve_case.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
        stats.factor = sl_factor_view(F).info;
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
                sl_plan_solve_regularized(P, F, c->X, MOST, c->B, MOST, c->nrhs, 3, W, NULL);
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
    if (sl_factor_change_entries(F, &c->A, NULL, columns, NULL, half, NULL, NULL) == SL_OK) {
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
    sl_factor_free(F);
    sl_symbolic_free(S);
    return 0;
}
