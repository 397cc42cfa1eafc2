/* selected_inverse.c: what does the whole diagonal of the inverse cost? */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/lib/bench.h"

/* Every variant of selected inversion ends with the diagonal in the caller's order; "diagonal
 * alone" keeps nothing else. The other rows: the refactorization, one for each instruction set;
 * single entries by a solve on a plan with b and x at one vertex, where the row is one entry and
 * the alternative is n of them; and the selected inverse of a patch, on the reach of the patch
 * alone. Refactor uses the memory that it has; create allocates, and the cost of fresh pages is
 * the system's. The flops are those of the factorization; selected inversion needs twice as
 * many. */
enum { VERTICES = 32, PATCH = 1000, MAX_SYSTEMS = 4, VARIANTS = 8, VARIANTS_AVX2 = 2 };

typedef struct variant {
    const bench_system *system;
    sl_options options;
    sl_factor *F; /* may be factored again */
    sl_selected *Z;
    sl_work *W;
    const sl_int *set; /* NULL: all rows */
    sl_int count;
    double *diagonal; /* n or count */
} variant;

static void call_refactor(void *state) {
    variant *w = state;
    bench_must(sl_factor_refactor(w->F, &w->system->A, NULL), "refactor");
}

static void call_selected_refactor(void *state) {
    variant *w = state;
    bench_must(sl_selected_refactor(w->Z, w->F, w->W), "selected refactor");
    bench_must(sl_selected_entries(w->Z, w->diagonal, w->set, NULL, w->count, NULL), "diagonal");
}

static void call_diagonal(void *state) {
    variant *w = state;
    bench_must(sl_inverse_diagonal(w->F, w->diagonal, w->set, w->count, w->W, NULL), "diagonal");
}

static void call_create(void *state) {
    variant *w = state;
    sl_selected *Z;
    bench_must(sl_selected_create(&Z, w->F, w->set, w->count, NULL, NULL), "selected inverse");
    bench_must(sl_selected_entries(Z, w->diagonal, w->set, NULL, w->count, NULL), "diagonal");
    sl_selected_free(Z);
}

/* Returns 0 if the instruction set is absent. */
static int variant_create(variant *w, const bench_system *system, sl_isa isa, sl_int threads,
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
    call_selected_refactor(w);
    return 1;
}

static void variant_free(variant *w) {
    sl_selected_free(w->Z);
    sl_work_free(w->W);
    sl_factor_free(w->F);
    free(w->diagonal);
}

/* Checks entries of the diagonal against full solves, with relative error 1e-9. */
static int check_diagonal(bench_run *run, const variant *w) {
    const size_t n = (size_t)w->system->n;
    double *b = bench_alloc(n, sizeof *b), *x = bench_alloc(n, sizeof *x);
    uint64_t rng = 9;
    int passed = 1;
    memset(b, 0, n * sizeof *b);
    for (int k = 0; k < 5; k++) {
        const sl_int at = bench_random_below(&rng, w->set ? w->count : w->system->n);
        const sl_int row = w->set ? w->set[at] : at;
        b[row] = 1;
        bench_must(sl_factor_solve(w->system->F, x, n, b, n, 1, NULL), "full solve");
        b[row] = 0;
        passed &= bench_expect(run, fabs(w->diagonal[at] - x[row]) <= 1e-9 * x[row],
                               "%s: diagonal entry %d is %.17g instead of %.17g", w->system->name,
                               (int)row, w->diagonal[at], x[row]);
    }
    free(x);
    free(b);
    return passed;
}

static void report_variant(bench_report *report, const variant *w, const char *what,
                           const char *method, bench_sample time, double baseline) {
    sl_stats stats = w->system->stats;
    stats.factor = sl_factor_view(w->F).info;
    bench_row row = {.what = what,
                     .method = method,
                     .isa = stats.factor.isa,
                     .threads = w->options.threads.count,
                     .flops = w->set ? 0 : w->system->stats.symbolic.flops,
                     .time = time,
                     .baseline = baseline};
    bench_report_row(report, w->system, &row);
}

