/* given_calls.h: what calls give on a factor, so that two factors can be compared */
#ifndef SL_TEST_GIVEN_CALLS_H
#define SL_TEST_GIVEN_CALLS_H

#include "given_factors.h"

/* ---- the calls: each writes at most NUMBERS numbers ---- */

typedef struct target {
    const world *w;
    sl_factor *F;
    sl_csc A; /* its matrix, n x n: the first rows of the whole one */
    sl_int n;
    const sl_options *opt;
} target;

static inline target target_make(const world *w, kind of, int changed, const sl_options *opt) {
    const target t = {w, NULL, sl_matrix_view(w->M[of][changed]), N, opt};
    return t;
}

/* Consistent in all grids but the last, which is regular; or in none. */
static inline void right_side(const world *w, double *b, int is_consistent) {
    for (sl_int k = 0; k < N; k++) {
        b[k] = sin(1.0 + k);
    }
    for (sl_int part = 0; part < PARTS - 1 && is_consistent; part++) {
        for (int c = 0; c < 2; c++) {
            double dot = 0.0;
            for (sl_int k = 2 * NODES * part; k < 2 * NODES * (part + 1); k++) {
                dot += b[k] * w->z[c * N + k] / NODES;
            }
            for (sl_int k = 2 * NODES * part; k < 2 * NODES * (part + 1); k++) {
                b[k] -= dot * w->z[c * N + k];
            }
        }
    }
}

static inline sl_status call_solve(const target *t, double *out) {
    double b[N];
    right_side(t->w, b, 1);
    return sl_factor_solve(t->F, out, (size_t)t->n, b, (size_t)t->n, 1, NULL);
}

static inline sl_status call_inconsistent(const target *t, double *out) {
    double b[N];
    right_side(t->w, b, 0);
    return sl_factor_solve(t->F, out, (size_t)t->n, b, (size_t)t->n, 1, NULL);
}

static inline sl_status call_local(const target *t, double *out) {
    double b[ROWS];
    memset(b, 0, sizeof b);
    b[0] = 1.0;
    return sl_local_solve(t->F, t->w->rows, ROWS, t->w->rows, ROWS, out, ROWS, b, ROWS, 1, NULL,
                          NULL);
}

static inline sl_status call_regularized(const target *t, double *out) {
    sl_plan *P = NULL;
    double b[N];
    sl_status s =
        sl_plan_create(&P, sl_factor_view(t->F).symbolic, NULL, SL_ALL, NULL, SL_ALL, NULL, NULL);
    right_side(t->w, b, 1);
    s = s == SL_OK ? sl_plan_solve_regularized(P, t->F, out, (size_t)t->n, b, (size_t)t->n, 1, 30,
                                               NULL, NULL)
                   : s;
    sl_plan_free(P);
    return s;
}

static inline sl_status call_refine(const target *t, double *out) {
    double b[N];
    right_side(t->w, b, 1);
    return sl_factor_refine(t->F, &t->A, out, (size_t)t->n, b, (size_t)t->n, 1, 30, NULL, NULL);
}

static inline sl_status call_rcond(const target *t, double *out) {
    return sl_factor_rcond(t->F, &t->A, out, NULL);
}

static inline sl_status call_logdet(const target *t, double *out) {
    return sl_factor_logdet(t->F, out, out + 1);
}

static inline sl_status call_pivots(const target *t, double *out) {
    const sl_factor_info info = sl_factor_view(t->F).info;
    sl_status s = SL_OK;
    double shifts[N];
    sl_int rows[N], count = 0;
    *out++ = info.positive;
    *out++ = info.negative;
    for (int which = SL_PIVOT_NULL; which <= SL_PIVOT_REGULARIZED && s == SL_OK; which++) {
        s = sl_factor_pivot_rows(t->F, (sl_pivot_kind)which, rows, shifts, N, &count);
        *out++ = count;
        for (sl_int k = 0; k < count && k < 20; k++) {
            *out++ = rows[k] + shifts[k];
        }
    }
    return s;
}

static inline sl_status call_pseudo(const target *t, double *out) {
    sl_int component[N];
    double Q[3 * N], K[3 * N];
    sl_pseudo_inverse P = {3, component, Q, K, 0.0};
    const sl_status s = sl_factor_pseudo_inverse(t->F, &P, NULL);
    for (sl_int k = 0; k < t->n && s == SL_OK; k++) {
        out[k] = component[k]; /* the vectors of a component are any basis */
    }
    out[N] = s == SL_OK ? P.log_det : 0.0;
    return s;
}

