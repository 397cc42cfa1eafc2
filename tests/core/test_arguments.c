/* test_arguments.c: every call against every way to be wrong of every argument that it takes */
#include "tests/lib/factored.h"

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

static sl_status bilinear(arguments_t *a) {
    double z;
    return sl_inverse_bilinear(a->F, &z, a->bset, a->B, a->nb, a->xset, a->B, a->nx, NULL,
                               &a->stats);
}

static sl_status rcond(arguments_t *a) {
    double r;
    return sl_factor_rcond(a->F, a->A, &r, NULL);
}

static sl_status logdet(arguments_t *a) {
    double log_abs, sign;
    return sl_factor_logdet(a->F, &log_abs, &sign);
}

static sl_status null_rows(arguments_t *a) {
    sl_int rows[1], count;
    return sl_factor_null_rows(a->F, rows, 1, &count);
}

static sl_status save_bytes(arguments_t *a) {
    size_t bytes = 0;
    return sl_save_bytes(&bytes, a->S, a->F);
}

static sl_status save_memory(arguments_t *a) {
    size_t bytes = 0;
    const sl_status status = sl_save_bytes(&bytes, o->good.S, o->good.F);
    void *memory = test_array(bytes, 1);
    const sl_status saved = sl_save_memory(memory, bytes, a->S, a->F);
    free(memory);
    return status == SL_OK ? saved : status;
}

/* The set of an analysis and a factor of the arguments. */
static sl_saved_set saved_set(arguments_t *a) {
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    set.symbolic = (sl_symbolic *)(uintptr_t)a->S;
    set.factor = a->F;
    return set;
}

static sl_status save_set_bytes(arguments_t *a) {
    const sl_saved_set set = saved_set(a);
    size_t bytes = 0;
    return sl_save_set_bytes(&bytes, &set);
}

static sl_status save_set_file(arguments_t *a) {
    const sl_saved_set set = saved_set(a);
    return sl_save_set_file(NOWHERE, &set, NULL);
}

static sl_status batch_diagonal(arguments_t *a) {
    const sl_factor *F = a->F;
    return sl_batch_diagonal(&F, 1, a->X, a->ldx, a->xset, a->nx, NULL, NULL, NULL, &a->stats);
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
        sl_factor_restrict(&S, &G, a->F, a->A, a->xset, a->nx, NULL, &a->stats);
    assert_true((S != NULL) == (status == SL_OK) && (G != NULL) == (status == SL_OK));
    sl_factor_free(G);
    sl_symbolic_free(S);
    return status;
}

/* A call on a set of so many pins, which the call may change. */
#define ON_PINS(name, count, call) \
    static sl_status name(arguments_t *a) { \
        sl_pins *pins = a->has_pins ? pins_make(count) : NULL; \
        const sl_status status = call; \
        sl_pins_free(pins); \
        return status; \
    }

static sl_pins *pins_make(sl_int count) {
    sl_pins *pins = NULL;
    SL_CHECK(sl_pins_create(&pins, o->good.F, NULL));
    for (sl_int row = 0; row < count; row++) {
        SL_CHECK(sl_pins_add(pins, row, NULL));
    }
    return pins;
}

CALL(check, sl_csc_check(a->A, &a->stats))
CALL(refactor, sl_factor_refactor(a->F, a->A, &a->stats))
CALL(changed, sl_factor_refactor_changed(a->F, a->A, a->xset, a->nx, &a->stats))
CALL(refine,
     sl_factor_refine(a->F, a->A, a->X, a->ldx, a->B, a->ldb, a->nrhs, a->steps, NULL, &a->stats))
CALL(scatter, sl_symbolic_scatter(a->S, o->entries, a->A, &a->stats))
CALL(write_file, sl_csc_write(a->A, SL_AS_SYMMETRIC, NOWHERE))
CALL(save_file, sl_save_file(NOWHERE, a->S, a->F, NULL))
CALL(solve, sl_factor_solve(a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs, NULL))
CALL(plan_solve, sl_plan_solve(a->P, a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs, NULL))
CALL(plan_refined, sl_plan_solve_refined(a->P, a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs, a->steps,
                                         NULL, &a->stats))
CALL(local, sl_local_solve(a->F, a->bset, a->nb, a->xset, a->nx, a->X, a->ldx, a->B, a->ldb,
                           a->nrhs, NULL, &a->stats))
