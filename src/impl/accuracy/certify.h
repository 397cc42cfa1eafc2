/* certify.h: sl_factor_certify: the largest error of all solves in the energy norm */
#ifndef SLI_ACCURACY_CERTIFY_H
#define SLI_ACCURACY_CERTIFY_H

#include "../../public/bounds.h"
#include "../matrix/csc_products.h"
#include "../factor/factor.h"
#include "../solve/plan.h"
#include "guarantee.h"

/* Estimated: a power iteration. For a probe v the product b = A v is formed in twice the working
 * precision, so that v is the exact solution, and the error of the solve of b is measured against
 * v, in the energy norm. The next probe is that error: it is about A^-1 E v, where L D L' = A + E,
 * and so the probes turn to the vectors that E disturbs most, as a rule the smooth ones, while
 * rounding in the sweeps is measured along with E. Half of the probes start rough, half of them
 * smooth. Each tree of the elimination forest has norms and probes of its own: in a mean over all
 * of them the errors of a small one would not show. */
#define SLI_PROBES 4
#define SLI_PROBE_TURNS 3

/* The probes measure a mean over a tree. The largest error of a solve was up to 2.0 times the
 * largest measured one in 7e4 systems of up to 12 rows, and up to 1.03 times in 250 meshes of 500
 * to 1e4 rows: badly scaled ones, with conditions up to 1e10, L in double and in float. But where b
 * and x stay within a few rows of many, beside a heavy mass matrix, the worst one of many small
 * systems counts. Errors are a few roundings of single rows there: eta is at least four of them. */
#define SLI_PROBE_SAFETY 4.0

/* Above, the terms of second order in eta matter, which bounds take four times. */
#define SLI_ETA_MOST 0.0625

typedef struct sli_probes {
    const sl_factor *F;
    const sl_csc *A;
    sl_triangle triangle;
    double *v;             /* n x SLI_PROBES, by rows: the probes */
    double *product;       /* n x 2 SLI_PROBES, by rows: A v as a sum, the large parts first */
    unsigned char *memory; /* of the sweeps */
    double *norm;          /* trees x SLI_PROBES */
    double *scale;         /* trees x SLI_PROBES: of the error that has become the probe */
    double eta;            /* the largest error so far */
    sl_int solves;
} sli_probes;

static void sli_probes_layout(sli_probes *p, sli_block *b) {
    const sli_query q = sli_query_all(p->F->S);
    const uint64_t count = (uint64_t)p->F->S->n * SLI_PROBES;
    p->v = SLI_TAKE(b, double, count);
    p->product = SLI_TAKE(b, double, 2 * count);
    p->norm = SLI_TAKE(b, double, (uint64_t)p->F->S->stats.symbolic.components *SLI_PROBES);
    p->scale = SLI_TAKE(b, double, (uint64_t)p->F->S->stats.symbolic.components *SLI_PROBES);
    p->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(&q, 2 * SLI_PROBES, SLI_TILE), 1);
}

/* Where row k of the probes is, by trees; one tree has the order of the caller. */
SLI_INLINE ptrdiff_t sli_probes_at(const sli_probes *p, sl_int k) {
    const sl_symbolic *S = p->F->S;
    return (ptrdiff_t)(S->stats.symbolic.components == 1 ? k : S->perm[k]) * SLI_PROBES;
}

/* One more than the last row of the tree that begins with row `first`. */
static sl_int sli_probes_end(const sli_probes *p, sl_int first) {
    const sl_symbolic *S = p->F->S;
    sl_int k = S->stats.symbolic.components == 1 ? S->n - 1 : first;
    while (S->parent[k] != -1) {
        k++;
    }
    return k + 1;
}

