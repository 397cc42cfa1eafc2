/* peers_harmonic.c: how do k-harmonic systems compare with CHOLMOD and Eigen, over the same permutation? */
#include "peers_steps.h"

enum { NRHS = 3, ORDERS = 3 };

void bench_peers_harmonic(bench_run *run) {
    const double vertices = run->size == BENCH_QUICK ? 1e4 : run->size == BENCH_DEFAULT ? 1e5 : 4e5;
    bench_report *report = bench_report_open(
        run, "peers_harmonic", "k-harmonic systems beside CHOLMOD and Eigen, same permutation",
        "ours on one thread");
    bench_machine_write(run, "peers_harmonic");
    for (int k = 1; k <= ORDERS; k++) {
        const bench_system *system = bench_k_harmonic(run, vertices, k);
        if (system) {
            match *m = match_create(run, system, NRHS);
            peers_factor(run, report, m);
            peers_solve(run, report, m, NRHS);
            bench_note_residual(report, system, m->answer, m->B, NRHS, "CHOLMOD");
            bench_must(sl_factor_solve(system->F, m->X, (size_t)system->n, m->B, (size_t)system->n,
                                       NRHS, m->W),
                       "full solve");
            bench_note_residual(report, system, m->X, m->B, NRHS, "ours");
            match_free(m);
        }
    }
    bench_report_close(report);
}