CALL(defects, sl_factor_defects(a->F, a->X, a->ldx, a->B, a->ldb, a->nrhs, NULL))
CALL(diagonal, sl_inverse_diagonal(a->F, a->X, a->xset, a->nx, NULL, &a->stats))
CALL(pairs, sl_inverse_pairs(a->F, a->X, a->xset, a->xset, a->nx, NULL, &a->stats))
CALL(block, sl_inverse_block(a->F, a->X, a->ldx, a->xset, a->nx, a->bset, 1, NULL, &a->stats))
CALL(selected_refactor, sl_selected_refactor(a->Z, a->F, NULL))
CALL(selected_diagonal, sl_selected_diagonal(a->Z, a->X, a->xset, a->nx, &a->stats))
CALL(selected_entries, sl_selected_entries(a->Z, a->X, a->xset, a->xset, a->nx, &a->stats))
CALL(region_refactor, sl_region_refactor(a->R, a->F, NULL, NULL))
CALL(reserve_factor, sl_work_reserve_factor(a->W, a->F, a->nrhs))
CALL(reserve_plan, sl_work_reserve_plan(a->W, a->P, a->nrhs))
CALL(reserve_refine, sl_work_reserve_refine(a->W, a->F, a->nrhs))
CALL(reserve_selected, sl_work_reserve_selected(a->W, a->Z))
CALL(reserve_region, sl_work_reserve_region(a->W, a->R, a->F))
ON_PINS(pins_add, 1, sl_pins_add(pins, a->xset[0], &a->stats))
ON_PINS(pins_add_rows, 1, sl_pins_add_rows(pins, a->xset, a->nx, &a->stats))
ON_PINS(pins_equality, 1, sl_pins_add_equality(pins, a->xset, a->B, a->nx, &a->stats))
ON_PINS(pins_release, 1, sl_pins_release(pins, 0))
ON_PINS(pins_release_rows, N, sl_pins_release_rows(pins, a->xset, a->nx, &a->stats))
ON_PINS(pins_matrix, 1, sl_pins_set_matrix(pins, a->A, &a->stats))
ON_PINS(pins_refactor, 1, sl_pins_refactor(pins))
ON_PINS(pins_solve, 1,
        sl_pins_solve(pins, NULL, a->X, a->ldx, a->B, a->ldb, o->entries, N, a->nrhs, NULL))
CREATE(pins, sl_pins, sl_pins_free, sl_pins_create(&out, a->F, NULL))
CREATE(symbolic, sl_symbolic, sl_symbolic_free, sl_symbolic_create(&out, a->A, NULL, &a->stats))
CREATE(edit, sl_symbolic, sl_symbolic_free,
       sl_symbolic_edit(&out, a->S, &o->good.M.view, a->A, o->perm, NULL, &a->stats))
CREATE(edit_before, sl_symbolic, sl_symbolic_free,
       sl_symbolic_edit(&out, a->S, a->A, &o->good.M.view, o->perm, NULL, &a->stats))
CREATE(edit_factor, sl_factor, sl_factor_free,
       sl_factor_edit(&out, a->F, a->S, a->A, o->perm, NULL, &a->stats))
