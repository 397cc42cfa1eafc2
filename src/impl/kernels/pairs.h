/* pairs.h: 2x2 pivots: the column tile that holds some, and the rows below it, in plain C */
#ifndef SLI_KERNELS_PAIRS_H
#define SLI_KERNELS_PAIRS_H

#include "front.h"

/* Two adjacent columns u, u+1 of one supernode and one tile form a pair if they are eliminated
 * together. D then has a 2x2 block [D(u) E(u); E(u) D(u+1)], and L(u+1, u) = 0. Tiles without pairs
 * go through the kernels as always. */
enum { SLI_PAIR_NONE = 0, SLI_PAIR_FIRST, SLI_PAIR_SECOND };

/* Does column tile c of the front hold pairs? */
SLI_INLINE int sli_tile_has_pairs(const sli_front *f, sl_int c) {
    sl_int k, any = 0;
    if (f->pairs != NULL) {
        for (k = SLI_TILE * c; k < sli_min(f->width, SLI_TILE * (c + 1)); k++) {
            any |= f->pairs[k];
        }
    }
    return any != 0;
}

/* How [a e; e b] (l, m)' = (x, y)' is solved: one elimination step. Its pivot is e, which swaps the
 * equations, if |a b| <= e^2, and a otherwise. Then the product that is subtracted from the other
 * entry is not larger than that entry, and the residual is within rounding of |D| |l|. */
typedef struct sli_pair_steps {
    int is_swapped;     /* y belongs to the first equation */
    double factor;      /* of the first equation, subtracted from the second */
    double coefficient; /* of m in the first equation */
    double l, m;        /* the pivots: subnormal ones have no reciprocal */
} sli_pair_steps;

SLI_INLINE sli_pair_steps sli_pair_eliminate(double a, double b, double e) {
    sli_pair_steps steps;
    steps.is_swapped = fabs(a / e * b) <= fabs(e); /* not if e is 0 */
    steps.factor = steps.is_swapped ? a / e : e / a;
    steps.coefficient = steps.is_swapped ? b : e;
    steps.l = steps.is_swapped ? e : a;
    steps.m = (steps.is_swapped ? e : b) - steps.factor * steps.coefficient;
    return steps;
}

/* (l, m) := D^-1 (x, y); x and l may be the same, and so may y and m. */
SLI_INLINE void sli_pair_solve(const sli_pair_steps *steps, double x, double y, double *l,
                               double *m) {
    const double first = steps->is_swapped ? y : x, second = steps->is_swapped ? x : y;
    *m = (second - steps->factor * first) / steps->m;
    *l = (first - steps->coefficient * *m) / steps->l;
}

/* A symmetric block [p q; q r]. */
typedef struct sli_pair {
    double p, q, r;
} sli_pair;

/* |D| = (D^2)^(1/2) = [p q; q r], positive semidefinite. |l' D l| alone may be 0 where an update
 * cancels the whole row, as in a constraint that repeats another one: l' |D| l is not. */
SLI_NOINLINE static sli_pair sli_pair_absolute(double a, double b, double e) {
    const double most = fabs(a) > fabs(b) ? fabs(a) : fabs(b),
                 size = most > fabs(e) ? most : fabs(e);
    const double f = size > 0.0 ? a / size : 0.0, g = size > 0.0 ? b / size : 0.0;
    const double h = size > 0.0 ? e / size : 0.0, det = fabs(f * g - h * h);
    const double trace = sqrt(f * f + g * g + 2.0 * (h * h + det)); /* of |D| / size */
    const double scale = trace > 0.0 ? size / trace : 0.0;
    sli_pair D;
    D.p = scale * (f * f + h * h + det);
    D.q = scale * fabs(h * (f + g));
    D.r = scale * (g * g + h * h + det);
    return D;
}

/* The magnitude of a row's update by a pair: l' |D| l, summed in magnitude. */
SLI_INLINE double sli_pair_gain(const sli_pair *D, double l, double m) {
    return l * l * D->p + 2.0 * fabs(l * m) * D->q + m * m * D->r;
}

