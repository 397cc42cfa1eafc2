/* test_patch_solver.c: Poisson problems on patches by the mesh's factor, against other methods */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/surfaces.h"
#include "tests/lib/real_meshes.h"
#include "tests/lib/mesh_patch.h"

#include "tools/matrix/cg.h"
#include "tools/matrix/sparse_product.h"

/* Random right-hand sides that sum to 0. */
static double *random_flux(sl_int n, sl_int nrhs, uint64_t seed) {
    double *B = test_reals((size_t)n * (size_t)nrhs);
    gen_reals(B, (size_t)n * (size_t)nrhs, seed);
    for (sl_int c = 0; c < nrhs; c++) {
        double mean = 0;
        for (sl_int k = 0; k < n; k++) {
            mean += B[c * n + k] / n;
        }
        for (sl_int k = 0; k < n; k++) {
            B[c * n + k] -= mean;
        }
    }
    return B;
}

/* The paper's problem: the solution has the bits of the full solve and is harmonic inside, where
 * the rows of L are those of N. */
static void the_mesh_problem_equals_the_full_solve(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, torus_grid(30, 20));
    submesh p = grown_patch(&w, 100, 150);
    sl_int n = p.m.n_vertices, all = w.m.n_vertices;
    double *B = interface_flux(&p, 2), *X = test_reals(2 * (size_t)n);
    double *full = test_reals(2 * (size_t)all);
    patch_solver s = patch_solver_of(&w, &p);
    SL_CHECK(patch_solver_solve_mesh(&s, X, B, 2));
    for (sl_int v = 0; v < n; v++) {
        full[p.vertices[v]] = B[v];
        full[all + p.vertices[v]] = B[n + v];
    }
    SL_CHECK(sl_factor_solve(w.F, full, (size_t)all, full, (size_t)all, 2, NULL));
    for (sl_int v = 0; v < n; v++) {
        assert_true(X[v] == full[p.vertices[v]] && X[n + v] == full[all + p.vertices[v]]);
    }
    SL_CHECK(patch_solver_apply(&s, B, X, 2));
    for (sl_int k = 0; k < p.n_interface; k++) {
        B[p.interface[k]] = B[n + p.interface[k]] = 0;
    }
    assert_true(largest(B, 2 * (size_t)n) <= 1e-13 * largest(X, 2 * (size_t)n));
    patch_solver_free(&s);
    free(full);
    free(X);
    free(B);
    submesh_free(&p);
    mesh_factor_free(&w);
}

/* Solves N X = B by an analysis and a factorization of N. */
static void factor_and_solve(double *X, const sl_csc *N, const double *B, sl_int nrhs) {
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    sl_options opt = options_none();
    const size_t n = (size_t)N->n_cols;
    opt.pivots = SL_PIVOTS_SKIP_NULL;
    SL_CHECK(sl_symbolic_create(&S, N, NULL, NULL));
    SL_CHECK(sl_factor_create(&F, S, N, &opt, NULL));
    SL_CHECK(sl_factor_solve(F, X, n, B, n, nrhs, NULL));
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Solves the problem of the patch with the factor of the mesh, with a factor of its own, and by
 * conjugate gradients. */
static void assert_three_methods_agree(const submesh *p, patch_solver *s, int max_solves) {
    sl_int n = p->m.n_vertices;
    double *B = random_flux(n, 3, 9), *X = test_reals(3 * (size_t)n);
    double *Y = test_reals(3 * (size_t)n), *work = test_reals(4 * (size_t)n);
    const sl_csc N = sl_matrix_view(s->N);
    sl_matrix *both;
    int solves = max_solves;
    assert_true(csc_expand_symmetric(&both, &N));
    const sl_csc A = sl_matrix_view(both);
    SL_CHECK(patch_solver_solve_patch(s, X, B, 3, 1e-11, &solves));
    factor_and_solve(Y, &N, B, 3);
    assert_true(solves < max_solves);
    for (sl_int c = 0; c < 3; c++) {
        double size = largest(Y + c * n, (size_t)n);
        assert_true(largest_difference(X + c * n, Y + c * n, n) <= 1e-8 * size);
        (void)cg_jacobi(&A, X + c * n, B + c * n, 1e-12, 100000, work);
        assert_true(largest_difference(X + c * n, Y + c * n, n) <= 1e-7 * size);
    }
    sl_matrix_free(both);
    free(work);
    free(Y);
    free(X);
    free(B);
}

static void three_methods_agree_on_the_patch_problem(void **state) {
    (void)state;
    for (int which = 0; which < 3; which++) {
        mesh_factor_t w;
        mesh_factor_make(&w, which == 0   ? flat_grid(50, 0.2)
                             : which == 1 ? torus_grid(60, 40)
                                          : sphere_grid(50, 2));
        for (sl_int count = 4; count < w.m.n_vertices; count *= 4) {
            submesh p = grown_patch(&w, w.m.n_vertices / 2 + 25, count);
            patch_solver s = patch_solver_of(&w, &p);
            assert_three_methods_agree(&p, &s, 40);
            patch_solver_free(&s);
            submesh_free(&p);
        }
        mesh_factor_free(&w);
    }
}

/* Tolerances below rounding, where the right-hand side of a correction is only rounding, are not
 * refused. */
static void tolerances_below_rounding_work(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, flat_grid(60, 0));
    submesh p = grown_patch(&w, 1830, 300);
    sl_int n = p.m.n_vertices;
    patch_solver s = patch_solver_of(&w, &p);
    double *B = interface_flux(&p, 2), *X = test_reals(2 * (size_t)n);
    int solves = 60;
    SL_CHECK(patch_solver_solve_patch(&s, X, B, 2, 1e-10, &solves));
    assert_true(solves > 1 && solves < 60);
    solves = 60;
    SL_CHECK(patch_solver_solve_patch(&s, X, B, 2, 1e-18, &solves));
    assert_true(isfinite(largest(X, 2 * (size_t)n)));
    free(X);
    free(B);
    patch_solver_free(&s);
    submesh_free(&p);
    mesh_factor_free(&w);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    mesh_factor_t w;
    mesh_factor_make(&w, flat_grid(6, 0));
    submesh p = grown_patch(&w, 7, 10);
    patch_solver s = patch_solver_of(&w, &p);
    double X[50] = {0}, B[50] = {0};
    int solves = 3;
    SL_EXPECT(SL_ERR_ARGUMENT, patch_solver_solve_patch(&s, X, B, 5, 1e-10, &solves));
    assert_int_equal(solves, 0);
    solves = 3;
    SL_CHECK(patch_solver_solve_patch(&s, X, B, 0, 1e-10, &solves)); /* no right-hand side */
    solves = 3;
    SL_CHECK(patch_solver_solve_patch(&s, X, B, 2, 1e-10, &solves)); /* b = 0 */
    assert_int_equal(solves, 1);
    patch_solver_free(&s);
    p.vertices[3] = p.vertices[2];
    SL_EXPECT(SL_ERR_ARGUMENT, patch_solver_create(&s, w.S, w.F, &p));
    p.vertices[3] = 36;
    SL_EXPECT(SL_ERR_ARGUMENT, patch_solver_create(&s, w.S, w.F, &p));
    assert_null(s.patch_plan);
    submesh_free(&p);
    mesh_factor_free(&w);
}