CREATE(factor, sl_factor, sl_factor_free, sl_factor_create(&out, a->S, a->A, NULL, &a->stats))
CREATE(transpose, sl_matrix, sl_matrix_free, sl_matrix_transpose(&out, a->A, NULL))
CREATE(permute, sl_matrix, sl_matrix_free, sl_matrix_permute(&out, a->A, o->perm, NULL))
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
    {"sl_csc_write", write_file, A_ | SQUARE_},
    {"sl_matrix_transpose", transpose, A_},
    {"sl_matrix_permute", permute, A_ | SQUARE_},
    {"sl_matrix_sum", sum, A_ | SQUARE_},
    {"sl_symbolic_create", symbolic, A_ | SQUARE_},
    {"sl_symbolic_edit", edit, A_ | SQUARE_ | S_},
    {"sl_symbolic_edit, A", edit_before, A_ | SQUARE_ | S_},
    {"sl_factor_edit", edit_factor, A_ | SQUARE_ | VALUES_ | S_ | F_ | FAILED_},
    {"sl_symbolic_scatter", scatter, A_ | SQUARE_ | VALUES_ | S_},
    {"sl_factor_create", factor, A_ | SQUARE_ | VALUES_ | S_},
    {"sl_factor_refactor", refactor, A_ | SQUARE_ | VALUES_ | F_},
    {"sl_factor_refactor_changed", changed, A_ | SQUARE_ | VALUES_ | F_ | FAILED_ | LIST_},
    {"sl_factor_refine", refine, A_ | SQUARE_ | VALUES_ | SOLVE_ | STEPS_},
    {"sl_factor_rcond", rcond, A_ | SQUARE_ | VALUES_ | F_ | FAILED_},
    {"sl_factor_restrict", restriction, SQUARE_ | VALUES_ | F_ | FAILED_ | LIST_},
    {"sl_factor_logdet", logdet, F_ | FAILED_},
    {"sl_factor_null_rows", null_rows, F_ | FAILED_},
    {"sl_factor_lower", lower, F_ | FAILED_},
    {"sl_factor_defects", defects, F_ | FAILED_ | B_ | LDB_ | NRHS_},
    {"sl_factor_solve", solve, SOLVE_},
    {"sl_plan_create", plan, S_ | BSET_ | XSET_},
    {"sl_plan_solve", plan_solve, SOLVE_ | P_ | OTHER_},
    {"sl_plan_solve_refined", plan_refined, SOLVE_ | P_ | OTHER_ | STEPS_},
    {"sl_local_solve", local, SOLVE_ | BSET_ | XSET_},
    {"sl_inverse_diagonal", diagonal, F_ | FAILED_ | X_ | XSET_},
    {"sl_inverse_pairs", pairs, F_ | FAILED_ | X_ | LIST_},
    {"sl_inverse_block", block, F_ | FAILED_ | X_ | LDX_ | LIST_},
    {"sl_inverse_bilinear", bilinear, F_ | FAILED_ | B_ | BSET_ | XSET_},
    {"sl_selected_create", selected, F_ | FAILED_ | XSET_},
    {"sl_selected_refactor", selected_refactor, F_ | FAILED_ | OTHER_ | Z_},
    {"sl_selected_diagonal", selected_diagonal, Z_ | X_ | XSET_},
    {"sl_selected_entries", selected_entries, Z_ | X_ | LIST_},
    {"sl_region_create", region, F_ | FAILED_ | XSET_},
    {"sl_region_refactor", region_refactor, F_ | FAILED_ | OTHER_ | R_},
    {"sl_pins_create", pins, F_ | FAILED_},
    {"sl_pins_add", pins_add, PINS_},
    {"sl_pins_add_rows", pins_add_rows, PINS_ | LIST_},
    {"sl_pins_add_equality", pins_equality, PINS_ | LIST_ | B_},
    {"sl_pins_release", pins_release, PINS_},
    {"sl_pins_release_rows", pins_release_rows, PINS_ | LIST_},
    {"sl_pins_set_matrix", pins_matrix, PINS_ | A_ | SQUARE_ | VALUES_},
    {"sl_pins_refactor", pins_refactor, PINS_},
    {"sl_pins_solve", pins_solve, PINS_ | X_ | LDX_ | B_ | LDB_ | NRHS_},
    {"sl_save_bytes", save_bytes, S_ | FAILED_ | OTHER_},
    {"sl_save_memory", save_memory, S_ | FAILED_ | OTHER_},
    {"sl_save_file", save_file, S_ | FAILED_ | OTHER_},
    {"sl_save_set_bytes", save_set_bytes, S_ | FAILED_ | OTHER_},
    {"sl_save_set_file", save_set_file, S_ | FAILED_ | OTHER_},
    {"sl_batch_solve", batch_solve, SOLVE_},
    {"sl_batch_diagonal", batch_diagonal, F_ | FAILED_ | X_ | LDX_ | XSET_},
    {"sl_work_reserve_factor", reserve_factor, W_ | F_ | NRHS_},
    {"sl_work_reserve_plan", reserve_plan, W_ | P_ | NRHS_},
    {"sl_work_reserve_refine", reserve_refine, W_ | F_ | NRHS_},
    {"sl_work_reserve_selected", reserve_selected, W_ | Z_},
    {"sl_work_reserve_region", reserve_region, W_ | F_ | OTHER_ | R_},
};

/* ---- ways to be wrong ---- */

/* Any error of a matrix: what is looked at first differs from call to call. */
#define BAD_MATRIX ((sl_status)-1)

#define SPOIL(name, action) \
    static void name(arguments_t *a) { \
        (void)a; \
        action; \
    }

