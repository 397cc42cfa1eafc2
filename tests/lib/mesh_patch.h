/* mesh_patch.h: the solver of a patch of a mesh, and the largest entry of its solution */
#ifndef SL_TEST_MESH_PATCH_H
#define SL_TEST_MESH_PATCH_H

#include "surfaces.h"

#include "tools/geometry/patch_solver.h"

static inline patch_solver patch_solver_of(const mesh_factor_t *w, const submesh *p) {
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
