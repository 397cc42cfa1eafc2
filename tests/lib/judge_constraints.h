/* judge_constraints.h: judges of pins and of entries of the inverse */
#ifndef SL_TEST_JUDGE_CONSTRAINTS_H
#define SL_TEST_JUDGE_CONSTRAINTS_H

#include "judge.h"
#include "constraint_calls.h"
#include "exact_solve.h"

enum { JUDGE_EQUALITIES = 3 };

/* Pins, equalities and what they demand. */
typedef struct judge_constraints_t {
    sl_constraints *P;
    sl_int count;
    sl_int *row;   /* of pin k; -1: equality */
    sl_int *which; /* equality k is column which[k] of C */
    double *C;     /* n x JUDGE_EQUALITIES */
    sl_int equalities;
} judge_constraints_t;

static inline void judge_constraints_add(judge_t *t, judge_constraints_t *p, unsigned char *held) {
    const sl_int n = (sl_int)t->n, many = 1 + gen_below(&t->state, 1 + n / 3);
    sl_int *rows = test_ints(t->n), count = 0;
    if (gen_below(&t->state, 4) == 0 && p->equalities < JUDGE_EQUALITIES) {
        const sl_int size = 1 + gen_below(&t->state, n < 6 ? n : 6);
        double *c = p->C + (size_t)p->equalities * t->n, values[6];
        gen_permutation(rows, n, gen_bits(&t->state));
        gen_reals(values, 6, gen_bits(&t->state));
        const sl_status status = sl_constraints_add(p->P, rows, values, size, NULL);
        if (status == SL_OK) {
            memset(c, 0, t->n * sizeof *c);
            for (sl_int k = 0; k < size; k++) {
                c[rows[k]] = values[k];
            }
            p->row[p->count] = -1;
            p->which[p->count++] = p->equalities++;
        }
    } else {
        for (sl_int k = 0; k < many; k++) {
            const sl_int row = gen_below(&t->state, n);
            if (!held[row]) {
                held[row] = 1;
                rows[count++] = row;
            }
        }
        const sl_status status = sl_constraints_add(p->P, rows, NULL, count, NULL);
        for (sl_int k = 0; k < count; k++) {
            if (status == SL_OK) {
                p->row[p->count] = rows[k];
                p->which[p->count++] = -1;
            } else {
                held[rows[k]] = 0;
            }
        }
    }
    free(rows);
}

static inline void judge_constraints_release(judge_t *t, judge_constraints_t *p,
                                             unsigned char *held) {
    const sl_int at = gen_below(&t->state, p->count);
    if (p->row[at] == -1 || unpin(p->P, at) != SL_OK) {
        return; /* equalities stay: their columns are numbered */
    }
    held[p->row[at]] = 0;
    for (sl_int k = at; k + 1 < p->count; k++) {
        p->row[k] = p->row[k + 1];
        p->which[k] = p->which[k + 1];
    }
    p->count--;
}

/* Orthonormal columns that span those of C and the unit vectors of held rows; returns how many. */
static inline sl_int judge_constraints_basis(const judge_t *t, const judge_constraints_t *p,
                                             double *Q) {
    const size_t n = t->n;
    sl_int count = 0;
    for (sl_int k = 0; k < p->count; k++) {
        double *q = Q + (size_t)count * n, norm = 0.0;
        memset(q, 0, n * sizeof *q);
        if (p->row[k] >= 0) {
            q[p->row[k]] = 1.0;
        } else {
            memcpy(q, p->C + (size_t)p->which[k] * n, n * sizeof *q);
        }
        for (sl_int j = 0; j < 2 * count; j++) {
            const double *o = Q + (size_t)(j % count) * n;
            double dot = 0.0;
            for (size_t i = 0; i < n; i++) {
                dot += o[i] * q[i];
            }
            for (size_t i = 0; i < n; i++) {
                q[i] -= dot * o[i];
            }
        }
        for (size_t i = 0; i < n; i++) {
            norm += q[i] * q[i];
        }
        for (size_t i = 0; i < n && norm > 0.0; i++) {
            q[i] /= sqrt(norm);
        }
        count += sqrt(norm) > 1e-9;
    }
    return count;
}

