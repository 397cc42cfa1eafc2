/* test_osqp.c: the linear-system solver for OSQP, called as OSQP calls it, against dense solves */
#include "tests/lib/dense_reference.h"
#include "tests/lib/gen_graphs.h"

/* OSQP's headers, which are osqp_interface.h here; the bodies of sparse_local.h are linked */
#define SL_OSQP_LINKED
#include "tools/adapters/sparse_local_osqp.c"

#include "osqp_programs.h"

char printed[300];

/* ---- memory ---- */

static counter_t memory;

void *c_malloc(size_t bytes) {
    return counter_allocate(&memory, bytes);
}

void *c_calloc(size_t count, size_t bytes) {
    void *block = counter_allocate(&memory, count * bytes);
    return block == NULL ? NULL : memset(block, 0, count * bytes);
}

void c_free(void *block) {
    if (block != NULL) {
        counter_release(&memory, block);
    }
}

/* ---- solvers ---- */

enum { RHO_VECTOR, RHO_NUMBER, POLISH };

static LinSysSolver *solver_make(const program_t *w, int kind, OSQPInt wanted) {
    qdldl_solver *s = NULL;
    const OSQPInt error = init_linsys_solver_sparse_local(
        &s, &w->P, &w->A, kind == RHO_VECTOR ? &w->rho : NULL, &w->settings, kind == POLISH);
    assert_int_equal(error, wanted);
    assert_true((s == NULL) == (wanted != OSQP_NO_ERROR));
    return (LinSysSolver *)(void *)s;
}

/* Diagonal of the constraints, positive. */
static double below(const program_t *w, int kind, sl_int k) {
    return kind == POLISH       ? (double)w->settings.sigma
           : kind == RHO_NUMBER ? 1.0 / (double)w->settings.rho
                                : 1.0 / (double)w->rho.x[k];
}

static double *kkt(const program_t *w, int kind) {
    const sl_int n = w->n + w->m;
    double *K = test_reals((size_t)n * (size_t)n);
    for (sl_int j = 0; j < w->n; j++) {
        AT(K, j, j) += (double)w->settings.sigma;
        for (OSQPInt p = w->P.p[j]; p < w->P.p[j + 1]; p++) {
            AT(K, w->P.i[p], j) += (double)w->P.x[p];
            AT(K, j, w->P.i[p]) = AT(K, w->P.i[p], j);
        }
        for (OSQPInt p = w->A.p[j]; p < w->A.p[j + 1]; p++) {
            AT(K, w->n + w->A.i[p], j) = AT(K, j, w->n + w->A.i[p]) = (double)w->A.x[p];
        }
    }
    for (sl_int k = 0; k < w->m; k++) {
        AT(K, w->n + k, w->n + k) = -below(w, kind, k);
    }
    return K;
}

/* The solver's answer to one right-hand side is that of a dense solve. */
static void answers_are_right(LinSysSolver *s, const program_t *w, int kind, uint64_t seed) {
    const sl_int n = w->n + w->m;
    const double bound = (sizeof(OSQPFloat) == 4 ? FLT_EPSILON : DBL_EPSILON) * 1e3 * (n + 1);
    double *K = kkt(w, kind), *wanted = test_reals((size_t)n);
    OSQPVectorf b = {floats((size_t)n)};
    const size_t calls = memory.calls;
    for (sl_int k = 0; k < n; k++) {
        wanted[k] = gen_real(&seed);
        b.x[k] = (OSQPFloat)wanted[k];
    }
    assert_int_equal(s->solve(s, &b, 1), 0);
    assert_true(memory.calls == calls);
    double *z = test_reals((size_t)n);
    memcpy(z, wanted, (size_t)n * sizeof *z);
    ref_solve(n, K, wanted, 1);
    for (sl_int k = 0; k < n; k++) {
        const double x =
            k < w->n || kind == POLISH ? wanted[k] : z[k] + below(w, kind, k - w->n) * wanted[k];
        assert_true(fabs((double)b.x[k] - x) <= bound * (1 + fabs(x)));
    }
    free(z);
    free(b.x);
    free(K);
    free(wanted);
}

static void begin(void) {
    memory = counter_make();
    printed[0] = 0;
}

static void end(void) {
    assert_true(memory.live_blocks == 0 && memory.damaged == 0);
}

