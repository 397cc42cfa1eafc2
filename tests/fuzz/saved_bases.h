/* saved_bases.h: the files that fuzz_saved.c damages: grids and paths, with every treatment of null
 * pivots */
#ifndef SL_FUZZ_SAVED_BASES_H
#define SL_FUZZ_SAVED_BASES_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "sparse_local.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

enum { SIDE = 4, MOST = SIDE * SIDE, WAYS = 6, BASES = 2 * WAYS, REGIONS = 3 };

static void ignore(sl_status status) {
    (void)status;
}

/* Of which kind base k is; those from WAYS on are paths. */
enum { REGULAR, SKIPPED, WEIGHTED, REGULARIZED, SIGNED, PIVOTED };

typedef struct matrix_t {
    sl_int n, p[MOST + 1], i[MOST * MOST];
    double x[MOST * MOST];
} matrix_t;

/* Flags of a file: with regions and selected inverse; with L in float; with several null vectors,
 * which second differences have. */
enum { HAS_INVERSE = 1, HAS_FLOATS = 2, HAS_SEVERAL = 4, FLAGS = 8 };

/* Adds c c' for the first or second difference c of the rows from j on in steps of `step`. */
static void add_difference(double *a, sl_int j, sl_int step, int is_second) {
    static const double first[2] = {1, -1}, second[3] = {1, -2, 1};
    const double *c = is_second ? second : first;
    const int count = is_second ? 3 : 2;
    for (int k = 0; k < count * count; k++) {
        a[j + step * (k / count) + MOST * (j + step * (k % count))] += c[k / count] * c[k % count];
    }
}

/* The path is cut after row 4. */
static matrix_t matrix_make(int base, int flags) {
    matrix_t A;
    const int way = base % WAYS, is_path = base >= WAYS, is_second = (flags & HAS_SEVERAL) != 0;
    const int is_singular = way == SKIPPED || way == WEIGHTED;
    const sl_int reach = is_second ? 2 : 1;
    double a[MOST * MOST] = {0};
    memset(&A, 0, sizeof A);
    A.n = is_path ? 11 : MOST;
    for (sl_int j = 0; j < A.n; j++) {
        a[j + MOST * j] += is_singular ? 0 : 1;
        if (is_path ? j + reach < A.n && (j > 4 || j + reach <= 4) : j % SIDE + reach < SIDE) {
            add_difference(a, j, 1, is_second);
        }
        if (!is_path && j + reach * SIDE < A.n) {
            add_difference(a, j, SIDE, is_second);
        }
    }
    for (sl_int j = 0, at = 0; j < A.n; j++) {
        for (sl_int i = j; i < A.n; i++) {
            if (i == j || a[i + MOST * j] != 0) {
                A.i[at] = i;
                A.x[at++] = a[i + MOST * j];
            }
        }
        A.p[j + 1] = at;
    }
    for (sl_int j = 0; j < A.n && way == PIVOTED; j++) { /* needs 2x2 pivots */
        A.x[A.p[j]] *= j % 3 == 0 ? 1e-3 : -0.125;
    }
    return A;
}

/* The null vectors of second differences, with room for two components: 1, x, y, x y. */
enum { COLUMNS = 4 };

static void fill_null_vectors(double *z, sl_int n, int is_path) {
    for (sl_int i = 0; i < n; i++) {
        const double x = is_path ? i : i % SIDE, y = is_path ? 0 : i / SIDE;
        z[i] = 1;
        z[i + n] = x;
        z[i + 2 * n] = y;
        z[i + 3 * n] = x * y;
    }
}

static sl_csc view_of(const matrix_t *A) {
    sl_csc view;
    view.n_rows = view.n_cols = A->n;
    view.p = A->p;
    view.i = A->i;
    view.x = A->x;
    return view;
}

/* Saves a factor in new memory, if wanted with what is made over it. */
static unsigned char *save(sl_symbolic *S, sl_factor *F, int has_inverse, size_t *size) {
    const sl_int few[2] = {0, 1}, *const sets[REGIONS] = {few, NULL, few};
    const sl_int counts[REGIONS] = {2, 0, 1};
    sl_region *regions[REGIONS] = {NULL, NULL, NULL};
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    set.symbolic = S;
    set.factor = F;
    set.regions = regions;
    if (has_inverse) { /* a factor with weights has no regions, one with 2x2 pivots neither */
        ignore(sl_selected_create(&set.selected, F, few, 2, NULL, NULL));
        for (int k = 0; k < REGIONS; k++) {
            const sl_selected *Z = k == 2 ? set.selected : NULL;
            set.n_regions += sl_region_create(&regions[set.n_regions], F, sets[k], counts[k], Z,
                                              NULL, NULL) == SL_OK;
        }
    }
    PROMISE(sl_save(NULL, NULL, size, &set, NULL) == SL_OK);
    unsigned char *bytes = (unsigned char *)malloc(*size);
    PROMISE(bytes != NULL && sl_save(NULL, bytes, size, &set, NULL) == SL_OK);
    for (int k = 0; k < REGIONS; k++) {
        sl_region_free(regions[k]);
    }
    sl_selected_free(set.selected);
    return bytes;
}

/* A file, and what its factor answers. */
typedef struct base_t {
    unsigned char *bytes;
    size_t size;
    sl_status status;
    double x[MOST];
} base_t;

/* Solves for 1, 2, ... */
static sl_status ask(const sl_factor *F, sl_int n, double *x) {
    double b[MOST];
    for (sl_int i = 0; i < n; i++) {
        b[i] = 1.0 + i;
    }
    return sl_factor_solve(F, x, MOST, b, MOST, 1, NULL);
}

/* Saves base k in new memory. */
static base_t base_make(int base, int flags) {
    const matrix_t A = matrix_make(base, flags);
    base_t found;
    const int way = base % WAYS;
    const sl_csc view = view_of(&A);
    double mass[MOST], z[COLUMNS * MOST];
    sl_int signs[MOST];
    sl_options opt;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    memset(&opt, 0, sizeof opt);
    memset(&found, 0, sizeof found);
    for (int k = 0; k < MOST; k++) {
        mass[k] = 1 + k;
        signs[k] = k % 4 == 3 ? -1 : 1;
    }
    opt.pivots = way == SKIPPED || way == WEIGHTED ? SL_PIVOTS_SKIP_NULL : SL_PIVOTS_NONZERO;
    opt.mass = way == WEIGHTED ? mass : NULL;
    if (flags & HAS_SEVERAL && opt.pivots == SL_PIVOTS_SKIP_NULL) {
        fill_null_vectors(z, A.n, base >= WAYS);
        opt.null_vector = z;
        opt.null_vector_count = COLUMNS;
    }
    opt.regularization = way >= REGULARIZED ? 1e-8 : 0.0;
    opt.signs = way == SIGNED ? signs : NULL;
    opt.storage = flags & HAS_FLOATS ? SL_STORAGE_FLOAT : SL_STORAGE_DOUBLE;
    if (way == PIVOTED) {
        PROMISE(sl_symbolic_create_pivoted(&S, &view, NULL, NULL) == SL_OK);
    } else {
        PROMISE(sl_symbolic_create(&S, &view, NULL, NULL) == SL_OK);
    }
    PROMISE(sl_factor_create(&F, S, &view, &opt, NULL) == SL_OK);
    found.bytes = save(S, F, flags & HAS_INVERSE, &found.size);
    found.status = ask(F, A.n, found.x);
    sl_factor_free(F);
    sl_symbolic_free(S);
    return found;
}

#endif
