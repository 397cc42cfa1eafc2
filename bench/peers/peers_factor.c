/* peers_factor.c: analysis and factorization beside CHOLMOD's and Eigen's, on one thread and on two */
#include "peers_steps.h"

/* What a simplicial factorization can repeat; beyond that it is timed once, CHOLMOD's only where it does not take as
 * long as all else together: Eigen's, of the same kind, is a bit faster. */
static const double few_flops = 1e9, most_flops_simple = 5e9, most_flops_simple_full = 5e10,
                    many_flops = 1e11;

/* ---- contenders ---- */

static void analyse_ready(void *state) {
    match *m = state;
    sl_symbolic_free(m->S);
    m->S = NULL;
}

static void analyse_call(void *state) {
    match *m = state;
    bench_must(sl_symbolic_create(&m->S, &m->system->A, &m->given, NULL), "analysis");
}

static void first_ready(void *state) {
    match *m = state;
    sl_factor_free(m->first);
    m->first = NULL;
}

static void first_call(void *state) {
    match *m = state;
    bench_must(sl_factor_create(&m->first, m->system->S, &m->system->A, NULL, NULL), "factor");
}

static void refactor_call(void *state) {
    match *m = state;
    bench_must(sl_factor_refactor(m->F, &m->system->A, NULL), "refactor");
}

static void refactor_narrow_call(void *state) {
    match *m = state;
    bench_must(sl_factor_refactor(m->narrow.F, &m->system->A, NULL), "refactor");
}

static void refactor_threaded_call(void *state) {
    match *m = state;
    bench_must(sl_factor_refactor(m->threaded, &m->system->A, NULL), "refactor");
}

static void cholmod_analyse_call(void *state) {
    peer_cholmod_analyse(((match *)state)->cholmod);
}

static void cholmod_first_ready(void *state) {
    peer_cholmod_first_ready(((match *)state)->cholmod);
}

static void cholmod_first_call(void *state) {
    peer_cholmod_first(((match *)state)->cholmod);
}

static void cholmod_factor_call(void *state) {
    peer_cholmod_factor(((match *)state)->cholmod);
}

static void cholmod_simple_call(void *state) {
    peer_cholmod_factor_simple(((match *)state)->cholmod);
}

static void eigen_factor_call(void *state) {
    peer_eigen_factor(((match *)state)->eigen);
}

/* ---- steps ---- */

/* Seconds for a race of factorizations; where one takes seconds, its warm-up will do. */
static double patience(const bench_run *run, const match *m) {
    return m->is_brief && m->system->stats.flops > many_flops ? 0.6 * run->seconds
                                                              : 2 * run->seconds;
}

static bench_sample one_time(double seconds) {
    bench_sample sample = {1, seconds, seconds, seconds};
    return sample;
}

/* The narrow factor and the one on threads solve as well as the first. */
static void check_factors(bench_run *run, const match *m) {
    const sl_factor *factors[3] = {m->F, m->threaded, m->narrow.F};
    const size_t n = (size_t)m->system->n;
    uint64_t chance = 44;
    bench_random_fill(&chance, m->B, n);
    for (int k = 0; k < 3; k++) {
        if (factors[k]) {
            bench_must(sl_factor_solve(factors[k], m->X, n, m->B, n, 1, m->W), "full solve");
            bench_check_residual(run, m->system, m->X, m->B, 1, "refactor");
        }
    }
}