/* |C' x - g| relative to |C| |x| + |g| with the largest |x| of each component, the largest. */
static inline double judge_constraints_miss(const judge_t *t, const judge_constraints_t *p,
                                            const double *x, const double *g) {
    double *most = test_reals(t->n), worst = 0.0;
    for (size_t i = 0; i < t->n; i++) {
        most[t->y->of[i]] = fmax(most[t->y->of[i]], fabs(x[i]));
    }
    for (sl_int k = 0; k < p->count; k++) {
        double sum = -g[k], size = fabs(g[k]);
        for (size_t i = 0; i < t->n; i++) {
            const double c = p->row[k] >= 0 ? ((size_t)p->row[k] == i ? 1.0 : 0.0)
                                            : p->C[(size_t)p->which[k] * t->n + i];
            sum += c * x[i];
            size += fabs(c) * most[t->y->of[i]];
        }
        worst = fmax(worst, size > 0.0 ? fabs(sum) / size : 0.0);
    }
    free(most);
    return worst;
}

/* The components of A that equalities join. */
static inline sl_int *judge_constraints_join(const judge_t *t, const judge_constraints_t *p) {
    sl_int *of = test_ints(t->n);
    memcpy(of, t->y->of, t->n * sizeof *of);
    for (sl_int k = 0; k < p->count; k++) {
        sl_int first = -1;
        for (size_t i = 0; i < t->n && p->row[k] == -1; i++) {
            if (p->C[(size_t)p->which[k] * t->n + i] != 0.0) {
                const sl_int own = judge_root(of, (sl_int)i);
                first = first == -1 ? own : judge_root(of, first);
                of[own > first ? own : first] = own > first ? first : own;
            }
        }
    }
    for (size_t i = 0; i < t->n; i++) {
        of[i] = judge_root(of, (sl_int)i);
    }
    return of;
}

static inline void judge_constraints_solve(judge_t *t, const judge_constraints_t *p) {
    const size_t n = t->n;
    double *b = test_reals(n), *x = test_reals(n), *g = test_reals(n + JUDGE_EQUALITIES);
    double *Q = test_reals(n * (n + JUDGE_EQUALITIES)), *extra = test_reals(n);
    unsigned char *is_held = (unsigned char *)test_array(n, 1);
    const double scale = gen_below(&t->state, 3) ? 1.0 : system_scale(&t->state, -8.0, 8.0);
    judge_load(t, b);
    gen_reals(g, n + JUDGE_EQUALITIES, gen_bits(&t->state));
    for (size_t i = 0; i < n; i++) {
        g[i] *= scale;
    }
    for (sl_int k = 0; k < p->count; k++) {
        for (size_t i = 0; i < n; i++) { /* any right-hand side where something is held */
            const int holds =
                p->row[k] >= 0 ? (size_t)p->row[k] == i : p->C[(size_t)p->which[k] * n + i] != 0.0;
            is_held[t->y->of[i]] |= (unsigned char)holds;
        }
    }
    const int is_any = p->equalities == 0 && t->y->constant && gen_below(&t->state, 2);
    for (size_t i = 0; i < n && is_any; i++) {
        if (is_held[t->y->of[i]] || t->y->mass != NULL) {
            b[i] = gen_real(&t->state);
        }
    }
    const sl_status status =
        sl_constraints_solve(p->P, NULL, x, n, b, n, g, n + JUDGE_EQUALITIES, 1, NULL);
    if (judge_succeeded(t, status, "pins")) {
        const sl_int rank = judge_constraints_basis(t, p, Q);
        double mean = 0.0;
        if (judge_is_centered(t) && p->equalities == 0) {
            mean = judge_center(t, b, extra, x, is_held);
        }
        sl_int *of = judge_constraints_join(t, p);
        const double error = judge_error(&t->y->M.view, of, x, b, extra, Q, rank);
        free(of);
        judge_answer(t, error, judge_limit(&t->stats), judge_is_told(&t->stats), "pins, residual");
        judge_answer(t, error == -1.0 ? error : judge_constraints_miss(t, p, x, g),
                     judge_limit(&t->stats), judge_is_told(&t->stats), "pins, values");
        judge_answer(t, mean, judge_limit(&t->stats), judge_is_told(&t->stats), "pins, mean");
    }
    free(b);
    free(x);
    free(g);
    free(Q);
    free(extra);
    free(is_held);
}