static inline sl_status call_certify(const target *t, double *out) {
    sl_plan *P = NULL;
    double b[N], bounds[N];
    sl_status s = sl_factor_certify(t->F, &t->A, SL_ESTIMATED, NULL, NULL);
    right_side(t->w, b, 1);
    if (s == SL_OK) {
        SL_CHECK(sl_plan_create(&P, sl_factor_view(t->F).symbolic, NULL, SL_ALL, t->w->rows, ROWS,
                                NULL, NULL));
        s = sl_plan_solve_bounded(P, t->F, out, ROWS, bounds, b, (size_t)t->n, 1, NULL, NULL, NULL);
    }
    sl_plan_free(P);
    return s;
}

static inline sl_status call_diagonal(const target *t, double *out) {
    return sl_inverse_diagonal(t->F, out, t->w->rows, ROWS, NULL, NULL);
}

/* A selected inverse, the region that uses it, and a solve in it. */
static inline sl_status call_region(const target *t, double *out, int is_selected, size_t bytes) {
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    sl_plan *P = NULL;
    sl_options opt = options_none();
    double b[ROWS];
    sl_status s = SL_OK;
    memset(b, 0, sizeof b);
    b[1] = 1.0;
    if (is_selected) {
        s = sl_selected_create(&Z, t->F, t->w->rows, ROWS, NULL, NULL);
        s = s == SL_OK ? sl_selected_entries(Z, out, t->w->rows, t->w->rows, ROWS, NULL) : s;
    }
    opt.region_bytes = bytes;
    s = s == SL_OK ? sl_region_create(&R, t->F, t->w->rows, ROWS, Z, &opt, NULL) : s;
    opt = options_none();
    opt.region = R;
    s = s == SL_OK ? sl_plan_create(&P, sl_factor_view(t->F).symbolic, t->w->rows, ROWS, t->w->rows,
                                    ROWS, &opt, NULL)
                   : s;
    s = s == SL_OK ? sl_plan_solve(P, t->F, out + ROWS, ROWS, b, ROWS, 1, NULL) : s;
    sl_plan_free(P);
    sl_region_free(R);
    sl_selected_free(Z);
    return s;
}

static inline sl_status call_region_selected(const target *t, double *out) {
    return call_region(t, out, 1, 0);
}

static inline sl_status call_region_any(const target *t, double *out) {
    return call_region(t, out, 0, 0);
}

static inline sl_status call_region_bytes(const target *t, double *out) {
    return call_region(t, out, 0, 2000);
}

static inline sl_status call_constraints(const target *t, double *out) {
    sl_constraints *P = NULL;
    double b[N], values[ROWS];
    sl_status s = sl_constraints_create(&P, t->F, NULL);
    for (int k = 0; k < ROWS; k++) {
        values[k] = 1.0 + k;
    }
    right_side(t->w, b, 1);
    s = s == SL_OK ? sl_constraints_add(P, t->w->rows, NULL, ROWS, NULL) : s;
    s = s == SL_OK ? sl_constraints_solve(P, NULL, out, (size_t)t->n, b, (size_t)t->n, values, ROWS,
                                          1, NULL)
                   : s;
    sl_constraints_free(P);
    return s;
}

/* The first two grids and a part of the last. */
static inline sl_status call_submatrix(const target *t, double *out) {
    enum { COUNT = 4 * NODES + 12 };
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    sl_int rows[COUNT];
    double b[COUNT];
    for (sl_int k = 0; k < COUNT; k++) {
        rows[k] = k < 4 * NODES ? k : 2 * NODES + k;
        b[k] = 1.0 + k % 7;
    }
    sl_status s = sl_factor_submatrix(&S, &G, t->F, &t->A, rows, COUNT, NULL, NULL);
    s = s == SL_OK ? sl_factor_solve(G, out, COUNT, b, COUNT, 1, NULL) : s;
    sl_factor_free(G);
    sl_symbolic_free(S);
    return s;
}

/* The factor of another matrix follows: its options, not those of F, decide. */
static inline sl_status follow(const target *t, double *out, kind of, const sl_options *opt) {
    const sl_csc B = sl_matrix_view(t->w->M[of][0]);
    target next = *t;
    next.F = NULL;
    sl_status s =
        sl_factor_edit(&next.F, t->F, sl_factor_view(t->F).symbolic, &B, t->w->same, opt, NULL);
    s = s == SL_OK ? call_solve(&next, out) : s;
    sl_factor_free(next.F);
    return s;
}

static inline sl_status call_edit(const target *t, double *out) {
    return follow(t, out, DEFINITE, t->opt);
}

