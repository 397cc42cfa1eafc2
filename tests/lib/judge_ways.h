/* judge_ways.h: the ways to an answer that judges try: solves, changes, restrictions, edits */
#ifndef SL_TEST_JUDGE_WAYS_H
#define SL_TEST_JUDGE_WAYS_H

#include "judge.h"
#include "subset.h"

/* Judges x for the right-hand side b of the system itself. */
static inline void judge_solution(judge_t *t, const sl_csc *A, const sl_int *of, const double *x,
                                  const double *b, int told, double limit, const char *what) {
    judge_answer(t, judge_error(A, of, x, b, NULL, NULL, 0), limit, told, what);
}

/* Solves with one or more right-hand sides, and judges the last one. */
static inline void judge_solve_with(judge_t *t, const sl_factor *F, const sl_csc *A,
                                    const sl_int *of, int told, double limit, const char *what) {
    const size_t n = t->n;
    const sl_int counts[6] = {1, 1, 2, 5, 8, 19}, nrhs = counts[gen_below(&t->state, 6)];
    double *B = test_reals(n * (size_t)nrhs), *X = test_reals(n * (size_t)nrhs);
    for (sl_int r = 0; r < nrhs; r++) {
        judge_load(t, B + n * (size_t)r);
    }
    if (judge_succeeded(t, sl_factor_solve(F, X, n, B, n, nrhs, NULL), what)) {
        double *b = B + n * (size_t)(nrhs - 1), *x = X + n * (size_t)(nrhs - 1);
        if (judge_is_centered(t)) {
            double *extra = test_reals(n);
            gen_reals(b, n, t->seed); /* inconsistent, for the weights to make good */
            SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
            const double mean = judge_center(t, b, extra, x, NULL);
            const double error = judge_error(A, of, x, b, extra, NULL, 0);
            judge_answer(t, error == -1.0 ? error : fmax(mean, error), limit, told, what);
            free(extra);
        } else {
            judge_solution(t, A, of, x, b, told, limit, what);
        }
    }
    free(B);
    free(X);
}

static inline void judge_way_solve(judge_t *t) {
    judge_solve_with(t, t->F, &t->y->M.view, t->y->of, judge_is_told(&t->stats),
                     judge_limit(&t->stats), "solve");
}

static inline void judge_way_refine(judge_t *t) {
    const size_t n = t->n;
    double *b = test_reals(n), *x = test_reals(n);
    sl_stats stats;
    judge_load(t, b);
    if (judge_succeeded(t, sl_factor_solve(t->F, x, n, b, n, 1, NULL), "solve") &&
        judge_succeeded(t,
                        sl_factor_refine(t->F, &t->y->M.view, x, n, b, n, 1,
                                         1 + gen_below(&t->state, 8), NULL, &stats),
                        "refine")) {
        judge_solution(t, &t->y->M.view, t->y->of, x, b, 0, JUDGE_LIMIT, "refine");
    }
    free(b);
    free(x);
}

/* A solve with b and x in a region agrees with the full one up to 1000 times as much as entries of
 * the inverse do. Half of the regions are those of neighbors in the elimination order. */