/* x := A^-1 x by the factor, 0 in the rows of null pivots. x: n x count, by rows. */
static void sli_probes_solve(sli_probes *p, double *x, sl_int count) {
    const sli_query q = sli_query_all(p->F->S);
    const size_t ld = SL_ROWS((size_t)count);
    const sli_rhs rhs = sli_rhs_of(x, ld, x, ld, count);
    const sli_vectors v = sli_vectors_of(&q, count, p->memory);
    const int kind = sli_lanes_kind(count);
    sli_pack(p->F, &q, v.y, &rhs);
    sli_forward_sweep(p->F, kind, &q.forward, v.y, v.scratch);
    sli_backward_sweep(p->F, kind, &q.forward, p->F->D, v.y, v.scratch);
    sli_unpack(p->F, &q, &rhs, v.y);
    p->solves += count;
}

/* A pseudo-random number from -1 to 1. */
SLI_INLINE double sli_probe_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / (double)(1u << 23) - 1.0;
}

SLI_HOT static void sli_probes_start(sli_probes *p) {
    const sl_int n = p->F->S->n, half = SLI_PROBES / 2;
    double *diagonal = p->product; /* free so far */
    uint32_t state = 1;
    sl_int i, c;
    sli_diagonal_of(p->A, diagonal); /* the scale of the probes, the same for any scaling of A */
    for (i = 0; i < n; i++) {
        for (c = 0; c < SLI_PROBES; c++) {
            p->v[(ptrdiff_t)i * SLI_PROBES + c] = sli_probe_random(&state) * sqrt(diagonal[i]);
        }
    }
    sli_probes_solve(p, p->v, SLI_PROBES);
    for (i = 0; i < n; i++) {
        const int is_null = sli_is_skipped(p->F, p->F->S->iperm[i]); /* solutions are 0 there */
        for (c = 0; c < half; c++) {
            p->v[(ptrdiff_t)i * SLI_PROBES + c] =
                is_null ? 0.0 : sli_probe_random(&state) / sqrt(diagonal[i]);
        }
    }
}

/* The upper half of the digits of x [Dek71]. */
SLI_INLINE double sli_upper_half(double x) {
    const double t = 134217729.0 * x; /* 2^27 + 1 */
    return t - (t - x);
}

/* product += a v in one row, with a relative error of about epsilon^2 [Dek71]. */
static void sli_probes_add(double *product, double a, const double *v) {
    double *high = product, *low = product + SLI_PROBES;
    const double a1 = sli_upper_half(a), a2 = a - a1;
    sl_int c;
    for (c = 0; c < SLI_PROBES; c++) {
        const double v1 = sli_upper_half(v[c]), v2 = v[c] - v1, exact = a * v[c];
        const double error = ((a1 * v1 - exact) + a1 * v2 + a2 * v1) + a2 * v2;
        const double sum = high[c] + exact, t = sum - high[c];
        low[c] += ((high[c] - (sum - t)) + (exact - t)) + error;
        high[c] = sum;
    }
}

SLI_HOT static void sli_probes_multiply(sli_probes *p) {
    const sl_csc *A = p->A;
    sl_int j, q;
    SLI_ZERO(p->product, (size_t)A->n_cols * 2 * SLI_PROBES);
    for (j = 0; j < A->n_cols; j++) {
        const ptrdiff_t at = (ptrdiff_t)j * SLI_PROBES;
        for (q = A->p[j]; q < A->p[j + 1]; q++) {
            const ptrdiff_t to = (ptrdiff_t)A->i[q] * SLI_PROBES;
            if (sli_is_read(p->triangle, A->i[q], j)) {
                sli_probes_add(p->product + 2 * to, A->x[q], p->v + at);
                if (to != at) {
                    sli_probes_add(p->product + 2 * at, A->x[q], p->v + to);
                }
            }
        }
    }
}

/* Takes the norms of the probes in each tree. Those after the first are the errors of the ones
 * before. */
