/* uses.c: a use of each call, in at most three lines, as the manual shows it under the contract
 *
 * A line with the name of a call begins its use. A is an n x n matrix, S its analysis, F its
 * factor; B and X are blocks of right-hand sides and solutions; ok ends the program if a call
 * fails. */
#define SL_WITH_ALL
#include "example.h"

static const sl_int n = N;
static sl_csc A;
static sl_symbolic *S;
static sl_factor *F;
static sl_stats stats;
static double B[3 * N], X[3 * N], R[3 * N];
static const sl_int rows[3] = {5, 6, 820}, other[3] = {6, 5, 820}; /* 5 and 6 are neighbors */
static const double one = 1.0;

static void use_matrices(void) {
    sl_matrix *M = NULL, *part = NULL;
    sl_triangle triangle;
    sl_status status;
    char text[300];
    /* ---- sl_matrix_from_triplets ---- */
    const sl_int i[] = {0, 1, 1}, j[] = {0, 0, 1}; /* [2 -1; -1 2]: the lower triangle */
    const double x[] = {2, -1, 2};
    ok(sl_matrix_from_triplets(&M, 2, 2, 3, i, j, x, NULL, NULL));
    /* ---- end ---- */
    sl_matrix_free(M);
    /* ---- sl_matrix_submatrix ---- */
    ok(sl_matrix_submatrix(&part, &A, rows, 3, NULL, NULL)); /* 3 x 3: row k is rows[k] of A */
    /* ---- sl_matrix_view ---- */
    const sl_csc view = sl_matrix_view(part); /* valid until part is freed */
    /* ---- sl_matrix_free ---- */
    sl_matrix_free(part);
    /* ---- sl_csc_check ---- */
    status = sl_csc_check(&A, &stats); /* stats.error.row and .column: the first bad entry */
    /* ---- sl_error_text ---- */
    if (status != SL_OK) sl_error_text(text, sizeof text, status, &stats);
    /* ---- sl_status_string ---- */
    printf("%s\n", sl_status_string(status));
    /* ---- sl_csc_triangle ---- */
    ok(sl_csc_triangle(&A, &triangle, NULL, NULL)); /* here SL_TRIANGLE_LOWER */
    /* ---- sl_csc_multiply ---- */
    ok(sl_csc_multiply(&A, SL_AS_SYMMETRIC, X, n, B, n, 1)); /* X = A B */
    /* ---- end ---- */
    if (view.n_rows != 3 || triangle != SL_TRIANGLE_LOWER) exit(1);
}

static void use_files(void) {
    const int64_t p64[] = {0, 1, 2}, i64[] = {0, 1};
    const double x[] = {1, 2};
    sl_matrix *M = NULL, *parsed = NULL, *narrow = NULL;
    FILE *file = fopen("uses.mtx", "w");
    if (file == NULL) exit(1);
    fprintf(file, "%%%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1\n2 2 4\n");
    fclose(file);
    /* ---- sl_matrix_read ---- */
    ok(sl_matrix_read(&M, "uses.mtx", NULL, &stats)); /* on error stats.error.line */
    /* ---- sl_matrix_parse ---- */
    const char text[] = "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 4\n";
    ok(sl_matrix_parse(&parsed, text, sizeof text - 1, NULL, NULL));
    /* ---- sl_matrix_from_csc64 ---- */
    const sl_csc64 wide = {2, 2, p64, i64, x};
    ok(sl_matrix_from_csc64(&narrow, &wide, NULL, NULL));
    /* ---- end ---- */
    sl_matrix_free(M);
    sl_matrix_free(parsed);
    sl_matrix_free(narrow);
    remove("uses.mtx");
}

