/* argument_calls.h: every call by one signature, and which arguments it takes */
#ifndef SL_TEST_ARGUMENT_CALLS_H
#define SL_TEST_ARGUMENT_CALLS_H

#include "factored.h"

enum { N = 144, NB = 20, NX = 30, NNZ_MAX = 8 * N };

/* ---- the arguments of all calls, good until one of them is spoiled ---- */

typedef struct arguments_t {
    sl_csc view;
    const sl_csc *A;
    const sl_symbolic *S;
    sl_factor *F;
    const sl_plan *P;
    sl_selected *Z;
    sl_region *R;
    sl_work *W;
    const sl_int *bset, *xset;
    sl_int nb, nx;
    double *X;
    const double *B;
    size_t ldx, ldb;
    sl_int nrhs, steps;
    int has_pins;
    sl_stats stats;
} arguments_t;

/* What the arguments are made of. */
typedef struct objects_t {
    factored_t good, other; /* two analyses of one matrix */
    sl_factor *failed;
    sl_plan *P;
    sl_selected *Z;
    sl_region *R;
    sl_work *W;
    sl_int p[N + 1], i[NNZ_MAX], bset[NB], xset[NX], spoiled[NX], perm[N];
    double X[2 * N], B[2 * N], entries[NNZ_MAX];
} objects_t;

static objects_t *o;

enum {
    A_ = 1,
    S_ = 2,
    F_ = 4,
    FAILED_ = 8, /* a failed factor is refused */
    OTHER_ = 16, /* and so is one of another analysis */
    P_ = 32,
    Z_ = 64,
    R_ = 128,
    W_ = 256,     /* a workspace that must not be NULL */
    BSET_ = 512,  /* nb rows; NULL: all */
    XSET_ = 1024, /* nx rows; NULL: all */
    LIST_ = 2048, /* xset is a list that must not be NULL */
    X_ = 4096,
    LDX_ = 8192,
    B_ = 16384,
    LDB_ = 32768,
    NRHS_ = 65536,
    STEPS_ = 131072,
    SQUARE_ = 262144, /* a matrix that must be square */
    VALUES_ = 524288, /* and one that must have values */
    PINS_ = 1048576,  /* a set of pins */
    SOLVE_ = F_ | FAILED_ | X_ | LDX_ | B_ | LDB_ | NRHS_
};

/* ---- calls ---- */

#define CALL(name, call) \
    static sl_status name(arguments_t *a) { \
        return call; \
    }
#define CREATE(name, type, release, call) \
    static sl_status name(arguments_t *a) { \
        type *out = (type *)(void *)a; /* to see that the call sets it to NULL */ \
        const sl_status status = call; \
        assert_true((out != NULL) == (status == SL_OK)); \
        release(out); \
        return status; \
    }

static sl_status triangle(arguments_t *a) {
    sl_triangle t = SL_TRIANGLE_NONE;
    return sl_csc_triangle(a->A, &t, NULL, &a->stats);
}

static sl_status rcond(arguments_t *a) {
    double r;
    return sl_factor_rcond(a->F, a->A, &r, NULL);
}

static sl_status plan_bounded(arguments_t *a) {
    double bounds[2 * N];
    if (a->F != NULL && a->F == o->good.F) {
        SL_CHECK(sl_factor_certify(a->F, &o->good.M.view, SL_ESTIMATED, NULL, NULL));
    }
    return sl_plan_solve_bounded(a->P, a->F, a->X, a->ldx, bounds, a->B, a->ldb, a->nrhs, NULL,
                                 NULL, &a->stats);
}

static sl_status logdet(arguments_t *a) {
    double log_abs, sign;
    return sl_factor_logdet(a->F, &log_abs, &sign);
}

static sl_status pseudo(arguments_t *a) {
    sl_int component[N];
    double Q[N], K[N];
    sl_pseudo_inverse room = {1, component, Q, K, 0.0};
    return sl_factor_pseudo_inverse(a->F, &room, a->W);
}