SLI_HOT static void sli_probes_measure(sli_probes *p, int is_first) {
    double *before = p->norm;
    const double *scale = p->scale;
    sl_int first, end, k, c;
    for (first = 0; first < p->F->S->n; first = end, before += SLI_PROBES, scale += SLI_PROBES) {
        double square[SLI_PROBES] = {0.0}, size[SLI_PROBES] = {0.0};
        end = sli_probes_end(p, first);
        for (k = first; k < end; k++) {
            const ptrdiff_t at = sli_probes_at(p, k);
            for (c = 0; c < SLI_PROBES; c++) {
                square[c] +=
                    p->v[at + c] * (p->product[2 * at + c] + p->product[2 * at + SLI_PROBES + c]);
                size[c] += fabs(p->v[at + c]);
            }
        }
        for (c = 0; c < SLI_PROBES; c++) {
            const double norm = size[c] == 0.0 ? 0.0 : sqrt(square[c]);
            if (size[c] != 0.0 && !(square[c] > 0.0)) { /* A is not definite, or not finite */
                p->eta = HUGE_VAL;
            } else if (!is_first && before[c] > 0.0) {
                p->eta = fmax(p->eta, norm * (scale[c] / before[c]));
            }
            before[c] = norm;
        }
    }
}

/* The errors of the solves become the probes, scaled by powers of 2 in each tree. Null pivots have
 * no error: their x is 0 but for D, which is not infinite. */
SLI_HOT static void sli_probes_turn(sli_probes *p) {
    double *scale = p->scale;
    sl_int first, end, k, c;
    sli_probes_solve(p, p->product, 2 * SLI_PROBES);
    for (first = 0; first < p->F->S->n; first = end, scale += SLI_PROBES) {
        double largest[SLI_PROBES] = {0.0};
        end = sli_probes_end(p, first);
        for (k = first; k < end; k++) {
            const ptrdiff_t at = sli_probes_at(p, k);
            const int is_null = sli_is_skipped(p->F, p->F->S->iperm[at / SLI_PROBES]);
            double *v = p->v + at;
            const double *x = p->product + 2 * at;
            for (c = 0; c < SLI_PROBES; c++) {
                v[c] = is_null ? 0.0 : (v[c] - x[c]) - x[c + SLI_PROBES];
                largest[c] = fmax(largest[c], fabs(v[c]));
            }
        }
        for (c = 0; c < SLI_PROBES; c++) {
            int exponent = 0;
            (void)frexp(largest[c], &exponent);
            scale[c] = ldexp(1.0, exponent);
        }
        for (k = first; k < end; k++) {
            double *v = p->v + sli_probes_at(p, k);
            for (c = 0; c < SLI_PROBES; c++) {
                v[c] /= scale[c];
            }
        }
    }
}

/* The number of the anchor among the columns first .. root of a tree, or -1 if solves are not
 * centered there, or by a null vector that is not known. */
SLI_INLINE sl_int sli_anchor_in(const sl_factor *F, sl_int first, sl_int root) {
    const sl_int count = F->null.is_centered ? F->null.n_anchors : 0;
    const sl_int m = sli_lower_bound(F->null.anchors, count, first);
    return m < count && F->null.anchors[m] <= root && F->null.g[F->null.anchors[m]] != 0.0 ? m : -1;
}

/* z in column k of the tree of anchor m, where it is 1. */
SLI_INLINE double sli_anchor_vector(const sl_factor *F, sl_int m, sl_int k) {
    return F->null.g[k] / F->null.g[F->null.anchors[m]];
}

/* What the solves of the tree of columns first .. root with anchor m lose relative to |w| |u(b)|:
 * p->v and p->product have d and A d, and a vector like the rounding errors of z. */