static void spoil_set(const sl_int **set, sl_int count, sl_int row) {
    memcpy(o->spoiled, *set, (size_t)count * sizeof **set);
    o->spoiled[count / 2] = row;
    *set = o->spoiled;
}

SPOIL(no_matrix, a->A = NULL)
SPOIL(negative_size, a->view.n_rows = a->view.n_cols = -1)
SPOIL(negative_rows, a->view.n_rows = -1)
SPOIL(rectangular, a->view.n_rows = N + 1)
SPOIL(narrow, a->view.n_cols = N - 1)
SPOIL(largest_size, a->view.n_rows = a->view.n_cols = INT32_MAX)
SPOIL(no_positions, a->view.p = NULL)
SPOIL(no_rows, a->view.i = NULL)
SPOIL(no_values, a->view.x = NULL)
SPOIL(late_start, o->p[0] = 1)
SPOIL(early_start, o->p[0] = -1000)
SPOIL(negative_position, o->p[3] = -5)
SPOIL(descending_position, o->p[3] = o->p[4] + 1)
SPOIL(negative_end, o->p[N] = -3)
SPOIL(row_n, o->i[5] = N)
SPOIL(row_negative, o->i[5] = -1)
SPOIL(row_least, o->i[0] = INT32_MIN)
SPOIL(row_last_too_large, o->i[o->p[N] - 1] = INT32_MAX)
SPOIL(no_analysis, a->S = NULL)
SPOIL(no_factor, a->F = NULL)
SPOIL(failed_factor, a->F = o->failed)
SPOIL(other_factor, a->F = o->other.F)
SPOIL(no_plan, a->P = NULL)
SPOIL(no_selected, a->Z = NULL)
SPOIL(no_region, a->R = NULL)
SPOIL(no_work, a->W = NULL)
SPOIL(negative_nb, a->nb = -1)
SPOIL(negative_nx, a->nx = -1)
SPOIL(least_nx, a->nx = INT32_MIN)
SPOIL(no_list, a->xset = NULL)
SPOIL(b_row_n, spoil_set(&a->bset, NB, N))
SPOIL(b_row_negative, spoil_set(&a->bset, NB, -1))
SPOIL(b_row_least, spoil_set(&a->bset, NB, INT32_MIN))
SPOIL(x_row_n, spoil_set(&a->xset, NX, N))
SPOIL(x_row_negative, spoil_set(&a->xset, NX, -1))
SPOIL(x_row_largest, spoil_set(&a->xset, NX, INT32_MAX))
SPOIL(no_x, a->X = NULL)
SPOIL(small_ldx, a->ldx = 1)
SPOIL(zero_ldx, a->ldx = 0)
SPOIL(no_b, a->B = NULL)
SPOIL(small_ldb, a->ldb = 1)
SPOIL(zero_ldb, a->ldb = 0)
SPOIL(negative_nrhs, a->nrhs = -1)
SPOIL(least_nrhs, a->nrhs = INT32_MIN)
SPOIL(negative_steps, a->steps = -1)
SPOIL(no_pins, a->has_pins = 0)

