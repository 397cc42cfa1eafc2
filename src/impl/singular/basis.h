/* basis.h: several null vectors in each component: which of them hold, and their anchors */
#ifndef SLI_SINGULAR_BASIS_H
#define SLI_SINGULAR_BASIS_H

#include "../factor/storage_type.h"
#include "dense.h"
#include "product.h"

/* Let the columns of Z span the null space of a component, as the rigid motions of an elastic body
 * do. For any rows N with Z(N, :) regular, A without the rows and columns N is regular: x = 0 in N
 * fixes the body. These rows are the anchors. Their pivots are skipped whatever value they have,
 * and their columns of L become 0, so that it is as if the rows were not there.
 *
 * Anchors must be far apart, or the matrix without them is ill-conditioned: a body that is held by
 * two neighboring points hardly resists a rotation. So they are chosen by threshold pivoting on an
 * orthonormal basis of Z: an anchor is the last row, in elimination order, whose
 * distance from the span of the anchors before it is at least 0.3 of the largest one.
 *
 * Not all columns need to hold: a body with a fixed point can still rotate about it. Each row i of
 * A Z that is not rounding error rules out one combination of the columns; the null vectors are the
 * combinations orthogonal to these. The row that exceeds its bound most is taken first, because its
 * direction is the most accurate one. For the combinations C that are left, A Z C is rounding error
 * of A Z.
 *
 * Kept is the basis that is the unit matrix in the anchors. In a tree with several components each
 * component has columns of its own, so that a dot product over the columns of the tree is one over
 * the component. */

#define SLI_NULL_ANCHOR 0.3 /* least distance of an anchor, relative to the largest one */
enum { SLI_NULL_IS_ANCHOR = -2 /* in the chain, in place of the pivot before */ };

/* A component: its pivots are a chain, from the last one to the first. */
typedef struct sli_null_part {
    sl_factor *F;
    double *z; /* n x count: the columns, in F->g */
    size_t n;
    sl_int last, count;
    sl_int rank; /* of the columns */
} sli_null_part;

SLI_INLINE sli_null_part sli_null_part_of(sl_factor *F, sl_int last) {
    sli_null_part p;
    p.F = F;
    p.z = F->null.g;
    p.n = (size_t)F->S->n;
    p.last = last;
    p.count = p.rank = F->null.vectors;
    return p;
}

/* Links the pivots of each component. */
static void sli_null_chain(sl_factor *F) {
    sli_null_row *tails = F->null.rows; /* free until the next product */
    sl_int k;
    for (k = 0; k < F->S->n; k++) {
        tails[k].up = -1;
    }
    for (k = 0; k < F->S->n; k++) {
        F->null.chain[k] = tails[F->null.last[k]].up;
        tails[F->null.last[k]].up = k;
    }
}

/* Is a pivot that is no anchor the only row of its component? */
SLI_INLINE int sli_null_is_row(const sl_factor *F, sl_int k) {
    return F->null.last[k] == k && F->null.chain[k] == -1;
}

/* The largest entry of column j. */
static double sli_null_largest(const sli_null_part *p, sl_int j) {
    const double *z = p->z + (size_t)j * p->n;
    double largest = 0.0;
    sl_int k;
    for (k = p->last; k != -1; k = p->F->null.chain[k]) {
        largest = fabs(z[k]) > largest ? fabs(z[k]) : largest;
    }
    return largest;
}

/* Multiplies column j by a power of 2, so that its largest entry is between 0.5 and 1. */
static void sli_null_scale(const sli_null_part *p, sl_int j) {
    double *z = p->z + (size_t)j * p->n;
    int exponent;
    sl_int k;
    (void)frexp(sli_null_largest(p, j), &exponent);
    for (k = p->last; k != -1; k = p->F->null.chain[k]) {
        z[k] = ldexp(z[k], -exponent);
    }
}

/* The row of A Z whose part orthogonal to q exceeds its rounding error most, by the factor that is
 * returned; x: this part, scaled to 1. Infinity if A Z is not finite. */
static double sli_null_violation(const sli_null_part *p, const double *q, sl_int vectors,
                                 double *x) {
    const double *product = p->F->null.products, *sizes = product + (size_t)p->count * p->n;
    double most = 0.0, y[SLI_NULL_VECTORS_MAX];
    sl_int k, j;
    for (k = p->last; k != -1; k = p->F->null.chain[k]) {
        double norm, ratio;
        if (!sli_is_finite(sizes[k])) {
            return (double)INFINITY;
        }
        if (sizes[k] == 0.0) {
            continue;
        }
        for (j = 0; j < p->count; j++) {
            y[j] = product[(size_t)k + (size_t)j * p->n] / sizes[k];
        }
        norm = sli_null_project(q, vectors, p->count, y);
        ratio = norm / (16.0 * DBL_EPSILON * p->F->null.row_entries[k]);
        if (ratio > most) {
            most = ratio;
            for (j = 0; j < p->count; j++) {
                x[j] = y[j] / norm;
            }
        }
    }
    return most;
}

