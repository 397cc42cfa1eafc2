/* selected.c: what does the whole diagonal of the inverse cost, beside a refactorization and beside entry after entry? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

/* Every row of the selected inverse ends with the diagonal in the caller's order; where only that is asked for, nothing
 * else is kept. Beside it: the refactorization, of
 * which each instruction set has its own; entry after entry by planned solves of a vertex to itself, the row being one
 * entry and the alternative n of them; and the selected inverse of a patch of vertices, on the reach of that alone.
 * Refill works in the memory it has; create asks for all of it, and what fresh pages cost is the system's. The flops are
 * those of the factorization, of which selected inversion needs twice as many. */
enum { VERTICES = 32, PATCH = 1000, MAX_SYSTEMS = 4, WAYS = 8, WAYS_NARROW = 2 };

typedef struct way {
    const bench_system *system;
    sl_options options;
    sl_factor *F; /* one that may be factored again */
    sl_selected *Z;
    sl_work *W;
    const sl_int *set; /* NULL: all */
    sl_int count;
    double *diagonal; /* n or count */
} way;

static void call_refactor(void *state) {
    way *w = state;
    bench_must(sl_factor_refactor(w->F, &w->system->A, NULL), "refactor");
}

static void call_refill(void *state) {
    way *w = state;
    bench_must(sl_selected_refill(w->Z, w->F, w->W), "refill");
    bench_must(sl_selected_diagonal(w->Z, w->diagonal, w->set, w->count, NULL), "diagonal");
}

static void call_diagonal(void *state) {
    way *w = state;
    bench_must(sl_inverse_diagonal(w->F, w->diagonal, w->set, w->count, w->W, NULL), "diagonal");
}

static void call_create(void *state) {
    way *w = state;
    sl_selected *Z;
    bench_must(sl_selected_create(&Z, w->F, w->set, w->count, NULL, NULL), "selected inverse");
    bench_must(sl_selected_diagonal(Z, w->diagonal, w->set, w->count, NULL), "diagonal");
    sl_selected_free(Z);
}

/* 0 where the instruction set is not here. */
static int way_make(way *w, const bench_system *system, sl_isa isa, sl_int threads,
                    const sl_int *set, sl_int count) {
    memset(w, 0, sizeof *w);
    w->system = system;
    w->options.isa = isa;
    w->options.threads = bench_threads(threads);
    w->set = set;
    w->count = count;
    const sl_status status = sl_factor_create(&w->F, system->S, &system->A, &w->options, NULL);
    if (status == SL_ERR_UNSUPPORTED) {
        return 0;
    }
    bench_must(status, "factor");
    bench_must(sl_selected_create(&w->Z, w->F, set, count, NULL, NULL), "selected inverse");
    bench_must(sl_work_create(&w->W, NULL), "workspace");
    w->diagonal = bench_alloc((size_t)(set ? count : system->n), sizeof *w->diagonal);
    call_refill(w);
    return 1;
}

static void way_free(way *w) {
    sl_selected_free(w->Z);
    sl_work_free(w->W);
    sl_factor_free(w->F);
    free(w->diagonal);
}

/* Entries of the diagonal are those of full solves, to 1e-9 of themselves. */
static int check_diagonal(bench_run *run, const way *w) {
    const size_t n = (size_t)w->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    uint64_t chance = 9;
    int good = 1;
    memset(b, 0, n * sizeof *b);
    for (int k = 0; k < 5; k++) {
        const sl_int at = bench_random_below(&chance, w->set ? w->count : w->system->n);
        const sl_int row = w->set ? w->set[at] : at;
        b[row] = 1;
        bench_must(sl_factor_solve(w->system->F, x, n, b, n, 1, NULL), "full solve");
        b[row] = 0;
        good &= bench_expect(run, fabs(w->diagonal[at] - x[row]) <= 1e-9 * x[row],
                             "%s: diagonal entry %d is %.17g instead of %.17g", w->system->name,
                             (int)row, w->diagonal[at], x[row]);
    }
    free(x);
    free(b);
    return good;
}

