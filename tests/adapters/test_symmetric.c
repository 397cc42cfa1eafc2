/* test_symmetric.c: any symmetric system: the way it takes, its solution, its inertia */
#include "tests/lib/dense_eigen.h"

#include "tools/adapters/sparse_local_symmetric.h"

enum { MOST = 24 };

/* A dense symmetric matrix, and its lower triangle as a sparse one. */
typedef struct system_t {
    int n;
    double dense[MOST * MOST];
    sl_int p[MOST + 1], i[MOST * MOST];
    double x[MOST * MOST];
    sl_csc A;
} system_t;

static void set(system_t *s, int i, int j, double value) {
    s->dense[i + s->n * j] = s->dense[j + s->n * i] = value;
}

static void begin(system_t *s, int n) {
    memset(s, 0, sizeof *s);
    s->n = n;
}

static void finish(system_t *s) {
    sl_int count = 0;
    for (int j = 0; j < s->n; j++) {
        s->p[j] = count;
        for (int i = j; i < s->n; i++) {
            if (s->dense[i + s->n * j] != 0) {
                s->i[count] = i;
                s->x[count++] = s->dense[i + s->n * j];
            }
        }
    }
    s->p[s->n] = count;
    const sl_csc A = {s->n, s->n, s->p, s->i, s->x};
    s->A = A;
}

static void multiply(const system_t *s, double *b, const double *x) {
    for (int i = 0; i < s->n; i++) {
        b[i] = 0;
        for (int j = 0; j < s->n; j++) {
            b[i] += s->dense[i + s->n * j] * x[j];
        }
    }
}

static double uniform(uint64_t *seed) {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

/* How far x is from a solution: componentwise, or if A is singular relative to the largest row. */
static double backward_error(const sl_symmetric *M, const system_t *s, const double *x,
                             const double *b) {
    double worst = 0, largest = 0;
    for (int i = 0; i < s->n; i++) {
        double residual = b[i], size = fabs(b[i]);
        for (int j = 0; j < s->n; j++) {
            residual -= s->dense[i + s->n * j] * x[j];
            size += fabs(s->dense[i + s->n * j] * x[j]);
        }
        const double of = M->way == SL_SYMMETRIC_SINGULAR ? 1 / M->scale[i] : size;
        worst = residual == 0 ? worst : fmax(worst, fabs(residual) / of);
        largest = fmax(largest, M->scale[i] * size);
    }
    return M->way == SL_SYMMETRIC_SINGULAR && largest > 0 ? worst / largest : worst;
}

static sl_symmetric *create(const system_t *s, sl_symmetric_way way) {
    sl_symmetric *M;
    assert_true(sl_symmetric_create(&M, &s->A, NULL, NULL) == SL_OK);
    assert_int_equal(M->way, way);
    return M;
}

static void check_inertia(sl_symmetric *M, sl_int positive, sl_int negative, sl_int zero) {
    sl_inertia inertia;
    assert_true(sl_symmetric_inertia(M, &inertia, NULL) == SL_OK);
    assert_int_equal(inertia.positive, positive);
    assert_int_equal(inertia.negative, negative);
    assert_int_equal(inertia.zero, zero);
    assert_true((inertia.bound == 0) == (zero == 0));
}

/* A path whose ends are held: definite. */
static void definite_takes_the_fixed_order(void **state) {
    (void)state;
    system_t s;
    begin(&s, 10);
    for (int k = 0; k < 10; k++) {
        set(&s, k, k, 2);
        if (k > 0) {
            set(&s, k, k - 1, -1);
        }
    }
    finish(&s);
    sl_symmetric *M = create(&s, SL_SYMMETRIC_FIXED);
    double X[3 * 12], B[3 * 12];
    for (int c = 0; c < 3; c++) {
        double x[10];
        for (int k = 0; k < 10; k++) {
            x[k] = k + 2 * c - 5;
        }
        multiply(&s, B + (size_t)12 * (size_t)c, x);
    }
    sl_stats stats;
    assert_true(sl_symmetric_solve(M, X, 12, B, 12, 3, &stats) == SL_OK);
    assert_true(stats.refine.backward_error <= SL_SYMMETRIC_ERROR);
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 10; k++) {
            assert_true(fabs(X[12 * c + k] - (k + 2 * c - 5)) < 1e-12);
        }
    }
    check_inertia(M, 10, 0, 0);
    sl_symmetric_free(M);
}

