/* subjects.c: what is asked of each version: sets of vertices, plans, calls, checks of results */
#include "subjects.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const row_names[ROW_KINDS] = {"vertex",   "pair",   "patch", "one shot",        "full",
                                          "refactor", "factor", "cold",  "cold, one factor"};

int row_is_solve(row_kind kind) {
    return kind <= ROW_FULL;
}

/* ---- the case ---- */

static void add_query(query_list *list, int b, int x) {
    const int k = list->count++;
    list->bsets[k] = b;
    list->xsets[k] = x;
    const last_query q = {&list->bsets[k], &list->xsets[k], 1, 1};
    list->queries[k] = q;
}

/* A patch of 1000 vertices, a quarter of a small system, around a vertex whose component is large
 * enough if there is one. */
static void choose_patch(last_case *c, const sl_csc *A) {
    const sl_int n = A->n_rows, wanted = n < 4000 ? (n + 3) / 4 : 1000;
    adjacency graph;
    bench_must(adjacency_from_matrix(&graph, A) ? SL_OK : SL_ERR_MEMORY, "the graph of a matrix");
    unsigned char *seen = bench_alloc((size_t)n, 1);
    memset(seen, 0, (size_t)n);
    c->patch_vertices = bench_alloc((size_t)wanted, sizeof *c->patch_vertices);
    uint64_t random = 77;
    sl_int found = 0;
    for (int attempt = 0; attempt < 20 && found < wanted; attempt++) {
        found =
            adjacency_bfs(c->patch_vertices, wanted, &graph, bench_random_below(&random, n), seen);
    }
    const last_query q = {c->patch_vertices, c->patch_vertices, found, found};
    c->patch.count = 1;
    c->patch.queries[0] = q;
    free(seen);
    adjacency_free(&graph);
}

void case_create(last_case *c, const char *name, const sl_csc *A, const last_header *header) {
    const size_t n = (size_t)A->n_rows;
    memset(c, 0, sizeof *c);
    snprintf(c->name, sizeof c->name, "%s", name);
    c->A.n = A->n_rows;
    c->A.p = A->p;
    c->A.i = A->i;
    c->A.x = A->x;
    c->order = bench_alloc(n, sizeof *c->order);
    bench_must((sl_status)header->order(c->order, &c->A, LAST_MANY_SOLVES), "ordering a system");
    uint64_t random = 12345;
    for (int k = 0; k < VERTICES; k++) {
        const int v = bench_random_below(&random, A->n_rows);
        add_query(&c->vertices, v, v);
        add_query(&c->pairs, v, bench_random_below(&random, A->n_rows));
    }
    choose_patch(c, A);
    c->B = bench_alloc(n * MOST_RHS, sizeof *c->B);
    c->X = bench_alloc(n * MOST_RHS, sizeof *c->X);
    c->reference = bench_alloc(n * MOST_RHS, sizeof *c->reference);
    bench_random_fill(&random, c->B, n * MOST_RHS);
    memset(c->X, 0, n * MOST_RHS * sizeof *c->X);
}

void case_free(last_case *c) {
    free(c->reference);
    free(c->X);
    free(c->B);
    free(c->patch_vertices);
    free(c->order);
}

/* ---- subjects ---- */

static int create_plans(void **plans, const subject *s, const query_list *list) {
    int error = 0;
    for (int k = 0; k < list->count && !error; k++) {
        error = s->header->plan_create(&plans[k], s->state, &list->queries[k]);
    }
    return error;
}

int subject_create(subject *s, const last_case *c, const last_header *header, last_isa isa) {
    memset(s, 0, sizeof *s);
    s->on = c;
    s->header = header;
    int error = header->open(&s->state, &c->A, c->order, isa);
    error = error ? error : create_plans(s->vertices, s, &c->vertices);
    error = error ? error : create_plans(s->pairs, s, &c->pairs);
    return error ? error : create_plans(s->patch, s, &c->patch);
}

void subject_free(subject *s) {
    for (int k = 0; k < VERTICES; k++) {
        s->header->plan_free(s->vertices[k]);
        s->header->plan_free(s->pairs[k]);
    }
    s->header->plan_free(s->patch[0]);
    s->header->close(s->state);
}

/* ---- calls ---- */

typedef struct timed {
    const subject *s;
    row_kind kind;
    int nrhs, queries; /* how many of the list */
    int times;
} timed;

static const query_list *list_of(const last_case *c, row_kind kind) {
    return kind == ROW_PAIR ? &c->pairs : kind == ROW_PATCH ? &c->patch : &c->vertices;
}

static int local_solve(const subject *s, row_kind kind, int k, double *X, int nrhs) {
    const last_query *q = &list_of(s->on, kind)->queries[k];
    void *const *plans = kind == ROW_PAIR ? s->pairs : kind == ROW_PATCH ? s->patch : s->vertices;
    return kind == ROW_ONE_SHOT ? s->header->one_shot(s->state, q, X, s->on->B, nrhs)
                                : s->header->plan_solve(s->state, plans[k], q, X, s->on->B, nrhs);
}

static int run_once(const timed *t) {
    const last_header *h = t->s->header;
    const last_case *c = t->s->on;
    int error = 0;
    switch (t->kind) {
    case ROW_FULL:
        return h->full(t->s->state, c->X, c->B, t->nrhs);
    case ROW_REFACTOR:
        return h->refactor(t->s->state);
    case ROW_FACTOR:
        return h->factor(t->s->state);
    case ROW_COLD:
        return h->cold(t->s->state, LAST_MANY_SOLVES, c->X, c->B);
    case ROW_COLD_ONE:
        return h->cold(t->s->state, LAST_ONE_FACTOR, c->X, c->B);
    default:
        for (int k = 0; k < t->queries && !error; k++) {
            error = local_solve(t->s, t->kind, k, c->X, t->nrhs);
        }
        return error;
    }
}

