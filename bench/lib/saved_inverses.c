/* saved_inverses.c: regions and selected inverses read from a file, against made anew */
#include "saved_inverses.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Every way begins with a file and ends with a factor and what is made over it, ready for queries.
 * Times are those of the processor: the file stays in the page cache, and other programs run. */

enum { PATCH = 2000, OPENS = 5, WAYS = 4 };

typedef enum part { PART_REGION, PART_SELECTED, PARTS } part;

typedef struct file_case {
    char path[500];
    const sl_int *patch;
    sl_int size;
    part what;
} file_case;

/* Makes the region or the selected inverse over the factor of a set. */
static void make(const file_case *c, sl_saved_set *set, sl_region **R) {
    if (c->what == PART_SELECTED) {
        bench_must(sl_selected_create(&set->selected, set->factor, NULL, SL_ALL, NULL, NULL),
                   "selected inverse");
    } else {
        bench_must(sl_region_create(R, set->factor, c->patch, c->size, NULL, NULL, NULL), "region");
        set->regions = R;
        set->n_regions = 1;
    }
}

/* Maps the factor and makes the rest anew. */
static void map_and_make(const file_case *c) {
    sl_saved_set set = {.wanted = SL_SAVED_FACTOR}, made;
    sl_region *R = NULL;
    bench_must(sl_load(&set, c->path, NULL, 0, SL_LOAD_MAPPED, NULL), "mapping");
    made = set;
    make(c, &made, &R);
    sl_region_free(R);
    sl_selected_free(made.selected);
    sl_saved_set_free(&set);
}

static void open_set(const file_case *c, int way) {
    sl_saved_set set = {0};
    bench_must(way == 3
                   ? sl_load(&set, c->path, NULL, 0, SL_LOAD_CHECKED, NULL)
                   : sl_load(&set, c->path, NULL, 0,
                             (way == 1 ? SL_LOAD_CHECKED : SL_LOAD_TRUSTED) | SL_LOAD_MAPPED, NULL),
               "opening");
    sl_saved_set_free(&set);
}

static int same_bits(const file_case *c, const sl_saved_set *made) {
    sl_saved_set got = {0};
    int same = 1;
    bench_must(sl_load(&got, c->path, NULL, 0, SL_LOAD_VERIFIED | SL_LOAD_MAPPED, NULL), "mapping");
    if (c->what == PART_SELECTED) {
        const sl_selected_arrays a = sl_selected_view(made->selected),
                                 b = sl_selected_view(got.selected);
        same = memcmp(a.Z, b.Z, (size_t)a.begin[a.count] * sizeof *a.Z) == 0;
    } else {
        const sl_saved_set *sets[2] = {made, &got};
        double *b = bench_alloc((size_t)c->size, sizeof *b), *x[2];
        for (int k = 0; k < c->size; k++) {
            b[k] = 1;
        }
        for (int k = 0; k < 2; k++) {
            const size_t ld = (size_t)c->size;
            sl_options opt;
            sl_plan *P;
            x[k] = bench_alloc(ld, sizeof **x);
            memset(&opt, 0, sizeof opt);
            opt.region = sets[k]->regions[0];
            bench_must(sl_plan_create(&P, sets[k]->symbolic, c->patch, c->size, c->patch, c->size,
                                      &opt, NULL),
                       "plan");
            bench_must(sl_plan_solve(P, sets[k]->factor, x[k], ld, b, ld, 1, NULL), "solve");
            sl_plan_free(P);
        }
        same = memcmp(x[0], x[1], (size_t)c->size * sizeof **x) == 0;
        free(x[0]);
        free(x[1]);
        free(b);
    }
    sl_saved_set_free(&got);
    return same;
}

static void time_ways(bench_report *report, const bench_system *system, const file_case *c) {
    static const char *const names[WAYS] = {"map, make anew", "map, checked", "map, trusted",
                                            "load, checked"};
    double times[WAYS][OPENS];
    bench_sample found[WAYS];
    for (int round = -1; round < OPENS; round++) { /* the first one is a warm-up */
        for (int way = 0; way < WAYS; way++) {
            const double start = bench_processor_seconds();
            if (way == 0) {
                map_and_make(c);
            } else {
                open_set(c, way);
            }
            times[way][round < 0 ? 0 : round] = bench_processor_seconds() - start;
        }
    }
    for (int way = 0; way < WAYS; way++) {
        found[way] = bench_sample_of(times[way], OPENS);
    }
    for (int way = 0; way < WAYS; way++) {
        bench_row row = {.what = c->what == PART_REGION ? "region, CPU" : "selected, CPU",
                         .method = names[way],
                         .nrhs = 1};
        row.time = found[way];
        row.baseline = found[0].median;
        bench_report_row(report, system, &row);
    }
}

void bench_saved_inverses(bench_run *run, bench_report *report, const bench_system *system) {
    sl_int *patch = bench_alloc(PATCH, sizeof *patch);
    for (part what = PART_REGION; what < PARTS; what = (part)(what + 1)) {
        file_case c;
        sl_saved_set set;
        sl_region *R = NULL;
        memset(&set, 0, sizeof set);
        memset(&c, 0, sizeof c);
        c.what = what;
        c.patch = patch;
        c.size = adjacency_bfs(patch, PATCH, &system->graph, system->n / 3, system->seen);
        snprintf(c.path, sizeof c.path, "%s/saved_set.slf", run->out_dir);
        set.symbolic = system->S;
        set.factor = system->F;
        make(&c, &set, &R);
        bench_must(sl_save(c.path, NULL, NULL, &set, NULL), "saving");
        if (bench_expect(run, same_bits(&c, &set),
                         "a region or selected inverse of a file differs")) {
            time_ways(report, system, &c);
        }
        sl_region_free(R);
        sl_selected_free(set.selected);
        (void)remove(c.path);
    }
    free(patch);
}
