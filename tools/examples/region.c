/* region.c: a region: local solves at a cost that does not depend on the rest of the matrix */
#define SL_WITH_INVERSE
#include "example.h"

int main(void) {
    sl_matrix *M = grid_laplacian(0.1);
    const sl_csc A = sl_matrix_view(M);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_int patch[100], k;
    double inside, outside;
    const double one = 1.0;
    sl_region *R = NULL;
    sl_plan *near = NULL, *far = NULL;
    sl_options opt;
    sl_stats stats;
    for (k = 0; k < 100; k++) {
        patch[k] = (15 + k / 10) * SIDE + 15 + k % 10;
    }
    ok(sl_symbolic_create(&S, &A, NULL, NULL));
    ok(sl_factor_create(&F, S, &A, NULL, NULL));
    /* ---- region ---- */
    ok(sl_region_create(&R, F, patch, 100, NULL, NULL, NULL));
    sl_options_init(&opt, sizeof opt);
    opt.region = R;
    ok(sl_plan_create(&near, S, patch, 1, patch + 99, 1, &opt, &stats));
    /* ---- end ---- */
    ok(sl_plan_create(&far, S, patch, 1, patch + 99, 1, NULL, NULL));
    ok(sl_plan_solve(near, F, &inside, 1, &one, 1, 1, NULL));
    ok(sl_plan_solve(far, F, &outside, 1, &one, 1, 1, NULL));
    printf("%.15f in the region, %.15f without it\n", inside, outside);
    sl_plan_free(near);
    sl_plan_free(far);
    sl_region_free(R);
    sl_factor_free(F);
    sl_symbolic_free(S);
    sl_matrix_free(M);
    return !(stats.plan.in_region && fabs(inside - outside) < 1e-13 * outside);
}
