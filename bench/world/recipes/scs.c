/* scs.c: programs of each kind whose linear systems SCS factors
 *
 *     program [PIXELS]
 *
 * PIXELS  the side of an image that is smoothed by its total variation, in 200 iterations
 */
#include "programs.h"
#include "report.h"
#include "scs.h"

/* Solves, and if `again` is a name once more with half of c, beginning with the solution. */
static void run(program w, const char *feature, const char *again, int iterations) {
    ScsMatrix A = {w.A.x, w.A.i, w.A.p, w.m, w.n}, P = {w.P.x, w.P.i, w.P.p, w.n, w.n};
    scs_int sizes[100];
    for (int k = 0; k < w.cones; k++) sizes[k] = w.cone_size;
    ScsCone cone = {0};
    cone.z = w.zero;
    cone.l = w.positive;
    cone.q = sizes;
    cone.qsize = w.cones;
    ScsData data = {0};
    data.m = w.m;
    data.n = w.n;
    data.A = &A;
    data.P = w.P.x[0] != 0 ? &P : NULL;
    data.b = w.b;
    data.c = w.c;
    ScsSettings settings;
    scs_set_default_settings(&settings);
    settings.verbose = 0;
    settings.eps_abs = settings.eps_rel = iterations ? 1e-15 : 1e-10;
    if (iterations) settings.max_iters = iterations;
    ScsSolution solution = {0};
    ScsInfo info = {0};
    const double begin = seconds();
    ScsWork *work = scs_init(&data, &cone, &settings);
    if (!work) exit(1);
    scs_solve(work, &solution, &info, 0);
    if (iterations) report_time(seconds() - begin);
    for (int j = 0; j < w.n; j++) report(feature, solution.x[j]);
    for (int i = 0; i < w.m; i++) report(feature, solution.y[i]);
    if (again) {
        for (int j = 0; j < w.n; j++) w.c[j] *= 0.5;
        scs_update(work, NULL, w.c);
        scs_solve(work, &solution, &info, 1);
        for (int j = 0; j < w.n; j++) report(again, solution.x[j]);
    }
    scs_finish(work);
    free(solution.x);
    free(solution.y);
    free(solution.s);
    program_free(&w);
}

int main(int argc, char **argv) {
    if (argc > 1) {
        run(smoothing(atoi(argv[1])), "size", NULL, 200);
        return 0;
    }
    run(random_program(60, 20, 120, 0, 0, 0), "linear", NULL, 0);
    run(random_program(60, 10, 100, 0, 0, 1), "quadratic", "warm_update", 0);
    /* L has long columns, which our QDLDL factors by supernodes */
    run(random_program(300, 50, 600, 0, 0, 1), "filled", "filled_again", 0);
    run(random_program(60, 5, 40, 10, 8, 0), "second_order", NULL, 0);
    run(random_program(60, 0, 20, 6, 15, 0.1), "second_order_quadratic", NULL, 0);
    return 0;
}