static sl_status null_rows(arguments_t *a) {
    sl_int rows[1], count;
    return sl_factor_pivot_rows(a->F, SL_PIVOT_NULL, rows, NULL, 1, &count);
}

/* The set of an analysis and a factor of the arguments. */
static sl_saved_set saved_set(arguments_t *a) {
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    set.symbolic = (sl_symbolic *)(uintptr_t)a->S;
    set.factor = a->F;
    return set;
}

static sl_status save_memory(arguments_t *a) {
    const sl_saved_set set = saved_set(a);
    sl_saved_set good = set;
    size_t bytes = 0;
    good.symbolic = o->good.S;
    good.factor = o->good.F;
    SL_CHECK(sl_save(NULL, NULL, &bytes, &good, NULL));
    void *memory = test_array(bytes, 1);
    const sl_status status = sl_save(NULL, memory, &bytes, &set, NULL);
    free(memory);
    return status;
}

static sl_status save_file(arguments_t *a) {
    const sl_saved_set set = saved_set(a);
    return sl_save(NOWHERE, NULL, NULL, &set, NULL);
}

static sl_status batch_solve(arguments_t *a) {
    sl_request request;
    memset(&request, 0, sizeof request);
    request.X = a->X;
    request.ldx = a->ldx;
    request.B = a->B;
    request.ldb = a->ldb;
    request.nrhs = a->nrhs;
    return sl_batch_solve(a->F, &request, 1, NULL, NULL, NULL);
}

static sl_status restriction(arguments_t *a) {
    sl_symbolic *S = (sl_symbolic *)(void *)a;
    sl_factor *G = (sl_factor *)(void *)a;
    const sl_status status =
        sl_factor_submatrix(&S, &G, a->F, a->A, a->xset, a->nx, NULL, &a->stats);
    assert_true((S != NULL) == (status == SL_OK) && (G != NULL) == (status == SL_OK));
    sl_factor_free(G);
    sl_symbolic_free(S);
    return status;
}

/* A call on a set of so many pins, which the call may change. */
#define ON_PINS(name, count, call) \
    static sl_status name(arguments_t *a) { \
        sl_constraints *pins = a->has_pins ? pins_make(count) : NULL; \
        const sl_status status = call; \
        sl_constraints_free(pins); \
        return status; \
    }

static sl_constraints *pins_make(sl_int count) {
    sl_constraints *pins = NULL;
    SL_CHECK(sl_constraints_create(&pins, o->good.F, NULL));
    for (sl_int row = 0; row < count; row++) {
        SL_CHECK(sl_constraints_add(pins, &row, NULL, 1, NULL));
    }
    return pins;
}

CALL(check, sl_csc_check(a->A, &a->stats))
CALL(refactor, sl_factor_refactor(a->F, a->A, &a->stats))
CALL(changed, sl_factor_change_entries(a->F, a->A, NULL, a->xset, NULL, a->nx, NULL, &a->stats))
CALL(refine,
     sl_factor_refine(a->F, a->A, a->X, a->ldx, a->B, a->ldb, a->nrhs, a->steps, NULL, &a->stats))
CALL(certify, sl_factor_certify(a->F, a->A, SL_ESTIMATED, NULL, &a->stats))
CALL(scatter, sl_symbolic_scatter(a->S, o->entries, a->A, &a->stats))
CALL(solve, sl_factor_solve(a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs, NULL))
CALL(plan_solve, sl_plan_solve(a->P, a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs, NULL))
CALL(plan_refined, sl_plan_solve_regularized(a->P, a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs,
                                             a->steps, NULL, &a->stats))
CALL(local, sl_local_solve(a->F, a->bset, a->nb, a->xset, a->nx, a->X, a->ldx, a->B, a->ldb,
                           a->nrhs, NULL, &a->stats))