static void report_way(bench_report *report, const way *w, const char *what, const char *method,
                       bench_sample time, double baseline) {
    sl_stats stats = w->system->stats;
    sl_factor_stats(w->F, &stats);
    bench_row row = {.what = what,
                     .method = method,
                     .isa = stats.isa,
                     .threads = w->options.threads.count,
                     .flops = w->set ? 0 : w->system->stats.flops,
                     .time = time,
                     .baseline = baseline};
    bench_report_row(report, w->system, &row);
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    way all, narrow, some, two;
    bench_patch patch = bench_patch_create(system, system->n / 2, PATCH);
    const int has_all = way_make(&all, system, SL_ISA_AUTO, 1, NULL, 0);
    const int has_narrow =
        system->stats.isa == SL_ISA_AVX512 && way_make(&narrow, system, SL_ISA_AVX2, 1, NULL, 0);
    const int has_some = way_make(&some, system, SL_ISA_AUTO, 1, patch.vertices, patch.size);
    const int has_two = way_make(&two, system, SL_ISA_AUTO, 2, NULL, 0);
    if (has_all && has_some && has_two && check_diagonal(run, &all) && check_diagonal(run, &some) &&
        check_diagonal(run, &two) && (!has_narrow || check_diagonal(run, &narrow))) {
        bench_contender contenders[WAYS] = {
            {call_refactor, &all, 1, NULL},    {call_refill, &all, 1, NULL},
            {call_create, &all, 1, NULL},      {call_diagonal, &all, 1, NULL},
            {call_refill, &two, 1, NULL},      {call_diagonal, &two, 1, NULL},
            {call_refactor, &narrow, 1, NULL}, {call_refill, &narrow, 1, NULL}};
        bench_contender patch_ways[3] = {{call_refill, &some, 1, NULL},
                                         {call_create, &some, 1, NULL},
                                         {call_diagonal, &some, 1, NULL}};
        bench_sample samples[WAYS], local[3], single;
        bench_race(samples, contenders, has_narrow ? WAYS : WAYS - WAYS_NARROW, 4 * run->seconds);
        bench_race(local, patch_ways, 3, run->seconds / 2);
        bench_queries *q = bench_queries_vertices(system, VERTICES, 1);
        bench_contender one = {bench_call_plan_solve, q, VERTICES, NULL};
        bench_queries_check(run, q, 2);
        bench_race(&single, &one, 1, run->seconds / 4);
        const double baseline = samples[0].median;
        report_way(report, &all, "factor", "refactor", samples[0], baseline);
        report_way(report, &all, "whole diagonal", "selected, refill", samples[1], baseline);
        report_way(report, &all, "whole diagonal", "selected, create", samples[2], baseline);
        report_way(report, &all, "whole diagonal", "diagonal alone", samples[3], baseline);
        report_way(report, &two, "whole diagonal", "selected, refill", samples[4], baseline);
        report_way(report, &two, "whole diagonal", "diagonal alone", samples[5], baseline);
        if (has_narrow) {
            report_way(report, &narrow, "factor", "refactor, AVX2", samples[6], samples[6].median);
            report_way(report, &narrow, "whole diagonal", "selected, refill, AVX2", samples[7],
                       samples[6].median);
        }
        report_way(report, &some, "patch", "selected, refill", local[0], baseline);
        report_way(report, &some, "patch", "selected, create", local[1], baseline);
        report_way(report, &some, "patch", "diagonal alone", local[2], baseline);
        bench_row row = {.what = "one entry",
                         .method = "plan solve",
                         .nrhs = 1,
                         .time = single,
                         .baseline = baseline};
        sl_stats reach = bench_queries_reach(q);
        bench_row_reach(&row, &reach);
        bench_report_row(report, system, &row);
        bench_report_note(
            report,
            "%-14s   the whole diagonal alone costs as much as %.0f of its %d entries by "
            "plan solves; all of those %.0f times as much",
            "", samples[3].median / single.median, (int)system->n,
            single.median * system->n / samples[3].median);
        bench_queries_free(q);
    }
    if (has_narrow) {
        way_free(&narrow);
    }
    way_free(&some);
    way_free(&two);
    way_free(&all);
    bench_patch_free(&patch);
}

void bench_selected(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, 3, systems);
    bench_report *report = bench_report_open(
        run, "selected", "the whole diagonal of the inverse by selected inversion", "refactor");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    if (!run->mesh_path) {
        one_system(run, report, bench_volume(run->size == BENCH_QUICK ? 20 : 30));
    }
    bench_report_close(report);
}
