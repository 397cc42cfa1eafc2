/* peers_setup.c: the time to the first solution: our order, analysis and factorization beside METIS and CHOLMOD's */
#include <stdlib.h>

#include "peers_steps.h"

#include <metis.h>

/* CHOLMOD analyses and factors the permuted matrix that both are given elsewhere; the order itself, which it does not
 * make here, is METIS_NodeND's time on the same graph. */

static void ours_call(void *state) {
    match *m = state;
    sl_symbolic *S;
    sl_factor *F;
    bench_must(sl_symbolic_create(&S, &m->system->A, NULL, NULL), "analysis");
    bench_must(sl_factor_create(&F, S, &m->system->A, NULL, NULL), "factor");
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void metis_order(const adjacency *g) {
    const size_t n = (size_t)g->n, edges = (size_t)g->begin[g->n];
    idx_t *begin = bench_alloc(n + 1, sizeof *begin), *to = bench_alloc(edges + 1, sizeof *to),
          *perm = bench_alloc(n, sizeof *perm), *iperm = bench_alloc(n, sizeof *iperm);
    idx_t rows = (idx_t)n;
    for (size_t k = 0; k <= n; k++) {
        begin[k] = (idx_t)g->begin[k];
    }
    for (size_t e = 0; e < edges; e++) {
        to[e] = g->neighbour[e];
    }
    if (METIS_NodeND(&rows, begin, to, NULL, NULL, perm, iperm) != METIS_OK) {
        bench_must(SL_ERR_ORDERING, "METIS");
    }
    free(begin);
    free(to);
    free(perm);
    free(iperm);
}

static void cholmod_ready(void *state) {
    peer_cholmod_first_ready(((match *)state)->cholmod);
}

static void cholmod_call(void *state) {
    match *m = state;
    metis_order(&m->system->graph);
    peer_cholmod_analyse(m->cholmod);
    peer_cholmod_first(m->cholmod);
}

void peers_setup(bench_run *run, bench_report *report, match *m) {
    entry entries[2] = {{.method = "ours", .call = ours_call},
                        {.method = "METIS + CHOLMOD supernodal",
                         .call = cholmod_call,
                         .ready = cholmod_ready,
                         .foreign = 1}};
    for (int c = 0; c < 2; c++) {
        entries[c].state = m;
        entries[c].flops = m->system->stats.flops;
    }
    /* patient enough for a second round where one takes seconds: the first meets memory that no process has had */
    peers_race(4 * run->seconds, report, m, "order to factor", 0, entries, 2, NULL, 0);
}
