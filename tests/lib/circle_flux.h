/* circle_flux.h: the right-hand side of the harmonic layout of a patch */
#ifndef SL_TEST_CIRCLE_FLUX_H
#define SL_TEST_CIRCLE_FLUX_H

#include <stdlib.h>

#include "gen_matrices.h"
#include "tools/geometry/harmonic_map.h"

/* The flux, n x 2, of the boundary mapped to a circle; the caller frees it. */
static inline double *circle_flux(const disk_patch *d) {
    const size_t boundary = (size_t)d->n_boundary;
    double *edge = test_reals(2 * boundary), *b = test_reals(2 * boundary);
    double *B = test_reals(2 * (size_t)d->p.m.n_vertices);
    boundary_to_circle(edge, d);
    boundary_neumann_rhs(b, edge, d->n_boundary);
    boundary_scatter(B, b, d);
    free(b);
    free(edge);
    return B;
}

#endif
