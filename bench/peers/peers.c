/* peers.c: how does each step compare with CHOLMOD and Eigen, over the same permutation? */
#include <stdio.h>
#include <stdlib.h>

#include "peers_steps.h"

/* Repetitions of a step go round ours and theirs in turn. */
enum { MAX_SYSTEMS = 10 };

static const double large = 3e6; /* vertices: so many right-hand sides at once would not fit */

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    static const sl_int counts[] = {1, 2, 3, 4, 8, 16, 64}, counts_brief[] = {1, 2, 3, 8, 64};
    const sl_int most = system->n > large ? 16 : PEERS_MOST_RHS;
    const double start = bench_now();
    match *m = match_create(run, system, most);
    const double created = bench_now();
    peers_setup(run, report, m);
    peers_factor(run, report, m);
    const double factored = bench_now();
    for (int k = 0; k < (m->is_brief ? 5 : 7); k++) {
        const sl_int nrhs = m->is_brief ? counts_brief[k] : counts[k];
        if (nrhs <= most) {
            peers_solve(run, report, m, nrhs);
        }
    }
    const double solved = bench_now();
    peers_local(run, report, m);
    peers_inverse(run, report, m);
    match_free(m);
    bench_progress("[%s: made ready %.0f s, factor %.0f s, full solves %.0f s, local %.0f s]\n",
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
    bench_report *report =
        bench_report_open(run, "peers", "beside CHOLMOD and Eigen, same permutation",
                          "ours (factoring: on one thread)");
    bench_machine_write(run, "peers");
    printf("   OpenBLAS kernels for CHOLMOD: %s\n", peer_cholmod_kernels());
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    bench_report_close(report);
}
