/* mesh_patch.h: the solver of a patch of a mesh, its right-hand sides, the largest entry of x */
#ifndef SL_TEST_MESH_PATCH_H
#define SL_TEST_MESH_PATCH_H

#include "gen_matrices.h"
#include "surfaces.h"

#include "tools/geometry/patch_solver.h"

static inline patch_solver patch_solver_of(const mesh_factor_t *w, const submesh *p) {
    patch_solver s;
    SL_CHECK(patch_solver_create(&s, w->S, w->F, p));
    return s;
}

/* Random right-hand sides on the interface that sum to 0; the caller frees them. */
static inline double *interface_flux(const submesh *p, sl_int nrhs) {
    const size_t n = (size_t)p->m.n_vertices, count = (size_t)p->n_interface;
    double *B = test_reals(n * (size_t)nrhs), *x = test_reals(count);
    for (size_t c = 0; c < (size_t)nrhs; c++) {
        double mean = 0;
        gen_reals(x, count, c + 9);
        for (size_t k = 0; k < count; k++) {
            mean += x[k] / (double)count;
        }
        for (size_t k = 0; k < count; k++) {
            B[c * n + (size_t)p->interface[k]] = x[k] - mean;
        }
    }
    free(x);
    return B;
}

static inline double largest(const double *x, size_t n) {
    double most = 0;
    for (size_t k = 0; k < n; k++) {
        most = fmax(most, fabs(x[k]));
    }
    return most;
}

#endif
