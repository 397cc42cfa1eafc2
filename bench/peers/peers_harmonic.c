/* peers_harmonic.c: how do k-harmonic systems compare with CHOLMOD and Eigen? */
#include "peers_steps.h"

enum { NRHS = 3, ORDERS = 3 };

void bench_peers_harmonic(bench_run *run) {
    const double vertices = run->size == BENCH_QUICK ? 1e4 : run->size == BENCH_DEFAULT ? 1e5 : 4e5;
    bench_report *report =
        bench_report_open(run, "peers_harmonic", "k-harmonic systems against CHOLMOD and Eigen",
                          "ours on one thread");
    for (int k = 1; k <= ORDERS; k++) {
        const bench_system *system = bench_k_harmonic(run, vertices, k);
        if (system) {
            comparison *cmp = comparison_create(run, system, NRHS);
            peers_order_to_factor(run, report, cmp);
            peers_factor(run, report, cmp);
            peers_solve(run, report, cmp, NRHS);
            bench_note_residual(report, system, cmp->answer, cmp->B, NRHS, "CHOLMOD");
            bench_must(sl_factor_solve(system->F, cmp->X, (size_t)system->n, cmp->B,
                                       (size_t)system->n, NRHS, cmp->W),
                       "full solve");
            bench_note_residual(report, system, cmp->X, cmp->B, NRHS, "ours");
            comparison_free(cmp);
        }
    }
    bench_report_close(report);
}
