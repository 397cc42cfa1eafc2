/* peers_factor.c: analysis, first factorization and refactorization against CHOLMOD and Eigen */
#include "peers_steps.h"

enum { MAX_REFACTOR_ROWS = 7 };

/* Limits of operations. A simplicial factorization is repeated below max_flops_repeated and
 * timed once above. CHOLMOD's is left out above max_flops_simplicial, where it would take as
 * long as everything else together; Eigen's, of the same kind, is a bit faster. */
static const double max_flops_repeated = 1e9, max_flops_simplicial = 5e9,
                    max_flops_simplicial_full = 5e10, min_flops_brief = 1e11;

/* ---- contenders ---- */

static void analyze_ready(void *state) {
    comparison *cmp = state;
    sl_symbolic_free(cmp->S);
    cmp->S = NULL;
}

static void analyze_call(void *state) {
    comparison *cmp = state;
    bench_must(sl_symbolic_create(&cmp->S, &cmp->system->A, &cmp->given, NULL), "analysis");
}

static void first_ready(void *state) {
    comparison *cmp = state;
    sl_factor_free(cmp->first);
    cmp->first = NULL;
}

static void first_call(void *state) {
    comparison *cmp = state;
    bench_must(sl_factor_create(&cmp->first, cmp->system->S, &cmp->system->A, NULL, NULL),
               "factor");
}

static void refactor_call(void *state) {
    comparison *cmp = state;
    bench_must(sl_factor_refactor(cmp->F, &cmp->system->A, NULL), "refactor");
}

static void refactor_avx2_call(void *state) {
    comparison *cmp = state;
    bench_must(sl_factor_refactor(cmp->avx2.F, &cmp->system->A, NULL), "refactor");
}

static void refactor_threaded_call(void *state) {
    comparison *cmp = state;
    bench_must(sl_factor_refactor(cmp->threaded, &cmp->system->A, NULL), "refactor");
}

static void cholmod_analyze_call(void *state) {
    peer_cholmod_analyze(((comparison *)state)->cholmod);
}

static void cholmod_first_ready(void *state) {
    peer_cholmod_first_ready(((comparison *)state)->cholmod);
}

static void cholmod_first_call(void *state) {
    peer_cholmod_first(((comparison *)state)->cholmod);
}

static void cholmod_factor_call(void *state) {
    peer_cholmod_factor(((comparison *)state)->cholmod);
}

static void cholmod_simplicial_call(void *state) {
    peer_cholmod_factor_simplicial(((comparison *)state)->cholmod);
}

static void cholmod_defaults_call(void *state) {
    peer_cholmod_own_factor(((comparison *)state)->cholmod_defaults);
}

static void eigen_defaults_call(void *state) {
    peer_eigen_amd_factor(((comparison *)state)->eigen_defaults);
}

static void eigen_factor_call(void *state) {
    peer_eigen_factor(((comparison *)state)->eigen);
}

/* ---- steps ---- */

/* Seconds for timing factorizations. Where one takes seconds, the warm-up is enough. */
static double race_seconds(const bench_run *run, const comparison *cmp) {
    return cmp->is_brief && cmp->system->stats.symbolic.flops > min_flops_brief ? 0.6 * run->seconds
                                                                                : 2 * run->seconds;
}

/* Solves with the factors that are refactored later: default, threaded, AVX2. */
static void check_factors(bench_run *run, const comparison *cmp) {
    const sl_factor *factors[3] = {cmp->F, cmp->threaded, cmp->avx2.F};
    const size_t n = (size_t)cmp->system->n;
    uint64_t rng = 44;
    bench_random_fill(&rng, cmp->B, n);
    for (int k = 0; k < 3; k++) {
        if (factors[k]) {
            bench_must(sl_factor_solve(factors[k], cmp->X, n, cmp->B, n, 1, cmp->W), "full solve");
            bench_check_residual(run, cmp->system, cmp->X, cmp->B, 1, "refactor");
        }
    }
}

static void analyze_steps(bench_run *run, bench_report *report, comparison *cmp) {
    timed_row rows[3] = {
        {.method = "ours, given order", .call = analyze_call, .ready = analyze_ready},
        {.method = "CHOLMOD supernodal", .call = cholmod_analyze_call, .is_peer = 1},
        {.method = "Eigen simplicial, once", .is_peer = 1}};
    for (int c = 0; c < 2; c++) {
        rows[c].state = cmp;
    }
    if (cmp->eigen) {
        rows[2].sample = peers_one_sample(cmp->eigen_analyze);
    }
    peers_race(run->seconds, report, cmp, "analyze", 0, rows, cmp->eigen ? 3 : 2, NULL, 0);
    bench_report_note(report, "%-14s   our first analysis: ordering %.3f s, the rest %.3f s", "",
                      cmp->system->stats.symbolic.seconds_order,
                      cmp->system->stats.symbolic.seconds_analyze);
    const bench_memory memory = bench_memory_of(cmp->system, cmp->given);
    bench_report_note(
        report,
        "%-14s   peak memory of analyze + factor: ours %.1f MB (%.2f of A and the panels), "
        "CHOLMOD %.1f MB",
        "", 1e-6 * memory.peak, memory.peak / (memory.matrix + memory.panels),
        1e-6 * peer_cholmod_peak(cmp->cholmod));
}

