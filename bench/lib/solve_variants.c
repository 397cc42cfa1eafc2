/* forms.c: times local solves planned and in one shot, the making of the plan, and full solves */
#include "bench.h"

const char *const bench_forms[BENCH_FORMS] = {"plan solve", "plan create", "one shot",
                                              "full solve"};

int bench_forms_time(bench_run *run, bench_report *report, bench_queries *q, const char *what,
                     double *medians) {
    /* Full solves stand apart: they push everything out of the caches, and each local solve after one would be
     * the first of its kind. */
    int batch = q->count < 8 ? 8 * q->count : q->count;
    bench_contender contenders[BENCH_FORMS] = {{bench_call_plan_solve, q, batch, NULL},
                                               {bench_call_plan_create, q, batch, NULL},
                                               {bench_call_one_shot, q, batch, NULL},
                                               {bench_call_full, q, 1, NULL}};
    bench_sample samples[BENCH_FORMS];
    if (!bench_queries_check(run, q, 2)) {
        return 0;
    }
    bench_race(samples, contenders, BENCH_FULL_SOLVE, run->seconds / 2);
    bench_race(samples + BENCH_FULL_SOLVE, contenders + BENCH_FULL_SOLVE, 1, run->seconds / 4);
    sl_stats reach = bench_queries_reach(q);
    for (int c = 0; c < BENCH_FORMS; c++) {
        bench_row row = {
            .what = what, .method = bench_forms[c], .nrhs = q->nrhs, .time = samples[c]};
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
