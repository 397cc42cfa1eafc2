/* sequence_objects.h: the calls of fuzz_sequence.c that need no model of their own: products,
 * matrices, views, copies, and the other ways to ask for what its calls have checked */
#ifndef SL_FUZZ_SEQUENCE_OBJECTS_H
#define SL_FUZZ_SEQUENCE_OBJECTS_H

#include "sequence_model.h"

/* Rounding of sums of up to MOST products, the largest of magnitude `size`. */
static void check_close(double x, double y, double size) {
    PROMISE(fabs(x - y) <= 1e-13 * size);
}

static void fill(input_t *in, double *X, int count) {
    for (int q = 0; q < count; q++) {
        X[q] = q < MOST ? take_eighths(in) : X[q - MOST] * 0.5 + 1.0;
    }
}

/* Right-hand sides by rows: the bits of the same by columns. */
static void solve_rows(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const sl_int nrhs = take(in) % (RHS + 1);
    double B[MOST * RHS], Bt[MOST * RHS], X[MOST * RHS];
    if (!f->F) {
        return;
    }
    fill(in, B, MOST * RHS);
    for (int q = 0; q < MOST * RHS; q++) {
        Bt[q] = B[q / RHS + MOST * (q % RHS)];
    }
    const sl_status rows = sl_factor_solve(f->F, Bt, SL_ROWS(RHS), Bt, SL_ROWS(RHS), nrhs, work);
    const sl_status columns = sl_factor_solve(f->F, X, MOST, B, MOST, nrhs, work);
    if (no_memory(rows) || no_memory(columns)) {
        return;
    }
    PROMISE(rows == columns);
    for (sl_int r = 0; rows == SL_OK && r < nrhs; r++) {
        for (sl_int i = 0; i < order_of(f); i++) {
            check_same(Bt[r + RHS * i], X[i + MOST * r]);
        }
    }
}

/* Products and residuals against those of the dense matrix. */
static void multiply(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const sl_int nrhs = take(in) % (RHS + 1);
    double X[MOST * RHS], Y[MOST * RHS], R[MOST * RHS], errors[RHS];
    if (!f->F || f->v.kind == WILD) {
        return;
    }
    const sl_int n = order_of(f);
    const sl_csc A = view(&analyses[f->analysis], f->v.x);
    const double size = MOST * largest(f->v.a, ENTRIES) * 256.0;
    fill(in, X, MOST * RHS);
    PROMISE(sl_csc_multiply(&A, SL_AS_SYMMETRIC, Y, MOST, X, MOST, nrhs) == SL_OK);
    PROMISE(sl_csc_residual(&A, R, MOST, errors, X, MOST, Y, MOST, nrhs) == SL_OK);
    for (sl_int r = 0; r < nrhs; r++) {
        for (sl_int i = 0; i < n; i++) {
            double sum = 0.0;
            for (sl_int j = 0; j < n; j++) {
                sum += f->v.a[i + MOST * j] * X[j + MOST * r];
            }
            check_close(Y[i + MOST * r], sum, size);
            check_close(R[i + MOST * r], 0.0, size);
        }
        PROMISE(errors[r] <= 1e-14);
    }
}

static void add_dense(const sl_matrix *M, double *a) {
    const sl_csc A = sl_matrix_view(M);
    PROMISE(sl_csc_check(&A, NULL) == SL_OK);
    for (sl_int j = 0; j < A.n_cols; j++) {
        for (sl_int q = A.p[j]; q < A.p[j + 1]; q++) {
            a[A.i[q] + MOST * j] += A.x[q];
        }
    }
}

/* The transpose, a sum, a permutation and the triplets of a matrix have the dense entries. */
static void build_matrices(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in) % 3;
    sl_matrix *M = NULL;
    sl_int perm[MOST], columns[ENTRIES];
    double a[ENTRIES] = {0.0};
    if (!f->F || f->v.kind == WILD) {
        return;
    }
    const sl_int n = order_of(f);
    const sl_csc A = view(&analyses[f->analysis], f->v.x), terms[2] = {A, A};
    const sl_options opt = options();
    sl_status status;
    for (sl_int j = 0; j < n; j++) {
        perm[j] = n - 1 - j;
        for (sl_int q = A.p[j]; q < A.p[j + 1]; q++) {
            columns[q] = j;
        }
    }
    if (form == 0) {
        static const double halves[2] = {0.25, 0.75};
        status = sl_matrix_sum(&M, halves, terms, 2, &opt, NULL);
    } else if (form == 1) {
        status = sl_matrix_submatrix(&M, &A, perm, A.n_cols, &opt, NULL);
    } else {
        status = sl_matrix_from_triplets(&M, n, n, A.p[n], A.i, columns, A.x, &opt, NULL);
    }
    PROMISE((M != NULL) == (status == SL_OK));
    PROMISE(status == SL_OK || no_memory(status));
    if (M) {
        add_dense(M, a);
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j < n; j++) {
                const double entry =
                    form == 1 ? f->v.a[perm[i] + MOST * perm[j]] : f->v.a[i + MOST * j];
                const double found = a[i + MOST * j] != 0.0 ? a[i + MOST * j] : a[j + MOST * i];
                check_close(found, entry, fabs(entry));
            }
        }
    }
    sl_matrix_free(M);
}