static void one_system(bench_run *run, bench_report *report, const bench_system *system) {
    variant all, avx2, some, two;
    bench_patch patch = bench_patch_create(system, system->n / 2, PATCH);
    const int has_all = variant_create(&all, system, SL_ISA_AUTO, 1, NULL, SL_ALL);
    const int has_avx2 = system->stats.factor.isa == SL_ISA_AVX512 &&
                         variant_create(&avx2, system, SL_ISA_AVX2, 1, NULL, SL_ALL);
    const int has_some = variant_create(&some, system, SL_ISA_AUTO, 1, patch.vertices, patch.size);
    const int has_two = variant_create(&two, system, SL_ISA_AUTO, 2, NULL, SL_ALL);
    if (has_all && has_some && has_two && check_diagonal(run, &all) && check_diagonal(run, &some) &&
        check_diagonal(run, &two) && (!has_avx2 || check_diagonal(run, &avx2))) {
        bench_contender contenders[VARIANTS] = {{call_refactor, &all, 1, NULL},
                                                {call_selected_refactor, &all, 1, NULL},
                                                {call_create, &all, 1, NULL},
                                                {call_diagonal, &all, 1, NULL},
                                                {call_selected_refactor, &two, 1, NULL},
                                                {call_diagonal, &two, 1, NULL},
                                                {call_refactor, &avx2, 1, NULL},
                                                {call_selected_refactor, &avx2, 1, NULL}};
        bench_contender patch_variants[3] = {{call_selected_refactor, &some, 1, NULL},
                                             {call_create, &some, 1, NULL},
                                             {call_diagonal, &some, 1, NULL}};
        bench_sample samples[VARIANTS], local[3], single;
        bench_race(samples, contenders, has_avx2 ? VARIANTS : VARIANTS - VARIANTS_AVX2,
                   4 * run->seconds);
        bench_race(local, patch_variants, 3, run->seconds / 2);
        bench_queries *q = bench_queries_vertices(system, VERTICES, 1);
        bench_contender one = {bench_call_plan_solve, q, VERTICES, NULL};
        bench_queries_check(run, q, 2);
        bench_race(&single, &one, 1, run->seconds / 4);
        const double baseline = samples[0].median;
        report_variant(report, &all, "factor", "refactor", samples[0], baseline);
        report_variant(report, &all, "whole diagonal", "selected, refactor", samples[1], baseline);
        report_variant(report, &all, "whole diagonal", "selected, create", samples[2], baseline);
        report_variant(report, &all, "whole diagonal", "diagonal alone", samples[3], baseline);
        report_variant(report, &two, "whole diagonal", "selected, refactor", samples[4], baseline);
        report_variant(report, &two, "whole diagonal", "diagonal alone", samples[5], baseline);
        if (has_avx2) {
            report_variant(report, &avx2, "factor", "refactor, AVX2", samples[6],
                           samples[6].median);
            report_variant(report, &avx2, "whole diagonal", "selected, refactor, AVX2", samples[7],
                           samples[6].median);
        }
        report_variant(report, &some, "patch", "selected, refactor", local[0], baseline);
        report_variant(report, &some, "patch", "selected, create", local[1], baseline);
        report_variant(report, &some, "patch", "diagonal alone", local[2], baseline);
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
    if (has_avx2) {
        variant_free(&avx2);
    }
    variant_free(&some);
    variant_free(&two);
    variant_free(&all);
    bench_patch_free(&patch);
}

void bench_selected_inverse(bench_run *run) {
    static const double wanted[] = {1e4, 1e5, 1e6};
    const bench_system *systems[MAX_SYSTEMS];
    int count = bench_systems(run, wanted, 3, systems);
    bench_report *report =
        bench_report_open(run, "selected_inverse",
                          "the whole diagonal of the inverse by selected inversion", "refactor");
    for (int k = 0; k < count; k++) {
        one_system(run, report, systems[k]);
    }
    if (!run->mesh_path) {
        one_system(run, report, bench_volume(run->size == BENCH_QUICK ? 20 : 30));
    }
    bench_report_close(report);
}
