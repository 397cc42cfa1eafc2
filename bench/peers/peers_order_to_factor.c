/* peers_order_to_factor.c: the time from the caller's matrix to a factor, ordering included */
#include <string.h>

#include "peers_steps.h"

/* Each library runs as a whole on the caller's matrix, with its own ordering, and releases what
 * it allocated: this library with its defaults, and for the purpose of one factor; CHOLMOD set to
 * METIS; CHOLMOD with nothing set, which tries AMD and perhaps METIS and chooses between a
 * supernodal and a simplicial factor; Eigen with AMD, its default. The last factors of CHOLMOD's
 * and Eigen's defaults are kept: later steps refactor them and solve with them. */

/* A simplicial factorization with more operations than max_flops_repeated is timed once; with more
 * than max_flops_amd, which is some seconds, not at all. */
static const double max_flops_repeated = 1e9, max_flops_amd = 1e10, max_flops_amd_full = 5e10;

static void ours_create(const comparison *cmp, sl_purpose purpose, sl_symbolic **S,
                        sl_factor **F) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.purpose = purpose;
    bench_must(sl_symbolic_create(S, &cmp->system->A, &opt, NULL), "analysis");
    bench_must(sl_factor_create(F, *S, &cmp->system->A, NULL, NULL), "factor");
}

static void ours_call(void *state) {
    sl_symbolic *S;
    sl_factor *F;
    ours_create(state, SL_PURPOSE_MANY_SOLVES, &S, &F);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

static void ours_one_factor_call(void *state) {
    sl_symbolic *S;
    sl_factor *F;
    ours_create(state, SL_PURPOSE_ONE_FACTOR, &S, &F);
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* The timed call releases the factor of the previous call, as ours releases its own. */
static void metis_call(void *state) {
    comparison *cmp = state;
    peer_cholmod_own_free(cmp->cholmod_metis);
    cmp->cholmod_metis = peer_cholmod_own_create(&cmp->system->A, PEER_CHOLMOD_METIS);
}

static void defaults_call(void *state) {
    comparison *cmp = state;
    peer_cholmod_own_free(cmp->cholmod_defaults);
    cmp->cholmod_defaults = peer_cholmod_own_create(&cmp->system->A, PEER_CHOLMOD_DEFAULTS);
}

static void eigen_call(void *state) {
    peer_eigen_amd_compute(((comparison *)state)->eigen_defaults);
}

/* Leaves cmp->eigen_defaults NULL where its factorization would take too long. */
static void create_eigen(const bench_run *run, comparison *cmp) {
    const double limit = run->size == BENCH_FULL ? max_flops_amd_full : max_flops_amd;
    if (cmp->system->stats.symbolic.flops < limit) {
        cmp->eigen_defaults = peer_eigen_amd_create(&cmp->system->A);
        cmp->eigen_defaults_flops = peer_eigen_amd_analyze(cmp->eigen_defaults);
        if (cmp->eigen_defaults_flops >= limit) {
            peer_eigen_amd_free(cmp->eigen_defaults);
            cmp->eigen_defaults = NULL;
        }
    }
}

/* Every factor that was timed solves a random system. */
static int check_factors(bench_run *run, comparison *cmp) {
    const bench_system *system = cmp->system;
    const size_t n = (size_t)system->n;
    uint64_t rng = 46;
    sl_symbolic *S;
    sl_factor *F;
    sl_stats stats;
    bench_random_fill(&rng, cmp->B, n);
    ours_create(cmp, SL_PURPOSE_ONE_FACTOR, &S, &F);
    stats.symbolic = sl_symbolic_view(S).info;
    cmp->one_factor_flops = stats.symbolic.flops;
    bench_must(sl_factor_solve(F, cmp->X, n, cmp->B, n, 1, NULL), "solve");
    sl_factor_free(F);
    sl_symbolic_free(S);
    int passed = bench_check_residual(run, system, cmp->X, cmp->B, 1, "ours, one factor");
    passed &=
        bench_check_residual(run, system, peer_cholmod_own_solve(cmp->cholmod_metis, cmp->B, 1),
                             cmp->B, 1, "CHOLMOD METIS");
    passed &=
        bench_check_residual(run, system, peer_cholmod_own_solve(cmp->cholmod_defaults, cmp->B, 1),
                             cmp->B, 1, "CHOLMOD defaults");
    if (cmp->eigen_defaults) {
        peer_eigen_amd_solve(cmp->eigen_defaults, cmp->X, cmp->B, 1);
        passed &= bench_check_residual(run, system, cmp->X, cmp->B, 1, "Eigen defaults");
    }
    return passed;
}

void peers_order_to_factor(bench_run *run, bench_report *report, comparison *cmp) {
    timed_row rows[5] = {{.method = "ours", .call = ours_call},
                         {.method = "ours, one factor", .call = ours_one_factor_call},
                         {.method = "CHOLMOD METIS", .call = metis_call, .is_peer = 1},
                         {.method = "CHOLMOD defaults", .call = defaults_call, .is_peer = 1},
                         {.method = "Eigen defaults", .call = eigen_call, .is_peer = 1}};
    create_eigen(run, cmp);
    const int count = cmp->eigen_defaults ? 5 : 4;
    if (cmp->eigen_defaults && cmp->eigen_defaults_flops >= max_flops_repeated) {
        rows[4].method = "Eigen defaults, once";
        rows[4].sample = peers_time_once(eigen_call, cmp);
    }
    for (int c = 0; c < count; c++) {
        rows[c].state = cmp;
    }
    /* Long enough for a second round where one factorization takes seconds: in the first round the
     * system hands out memory that no process has used before. */
    peers_time(6 * run->seconds, rows, count);
    if (check_factors(run, cmp)) {
        rows[0].flops = cmp->system->stats.symbolic.flops;
        rows[1].flops = cmp->one_factor_flops;
        rows[2].flops = peer_cholmod_own_flops(cmp->cholmod_metis);
        rows[3].flops = peer_cholmod_own_flops(cmp->cholmod_defaults);
        rows[4].flops = cmp->eigen_defaults_flops;
        peers_report(report, cmp, "order to factor", 0, rows, count, NULL, 0);
        bench_report_note(
            report,
            "%-14s   CHOLMOD's defaults chose %s, a %s factor, nnz(L) %.4g (METIS: "
            "%.4g)",
            "", peer_cholmod_own_ordering(cmp->cholmod_defaults),
            peer_cholmod_own_is_supernodal(cmp->cholmod_defaults) ? "supernodal" : "simplicial",
            peer_cholmod_own_nnz(cmp->cholmod_defaults), peer_cholmod_own_nnz(cmp->cholmod_metis));
    }
    peer_cholmod_own_free(cmp->cholmod_metis);
    cmp->cholmod_metis = NULL;
}