CALL(defects, sl_factor_defects(a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs, NULL))
CALL(diagonal, sl_inverse_diagonal(a->F, a->X, a->xset, a->nx, NULL, &a->stats))
CALL(pairs, sl_inverse_pairs(a->F, a->X, a->xset, a->xset, a->nx, NULL, &a->stats))
CALL(block, sl_inverse_block(a->F, a->X, a->ldx, a->xset, a->nx, a->bset, 1, NULL, &a->stats))
CALL(selected_refactor, sl_selected_refactor(a->Z, a->F, NULL))
CALL(selected_diagonal, sl_selected_entries(a->Z, a->X, a->xset, NULL, a->nx, &a->stats))
CALL(selected_entries, sl_selected_entries(a->Z, a->X, a->xset, a->xset == NULL ? o->xset : a->xset,
                                           a->nx, &a->stats))
CALL(region_refactor, sl_region_refactor(a->R, a->F, NULL, NULL))
CALL(reserve, sl_work_reserve(a->W, 64))
ON_PINS(pins_add, 1, sl_constraints_add(pins, a->xset, NULL, a->nx, &a->stats))
ON_PINS(pins_equality, 1, sl_constraints_add(pins, a->xset, a->B, a->nx, &a->stats))
ON_PINS(pins_release, N, sl_constraints_release(pins, a->xset, a->nx, &a->stats))
ON_PINS(pins_refactor, 1, sl_constraints_refactor(pins, &a->stats))
ON_PINS(pins_solve, 1,
        sl_constraints_solve(pins, NULL, a->X, a->ldx, a->B, a->ldb, o->entries, N, a->nrhs, NULL))
CREATE(pins, sl_constraints, sl_constraints_free, sl_constraints_create(&out, a->F, NULL))
CREATE(symbolic, sl_symbolic, sl_symbolic_free, sl_symbolic_create(&out, a->A, NULL, &a->stats))
CREATE(edit, sl_symbolic, sl_symbolic_free,
       sl_symbolic_edit(&out, a->S, &o->good.M.view, a->A, o->perm, NULL, &a->stats))
CREATE(edit_before, sl_symbolic, sl_symbolic_free,
       sl_symbolic_edit(&out, a->S, a->A, &o->good.M.view, o->perm, NULL, &a->stats))
CREATE(edit_factor, sl_factor, sl_factor_free,
       sl_factor_edit(&out, a->F, a->S, a->A, o->perm, NULL, &a->stats))
CREATE(factor, sl_factor, sl_factor_free, sl_factor_create(&out, a->S, a->A, NULL, &a->stats))
CREATE(fixed, sl_fixed, sl_fixed_free, sl_fixed_create(&out, a->A, a->xset, a->nx, NULL, &a->stats))
CREATE(submatrix, sl_matrix, sl_matrix_free,
       sl_matrix_submatrix(&out, a->A, a->xset, a->nx, NULL, &a->stats))
CREATE(sum, sl_matrix, sl_matrix_free, sl_matrix_sum(&out, NULL, a->A, 1, NULL, &a->stats))
CREATE(lower, sl_matrix, sl_matrix_free, sl_factor_lower(&out, a->F, NULL))
CREATE(plan, sl_plan, sl_plan_free,
       sl_plan_create(&out, a->S, a->bset, a->nb, a->xset, a->nx, NULL, &a->stats))
CREATE(selected, sl_selected, sl_selected_free,
       sl_selected_create(&out, a->F, a->xset, a->nx, NULL, &a->stats))
CREATE(region, sl_region, sl_region_free,
       sl_region_create(&out, a->F, a->xset, a->nx, NULL, NULL, &a->stats))

