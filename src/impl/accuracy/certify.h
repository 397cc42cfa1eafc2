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
 * smooth. */
#define SLI_PROBES 4
#define SLI_PROBE_TURNS 3

/* The probes measure a mean over all of A. The largest error of a solve was up to 2.0 times the
 * largest measured one in 7e4 systems of up to 12 rows, and up to 1.03 times in 250 meshes of 500
 * to 1e4 rows: badly scaled ones, with conditions up to 1e10, L in double and in float. But where b
 * and x stay within a few rows of many, in small components or beside a heavy mass matrix, the
 * worst one of many small systems counts: 2.8 times in 1e3 components of 3 rows, 3.5 times in 3e4
 * of them. Errors are a few roundings of single rows there: eta is at least four of them. */
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
    double norm[SLI_PROBES];
    double scale[SLI_PROBES]; /* of the error that has become the probe */
    double eta;               /* the largest error so far */
    sl_int solves;
} sli_probes;

static void sli_probes_layout(sli_probes *p, sli_block *b) {
    const sli_query q = sli_query_all(p->F->S);
    const uint64_t count = (uint64_t)p->F->S->n * SLI_PROBES;
    p->v = SLI_TAKE(b, double, count);
    p->product = SLI_TAKE(b, double, 2 * count);
    p->memory = (unsigned char *)sli_take(b, sli_vectors_bytes(&q, 2 * SLI_PROBES, SLI_TILE), 1);
}

/* x := A^-1 x by the factor, whether consistent or not. x: n x count, by rows. */
static void sli_probes_solve(sli_probes *p, double *x, sl_int count) {
    const sli_query q = sli_query_all(p->F->S);
    const size_t ld = SL_ROWS((size_t)count);
    const sli_rhs rhs = sli_rhs_of(x, ld, x, ld, count);
    const sli_vectors v = sli_vectors_of(&q, count, p->memory);
    sli_pack(p->F, &q, v.y, &rhs);
    sli_sweep_forward(p->F, &q, &v, count);
    sli_sweep_backward(p->F, &q, &v, count);
    sli_unpack(p->F, &q, &rhs, v.x);
    p->solves += count;
}

/* A pseudo-random number from -1 to 1. */
SLI_INLINE double sli_probe_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / (double)(1u << 23) - 1.0;
}

/* The diagonal of A: the scale of the probes, which are the same for any scaling of A. */
static void sli_probes_diagonal(const sli_probes *p, double *diagonal) {
    const sl_csc *A = p->A;
    sl_int j, q;
    for (j = 0; j < A->n_cols; j++) {
        diagonal[j] = 0.0;
        for (q = A->p[j]; q < A->p[j + 1]; q++) {
            diagonal[j] += A->i[q] == j ? A->x[q] : 0.0;
        }
    }
}

static void sli_probes_start(sli_probes *p) {
    const sl_int n = p->F->S->n, half = SLI_PROBES / 2;
    double *diagonal = p->product; /* free so far */
    uint32_t state = 1;
    sl_int i, c;
    sli_probes_diagonal(p, diagonal);
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

static void sli_probes_multiply(sli_probes *p) {
    const sl_csc *A = p->A;
    sl_int j, q;
    memset(p->product, 0, (size_t)A->n_cols * 2 * SLI_PROBES * sizeof(double));
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

/* Takes the norms of the probes. Those after the first are the errors of the ones before. */
static void sli_probes_measure(sli_probes *p, int is_first) {
    double square[SLI_PROBES], size[SLI_PROBES];
    sl_int i, c;
    memset(square, 0, sizeof square);
    memset(size, 0, sizeof size);
    for (i = 0; i < p->F->S->n; i++) {
        const ptrdiff_t at = (ptrdiff_t)i * SLI_PROBES;
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
        } else if (!is_first && p->norm[c] > 0.0) {
            p->eta = fmax(p->eta, norm * (p->scale[c] / p->norm[c]));
        }
        p->norm[c] = norm;
    }
}

/* The errors of the solves become the probes, scaled by powers of 2. */
static void sli_probes_turn(sli_probes *p) {
    double largest[SLI_PROBES], *v = p->v;
    const double *x = p->product;
    sl_int i, c;
    sli_probes_solve(p, p->product, 2 * SLI_PROBES);
    memset(largest, 0, sizeof largest);
    for (i = 0; i < p->F->S->n; i++, v += SLI_PROBES, x += 2 * SLI_PROBES) {
        for (c = 0; c < SLI_PROBES; c++) {
            v[c] = (v[c] - x[c]) - x[c + SLI_PROBES];
            largest[c] = fmax(largest[c], fabs(v[c]));
        }
    }
    for (c = 0; c < SLI_PROBES; c++) {
        int exponent = 0;
        (void)frexp(largest[c], &exponent);
        p->scale[c] = ldexp(1.0, exponent);
    }
    for (i = 0, v = p->v; i < p->F->S->n; i++, v += SLI_PROBES) {
        for (c = 0; c < SLI_PROBES; c++) {
            v[c] /= p->scale[c];
        }
    }
}

/* Estimates eta. n > 0. */
static sl_status sli_probes_run(sli_probes *p, sl_work *W) {
    sli_block b = {NULL, 0, 0};
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
    p->eta = SLI_PROBE_SAFETY *
             fmax(p->eta, sli_is_float(p->F) ? (double)FLT_EPSILON / 8.0 : DBL_EPSILON);
    return SL_OK;
}

/* Has F the pivots that bounds are derived for? */
static int sli_certify_suits(const sl_factor *F) {
    return F->stats.factor.negative == 0 && F->stats.factor.regularized == 0 && F->E == NULL &&
           F->null.mass == NULL && F->null.vectors <= 1 && F->type->half == 0;
}

static sl_status sli_certify(sl_factor *F, const sl_csc *A, sl_certainty certainty, sl_work *W,
                             sl_certificate_info *info) {
    sli_probes p;
    sl_status status;
    if (F->S->n == 0) {
        return SL_OK;
    }
    if (certainty == SL_GUARANTEED) {
        return sli_guarantee(F, A, W, info);
    }
    memset(&p, 0, sizeof p);
    p.F = F;
    p.A = A;
    p.triangle = F->S->stats.symbolic.triangle;
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
    status = sli_argument(F == NULL ? "F is NULL"
                          : certainty != SL_ESTIMATED && certainty != SL_GUARANTEED
                              ? "certainty is neither SL_ESTIMATED nor SL_GUARANTEED"
                              : NULL);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    memset(&F->certificate, 0, sizeof F->certificate);
    status = sli_factor_fits(F, A);
    if (status == SL_OK && !sli_certify_suits(F)) {
        status = sli_refuse(SL_ERR_UNSUPPORTED, "bounds with negative, regularized or 2x2 pivots, "
                                                "options.mass or SL_STORAGE_COMPLEX");
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    memset(&info, 0, sizeof info);
    own = sli_work_own(&F->allocator);
    status = sli_certify(F, A, certainty, W == NULL ? &own : W, &info);
    sli_free(&own.allocator, own.block);
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
