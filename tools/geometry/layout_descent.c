/* layout_descent.c: layouts that preserve lengths: as rigid as possible, or symmetric Dirichlet */
#include "layout_descent.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the springs of pins; the stiffness of a good mesh at a vertex is about 1. */
#define SPRING 1e3

/* An iteration that lowers the energy by less than this part of it is followed by one of Newton. */
#define NEWTON_BELOW 0.1

/* Of the eigenvalue of a face's turn; the layout as a whole turns freely. */
#define LEAST_TURN 1e-6

/* ---- the energy of a face ---- */

/* The singular values a >= |b| of J, and the matrices Q, R with J = Q diag(a, b) Q' R. */
typedef struct polar {
    double a, b;
    double cosine, sine; /* of the first column of Q */
    double rotation[2];  /* cosine and sine of R */
} polar;

static polar polar_of(const double J[4], double det) {
    /* J is a similarity plus a similarity of the mirror image */
    const double p = (J[0] + J[3]) / 2, q = (J[2] - J[1]) / 2;
    const double r = (J[0] - J[3]) / 2, s = (J[2] + J[1]) / 2;
    const double keeps = hypot(p, q), turns = hypot(r, s);
    const double angle = (atan2(s, r) + atan2(q, p)) / 2;
    const polar found = {keeps + turns,
                         keeps > 0 ? det / (keeps + turns) : -turns, /* keeps - turns */
                         cos(angle),
                         sin(angle),
                         {keeps > 0 ? p / keeps : 1, keeps > 0 ? q / keeps : 0}};
    return found;
}

static double face_energy(const double J[4], double det, layout_energy energy) {
    const double squares = J[0] * J[0] + J[1] * J[1] + J[2] * J[2] + J[3] * J[3];
    if (energy == LAYOUT_SLIM) {
        return det > 0 ? squares * (1 + 1 / det / det) : INFINITY;
    }
    /* a + b is twice the part of J that keeps the orientation */
    return squares + 2 - 2 * hypot(J[0] + J[3], J[2] - J[1]);
}

/* Half the gradient of the energy by J, and the matrix P of the system. */
static void local_step(double G[4], double P[3], const double J[4], double det,
                       layout_energy energy) {
    const polar f = polar_of(J, det);
    const double c = f.cosine, s = f.sine, rc = f.rotation[0], rs = f.rotation[1];
    double ga = f.a - 1, gb = f.b - 1, pa = 1, pb = 1;
    if (energy == LAYOUT_SLIM) {
        ga = f.a - 1 / (f.a * f.a * f.a);
        gb = f.b - 1 / (f.b * f.b * f.b);
        pa = 1 + (1 + (1 + 1 / f.a) / f.a) / f.a; /* (x - x^-3) / (x - 1) */
        pb = 1 + (1 + (1 + 1 / f.b) / f.b) / f.b;
    }
    P[0] = pa * c * c + pb * s * s;
    P[1] = (pa - pb) * c * s;
    P[2] = pa * s * s + pb * c * c;
    /* Q diag(ga, gb) Q' R */
    const double xx = ga * c * c + gb * s * s, xy = (ga - gb) * c * s, yy = ga * s * s + gb * c * c;
    G[0] = xx * rc + xy * rs;
    G[1] = -xx * rs + xy * rc;
    G[2] = xy * rc + yy * rs;
    G[3] = -xy * rs + yy * rc;
}

/* Half the Hessian of the symmetric Dirichlet energy by J, 4 x 4, without its negative part: three
 * eigenvalues are positive, and that of the turn is raised to LEAST_TURN. */
static void hessian_of(double H[16], const double J[4], double det) {
    const polar f = polar_of(J, det);
    const double c = f.cosine, s = f.sine, half = sqrt(0.5), a = f.a, b = f.b;
    const double a3 = 1 / (a * a * a), b3 = 1 / (b * b * b);
    const double value[4] = {1 + 3 * a3 / a, 1 + 3 * b3 / b,
                             fmax(LEAST_TURN, 1 - (a3 + b3) / (a + b)),
                             1 + (a * a + a * b + b * b) * a3 * b3};
    /* eigenvectors are these matrices times R: two stretches, a turn, a shear */
    const double S[4][4] = {
        {c * c, c * s, c * s, s * s},
        {s * s, -c * s, -c * s, c * c},
        {0, -half, half, 0},
        {-2 * c * s * half, (c * c - s * s) * half, (c * c - s * s) * half, 2 * c * s * half}};
    memset(H, 0, 16 * sizeof *H);
    for (int k = 0; k < 4; k++) {
        const double rc = f.rotation[0], rs = f.rotation[1];
        const double e[4] = {S[k][0] * rc + S[k][1] * rs, S[k][1] * rc - S[k][0] * rs,
                             S[k][2] * rc + S[k][3] * rs, S[k][3] * rc - S[k][2] * rs};
        for (int i = 0; i < 16; i++) {
            H[i] += value[k] * e[i / 4] * e[i % 4];
        }
    }
}

/* ---- the energy of a layout ---- */

double layout_energy_of(const layout *l, const double *uv, layout_energy energy) {
    double sum = 0, J[4];
    for (sl_int f = 0; f < l->m->n_faces; f++) {
        const double det = layout_jacobian(J, l, uv, f);
        sum += l->area[f] * face_energy(J, det, energy);
    }
    return sum / l->whole;
}

