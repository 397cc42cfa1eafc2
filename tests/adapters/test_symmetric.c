/* test_symmetric.c: any symmetric system: the way it takes, its solution, its inertia */
#include "tests/lib/dense_eigen.h"

static long until_failure = -1; /* calls of malloc that succeed before one fails; -1: all */

static int memory_ends(void) {
    return until_failure >= 0 && until_failure-- == 0;
}

#define malloc(size) (memory_ends() ? NULL : malloc(size))
#define calloc(count, size) (memory_ends() ? NULL : calloc(count, size))

/* With SL_VERIFY a call refuses options that it does not read: each call gets its own. */
static const sl_options *of_memory(const sl_options *opt) {
    assert_true(opt->triangle == SL_TRIANGLE_NONE && opt->isa == 0 && opt->growth_limit == 0);
    return opt;
}

static const sl_options *of_analysis(const sl_options *opt) {
    assert_true(opt->isa == 0 && opt->growth_limit == 0);
    return opt;
}

static const sl_options *of_numbers(const sl_options *opt) {
    assert_true(opt->triangle == SL_TRIANGLE_NONE);
    return opt;
}

#define sl_work_create(W, opt) sl_work_create(W, of_memory(opt))
#define sl_csc_triangle(A, out, opt, stats) sl_csc_triangle(A, out, of_analysis(opt), stats)
#define sl_symbolic_create(S, A, opt, stats) sl_symbolic_create(S, A, of_analysis(opt), stats)
#define sl_symbolic_create_pivoted(S, A, opt, stats) \
    sl_symbolic_create_pivoted(S, A, of_analysis(opt), stats)