/* Z := Z C for `columns` vectors c; the other columns become 0. */
static void sli_null_combine(const sli_null_part *p, const double *c, sl_int columns) {
    double x[SLI_NULL_VECTORS_MAX];
    sl_int k, v, j;
    for (k = p->last; k != -1; k = p->F->null.chain[k]) {
        double *z = p->z + k;
        for (j = 0; j < p->count; j++) {
            x[j] = z[(size_t)j * p->n];
        }
        for (v = 0; v < p->count; v++) {
            double sum = 0.0;
            for (j = 0; j < p->count && v < columns; j++) {
                sum += c[v * p->count + j] * x[j];
            }
            z[(size_t)v * p->n] = sum;
        }
    }
}

/* Replaces Z by the combinations of its columns with A Z = 0. Returns how many columns were ruled
 * out. */
SLI_COLD static sl_int sli_null_restrict(const sli_null_part *p) {
    double q[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
    double c[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
    sl_int vectors = 0;
    memset(q, 0, sizeof q);
    while (vectors < p->count) {
        const double ratio = sli_null_violation(p, q, vectors, q + vectors * p->count);
        if (!sli_is_finite(ratio)) {
            vectors = p->count;
        } else if (ratio > 1.0) {
            vectors++;
        } else {
            break;
        }
    }
    if (vectors > 0) {
        sli_null_complement(q, vectors, p->count, c);
        sli_null_combine(p, c, p->count - vectors);
    }
    return vectors;
}

/* a' b of two columns. */
static double sli_null_scalar(const sli_null_part *p, const double *a, const double *b) {
    double sum = 0.0;
    sl_int k;
    for (k = p->last; k != -1; k = p->F->null.chain[k]) {
        sum += a[k] * b[k];
    }
    return sum;
}

static void sli_null_subtract(const sli_null_part *p, double *a, const double *b, double c) {
    sl_int k;
    for (k = p->last; k != -1; k = p->F->null.chain[k]) {
        a[k] -= c * b[k];
    }
}

/* Makes the columns orthonormal, the largest remainder first. Dependent columns become 0. */
SLI_HOT static void sli_null_orthonormalize(sli_null_part *p) {
    sl_int v, j, k;
    for (v = 0; v < p->count; v++) {
        double *z = p->z + (size_t)v * p->n, most = -1.0;
        sl_int at = v;
        int pass;
        for (j = v; j < p->count; j++) {
            const double *other = p->z + (size_t)j * p->n;
            const double square = sli_null_scalar(p, other, other);
            at = square > most ? j : at;
            most = square > most ? square : most;
        }
        for (k = p->last; k != -1; k = p->F->null.chain[k]) {
            const double swapped = z[k];
            z[k] = p->z[(size_t)k + (size_t)at * p->n];
            p->z[(size_t)k + (size_t)at * p->n] = swapped;
        }
        for (pass = 0; pass < 2; pass++) {
            for (j = 0; j < v && sqrt(most) > SLI_NULL_DEPENDENT; j++) {
                const double *q = p->z + (size_t)j * p->n;
                sli_null_subtract(p, z, q, sli_null_scalar(p, z, q));
            }
            most = sli_null_scalar(p, z, z);
        }
        if (sqrt(most) <= SLI_NULL_DEPENDENT) {
            break;
        }
        for (k = p->last; k != -1; k = p->F->null.chain[k]) {
            z[k] /= sqrt(most);
        }
        for (j = v + 1; j < p->count; j++) {
            double *other = p->z + (size_t)j * p->n;
            sli_null_subtract(p, other, z, sli_null_scalar(p, other, z));
        }
    }
    p->rank = v;
    for (; v < p->count; v++) {
        for (k = p->last; k != -1; k = p->F->null.chain[k]) {
            p->z[(size_t)k + (size_t)v * p->n] = 0.0;
        }
    }
}

/* x := the part of row k that is orthogonal to q; returns its length. */
static double sli_null_distance(const sli_null_part *p, sl_int k, const double *q, sl_int vectors,
                                double *x) {
    sl_int j;
    for (j = 0; j < p->rank; j++) {
        x[j] = p->z[(size_t)k + (size_t)j * p->n];
    }
    return sli_null_project(q, vectors, p->rank, x);
}

/* Chooses `rank` anchors. */
SLI_COLD static void sli_null_anchors(const sli_null_part *p, sl_int *anchors) {
    double q[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX];
    sl_int v, j, k;
    for (v = 0; v < p->rank; v++) {
        double *x = q + v * p->rank, most = 0.0, distance = 0.0;
        for (k = p->last; k != -1; k = p->F->null.chain[k]) {
            distance = sli_null_distance(p, k, q, v, x);
            most = distance > most ? distance : most;
        }
        k = v % 2 > 0 && p->F->type->half > 0 && p->F->null.last[anchors[v - 1] ^ 1] == p->last
                ? anchors[v - 1] ^ 1 /* the other row of the same complex one */
                : p->last;
        while ((distance = sli_null_distance(p, k, q, v, x)) < SLI_NULL_ANCHOR * most) {
            k = p->F->null.chain[k];
        }
        anchors[v] = k;
        for (j = 0; j < p->rank; j++) {
            x[j] /= distance;
        }
    }
}

/* Makes Z the unit matrix in the anchors, and moves it to the columns from `first` on. */
static void sli_null_normalize(const sli_null_part *p, const sl_int *anchors, sl_int first) {
    double a[SLI_NULL_VECTORS_MAX * SLI_NULL_VECTORS_MAX], x[SLI_NULL_VECTORS_MAX];
    sl_int i, j, k;
    for (i = 0; i < p->rank; i++) {
        for (j = 0; j < p->rank; j++) {
            a[i * p->rank + j] = p->z[(size_t)anchors[i] + (size_t)j * p->n];
        }
    }
    sli_null_invert(a, p->rank);
    for (k = p->last; k != -1; k = p->F->null.chain[k]) {
        double *z = p->z + k;
        for (j = 0; j < p->count; j++) {
            x[j] = z[(size_t)j * p->n];
            z[(size_t)j * p->n] = 0.0;
        }
        for (i = 0; i < p->rank; i++) {
            for (j = 0; j < p->rank; j++) {
                z[(size_t)(first + i) * p->n] += x[j] * a[j * p->rank + i];
            }
        }
    }
    for (i = 0; i < p->rank; i++) {
        for (j = 0; j < p->rank; j++) {
            p->z[(size_t)anchors[i] + (size_t)(first + j) * p->n] = i == j ? 1.0 : 0.0;
        }
    }
}

/* Computes A Z for the columns in g, and the sums of the columns of |A| |Z|. */
static void sli_null_products(sl_factor *F, const sli_source *from) {
    const size_t n = (size_t)F->S->n;
    double *product = F->null.products, *sizes = product + (size_t)F->null.vectors * n;
    sl_int j, k;
    memset(sizes, 0, n * sizeof(double));
    for (j = 0; j < F->null.vectors; j++) {
        const sli_null_walk w = sli_null_product(F, from, F->null.g + (size_t)j * n, NULL);
        for (k = 0; k < F->S->n; k++) {
            const sli_null_row *row = &F->null.rows[sli_null_walk_row(&w, k)];
            product[(size_t)k + (size_t)j * n] = row->product;
            sizes[k] += row->size;
            F->null.row_entries[k] = row->entries;
        }
    }
}

/* rounding(last) := infinity for a component without a null vector among the combinations of the
 * columns, else 0; g := these null vectors. */
static void sli_null_bases_test(sl_factor *F, const sli_source *from) {
    sl_int k;
    for (k = 0; k < F->S->n; k++) {
        sli_null_part p = sli_null_part_of(F, k);
        for (; F->null.last[k] == k && p.rank > 0; p.rank--) {
            sli_null_scale(&p, p.rank - 1);
        }
    }
    sli_null_products(F, from);
    for (k = 0; k < F->S->n; k++) {
        if (F->null.last[k] == k) {
            const sli_null_part p = sli_null_part_of(F, k);
            F->null.rounding[k] = sli_null_restrict(&p) < p.count ? 0.0 : (double)INFINITY;
        }
    }
}

/* Finds the null vectors of all components and their anchors, which are marked in the chain. The
 * components of one tree share the columns of g; refused if these do not suffice. */
static sl_status sli_null_bases(sl_factor *F, const sli_source *from, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_int anchors[SLI_NULL_VECTORS_MAX], k, j, rank, used = 0;
    SLI_COPY(F->null.g, F->null.z, (size_t)S->n * (size_t)F->null.vectors);
    sli_null_chain(F);
    sli_null_bases_test(F, from);
    for (k = 0; k < S->n; k++) {
        if (F->null.last[k] == k) {
            sli_null_part p = sli_null_part_of(F, k);
            const int is_single = sli_null_is_row(F, k);
            if (F->null.rounding[k] == 0.0) {
                sli_null_orthonormalize(&p);
            } else {
                p.rank = 0;
            }
            F->null.rounding[k] = p.rank == 0 ? (double)INFINITY : 0.0;
            if (!is_single && used + p.rank > p.count) {
                return sli_fail(failure, SL_ERR_UNSUPPORTED, S->super_of[k], k, -1, 0.0);
            }
            sli_null_anchors(&p, anchors);
            rank = p.rank;
            p.rank = is_single ? 0 : rank; /* in a row of zeros z' b is b itself */
            sli_null_normalize(&p, anchors, used);
            used += p.rank;
            for (j = 0; j < rank; j++) {
                F->null.chain[anchors[j]] = SLI_NULL_IS_ANCHOR;
            }
        }
        used = S->parent[k] == -1 ? 0 : used;
    }
    return SL_OK;
}

#endif