static int run_timed(const void *state) {
    const timed *t = state;
    int error = 0;
    for (int k = 0; k < t->times && !error; k++) {
        error = run_once(t);
    }
    return error;
}

/* As many vertices as take 50 microseconds, at least 8 if there are as many. */
static int choose_queries(const timed *t, const query_list *list) {
    timed some = *t;
    some.queries = list->count;
    for (int count = 8; count < list->count; count *= 2) {
        some.queries = count;
        double start = bench_processor_seconds();
        if (run_once(&some) == 0 && bench_processor_seconds() - start > 50e-6) {
            break;
        }
        some.queries = list->count;
    }
    return some.queries;
}

int subjects_race(double *least, const subject *subjects, int count, row_kind kind, int nrhs,
                  int extra, double seconds) {
    timed all[RACE_MOST];
    race_call calls[RACE_MOST];
    memset(calls, 0, sizeof calls);
    for (int k = 0; k < count; k++) {
        const timed t = {&subjects[k], kind, nrhs, 1, k == 0 ? 1 + extra : 1};
        all[k] = t;
        calls[k].run = run_timed;
        calls[k].state = &all[k];
    }
    if (row_is_solve(kind) && kind != ROW_FULL) {
        const int queries = choose_queries(&all[count - 1], list_of(subjects[0].on, kind));
        for (int k = 0; k < count; k++) {
            all[k].queries = queries;
        }
    }
    const int error = race(least, calls, count, seconds);
    for (int k = 0; k < count; k++) {
        least[k] /= all[k].queries;
    }
    return error;
}

/* ---- checks ---- */

/* Relative to the largest entry of the solution. */
static const double rounding = 1e-8, residual = 1e-11;

/* Whether rows of X equal those of the reference; rows may be NULL: all. */
static int is_close(const last_case *c, const int *rows, int count, int nrhs) {
    double largest = 0, difference = 0;
    for (size_t k = 0; k < (size_t)c->A.n * (size_t)nrhs; k++) {
        largest = fmax(largest, fabs(c->reference[k]));
    }
    for (int r = 0; r < nrhs; r++) {
        for (int k = 0; k < count; k++) {
            const size_t row = (size_t)(rows ? rows[k] : k) + (size_t)r * (size_t)c->A.n;
            const double d = c->X[(size_t)k + (size_t)r * (size_t)count] - c->reference[row];
            difference = fmax(difference, d == d ? fabs(d) : INFINITY);
        }
    }
    return difference <= rounding * largest;
}

static int check_local(const subject *subjects, int count, row_kind kind, int nrhs) {
    const last_case *c = subjects[0].on;
    const last_query *q = &list_of(c, kind)->queries[0];
    const size_t n = (size_t)c->A.n;
    double *B = bench_alloc(n * (size_t)nrhs, sizeof *B);
    int wrong = 0;
    memset(B, 0, n * (size_t)nrhs * sizeof *B);
    for (int r = 0; r < nrhs; r++) {
        for (int k = 0; k < q->nb; k++) {
            B[(size_t)q->bset[k] + (size_t)r * n] = c->B[k + r * q->nb];
        }
    }
    wrong += subjects[0].header->full(subjects[0].state, c->reference, B, nrhs) != 0;
    for (int k = 0; k < count; k++) {
        if (local_solve(&subjects[k], kind, 0, c->X, nrhs) || !is_close(c, q->xset, q->nx, nrhs)) {
            printf("%s: %s of %s, %d right-hand sides: wrong\n", c->name, row_names[kind],
                   subjects[k].header->name, nrhs);
            wrong++;
        }
    }
    free(B);
    return wrong;
}

static int check_full(const subject *subjects, int count, int nrhs) {
    const last_case *c = subjects[0].on;
    const size_t n = (size_t)c->A.n;
    const sl_csc A = {c->A.n, c->A.n, c->A.p, c->A.i, c->A.x};
    double *R = bench_alloc(n * (size_t)nrhs, sizeof *R), error[MOST_RHS];
    int wrong = 0;
    if (subjects[0].header->full(subjects[0].state, c->reference, c->B, nrhs) ||
        sl_csc_residual(&A, R, n, error, c->reference, n, c->B, n, nrhs)) {
        wrong++;
    }
    for (int r = 0; r < nrhs; r++) {
        wrong += !(error[r] <= residual);
    }
    for (int k = 0; k < count; k++) {
        for (row_kind kind = ROW_FULL; kind < ROW_KINDS; kind++) {
            const timed t = {&subjects[k], kind, nrhs, 1, 1};
            const int sides = kind == ROW_FULL ? nrhs : 1;
            if ((kind == ROW_FULL || nrhs == 1) &&
                (run_once(&t) || !is_close(c, NULL, c->A.n, sides))) {
                printf("%s: %s of %s: wrong\n", c->name, row_names[kind], subjects[k].header->name);
                wrong++;
            }
        }
    }
    free(R);
    return wrong;
}

int subjects_check(const subject *subjects, int count) {
    static const int rhs[] = {1, 2, 3, 8};
    int wrong = 0;
    for (size_t k = 0; k < sizeof rhs / sizeof *rhs; k++) {
        for (row_kind kind = ROW_VERTEX; kind < ROW_FULL; kind++) {
            wrong += check_local(subjects, count, kind, rhs[k]);
        }
        wrong += check_full(subjects, count, rhs[k]);
    }
    return wrong;
}
