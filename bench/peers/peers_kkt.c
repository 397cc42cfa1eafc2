/* peers_kkt.c: how do KKT systems of quadratic programs compare with an up-looking LDL'?
 * Analysis, refactorization, a full solve. */
#include <stdlib.h>
#include <string.h>

#include "bench/lib/kkt_programs.h"
#include "peers_ldl.h"
#include "peers_steps.h"

/* ---- contenders; state is a kkt_comparison * ---- */

typedef struct kkt_comparison {
    const bench_system *system;
    sl_symbolic *S[2]; /* by default, and for one factor */
    sl_factor *F[2];
    int which;
    peer_ldl *ldl;
    double *b, *x;
    sl_work *W;
} kkt_comparison;

static void analyze(kkt_comparison *c, int which) {
    sl_options opt;
    memset(&opt, 0, sizeof opt);
    opt.purpose = which == 0 ? SL_PURPOSE_MANY_SOLVES : SL_PURPOSE_ONE_FACTOR;
    bench_must(sl_symbolic_create(&c->S[which], &c->system->A, &opt, NULL), "analysis");
}

static void analyze_call(void *state) {
    kkt_comparison *c = state;
    sl_symbolic *keep = c->S[0];
    analyze(c, 0);
    sl_symbolic_free(c->S[0]);
    c->S[0] = keep;
}

static void analyze_one_call(void *state) {
    kkt_comparison *c = state;
    sl_symbolic *keep = c->S[1];
    analyze(c, 1);
    sl_symbolic_free(c->S[1]);
    c->S[1] = keep;
}

static void analyze_ldl_call(void *state) {
    peer_ldl_free(peer_ldl_create(&((kkt_comparison *)state)->system->A));
}

static void refactor_call(void *state) {
    kkt_comparison *c = state;
    bench_must(sl_factor_refactor(c->F[0], &c->system->A, NULL), "refactor");
}

static void refactor_one_call(void *state) {
    kkt_comparison *c = state;
    bench_must(sl_factor_refactor(c->F[1], &c->system->A, NULL), "refactor");
}

static void refactor_ldl_call(void *state) {
    peer_ldl_factor(((kkt_comparison *)state)->ldl);
}

static void solve(kkt_comparison *c, int which) {
    const size_t n = (size_t)c->system->n;
    bench_must(sl_factor_solve(c->F[which], c->x, n, c->b, n, 1, c->W), "solve");
}

static void solve_call(void *state) {
    solve(state, 0);
}

static void solve_one_call(void *state) {
    solve(state, 1);
}

static void solve_ldl_call(void *state) {
    kkt_comparison *c = state;
    peer_ldl_solve(c->ldl, c->x, c->b);
}

/* Prints three rows: ours by default, ours for one factor, LDL. */
static void race(bench_run *run, bench_report *report, kkt_comparison *c, const char *what,
                 void (*const *calls)(void *), sl_int nrhs) {
    static const char *const methods[] = {"LDL with AMD", "ours", "ours, one factor"};
    timed_row rows[3];
    comparison cmp;
    memset(rows, 0, sizeof rows);
    memset(&cmp, 0, sizeof cmp);
    cmp.system = c->system;
    for (int k = 0; k < 3; k++) {
        rows[k].method = methods[k];
        rows[k].call = calls[k];
        rows[k].state = c;
        rows[k].is_peer = k == 0;
    }
    (void)peers_race(run->seconds, report, &cmp, what, nrhs, rows, 3, NULL, 0);
}

static void one_program(bench_run *run, bench_report *report, kkt_kind kind, int size,
                        bench_system *system) {
    static void (*const analyze_calls[])(void *) = {analyze_ldl_call, analyze_call,
                                                    analyze_one_call};
    static void (*const refactor_calls[])(void *) = {refactor_ldl_call, refactor_call,
                                                     refactor_one_call};
    static void (*const solve_calls[])(void *) = {solve_ldl_call, solve_call, solve_one_call};
    sl_matrix *M = kkt_matrix(kind, size);
    kkt_comparison c;
    sl_stats stats;
    uint64_t rng = 9;
    int passed = 1;
    memset(&c, 0, sizeof c);
    memset(system, 0, sizeof *system);
    strcpy(system->name, kkt_name(kind));
    system->A = sl_matrix_view(M);
    system->n = system->A.n_rows;
    c.system = system;
    c.b = bench_alloc((size_t)system->n, sizeof *c.b);
    c.x = bench_alloc((size_t)system->n, sizeof *c.x);
    bench_random_fill(&rng, c.b, (size_t)system->n);
    bench_must(sl_work_create(&c.W, NULL), "workspace");
    for (int k = 1; k >= 0; k--) {
        analyze(&c, k);
        bench_must(sl_factor_create(&c.F[k], c.S[k], &system->A, NULL, &system->stats), "factor");
        system->stats.symbolic = sl_symbolic_view(c.S[k]).info;
        solve(&c, k);
        passed &= bench_check_residual(run, system, c.x, c.b, 1, "ours");
    }
    stats.symbolic = sl_symbolic_view(c.S[1]).info;
    c.ldl = peer_ldl_create(&system->A);
    peer_ldl_factor(c.ldl);
    peer_ldl_solve(c.ldl, c.x, c.b);
    passed &= bench_check_residual(run, system, c.x, c.b, 1, "LDL");
    if (passed) {
        race(run, report, &c, "analyze", analyze_calls, 0);
        race(run, report, &c, "refactor", refactor_calls, 0);
        race(run, report, &c, "full solve", solve_calls, 1);
        bench_report_note(report,
                          "%-14s   nnz(L), panels: LDL %.4g; ours %.4g, %.4g; for one factor "
                          "%.4g, %.4g",
                          "", peer_ldl_nnz(c.ldl), (double)system->stats.symbolic.nnz_l,
                          (double)system->stats.symbolic.nnz_panels, (double)stats.symbolic.nnz_l,
                          (double)stats.symbolic.nnz_panels);
    }
    peer_ldl_free(c.ldl);
    for (int k = 0; k < 2; k++) {
        sl_factor_free(c.F[k]);
        sl_symbolic_free(c.S[k]);
    }
    sl_work_free(c.W);
    sl_matrix_free(M);
    free(c.b);
    free(c.x);
}

void bench_peers_kkt(bench_run *run) {
    const int sizes = run->size == BENCH_QUICK ? 1 : 2;
    bench_system systems[2 * KKT_KINDS]; /* the report tells them apart by their addresses */
    bench_report *report = bench_report_open(
        run, "peers_kkt", "KKT systems of quadratic programs against an up-looking LDL' with AMD",
        "LDL's, with AMD");
    for (int k = 0; k < sizes * KKT_KINDS; k++) {
        one_program(run, report, (kkt_kind)(k / sizes), k % sizes, &systems[k]);
    }
    bench_report_close(report);
}
