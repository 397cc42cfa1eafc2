/* test_layouts.c: calls that correct, constrain and multiply give the same bits in any layout */
#include "tests/lib/constraint_calls.h"
#include "tests/lib/factored.h"
#include "tests/lib/kkt.h"

enum { SIZE = 144, NB = 20, NX = 33, PINS = 3, KKT = 90, MOST = 11, GAP = 3 };

/* A block of the caller's, and whose elements it does not use are 1234.5. */
typedef struct block_t {
    double *at;
    size_t ld; /* as calls take it */
    size_t rows, columns, step;
    int by_rows;
} block_t;

static size_t place(const block_t *b, size_t i, size_t r) {
    return b->by_rows ? i * b->step + r : i + r * b->step;
}

/* values: rows x columns, column-major */
static block_t block_of(const double *values, size_t rows, size_t columns, int by_rows) {
    block_t b = {NULL, 0, rows, columns, (by_rows ? columns : rows) + GAP, by_rows};
    const size_t size = b.step * (by_rows ? rows : columns);
    b.ld = by_rows ? SL_ROWS(b.step) : b.step;
    b.at = test_reals(size + 1);
    for (size_t k = 0; k < size; k++) {
        b.at[k] = 1234.5;
    }
    for (size_t r = 0; r < columns; r++) {
        for (size_t i = 0; i < rows; i++) {
            b.at[place(&b, i, r)] = values[i + r * rows];
        }
    }
    return b;
}

/* The block holds these values, and its other elements are as they were. */
static void assert_block(const block_t *b, const double *values) {
    const size_t size = b->step * (b->by_rows ? b->rows : b->columns);
    size_t others = size - b->rows * b->columns;
    for (size_t r = 0; r < b->columns; r++) {
        for (size_t i = 0; i < b->rows; i++) {
            assert_memory_equal(b->at + place(b, i, r), values + i + r * b->rows, sizeof(double));
        }
    }
    for (size_t k = 0; k < size; k++) {
        others -= b->at[k] == 1234.5;
    }
    assert_int_equal(others, 0);
}

/* A grid with a plan and pins, a regularized saddle point, and a singular Laplacian. */
typedef struct systems_t {
    factored_t grid, singular;
    kkt_t kkt;
    sl_factor *regularized;
    sl_plan *P, *all;
    sl_constraints *pins;
} systems_t;

static systems_t systems_make(sl_isa isa) {
    systems_t y;
    sl_options opt = options_none();
    sl_int bset[SIZE], xset[SIZE];
    memset(&y, 0, sizeof y);
    opt.isa = isa;
    y.grid = factored_make(GEN_GRID2, SIZE, 1, 0, &opt);
    SL_CHECK(sl_factor_certify(y.grid.F, &y.grid.M.view, SL_ESTIMATED, NULL, NULL));
    gen_set(bset, NB, SIZE, 1);
    gen_set(xset, NX, SIZE, 2);
    SL_CHECK(sl_plan_create(&y.P, y.grid.S, bset, NB, xset, NX, NULL, NULL));
    SL_CHECK(sl_constraints_create(&y.pins, y.grid.F, NULL));
    SL_CHECK(sl_constraints_add(y.pins, xset, NULL, PINS, NULL));
    y.kkt = kkt_make(KKT, 0, SL_ORDERING_ND);
    opt.regularization = 1e-7;
    opt.signs = y.kkt.signs;
    SL_CHECK(sl_factor_create(&y.regularized, y.kkt.S, &y.kkt.M.view, &opt, NULL));
    SL_CHECK(sl_plan_create(&y.all, y.kkt.S, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL));
    opt = options_none();
    opt.isa = isa;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    y.singular = factored_make(GEN_SINGULAR, SIZE, 1, 0, &opt);
    return y;
}

static void systems_free(systems_t *y) {
    sl_constraints_free(y->pins);
    sl_plan_free(y->P);
    sl_plan_free(y->all);
    sl_factor_free(y->regularized);
    kkt_free(&y->kkt);
    factored_free(&y->grid);
    factored_free(&y->singular);
}

/* ---- the calls: X is what they write, B and G what they read; extra: numbers beside ---- */