/* A solve on a patch of one size reads the paths above it, a share of the factor that falls as the
 * mesh grows. */
static void the_share_of_the_factor_read_falls_with_the_mesh(void **state) {
    (void)state;
    double before = 1;
    for (sl_int side = 50; side <= 200; side *= 4) {
        mesh_factor_t w;
        mesh_factor_make(&w, flat_grid(side, 0));
        submesh p = grown_patch(&w, (side / 2) * side + side / 2, 300);
        patch_solver s = patch_solver_of(&w, &p);
        sl_stats all;
        all.symbolic = sl_symbolic_view(w.S).info;
        assert_true(p.m.n_vertices > 280 && p.m.n_vertices <= 300);
        double share = (double)s.stats.plan.x_entries / (double)all.symbolic.nnz_panels;
        print_message("%d x %d: %.3f of the factor\n", (int)side, (int)side, share);
        assert_true(s.stats.plan.b_entries == s.stats.plan.x_entries && share < 0.8 * before);
        before = share;
        patch_solver_free(&s);
        submesh_free(&p);
        mesh_factor_free(&w);
    }
}

/* The solution of the mesh's problem is finite, and the residual of the patch's problem is
 * small. */
static void check_mesh(const char *name, mesh m) {
    mesh_factor_t w;
    mesh_factor_make(&w, m);
    submesh p = grown_patch(&w, w.m.faces[0], 800);
    sl_int n = p.m.n_vertices;
    patch_solver s = patch_solver_of(&w, &p);
    double *B = random_flux(n, 2, 5), *X = test_reals(2 * (size_t)n);
    double *R = test_reals(2 * (size_t)n);
    int solves = 200;
    SL_CHECK(patch_solver_solve_mesh(&s, X, B, 2));
    assert_true(isfinite(largest(X, 2 * (size_t)n)));
    SL_CHECK(patch_solver_solve_patch(&s, X, B, 2, 1e-8, &solves));
    SL_CHECK(patch_solver_apply(&s, R, X, 2));
    for (sl_int i = 0; i < 2 * n; i++) {
        R[i] -= B[i];
    }
    double rest = largest(R, 2 * (size_t)n) / largest(B, 2 * (size_t)n);
    print_message("%s: %d solves, residual %.1e\n", name, solves, rest);
    assert_true(solves < 200 && rest <= 1e-6);
    free(R);
    free(X);
    free(B);
    patch_solver_free(&s);
    submesh_free(&p);
    mesh_factor_free(&w);
}

static void real_meshes_are_solved(void **state) {
    (void)state;
    each_mesh(NULL, 0, 60000, check_mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mesh_problem_equals_the_full_solve),
        cmocka_unit_test(three_methods_agree_on_the_patch_problem),
        cmocka_unit_test(tolerances_below_rounding_work),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(the_share_of_the_factor_read_falls_with_the_mesh),
        cmocka_unit_test(real_meshes_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