/* [e 1; 1 1] has a pivot of e in its order, and [0 1; 1 0] none at all. */
static void small_pivots_are_avoided(void **state) {
    (void)state;
    static const double corners[] = {0, 1e-20, 1e-200, -1e-20};
    for (size_t k = 0; k < sizeof corners / sizeof *corners; k++) {
        system_t s;
        begin(&s, 2);
        set(&s, 0, 0, corners[k]);
        set(&s, 1, 0, 1);
        set(&s, 1, 1, corners[k] == 0 ? 0 : corners[k] * 2);
        finish(&s);
        sl_symmetric *M = create(&s, SL_SYMMETRIC_PIVOTED);
        double x[2] = {3, 2}; /* the right-hand side is the place of the solution, too */
        assert_true(sl_symmetric_solve(M, x, 2, x, 2, 1, NULL) == SL_OK);
        assert_true(fabs(x[0] - 2) < 1e-14 && fabs(x[1] - 3) < 1e-14);
        check_inertia(M, 1, 1, 0);
        sl_symmetric_free(M);
    }
}

/* A closed path: x is determined up to a constant, and b sums to 0. */
static void singular_systems_have_short_solutions(void **state) {
    (void)state;
    system_t s;
    begin(&s, 12);
    for (int k = 0; k < 12; k++) {
        set(&s, k, k, 2);
        set(&s, k, (k + 1) % 12, -1);
    }
    finish(&s);
    sl_symmetric *M = create(&s, SL_SYMMETRIC_SINGULAR);
    double b[12] = {0}, x[12], mean = 0;
    b[3] = 1;
    b[8] = -1;
    assert_true(sl_symmetric_solve(M, x, 12, b, 12, 1, NULL) == SL_OK);
    assert_true(backward_error(M, &s, x, b) < 1e-12);
    for (int k = 0; k < 12; k++) {
        mean += x[k] / 12;
    }
    assert_true(fabs(mean) < 1e-5 && fabs(x[3] - x[8]) < 5);
    check_inertia(M, 11, 0, 1);

    sl_stats stats;
    char text[200];
    b[8] = 1;
    assert_true(sl_symmetric_solve(M, x, 12, b, 12, 1, &stats) == SL_ERR_INACCURATE);
    assert_true(stats.refine.backward_error > SL_SYMMETRIC_SINGULAR_ERROR);
    (void)sl_error_text(text, sizeof text, SL_ERR_INACCURATE, &stats);
    assert_non_null(strstr(text, "no solution"));
    sl_symmetric_free(M);
}

/* A system of an interior-point method, early or late, or with zeros and negative numbers in H, the
 * first rows; a constraint twice; all rows scaled. */
static void constrained(system_t *s, int kind, uint64_t *seed) {
    const int rows = 4 + (int)(10 * uniform(seed)),
              constraints = 1 + (int)(uniform(seed) * rows / 2);
    begin(s, rows + constraints);
    for (int k = 0; k < rows; k++) {
        const double late = pow(10, 16 * uniform(seed) - 8);
        const double any = uniform(seed) < 0.5 ? 0 : uniform(seed) - 0.5;
        set(s, k, k, kind == 0 ? 0.1 + uniform(seed) : kind == 1 ? late : any);
    }
    for (int c = rows; c < s->n; c++) {
        for (int k = 0; k < 4; k++) {
            set(s, c, (int)(uniform(seed) * rows), uniform(seed) - 0.5);
        }
    }
    for (int k = 0; k < rows && kind == 3 && constraints > 1; k++) { /* one of them twice */
        set(s, s->n - 1, k, 2 * s->dense[rows + s->n * k]);
    }
    for (int k = 0; k < s->n && kind == 4; k++) {
        const double scale = ldexp(1, (int)(40 * uniform(seed)) - 20);
        for (int j = 0; j < s->n; j++) {
            s->dense[k + s->n * j] *= scale;
            s->dense[j + s->n * k] *= scale;
        }
    }
    finish(s);
}