#define CALL(name, what) \
    static sl_status name(const systems_t *y, block_t X, block_t B, block_t G, sl_int nrhs, \
                          double *extra) { \
        const sl_csc *A = &y->grid.M.view; \
        const sl_factor *F = y->grid.F; \
        sl_stats stats; \
        sl_status status; \
        memset(&stats, 0, sizeof stats); \
        status = what; \
        extra[0] = extra[0] + stats.refine.backward_error + stats.refine.steps; \
        (void)A; \
        (void)F; \
        (void)G; \
        return status; \
    }

CALL(refine, sl_factor_refine(F, A, X.at, X.ld, B.at, B.ld, nrhs, 3, NULL, &stats))
CALL(regularized, sl_plan_solve_regularized(y->all, y->regularized, X.at, X.ld, B.at, B.ld, nrhs, 5,
                                            NULL, &stats))
CALL(bounded, sl_plan_solve_bounded(y->P, F, X.at, X.ld, G.at, B.at, B.ld, nrhs, NULL, NULL, NULL))
CALL(pinned, sl_constraints_solve(y->pins, NULL, X.at, X.ld, B.at, B.ld, G.at, G.ld, nrhs, NULL))
CALL(pinned_local,
     sl_constraints_solve(y->pins, y->P, X.at, X.ld, B.at, B.ld, G.at, G.ld, nrhs, NULL))
CALL(product, sl_csc_multiply(A, SL_AS_SYMMETRIC, X.at, X.ld, B.at, B.ld, nrhs))
CALL(as_stored, sl_csc_multiply(A, SL_AS_STORED, X.at, X.ld, B.at, B.ld, nrhs))
CALL(residual,
     sl_csc_residual(A, X.at, X.ld, X.at == B.at ? NULL : extra, G.at, G.ld, B.at, B.ld, nrhs))
CALL(defects, sl_factor_defects(y->singular.F, X.at, X.ld, B.at, B.ld, nrhs, NULL))

typedef struct call_t {
    sl_status (*run)(const systems_t *y, block_t X, block_t B, block_t G, sl_int nrhs,
                     double *extra);
    size_t nx, nb, ng;
    int g_follows; /* G has the layout of X */
    int in_place;  /* X may be B */
} call_t;

static const call_t calls[] = {
    {refine, SIZE, SIZE, 0, 0, 0},      {regularized, KKT, KKT, 0, 0, 1},
    {bounded, NX, NB, NX, 1, 0},        {pinned, SIZE, SIZE, PINS, 0, 1},
    {pinned_local, NX, NB, PINS, 0, 0}, {product, SIZE, SIZE, 0, 0, 0},
    {as_stored, SIZE, SIZE, 0, 0, 0},   {residual, SIZE, SIZE, SIZE, 0, 1},
    {defects, 1, SIZE, 0, 0, 0},
};
enum { CALLS = sizeof calls / sizeof calls[0] };

/* Values of the three blocks of a call, column-major, before it. */
typedef struct values_t {
    double *X, *B, *G;
} values_t;

static values_t values_make(const systems_t *y, const call_t *call) {
    values_t v = {test_reals(call->nx * MOST), test_reals(call->nb * MOST),
                  test_reals(call->ng * MOST + 1)};
    gen_reals(v.X, call->nx * MOST, 3);
    gen_reals(v.B, call->nb * MOST, 4);
    gen_reals(v.G, call->ng * MOST, 5);
    for (size_t r = 1; call->run == refine && r < MOST; r += 2) { /* no step changes these */
        SL_CHECK(sl_factor_solve(y->grid.F, v.X + r * SIZE, SIZE, v.B + r * SIZE, SIZE, 1, NULL));
    }
    return v;
}

static void values_free(values_t *v) {
    free(v->X);
    free(v->B);
    free(v->G);
}

