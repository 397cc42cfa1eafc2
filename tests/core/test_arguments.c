/* test_arguments.c: every call against every way to be wrong of every argument that it takes */
#include "tests/lib/argument_calls.h"

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
    const char *words; /* one of these, separated by bars, is in the text of the error */
} wrongs[] = {
    {"A NULL", no_matrix, A_, SL_ERR_ARGUMENT, "is NULL"},
    {"n = -1", negative_size, A_, BAD_MATRIX, "size|below 0"},
    {"n_rows = -1", negative_rows, A_, BAD_MATRIX, "size|below 0"},
    {"rectangular", rectangular, SQUARE_, BAD_MATRIX, "square|size"},
    {"a column less", narrow, SQUARE_, BAD_MATRIX, "square|size"},
    {"n = 2^31 - 1", largest_size, A_, BAD_MATRIX, "size|2^31 - 8"},
    {"p NULL", no_positions, A_, SL_ERR_ARGUMENT, "is NULL"},
    {"i NULL", no_rows, A_, SL_ERR_ARGUMENT, "is NULL"},
    {"x NULL", no_values, VALUES_, SL_ERR_ARGUMENT, "is NULL"},
    {"p[0] = 1", late_start, A_, SL_ERR_MALFORMED, "A.p"},
    {"p[0] = -1000", early_start, A_, SL_ERR_MALFORMED, "A.p"},
    {"p[3] = -5", negative_position, A_, SL_ERR_MALFORMED, "A.p"},
    {"p[3] > p[4]", descending_position, A_, SL_ERR_MALFORMED, "A.p"},
    {"p[n] = -3", negative_end, A_, SL_ERR_MALFORMED, "A.p"},
    {"i = n", row_n, A_, SL_ERR_MALFORMED, "row of A is out of range"},
    {"i = -1", row_negative, A_, SL_ERR_MALFORMED, "row of A is out of range"},
    {"i = -2^31", row_least, A_, SL_ERR_MALFORMED, "row of A is out of range"},
    {"last i = 2^31 - 1", row_last_too_large, A_, SL_ERR_MALFORMED, "row of A is out of range"},
    {"S NULL", no_analysis, S_, SL_ERR_ARGUMENT, "is NULL"},
    {"F NULL", no_factor, F_, SL_ERR_ARGUMENT, "is NULL"},
    {"failed F", failed_factor, FAILED_, SL_ERR_STALE, "no numbers"},
    {"F of another analysis", other_factor, OTHER_, SL_ERR_MISMATCH, "anal"},
    {"P NULL", no_plan, P_, SL_ERR_ARGUMENT, "is NULL"},
    {"Z NULL", no_selected, Z_, SL_ERR_ARGUMENT, "is NULL"},
    {"R NULL", no_region, R_, SL_ERR_ARGUMENT, "is NULL"},
    {"W NULL", no_work, W_, SL_ERR_ARGUMENT, "is NULL"},
    {"nb = -1", negative_nb, BSET_, SL_ERR_ARGUMENT, "below 0"},
    {"nx = -1", negative_nx, XSET_ | LIST_, SL_ERR_ARGUMENT, "below"},
    {"nx = -2^31", least_nx, XSET_ | LIST_, SL_ERR_ARGUMENT, "below"},
    {"list NULL", no_list, LIST_, SL_ERR_ARGUMENT, "is NULL"},
    {"b row n", b_row_n, BSET_, SL_ERR_ARGUMENT, "out of range|this index"},
    {"b row -1", b_row_negative, BSET_, SL_ERR_ARGUMENT, "out of range|this index"},
    {"b row -2^31", b_row_least, BSET_, SL_ERR_ARGUMENT, "out of range|this index"},
    {"x row n", x_row_n, XSET_ | LIST_, SL_ERR_ARGUMENT, "out of range|this index"},
    {"x row -1", x_row_negative, XSET_ | LIST_, SL_ERR_ARGUMENT, "out of range|this index"},
    {"x row 2^31 - 1", x_row_largest, XSET_ | LIST_, SL_ERR_ARGUMENT, "out of range|this index"},
    {"X NULL", no_x, X_, SL_ERR_ARGUMENT, "is NULL"},
    {"ldx = 1", small_ldx, LDX_, SL_ERR_ARGUMENT, "ldx|ldz|ldo|ldy"},
    {"ldx = 0", zero_ldx, LDX_, SL_ERR_ARGUMENT, "ldx|ldz|ldo|ldy"},
    {"B NULL", no_b, B_, SL_ERR_ARGUMENT, "is NULL"},
    {"ldb = 1", small_ldb, LDB_, SL_ERR_ARGUMENT, "ldb"},
    {"ldb = 0", zero_ldb, LDB_, SL_ERR_ARGUMENT, "ldb"},
    {"nrhs = -1", negative_nrhs, NRHS_, SL_ERR_ARGUMENT, "nrhs"},
    {"nrhs = -2^31", least_nrhs, NRHS_, SL_ERR_ARGUMENT, "nrhs"},
    {"steps = -1", negative_steps, STEPS_, SL_ERR_ARGUMENT, "steps"},
    {"pins NULL", no_pins, PINS_, SL_ERR_ARGUMENT, "is NULL"},
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
    SL_CHECK(sl_selected_create(&o->Z, o->good.F, NULL, SL_ALL, NULL, NULL));
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

/* Is one of the words in the text of the last error? It says more than the status. */
static int is_named(sl_status status, const char *words, char *text, size_t size) {
    sl_error_text(text, size, status, NULL);
    for (const char *word = words; *word != '\0';
         word += strcspn(word, "|"), word += *word == '|') {
        char one[40];
        (void)snprintf(one, sizeof one, "%.*s", (int)strcspn(word, "|"), word);
        if (strstr(text, ": ") != NULL && strstr(text, one) != NULL) {
            return 1;
        }
    }
    return 0;
}

/* Spoils one argument at a time. A refused call has written nothing to X, and has a reason. */
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
                                     ? status == SL_ERR_ARGUMENT || status == SL_ERR_MALFORMED ||
                                           status == SL_ERR_OTHER_PATTERN ||
                                           status == SL_ERR_TOO_LARGE
                                     : status == wrongs[wrong].expected;
            int is_unchanged = 1;
            for (int k = 0; k < 2 * N; k++) {
                is_unchanged &= o->X[k] == 4321.5;
            }
            char text[300];
            if (!is_named(status, wrongs[wrong].words, text, sizeof text) || !is_right ||
                !is_unchanged) {
                print_error("%s, %s: %s%s\n", calls[call].name, wrongs[wrong].name, text,
                            is_unchanged ? "" : ", X was written");
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
