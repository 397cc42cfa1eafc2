/* peers.c: how does each step compare with CHOLMOD and Eigen? */
#include <stdio.h>
#include <stdlib.h>

#include "peers_steps.h"

enum { MAX_SYSTEMS = 10 };

/* Vertices. On larger systems, 64 right-hand sides would not fit in memory. */
static const double max_n_64_rhs = 3e6;

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    static const sl_int counts[] = {1, 2, 3, 4, 8, 16, 64}, counts_brief[] = {1, 2, 3, 8, 64};
    const sl_int max_rhs = system->n > max_n_64_rhs ? 16 : PEERS_MAX_RHS;
    const double start = bench_now();
    comparison *cmp = comparison_create(run, system, max_rhs);
    const double created = bench_now();
    peers_order_to_factor(run, report, cmp);
    peers_factor(run, report, cmp);
    const double factored = bench_now();
    for (int k = 0; k < (cmp->is_brief ? 5 : 7); k++) {
        const sl_int nrhs = cmp->is_brief ? counts_brief[k] : counts[k];
        if (nrhs <= max_rhs) {
            peers_solve(run, report, cmp, nrhs);
        }
    }
    const double solved = bench_now();
    peers_local(run, report, cmp);
    peers_inverse(run, report, cmp);
    peers_change(run, report, cmp);
    comparison_free(cmp);
    bench_progress("[%s: created %.0f s, factor %.0f s, full solves %.0f s, local %.0f s]\n",
                   system->name, created - start, factored - created, solved - factored,
                   bench_now() - solved);
}

void bench_peers(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6, 4e6};
    static const sl_int sides[] = {40, 60};
    const bench_system *systems[MAX_SYSTEMS];
    const char *data = getenv("SL_DATA");
    int count = 0;
    if (!run->mesh_path && data && data[0]) {
        char path[512];
        snprintf(path, sizeof path, "%s/meshes/bunny.off.gz", data);
        systems[count] = bench_mesh(path);
        count += systems[count] != NULL;
    }
    count += bench_systems(run, wanted, run->size == BENCH_QUICK ? 1 : 4, systems + count);
    for (int k = 0; k < 2 && !run->mesh_path && run->size != BENCH_QUICK; k++) {
        systems[count++] = bench_volume(sides[k]);
    }
    bench_report *report = bench_report_open(
        run, "peers", "CHOLMOD and Eigen, in our permutation and with their defaults",
        "the first row of the step (refactor: on one thread)");
    printf("   OpenBLAS kernels for CHOLMOD: %s\n", peer_cholmod_kernels());
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}
