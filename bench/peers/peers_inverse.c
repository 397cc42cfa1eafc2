/* peers_inverse.c: single entries of the inverse against CHOLMOD's solve2 with Bset */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "peers_steps.h"

/* For CHOLMOD, a diagonal entry is a solve with b and x at one vertex. An entry (i, j) needs
 * both vertices in Bset, because x is valid only on the reach of Bset. CHOLMOD has no call for a
 * list of entries. Ours are computed one by one and as one list; times are per entry. */
enum { QUERIES = 300, QUERIES_BRIEF = 64, CHECKED = 16 };

typedef struct entry_queries {
    comparison *cmp;
    sl_int count, next;
    sl_int *rows, *columns; /* the same array for diagonal entries */
    double *out;
} entry_queries;

static double cholmod_entry(entry_queries *a, sl_int k) {
    const sl_int set[2] = {a->columns[k], a->rows[k]};
    const double b[2] = {1, 0};
    a->cmp->answer = peer_cholmod_local(a->cmp->cholmod, set, set[0] == set[1] ? 1 : 2, b);
    return a->cmp->answer[set[1]];
}

static void cholmod_call(void *state) {
    entry_queries *a = state;
    a->out[a->next] = cholmod_entry(a, a->next);
    a->next = (a->next + 1) % a->count;
}

static void ours_call(void *state) {
    entry_queries *a = state;
    const sl_int k = a->next;
    bench_must(sl_inverse_pairs(a->cmp->system->F, a->out + k, a->rows + k, a->columns + k, 1,
                                a->cmp->W, NULL),
               "entry");
    a->next = (k + 1) % a->count;
}

static void list_call(void *state) {
    entry_queries *a = state;
    bench_must(
        sl_inverse_pairs(a->cmp->system->F, a->out, a->rows, a->columns, a->count, a->cmp->W, NULL),
        "entries");
}

static int check(bench_run *run, entry_queries *a, const char *what) {
    double largest = 0, difference = 0;
    list_call(a);
    for (sl_int k = 0; k < a->count && k < CHECKED; k++) {
        const double together = a->out[k], theirs = cholmod_entry(a, k);
        a->next = k;
        ours_call(a);
        largest = fmax(largest, fabs(theirs));
        difference = fmax(difference, fmax(fabs(together - theirs), fabs(a->out[k] - theirs)));
    }
    a->next = 0;
    return bench_expect(run, difference <= 1e-9 * largest,
                        "%s, %s: CHOLMOD's result differs by %.2g", a->cmp->system->name, what,
                        difference / largest);
}

static void step(bench_run *run, bench_report *report, entry_queries *a, const char *what) {
    if (check(run, a, what)) {
        bench_contender whole = {list_call, a, 1, NULL};
        timed_row rows[3] = {
            {.method = "ours, one list"},
            {.method = "ours, one by one", .call = ours_call, .state = a, .batch = a->count},
            {.method = "CHOLMOD solve2 Bset",
             .call = cholmod_call,
             .state = a,
             .batch = a->count,
             .is_peer = 1}};
        bench_race(&rows[0].sample, &whole, 1, run->seconds / 4);
        rows[0].sample.min /= a->count;
        rows[0].sample.median /= a->count;
        rows[0].sample.max /= a->count;
        peers_race(run->seconds / 2, report, a->cmp, what, 1, rows, 3, NULL, 0);
    }
}

void peers_inverse(bench_run *run, bench_report *report, comparison *cmp) {
    const sl_int n = cmp->system->n;
    entry_queries a = {.cmp = cmp, .count = cmp->is_brief ? QUERIES_BRIEF : QUERIES};
    uint64_t rng = 1234;
    a.rows = bench_alloc((size_t)a.count, sizeof *a.rows);
    a.columns = bench_alloc((size_t)a.count, sizeof *a.columns);
    a.out = bench_alloc((size_t)a.count, sizeof *a.out);
    sl_int *columns = a.columns;
    for (sl_int k = 0; k < a.count; k++) {
        a.rows[k] = bench_random_below(&rng, n);
        columns[k] = bench_random_below(&rng, n);
    }
    a.columns = a.rows;
    step(run, report, &a, "diagonal entry");
    a.columns = columns;
    step(run, report, &a, "off-diagonal");
    free(a.rows);
    free(columns);
    free(a.out);
}
