/* client.c: a program that gives the library its structs and reads those of the library; compiled
 * with one header and linked with the library of another (make abi) */
#if !defined(SL_WITH_ALL)
#define SL_WITH_ALL
#endif
#include ABI_HEADER
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Ends the program if something is not so. */
static void holds(int is_so, int line) {
    if (!is_so) {
        fprintf(stderr, "client.c:%d does not hold\n", line);
        exit(1);
    }
}
#define HOLDS(condition) holds(condition, __LINE__)

enum { N = 40 };
static sl_int p[N + 1], i[2 * N];
static double x[2 * N];

/* A path of N vertices: tridiag(-1, 2.5, -1), its lower triangle. */
static sl_csc path(void) {
    sl_csc A;
    sl_int k, q = 0;
    for (k = 0; k < N; k++) {
        p[k] = q;
        i[q] = k;
        x[q++] = 2.5;
        if (k + 1 < N) {
            i[q] = k + 1;
            x[q++] = -1;
        }
    }
    p[N] = q;
    A.n_rows = A.n_cols = N;
    A.p = p;
    A.i = i;
    A.x = x;
    return A;
}

/* What is saved and loaded solves with the same bits. */
static void saved(sl_symbolic *S, sl_factor *F, const double *b, const double *full) {
    sl_saved_set set, got;
    double y[N];
    size_t bytes = 0;
    void *memory;
    memset(&set, 0, sizeof set);
    memset(&got, 0, sizeof got);
    set.symbolic = S;
    set.factor = F;
    HOLDS(sl_save(NULL, NULL, &bytes, &set, NULL) == SL_OK);
    memory = malloc(bytes);
    HOLDS(memory != NULL && sl_save(NULL, memory, &bytes, &set, NULL) == SL_OK);
    HOLDS(sl_load(&got, NULL, memory, bytes, SL_LOAD_VERIFIED, NULL) == SL_OK);
    HOLDS(got.factor != NULL && got.n_regions == 0);
    HOLDS(sl_factor_solve(got.factor, y, N, b, N, 1, NULL) == SL_OK);
    HOLDS(memcmp(y, full, sizeof y) == 0);
    sl_saved_set_free(&got);
    free(memory);
}

/* Local solves, a batch, entries of the inverse, pins, a change, and fixed rows. */
static void packs(const sl_csc *A, sl_symbolic *S, sl_factor *F, const double *b,
                  const double *full) {
    const sl_int bset[] = {3, 20}, xset[] = {21}, fixed[] = {0, N - 1};
    const double sides[] = {1, 2}, values[] = {1, -1}, delta = 0.5;
    double one = 0, again = 0, z = 0, y[N], error[1];
    sl_plan *P = NULL;
    sl_constraints *pins = NULL;
    sl_fixed *D = NULL;
    sl_request request;
    sl_stats stats;
    HOLDS(sl_plan_create(&P, S, bset, 2, xset, 1, NULL, &stats) == SL_OK);
    HOLDS(stats.plan.b_columns > 0 && stats.plan.in_region == 0 && stats.error.row == -1);
    HOLDS(sl_plan_solve(P, F, &one, 1, sides, 2, 1, NULL) == SL_OK);
    memset(&request, 0, sizeof request);
    request.plan = P;
    request.X = &again;
    request.ldx = 1;
    request.B = sides;
    request.ldb = 2;
    request.nrhs = 1;
    HOLDS(sl_batch_solve(F, &request, 1, NULL, NULL, NULL) == SL_OK && again == one);
    HOLDS(sl_inverse_pairs(F, &z, xset, bset, 1, NULL, &stats) == SL_OK);
    HOLDS(stats.inverse.method != SL_INVERSE_NONE && z > 0);
    HOLDS(sl_constraints_create(&pins, F, NULL) == SL_OK);
    HOLDS(sl_constraints_add(pins, fixed, NULL, 2, &stats) == SL_OK &&
          stats.constraints.count == 2);
    HOLDS(sl_constraints_solve(pins, NULL, y, N, b, N, values, 2, 1, NULL) == SL_OK);
    HOLDS(fabs(y[0] - 1) < 1e-12 && fabs(y[N - 1] + 1) < 1e-12);
    HOLDS(sl_fixed_create(&D, A, fixed, 2, NULL, &stats) == SL_OK);
    HOLDS(sl_fixed_view(D).n_free == N - 2 && stats.fixed.n_free == N - 2);
    HOLDS(sl_factor_change_entries(F, NULL, xset, xset, &delta, 1, NULL, &stats) == SL_OK);
    HOLDS(stats.change.method == SL_CHANGE_UPDATE && stats.factor.positive == N);
    HOLDS(sl_factor_refactor(F, A, &stats) == SL_OK);
    memcpy(y, full, sizeof y);
    HOLDS(sl_factor_refine(F, A, y, N, b, N, 1, 2, NULL, &stats) == SL_OK);
    HOLDS(stats.refine.backward_error < 1e-14);
    HOLDS(sl_csc_residual(A, y, N, error, full, N, b, N, 1) == SL_OK && error[0] < 1e-14);
    sl_fixed_free(D);
    sl_constraints_free(pins);
    sl_plan_free(P);
}

int main(void) {
    sl_options options;
    sl_stats stats;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    double b[N], full[N], logarithm = 0, sign = 0;
    char text[200];
    sl_csc A = path();
    sl_int k;
    for (k = 0; k < N; k++)
        b[k] = k % 3 - 1;
    HOLDS(sl_stats_size() == sizeof stats);
    memset(&options, 1, sizeof options); /* what the library does not set would be noticed */
    sl_options_init(&options, sizeof options);
    options.purpose = SL_PURPOSE_ONE_FACTOR;
    options.ordering = SL_ORDERING_MINDEG;
    options.pivots = SL_PIVOTS_POSITIVE;
    options.growth_limit = 10;
    HOLDS(sl_symbolic_create(&S, &A, &options, &stats) == SL_OK);
    HOLDS(stats.symbolic.n == N && stats.symbolic.triangle == SL_TRIANGLE_LOWER);
    HOLDS(sl_symbolic_view(S).n == N && sl_symbolic_view(S).perm != NULL);
    HOLDS(sl_factor_create(&F, S, &A, &options, &stats) == SL_OK);
    HOLDS(stats.factor.positive == N && stats.factor.pivot_min > 0 && stats.factor.threads == 1);
    HOLDS(sl_factor_view(F).symbolic == S && sl_factor_view(F).D != NULL);
    HOLDS(sl_factor_logdet(F, &logarithm, &sign) == SL_OK && sign == 1);
    HOLDS(sl_factor_solve(F, full, N, b, N, 1, NULL) == SL_OK);
    saved(S, F, b, full);
    packs(&A, S, F, b, full);
    x[0] = -4;
    HOLDS(sl_factor_refactor(F, &A, &stats) == SL_ERR_PIVOT);
    HOLDS(stats.error.row >= 0 && stats.error.what != NULL);
    HOLDS(sl_error_text(text, sizeof text, SL_ERR_PIVOT, &stats) > 20);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return 0;
}