/* A pair is null if its block, scaled by the sums of the magnitudes m that a and b were computed
 * from, has an eigenvalue within rounding of 0: |det| <= tolerance * (largest entry). */
SLI_NOINLINE static int sli_pair_is_null(double a, double b, double e, double m_a, double m_b,
                                         double tolerance) {
    const double f = a / m_a, g = b / m_b, h = e / (sqrt(m_a) * sqrt(m_b));
    const double most = fabs(f) > fabs(g) ? fabs(f) : fabs(g);
    if (e == 0.0) {
        return sli_is_null(a, m_a, tolerance) || sli_is_null(b, m_b, tolerance);
    }
    if (m_a == 0.0 || m_b == 0.0 || !sli_is_finite(m_a) || !sli_is_finite(m_b)) {
        return 0; /* one diagonal entry is 0 and nothing was subtracted from it; or nothing known */
    }
    return !(fabs(f * g - h * h) > tolerance * (most > fabs(h) ? most : fabs(h)));
}

/* Regularizes a null pair: moves both diagonal entries away from 0, in the direction of the trace,
 * so that the determinant of a semidefinite block grows. */
static void sli_pair_by_rule(const sli_pivot_rule *rule, sl_int k, double *a, double *b, double e,
                             const double *magnitude) {
    const double sign = *a + *b < 0.0 ? -1.0 : 1.0, other = e != 0.0 ? fabs(e) : 1.0;
    const int is_null =
        sli_pair_is_null(*a, *b, e, magnitude[0], magnitude[1], sli_rule_tolerance(rule, k));
    double *const d[2] = {a, b};
    int m;
    for (m = 0; m < 2; m++) {
        const double size = magnitude[m] > 0.0 ? magnitude[m] : other, before = *d[m];
        *d[m] += is_null ? sign * rule->regularization * size : 0.0;
        rule->shifts[k + m] = *d[m] - before;
    }
}

/* Subtracts l x' of one column from the columns i of a tile. p: the tile, 8 x 8. */
SLI_INLINE void sli_pair_subtract(double *p, sl_int i, sl_int columns, const double *l,
                                  const double *x) {
    sl_int r;
    for (; i < columns; i++) {
        for (r = i; r < SLI_TILE; r++) {
            p[SLI_TILE * i + r] -= l[r] * x[i];
        }
    }
}

/* One pivot of a tile with pairs. k: the column in the tile. */
static void sli_pair_tile_single(const sli_front *f, sl_int first, sl_int k, sl_int columns,
                                 double *p, double *reciprocals) {
    double *magnitude = f->magnitude + first, d = p[SLI_TILE * k + k];
    double l[SLI_TILE], x[SLI_TILE];
    sl_int r;
    if (f->rule->replaces) {
        d = sli_pivot_by_rule(f->rule, f->column + first + k, d, magnitude[k]);
    }
    f->D[first + k] = d;
    f->E[first + k] = 0.0;
    reciprocals[k] = 1.0 / d;
    reciprocals[SLI_TILE + k] = d < 0.0 ? 1.0 : -1.0;
    reciprocals[2 * SLI_TILE + k] = d;
    for (r = 0; r < SLI_TILE; r++) {
        x[r] = p[SLI_TILE * k + r];
        l[r] = r > k ? x[r] / d : 0.0;
        magnitude[r] += r > k ? fabs(l[r] * x[r]) : 0.0;
        p[SLI_TILE * k + r] = l[r];
    }
    sli_pair_subtract(p, k + 1, columns, l, x);
}

/* The 2x2 pivot of columns k, k+1 of a tile. For the rows below, the kernel computes x = l D with
 * divisors 1; sli_pair_rows then computes l. */