/* Adds simplicial factorizations over our permutation: repeated where they are fast, else timed
 * once. Returns the new count. */
static int add_simplicial(const bench_run *run, comparison *cmp, timed_row *rows, int count) {
    const double flops = cmp->system->stats.symbolic.flops;
    if (flops < (run->size == BENCH_FULL ? max_flops_simplicial_full : max_flops_simplicial)) {
        timed_row simplicial = {.method = "CHOLMOD simplicial", .call = cholmod_simplicial_call};
        if (flops >= max_flops_repeated) {
            simplicial.method = "CHOLMOD simplicial, once";
            simplicial.sample = peers_time_once(simplicial.call, cmp);
        }
        rows[count++] = simplicial;
    }
    if (cmp->eigen) {
        timed_row eigen = {.method = "Eigen simplicial", .call = eigen_factor_call};
        if (flops >= max_flops_repeated) {
            eigen.method = "Eigen simplicial, once";
            eigen.sample = peers_one_sample(cmp->eigen_first);
        }
        rows[count++] = eigen;
    }
    return count;
}

/* The peers over their own orderings, with the factors that the step "order to factor" left. */
static int add_defaults(comparison *cmp, timed_row *rows, int count) {
    rows[count++] = (timed_row){.method = "CHOLMOD defaults",
                                .call = cholmod_defaults_call,
                                .flops = peer_cholmod_own_flops(cmp->cholmod_defaults)};
    if (cmp->eigen_defaults) {
        timed_row eigen = {.method = "Eigen defaults",
                           .call = eigen_defaults_call,
                           .flops = cmp->eigen_defaults_flops};
        if (eigen.flops >= max_flops_repeated) {
            eigen.method = "Eigen defaults, once";
            eigen.sample = peers_time_once(eigen.call, cmp);
        }
        rows[count++] = eigen;
    }
    return count;
}

/* CHOLMOD with OpenBLAS on threads: over our permutation and, if that factor is supernodal and
 * the system not too large, over its own. */
static void refactor_threaded(bench_run *run, bench_report *report, comparison *cmp,
                              double baseline) {
    const double flops = cmp->system->stats.symbolic.flops;
    timed_row rows[3] = {
        {.method = "ours",
         .call = refactor_threaded_call,
         .ready = peers_wait_idle,
         .flops = flops},
        {.method = "CHOLMOD supernodal", .call = cholmod_factor_call, .is_peer = 1, .flops = flops},
        {.method = "CHOLMOD defaults",
         .call = cholmod_defaults_call,
         .is_peer = 1,
         .flops = peer_cholmod_own_flops(cmp->cholmod_defaults)}};
    const int has_defaults =
        !cmp->is_brief && peer_cholmod_own_is_supernodal(cmp->cholmod_defaults);
    const int count = has_defaults ? 3 : 2;
    for (int c = 0; c < count; c++) {
        rows[c].state = cmp;
        rows[c].threads = PEERS_THREADS;
    }
    peer_cholmod_threads(PEERS_THREADS);
    peers_race(run->seconds, report, cmp, "refactor", 0, rows, count, NULL, baseline);
    peer_cholmod_threads(1);
    peers_wait_idle(NULL);
}

static void refactor_steps(bench_run *run, bench_report *report, comparison *cmp) {
    timed_row rows[MAX_REFACTOR_ROWS] = {{.method = "ours", .call = refactor_call}};
    int ours = 1, count;
    if (cmp->avx2.F) {
        rows[ours++] = (timed_row){
            .method = "ours, AVX2 forced", .call = refactor_avx2_call, .isa = SL_ISA_AVX2};
    }
    rows[ours] = (timed_row){.method = "CHOLMOD supernodal", .call = cholmod_factor_call};
    count = add_simplicial(run, cmp, rows, ours + 1);
    count = add_defaults(cmp, rows, count);
    for (int c = 0; c < count; c++) {
        rows[c].state = cmp;
        rows[c].is_peer = c >= ours;
        rows[c].flops = rows[c].flops > 0 ? rows[c].flops : cmp->system->stats.symbolic.flops;
    }
    const double baseline =
        peers_race(race_seconds(run, cmp), report, cmp, "refactor", 0, rows, count, NULL, 0);
    refactor_threaded(run, report, cmp, baseline);
}

void peers_factor(bench_run *run, bench_report *report, comparison *cmp) {
    timed_row first[3] = {{.method = "ours", .call = first_call, .ready = first_ready},
                          {.method = "CHOLMOD supernodal",
                           .call = cholmod_first_call,
                           .ready = cholmod_first_ready,
                           .is_peer = 1},
                          {.method = "Eigen simplicial, once", .is_peer = 1}};
    check_factors(run, cmp);
    analyze_steps(run, report, cmp);
    for (int c = 0; c < 3; c++) {
        first[c].state = cmp;
        first[c].flops = cmp->system->stats.symbolic.flops;
    }
    if (cmp->eigen) {
        first[2].sample = peers_one_sample(cmp->eigen_first);
    }
    peers_race(race_seconds(run, cmp) / 2, report, cmp, "first factor", 0, first,
               cmp->eigen ? 3 : 2, NULL, 0);
    first_ready(cmp);
    refactor_steps(run, report, cmp);
}