static double all_energy(const layout *l, const double *uv, const layout_descent *d) {
    double sum = 0;
    for (sl_int k = 0; d->pins != NULL && k < 2 * d->pins->count; k++) {
        const double gap = uv[2 * d->pins->vertex[k / 2] + k % 2] - d->pins->place[k];
        sum += SPRING * gap * gap;
    }
    return sum / l->whole + layout_energy_of(l, uv, d->energy);
}

/* ---- steps ---- */

/* The first t above 0 at which a + b t + c t^2 is 0, for a > 0; INFINITY if there is none. */
static double first_root(double a, double b, double c) {
    const double discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0)) {
        return INFINITY;
    }
    const double below = sqrt(discriminant) - b; /* the roots are 2 a / (-b +- root) */
    return below > 0 ? 2 * a / below : INFINITY;
}

double layout_longest_step(const layout *l, const double *uv, const double *step) {
    double longest = INFINITY;
    for (sl_int f = 0; f < l->m->n_faces; f++) {
        double J[4], D[4];
        const double area = layout_jacobian(J, l, uv, f), end = layout_jacobian(D, l, step, f);
        if (area > 0) {
            const double mixed = J[0] * D[3] + D[0] * J[3] - J[1] * D[2] - D[1] * J[2];
            longest = fmin(longest, first_root(area, mixed, end));
        }
    }
    return fmin(1, 0.9 * longest);
}

/* The step of the local and the global phase, or that of Newton, and the slope of the energy along
 * it. P: 16 n_faces, scratch. */
static sl_status find_step(layout *l, const double *uv, layout_descent *d, double *P, double *step,
                           double *slope) {
    const size_t n = 2 * (size_t)l->m->n_vertices;
    const bool is_newton =
        d->energy == LAYOUT_SLIM && d->iterations > 0 && d->lowered < NEWTON_BELOW;
    double *g = step + n, J[4], G[4], weights[3];
    memset(g, 0, n * sizeof *g);
    for (sl_int f = 0; f < l->m->n_faces; f++) {
        const double det = layout_jacobian(J, l, uv, f);
        local_step(G, is_newton ? weights : P + 3 * (size_t)f, J, det, d->energy);
        if (is_newton) {
            hessian_of(P + 16 * (size_t)f, J, det);
        }
        for (int k = 0; k < 4; k++) {
            G[k] *= l->area[f];
        }
        layout_scatter(g, l, G, f);
    }
    for (sl_int k = 0; d->pins != NULL && k < 2 * d->pins->count; k++) {
        const sl_int at = 2 * d->pins->vertex[k / 2] + k % 2;
        g[at] += SPRING * (uv[at] - d->pins->place[k]);
    }
    sl_status status = SL_OK;
    if (l->F == NULL || d->energy == LAYOUT_SLIM) {
        if (is_newton) {
            layout_assemble_hessian(l, P);
        } else {
            layout_assemble(l, P, 0);
        }
        for (sl_int k = 0; d->pins != NULL && k < d->pins->count; k++) {
            layout_add_diagonal(l, d->pins->vertex[k], SPRING);
        }
        status = layout_factor(l);
    }
    memcpy(step, g, n * sizeof *g);
    status = status == SL_OK ? layout_solve(l, step) : status;
    *slope = 0;
    for (size_t k = 0; k < n && status == SL_OK; k++) {
        *slope -= 2 * g[k] * step[k] / l->whole;
        step[k] = -step[k];
    }
    return status;
}

/* Goes along the step until the energy falls by a part of what the slope promises. Returns the
 * energy there; that of the start if no step lowers it. */
static double search(const layout *l, double *uv, const double *step, double *trial, double slope,
                     const layout_descent *d) {
    const size_t n = 2 * (size_t)l->m->n_vertices;
    double t = d->energy == LAYOUT_SLIM ? layout_longest_step(l, uv, step) : 1;
    for (int k = 0; k < 50; k++, t *= 0.6) {
        for (size_t j = 0; j < n; j++) {
            trial[j] = uv[j] + t * step[j];
        }
        const double energy = all_energy(l, trial, d);
        if (energy <= d->last + 1e-4 * t * slope) {
            memcpy(uv, trial, n * sizeof *uv);
            return energy;
        }
    }
    return d->last;
}

sl_status layout_descend(layout *l, double *uv, layout_descent *d) {
    const size_t n = 2 * (size_t)l->m->n_vertices, nf = (size_t)l->m->n_faces;
    double *work = (double *)malloc((3 * n + 16 * nf + 1) * sizeof *work);
    sl_status status = work != NULL ? SL_OK : SL_ERR_MEMORY;
    d->iterations = 0;
    d->lowered = 0;
    d->converged = false;
    d->first = d->last = all_energy(l, uv, d);
    if (status == SL_OK && !isfinite(d->last)) {
        status = SL_ERR_NOT_FINITE;
    }
    memset(l->fixed, 0, n / 2);
    if (d->pins == NULL && n > 0) {
        l->fixed[l->m->faces[0]] = 1; /* the energy does not depend on translations */
    }
    sl_factor_free(l->F);
    l->F = NULL;
    while (status == SL_OK && !d->converged && d->iterations < d->limit) {
        double slope;
        status = find_step(l, uv, d, work + 3 * n, work, &slope);
        if (status == SL_OK) {
            const double energy = search(l, uv, work, work + 2 * n, slope, d);
            d->iterations++;
            d->lowered = d->last > 0 ? (d->last - energy) / d->last : 0;
            d->last = energy;
            d->converged = !(d->lowered > d->tolerance);
            if (d->each != NULL) {
                d->each(d->context, d);
            }
        }
    }
    free(work);
    return status;
}