static const struct {
    const char *name;
    void (*spoil)(arguments_t *a);
    int of; /* the argument that it spoils */
    sl_status expected;
} wrongs[] = {
    {"A NULL", no_matrix, A_, SL_ERR_ARGUMENT},
    {"n = -1", negative_size, A_, BAD_MATRIX},
    {"n_rows = -1", negative_rows, A_, BAD_MATRIX},
    {"rectangular", rectangular, SQUARE_, BAD_MATRIX},
    {"a column less", narrow, SQUARE_, BAD_MATRIX},
    {"n = 2^31 - 1", largest_size, A_, BAD_MATRIX},
    {"p NULL", no_positions, A_, SL_ERR_ARGUMENT},
    {"i NULL", no_rows, A_, SL_ERR_ARGUMENT},
    {"x NULL", no_values, VALUES_, SL_ERR_ARGUMENT},
    {"p[0] = 1", late_start, A_, SL_ERR_PATTERN},
    {"p[0] = -1000", early_start, A_, SL_ERR_PATTERN},
    {"p[3] = -5", negative_position, A_, SL_ERR_PATTERN},
    {"p[3] > p[4]", descending_position, A_, SL_ERR_PATTERN},
    {"p[n] = -3", negative_end, A_, SL_ERR_PATTERN},
    {"i = n", row_n, A_, SL_ERR_PATTERN},
    {"i = -1", row_negative, A_, SL_ERR_PATTERN},
    {"i = -2^31", row_least, A_, SL_ERR_PATTERN},
    {"last i = 2^31 - 1", row_last_too_large, A_, SL_ERR_PATTERN},
    {"S NULL", no_analysis, S_, SL_ERR_ARGUMENT},
    {"F NULL", no_factor, F_, SL_ERR_ARGUMENT},
    {"failed F", failed_factor, FAILED_, SL_ERR_STATE},
    {"F of another analysis", other_factor, OTHER_, SL_ERR_STATE},
    {"P NULL", no_plan, P_, SL_ERR_ARGUMENT},
    {"Z NULL", no_selected, Z_, SL_ERR_ARGUMENT},
    {"R NULL", no_region, R_, SL_ERR_ARGUMENT},
    {"W NULL", no_work, W_, SL_ERR_ARGUMENT},
    {"nb = -1", negative_nb, BSET_, SL_ERR_ARGUMENT},
    {"nx = -1", negative_nx, XSET_ | LIST_, SL_ERR_ARGUMENT},
    {"nx = -2^31", least_nx, XSET_ | LIST_, SL_ERR_ARGUMENT},
    {"list NULL", no_list, LIST_, SL_ERR_ARGUMENT},
    {"b row n", b_row_n, BSET_, SL_ERR_ARGUMENT},
    {"b row -1", b_row_negative, BSET_, SL_ERR_ARGUMENT},
    {"b row -2^31", b_row_least, BSET_, SL_ERR_ARGUMENT},
    {"x row n", x_row_n, XSET_ | LIST_, SL_ERR_ARGUMENT},
    {"x row -1", x_row_negative, XSET_ | LIST_, SL_ERR_ARGUMENT},
    {"x row 2^31 - 1", x_row_largest, XSET_ | LIST_, SL_ERR_ARGUMENT},
    {"X NULL", no_x, X_, SL_ERR_ARGUMENT},
    {"ldx = 1", small_ldx, LDX_, SL_ERR_ARGUMENT},
    {"ldx = 0", zero_ldx, LDX_, SL_ERR_ARGUMENT},
    {"B NULL", no_b, B_, SL_ERR_ARGUMENT},
    {"ldb = 1", small_ldb, LDB_, SL_ERR_ARGUMENT},
    {"ldb = 0", zero_ldb, LDB_, SL_ERR_ARGUMENT},
    {"nrhs = -1", negative_nrhs, NRHS_, SL_ERR_ARGUMENT},
    {"nrhs = -2^31", least_nrhs, NRHS_, SL_ERR_ARGUMENT},
    {"steps = -1", negative_steps, STEPS_, SL_ERR_ARGUMENT},
    {"pins NULL", no_pins, PINS_, SL_ERR_ARGUMENT},
};

enum { CALLS = sizeof calls / sizeof calls[0], WRONGS = sizeof wrongs / sizeof wrongs[0] };

/* ---- the table ---- */

static arguments_t arguments(void) {
    const sl_csc *A = &o->good.M.view;
    arguments_t a;
    memset(&a, 0, sizeof a);
    memcpy(o->p, A->p, sizeof o->p);
    memcpy(o->i, A->i, (size_t)A->p[N] * sizeof *o->i);
    a.view = *A;
    a.view.p = o->p;
    a.view.i = o->i;
    a.S = o->good.S;
    a.F = o->good.F;
    a.P = o->P;
    a.Z = o->Z;
    a.R = o->R;
    a.W = o->W;
    a.bset = o->bset;
    a.xset = o->xset;
    a.nb = NB;
    a.nx = NX;
    a.X = o->X;
    a.B = o->B;
    a.ldx = a.ldb = N;
    a.nrhs = 2;
    a.steps = 1;
    a.has_pins = 1;
    return a;
}

static void fill_x(void) {
    for (int k = 0; k < 2 * N; k++) {
        o->X[k] = 4321.5;
    }
}

/* Runs a call whose arguments are good apart from those that `wrong` spoils; -1: none. */
static sl_status run(int call, int wrong) {
    arguments_t a = arguments();
    a.A = &a.view;
    if (wrong >= 0) {
        wrongs[wrong].spoil(&a);
    }
    fill_x();
    return calls[call].call(&a);
}

