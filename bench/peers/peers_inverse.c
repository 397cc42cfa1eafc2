/* peers_inverse.c: entries of the inverse beside CHOLMOD's solve2 with Bset, one query each */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "peers_steps.h"

/* A diagonal entry is a solve of a vertex to itself for CHOLMOD, and a pair one with both vertices in Bset, as x comes on
 * the reach of Bset alone; it has no call for more of them at once. Ours come one by one, and as one list; times are
 * those of one entry. */
enum { QUERIES = 300, QUERIES_BRIEF = 64, CHECKED = 16 };

typedef struct ask {
    match *m;
    sl_int count, next;
    sl_int *rows, *columns; /* one array: the diagonal */
    double *out;
} ask;

static double cholmod_entry(ask *a, sl_int k) {
    const sl_int set[2] = {a->columns[k], a->rows[k]};
    const double b[2] = {1, 0};
    a->m->answer = peer_cholmod_local(a->m->cholmod, set, set[0] == set[1] ? 1 : 2, b);
    return a->m->answer[set[1]];
}

static void cholmod_call(void *state) {
    ask *a = state;
    a->out[a->next] = cholmod_entry(a, a->next);
    a->next = (a->next + 1) % a->count;
}

static void ours_call(void *state) {
    ask *a = state;
    const sl_int k = a->next;
    bench_must(sl_inverse_pairs(a->m->system->F, a->out + k, a->rows + k, a->columns + k, 1,
                                a->m->W, NULL),
               "entry");
    a->next = (k + 1) % a->count;
}

static void list_call(void *state) {
    ask *a = state;
    bench_must(
        sl_inverse_pairs(a->m->system->F, a->out, a->rows, a->columns, a->count, a->m->W, NULL),
        "entries");
}

static int check(bench_run *run, ask *a, const char *what) {
    double most = 0, apart = 0;
    list_call(a);
    for (sl_int k = 0; k < a->count && k < CHECKED; k++) {
        const double together = a->out[k], theirs = cholmod_entry(a, k);
        a->next = k;
        ours_call(a);
        most = fmax(most, fabs(theirs));
        apart = fmax(apart, fmax(fabs(together - theirs), fabs(a->out[k] - theirs)));
    }
    a->next = 0;
    return bench_expect(run, apart <= 1e-9 * most, "%s, %s: CHOLMOD's answer is %.2g away",
                        a->m->system->name, what, apart / most);
}

static void step(bench_run *run, bench_report *report, ask *a, const char *what) {
    if (check(run, a, what)) {
        bench_contender whole = {list_call, a, 1, NULL};
        entry entries[3] = {
            {.method = "ours, one list"},
            {.method = "ours, one by one", .call = ours_call, .state = a, .batch = a->count},
            {.method = "CHOLMOD solve2 Bset",
             .call = cholmod_call,
             .state = a,
             .batch = a->count,
             .foreign = 1}};
        bench_race(&entries[0].sample, &whole, 1, run->seconds / 4);
        entries[0].sample.min /= a->count;
        entries[0].sample.median /= a->count;
        entries[0].sample.max /= a->count;
        peers_race(run->seconds / 2, report, a->m, what, 1, entries, 3, NULL, 0);
    }
}

void peers_inverse(bench_run *run, bench_report *report, match *m) {
    const sl_int n = m->system->n;
    ask a = {.m = m, .count = m->is_brief ? QUERIES_BRIEF : QUERIES};
    uint64_t chance = 1234;
    a.rows = bench_alloc((size_t)a.count, sizeof *a.rows);
    a.columns = bench_alloc((size_t)a.count, sizeof *a.columns);
    a.out = bench_alloc((size_t)a.count, sizeof *a.out);
    sl_int *columns = a.columns;
    for (sl_int k = 0; k < a.count; k++) {
        a.rows[k] = bench_random_below(&chance, n);
        columns[k] = bench_random_below(&chance, n);
    }
    a.columns = a.rows;
    step(run, report, &a, "diagonal entry");
    a.columns = columns;
    step(run, report, &a, "pair's entry");
    free(a.rows);
    free(columns);
    free(a.out);
}
