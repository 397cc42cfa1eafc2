/* osqp.c: programs whose KKT systems OSQP factors, and every way to change one
 *
 *     program [PIXELS]
 *
 * PIXELS  the side of an image that is smoothed by its total variation, in 500 iterations
 */
#include "osqp.h"
#include "programs.h"
#include "report.h"

static OSQPCscMatrix *take(const columns *w, int rows, int count) {
    const int entries = w->p[count];
    OSQPInt *p = calloc((size_t)count + 1, sizeof *p), *i = calloc((size_t)entries + 1, sizeof *i);
    OSQPFloat *x = calloc((size_t)entries + 1, sizeof *x);
    for (int j = 0; j <= count; j++) p[j] = w->p[j];
    for (int k = 0; k < entries; k++) i[k] = w->i[k], x[k] = w->x[k];
    return OSQPCscMatrix_new(rows, count, entries, x, i, p);
}

static void release(OSQPCscMatrix *w) {
    free(w->p);
    free(w->i);
    free(w->x);
    OSQPCscMatrix_free(w);
}

static void solution(const char *feature, OSQPSolver *solver, const program *w) {
    for (int j = 0; j < w->n; j++) report(feature, solver->solution->x[j]);
    for (int i = 0; i < w->m; i++) report(feature, solver->solution->y[i]);
}

/* The name of a feature of this program. */
static const char *named(const char *name, const char *what) {
    static char text[100];
    snprintf(text, sizeof text, "%s_%s", name, what);
    return text;
}

static void run(program w, const char *name, int iterations) {
    OSQPCscMatrix *P = take(&w.P, w.n, w.n), *A = take(&w.A, w.m, w.n);
    OSQPFloat *l = calloc((size_t)w.m, sizeof *l);
    for (int i = 0; i < w.m; i++) l[i] = i < w.zero ? w.b[i] : -OSQP_INFTY;
    OSQPSettings settings;
    osqp_set_default_settings(&settings);
    settings.verbose = 0;
    /* not by time: the same in each run */
    settings.adaptive_rho = OSQP_ADAPTIVE_RHO_UPDATE_ITERATIONS;
    settings.adaptive_rho_interval = 50;
    /* a linear program ends anywhere within eps if rounding decides when rho changes */
    if (w.P.x[0] == 0) settings.adaptive_rho = OSQP_ADAPTIVE_RHO_UPDATE_DISABLED;
    settings.eps_abs = settings.eps_rel = iterations ? 1e-15 : 1e-10;
    settings.max_iter = iterations ? iterations : 20000;
    settings.polishing = !iterations;
    OSQPSolver *solver;
    const double begin = seconds();
    if (osqp_setup(&solver, P, w.c, A, l, w.b, w.m, w.n, &settings)) exit(1);
    osqp_solve(solver);
    if (iterations) {
        report_time(seconds() - begin);
        solution(name, solver, &w);
    } else {
        solution(named(name, "solve"), solver, &w);
        for (int j = 0; j < w.n; j++) w.c[j] *= 0.5;
        osqp_update_data_vec(solver, w.c, NULL, NULL);
        osqp_solve(solver);
        solution(named(name, "vectors"), solver, &w);
        for (int k = 0; k < P->p[w.n]; k++) P->x[k] *= 1.5;
        for (int k = 0; k < A->p[w.n]; k++) A->x[k] *= 0.75;
        osqp_update_data_mat(solver, P->x, NULL, P->p[w.n], A->x, NULL, A->p[w.n]);
        osqp_solve(solver);
        solution(named(name, "matrices"), solver, &w);
        osqp_update_rho(solver, 0.7);
        osqp_cold_start(solver);
        osqp_solve(solver);
        solution(named(name, "rho"), solver, &w);
    }
    osqp_cleanup(solver);
    release(P);
    release(A);
    free(l);
    program_free(&w);
}

/* Narrow intervals for more rows than there are columns: the certificate. */
static void infeasible(void) {
    program w = random_program(40, 10, 60, 0, 0, 1);
    OSQPCscMatrix *P = take(&w.P, w.n, w.n), *A = take(&w.A, w.m, w.n);
    OSQPFloat *l = calloc((size_t)w.m, sizeof *l);
    for (int i = 0; i < w.m; i++) l[i] = i < w.zero ? w.b[i] : -0.5;
    for (int i = w.zero; i < w.m; i++) w.b[i] = -0.25;
    OSQPSettings settings;
    osqp_set_default_settings(&settings);
    settings.verbose = 0;
    settings.adaptive_rho = OSQP_ADAPTIVE_RHO_UPDATE_DISABLED;
    OSQPSolver *solver;
    if (osqp_setup(&solver, P, w.c, A, l, w.b, w.m, w.n, &settings)) exit(1);
    osqp_solve(solver);
    report("infeasible", solver->info->status_val == OSQP_PRIMAL_INFEASIBLE);
    for (int i = 0; i < w.m; i++) report("infeasible", solver->solution->prim_inf_cert[i]);
    osqp_cleanup(solver);
    release(P);
    release(A);
    free(l);
    program_free(&w);
}

int main(int argc, char **argv) {
    if (argc > 1) {
        run(smoothing(atoi(argv[1])), "size", 500);
        return 0;
    }
    run(random_program(60, 20, 120, 0, 0, 0), "linear", 0);
    run(random_program(60, 10, 100, 0, 0, 1), "quadratic", 0);
    run(random_program(300, 50, 600, 0, 0, 1), "filled", 0);
    infeasible();
    return 0;
}
