/* peers_kkt.c: how do KKT systems of quadratic programs compare with an up-looking LDL'? */
#include <stdlib.h>
#include <string.h>

#include "peers_ldl.h"
#include "peers_steps.h"

/* K = [P + s I, A'; A, -1/r I], as operator splitting (OSQP) factors it once for each r and then
 * solves with it in every iteration: analysis, refactorization, a full solve. */
static const double shift = 1e-6, penalty = 0.1;

typedef enum program { PROGRAM_RANDOM, PROGRAM_MPC, PROGRAM_PDE, PROGRAMS } program;
static const char *const names[PROGRAMS] = {"random QP", "MPC", "PDE control"};

/* The lower triangle of K as triplets. */
typedef struct triplets {
    sl_int n, variables; /* constraints follow the variables */
    sl_int count, room;
    sl_int *row, *column;
    double *x;
} triplets;

static void add(triplets *t, sl_int row, sl_int column, double x) {
    if (t->count < t->room) {
        t->row[t->count] = row;
        t->column[t->count] = column;
        t->x[t->count] = x;
    }
    t->count++;
}

/* Half of the variables have an entry of P with another one; a constraint has 3 variables. */
static void random_program(triplets *t, sl_int variables) {
    uint64_t rng = 7;
    t->n = 3 * variables;
    t->variables = variables;
    for (sl_int k = 0; k < variables; k++) {
        const sl_int other = bench_random_below(&rng, variables);
        add(t, k, k, 4 + shift);
        if (k % 2 == 0 && other != k) {
            add(t, other > k ? other : k, other > k ? k : other, bench_random_unit(&rng));
        }
    }
    for (sl_int k = variables; k < t->n; k++) {
        sl_int v = bench_random_below(&rng, variables);
        for (int c = 0; c < 3; c++) {
            add(t, k, v, bench_random_unit(&rng));
            v = (v + 1 + bench_random_below(&rng, variables / 4)) % variables;
        }
    }
}

/* A linear system of 10 states and 4 inputs over `steps` steps: x' = F x + G u, half of the entries
 * of F and G zero; bounds on all. */
static void mpc_program(triplets *t, sl_int steps) {
    enum { STATES = 10, INPUTS = 4, STEP = STATES + INPUTS };
    const sl_int variables = steps * STEP, bounds = variables + steps * STATES;
    uint64_t rng = 8;
    t->n = bounds + variables;
    t->variables = variables;
    for (sl_int k = 0; k < variables; k++) {
        add(t, k, k, 1 + shift);
        add(t, bounds + k, k, 1);
    }
    for (sl_int s = 0; s < steps; s++) {
        for (sl_int i = 0; i < STATES; i++) {
            const sl_int row = variables + s * STATES + i;
            add(t, row, s * STEP + i, -1);
            for (sl_int j = 0; j < STEP && s > 0; j++) {
                if (bench_random_below(&rng, 2) == 0) {
                    add(t, row, (s - 1) * STEP + j, bench_random_unit(&rng));
                }
            }
        }
    }
}

/* A state y on a grid, L y = u with a five-point Laplacian L, and bounds on u. */
static void pde_program(triplets *t, sl_int side) {
    const sl_int m = side * side;
    t->n = 4 * m;
    t->variables = 2 * m;
    for (sl_int v = 0; v < m; v++) {
        add(t, v, v, 1 + shift);
        add(t, m + v, m + v, 0.01 + shift);
        add(t, 2 * m + v, v, 4);
        add(t, 2 * m + v, m + v, -1);
        add(t, 3 * m + v, m + v, 1);
        for (int k = 0; k < 4; k++) {
            const sl_int x = v % side + (k == 0) - (k == 1), y = v / side + (k == 2) - (k == 3);
            if (x >= 0 && x < side && y >= 0 && y < side) {
                add(t, 2 * m + v, x + side * y, -1);
            }
        }
    }
}

static sl_matrix *program_matrix(program kind, int is_quick) {
    triplets t;
    sl_matrix *M = NULL;
    memset(&t, 0, sizeof t);
    for (int pass = 0; pass < 2; pass++) { /* counts, then fills */
        t.room = pass == 0 ? 0 : t.count;
        t.row = bench_alloc((size_t)t.room + 1, sizeof *t.row);
        t.column = bench_alloc((size_t)t.room + 1, sizeof *t.column);
        t.x = bench_alloc((size_t)t.room + 1, sizeof *t.x);
        t.count = 0;
        if (kind == PROGRAM_RANDOM) {
            random_program(&t, is_quick ? 500 : 2000);
        } else if (kind == PROGRAM_MPC) {
            mpc_program(&t, is_quick ? 100 : 1158);
        } else {
            pde_program(&t, is_quick ? 30 : 100);
        }
        for (sl_int k = t.variables; k < t.n; k++) {
            add(&t, k, k, -1 / penalty);
        }
        if (pass == 1) {
            bench_must(
                sl_matrix_from_triplets(&M, t.n, t.n, t.count, t.row, t.column, t.x, NULL, NULL),
                "assembling");
        }
        free(t.row);
        free(t.column);
        free(t.x);
    }
    return M;
}

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

static void one_program(bench_run *run, bench_report *report, program kind, bench_system *system) {
    static void (*const analyze_calls[])(void *) = {analyze_ldl_call, analyze_call,
                                                    analyze_one_call};
    static void (*const refactor_calls[])(void *) = {refactor_ldl_call, refactor_call,
                                                     refactor_one_call};
    static void (*const solve_calls[])(void *) = {solve_ldl_call, solve_call, solve_one_call};
    sl_matrix *M = program_matrix(kind, run->size == BENCH_QUICK);
    kkt_comparison c;
    sl_stats stats;
    uint64_t rng = 9;
    int passed = 1;
    memset(&c, 0, sizeof c);
    memset(system, 0, sizeof *system);
    strcpy(system->name, names[kind]);
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
        sl_symbolic_stats(c.S[k], &system->stats);
        solve(&c, k);
        passed &= bench_check_residual(run, system, c.x, c.b, 1, "ours");
    }
    sl_symbolic_stats(c.S[1], &stats);
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
                          (double)system->stats.symbolic.nnz_panels,
                          (double)stats.symbolic.nnz_l, (double)stats.symbolic.nnz_panels);
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
    bench_system systems[PROGRAMS]; /* the report tells them apart by their addresses */
    bench_report *report = bench_report_open(
        run, "peers_kkt", "KKT systems of quadratic programs against an up-looking LDL' with AMD",
        "LDL's, with AMD");
    bench_machine_write(run, "peers_kkt");
    for (int k = 0; k < PROGRAMS; k++) {
        one_program(run, report, (program)k, &systems[k]);
    }
    bench_report_close(report);
}