static void use_factor(void) {
    sl_matrix *L = NULL;
    double log_abs_det, sign, error;
    sl_int null_rows[8], count;
    /* ---- sl_symbolic_create ---- */
    ok(sl_symbolic_create(&S, &A, NULL, &stats)); /* once per pattern */
    printf("%ld entries of L\n", (long)stats.symbolic.nnz_l);
    /* ---- sl_factor_create ---- */
    ok(sl_factor_create(&F, S, &A, NULL, &stats)); /* once per matrix */
    printf("growth %g\n", stats.factor.growth);
    /* ---- sl_factor_refactor ---- */
    ok(sl_factor_refactor(F, &A, NULL)); /* A.x has new values; plans of S stay valid */
    /* ---- sl_factor_solve ---- */
    ok(sl_factor_solve(F, X, n, B, n, 3, NULL)); /* three columns of n numbers */
    /* ---- sl_csc_residual ---- */
    ok(sl_csc_residual(&A, R, n, &error, X, n, B, n, 1)); /* error is about 1e-16 */
    /* ---- sl_factor_pivot_rows ---- */
    ok(sl_factor_pivot_rows(F, SL_PIVOT_NULL, null_rows, NULL, 8, &count));
    /* ---- sl_factor_logdet ---- */
    ok(sl_factor_logdet(F, &log_abs_det, &sign)); /* det A = sign exp(log_abs_det) */
    /* ---- sl_factor_lower ---- */
    ok(sl_factor_lower(&L, F, NULL));
    printf("%d numbers of L\n", (int)sl_matrix_view(L).p[n]);
    /* ---- sl_factor_view ---- */
    const double first_pivot = sl_factor_view(F).D[0];
    /* ---- sl_symbolic_view ---- */
    const sl_int first_row = sl_symbolic_view(S).perm[0]; /* the row of A that is pivot 0 */
    /* ---- end ---- */
    sl_matrix_free(L);
    if (count != 0 || first_pivot <= 0 || first_row < 0 || error > 1e-14) exit(1);
}

static void use_workspaces(void) {
    sl_work *trial = NULL, *W = NULL;
    /* ---- sl_work_create ---- */
    ok(sl_work_create(&W, NULL)); /* one for each thread */
    /* ---- end ---- */
    ok(sl_work_create(&trial, NULL));
    /* ---- sl_work_reserve ---- */
    ok(sl_factor_solve(F, X, n, B, n, 3, trial)); /* the largest call that W is for */
    ok(sl_work_reserve(W, sl_work_bytes(trial))); /* from now on it allocates nothing */
    /* ---- end ---- */
    sl_work_free(trial);
    sl_work_free(W);
}

static void use_plans(void) {
    sl_plan *P = NULL, *in_region = NULL;
    sl_region *region = NULL;
    sl_options opt = {0};
    double x[3];
    /* ---- sl_plan_create ---- */
    ok(sl_plan_create(&P, S, rows, 1, other, 3, NULL, NULL)); /* b in 1 row, x in 3 */
    /* ---- sl_plan_solve ---- */
    ok(sl_plan_solve(P, F, x, 3, &one, 1, 1, NULL)); /* any number of times */
    /* ---- sl_plan_stats ---- */
    sl_plan_stats(P, &stats);
    printf("%d columns of L\n", (int)stats.plan.b_columns);
    /* ---- sl_local_solve ---- */
    ok(sl_local_solve(F, rows, 1, other, 3, x, 3, &one, 1, 1, NULL, NULL)); /* the same once */
    /* ---- sl_region_create ---- */
    ok(sl_region_create(&region, F, rows, 2, NULL, NULL, NULL));
    opt.region = region;
    ok(sl_plan_create(&in_region, S, rows, 1, other, 2, &opt, NULL));
    /* ---- sl_region_refactor ---- */
    ok(sl_factor_refactor(F, &A, NULL));
    ok(sl_region_refactor(region, F, NULL, NULL)); /* in_region is valid again */
    /* ---- end ---- */
    sl_plan_free(P);
    sl_plan_free(in_region);
    sl_region_free(region);
}

