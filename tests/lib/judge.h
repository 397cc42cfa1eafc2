/* judge.h: a judge of answers: the backward error of each component, and what a caller was told */
#ifndef SL_TEST_JUDGE_H
#define SL_TEST_JUDGE_H

#include "judge_systems.h"

#define JUDGE_LIMIT 1e-8

typedef enum judge_verdict_t {
    JUDGE_GOOD,
    JUDGE_REFUSED,     /* by a status */
    JUDGE_UNSUPPORTED, /* by SL_ERR_UNSUPPORTED */
    JUDGE_FLAGGED,     /* wrong, and a field of stats says so */
    JUDGE_NOT_FINITE,  /* x itself says so */
    JUDGE_SILENT,      /* wrong without a signal */
    JUDGE_VERDICTS
} judge_verdict_t;

enum { JUDGE_WAYS_MOST = 24, JUDGE_DECADES = 17 };

typedef struct judge_tally_t {
    sl_off verdicts[JUDGE_WAYS_MOST][JUDGE_VERDICTS];
    double worst[JUDGE_WAYS_MOST]; /* of the good ones */
    /* by decades of growth: the largest error of entries of the inverse, and of their sweeps beside
     * full solves */
    double entries[JUDGE_DECADES], sweeps[JUDGE_DECADES];
    sl_off bounds; /* errors that were compared with their bounds */
} judge_tally_t;

/* A system under judgement. */
typedef struct judge_t {
    const judge_system_t *y;
    sl_options opt; /* for the factorization */
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats; /* of F */
    size_t n;
    int family, way;
    uint64_t seed, state;
    judge_tally_t *tally;
} judge_t;

static inline void judge_count(judge_t *t, judge_verdict_t verdict, double error,
                               const char *what) {
    double *worst = &t->tally->worst[t->way];
    t->tally->verdicts[t->way][verdict]++;
    if (verdict == JUDGE_GOOD) {
        *worst = error > *worst ? error : *worst;
    }
    if (verdict == JUDGE_SILENT) {
        print_error("silent: %s, family %d (%s), seed %llu, n %d, error %.3g, growth %.3g\n", what,
                    t->family, judge_name(t->family), (unsigned long long)t->seed, (int)t->n, error,
                    t->stats.factor.growth);
    }
}

/* Records the error of entries of the inverse by the growth of the factor. */
static inline void judge_grown(judge_t *t, double entries, double sweeps) {
    const int decade = (int)log10(fmax(t->stats.factor.growth, 1.0));
    const int k = decade < JUDGE_DECADES ? decade : JUDGE_DECADES - 1;
    t->tally->entries[k] = fmax(t->tally->entries[k], entries);
    t->tally->sweeps[k] = fmax(t->tally->sweeps[k], sweeps);
}

/* Counts a call that did not succeed; returns 1 if it did. SL_ERR_ARGUMENT and the like are no
 * answers to a correct call. */
static inline int judge_succeeded(judge_t *t, sl_status status, const char *what) {
    if (status == SL_ERR_ARGUMENT || status == SL_ERR_MISMATCH || status == SL_ERR_STALE ||
        status == SL_ERR_MALFORMED || status == SL_ERR_OTHER_PATTERN || status == SL_ERR_MEMORY) {
        print_error("%s: ", sl_status_string(status));
        judge_count(t, JUDGE_SILENT, 0.0, what);
    } else if (status != SL_OK) {
        judge_count(t, status == SL_ERR_UNSUPPORTED ? JUDGE_UNSUPPORTED : JUDGE_REFUSED, 0.0, what);
    }
    return status == SL_OK;
}

/* What a caller reads, as sl_factor_create describes it. */
static inline int judge_is_told(const sl_stats *stats) {
    return stats->factor.regularized > 0 || DBL_EPSILON * stats->factor.growth > JUDGE_LIMIT;
}

/* The backward error that L alone allows: 1e-8, or that of float. */
static inline double judge_limit(const sl_stats *stats) {
    return stats->factor.storage == SL_STORAGE_FLOAT ? 1e-4 * fmax(stats->factor.growth, 1.0)
                                              : JUDGE_LIMIT;
}

/* A residual: of b - A x + C f for the best f, where C has `count` orthonormal columns, by
 * components in the maximum norm, relative to |A| |x| + |b| + |c f| for columns c of several rows.
 * Returns the largest, -1 if x is not finite. */