static int set_up(void **state) {
    (void)state;
    sl_options natural = options_none();
    natural.ordering = SL_ORDERING_NATURAL;
    o = (objects_t *)test_array(1, sizeof *o);
    o->good = factored_make(GEN_GRID2, N, 1, 0, NULL);
    o->other = factored_make(GEN_GRID2, N, 1, 0, &natural);
    for (sl_int k = 0; k < N; k++) {
        o->perm[k] = k * 67 % N;
    }
    for (sl_int k = 0; k < NB; k++) {
        o->bset[k] = 5 * k;
    }
    for (sl_int k = 0; k < NX; k++) {
        o->xset[k] = 3 * k + 1;
    }
    gen_reals(o->B, 2 * N, 3);
    assert_true(o->good.M.p[N] <= NNZ_MAX);
    SL_CHECK(sl_factor_create(&o->failed, o->good.S, &o->good.M.view, NULL, NULL));
    double *zeros = test_reals((size_t)o->good.M.p[N]);
    sl_csc bad = o->good.M.view;
    bad.x = zeros;
    SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(o->failed, &bad, NULL));
    free(zeros);
    SL_CHECK(sl_plan_create(&o->P, o->good.S, o->bset, NB, o->xset, NX, NULL, NULL));
    SL_CHECK(sl_selected_create(&o->Z, o->good.F, NULL, 0, NULL, NULL));
    SL_CHECK(sl_region_create(&o->R, o->good.F, o->bset, NB, NULL, NULL, NULL));
    SL_CHECK(sl_work_create(&o->W, NULL));
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    sl_work_free(o->W);
    sl_region_free(o->R);
    sl_selected_free(o->Z);
    sl_plan_free(o->P);
    sl_factor_free(o->failed);
    factored_free(&o->good);
    factored_free(&o->other);
    free(o);
    return 0;
}

/* Spoils one argument at a time. A refused call has written nothing to X. */
static void one_wrong_argument_is_refused(void **state) {
    (void)state;
    int count = 0, failures = 0;
    for (int call = 0; call < CALLS; call++) {
        for (int wrong = 0; wrong < WRONGS; wrong++) {
            if ((calls[call].takes & wrongs[wrong].of) == 0) {
                continue;
            }
            const sl_status status = run(call, wrong);
            const int is_right = wrongs[wrong].expected == BAD_MATRIX
                                     ? status == SL_ERR_ARGUMENT || status == SL_ERR_PATTERN ||
                                           status == SL_ERR_TOO_LARGE
                                     : status == wrongs[wrong].expected;
            int is_unchanged = 1;
            for (int k = 0; k < 2 * N; k++) {
                is_unchanged &= o->X[k] == 4321.5;
            }
            if (!is_right || !is_unchanged) {
                print_error("%s, %s: %s%s\n", calls[call].name, wrongs[wrong].name,
                            sl_status_string(status), is_unchanged ? "" : ", X was written");
                failures++;
            }
            count++;
        }
        SL_CHECK(run(call, -1)); /* and the objects are as good as before */
    }
    print_message("%d calls with one wrong argument\n", count);
    assert_int_equal(failures, 0);
}

/* Two wrong arguments at a time are refused too, whatever is looked at first. */
static void two_wrong_arguments_are_refused(void **state) {
    (void)state;
    int count = 0;
    for (int call = 0; call < CALLS; call++) {
        for (int first = 0; first < WRONGS; first++) {
            for (int second = first + 1; second < WRONGS; second++) {
                const int takes = calls[call].takes;
                if ((takes & wrongs[first].of) == 0 || (takes & wrongs[second].of) == 0) {
                    continue;
                }
                arguments_t a = arguments();
                a.A = &a.view;
                wrongs[first].spoil(&a);
                const int is_shared = (wrongs[first].of & wrongs[second].of) != 0;
                if (is_shared) { /* the second would undo the first, or read what it removed */
                    continue;
                }
                if ((wrongs[second].of & (BSET_ | XSET_ | LIST_)) != 0 &&
                    (a.bset == NULL || a.xset == NULL)) {
                    continue;
                }
                wrongs[second].spoil(&a);
                if (calls[call].call(&a) == SL_OK) {
                    print_error("%s, %s and %s\n", calls[call].name, wrongs[first].name,
                                wrongs[second].name);
                    assert_true(0);
                }
                count++;
            }
        }
        SL_CHECK(run(call, -1));
    }
    print_message("%d calls with two wrong arguments\n", count);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_wrong_argument_is_refused),
        cmocka_unit_test(two_wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