static void use_accuracy(void) {
    sl_plan *P = NULL, *Q = NULL;
    sl_int both[N + 1], m;
    double rcond, x[3], bounds[3], scales[4 * 3 + 2] = {0.0}, f[N + 1] = {1}, z[N + 1];
    both[0] = rows[0];
    /* ---- sl_factor_refine ---- */
    ok(sl_factor_refine(F, &A, X, n, B, n, 3, 2, NULL, &stats)); /* at most 2 steps */
    printf("backward error %.1e\n", stats.refine.backward_error);
    /* ---- sl_factor_rcond ---- */
    ok(sl_factor_rcond(F, &A, &rcond, NULL));
    printf("about %d correct digits\n", (int)(15.6 + log10(rcond)));
    /* ---- sl_factor_certify ---- */
    ok(sl_factor_certify(F, &A, SL_ESTIMATED, NULL, &stats)); /* stats.certificate.eta */
    /* ---- end ---- */
    ok(sl_plan_create(&P, S, rows, 1, other, 3, NULL, NULL));
    /* ---- sl_plan_solve_bounded ---- */
    ok(sl_plan_solve_bounded(P, F, x, 3, bounds, &one, 1, 1, scales, NULL, NULL));
    printf("x = %g +- %.1e\n", x[0], bounds[0]);
    /* ---- sl_plan_solve_regularized ---- */
    ok(sl_factor_pivot_rows(F, SL_PIVOT_REGULARIZED, both + 1, NULL, N, &m)); /* after both[0] */
    ok(sl_plan_create(&Q, S, both, m + 1, both, m + 1, NULL, NULL));
    ok(sl_plan_solve_regularized(Q, F, z, N + 1, f, N + 1, 1, 2, NULL, &stats)); /* f[0], z[0] */
    /* ---- end ---- */
    ok(sl_local_solve(F, rows, 1, rows, 1, x, 1, &one, 1, 1, NULL, NULL));
    sl_plan_free(Q);
    sl_plan_free(P);
    if (m != 0 || fabs(z[0] - x[0]) > 1e-12) exit(1);
}

static void use_parts(void) {
    sl_plan *P = NULL;
    sl_int columns[N], count;
    /* ---- sl_factor_solve_part ---- */
    const unsigned forward = SL_PART_P | SL_PART_L;
    ok(sl_factor_solve_part(F, NULL, forward, R, n, B, n, 3, NULL)); /* R = L^-1 P B */
    /* ---- sl_factor_multiply_part ---- */
    ok(sl_factor_multiply_part(F, SL_PART_L | SL_PART_PT, X, n, R, n, 3, NULL)); /* B again */
    /* ---- end ---- */
    ok(sl_plan_create(&P, S, rows, 1, other, 3, NULL, NULL));
    /* ---- sl_plan_columns ---- */
    ok(sl_plan_columns(P, SL_PART_L, columns, N, &count)); /* those of the forward sweep */
    /* ---- end ---- */
    sl_plan_free(P);
}

static void use_null_spaces(void) {
    sl_matrix *M = grid_laplacian(0.0);
    const sl_csc L = sl_matrix_view(M);
    sl_factor *G = NULL;
    sl_options opt = {0};
    static sl_int component[N];
    static double Q[N], K[N];
    double defect;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    ok(sl_factor_create(&G, S, &L, &opt, NULL));
    /* ---- sl_factor_defects ---- */
    ok(sl_factor_defects(G, &defect, 1, B, n, 1, NULL)); /* of a Laplacian: the sum of b */
    /* ---- sl_factor_pseudo_inverse ---- */
    sl_pseudo_inverse null_space = {1, component, Q, K, 0.0}; /* room for one null vector */
    ok(sl_factor_pseudo_inverse(G, &null_space, NULL));
    /* ---- end ---- */
    sl_factor_free(G);
    sl_matrix_free(M);
}

static void use_inverse(void) {
    sl_selected *Z = NULL;
    double z[9];
    /* ---- sl_inverse_diagonal ---- */
    ok(sl_inverse_diagonal(F, X, NULL, SL_ALL, NULL, NULL)); /* n variances */
    /* ---- sl_inverse_pairs ---- */
    ok(sl_inverse_pairs(F, z, rows, other, 3, NULL, NULL)); /* (5, 6), (6, 5), (820, 820) */
    /* ---- sl_inverse_block ---- */
    ok(sl_inverse_block(F, z, 3, rows, 3, rows, 3, NULL, NULL)); /* 3 x 3 */
    /* ---- sl_selected_create ---- */
    ok(sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL));
    /* ---- sl_selected_entries ---- */
    ok(sl_selected_entries(Z, z, rows, other, 3, NULL)); /* 5 and 6 are neighbors in A */
    /* ---- sl_selected_refactor ---- */
    ok(sl_selected_refactor(Z, F, NULL)); /* after F has changed */
    /* ---- end ---- */
    sl_selected_free(Z);
}