static inline double judge_error(const sl_csc *A, const sl_int *of, const double *x,
                                 const double *b, const double *extra, const double *C,
                                 sl_int count) {
    const size_t n = (size_t)A->n_cols;
    double *D = ref_dense(A), worst = 0.0;
    long double *r = (long double *)test_array(n + 1, sizeof *r);
    long double *a = (long double *)test_array(4 * n + 1, sizeof *a);
    long double *xs = a + n, *bs = xs + n, *rs = bs + n;
    for (size_t i = 0; i < n; i++) {
        long double row = 0.0L;
        r[i] = b[i];
        for (size_t j = 0; j < n; j++) {
            r[i] -= (long double)D[i + j * n] * x[j];
            row += fabs(D[i + j * n]);
        }
        if (!(fabs(x[i]) <= DBL_MAX)) {
            worst = -1.0;
        }
        const size_t c = (size_t)of[i];
        const long double size = fabs(b[i]) + (extra ? extra[i] : 0.0);
        a[c] = row > a[c] ? row : a[c];
        xs[c] = fabs(x[i]) > xs[c] ? (long double)fabs(x[i]) : xs[c];
        bs[c] = size > bs[c] ? size : bs[c];
    }
    for (sl_int k = 0; k < count && worst == 0.0; k++) { /* least squares */
        long double dot = 0.0L;
        sl_int rows = 0;
        for (size_t i = 0; i < n; i++) {
            dot += C[i + (size_t)k * n] * r[i];
            rows += C[i + (size_t)k * n] != 0.0;
        }
        for (size_t i = 0; i < n; i++) {
            const long double part = dot * C[i + (size_t)k * n];
            const long double size = part < 0.0L ? -part : part;
            r[i] -= part;
            bs[of[i]] = rows > 1 && size > bs[of[i]] ? size : bs[of[i]];
        }
    }
    for (size_t i = 0; i < n && worst >= 0.0; i++) {
        const size_t c = (size_t)of[i];
        const long double e = r[i] < 0.0L ? -r[i] : r[i];
        rs[c] = e > rs[c] ? e : rs[c];
    }
    for (size_t c = 0; c < n && worst >= 0.0; c++) {
        const long double size = a[c] * xs[c] + bs[c];
        if (rs[c] > 0.0L) {
            worst = fmax(worst, (double)(rs[c] / size));
        }
    }
    free(D);
    free(r);
    free(a);
    return worst;
}

/* What two ways to one answer may differ by, relative to the largest entry. spread: what two ways
 * differ by that are as accurate as L; not known of singular matrices. */
static inline double judge_forward(const judge_t *t, double least, double spread) {
    return t->y->skips ? judge_limit(&t->stats) + 1e-3 : least + 1000.0 * spread;
}

/* Judges one answer that came with SL_OK. told: a field of stats has warned. */
static inline void judge_answer(judge_t *t, double error, double limit, int told,
                                const char *what) {
    judge_count(t,
                error == -1.0    ? JUDGE_NOT_FINITE
                : error <= limit ? JUDGE_GOOD
                : told           ? JUDGE_FLAGGED
                                 : JUDGE_SILENT,
                error, what);
}

/* A random local question: b on some rows, x wanted on some rows. */
typedef struct judge_question_t {
    sl_int nb, nx, *bset, *xset;
    double *b, *full; /* nb; n: the same right-hand side on all rows */
} judge_question_t;

static inline judge_question_t judge_question(judge_t *t) {
    const sl_int n = (sl_int)t->n;
    judge_question_t q;
    q.nb = 1 + gen_below(&t->state, n);
    q.nx = 1 + gen_below(&t->state, n);
    q.bset = test_ints(t->n);
    q.xset = test_ints(t->n);
    q.b = test_reals(t->n);
    q.full = test_reals(t->n);
    gen_set(q.bset, q.nb, n, gen_bits(&t->state));
    gen_set(q.xset, q.nx, n, gen_bits(&t->state));
    gen_reals(q.b, t->n, gen_bits(&t->state));
    for (sl_int k = 0; k < q.nb; k++) {
        q.full[q.bset[k]] = q.b[k];
    }
    return q;
}

static inline void judge_question_free(judge_question_t *q) {
    free(q->bset);
    free(q->xset);
    free(q->b);
    free(q->full);
}

/* A right-hand side: any one, a unit vector, or for semidefinite systems A z in long double. */
static inline void judge_load(judge_t *t, double *b) {
    const size_t n = t->n;
    const sl_int kind = t->y->skips ? 2 : gen_below(&t->state, 4);
    gen_reals(b, n, gen_bits(&t->state));
    if (kind == 1) {
        memset(b, 0, n * sizeof *b);
        b[gen_below(&t->state, (sl_int)n)] = 1.0;
    } else if (kind == 2) {
        double *D = ref_dense(&t->y->M.view), *z = test_reals(n);
        memcpy(z, b, n * sizeof *z);
        for (size_t i = 0; i < n; i++) {
            long double sum = 0.0L;
            for (size_t j = 0; j < n; j++) {
                sum += (long double)D[i + j * n] * z[j];
            }
            b[i] = (double)sum;
        }
        for (size_t i = 0; i < n; i++) {
            if (!(fabs(b[i]) <= DBL_MAX)) {
                b[i] = 0.0;
            }
        }
        free(D);
        free(z);
    }
}

