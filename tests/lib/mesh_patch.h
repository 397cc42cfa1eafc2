/* patch_checks.h: what the tests of problems on patches share */
#ifndef SL_TEST_PATCH_CHECKS_H
#define SL_TEST_PATCH_CHECKS_H

#include "bent_grids.h"

#include "../tools/patch_solver.h"

static inline patch_solver solver_of(const whole_t *w, const part *p) {
    patch_solver s;
    SL_CHECK(patch_solver_create(&s, w->S, w->F, p));
    return s;
}

static inline double largest(const double *x, size_t n) {
    double most = 0;
    for (size_t k = 0; k < n; k++) {
        most = fmax(most, fabs(x[k]));
    }
    return most;
}

#endif