static void solutions_are_right(void **state) {
    static const sl_int sizes[][2] = {{1, 0}, {1, 1}, {4, 7}, {30, 12}, {40, 90}};
    (void)state;
    for (int kind = RHO_VECTOR; kind <= POLISH; kind++) {
        for (int k = 0; k < 5; k++) {
            program_t w = program_make(sizes[k][0], sizes[k][1], 1 + (uint64_t)k);
            begin();
            LinSysSolver *s = solver_make(&w, kind, OSQP_NO_ERROR);
            assert_string_equal(s->name(s), "sparse_local");
            assert_int_equal(s->type, OSQP_DIRECT_SOLVER);
            assert_int_equal(s->nthreads, 1);
            s->warm_start(s, NULL);
            s->update_settings(s, &w.settings);
            answers_are_right(s, &w, kind, 5);
            answers_are_right(s, &w, kind, 6);
            s->free(s);
            end();
            program_free(&w);
        }
    }
}

static void updates_follow(void **state) {
    uint64_t rng = 3;
    OSQPInt P_index[] = {2, 0}, A_index[] = {1, 4, 3};
    (void)state;
    for (int kind = RHO_VECTOR; kind <= RHO_NUMBER; kind++) {
        program_t w = program_make(20, 25, 8);
        begin();
        LinSysSolver *s = solver_make(&w, kind, OSQP_NO_ERROR);
        const size_t calls = memory.calls;
        new_rho(&w, &rng);
        w.settings.rho = 2;
        assert_int_equal(s->update_rho_vec(s, kind == RHO_VECTOR ? &w.rho : NULL, w.settings.rho),
                         0);
        answers_are_right(s, &w, kind, 5);
        for (int k = 0; k < 3; k++) {
            w.A.x[A_index[k]] = (OSQPFloat)gen_real(&rng);
        }
        assert_int_equal(s->update_matrices(s, &w.P, NULL, 0, &w.A, A_index, 3), 0);
        answers_are_right(s, &w, kind, 6);
        for (OSQPInt p = 0; p < w.P.p[w.n]; p++) {
            w.P.x[p] *= 2;
        }
        for (OSQPInt p = 0; p < w.A.p[w.n]; p++) {
            w.A.x[p] *= (OSQPFloat)1.5;
        }
        assert_int_equal(s->update_matrices(s, &w.P, NULL, w.P.p[w.n], &w.A, NULL, w.A.p[w.n]), 0);
        answers_are_right(s, &w, kind, 7);
        w.P.x[P_index[0]] *= (OSQPFloat)0.5;
        w.P.x[P_index[1]] *= (OSQPFloat)0.5;
        assert_int_equal(s->update_matrices(s, &w.P, P_index, 2, &w.A, NULL, 0), 0);
        answers_are_right(s, &w, kind, 8);
        assert_true(memory.calls == calls);
        s->free(s);
        end();
        program_free(&w);
    }
}

/* P = p in one entry, with a constraint. */
static program_t small_program(double p) {
    program_t w = program_make(1, 1, 1);
    matrix_free(&w.P);
    matrix_free(&w.A);
    for (int k = 0; k < 2; k++) {
        OSQPMatrix *M = k == 0 ? &w.P : &w.A;
        M->m = M->n = 1;
        M->p = (OSQPInt *)test_array(2, sizeof(OSQPInt));
        M->i = (OSQPInt *)test_array(1, sizeof(OSQPInt));
        M->x = floats(1);
        M->p[1] = 1;
        M->x[0] = (OSQPFloat)(k == 0 ? p : 1.0);
    }
    return w;
}

static void convexity_is_judged(void **state) {
    /* negative with sigma, null with sigma, not a number */
    static const double values[] = {-1.0, -0.25, NAN};
    (void)state;
    for (int k = 0; k < 3; k++) {
        const OSQPInt wanted = k < 2 ? OSQP_NONCVX_ERROR : OSQP_LINSYS_SOLVER_INIT_ERROR;
        program_t w = small_program(values[k]), good = small_program(1.0);
        OSQPVectorf b = {floats(2)};
        w.A.x[0] = good.A.x[0] = 0; /* otherwise the null pivot comes second */
        begin();
        assert_null(solver_make(&w, RHO_VECTOR, wanted));
        assert_non_null(strstr(printed, k < 2 ? "non-convex" : "not finite"));
        end();
        LinSysSolver *s = solver_make(&good, RHO_VECTOR, OSQP_NO_ERROR);
        assert_int_equal(s->update_matrices(s, &w.P, NULL, 1, &w.A, NULL, 1), 1);
        assert_int_equal(s->solve(s, &b, 1), k > 0); /* k = 0: K has a factor all the same */
        assert_int_equal(s->update_matrices(s, &good.P, NULL, 1, &good.A, NULL, 1), 0);
        answers_are_right(s, &good, RHO_VECTOR, 5);
        good.rho.x[0] = (OSQPFloat)NAN;
        assert_int_equal(s->update_rho_vec(s, &good.rho, 1), 1);
        s->free(s);
        end();
        free(b.x);
        program_free(&w);
        program_free(&good);
    }
}

