/* change_patch.c: does sl_factor_change_entries take the fastest way when a patch changes? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* The weights of all edges in a patch become larger and, in the next call, smaller again: by
 * sl_factor_change_entries, and by each of the ways between which it chooses. The baseline is the
 * best of the three. Rank-one changes are left out where they would take much longer than the
 * others. */
enum { SIZES = 4, MOST_RANKS = 4000, PATCHES = 3 };

static const sl_int sizes[SIZES] = {10, 100, 1000, 10000};

typedef struct patch_change {
    sl_int n_vertices, *vertices;
    sl_int count, *rows, *columns; /* changed entries */
    double *deltas[2];             /* up, down */
} patch_change;

typedef struct change_state {
    const bench_system *system;
    sl_factor *F;
    sl_work *W;
    double *values[PATCHES]; /* of A with patch k changed */
    patch_change patches[PATCHES];
    int next, is_changed; /* patch `next` is changed in F */
    sl_stats stats;
} change_state;

static void patch_fill(patch_change *p, double *values, const bench_system *system,
                       const bench_patch *patch, double w) {
    const sl_csc *A = &system->A;
    unsigned char *inside = calloc((size_t)system->n + 1, 1);
    sl_int room = 0;
    bench_must(inside ? SL_OK : SL_ERR_MEMORY, "marking a patch");
    for (sl_int v = 0; v < patch->size; v++) {
        inside[patch->vertices[v]] = 1;
        room += 3 * (A->p[patch->vertices[v] + 1] - A->p[patch->vertices[v]]);
    }
    p->n_vertices = patch->size;
    p->vertices = bench_alloc((size_t)patch->size, sizeof(sl_int));
    memcpy(p->vertices, patch->vertices, (size_t)patch->size * sizeof(sl_int));
    p->rows = bench_alloc((size_t)room, sizeof(sl_int));
    p->columns = bench_alloc((size_t)room, sizeof(sl_int));
    p->deltas[0] = bench_alloc((size_t)room, sizeof(double));
    p->deltas[1] = bench_alloc((size_t)room, sizeof(double));
    p->count = 0;
    memcpy(values, A->x, (size_t)A->p[A->n_cols] * sizeof(double));
    for (sl_int v = 0; v < patch->size; v++) {
        const sl_int j = patch->vertices[v];
        for (sl_int at = A->p[j]; at < A->p[j + 1]; at++) {
            const sl_int i = A->i[at];
            if (i == j || !inside[i]) {
                continue;
            }
            const sl_int rows[3] = {i, j, i}, columns[3] = {i, j, j};
            for (int k = 0; k < 3; k++) {
                p->rows[p->count] = rows[k];
                p->columns[p->count] = columns[k];
                p->deltas[0][p->count] = k == 2 ? -w : w;
                p->deltas[1][p->count++] = k == 2 ? w : -w;
                for (sl_int d = A->p[columns[k]]; d < A->p[columns[k] + 1]; d++) {
                    values[d] += A->i[d] == rows[k] ? (k == 2 ? -w : w) : 0;
                }
            }
        }
    }
    free(inside);
}

static void patch_free(patch_change *p) {
    free(p->vertices);
    free(p->rows);
    free(p->columns);
    free(p->deltas[0]);
    free(p->deltas[1]);
}

/* The matrix that the factor is to become the factor of. */
static sl_csc target(const change_state *s) {
    sl_csc A = s->system->A;
    A.x = s->is_changed ? A.x : s->values[s->next];
    return A;
}

/* The change was made: down comes after up, then the next patch. */
static void step_on(change_state *s) {
    s->is_changed = !s->is_changed;
    s->next = s->is_changed ? s->next : (s->next + 1) % PATCHES;
}

static void call_change(void *state) {
    change_state *s = state;
    const patch_change *p = &s->patches[s->next];
    const sl_csc A = target(s);
    bench_must(sl_factor_change_entries(s->F, &A, p->rows, p->columns, p->deltas[s->is_changed],
                                        p->count, s->W, &s->stats),
               "change");
    step_on(s);
}

static void call_update(void *state) {
    change_state *s = state;
    const patch_change *p = &s->patches[s->next];
    bench_must(sl_factor_change_entries(s->F, NULL, p->rows, p->columns, p->deltas[s->is_changed],
                                        p->count, s->W, NULL),
               "update");
    step_on(s);
}