static const struct {
    const char *name;
    sl_status (*call)(arguments_t *a);
    int takes;
} calls[] = {
    {"sl_csc_check", check, A_},
    {"sl_csc_triangle", triangle, A_ | SQUARE_},
    {"sl_fixed_create", fixed, A_ | SQUARE_ | VALUES_ | LIST_},
    {"sl_matrix_submatrix", submatrix, SQUARE_ | LIST_},
    {"sl_matrix_sum", sum, A_ | SQUARE_},
    {"sl_symbolic_create", symbolic, A_ | SQUARE_},
    {"sl_symbolic_edit", edit, A_ | SQUARE_ | S_},
    {"sl_symbolic_edit, A", edit_before, A_ | SQUARE_ | S_},
    {"sl_factor_edit", edit_factor, A_ | SQUARE_ | VALUES_ | S_ | F_ | FAILED_},
    {"sl_symbolic_scatter", scatter, A_ | SQUARE_ | VALUES_ | S_},
    {"sl_factor_create", factor, A_ | SQUARE_ | VALUES_ | S_},
    {"sl_factor_refactor", refactor, A_ | SQUARE_ | VALUES_ | F_},
    {"sl_factor_change_entries, columns", changed, A_ | SQUARE_ | VALUES_ | F_ | FAILED_ | LIST_},
    {"sl_factor_refine", refine, A_ | SQUARE_ | VALUES_ | SOLVE_ | STEPS_},
    {"sl_factor_rcond", rcond, A_ | SQUARE_ | VALUES_ | F_ | FAILED_},
    {"sl_factor_certify", certify, A_ | SQUARE_ | VALUES_ | F_ | FAILED_},
    {"sl_factor_submatrix", restriction, SQUARE_ | VALUES_ | F_ | FAILED_ | LIST_},
    {"sl_factor_logdet", logdet, F_ | FAILED_},
    {"sl_factor_pivot_rows", null_rows, F_ | FAILED_},
    {"sl_factor_pseudo_inverse", pseudo, F_ | FAILED_},
    {"sl_factor_lower", lower, F_ | FAILED_},
    {"sl_factor_defects", defects, F_ | FAILED_ | B_ | LDB_ | NRHS_},
    {"sl_factor_solve", solve, SOLVE_},
    {"sl_plan_create", plan, S_ | BSET_ | XSET_},
    {"sl_plan_solve", plan_solve, SOLVE_ | P_ | OTHER_},
    {"sl_plan_solve_regularized", plan_refined, SOLVE_ | P_ | OTHER_ | STEPS_},
    {"sl_plan_solve_bounded", plan_bounded, SOLVE_ | P_ | OTHER_},
    {"sl_local_solve", local, SOLVE_ | BSET_ | XSET_},
    {"sl_inverse_diagonal", diagonal, F_ | FAILED_ | X_ | XSET_},
    {"sl_inverse_pairs", pairs, F_ | FAILED_ | X_ | LIST_},
    {"sl_inverse_block", block, F_ | FAILED_ | X_ | LDX_ | LIST_},
    {"sl_selected_create", selected, F_ | FAILED_ | XSET_},
    {"sl_selected_refactor", selected_refactor, F_ | FAILED_ | OTHER_ | Z_},
    {"sl_selected_entries, diagonal", selected_diagonal, Z_ | X_ | XSET_},
    {"sl_selected_entries", selected_entries, Z_ | X_ | LIST_},
    {"sl_region_create", region, F_ | FAILED_ | XSET_},
    {"sl_region_refactor", region_refactor, F_ | FAILED_ | OTHER_ | R_},
    {"sl_constraints_create", pins, F_ | FAILED_},
    {"sl_constraints_add", pins_add, PINS_ | LIST_},
    {"sl_constraints_add, an equality", pins_equality, PINS_ | LIST_},
    {"sl_constraints_release", pins_release, PINS_ | LIST_},
    {"sl_constraints_refactor", pins_refactor, PINS_},
    {"sl_constraints_solve", pins_solve, PINS_ | X_ | LDX_ | B_ | LDB_ | NRHS_},
    {"sl_save to memory", save_memory, S_ | FAILED_ | OTHER_},
    {"sl_save to a file", save_file, S_ | FAILED_ | OTHER_},
    {"sl_batch_solve", batch_solve, SOLVE_},
    {"sl_work_reserve", reserve, W_},
};

#endif