static void assert_layouts(const systems_t *y, const call_t *call, sl_int nrhs) {
    const size_t columns = (size_t)nrhs;
    values_t v = values_make(y, call), to = values_make(y, call);
    const block_t X = {to.X, call->nx, call->nx, columns, call->nx, 0};
    const block_t B = {v.B, call->nb, call->nb, columns, call->nb, 0};
    const block_t G = {to.G, call->ng, call->ng, columns, call->ng, 0};
    double extra[MOST + 1] = {0}, found[MOST + 1];
    SL_CHECK(call->run(y, X, B, G, nrhs, extra));
    for (int layout = 0; layout < 8; layout++) {
        const int x = layout & 1, b = layout >> 1 & 1, g = call->g_follows ? x : layout >> 2;
        block_t Xt = block_of(v.X, call->nx, columns, x), Bt = block_of(v.B, call->nb, columns, b);
        block_t Gt = block_of(v.G, call->ng, columns, g);
        memset(found, 0, sizeof found);
        SL_CHECK(call->run(y, Xt, Bt, Gt, nrhs, found));
        assert_memory_equal(found, extra, sizeof extra);
        assert_block(&Xt, to.X);
        assert_block(&Bt, v.B);
        assert_block(&Gt, to.G);
        if (call->in_place && x == b) {
            SL_CHECK(call->run(y, Bt, Bt, Gt, nrhs, found));
            assert_block(&Bt, to.X);
        }
        free(Xt.at);
        free(Bt.at);
        free(Gt.at);
    }
    values_free(&v);
    values_free(&to);
}

static void any_layout_gives_the_same_bits(void **state) {
    (void)state;
    static const sl_int counts[] = {0, 1, 3, 8, MOST};
    isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        systems_t y = systems_make(isas.isa[k]);
        for (int c = 0; c < CALLS; c++) {
            for (size_t q = 0; q < sizeof counts / sizeof counts[0]; q++) {
                assert_layouts(&y, &calls[c], counts[q]);
            }
        }
        systems_free(&y);
    }
}

/* Too short rows, none, and the bit that later layouts may use; nothing is written. */
static void wrong_rows_are_refused(void **state) {
    (void)state;
    static const size_t wrong[] = {SL_ROWS(2), SL_ROWS(0), SL_ROWS(3) | SL_ROW_MAJOR >> 1,
                                   SIZE_MAX};
    systems_t y = systems_make(SL_ISA_AUTO);
    double extra[MOST + 1];
    for (int c = 0; c < CALLS; c++) {
        const call_t *call = &calls[c];
        values_t v = values_make(&y, call);
        for (size_t w = 0; w < 3 * sizeof wrong / sizeof wrong[0]; w++) {
            block_t b[3] = {block_of(v.X, call->nx, 3, 1), block_of(v.B, call->nb, 3, 1),
                            block_of(v.G, call->ng, 3, 1)};
            const int has_g = call->ng > 0 && !call->g_follows;
            b[w % 3].ld = wrong[w / 3];
            SL_EXPECT(w % 3 == 2 && !has_g ? SL_OK : SL_ERR_ARGUMENT,
                      call->run(&y, b[0], b[1], b[2], 3, extra));
            if (w % 3 != 2 || has_g) {
                assert_block(&b[0], v.X);
                assert_block(&b[2], v.G);
            }
            assert_block(&b[1], v.B);
            for (int k = 0; k < 3; k++) {
                free(b[k].at);
            }
        }
        values_free(&v);
    }
    systems_free(&y);
}

/* Entries of the inverse are by columns. */
static void blocks_of_the_inverse_refuse_rows(void **state) {
    (void)state;
    const size_t wrong[] = {SL_ROWS(6), SL_ROWS(0), SL_ROWS(1000), SIZE_MAX};
    const sl_int set[6] = {0, 1, 2, 3, 4, 5};
    factored_t y = factored_make(GEN_PATH, 6, 1, 0, NULL);
    double Z[12] = {1, 2};
    for (int k = 0; k < 4; k++) {
        for (sl_int columns = 1; columns <= 2; columns++) {
            SL_EXPECT(SL_ERR_ARGUMENT,
                      sl_inverse_block(y.F, Z, wrong[k], set, 6, set, columns, NULL, NULL));
        }
    }
    assert_true(Z[0] == 1 && Z[1] == 2 && Z[2] == 0);
    factored_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_layout_gives_the_same_bits),
        cmocka_unit_test(wrong_rows_are_refused),
        cmocka_unit_test(blocks_of_the_inverse_refuse_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