static double sli_probes_tree(const sli_probes *p, sl_int first, sl_int root, sl_int m) {
    const sli_null_space *null = &p->F->null;
    double squares[2] = {0.0, 0.0}, sum = 0.0, size = 0.0;
    sl_int k, c;
    for (k = first; k <= root; k++) {
        const ptrdiff_t at = (ptrdiff_t)p->F->S->perm[k] * SLI_PROBES;
        const double term = null->g[k] * null->mass[k];
        for (c = 0; c < 2; c++) {
            squares[c] += p->v[at + c] * p->product[2 * at + c];
        }
        sum += term;
        size += fabs(term);
    }
    size *= DBL_EPSILON * sqrt((double)(root - first + 1));
    return (sqrt(fmax(squares[0], 0.0)) + DBL_EPSILON * sqrt(squares[1])) * sqrt(null->squares[m]) +
           fabs(null->ratios[m] - 1.0) + (size > 0.0 ? size / fabs(sum) : 0.0);
}

/* By how much the null vectors of centered solves are off. With A_1, which is A without the anchor
 * row, the computed solution is v + t L'^-1 e_k, and the exact one is (A_1^-1 (b - c m), 0) + t z
 * with the given z. The difference d of both null vectors has the norm |d| in the energy of A_1.
 * Hence t d(i) is at most |t| |u(i)| |d|, and |t| <= |w| |u(b - c m)|: |w| |d| adds to eta, for the
 * worst component. So do the rounding errors of z' b, which are at most |e| |u(b)| for a vector e
 * of about epsilon z, and what c and the mean lose where weights of both signs cancel. */
static double sli_probes_null(sli_probes *p) {
    const sl_factor *F = p->F;
    const sl_symbolic *S = F->S;
    double most = 0.0;
    uint32_t state = 1;
    sl_int k, m, first;
    int pass;
    SLI_ZERO(p->v, (size_t)S->n * SLI_PROBES);
    for (m = 0; m < F->null.n_anchors; m++) {
        p->v[(ptrdiff_t)S->perm[F->null.anchors[m]] * SLI_PROBES] = SLI_NULL_PIVOT;
    }
    sli_probes_solve(p, p->v, SLI_PROBES);
    for (pass = 0; pass < 2; pass++) {
        for (k = first = 0; k < S->n; k++) {
            if (S->parent[k] != -1) {
                continue;
            }
            m = sli_anchor_in(F, first, k);
            if (m != -1 && pass == 1) {
                most = fmax(most, sli_probes_tree(p, first, k, m));
            }
            for (; m != -1 && pass == 0 && first <= k; first++) {
                double *v = p->v + (ptrdiff_t)S->perm[first] * SLI_PROBES;
                const double z = sli_anchor_vector(F, m, first);
                v[0] -= z;
                v[1] = 2.0 * sli_probe_random(&state) * z;
            }
            first = k + 1;
        }
        if (pass == 0) {
            sli_probes_multiply(p);
        }
    }
    return most;
}

/* Estimates eta. n > 0. */
static sl_status sli_probes_run(sli_probes *p, sl_work *W) {
    sli_block b = {NULL, 0};
    sl_status status;
    int turn;
    sli_probes_layout(p, &b);
    status = sli_work_block(W, &b);
    if (status != SL_OK) {
        return status;
    }
    sli_probes_layout(p, &b);
    sli_probes_start(p);
    sli_probes_multiply(p);
    sli_probes_measure(p, 1);
    for (turn = 0; turn < SLI_PROBE_TURNS; turn++) {
        sli_probes_turn(p);
        sli_probes_multiply(p);
        sli_probes_measure(p, 0);
    }
    if (p->F->null.is_centered) {
        p->eta += sli_probes_null(p);
    }
    p->eta = SLI_PROBE_SAFETY *
             fmax(p->eta, sli_is_float(p->F) ? (double)FLT_EPSILON / 8.0 : DBL_EPSILON);
    return SL_OK;
}

/* Has F the pivots that bounds are derived for? Centered solves must add one null vector in each
 * component, which is known; where a tree has one row only, x is 0. */