/* Iterations that diverge go on: x is written. */
static void right_hand_sides_may_be_infinite(void **state) {
    program_t w = small_program(1.0);
    OSQPVectorf b = {floats(2)};
    (void)state;
    begin();
    LinSysSolver *s = solver_make(&w, RHO_VECTOR, OSQP_NO_ERROR);
    b.x[0] = (OSQPFloat)INFINITY;
    assert_int_equal(s->solve(s, &b, 1), 0);
    assert_true(!isfinite(b.x[0]));
    s->free(s);
    end();
    free(b.x);
    program_free(&w);
}

static void allocations_may_fail(void **state) {
    program_t w = program_make(12, 17, 4);
    qdldl_solver *s = NULL;
    int64_t k = 0;
    (void)state;
    for (; s == NULL; k++) {
        begin();
        memory.fail_at = k;
        const OSQPInt error =
            init_linsys_solver_sparse_local(&s, &w.P, &w.A, &w.rho, &w.settings, 0);
        assert_int_equal(error, s == NULL ? OSQP_MEM_ALLOC_ERROR : OSQP_NO_ERROR);
        assert_true(s != NULL || memory.live_blocks == 0);
    }
    assert_true(k > 5);
    ((LinSysSolver *)(void *)s)->free((LinSysSolver *)(void *)s);
    end();
    program_free(&w);
}

static void large_matrices_are_refused(void **state) {
    program_t w = small_program(1.0);
    (void)state;
    begin();
    w.P.p[1] = INT32_MAX;
    assert_null(solver_make(&w, RHO_VECTOR, OSQP_LINSYS_SOLVER_INIT_ERROR));
    assert_non_null(strstr(printed, "2^31"));
    end();
    program_free(&w);
}

/* ---- generated code ---- */

struct qdldl {
    int is_in_use;
};

static struct qdldl theirs;
static OSQPInt init_error, written;
static LinSysSolver *seen;

OSQPInt init_linsys_solver_qdldl(qdldl_solver **s, const OSQPMatrix *P, const OSQPMatrix *A,
                                 const OSQPVectorf *rho_vec, const OSQPSettings *settings,
                                 OSQPInt polishing) {
    assert_true(P != NULL && A != NULL && rho_vec != NULL && settings != NULL && !polishing);
    theirs.is_in_use = init_error == 0;
    *s = init_error == 0 ? &theirs : NULL;
    return init_error;
}

void free_linsys_solver_qdldl(qdldl_solver *s) {
    if (s != NULL) {
        s->is_in_use = 0;
    }
}

OSQPInt codegen_src(const char *folder, const char *prefix, OSQPSolver *solver, OSQPInt embedded) {
    assert_string_equal(folder, "folder");
    assert_string_equal(prefix, "prefix");
    seen = solver->work->linsys_solver;
    return embedded;
}

static void generated_code_has_qdldl(void **state) {
    program_t w = small_program(1.0);
    LinSysSolver ours;
    OSQPData data = {&w.P, &w.A};
    OSQPWorkspace work = {&data, &ours, &w.rho};
    OSQPSolver solver = {&w.settings, &work};
    (void)state;
    written = codegen_src_sparse_local("folder", "prefix", &solver, 2);
    assert_true(written == 2 && (void *)seen == (void *)&theirs && !theirs.is_in_use);
    assert_true(work.linsys_solver == &ours);
    data.P = NULL; /* OSQP refuses it */
    assert_true(codegen_src_sparse_local("folder", "prefix", &solver, 1) == 1 && seen == NULL);
    data.P = &w.P;
    init_error = OSQP_NONCVX_ERROR;
    assert_int_equal(codegen_src_sparse_local("folder", "prefix", &solver, 2), OSQP_NONCVX_ERROR);
    assert_true(work.linsys_solver == &ours);
    program_free(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_are_right),
        cmocka_unit_test(updates_follow),
        cmocka_unit_test(convexity_is_judged),
        cmocka_unit_test(right_hand_sides_may_be_infinite),
        cmocka_unit_test(allocations_may_fail),
        cmocka_unit_test(large_matrices_are_refused),
        cmocka_unit_test(generated_code_has_qdldl),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