/* The signs of the eigenvalues; is none of them near 0 without being it? */
static int counted(const double *scale, const system_t *s, int sign[3]) {
    double D[MOST * MOST], V[MOST * MOST], largest = 0;
    int is_certain = 1;
    for (int j = 0; j < s->n; j++) {
        for (int i = 0; i < s->n; i++) {
            D[i + s->n * j] = s->dense[i + s->n * j] * scale[i] * scale[j];
        }
    }
    eigen_all(D, V, s->n);
    for (int k = 0; k < s->n; k++) {
        largest = fmax(largest, fabs(D[k * (s->n + 1)]));
    }
    sign[0] = sign[1] = sign[2] = 0;
    for (int k = 0; k < s->n; k++) {
        const double value = D[k * (s->n + 1)] / largest;
        is_certain &= fabs(value) < 1e-15 || fabs(value) > 1e-10;
        sign[1 + (value > 1e-13) - (value < -1e-13)]++;
    }
    return is_certain;
}

static void kkt_systems_are_solved_and_counted(void **state) {
    (void)state;
    uint64_t seed = 88172645463325252u;
    int counts[3] = {0}, certain = 0, unsolved = 0;
    for (int t = 0; t < 1500; t++) {
        system_t s;
        double x[MOST], b[MOST], y[MOST];
        sl_symmetric *M;
        sl_inertia inertia;
        int sign[3];
        constrained(&s, t % 5, &seed);
        for (int k = 0; k < s.n; k++) {
            x[k] = uniform(&seed) - 0.5;
        }
        multiply(&s, b, x);
        assert_true(sl_symmetric_create(&M, &s.A, NULL, NULL) == SL_OK);
        if (sl_symmetric_solve(M, y, (size_t)s.n, b, (size_t)s.n, 1, NULL) == SL_OK) {
            assert_true(backward_error(M, &s, y, b) < 2 * SL_SYMMETRIC_ERROR);
        } else {
            unsolved++;
        }
        counts[M->way]++;
        assert_true(sl_symmetric_inertia(M, &inertia, NULL) == SL_OK);
        if (counted(M->scale, &s, sign)) {
            certain++;
            assert_int_equal(inertia.negative, sign[0]);
            assert_int_equal(inertia.zero, sign[1]);
            assert_int_equal(inertia.positive, sign[2]);
        }
        sl_symmetric_free(M);
    }
    assert_true(unsolved == 0 && certain > 1400);
    assert_true(counts[0] > 300 && counts[1] > 50 && counts[2] > 100);
}

static void new_values_begin_again(void **state) {
    (void)state;
    system_t s, other;
    begin(&s, 3);
    for (int k = 0; k < 3; k++) {
        set(&s, k, k, 1);
        set(&s, k, (k + 1) % 3, 0.25);
    }
    finish(&s);
    sl_symmetric *M = create(&s, SL_SYMMETRIC_FIXED);
    double x[3] = {1, 2, 3}, b[3];
    for (int k = 0; k < 6; k++) { /* all entries are 1: singular */
        s.x[k] = 1;
    }
    assert_true(sl_symmetric_refactor(M, &s.A, NULL) == SL_OK);
    assert_int_equal(M->way, SL_SYMMETRIC_SINGULAR);
    check_inertia(M, 1, 0, 2);
    s.x[0] = 5;
    s.x[3] = -5;
    set(&s, 0, 0, 5);
    set(&s, 1, 1, -5);
    for (int k = 0; k < 3; k++) {
        set(&s, k, (k + 1) % 3, 1);
    }
    assert_true(sl_symmetric_refactor(M, &s.A, NULL) == SL_OK);
    assert_int_equal(M->way, SL_SYMMETRIC_FIXED);
    multiply(&s, b, x);
    assert_true(sl_symmetric_solve(M, b, 3, b, 3, 1, NULL) == SL_OK);
    for (int k = 0; k < 3; k++) {
        assert_true(fabs(b[k] - x[k]) < 1e-14);
    }
    check_inertia(M, 2, 1, 0);

    sl_stats stats;
    s.x[4] = NAN;
    assert_true(sl_symmetric_refactor(M, &s.A, &stats) == SL_ERR_NOT_FINITE);
    assert_int_equal(stats.error.row, 2);
    begin(&other, 3);
    set(&other, 0, 0, 1);
    finish(&other);
    assert_true(sl_symmetric_refactor(M, &other.A, NULL) == SL_ERR_OTHER_PATTERN);
    check_inertia(M, 2, 1, 0); /* unchanged */
    sl_symmetric_free(M);
}