static sl_status sli_certify_suits(const sl_factor *F) {
    const sl_int *up = F->S->parent;
    const char *what = NULL;
    sl_int m;
    if (F->stats.factor.negative > 0 || F->stats.factor.regularized > 0 || F->E != NULL ||
        F->type->half > 0) {
        what = "bounds with negative, regularized or 2x2 pivots or SL_STORAGE_COMPLEX";
    }
    for (m = 0; F->null.is_centered && m < F->null.n_anchors; m++) {
        const sl_int k = F->null.anchors[m];
        if (F->null.g[k] == 0.0 && (up[k] != -1 || (k > 0 && up[k - 1] != -1))) {
            what = "bounds with options.mass and a null vector that is not known: set "
                   "options.null_vector";
        }
    }
    if (F->null.is_centered && F->null.vectors > 1) {
        what = "bounds with options.mass and several null vectors: leave out options.mass";
    }
    return what == NULL ? SL_OK : sli_refuse(SL_ERR_UNSUPPORTED, what);
}

/* Is A the analyzed matrix or, for a restriction, which keeps no pattern, one of its size?
 * *triangle: the one that is read. */
static sl_status sli_certify_fits(const sl_factor *F, const sl_csc *A, sl_triangle *triangle) {
    sl_options opt;
    sl_status status;
    *triangle = F->S->stats.symbolic.triangle;
    if (F->S->nnz_input >= 0) {
        return sli_factor_fits(F, A);
    }
    opt = sli_options_with(&F->allocator);
    status = sl_csc_triangle(A, triangle, &opt, NULL);
    if (status == SL_OK && A->n_cols != F->S->n) {
        status = sli_refuse(SL_ERR_OTHER_PATTERN, "A has another size than the analyzed matrix");
    }
    return status == SL_OK ? sli_argument(A->x == NULL ? "A.x is NULL" : NULL) : status;
}

SLI_COLD static sl_status sli_certify(sl_factor *F, const sl_csc *A, sl_certainty certainty,
                                      sl_work *W, sl_certificate_info *info) {
    sli_probes p;
    sl_status status;
    SLI_CLEAR(p);
    status = sli_certify_fits(F, A, &p.triangle);
    status = status == SL_OK ? sli_certify_suits(F) : status;
    if (status != SL_OK || F->S->n == 0) {
        return status;
    }
    if (certainty == SL_GUARANTEED) {
        return sli_guarantee(F, A, W, info);
    }
    p.F = F;
    p.A = A;
    status = sli_probes_run(&p, W);
    info->eta = p.eta;
    info->solves = p.solves;
    return status;
}

SL_API sl_status sl_factor_certify(sl_factor *F, const sl_csc *A, sl_certainty certainty,
                                   sl_work *W, sl_stats *stats) {
    const double started = sli_seconds();
    sl_certificate_info info;
    sl_work own;
    sl_status status;
    sli_stats_clear_error(stats);
    if (F != NULL) {
        SLI_CLEAR(F->certificate);
    }
    status = sli_argument(F == NULL ? "F is NULL"
                          : certainty != SL_ESTIMATED && certainty != SL_GUARANTEED
                              ? "certainty is neither SL_ESTIMATED nor SL_GUARANTEED"
                              : NULL);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    SLI_CLEAR(info);
    own = sli_work_own(&F->allocator);
    status = sli_certify(F, A, certainty, W == NULL ? &own : W, &info);
    sli_free(&own.allocator, own.block);
    if (status == SL_OK && F->stats.factor.weak > 0) {
        status = sli_refuse(SL_ERR_INACCURATE, "a pivot within rounding of 0 was kept: "
                                               "stats.factor.weak");
    }
    if (status == SL_OK && !(info.eta <= SLI_ETA_MOST)) {
        status = sli_refuse(SL_ERR_INACCURATE, "eta is too large for bounds: A is ill-conditioned");
    }
    if (status == SL_OK) {
        F->certificate.eta = info.eta;
        F->certificate.certainty = info.certainty = certainty;
        F->certificate.generation = F->generation;
    }
    info.seconds = sli_seconds() - started;
    if (stats != NULL) {
        stats->certificate = info;
    }
    return sli_report(stats, status);
}

#endif