static inline sl_status call_update(const target *t, double *out) {
    const sl_int p[2] = {0, 1}, row = 5;
    const double root = 0.7;
    const sl_csc V = {N, 1, p, &row, &root};
    const sl_status s = sl_factor_rank_update(t->F, &V, NULL, NULL, NULL);
    return s == SL_OK ? call_solve(t, out) : s;
}

static inline sl_status call_update_negative(const target *t, double *out) {
    const sl_int p[2] = {0, 1}, row = 5;
    const double root = 3.0, sigma = -1.0;
    const sl_csc V = {N, 1, p, &row, &root};
    const sl_status s = sl_factor_rank_update(t->F, &V, &sigma, NULL, NULL);
    return s == SL_OK ? call_solve(t, out) : s;
}

static inline sl_status refactor(const target *t, double *out, kind of) {
    const sl_csc A = sl_matrix_view(t->w->M[of][0]);
    const sl_status s = sl_factor_refactor(t->F, &A, NULL);
    if (s == SL_OK) {
        SL_CHECK(call_pivots(t, out + N));
    }
    return s == SL_OK ? call_solve(t, out) : s;
}

static inline sl_status call_refactor_definite(const target *t, double *out) {
    return refactor(t, out, DEFINITE);
}

static inline sl_status call_refactor_singular(const target *t, double *out) {
    return refactor(t, out, SINGULAR);
}

static inline sl_status call_refactor_weak(const target *t, double *out) {
    return refactor(t, out, WEAK);
}

static inline sl_status call_refactor_negative(const target *t, double *out) {
    return refactor(t, out, NEGATIVE);
}

static inline sl_status call_refactor_growing(const target *t, double *out) {
    return refactor(t, out, GROWING);
}

typedef struct call {
    const char *name;
    sl_status (*run)(const target *t, double *out);
} call;

/* First those that a restriction supports, and last those that change F. */
static const call calls[] = {{"solve", call_solve},
                             {"solve, inconsistent", call_inconsistent},
                             {"local_solve", call_local},
                             {"plan_solve_regularized", call_regularized},
                             {"logdet", call_logdet},
                             {"pivot_rows", call_pivots},
                             {"certify", call_certify},
                             {"inverse_diagonal", call_diagonal},
                             {"region with a selected inverse", call_region_selected},
                             {"region", call_region_any},
                             {"region of few bytes", call_region_bytes},
                             {"constraints", call_constraints},
                             {"pseudo_inverse", call_pseudo},
                             {"refine", call_refine},
                             {"rcond", call_rcond},
                             {"submatrix", call_submatrix},
                             {"edit", call_edit},
                             {"rank_update", call_update},
                             {"rank_update, negative", call_update_negative},
                             {"refactor, definite", call_refactor_definite},
                             {"refactor, negative", call_refactor_negative},
                             {"refactor, growing", call_refactor_growing},
                             {"refactor, weak", call_refactor_weak},
                             {"refactor, singular", call_refactor_singular},
                             {"solve at the end", call_solve}};
enum { CALLS = sizeof calls / sizeof *calls };

/* Those that change a factor, which a mapped one refuses. */
enum { CHANGING = 8, OF_RESTRICTIONS = 13 };

/* What calls give with one factor. */
typedef struct answers {
    int is_taken[CALLS];
    sl_status status[CALLS];
    double x[CALLS][NUMBERS];
} answers;

static inline void answers_take(answers *a, const target *t, int count) {
    memset(a, 0, sizeof *a);
    for (int c = 0; c < count; c++) {
        a->is_taken[c] = 1;
        a->status[c] = calls[c].run(t, a->x[c]);
    }
}

static inline double tolerance_of(const sl_options *opt, kind of) {
    return opt->storage == SL_STORAGE_FLOAT ? 1e-3 : of == WEAK || of == GROWING ? 1e-6 : 1e-9;
}

/* Compares what F gives with what a new factor gives. Returns how many calls differ, and adds to
 * *answered those that succeed. Where pivots grow, rounding decides about rcond. */
static inline int answers_compare(const answers *a, const answers *b, const char *how, kind of,
                                  double tolerance, int *answered) {
    int wrong = 0;
    for (int c = 0; c < CALLS; c++) {
        const double error = difference(a->x[c], b->x[c]);
        const int is_rough = of == GROWING && calls[c].run == call_rcond;
        if (a->is_taken[c] &&
            (a->status[c] != b->status[c] || !(error <= (is_rough ? 3.0 : tolerance)))) {
            print_error("%s, %s matrix, F %s: %s, new %s, difference %g\n", calls[c].name,
                        kind_names[of], how, sl_status_string(a->status[c]),
                        sl_status_string(b->status[c]), error);
            wrong++;
        }
        *answered += a->is_taken[c] && a->status[c] == SL_OK;
    }
    return wrong;
}

#endif
