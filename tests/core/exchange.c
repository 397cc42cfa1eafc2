/* exchange.c: saves a set of objects, or loads one of another processor and saves it again */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "sparse_local.h"

/*     exchange double|float OUT       saves what this processor makes
 *     exchange double|float OUT IN    loads IN, compares its answers with those of this processor,
 *                                     and saves what it has loaded
 *
 * tests/core/check_exchange.sh runs it on two processors of different byte order. */
enum { SIDE = 30, N = SIDE * SIDE };

static void must(sl_status status, const char *what) {
    if (status != SL_OK) {
        fprintf(stderr, "%s: %s\n", what, sl_status_string(status));
        exit(1);
    }
}

/* What both processors make of the same numbers: a grid of springs whose constants differ. */
static void make(sl_saved_set *set, sl_region **R, const char *storage) {
    static const sl_int rows[4] = {431, 432, 461, 462};
    static sl_int p[N + 1], i[3 * N];
    static double x[3 * N], diagonal[N];
    sl_options opt;
    sl_int at = 0;
    for (sl_int j = 0; j < N; j++) {
        const sl_int right = j % SIDE < SIDE - 1 ? j + 1 : -1, below = j + SIDE < N ? j + SIDE : -1;
        const double k = 1 + j % 7 / 8.0;
        i[at] = j;
        x[at++] = 0.25;
        for (int side = 0; side < 2; side++) {
            const sl_int other = side == 0 ? right : below;
            if (other >= 0) {
                i[at] = other;
                x[at++] = -k;
                diagonal[j] += k;
                diagonal[other] += k;
            }
        }
        p[j + 1] = at;
    }
    for (sl_int j = 0; j < N; j++) {
        x[p[j]] += diagonal[j];
    }
    const sl_csc A = {N, N, p, i, x};
    memset(&opt, 0, sizeof opt);
    memset(set, 0, sizeof *set);
    opt.storage = strcmp(storage, "float") == 0 ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
    must(sl_symbolic_create(&set->symbolic, &A, NULL, NULL), "analysis");
    must(sl_factor_create(&set->factor, set->symbolic, &A, &opt, NULL), "factor");
    must(sl_selected_create(&set->selected, set->factor, NULL, SL_ALL, NULL, NULL), "selected");
    must(sl_region_create(R, set->factor, rows, 4, NULL, NULL, NULL), "region");
    set->regions = R;
    set->n_regions = 1;
}

/* A full solution, a local one in the region, and the diagonal of the inverse: 2 N + 1 numbers. */
static void ask(const sl_saved_set *set, double *x) {
    static const sl_int rows[1] = {432};
    static double b[N];
    sl_options opt;
    sl_plan *P = NULL;
    memset(&opt, 0, sizeof opt);
    opt.region = set->regions[0];
    for (sl_int k = 0; k < N; k++) {
        b[k] = 1 + k % 5;
    }
    must(sl_factor_solve(set->factor, x, N, b, N, 1, NULL), "solve");
    must(sl_selected_entries(set->selected, x + N, NULL, NULL, SL_ALL, NULL), "diagonal");
    must(sl_plan_create(&P, set->symbolic, rows, 1, rows, 1, &opt, NULL), "plan");
    must(sl_plan_solve(P, set->factor, x + 2 * N, 1, b, 1, 1, NULL), "solve in the region");
    sl_plan_free(P);
}

int main(int argc, char **argv) {
    static double own[2 * N + 1], other[2 * N + 1];
    sl_saved_set made, loaded = {0};
    sl_region *R = NULL;
    if (argc < 3) {
        return 2;
    }
    make(&made, &R, argv[1]);
    if (argc == 3) {
        must(sl_save(argv[2], NULL, NULL, &made, NULL), argv[2]);
    } else {
        /* D and the order are those of double; L in float is rounded once more */
        const double bound = strcmp(argv[1], "float") == 0 ? 1e-5 : 1e-13;
        must(sl_load(&loaded, argv[3], NULL, 0, SL_LOAD_VERIFIED, NULL), argv[3]);
        ask(&made, own);
        ask(&loaded, other);
        for (int k = 0; k < 2 * N + 1; k++) {
            if (!(fabs(own[k] - other[k]) <= bound * fabs(own[k]))) {
                fprintf(stderr, "number %d: %.17g, here %.17g\n", k, other[k], own[k]);
                return 1;
            }
        }
        must(sl_save(argv[2], NULL, NULL, &loaded, NULL), argv[2]);
        sl_saved_set_free(&loaded);
    }
    sl_region_free(R);
    sl_selected_free(made.selected);
    sl_factor_free(made.factor);
    sl_symbolic_free(made.symbolic);
    return 0;
}