/* Are the means of solutions known? */
static inline int judge_is_centered(const judge_t *t) {
    return t->y->mass != NULL && (t->y->constant || t->y->vectors > 0);
}

/* C := the null vectors in the rows of component c, orthonormal in the product of the weights.
 * Returns their number. */
static inline sl_int judge_motions(const judge_t *t, sl_int c, long double *C) {
    const size_t n = t->n;
    const double *m = t->y->mass;
    sl_int rank = 0;
    for (sl_int j = 0; j < t->y->vectors; j++) {
        long double *v = C + (size_t)rank * n, before = 0.0L, square = 0.0L;
        for (size_t i = 0; i < n; i++) {
            v[i] = t->y->of[i] == c ? (long double)t->y->Z[i + (size_t)j * n] : 0.0L;
            before += m[i] * v[i] * v[i];
        }
        for (sl_int k = 0; k < 2 * rank; k++) { /* twice */
            const long double *q = C + (size_t)(k % rank) * n;
            long double dot = 0.0L;
            for (size_t i = 0; i < n; i++) {
                dot += m[i] * q[i] * v[i];
            }
            for (size_t i = 0; i < n; i++) {
                v[i] -= dot * q[i];
            }
        }
        for (size_t i = 0; i < n; i++) {
            square += m[i] * v[i] * v[i];
        }
        for (size_t i = 0; i < n; i++) {
            v[i] /= square > 0.0L ? sqrtl(square) : 1.0L;
        }
        rank += square > 1e-28L * before;
    }
    return rank;
}

/* judge_center for component c with several null vectors. */
static inline double judge_center_motions(const judge_t *t, sl_int c, double *b, double *extra,
                                          const double *x) {
    const size_t n = t->n;
    const double *m = t->y->mass;
    long double *C = (long double *)test_array(n * (size_t)t->y->vectors, sizeof *C), most = 0.0L;
    long double *own = (long double *)test_array(n, sizeof *own);
    const sl_int rank = judge_motions(t, c, C);
    double worst = 0.0;
    for (size_t i = 0; i < n; i++) {
        own[i] = t->y->of[i] == c ? b[i] : 0.0;
        most = t->y->of[i] == c && fabs(x[i]) > most ? (long double)fabs(x[i]) : most;
    }
    for (sl_int k = 0; k < rank; k++) {
        const long double *q = C + (size_t)k * n;
        long double force = 0.0L, mean = 0.0L, size = 0.0L;
        for (size_t i = 0; i < n; i++) {
            force += q[i] * own[i];
            mean += q[i] * m[i] * x[i];
            size += fabs((double)q[i]) * m[i] * most;
        }
        for (size_t i = 0; i < n; i++) {
            extra[i] += fabs((double)(m[i] * q[i] * force));
            b[i] = (double)((long double)b[i] - m[i] * q[i] * force);
        }
        worst = size > 0.0L ? fmax(worst, fabs((double)(mean / size))) : worst;
    }
    free(C);
    free(own);
    return worst;
}

/* With weights and known null vectors: b := b - c m in each component, or b - M Z c; extra := what
 * was subtracted. The worst mean, relative to sum |m| max |x|. In a row of zeros x has to be 0. */
static inline double judge_center(const judge_t *t, double *b, double *extra, const double *x,
                                  const unsigned char *is_regular) {
    const size_t n = t->n;
    const sl_int *of = t->y->of;
    const double *m = t->y->mass;
    double *D = ref_dense(&t->y->M.view), worst = 0.0;
    long double *sums = (long double *)test_array(4 * n, sizeof *sums);
    for (size_t i = 0; i < n; i++) {
        long double *s = sums + 4 * of[i];
        s[0] += b[i];
        s[1] += m[i];
        s[2] += (long double)m[i] * x[i];
        s[3] = fabs(x[i]) > s[3] ? (long double)fabs(x[i]) : s[3];
    }
    for (size_t i = 0; i < n; i++) {
        const long double *s = sums + 4 * of[i];
        if (is_regular != NULL && is_regular[of[i]]) {
            continue;
        }
        if (D[i + i * n] == 0.0) { /* a row of zeros: its x is 0 */
            worst = fmax(worst, fabs(x[i]) > 1e-280 ? 1.0 : 0.0);
            b[i] = 0.0;
            continue;
        }
        if (t->y->vectors > 0) {
            worst = of[i] == (sl_int)i
                        ? fmax(worst, judge_center_motions(t, (sl_int)i, b, extra, x))
                        : worst;
            continue;
        }
        const double c = (double)(s[0] / s[1] * m[i]);
        extra[i] = fabs(c) + fabs(b[i]);
        b[i] = (double)((long double)b[i] - s[0] / s[1] * m[i]);
        if (s[3] > 0.0L) {
            worst = fmax(worst, fabs((double)(s[2] / s[3] / s[1])));
        }
    }
    free(D);
    free(sums);
    return worst;
}

#endif
