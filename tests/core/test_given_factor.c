/* test_given_factor.c: calls on a factor with a history give what they give on one made new */
#include "tests/lib/test.h"

enum { SIDE = 9, N = SIDE * SIDE, PICKED = 12 };

typedef enum kind { FLOATS, SKIPPED, REGULARIZED, CHANGED, LOADED, KINDS } kind;

static const char *const kind_names[KINDS] = {"float", "skipped", "regularized", "changed",
                                              "loaded"};

typedef struct given {
    sl_int p[N + 1], i[3 * N], rows[PICKED];
    double x[3 * N];
    sl_csc A;
    sl_symbolic *S;
    sl_factor *anew, *F;
    sl_saved_set set; /* of a loaded factor */
} given;

/* The Laplacian of a grid, with shift on its diagonal. */
static void given_matrix(given *g, double shift) {
    sl_int e = 0;
    for (sl_int j = 0; j < N; j++) {
        const sl_int u = j % SIDE, v = j / SIDE;
        g->p[j] = e;
        g->i[e] = j;
        g->x[e++] = (u > 0) + (u + 1 < SIDE) + (v > 0) + (v + 1 < SIDE) + shift;
        if (u + 1 < SIDE) {
            g->i[e] = j + 1;
            g->x[e++] = -1.0;
        }
        if (v + 1 < SIDE) {
            g->i[e] = j + SIDE;
            g->x[e++] = -1.0;
        }
    }
    g->p[N] = e;
    g->A.n_rows = g->A.n_cols = N;
    g->A.p = g->p;
    g->A.i = g->i;
    g->A.x = g->x;
    for (sl_int k = 0; k < PICKED; k++) {
        g->rows[k] = 5 * k + 3;
    }
}

static sl_options given_options(kind of) {
    sl_options opt = options_none();
    opt.storage = of == FLOATS ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
    opt.pivots = of == SKIPPED ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
    opt.regularization = of == REGULARIZED ? 1e-4 : 0.0;
    return opt;
}

/* F becomes a factor of A in the way of its kind; anew is made from A. */
static void given_make(given *g, kind of) {
    const sl_options opt = given_options(of);
    const sl_int vp[2] = {0, 1}, row = 7;
    const double root = 1.5;
    const sl_csc V = {N, 1, vp, &row, &root};
    memset(g, 0, sizeof *g);
    given_matrix(g, 0.7); /* F held other numbers before */
    SL_CHECK(sl_symbolic_create(&g->S, &g->A, NULL, NULL));
    SL_CHECK(sl_factor_create(&g->F, g->S, &g->A, &opt, NULL));
    given_matrix(g, of == SKIPPED || of == REGULARIZED ? 0.0 : 0.1);
    SL_CHECK(sl_factor_refactor(g->F, &g->A, NULL));
    if (of == CHANGED) {
        SL_CHECK(sl_factor_rank_update(g->F, &V, NULL, NULL, NULL));
        g->x[g->p[row]] += root * root;
    } else if (of == LOADED) {
        sl_saved_set set = {0};
        size_t bytes = 0;
        set.symbolic = g->S;
        set.factor = g->F;
        SL_CHECK(sl_save(NULL, NULL, &bytes, &set, NULL));
        void *memory = test_array(bytes, 1);
        SL_CHECK(sl_save(NULL, memory, &bytes, &set, NULL));
        SL_CHECK(sl_load(&g->set, NULL, memory, bytes, SL_LOAD_CHECKED, NULL));
        free(memory);
        sl_factor_free(g->F);
        g->F = g->set.factor;
    }
    SL_CHECK(sl_factor_create(&g->anew, g->S, &g->A, &opt, NULL));
}

static void given_free(given *g) {
    if (g->set.factor == NULL) {
        sl_factor_free(g->F);
    }
    sl_saved_set_free(&g->set);
    sl_factor_free(g->anew);
    sl_symbolic_free(g->S);
}

/* ---- the calls: each writes at most N numbers ---- */

static sl_status call_solve(const given *g, const sl_factor *F, double *out) {
    double b[N];
    for (int k = 0; k < N; k++) {
        b[k] = k == 3 ? 1.0 : k == 40 ? -1.0 : 0.0;
    }
    (void)g;
    return sl_factor_solve(F, out, N, b, N, 1, NULL);
}

static sl_status call_diagonal(const given *g, const sl_factor *F, double *out) {
    return sl_inverse_diagonal(F, out, g->rows, PICKED, NULL, NULL);
}

static sl_status call_selected(const given *g, const sl_factor *F, double *out) {
    sl_selected *Z;
    sl_status s = sl_selected_create(&Z, F, g->rows, PICKED, NULL, NULL);
    if (s == SL_OK) {
        s = sl_selected_entries(Z, out, g->rows, g->rows, PICKED, NULL);
    }
    sl_selected_free(Z);
    return s;
}

static sl_status call_constraints(const given *g, const sl_factor *F, double *out) {
    sl_constraints *P;
    double b[N] = {0.0}, values[PICKED];
    for (int k = 0; k < PICKED; k++) {
        values[k] = 1.0 + k;
    }
    sl_status s = sl_constraints_create(&P, F, NULL);
    if (s == SL_OK) {
        s = sl_constraints_add(P, g->rows, NULL, PICKED, NULL);
    }
    if (s == SL_OK) {
        s = sl_constraints_solve(P, NULL, out, N, b, N, values, PICKED, 1, NULL);
    }
    sl_constraints_free(P);
    return s;
}

static sl_status call_submatrix(const given *g, const sl_factor *F, double *out) {
    sl_symbolic *S;
    sl_factor *G;
    double b[PICKED] = {1.0};
    sl_status s = sl_factor_submatrix(&S, &G, F, &g->A, g->rows, PICKED, NULL, NULL);
    if (s == SL_OK) {
        s = sl_factor_solve(G, out, PICKED, b, PICKED, 1, NULL);
    }
    sl_factor_free(G);
    sl_symbolic_free(S);
    return s;
}

typedef sl_status (*call)(const given *g, const sl_factor *F, double *out);

static const struct {
    const char *name;
    call run;
} calls[] = {{"solve", call_solve},
             {"inverse_diagonal", call_diagonal},
             {"selected", call_selected},
             {"constraints", call_constraints},
             {"submatrix", call_submatrix}};

static void a_call_gives_what_it_gives_on_a_new_factor(void **state) {
    (void)state;
    int answered = 0;
    for (int of = 0; of < KINDS; of++) {
        given g;
        given_make(&g, (kind)of);
        for (size_t c = 0; c < sizeof calls / sizeof *calls; c++) {
            double x[N] = {0.0}, y[N] = {0.0}, most = 0.0, error = 0.0;
            const sl_status s = calls[c].run(&g, g.F, x), t = calls[c].run(&g, g.anew, y);
            for (int k = 0; k < N; k++) {
                most = fmax(most, fabs(y[k]));
                error = fmax(error, fabs(x[k] - y[k]));
            }
            if (s != t || !(error <= 1e-12 * most)) {
                fail_msg("%s, %s factor: %s, new %s, difference %g of %g", calls[c].name,
                         kind_names[of], sl_status_string(s), sl_status_string(t), error, most);
            }
            answered += s == SL_OK;
        }
        given_free(&g);
    }
    assert_true(answered >= 15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_call_gives_what_it_gives_on_a_new_factor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
