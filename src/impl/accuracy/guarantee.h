/* guarantee.h: a proved bound of the error of all solves in the energy norm */
#ifndef SLI_ACCURACY_GUARANTEE_H
#define SLI_ACCURACY_GUARANTEE_H

#include "../../public/bounds.h"
#include "../matrix/csc.h"
#include "../factor/factor.h"
#include "../solve/backward.h"
#include "../solve/work.h"

/* In exact arithmetic the computed L and D satisfy L D L' = A + E with |E| <= g |L| D |L'|, where g
 * = k u / (1 - k u), u = epsilon / 2, and k is the largest number of terms in an entry, whatever
 * the order of the sums [Hi02] 10.1. The two sweeps solve a system of L D L' + G with |G| <= 2 g
 * |L| D |L'| and terms of higher order [Hi02] 8.1. With the diagonal H of A let
 *
 *    m >= the largest eigenvalue of H^-1/2 |L| D |L'| H^-1/2,
 *    a <= the smallest one of H^-1/2 A H^-1/2.
 *
 * Then |v' (E + G) w| <= e ||v|| ||w|| in the energy norm, e = 3 g m / a. A (z - x) = -(E + G) z
 * gives ||z - x|| <= e ||z|| <= e / (1 - e) ||x||. 3.05 in place of 3 takes the terms of g^2. m is
 * the largest quotient of entries of the product with a positive vector and of that vector (Collatz
 * and Wielandt).
 *
 * a: if the factorization of A - s H has positive pivots only, then A - s H has no eigenvalue below
 * -g m H, with the m of that factor [Ru06]. So a = s - g m. */
#define SLI_POWER_STEPS 3
#define SLI_INVERSE_STEPS 8
/* roundings of an entry beside those of its sum: products, the quotient, the scaling of pivots */
#define SLI_OTHER_ROUNDINGS 16

typedef struct sli_guarantee_work {
    const sl_factor *F;
    sl_factor *G; /* of A - s H */
    double gamma;
    double *root; /* n, in pivot order: the square root of the diagonal of A */
    double *w, *z;
    sl_int *terms; /* n */
    double *scratch;
    double *values; /* of A - s H */
} sli_guarantee_work;

static void sli_guarantee_layout(sli_guarantee_work *p, sli_block *b, const sl_csc *A) {
    const sl_symbolic *S = p->F->S;
    p->root = SLI_TAKE(b, double, S->n);
    p->w = SLI_TAKE(b, double, S->n);
    p->z = SLI_TAKE(b, double, S->n);
    p->terms = SLI_TAKE(b, sl_int, S->n);
    p->scratch = SLI_TAKE(b, double, sli_sweep_scratch(S->tallest, S->widest, 1));
    p->values = SLI_TAKE(b, double, sli_nnz(A));
}

/* The factor k u / (1 - k u) for the longest row or column of L. */
static double sli_guarantee_gamma(const sli_guarantee_work *p) {
    const sl_symbolic *S = p->F->S;
    sl_int s, k, most = 0;
    double size;
    SLI_ZERO(p->terms, S->n);
    for (s = 0; s < S->n_supers; s++) {
        const sli_step *step = &S->steps[s];
        for (k = 0; k < step->below; k++) {
            p->terms[S->rows[S->rows_begin[s] + k]] += step->width;
        }
        most = sli_max(most, step->width + step->below);
    }
    for (k = 0; k < S->n; k++) {
        most = sli_max(most, p->terms[k] + S->steps[S->super_of[k]].width);
    }
    size = ((double)most + SLI_OTHER_ROUNDINGS) * (DBL_EPSILON / 2.0);
    return size / (1.0 - size);
}

