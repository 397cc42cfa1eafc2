/* square_region.h: a grid, the region of a square in it, and solves in that region */
#ifndef SL_TEST_SQUARE_REGION_H
#define SL_TEST_SQUARE_REGION_H

#include "check_region.h"

enum { SIDE = 150, N = SIDE * SIDE, WIDE = 20, COUNT = WIDE * WIDE };

/* The rows of a square of the grid whose upper left corner is at (at, at). */
static inline void square(sl_int *set, sl_int at) {
    for (sl_int k = 0; k < COUNT; k++) {
        set[k] = (at + k / WIDE) * SIDE + at + k % WIDE;
    }
}

/* A grid, a region of a square of its rows, and a plan in that region. */
typedef struct fixture_t {
    factored_t y;
    sl_int set[COUNT];
    sl_region *R;
    sl_plan *P;
    double B[3 * COUNT], X[3 * COUNT];
} fixture_t;

static inline fixture_t *fixture_make(void) {
    fixture_t *f = (fixture_t *)test_array(1, sizeof *f);
    sl_options opt = options_none();
    sl_stats stats;
    memset(&stats, 0, sizeof stats);
    f->y = factored_make(GEN_GRID2, N, 1, 0, NULL);
    square(f->set, 41);
    SL_CHECK(sl_region_create(&f->R, f->y.F, f->set, COUNT, NULL, NULL, &stats));
    assert_true(stats.region.boundary > 0 && stats.region.subtrees > 0);
    assert_true(stats.region.entries >= (sl_off)stats.region.boundary * stats.region.boundary / 2);
    assert_true(stats.region.bytes >= (size_t)stats.region.entries * sizeof(double));
    opt.region = f->R;
    SL_CHECK(sl_plan_create(&f->P, f->y.S, f->set, COUNT, f->set, COUNT, FOR_PLAN(&opt), NULL));
    gen_reals(f->B, 3 * COUNT, 6);
    return f;
}

static inline void fixture_free(fixture_t *f) {
    sl_plan_free(f->P);
    sl_region_free(f->R);
    factored_free(&f->y);
    free(f);
}

static inline sl_status fixture_solve(fixture_t *f, const sl_factor *F) {
    return sl_plan_solve(f->P, F, f->X, COUNT, f->B, COUNT, 3, NULL);
}

/* The plan's solution matches the full solve with F. */
static inline void assert_solution_matches(fixture_t *f, const sl_factor *F) {
    double *full = test_reals(3 * N), largest = 0;
    SL_CHECK(fixture_solve(f, F));
    for (sl_int k = 0; k < 3 * COUNT; k++) {
        full[N * (k / COUNT) + f->set[k % COUNT]] = f->B[k];
    }
    SL_CHECK(sl_factor_solve(F, full, N, full, N, 3, NULL));
    for (sl_int k = 0; k < 3 * N; k++) {
        largest = fabs(full[k]) > largest ? fabs(full[k]) : largest;
    }
    for (sl_int k = 0; k < 3 * COUNT; k++) {
        assert_true(fabs(f->X[k] - full[N * (k / COUNT) + f->set[k % COUNT]]) <=
                    1000 * DBL_EPSILON * largest);
    }
    free(full);
}

#endif