static void use_changes(void) {
    sl_factor *G = NULL;
    sl_symbolic *T = NULL;
    /* ---- sl_factor_rank_update ---- */
    const sl_int p[] = {0, 2}, i[] = {5, 6};
    const double v[] = {1, -1}; /* the edge between rows 5 and 6 becomes stiffer by 1 */
    const sl_csc V = {N, 1, p, i, v};
    /* ---- end ---- */
    ok(sl_factor_rank_update(F, &V, NULL, NULL, NULL));
    /* ---- sl_factor_change_entries ---- */
    const double deltas[] = {2.0, 0.0, 0.5}; /* A.x has the new values already */
    ok(sl_factor_change_entries(F, &A, rows, rows, deltas, 3, NULL, &stats));
    /* ---- end ---- */
    ok(sl_factor_refactor(F, &A, NULL));
    /* ---- sl_factor_submatrix ---- */
    ok(sl_factor_submatrix(&T, &G, F, &A, rows, 3, NULL, NULL)); /* the factor of 3 x 3 */
    /* ---- end ---- */
    sl_factor_free(G);
    sl_symbolic_free(T);
}

static void use_edits(void) {
    sl_matrix *M = NULL;
    sl_symbolic *T = NULL;
    sl_factor *G = NULL;
    static sl_int kept[N], new_of[N];
    for (sl_int k = 0; k < N; k++)
        kept[k] = k, new_of[k] = k < N - 1 ? k : -1;
    ok(sl_matrix_submatrix(&M, &A, kept, N - 1, NULL, NULL)); /* the last row goes */
    const sl_csc edited = sl_matrix_view(M);
    /* ---- sl_symbolic_edit ---- */
    ok(sl_symbolic_edit(&T, S, &A, &edited, new_of, NULL, NULL)); /* new_of[i]: -1 if i is gone */
    /* ---- sl_factor_edit ---- */
    ok(sl_factor_edit(&G, F, T, &edited, new_of, NULL, &stats)); /* stats.reuse */
    /* ---- end ---- */
    sl_factor_free(G);
    sl_symbolic_free(T);
    sl_matrix_free(M);
}

static void use_given_values(void) {
    sl_fixed *D = NULL;
    sl_constraints *P = NULL;
    const double g[3] = {0.0, 1.0, 2.0};
    const sl_int last = 2;
    /* ---- sl_fixed_create ---- */
    ok(sl_fixed_create(&D, &A, rows, 3, NULL, NULL)); /* no factor of A is needed */
    /* ---- sl_fixed_solve ---- */
    ok(sl_fixed_solve(D, X, n, NULL, 0, g, 3, 1, NULL)); /* b = 0, x(rows) = g */
    /* ---- sl_fixed_refactor ---- */
    ok(sl_fixed_refactor(D, &A, NULL)); /* A.x has new values */
    /* ---- sl_fixed_view ---- */
    const sl_int free_rows = sl_fixed_view(D).n_free;
    /* ---- sl_constraints_create ---- */
    ok(sl_constraints_create(&P, F, NULL));
    /* ---- sl_constraints_add ---- */
    ok(sl_constraints_add(P, rows, NULL, 3, NULL)); /* three pins */
    /* ---- sl_constraints_solve ---- */
    ok(sl_constraints_solve(P, NULL, X, n, B, n, g, 3, 1, NULL)); /* x(rows) = g */
    /* ---- sl_constraints_release ---- */
    ok(sl_constraints_release(P, &last, 1, NULL)); /* the pin with the number 2 */
    /* ---- sl_constraints_refactor ---- */
    ok(sl_factor_refactor(F, &A, NULL));
    ok(sl_constraints_refactor(P, NULL));
    /* ---- end ---- */
    if (free_rows != N - 3) exit(1);
    sl_constraints_free(P);
    sl_fixed_free(D);
}

