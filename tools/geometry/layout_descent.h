/* layout_descent.h: layouts that preserve lengths: as rigid as possible, or symmetric Dirichlet */
#ifndef TOOLS_LAYOUT_DESCENT_H
#define TOOLS_LAYOUT_DESCENT_H

#include "layout.h"

/* With the singular values a >= b of the map of a face, b < 0 if it is flipped, the energy is the
 * mean over the surface, weighted by area, of
 *
 *  LAYOUT_ARAP  (a - 1)^2 + (b - 1)^2: the local step finds the rotation nearest to each map, the
 *               global one the layout nearest to the rotations; the matrix stays the same. Faces
 *               may be flipped.
 *  LAYOUT_SLIM  a^2 + b^2 + 1/a^2 + 1/b^2, at least 4, and infinite where a face loses its area.
 *               The local step finds weights of each face with which the quadratic energy of the
 *               rotations has the gradient of this one; the matrix has new values in each
 *               iteration and is refactored. Once a step lowers the energy by little, the matrix is
 *               the Hessian of this energy, whose negative part each face leaves out: Newton's
 *               method, which ends in a tenth of the iterations. A step is shortened before the
 *               first face that it would flip, and until the energy falls: from a start without
 *               flipped faces none ever is.
 *
 *  Sources  Liu, Zhang, Xu, Gotsman, Gortler: A local/global approach to mesh parameterization,
 *           2008. Rabinovich, Poranne, Panozzo, Sorkine-Hornung: Scalable locally injective
 *           mappings, 2017. Smith, Schaefer: Bijective parameterization with free boundaries, 2015.
 *           Smith, de Goes, Kim: Analytic eigensystems for isotropic distortion energies, 2019.
 */
typedef enum layout_energy { LAYOUT_ARAP, LAYOUT_SLIM } layout_energy;

/** Where some vertices are drawn to, by springs. */
typedef struct layout_pins {
    sl_int count;
    const sl_int *vertex; /* count different ones */
    const double *place;  /* 2 count: u v */
} layout_pins;

typedef struct layout_descent {
    /* options */
    layout_energy energy;
    int limit;               /* the largest number of iterations */
    double tolerance;        /* converged: a step lowers the energy by at most this part of it */
    const layout_pins *pins; /* NULL: none */
    /* called after each step; may be NULL */
    void (*each)(const void *context, const struct layout_descent *now);
    const void *context;
    /* results */
    int iterations;
    double first, last; /* energies: at the start, and now; with springs */
    double lowered;     /* by the last step, as a part of the energy */
    bool converged;
} layout_descent;

/** The energy of a layout; INFINITY for LAYOUT_SLIM if a face is flipped or has no area. */
double layout_energy_of(const layout *l, const double *uv, layout_energy energy);

/** Shortens a step so that it flips no face: 0.9 of the way on which the first one loses its area,
 *  at most 1. Faces that have no area at the start do not count.
 *
 *  uv, step  [in]  2 n_vertices.
 */
double layout_longest_step(const layout *l, const double *uv, const double *step);

/** Lowers the energy from the layout uv, which for LAYOUT_SLIM flips no face. The energy never
 *  rises. The mean of the vertices is arbitrary without pins.
 *
 *  l        [in,out]  its fixed vertices are set.
 *  uv       [in,out]  2 n_vertices.
 *  d        [in,out]  options and results.
 *  Returns  SL_OK, also if it has not converged; SL_ERR_NOT_FINITE: the energy of the start is not
 *           finite; SL_ERR_MEMORY; as layout_factor.
 *  Cost     per iteration: O(n_faces), a solve, and for LAYOUT_SLIM a refactorization.
 *  Example  tests/tools/test_layout.c
 */
sl_status layout_descend(layout *l, double *uv, layout_descent *d);

#endif