static inline void judge_way_constraints(judge_t *t) {
    judge_constraints_t p;
    unsigned char *held = (unsigned char *)test_array(t->n, 1);
    memset(&p, 0, sizeof p);
    p.row = test_ints(t->n + JUDGE_EQUALITIES);
    p.which = test_ints(t->n + JUDGE_EQUALITIES);
    p.C = test_reals(t->n * JUDGE_EQUALITIES);
    if (judge_succeeded(t, sl_constraints_create(&p.P, t->F, NULL), "pins create")) {
        for (int k = 0; k < 1 + gen_below(&t->state, 6); k++) {
            if (p.count > 0 && gen_below(&t->state, 4) == 0) {
                judge_constraints_release(t, &p, held);
            } else {
                judge_constraints_add(t, &p, held);
            }
            judge_constraints_solve(t, &p);
        }
    }
    sl_constraints_free(p.P);
    free(held);
    free(p.row);
    free(p.which);
    free(p.C);
}

/* The largest difference of entries from those of the block B of all, relative to the largest one.
 */
static inline double judge_entries(const judge_t *t, const double *B, const sl_int *rows,
                                   const sl_int *columns, const double *z, sl_int count,
                                   double most) {
    double worst = 0.0;
    for (sl_int k = 0; k < count; k++) {
        const double d = fabs(z[k] - B[(size_t)rows[k] + (size_t)columns[k] * t->n]);
        worst = d <= worst ? worst : d;
    }
    return most > 0.0 ? worst / most : worst;
}

/* Every way to an entry that is not a sweep: entries of the pattern of A and the diagonal by
 * selected inversion, whole and for a set, pairs, the diagonal and a batch of diagonals. */
static inline double judge_all_ways(judge_t *t, const double *B, double most) {
    const sl_int n = (sl_int)t->n, *p = t->y->M.p, count = p[n];
    const sl_factor *const F = t->F;
    sl_int *rows = test_ints((size_t)count + 1), *columns = test_ints((size_t)count + 1);
    sl_int *all = test_ints(t->n), c = gen_below(&t->state, n), set = 0;
    double *z = test_reals((size_t)count + t->n), worst = 0.0;
    sl_selected *Z = NULL;
    for (sl_int j = 0; j < n; j++) {
        all[j] = j;
        for (sl_int k = p[j]; k < p[j + 1]; k++) {
            rows[k] = t->y->M.i[k];
            columns[k] = j;
        }
    }
    for (int way = 0; way < 5; way++) {
        const sl_int *r = way < 2 ? rows : all, *s = way < 2 ? columns : all;
        set = way < 2 ? count : n;
        if (way == 0) {
            SL_CHECK(sl_inverse_pairs(F, z, r, s, set, NULL, NULL));
        } else if (way == 1) {
            SL_CHECK(sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL));
            SL_CHECK(sl_selected_entries(Z, z, r, s, set, NULL));
            sl_selected_free(Z);
        } else if (way == 2) {
            SL_CHECK(sl_inverse_diagonal(F, z, NULL, SL_ALL, NULL, NULL));
        } else if (way == 3) {
            SL_CHECK(sl_inverse_diagonal(F, z, all, n, NULL, NULL));
        } else {
            set = 1;
            r = s = &c;
            SL_CHECK(sl_selected_create(&Z, F, &c, 1, NULL, NULL));
            SL_CHECK(sl_selected_entries(Z, z, &c, NULL, 1, NULL));
            sl_selected_free(Z);
        }
        worst = fmax(worst, judge_entries(t, B, r, s, z, set, most));
    }
    free(rows);
    free(columns);
    free(all);
    free(z);
    return worst;
}