/* P A P' = L D L', and what objects say about themselves. */
static void look_into(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    sl_matrix *M = NULL;
    sl_stats stats;
    sl_int count = -1;
    double l[ENTRIES] = {0.0};
    if (!f->F) {
        return;
    }
    const sl_int n = order_of(f);
    const sl_options opt = options();
    const sl_symbolic_arrays s = sl_symbolic_view(analyses[f->analysis].S);
    const sl_factor_arrays arrays = sl_factor_view(f->F);
    const sl_status expected = f->is_valid ? SL_OK : SL_ERR_STALE;
    const sl_status status = sl_factor_lower(&M, f->F, &opt);
    PROMISE(s.n == n && arrays.symbolic == analyses[f->analysis].S);
    PROMISE(status == expected || no_memory(status));
    PROMISE(sl_factor_pivot_rows(f->F, SL_PIVOT_REGULARIZED, NULL, NULL, 0, &count) == expected);
    PROMISE(count == (f->is_valid ? 0 : -1));
    stats.symbolic = sl_symbolic_view(analyses[f->analysis].S).info;
    PROMISE(stats.symbolic.n == n && stats.symbolic.supernodes == s.n_supers);
    for (int k = 0; k < PLANS; k++) {
        sl_plan_stats(plans[k].P, &stats);
    }
    if (M && f->v.kind == DOMINANT) {
        const double coarser = f->is_float ? 1e7 : 1.0; /* L is rounded to float */
        add_dense(M, l);
        for (sl_int i = 0; i < n; i++) {
            for (sl_int j = 0; j <= i; j++) {
                double sum = 0.0, size = 0.0;
                for (sl_int k = 0; k <= j; k++) {
                    const double term = l[i + MOST * k] * arrays.D[k] * l[j + MOST * k];
                    sum += term;
                    size += fabs(term);
                }
                check_close(sum, f->v.a[s.perm[i] + MOST * s.perm[j]], coarser * size);
            }
        }
    }
    sl_matrix_free(M);
}

/* Entries of a selected inverse on the pattern of a column, above and below the diagonal. */
static void select_pairs(input_t *in) {
    const selected_t *z = &selected[take(in) % SELECTED];
    if (!z->Z) {
        return;
    }
    const sl_int n = analyses[z->analysis].n, column = n > 0 ? take(in) % n : 0;
    sl_int rows[MOST], columns[MOST], count = 0;
    double out[MOST], one[1];
    sl_stats stats;
    stats.selected = sl_selected_view(z->Z).info;
    const sl_selected_arrays v = sl_selected_view(z->Z);
    PROMISE(v.symbolic == analyses[z->analysis].S);
    for (sl_int i = 0; i < n; i++) {
        if (z->a[i + MOST * column] != 0.0) {
            rows[count] = i;
            columns[count++] = column;
        }
    }
    const sl_status status = sl_selected_entries(z->Z, out, rows, columns, count, &stats);
    PROMISE(status == SL_OK || status == SL_ERR_OTHER_PATTERN);
    for (sl_int k = 0; k < count; k++) { /* Z is symmetric, and stored once */
        const sl_status same = sl_selected_entries(z->Z, one, columns + k, rows + k, 1, NULL);
        PROMISE(status != SL_OK || same == SL_OK);
        if (status == SL_OK) {
            check_same(one[0], out[k]);
        }
    }
}

/* Refactorizations of selected inverses and regions allocate nothing in a workspace that has what
 * the first of them took. */
static void reserve_others(input_t *in) {
    const selected_t *z = &selected[take(in) % SELECTED];
    const region_t *r = &regions[take(in) % REGIONS];
    if (z->Z) {
        for (int k = 0; k < FACTORS; k++) {
            const factor_t *f = &factors[k];
            if (f->F && f->is_valid && f->analysis == z->analysis && f->is_float == z->is_float &&
                memcmp(f->v.a, z->a, sizeof z->a) == 0) {
                const sl_status status = sl_selected_refactor(z->Z, f->F, work);
                PROMISE(status == SL_OK || no_memory(status));
                if (status == SL_OK) {
                    left = 0;
                    has_failed = 0;
                    PROMISE(sl_selected_refactor(z->Z, f->F, work) == SL_OK && !has_failed);
                }
                break;
            }
        }
    }
    left = -1;
    if (r->R) {
        const factor_t *f = &factors[r->factor];
        const sl_region_arrays v = sl_region_view(r->R);
        sl_stats stats;
        stats.region = sl_region_view(r->R).info;
        PROMISE(v.symbolic == analyses[r->analysis].S && v.n_boundary == stats.region.boundary);
        if (f->F && f->is_valid && f->analysis == r->analysis &&
            memcmp(f->v.a, r->a, sizeof r->a) == 0 && !f->has_mass) {
            PROMISE(sl_region_refactor(r->R, f->F, NULL, work) == SL_OK);
            left = 0;
            has_failed = 0;
            PROMISE(sl_region_refactor(r->R, f->F, NULL, work) == SL_OK && !has_failed);
        }
    }
}

#endif