static void analyse_steps(bench_run *run, bench_report *report, match *m) {
    entry entries[3] = {
        {.method = "ours, given order", .call = analyse_call, .ready = analyse_ready},
        {.method = "CHOLMOD supernodal", .call = cholmod_analyse_call, .foreign = 1},
        {.method = "Eigen simplicial, once", .foreign = 1}};
    for (int c = 0; c < 2; c++) {
        entries[c].state = m;
    }
    if (m->eigen) {
        entries[2].sample = one_time(m->eigen_analyse);
    }
    peers_race(run->seconds, report, m, "analyse", 0, entries, m->eigen ? 3 : 2, NULL, 0);
    bench_report_note(report, "%-14s   our first analysis: order %.3f s, all else %.3f s", "",
                      m->system->stats.seconds_order, m->system->stats.seconds_analyse);
    const bench_memory memory = bench_memory_of(m->system, m->given);
    bench_report_note(
        report,
        "%-14s   peak memory of analyse + factor: ours %.1f MB (%.2f of A and the panels), "
        "CHOLMOD %.1f MB",
        "", 1e-6 * memory.peak, memory.peak / (memory.matrix + memory.panels),
        1e-6 * peer_cholmod_peak(m->cholmod));
}

/* Simplicial ones: raced where they are quick, else one time. */
static int add_simplicial(const bench_run *run, match *m, entry *entries, int count) {
    const double flops = m->system->stats.flops;
    if (flops < (run->size == BENCH_FULL ? most_flops_simple_full : most_flops_simple)) {
        entry simple = {.method = "CHOLMOD simplicial", .call = cholmod_simple_call};
        if (flops >= few_flops) {
            const double start = bench_now();
            simple.call(m);
            simple.method = "CHOLMOD simplicial, once";
            simple.sample = one_time(bench_now() - start);
        }
        entries[count++] = simple;
    }
    if (m->eigen) {
        entry eigen = {.method = "Eigen simplicial", .call = eigen_factor_call};
        if (flops >= few_flops) {
            eigen.method = "Eigen simplicial, once";
            eigen.sample = one_time(m->eigen_first);
        }
        entries[count++] = eigen;
    }
    return count;
}

static void refactor_steps(bench_run *run, bench_report *report, match *m) {
    entry entries[5] = {{.method = "ours", .call = refactor_call}};
    int ours = 1, count;
    if (m->narrow.F) {
        entries[ours++] = (entry){
            .method = "ours, AVX2 forced", .call = refactor_narrow_call, .isa = SL_ISA_AVX2};
    }
    entries[ours] = (entry){.method = "CHOLMOD supernodal", .call = cholmod_factor_call};
    count = add_simplicial(run, m, entries, ours + 1);
    for (int c = 0; c < count; c++) {
        entries[c].state = m;
        entries[c].foreign = c >= ours;
        entries[c].flops = m->system->stats.flops;
    }
    const double baseline =
        peers_race(patience(run, m), report, m, "refactor", 0, entries, count, NULL, 0);
    entry both[2] = {{.method = "ours", .call = refactor_threaded_call, .ready = peers_nap},
                     {.method = "CHOLMOD supernodal", .call = cholmod_factor_call, .foreign = 1}};
    for (int c = 0; c < 2; c++) {
        both[c].state = m;
        both[c].threads = PEERS_THREADS;
        both[c].flops = m->system->stats.flops;
    }
    peer_cholmod_threads(PEERS_THREADS);
    peers_race(run->seconds, report, m, "refactor", 0, both, 2, NULL, baseline);
    peer_cholmod_threads(1);
    peers_nap(NULL);
}

void peers_factor(bench_run *run, bench_report *report, match *m) {
    entry first[3] = {{.method = "ours", .call = first_call, .ready = first_ready},
                      {.method = "CHOLMOD supernodal",
                       .call = cholmod_first_call,
                       .ready = cholmod_first_ready,
                       .foreign = 1},
                      {.method = "Eigen simplicial, once", .foreign = 1}};
    check_factors(run, m);
    analyse_steps(run, report, m);
    for (int c = 0; c < 3; c++) {
        first[c].state = m;
        first[c].flops = m->system->stats.flops;
    }
    if (m->eigen) {
        first[2].sample = one_time(m->eigen_first);
    }
    peers_race(patience(run, m) / 2, report, m, "first factor", 0, first, m->eigen ? 3 : 2, NULL,
               0);
    first_ready(m);
    refactor_steps(run, report, m);
}