static void call_reach(void *state) {
    change_state *s = state;
    const patch_change *p = &s->patches[s->next];
    const sl_csc A = target(s);
    bench_must(
        sl_factor_change_entries(s->F, &A, NULL, p->vertices, NULL, p->n_vertices, NULL, NULL),
        "refactorization of a reach");
    step_on(s);
}

static void call_refactor(void *state) {
    change_state *s = state;
    const sl_csc A = target(s);
    bench_must(sl_factor_refactor(s->F, &A, NULL), "refactorization");
    step_on(s);
}

/* Whether the factor, after one change by each way, solves with its matrix. */
static int check(bench_run *run, change_state *s, int with_updates) {
    const size_t n = (size_t)s->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    void (*const calls[4])(void *) = {call_change, call_reach, call_refactor, call_update};
    int held = 1;
    uint64_t rng = 5;
    bench_random_fill(&rng, b, n);
    for (int k = 0; k < 8 && held; k++) {
        if (k / 2 < 3 || with_updates) {
            calls[k / 2](s);
            bench_system now = *s->system;
            now.A.x = s->is_changed ? s->values[s->next] : now.A.x;
            bench_must(sl_factor_solve(s->F, x, n, b, n, 1, s->W), "solve");
            held = bench_check_residual(run, &now, x, b, 1, "change of a patch");
        }
    }
    free(x);
    free(b);
    return held;
}

static void time_size(bench_run *run, bench_report *report, const bench_system *system,
                      sl_int size) {
    static const char *const ways[] = {"nothing", "updates", "its reach", "a refactorization"};
    change_state s;
    bench_patch found[PATCHES];
    char what[32];
    double w = 0;
    memset(&s, 0, sizeof s);
    s.system = system;
    if (2 * size > system->n || bench_patch_pick(found, PATCHES, system, size) < PATCHES) {
        return;
    }
    for (sl_int p = 0; p < system->A.p[1]; p++) {
        w = fmax(w, 0.1 * fabs(system->A.x[p]));
    }
    bench_must(sl_factor_create(&s.F, system->S, &system->A, NULL, NULL), "factor");
    bench_must(sl_work_create(&s.W, NULL), "workspace");
    for (int k = 0; k < PATCHES; k++) {
        s.values[k] = bench_alloc((size_t)system->A.p[system->n], sizeof(double));
        patch_fill(&s.patches[k], s.values[k], system, &found[k], w);
        bench_patch_free(&found[k]);
    }
    const int with_updates = s.patches[0].count <= 3 * MOST_RANKS;
    if (check(run, &s, with_updates)) {
        const bench_contender contenders[4] = {{.call = call_change, .state = &s, .batch = 2},
                                               {.call = call_reach, .state = &s, .batch = 2},
                                               {.call = call_refactor, .state = &s, .batch = 2},
                                               {.call = call_update, .state = &s, .batch = 2}};
        static const char *const names[4] = {"sl_factor_change_entries", "refactor changed",
                                             "refactor", "updates"};
        bench_sample samples[4];
        const int count = with_updates ? 4 : 3;
        bench_race(samples, contenders, count, run->seconds);
        double best = samples[1].median;
        for (int k = 2; k < count; k++) {
            best = fmin(best, samples[k].median);
        }
        snprintf(what, sizeof what, "patch %d", (int)size);
        for (int k = 0; k < count; k++) {
            bench_row row = {.what = what, .method = names[k], .time = samples[k]};
            row.baseline = best;
            bench_report_row(report, system, &row);
        }
        bench_report_note(report, "%-14s   sl_factor_change_entries took %s, drift %.2g", "",
                          ways[s.stats.change.method], s.stats.change.drift);
    }
    for (int k = 0; k < PATCHES; k++) {
        patch_free(&s.patches[k]);
        free(s.values[k]);
    }
    sl_factor_free(s.F);
    sl_work_free(s.W);
}

void bench_change_patch(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[3];
    const int count = bench_systems(run, wanted, 3, systems);
    bench_report *report = bench_report_open(run, "change_patch", "the weights of a patch change",
                                             "the best of the three ways");
    for (int k = 0; k < count; k++) {
        for (int size = 0; size < SIZES; size++) {
            time_size(run, report, systems[k], sizes[size]);
        }
    }
    bench_report_close(report);
}