static inline void judge_region(judge_t *t, sl_int *set, sl_int count) {
    const size_t n = t->n, m = (size_t)count;
    const sl_int from = gen_below(&t->state, (sl_int)n - count + 1);
    double *b = test_reals(n), *x = test_reals(n), *full = test_reals(n), *X = test_reals(n);
    double *Z = test_reals(m * m), most = 0.0, worst = 0.0, spread = 0.0;
    sl_selected *selected = NULL;
    sl_region *R = NULL;
    sl_options opt = options_none();
    for (sl_int k = 0; k < count && from % 2; k++) {
        set[k] = sl_symbolic_view(t->S).perm[from + k];
    }
    if (gen_below(&t->state, 2) &&
        sl_selected_create(&selected, t->F, NULL, SL_ALL, NULL, NULL) != SL_OK) {
        selected = NULL;
    }
    if (judge_succeeded(t, sl_region_create(&R, t->F, set, count, selected, NULL, NULL),
                        "region")) {
        sl_plan *P = NULL;
        gen_reals(b, n, gen_bits(&t->state));
        for (sl_int k = 0; k < count; k++) {
            full[set[k]] = b[k];
        }
        opt.region = R;
        SL_CHECK(sl_inverse_block(t->F, Z, m, set, count, set, count, NULL, NULL));
        SL_CHECK(sl_plan_create(&P, t->S, set, count, set, count, &opt, NULL));
        const sl_status inside = sl_plan_solve(P, t->F, x, n, b, n, 1, NULL);
        if (sl_factor_solve(t->F, X, n, full, n, 1, NULL) == SL_OK &&
            judge_succeeded(t, inside, "region")) {
            for (size_t i = 0; i < n; i++) {
                most = fmax(most, fabs(X[i]));
            }
            for (size_t i = 0; i < m && most > 0.0 && most <= 1e300; i++) {
                double sum = 0.0;
                for (size_t j = 0; j < m; j++) {
                    sum += Z[i + j * m] * b[j];
                }
                spread = fmax(spread, fabs(sum - X[set[i]]) / most);
                worst = fmax(worst, fabs(x[i] - X[set[i]]) / most);
            }
            judge_answer(t, most <= 1e300 ? worst : -1.0, judge_forward(t, 1e-7, spread), 0,
                         "region");
        }
        sl_plan_free(P);
    }
    sl_region_free(R);
    sl_selected_free(selected);
    free(b);
    free(x);
    free(full);
    free(X);
    free(Z);
}

/* A local solve has the bits of the full one. */
static inline void judge_way_local(judge_t *t) {
    const size_t n = t->n;
    judge_question_t q = judge_question(t);
    double *x = test_reals(n), *X = test_reals(n), worst = 0.0;
    sl_plan *P = NULL;
    const sl_status status = sl_factor_solve(t->F, X, n, q.full, n, 1, NULL);
    SL_CHECK(sl_plan_create(&P, t->S, q.bset, q.nb, q.xset, q.nx, NULL, NULL));
    SL_EXPECT(status, sl_plan_solve(P, t->F, x, n, q.b, n, 1, NULL));
    for (sl_int k = 0; k < q.nx && status == SL_OK; k++) {
        const double d = X[q.xset[k]];
        worst = x[k] == d || (x[k] != x[k] && d != d) ? worst : 1.0;
    }
    sl_plan_free(P);
    if (judge_succeeded(t, status, "local")) {
        judge_answer(t, worst, 0.0, 0, "local bits");
    }
    if (status == SL_OK) {
        judge_region(t, q.xset, q.nx / 3 + 1);
    }
    judge_question_free(&q);
    free(x);
    free(X);
}

/* ---- changes of the values ---- */

/* A copy of the system's matrix without duplicates, in the lower triangle. */
static inline gen_matrix_t judge_copy(const judge_t *t) {
    double *D = ref_dense(&t->y->M.view);
    gen_list_t list = gen_list((sl_int)t->n);
    for (size_t j = 0; j < t->n; j++) {
        for (size_t i = j; i < t->n; i++) {
            if (D[i + j * t->n] != 0.0 || i == j) {
                gen_add(&list, (sl_int)i, (sl_int)j, D[i + j * t->n]);
            }
        }
    }
    gen_matrix_t M = gen_store(&list, gen_style(0), 1);
    gen_list_free(&list);
    free(D);
    return M;
}

/* Finds a change of an entry and, off the diagonal, of its diagonal entries as a spring does.
 * Returns how many entries change. */
static inline sl_int judge_change(judge_t *t, gen_matrix_t *M, sl_int *rows, sl_int *columns,
                                  double *deltas) {
    const sl_int p = gen_below(&t->state, M->p[t->n]);
    sl_int j = 0, count = 0;
    while (M->p[j + 1] <= p) {
        j++;
    }
    const sl_int i = M->i[p];
    const double size = fabs(M->x[p]) + fabs(M->x[M->p[i]]) * 1e-3;
    const double up = system_scale(&t->state, -8.0, gen_below(&t->state, 4) ? 1.0 : 10.0);
    const double delta = (M->x[M->p[i]] < 0.0 ? -size : size) * up;
    rows[count] = i;
    columns[count] = j;
    deltas[count++] = i == j ? delta : -delta;
    if (i != j) {
        rows[count] = columns[count] = i;
        deltas[count++] = delta;
        rows[count] = columns[count] = j;
        deltas[count++] = delta;
    }
    return count;
}