static void wrong_calls_are_refused(void **state) {
    (void)state;
    system_t s;
    sl_stats stats;
    sl_symmetric *M = NULL;
    double b[4] = {1, NAN, 1, 1}, x[4];
    begin(&s, 2);
    set(&s, 0, 0, 1);
    set(&s, 1, 1, -1);
    finish(&s);
    const sl_csc no_values = {2, 2, s.p, s.i, NULL}, wide = {3, 2, s.p, s.i, s.x};
    assert_true(sl_symmetric_create(NULL, &s.A, NULL, NULL) == SL_ERR_ARGUMENT);
    assert_true(sl_symmetric_create(&M, NULL, NULL, NULL) == SL_ERR_ARGUMENT && M == NULL);
    assert_true(sl_symmetric_create(&M, &no_values, NULL, NULL) == SL_ERR_ARGUMENT && M == NULL);
    assert_true(sl_symmetric_create(&M, &wide, NULL, NULL) == SL_ERR_ARGUMENT && M == NULL);
    M = create(&s, SL_SYMMETRIC_FIXED);
    assert_true(sl_symmetric_solve(M, x, 2, b, 2, 1, &stats) == SL_ERR_NOT_FINITE);
    assert_int_equal(stats.error.row, 1);
    assert_true(sl_symmetric_solve(M, x, 2, b, 2, -1, NULL) == SL_ERR_ARGUMENT);
    assert_true(sl_symmetric_solve(M, x, 1, b, 2, 2, NULL) == SL_ERR_ARGUMENT);
    assert_true(sl_symmetric_solve(M, NULL, 2, b, 2, 1, NULL) == SL_ERR_ARGUMENT);
    assert_true(sl_symmetric_solve(M, x, 2, b, 2, 0, NULL) == SL_OK);
    assert_true(sl_symmetric_inertia(M, NULL, NULL) == SL_ERR_ARGUMENT);
    assert_true(sl_symmetric_refactor(M, NULL, NULL) == SL_ERR_ARGUMENT);
    sl_symmetric_free(M);
    sl_symmetric_free(NULL);

    const sl_int none[1] = {0};
    const sl_csc empty = {0, 0, none, none, b};
    assert_true(sl_symmetric_create(&M, &empty, NULL, NULL) == SL_OK);
    assert_true(sl_symmetric_solve(M, x, 1, b, 1, 1, NULL) == SL_OK);
    check_inertia(M, 0, 0, 0);
    sl_symmetric_free(M);
}

/* Every allocation of the library fails once, in each way. */
static void memory_that_ends_is_reported(void **state) {
    (void)state;
    system_t s;
    int failures = 0;
    begin(&s, 3);
    for (int k = 0; k < 3; k++) {
        set(&s, k, k, 1);
        set(&s, k, (k + 1) % 3, 1);
    }
    finish(&s);
    for (int64_t k = 0; k < 1000; k++) {
        counter_t c = counter_make();
        c.fail_at = k;
        const sl_options opt = options_counted(&c);
        sl_symmetric *M;
        double b[3] = {3, 3, 3}, x[3];
        sl_status status = sl_symmetric_create(&M, &s.A, &opt, NULL);
        if (status == SL_OK) {
            status = sl_symmetric_solve(M, x, 3, b, 3, 1, NULL);
            sl_symmetric_free(M);
        }
        COUNTER_CLEAN(&c);
        if (status == SL_OK) {
            break;
        }
        assert_int_equal(status, SL_ERR_MEMORY);
        failures++;
    }
    assert_true(failures > 5 && failures < 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(definite_takes_the_fixed_order),
        cmocka_unit_test(small_pivots_are_avoided),
        cmocka_unit_test(singular_systems_have_short_solutions),
        cmocka_unit_test(kkt_systems_are_solved_and_counted),
        cmocka_unit_test(new_values_begin_again),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(memory_that_ends_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
