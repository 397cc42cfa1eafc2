/* test_lifetimes.c: objects made from others, freed in every order, and by several threads */
#include "tests/lib/factored.h"
#include "tests/lib/parallel_for.h"

enum { N = 16, OBJECTS = 6, ORDERS = 720 };

/* An analysis and what is made from it; NULL once it is freed. */
typedef struct objects_t {
    sl_symbolic *S;
    sl_factor *F;
    sl_plan *P; /* in R */
    sl_region *R;
    sl_selected *Z;
    sl_constraints *pins;
} objects_t;

static const sl_int set[4] = {0, 1, 4, 5};

static objects_t objects_make(const sl_csc *A, const sl_options *opt) {
    objects_t o;
    sl_options in_region = *opt;
    SL_CHECK(sl_symbolic_create(&o.S, A, opt, NULL));
    SL_CHECK(sl_factor_create(&o.F, o.S, A, opt, NULL));
    SL_CHECK(sl_selected_create(&o.Z, o.F, NULL, SL_ALL, opt, NULL));
    SL_CHECK(sl_region_create(&o.R, o.F, set, 4, NULL, opt, NULL));
    in_region.region = o.R;
    SL_CHECK(sl_plan_create(&o.P, o.S, set, 4, set, 4, &in_region, NULL));
    SL_CHECK(sl_constraints_create(&o.pins, o.F, opt));
    SL_CHECK(sl_constraints_add(o.pins, set, NULL, 1, NULL));
    return o;
}

static void objects_free(objects_t *o, int which) {
    switch (which) {
    case 0:
        sl_symbolic_free(o->S);
        o->S = NULL;
        break;
    case 1:
        sl_factor_free(o->F);
        o->F = NULL;
        break;
    case 2:
        sl_plan_free(o->P);
        o->P = NULL;
        break;
    case 3:
        sl_region_free(o->R);
        o->R = NULL;
        break;
    case 4:
        sl_selected_free(o->Z);
        o->Z = NULL;
        break;
    default:
        sl_constraints_free(o->pins);
        o->pins = NULL;
    }
}

/* Uses what is left. */
static void objects_use(const objects_t *o, const double *b, const double *x, const double *held) {
    const double g = 2.0;
    double y[N];
    if (o->F != NULL) {
        SL_CHECK(sl_factor_solve(o->F, y, N, b, N, 1, NULL));
        assert_memory_equal(y, x, sizeof y);
    }
    if (o->F != NULL && o->P != NULL) {
        SL_CHECK(sl_plan_solve(o->P, o->F, y, 4, b, 4, 1, NULL));
    }
    if (o->pins != NULL) {
        SL_CHECK(sl_constraints_solve(o->pins, NULL, y, N, b, N, &g, 1, 1, NULL));
        assert_memory_equal(y, held, sizeof y);
    }
    (void)sl_region_view(o->R);
    (void)sl_selected_view(o->Z);
    (void)sl_symbolic_view(o->S);
}

static void every_order_of_frees(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, N, 1, 1);
    double b[N], x[N], held[N];
    gen_reals(b, N, 3);
    for (int k = 0; k < ORDERS; k++) {
        counter_t c = counter_make();
        const sl_options opt = options_counted(&c);
        objects_t o = objects_make(&M.view, &opt);
        int left[OBJECTS] = {0, 1, 2, 3, 4, 5}, order = k;
        const double g = 2.0;
        SL_CHECK(sl_factor_solve(o.F, x, N, b, N, 1, NULL));
        SL_CHECK(sl_constraints_solve(o.pins, NULL, held, N, b, N, &g, 1, 1, NULL));
        for (int count = OBJECTS; count > 0; count--) {
            const int at = order % count;
            order /= count;
            objects_free(&o, left[at]);
            left[at] = left[count - 1];
            objects_use(&o, b, x, held);
        }
        COUNTER_CLEAN(&c);
    }
    gen_matrix_free(&M);
}