#define sl_factor_create(F, S, A, opt, stats) sl_factor_create(F, S, A, of_numbers(opt), stats)
#include "tools/adapters/sparse_local_symmetric.h"
#undef malloc
#undef calloc
#undef sl_work_create
#undef sl_csc_triangle
#undef sl_symbolic_create
#undef sl_symbolic_create_pivoted
#undef sl_factor_create

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
        const double of = M->way == SL_SYMMETRIC_SINGULAR ? ldexp(1, -M->scale[i]) : size;
        worst = residual == 0 ? worst : fmax(worst, fabs(residual) / of);
        largest = fmax(largest, ldexp(size, M->scale[i]));
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
static int counted(const int *scale, const system_t *s, int sign[3]) {
    double D[MOST * MOST], V[MOST * MOST], largest = 0;
    int is_certain = 1;
    for (int j = 0; j < s->n; j++) {
        for (int i = 0; i < s->n; i++) {
            D[i + s->n * j] = ldexp(s->dense[i + s->n * j], scale[i] + scale[j]);
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

static sl_status solve_numbers(double a, double b, double *x, sl_stats *stats) {
    const sl_int p[2] = {0, 1}, i[1] = {0};
    const sl_csc A = {1, 1, p, i, &a};
    sl_symmetric *M;
    assert_true(sl_symmetric_create(&M, &A, NULL, stats) == SL_OK);
    const sl_status status = sl_symmetric_solve(M, x, 1, &b, 1, 1, stats);
    assert_int_equal(M->way, SL_SYMMETRIC_FIXED); /* that x is out of range says nothing of A */
    check_inertia(M, 1, 0, 0);
    sl_symmetric_free(M);
    return status;
}

/* A, B and X near the ends of double; a solution beyond them is no solution. */
static void numbers_near_the_ends_of_double(void **state) {
    (void)state;
    static const double solved[][3] = {{1e-320, 1e-320, 1}, {5e-324, 5e-324, 1},
                                       {5e-324, 0, 0},      {0x1p-1070, 0x1p-70, 0x1p1000},
                                       {1e300, 1e300, 1},   {0x1p1000, 1, 0x1p-1000},
                                       {1e-300, 1e-300, 1}, {1, 5e-324, 5e-324}};
    static const double unsolved[][2] = {{1e-300, 1e300}, {1e-300, 1e10}, {1e300, 1e-300},
                                         {1e200, 1e-300}, {5e-324, 1},    {4, 5e-324}};
    sl_stats stats;
    double x;
    for (size_t k = 0; k < sizeof solved / sizeof *solved; k++) {
        assert_true(solve_numbers(solved[k][0], solved[k][1], &x, &stats) == SL_OK);
        assert_true(x == solved[k][2]);
    }
    for (size_t k = 0; k < sizeof unsolved / sizeof *unsolved; k++) {
        assert_int_equal(solve_numbers(unsolved[k][0], unsolved[k][1], &x, &stats),
                         SL_ERR_INACCURATE);
        assert_true(stats.refine.backward_error >= 1);
    }

    system_t s; /* scales beyond those of double: 2^-500, 2^-500, 2^1470 */
    double b[3] = {0, 0x1p-500, 0};
    begin(&s, 3);
    set(&s, 1, 0, 0x1p1000);
    set(&s, 2, 1, 0x1p-1000);
    set(&s, 0, 0, 0x1p1000);
    finish(&s);
    sl_symmetric *M;
    assert_true(sl_symmetric_create(&M, &s.A, NULL, &stats) == SL_OK);
    assert_true(M->scale[2] > 1024);
    assert_int_equal(sl_symmetric_solve(M, b, 3, b, 3, 1, &stats), SL_OK);
    assert_true(b[0] == 0 && b[1] == 0 && b[2] == 0x1p500);
    sl_symmetric_free(M);

    begin(&s, 3); /* singular, with an x of 2^1089 in one row only */
    set(&s, 0, 0, 1);
    set(&s, 1, 1, 0x1p-1070);
    finish(&s);
    M = create(&s, SL_SYMMETRIC_SINGULAR);
    double c[3] = {1, 0x1p19, 0};
    assert_int_equal(sl_symmetric_solve(M, c, 3, c, 3, 1, &stats), SL_ERR_INACCURATE);
    assert_true(stats.refine.backward_error > 1);
    sl_symmetric_free(M);

    begin(&s, 2);
    set(&s, 0, 0, 1);
    set(&s, 1, 1, 1);
    set(&s, 1, 0, 1);
    finish(&s);
    M = create(&s, SL_SYMMETRIC_SINGULAR);
    double d[2] = {1e300, -1e300}; /* inconsistent, but finite */
    assert_int_equal(sl_symmetric_solve(M, d, 2, d, 2, 1, &stats), SL_ERR_INACCURATE);
    sl_symmetric_free(M);
}

/* x(k) falls below the smallest double: no reason to leave the fixed order. */
static void solutions_that_decay_to_zero(void **state) {
    (void)state;
    enum { LONG = 1000 };
    sl_int p[LONG + 1], i[2 * LONG], count = 0;
    double values[2 * LONG], b[LONG] = {1}, *x = (double *)malloc(sizeof b);
    assert_non_null(x);
    for (sl_int j = 0; j < LONG; j++) {
        p[j] = count;
        i[count] = j;
        values[count++] = 3;
        if (j + 1 < LONG) {
            i[count] = j + 1;
            values[count++] = -1;
        }
    }
    p[LONG] = count;
    const sl_csc A = {LONG, LONG, p, i, values};
    sl_symmetric *M;
    assert_true(sl_symmetric_create(&M, &A, NULL, NULL) == SL_OK);
    assert_true(sl_symmetric_solve(M, x, LONG, b, LONG, 1, NULL) == SL_OK);
    assert_int_equal(M->way, SL_SYMMETRIC_FIXED);
    assert_true(x[700] > 0 && x[700] < 1e-290 && x[LONG - 1] < 1e-300);
    sl_symmetric_free(M);
    free(x);
}

/* With an eigenvalue of -e, A + e I is singular. */
static void eigenvalues_at_the_shift(void **state) {
    (void)state;
    system_t s;
    begin(&s, 4);
    for (int k = 0; k < 4; k++) {
        set(&s, k, k, k == 3 ? 1 - 2 * SL_SYMMETRIC_SHIFT : 1);
    }
    set(&s, 1, 0, 1);
    set(&s, 3, 2, 1);
    finish(&s);
    sl_symmetric *M = create(&s, SL_SYMMETRIC_SINGULAR);
    double b[4] = {1, 1, 1, 1}, x[4];
    assert_int_equal(sl_symmetric_solve(M, x, 4, b, 4, 1, NULL), SL_OK);
    assert_true(backward_error(M, &s, x, b) <= SL_SYMMETRIC_SINGULAR_ERROR);
    check_inertia(M, 2, 1, 1);
    sl_symmetric_free(M);
}

/* Both triangles with different values: options.triangle chooses one, and the other may be wild. */
static void a_chosen_triangle_is_read(void **state) {
    (void)state;
    const sl_int p[3] = {0, 2, 4}, i[4] = {0, 1, 0, 1};
    const double lower[4] = {2, 1, NAN, 3}, upper[4] = {2, 1e300, -4, 3}, b[2] = {6, 7};
    for (int is_upper = 0; is_upper < 2; is_upper++) {
        const sl_csc A = {2, 2, p, i, is_upper ? upper : lower};
        const double e = is_upper ? -4 : 1;
        sl_options opt;
        sl_symmetric *M;
        double x[2];
        sl_options_init(&opt, sizeof opt);
        assert_true(sl_symmetric_create(&M, &A, NULL, NULL) != SL_OK);
        opt.triangle = is_upper ? SL_TRIANGLE_UPPER : SL_TRIANGLE_LOWER;
        opt.isa = SL_ISA_SCALAR;
        assert_int_equal(sl_symmetric_create(&M, &A, &opt, NULL), SL_OK);
        assert_int_equal(sl_symmetric_solve(M, x, 2, b, 2, 1, NULL), SL_OK);
        assert_true(fabs(2 * x[0] + e * x[1] - 6) < 1e-14);
        assert_true(fabs(e * x[0] + 3 * x[1] - 7) < 1e-14);
        check_inertia(M, is_upper ? 1 : 2, is_upper, 0);
        sl_symmetric_free(M);
    }
}

/* X is B, in three blocks; with another leading dimension it would write over the next ones. */
static void blocks_in_place(void **state) {
    (void)state;
    system_t s;
    double X[3 * 20], B[3 * 20];
    begin(&s, 3);
    for (int k = 0; k < 3; k++) {
        set(&s, k, k, 4);
        set(&s, k, (k + 1) % 3, 1);
    }
    finish(&s);
    sl_symmetric *M = create(&s, SL_SYMMETRIC_FIXED);
    for (int k = 0; k < 3 * 20; k++) {
        B[k] = k % 7 - 3;
    }
    assert_int_equal(sl_symmetric_solve(M, X, 3, B, 3, 20, NULL), SL_OK);
    assert_int_equal(sl_symmetric_solve(M, B, 3, B, 2, 20, NULL), SL_ERR_ARGUMENT);
    assert_int_equal(sl_symmetric_solve(M, B, 4, B, 3, 15, NULL), SL_ERR_ARGUMENT);
    for (sl_int nrhs = 1; nrhs < 3; nrhs++) {
        const size_t by_rows = SL_ROWS(3);
        assert_int_equal(sl_symmetric_solve(M, B, 3, X, by_rows, nrhs, NULL), SL_ERR_ARGUMENT);
        assert_int_equal(sl_symmetric_solve(M, B, by_rows, X, 3, nrhs, NULL), SL_ERR_ARGUMENT);
    }
    assert_int_equal(sl_symmetric_solve(M, B, 3, B, 3, 20, NULL), SL_OK);
    assert_memory_equal(X, B, sizeof X);
    sl_symmetric_free(M);
}

/* Every malloc of this header fails once; then the object takes other values as before. */
static void own_memory_that_ends_is_reported(void **state) {
    (void)state;
    system_t s, regular;
    int failures = 0;
    begin(&s, 2);
    set(&s, 0, 0, 1);
    set(&s, 1, 1, 1);
    set(&s, 1, 0, 1);
    finish(&s);
    begin(&regular, 2);
    set(&regular, 0, 0, 2);
    set(&regular, 1, 1, 2);
    set(&regular, 1, 0, 1);
    finish(&regular);
    for (long k = 0; k < 100; k++) {
        sl_symmetric *M;
        sl_stats stats;
        double x[2], b[2] = {3, 3};
        until_failure = k;
        sl_status status = sl_symmetric_create(&M, &regular.A, NULL, &stats);
        if (status == SL_OK) {
            status = sl_symmetric_refactor(M, &s.A, &stats);
            if (status != SL_OK) {
                assert_true(sl_symmetric_solve(M, x, 2, b, 2, 1, NULL) == SL_ERR_STALE);
            } else {
                status = sl_symmetric_solve(M, x, 2, b, 2, 1, &stats);
            }
            const int has_ended = until_failure < 0;
            until_failure = -1;
            assert_true(sl_symmetric_refactor(M, &s.A, NULL) == SL_OK);
            assert_true(sl_symmetric_solve(M, x, 2, b, 2, 1, NULL) == SL_OK);
            assert_true(fabs(x[0] + x[1] - 3) < 1e-12);
            check_inertia(M, 1, 0, 1);
            sl_symmetric_free(M);
            if (!has_ended) {
                break;
            }
        }
        assert_int_equal(status, SL_ERR_MEMORY);
        failures++;
    }
    until_failure = -1;
    assert_int_equal(failures, 5 + 2 + 3 + 1); /* arrays, twice to scale, shifted, solve */
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
        cmocka_unit_test(numbers_near_the_ends_of_double),
        cmocka_unit_test(solutions_that_decay_to_zero),
        cmocka_unit_test(eigenvalues_at_the_shift),
        cmocka_unit_test(a_chosen_triangle_is_read),
        cmocka_unit_test(blocks_in_place),
        cmocka_unit_test(own_memory_that_ends_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