/* z += |L| z, or z += |L'| z, without the unit diagonal, for one row tile of supernode s. */
SLI_HOT static void sli_magnitudes_tile(const sl_factor *F, sl_int s, sl_int tile,
                                        int is_transposed, double *z) {
    const sli_step *step = &F->S->steps[s];
    const sl_int *below = F->S->rows + F->S->rows_begin[s] - step->width;
    const sl_int first = SLI_TILE * tile, columns = sli_min(step->width, first + SLI_TILE);
    const sl_int count = sli_min(SLI_TILE, step->width + step->below - first);
    const double *l = (const double *)F->values + step->panel + sli_tile_offset(step->width, tile);
    double x[SLI_TILE] = {0.0}, *at[SLI_TILE];
    sl_int j, q;
    for (q = 0; q < count; q++) {
        const sl_int r = first + q;
        at[q] = &z[r < step->width ? step->column + r : below[r]];
        x[q] = is_transposed ? *at[q] : 0.0;
    }
    for (j = 0; j < columns; j++, l += SLI_TILE) {
        double sum = 0.0;
        for (q = 0; q < count; q++) { /* what is not below the diagonal is 0 */
            sum += fabs(l[q]) * x[q];
            x[q] += is_transposed ? 0.0 : fabs(l[q]) * z[step->column + j];
        }
        z[step->column + j] += is_transposed ? sum : 0.0;
    }
    for (q = 0; q < count && !is_transposed; q++) {
        *at[q] += x[q];
    }
}

/* z := |L| D |L'| z. Each number is read before it changes: tiles ascend for L', and descend for
 * L. */
static void sli_magnitudes_multiply(const sl_factor *F, double *z) {
    const sl_symbolic *S = F->S;
    sl_int s, t;
    for (s = 0; s < S->n_supers; s++) {
        for (t = 0; t < sli_tiles(S->steps[s].width + S->steps[s].below); t++) {
            sli_magnitudes_tile(F, s, t, 1, z);
        }
    }
    for (s = 0; s < S->n; s++) {
        z[s] *= F->D[s];
    }
    for (s = S->n_supers - 1; s >= 0; s--) {
        for (t = sli_tiles(S->steps[s].width + S->steps[s].below) - 1; t >= 0; t--) {
            sli_magnitudes_tile(F, s, t, 0, z);
        }
    }
}

/* A bound of the largest eigenvalue of H^-1/2 |L| D |L'| H^-1/2 for the factor F, of some pivots
 * whose diagonal H is p->root squared. */
SLI_HOT static double sli_magnitude_bound(const sli_guarantee_work *p, const sl_factor *F) {
    const sl_symbolic *S = F->S;
    double least = HUGE_VAL;
    sl_int k;
    int step;
    for (k = 0; k < S->n; k++) {
        p->w[k] = 1.0;
    }
    for (step = 0; step < SLI_POWER_STEPS; step++) {
        double largest = 0.0, norm = 0.0;
        for (k = 0; k < S->n; k++) {
            p->z[k] = p->w[k] / p->root[k];
        }
        sli_magnitudes_multiply(F, p->z);
        for (k = 0; k < S->n; k++) {
            const double product = p->z[k] / p->root[k];
            largest = fmax(largest, product / p->w[k]);
            p->w[k] = product;
            norm = fmax(norm, product);
        }
        for (k = 0; k < S->n; k++) { /* not too small: any positive vector gives a bound */
            p->w[k] = fmax(p->w[k] / norm, DBL_EPSILON);
        }
        least = fmin(least, largest);
    }
    return least * (1.0 + 4.0 * p->gamma); /* roundings of this product */
}

/* The smallest eigenvalue of H^-1/2 A H^-1/2, estimated from above by inverse iteration. */
static double sli_eigenvalue_estimate(const sli_guarantee_work *p) {
    const sl_factor *F = p->F;
    const sli_reach all = sli_reach_all(F->S);
    double size = 1.0;
    sl_int k, step;
    for (k = 0; k < F->S->n; k++) {
        p->w[k] = 1.0 + (double)(k % 7) / 8.0;
    }
    for (step = 0; step < SLI_INVERSE_STEPS; step++) {
        double before = 0.0, after = 0.0;
        for (k = 0; k < F->S->n; k++) {
            before += p->w[k] * p->w[k];
            p->w[k] *= p->root[k];
        }
        sli_forward_sweep(F, SLI_NRHS_1, &all, p->w, p->scratch);
        sli_backward(F, &all, SLI_NRHS_1, p->w, p->scratch);
        for (k = 0; k < F->S->n; k++) {
            p->w[k] *= p->root[k];
            after += p->w[k] * p->w[k];
        }
        size = sqrt(after / before);
        for (k = 0; k < F->S->n; k++) {
            p->w[k] /= sqrt(after);
        }
    }
    return 1.0 / size;
}

static void sli_diagonal_of(const sl_csc *A, double *diagonal) {
    sl_int j, q;
    for (j = 0; j < A->n_cols; j++) {
        diagonal[j] = 0.0;
        for (q = A->p[j]; q < A->p[j + 1]; q++) {
            diagonal[j] += A->i[q] == j ? A->x[q] : 0.0;
        }
    }
}