/* The largest error of the columns B of the inverse, relative to the largest entry. */
static inline double judge_columns_error(const judge_t *t, const double *B, double most) {
    const size_t n = t->n;
    twice_t *x = (twice_t *)test_array(n, sizeof *x);
    double *e = test_reals(n), error = 0.0;
    for (size_t j = 0; j < n; j++) {
        e[j] = 1.0;
        exact_solve(t->F, &t->y->M.view, e, NULL, x);
        for (size_t i = 0; i < n; i++) {
            error = fmax(error, fabs(x[i].high - B[i + j * n]) / most);
        }
        e[j] = 0.0;
    }
    free(x);
    free(e);
    return error;
}

/* What entries of the inverse may differ by from its columns B: 1000 times as much as sweeps from
 * full solves (spread), what growth tells, and 1000 times the error of B. */
static inline double judge_entries_limit(const judge_t *t, const double *B, double most,
                                         double spread, double worst) {
    const double growth = DBL_EPSILON * t->stats.factor.growth;
    const double limit = fmax(judge_forward(t, 1e-9, spread), growth);
    return worst <= limit || t->y->skips || t->y->is_complex
               ? limit
               : fmax(limit, judge_forward(t, 0.0, judge_columns_error(t, B, most)));
}

/* Columns of the inverse are judged as solutions, and entries by all other ways beside them. */
static inline void judge_way_inverse(judge_t *t) {
    const size_t n = t->n;
    double *B = test_reals(n * n), *e = test_reals(n), *x = test_reals(n);
    double most = 0.0, spread = 0.0, worst = 0.0, entry = 0.0;
    sl_int *rows = test_ints(n);
    for (size_t i = 0; i < n; i++) {
        rows[i] = (sl_int)i;
    }
    if (judge_succeeded(t,
                        sl_inverse_block(t->F, B, n, rows, (sl_int)n, rows, (sl_int)n, NULL, NULL),
                        "inverse")) {
        const size_t c = (size_t)gen_below(&t->state, (sl_int)n);
        for (size_t k = 0; k < n * n; k++) {
            most = fmax(most, fabs(B[k]));
        }
        for (size_t j = 0; j < n && !t->y->skips; j++) {
            e[j] = 1.0;
            SL_CHECK(sl_factor_solve(t->F, x, n, e, n, 1, NULL));
            for (size_t i = 0; i < n; i++) {
                spread = fmax(spread, fabs(x[i] - B[i + j * n]) / most);
            }
            if (j == c) {
                judge_answer(t, judge_error(&t->y->M.view, t->y->of, B + j * n, e, NULL, NULL, 0),
                             judge_limit(&t->stats), judge_is_told(&t->stats),
                             "column of the inverse");
            }
            e[j] = 0.0;
        }
        const sl_int row = (sl_int)c, other = gen_below(&t->state, (sl_int)n);
        SL_CHECK(sl_inverse_pairs(t->F, &entry, &row, &other, 1, NULL, NULL));
        if (most <= 1e300) {
            worst = judge_entries(t, B, &other, &row, &entry, 1, most);
            worst = fmax(worst, judge_all_ways(t, B, most));
            judge_grown(t, worst, spread);
        }
        judge_answer(t, most > 0.0 && most <= 1e300 ? worst : -1.0,
                     judge_entries_limit(t, B, most, spread, worst), 0, "entries of the inverse");
    }
    free(rows);
    free(B);
    free(e);
    free(x);
}

#endif
