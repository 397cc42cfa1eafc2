/* solve_variants.c: times local solves on a plan and in one call, plan creation, full solves */
#include "bench.h"

const char *const bench_solve_variants[BENCH_SOLVE_VARIANTS] = {"plan solve", "plan create",
                                                                "one shot", "full solve"};

int bench_solve_variants_time(bench_run *run, bench_report *report, bench_queries *q,
                              const char *what, double *medians) {
    /* Full solves are timed in a race of their own: they evict everything from the caches, and
     * each local solve after one would start cold. */
    int batch = q->count < 8 ? 8 * q->count : q->count;
    bench_contender contenders[BENCH_SOLVE_VARIANTS] = {{bench_call_plan_solve, q, batch, NULL},
                                                        {bench_call_plan_create, q, batch, NULL},
                                                        {bench_call_one_shot, q, batch, NULL},
                                                        {bench_call_full, q, 1, NULL}};
    bench_sample samples[BENCH_SOLVE_VARIANTS];
    if (!bench_queries_check(run, q, 2)) {
        return 0;
    }
    bench_race(samples, contenders, BENCH_FULL_SOLVE, run->seconds / 2);
    bench_race(samples + BENCH_FULL_SOLVE, contenders + BENCH_FULL_SOLVE, 1, run->seconds / 4);
    sl_stats reach = bench_queries_reach(q);
    for (int c = 0; c < BENCH_SOLVE_VARIANTS; c++) {
        bench_row row = {
            .what = what, .method = bench_solve_variants[c], .nrhs = q->nrhs, .time = samples[c]};
        row.baseline = samples[BENCH_PLAN_SOLVE].median;
        if (c == BENCH_FULL_SOLVE) {
            bench_row_full(&row, q->system);
        } else {
            bench_row_reach(&row, &reach);
        }
        if (c == BENCH_PLAN_CREATE) {
            row.entries = 0;
        }
        bench_report_row(report, q->system, &row);
        medians[c] = samples[c].median;
    }
    return 1;
}