/* A restricted factor and its analysis, an object of fixed rows, and factors of a batch. */
static void other_objects(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 400, 1, 1);
    counter_t c = counter_make();
    const sl_options opt = options_counted(&c);
    sl_int rows[200];
    double x[400] = {0.0}, g = 1.0;
    sl_symbolic *S = NULL, *T = NULL;
    sl_factor *F = NULL, *G = NULL;
    sl_fixed *D = NULL;
    for (sl_int k = 0; k < 200; k++) {
        rows[k] = k;
    }
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    SL_CHECK(sl_factor_create(&F, S, &M.view, &opt, NULL));
    SL_CHECK(sl_factor_submatrix(&T, &G, F, &M.view, rows, 200, &opt, NULL));
    SL_CHECK(sl_fixed_create(&D, &M.view, rows, 1, &opt, NULL));
    sl_symbolic_free(T);
    sl_symbolic_free(S);
    sl_factor_free(F);
    SL_CHECK(sl_factor_solve(G, x, 200, x, 200, 1, NULL));
    SL_CHECK(sl_fixed_solve(D, x, 400, NULL, 0, &g, 1, 1, NULL));
    sl_factor_free(G);
    sl_fixed_free(D);
    COUNTER_CLEAN(&c);
    gen_matrix_free(&M);
}

/* Mapped memory holds the arrays of all objects. */
static void objects_of_a_mapped_set(void **state) {
    (void)state;
    factored_t y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    double b[N], x[N], got[N];
    size_t bytes;
    sl_saved_set set_of, mapped;
    gen_reals(b, N, 3);
    SL_CHECK(sl_factor_solve(y.F, x, N, b, N, 1, NULL));
    memset(&set_of, 0, sizeof set_of);
    memset(&mapped, 0, sizeof mapped);
    set_of.symbolic = y.S;
    set_of.factor = y.F;
    SL_CHECK(sl_save(NULL, NULL, &bytes, &set_of, NULL));
    char *block = (char *)test_array(bytes + 64, 1);
    char *at = block + (64 - (uintptr_t)block % 64) % 64;
    SL_CHECK(sl_save(NULL, at, &bytes, &set_of, NULL));
    SL_CHECK(sl_load(&mapped, NULL, at, bytes, SL_LOAD_MAPPED, NULL));
    sl_symbolic_free(mapped.symbolic);
    SL_CHECK(sl_factor_solve(mapped.factor, got, N, b, N, 1, NULL));
    assert_memory_equal(got, x, sizeof x);
    mapped.symbolic = NULL;
    sl_saved_set_free(&mapped);
    free(block);
    factored_free(&y);
}

enum { THREADS = 4, TURNS = 2000 };

/* Makes and frees plans over an analysis that others use, too. */
static void make_plans(void *data, sl_int k) {
    const sl_symbolic *S = (const sl_symbolic *)data;
    const sl_int row = k;
    for (int turn = 0; turn < TURNS; turn++) {
        sl_plan *P = NULL;
        if (sl_plan_create(&P, S, &row, 1, &row, 1, NULL, NULL) != SL_OK) {
            abort();
        }
        sl_plan_free(P);
    }
}

static void threads_may_borrow_at_once(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, N, 1, 1);
    counter_t c = counter_make();
    const sl_options opt = options_counted(&c);
    sl_symbolic *S = NULL;
    int calls = 0;
    SL_CHECK(sl_symbolic_create(&S, &M.view, &opt, NULL));
    run_threads(&calls, THREADS, make_plans, S);
    assert_int_equal(c.live_blocks, 1);
    sl_symbolic_free(S);
    COUNTER_CLEAN(&c);
    gen_matrix_free(&M);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_order_of_frees),
        cmocka_unit_test(other_objects),
        cmocka_unit_test(objects_of_a_mapped_set),
        cmocka_unit_test(threads_may_borrow_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