/* Fills p->root and checks that A is far from overflow and underflow. */
static int sli_guarantee_roots(const sli_guarantee_work *p, const sl_csc *A) {
    const sl_symbolic *S = p->F->S;
    sl_int k;
    sli_diagonal_of(A, p->w);
    for (k = 0; k < S->n; k++) {
        p->root[k] = sqrt(p->w[S->perm[k]]);
        if (!(p->F->D[k] > 1e-200 && p->root[k] > 1e-100 && p->root[k] < 1e100)) {
            return 0;
        }
    }
    return 1;
}

/* The lower bound a of A - s H; 0 or less if there is none. *status: of the factorization. */
SLI_HOT static double sli_guarantee_try(sli_guarantee_work *p, const sl_csc *A, double shift,
                                        sl_status *status) {
    const double kept = 1.0 - shift;
    sl_csc shifted = *A;
    sl_int j, q;
    for (j = 0; j < A->n_cols; j++) {
        for (q = A->p[j]; q < A->p[j + 1]; q++) {
            p->values[q] = A->i[q] == j ? A->x[q] * kept : A->x[q];
        }
    }
    shifted.x = p->values;
    if (p->G == NULL) {
        sl_options opt = sli_options_with(&p->F->allocator);
        opt.isa = p->F->kernels->isa;
        opt.method = p->F->method;
        opt.threads = p->F->threads;
        *status = sl_factor_create(&p->G, p->F->S, &shifted, &opt, NULL);
    } else {
        *status = sl_factor_refactor(p->G, &shifted, NULL);
    }
    if (*status == SL_ERR_PIVOT || *status == SL_ERR_INACCURATE ||
        (*status == SL_OK && p->G->stats.factor.negative > 0)) {
        *status = SL_OK;
        return 0.0;
    }
    /* (1 - shift) and the product with it are rounded */
    return *status == SL_OK ? (1.0 - kept) - p->gamma * sli_magnitude_bound(p, p->G) - DBL_EPSILON
                            : 0.0;
}

static sl_status sli_guarantee(const sl_factor *F, const sl_csc *A, sl_work *W,
                               sl_certificate_info *info) {
    sli_block b = {NULL, 0};
    sli_guarantee_work p;
    sli_hash values;
    sl_status status;
    double shift, lowest = 0.0;
    int attempt;
    if (F->null.count > 0 || F->type->storage != SL_STORAGE_DOUBLE || F->S->nnz_input < 0 ||
        sli_map_has_duplicates(F->S)) {
        return sli_refuse(SL_ERR_UNSUPPORTED, "SL_GUARANTEED with null pivots, L in float, "
                                              "duplicate entries of A or sl_factor_submatrix");
    }
    values = sli_hash_words(F->S->identity, A->x, sli_nnz(A));
    if (!sli_hash_equals(F->identity, sli_hash_words(values, F->D, F->S->n))) {
        return sli_refuse(SL_ERR_MISMATCH, "A is not the matrix that F was computed from");
    }
    SLI_CLEAR(p);
    p.F = F;
    sli_guarantee_layout(&p, &b, A);
    status = sli_work_block(W, &b);
    if (status != SL_OK) {
        return status;
    }
    sli_guarantee_layout(&p, &b, A);
    if (!sli_guarantee_roots(&p, A)) {
        return sli_refuse(SL_ERR_UNSUPPORTED, "SL_GUARANTEED with a diagonal entry or pivot out "
                                              "of range");
    }
    p.gamma = sli_guarantee_gamma(&p);
    shift = sli_eigenvalue_estimate(&p) / 2.0;
    for (attempt = 0; attempt < 4 && status == SL_OK && !(lowest > 0.0); attempt++) {
        lowest = sli_guarantee_try(&p, A, shift, &status);
        shift /= 8.0;
    }
    info->solves = SLI_INVERSE_STEPS;
    if (status == SL_OK) {
        const double e =
            lowest > 0.0 ? 3.05 * p.gamma * sli_magnitude_bound(&p, F) / lowest : HUGE_VAL;
        info->eta = e < 1.0 ? e / (1.0 - e) : HUGE_VAL;
        info->eigenvalue_min = lowest;
    }
    sl_factor_free(p.G);
    return status;
}

#endif