static void sli_pair_tile_double(const sli_front *f, sl_int first, sl_int k, sl_int columns,
                                 double *p, double *reciprocals) {
    double *magnitude = f->magnitude + first, *u = p + SLI_TILE * k, *v = u + SLI_TILE;
    double a = u[k], b = v[k + 1], x[2][SLI_TILE], l[2][SLI_TILE];
    const double e = u[k + 1];
    sli_pair_steps steps;
    sli_pair size;
    sl_int r;
    if (f->rule->replaces) {
        sli_pair_by_rule(f->rule, f->column + first + k, &a, &b, e, magnitude + k);
    }
    steps = sli_pair_eliminate(a, b, e);
    size = sli_pair_absolute(a, b, e);
    f->D[first + k] = a;
    f->D[first + k + 1] = b;
    f->E[first + k] = e;
    f->E[first + k + 1] = 0.0;
    for (r = k; r < k + 2; r++) {
        reciprocals[r] = reciprocals[2 * SLI_TILE + r] = 1.0;
        reciprocals[SLI_TILE + r] = 0.0;
    }
    for (r = 0; r < SLI_TILE; r++) {
        x[0][r] = u[r];
        x[1][r] = v[r];
        l[0][r] = l[1][r] = 0.0;
        if (r > k + 1) {
            sli_pair_solve(&steps, u[r], v[r], &l[0][r], &l[1][r]);
            magnitude[r] += sli_pair_gain(&size, l[0][r], l[1][r]);
        }
        u[r] = l[0][r];
        v[r] = l[1][r];
    }
    sli_pair_subtract(p, k + 2, columns, l[0], x[0]);
    sli_pair_subtract(p, k + 2, columns, l[1], x[1]);
}

/* The pivots of column tile c, which holds pairs. The columns before it are already applied.
 * reciprocals: as in sli_front, then the 8 divisors of the rows below. */
static void sli_pair_tile(const sli_front *f, sl_int c, double *reciprocals) {
    const sl_int first = SLI_TILE * c, columns = sli_min(SLI_TILE, f->width - first);
    double *p = f->panel + sli_tile_offset(f->width, c) + SLI_TILE * (ptrdiff_t)first;
    int safe = 1;
    sl_int k;
    for (k = 0; k < columns; k++) {
        if (f->pairs[first + k] == SLI_PAIR_FIRST) {
            sli_pair_tile_double(f, first, k++, columns, p, reciprocals);
        } else {
            sli_pair_tile_single(f, first, k, columns, p, reciprocals);
            safe &= fabs(f->D[first + k]) > 1e-290 && fabs(f->D[first + k]) < 1e290;
        }
    }
    if (!safe) {
        reciprocals[0] = 0.0;
    }
}

/* l := x D^-1 in the pairs of column tile c, for row tiles t0 .. t1-1 that hold x. */
static void sli_pair_rows(const sli_front *f, sl_int c, sl_int t0, sl_int t1) {
    sl_int k, t, r;
    for (k = SLI_TILE * c; k < sli_min(f->width, SLI_TILE * (c + 1)); k++) {
        sli_pair_steps steps;
        sli_pair size;
        if (f->pairs[k] != SLI_PAIR_FIRST) {
            continue;
        }
        steps = sli_pair_eliminate(f->D[k], f->D[k + 1], f->E[k]);
        size = sli_pair_absolute(f->D[k], f->D[k + 1], f->E[k]);
        for (t = t0; t < t1; t++) {
            double *u = f->panel + sli_tile_offset(f->width, t) + SLI_TILE * (ptrdiff_t)k;
            double *v = u + SLI_TILE, *magnitude = f->magnitude + SLI_TILE * (ptrdiff_t)t;
            for (r = 0; r < SLI_TILE; r++) {
                sli_pair_solve(&steps, u[r], v[r], &u[r], &v[r]);
                magnitude[r] += sli_pair_gain(&size, u[r], v[r]);
            }
        }
    }
}

/* B += L E on the 8 rows of a tile, for `length` columns: completes the product L D. */
static void sli_pair_pack(const double *l, const double *E, sl_int length, double *B) {
    sl_int j, r;
    for (j = 0; j < length; j++) {
        if (E[j] != 0.0) {
            const ptrdiff_t u = SLI_TILE * (ptrdiff_t)j, v = u + SLI_TILE;
            for (r = 0; r < SLI_TILE; r++) {
                B[u + r] += l[v + r] * E[j];
                B[v + r] += l[u + r] * E[j];
            }
        }
    }
}

#endif