/* The value of an entry, which is stored. */
static inline double *judge_entry(gen_matrix_t *M, sl_int row, sl_int column) {
    sl_int p = M->p[column];
    while (M->i[p] != row) {
        p++;
    }
    return &M->x[p];
}

/* A random sequence of changes by all calls that follow values, some of them undone later. */
static inline void judge_way_change(judge_t *t) {
    gen_matrix_t M = judge_copy(t);
    sl_options opt = t->opt;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_stats stats;
    sl_int rows[3], columns[3], count = 0;
    double deltas[3], before[3];
    opt.storage = opt.storage == SL_STORAGE_COMPLEX ? SL_STORAGE_DOUBLE : opt.storage;
    SL_CHECK(sl_symbolic_create(&S, &M.view, NULL, NULL));
    sl_status status = sl_factor_create(&F, S, &M.view, &opt, &stats);
    for (int k = 0, steps = (int)gen_below(&t->state, 12); k <= steps && status == SL_OK; k++) {
        const sl_int kind = gen_below(&t->state, 4);
        const int undoes = count > 0 && gen_below(&t->state, 3) == 0;
        count = undoes ? count : judge_change(t, &M, rows, columns, deltas);
        for (sl_int c = 0; c < count && undoes; c++) {
            deltas[c] = -deltas[c];
        }
        for (sl_int c = 0; c < count; c++) {
            double *entry = judge_entry(&M, rows[c], columns[c]);
            before[c] = *entry;
            *entry += deltas[c];
        }
        if (kind == 0) {
            status = sl_factor_change_entries(F, NULL, rows, columns, deltas, count, NULL, &stats);
            if (status == SL_ERR_UNSUPPORTED) {
                status = sl_factor_refactor(F, &M.view, &stats);
            } else if (status != SL_OK && status != SL_ERR_NOT_FINITE) { /* F is as before */
                while (count > 0) { /* subtracting the deltas would leave their rounding */
                    count--;
                    *judge_entry(&M, rows[count], columns[count]) = before[count];
                }
                stats.factor = sl_factor_view(F).info;
                status = SL_OK;
            }
        } else if (kind == 1) {
            status = sl_factor_change_entries(F, &M.view, NULL, columns, NULL, count, NULL, &stats);
        } else if (kind == 2) {
            status =
                sl_factor_change_entries(F, &M.view, rows, columns, deltas, count, NULL, &stats);
        } else {
            status = sl_factor_refactor(F, &M.view, &stats);
        }
    }
    if (F != NULL && judge_succeeded(t, status, "change")) {
        sl_stats now;
        now.factor = sl_factor_view(F).info;
        const int is_mixed = now.factor.positive > 0 && now.factor.negative > 0;
        sl_int *of = judge_components(&M.view, is_mixed); /* growth is that of a pattern */
        double *b = test_reals(t->n), *x = test_reals(t->n), *z = test_reals(t->n);
        gen_reals(z, t->n, t->seed);
        if (t->y->skips) {
            SL_CHECK(sl_csc_multiply(&M.view, SL_AS_SYMMETRIC, b, t->n, z, t->n, 1));
        } else {
            memcpy(b, z, t->n * sizeof *b);
        }
        const int told = judge_is_told(&now) || stats.change.drift > JUDGE_LIMIT;
        if (judge_succeeded(t, sl_factor_solve(F, x, t->n, b, t->n, 1, NULL), "changed solve") &&
            t->y->mass == NULL) {
            judge_solution(t, &M.view, of, x, b, told, judge_limit(&now), "change");
        }
        free(of);
        free(b);
        free(x);
        free(z);
    } else if (F == NULL) {
        (void)judge_succeeded(t, status, "create");
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    gen_matrix_free(&M);
}

/* ---- parts and edits of the matrix ---- */

static inline void judge_way_submatrix(judge_t *t) {
    const sl_int n = (sl_int)t->n;
    sl_int *rows = test_ints(t->n), count = 0;
    const sl_int keep = 1 + gen_below(&t->state, 12);
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    sl_stats stats;
    for (sl_int i = 0; i < n; i++) {
        if (gen_below(&t->state, keep + 1) > 0) {
            rows[count++] = i;
        }
    }
    if (judge_succeeded(t,
                        sl_factor_submatrix(&S, &G, t->F, &t->y->M.view, rows, count, NULL, &stats),
                        "restrict") &&
        count > 0) {
        gen_matrix_t B = subset_matrix(&t->y->M.view, rows, count);
        sl_int *of = judge_components(&B.view, 0);
        double *b = test_reals(t->n), *x = test_reals(t->n);
        gen_reals(b, t->n, gen_bits(&t->state));
        SL_CHECK(sl_factor_solve(G, x, (size_t)count, b, (size_t)count, 1, NULL));
        judge_solution(t, &B.view, of, x, b, judge_is_told(&stats), judge_limit(&stats),
                       "restrict");
        gen_matrix_free(&B);
        free(of);
        free(b);
        free(x);
    }
    sl_factor_free(G);
    sl_symbolic_free(S);
    free(rows);
}

/* Rows go, springs come; the factor follows. */
static inline void judge_way_edit(judge_t *t) {
    const size_t n = t->n;
    sl_int *new_of = test_ints(n), count = 0;
    double *D = ref_dense(&t->y->M.view), *E = test_reals((n + 2) * (n + 2));
    for (size_t i = 0; i < n; i++) {
        new_of[i] = gen_below(&t->state, 10) > 0 ? count++ : -1;
    }
    const sl_int m = count + gen_below(&t->state, 3);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = j; i < n; i++) {
            if (D[i + j * n] != 0.0 && i != j && new_of[i] >= 0 && new_of[j] >= 0) {
                E[(size_t)new_of[i] * (size_t)m + (size_t)new_of[j]] = D[i + j * n];
            }
        }
        if (new_of[j] >= 0) { /* what held the row to those that are gone is gone */
            double own = D[j + j * n];
            for (size_t i = 0; i < n && t->y->constant; i++) {
                own += i != j && new_of[i] < 0 ? D[i + j * n] : 0.0;
            }
            E[(size_t)new_of[j] * ((size_t)m + 1)] = own;
        }
    }
    for (sl_int i = 0; i < m && m > 1; i++) {
        if (i >= count || gen_below(&t->state, 8) == 0) {
            const sl_int j = (i + 1 + gen_below(&t->state, m - 1)) % m;
            system_spring(E, m, i, j, system_scale(&t->state, -3.0, 1.0));
        }
    }
    gen_list_t list = gen_list(m);
    for (sl_int i = 0; i < m; i++) {
        for (sl_int j = 0; j <= i; j++) {
            const double a = E[(size_t)i * (size_t)m + (size_t)j];
            if (a != 0.0 || i == j) {
                gen_add(&list, i, j, a);
            }
        }
    }
    gen_matrix_t B = gen_store(&list, gen_style(0), 1);
    sl_symbolic *S = NULL;
    sl_factor *G = NULL;
    sl_stats stats;
    sl_options opt = t->opt;
    opt.mass = NULL;
    opt.signs = NULL;
    opt.null_vector = NULL;
    opt.null_vector_count = 0;
    opt.storage = opt.storage == SL_STORAGE_COMPLEX ? SL_STORAGE_DOUBLE : opt.storage;
    gen_list_free(&list);
    if (m > 0 &&
        judge_succeeded(t, sl_symbolic_edit(&S, t->S, &t->y->M.view, &B.view, new_of, NULL, &stats),
                        "symbolic edit") &&
        judge_succeeded(t, sl_factor_edit(&G, t->F, S, &B.view, new_of, &opt, &stats),
                        "factor edit")) {
        const size_t rows = (size_t)m;
        sl_int *of = judge_components(&B.view, 0);
        double *b = test_reals(rows), *x = test_reals(rows), *z = test_reals(rows);
        gen_reals(z, rows, gen_bits(&t->state));
        memcpy(b, z, rows * sizeof *b);
        if (t->y->skips) {
            SL_CHECK(sl_csc_multiply(&B.view, SL_AS_SYMMETRIC, b, rows, z, rows, 1));
        }
        if (judge_succeeded(t, sl_factor_solve(G, x, rows, b, rows, 1, NULL), "edited solve")) {
            judge_solution(t, &B.view, of, x, b, judge_is_told(&stats), judge_limit(&stats),
                           "edit");
        }
        free(of);
        free(b);
        free(x);
        free(z);
    }
    sl_factor_free(G);
    sl_symbolic_free(S);
    gen_matrix_free(&B);
    free(D);
    free(E);
    free(new_of);
}

#endif