static void use_batches(void) {
    sl_matrix *U = NULL;
    sl_factor *G[2] = {NULL, NULL};
    static double m[4 * N];
    /* ---- sl_batch_solve ---- */
    const sl_request two[2] = {{NULL, X, N, B, N, 1, NULL}, {NULL, X + N, N, B + N, N, 1, NULL}};
    ok(sl_batch_solve(F, two, 2, NULL, NULL, NULL)); /* options.threads distribute them */
    /* ---- sl_matrix_sum ---- */
    const double weights[] = {1.0, 0.5};
    const sl_csc terms[] = {A, A};
    ok(sl_matrix_sum(&U, weights, terms, 2, NULL, NULL)); /* A + A / 2 */
    /* ---- sl_symbolic_scatter ---- */
    ok(sl_symbolic_scatter(S, m, &A, NULL)); /* m has stats.symbolic.nnz_a numbers */
    /* ---- sl_factor_create_sums ---- */
    const double *const values[] = {m}, scales[] = {1.0, 2.0};
    ok(sl_factor_create_sums(G, 2, S, scales, values, 1, NULL, NULL, NULL)); /* of A and 2 A */
    /* ---- sl_factor_refactor_sums ---- */
    ok(sl_factor_refactor_sums(G, 2, scales, values, 1, NULL, NULL, NULL));
    /* ---- end ---- */
    sl_factor_free(G[0]);
    sl_factor_free(G[1]);
    sl_matrix_free(U);
}

static void use_saved(void) {
    sl_saved_set set = {0}, got = {0};
    set.symbolic = S;
    set.factor = F;
    /* ---- sl_save ---- */
    ok(sl_save("uses.slf", NULL, NULL, &set, NULL)); /* set.symbolic = S, set.factor = F */
    /* ---- sl_load ---- */
    ok(sl_load(&got, "uses.slf", NULL, 0, SL_LOAD_MAPPED, NULL));
    ok(sl_factor_solve(got.factor, X, n, B, n, 1, NULL));
    /* ---- sl_saved_set_free ---- */
    sl_saved_set_free(&got);
    /* ---- end ---- */
    remove("uses.slf");
}

static void use_other_kinds(void) {
    const sl_int p[] = {0, 2, 3}, i[] = {0, 1, 1}, source = 0;
    const double h[] = {2, 0, 0, -1, 2, 0}, k[] = {0, 1, 0};
    const sl_csc indefinite = {2, 2, p, i, k};
    double log_abs_det, sign;
    sl_matrix *M = NULL;
    sl_symbolic *T = NULL;
    sl_factor *G = NULL;
    sl_plan *P = NULL;
    /* ---- sl_symbolic_create_pivoted ---- */
    ok(sl_symbolic_create_pivoted(&T, &indefinite, NULL, NULL)); /* [0 1; 1 0]; reads values */
    ok(sl_factor_create(&G, T, &indefinite, NULL, NULL));
    /* ---- end ---- */
    sl_factor_free(G);
    sl_symbolic_free(T);
    /* ---- sl_matrix_from_hermitian ---- */
    const sl_hermitian H = {2, p, i, h, NULL};        /* [2 i; -i 2] */
    ok(sl_matrix_from_hermitian(&M, &H, NULL, NULL)); /* 4 x 4, real */
    /* ---- end ---- */
    const sl_csc real = sl_matrix_view(M);
    ok(sl_symbolic_create(&T, &real, NULL, NULL));
    ok(sl_factor_create(&G, T, &real, NULL, NULL));
    /* ---- sl_complex_plan_create ---- */
    ok(sl_complex_plan_create(&P, T, &source, 1, NULL, SL_ALL, NULL, NULL)); /* complex rows */
    /* ---- sl_complex_logdet ---- */
    ok(sl_complex_logdet(G, &log_abs_det, &sign)); /* det H = 3 */
    /* ---- end ---- */
    sl_plan_free(P);
    sl_factor_free(G);
    sl_symbolic_free(T);
    sl_matrix_free(M);
}

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    sl_options opt;
    /* ---- sl_options_init ---- */
    sl_options_init(&opt, sizeof opt); /* all defaults; the same as sl_options opt = {0} */
    /* ---- sl_version ---- */
    if (sl_version() < 10000) return 1; /* older than 1.0.0 */
    /* ---- sl_stats_size ---- */
    if (sl_stats_size() != sizeof(sl_stats)) return 1; /* another version of the library */
    /* ---- end ---- */
    A = sl_matrix_view(M);
    for (int k = 0; k < 3 * N; k++)
        B[k] = sin(k);
    use_matrices();
    use_files();
    use_factor();
    use_workspaces();
    use_plans();
    use_accuracy();
    use_parts();
    use_null_spaces();
    use_inverse();
    use_changes();
    use_edits();
    use_given_values();
    use_batches();
    use_saved();
    use_other_kinds();
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return 0;
}
