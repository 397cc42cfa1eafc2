/* fuzz_saved.c: loads, maps and uses saved factors, some with regions and a selected inverse, that
 * are arbitrary bytes, or damaged in a few words with checksums that agree; what is not damaged has
 * to give the answers of what was saved */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "sparse_local.h"
#include "tests/lib/saved_format.h"

#define PROMISE(condition) ((condition) ? (void)0 : abort())

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { SIDE = 4, MOST = SIDE * SIDE, WAYS = 6, BASES = 2 * WAYS, REGIONS = 3 };

static void ignore(sl_status status) {
    (void)status;
}

/* ---- memory: loads take no more than the saved bytes ---- */

static size_t limit; /* of the next allocation; 0: none */

static void *allocate(void *context, size_t bytes) {
    (void)context;
    PROMISE(limit == 0 || bytes <= limit);
    return malloc(bytes);
}

static void release(void *context, void *block) {
    (void)context;
    free(block);
}

/* ---- files to damage: grids and paths, with every treatment of null pivots ---- */

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
    PROMISE(sl_save_set_bytes(size, &set) == SL_OK);
    unsigned char *bytes = (unsigned char *)malloc(*size);
    PROMISE(bytes != NULL && sl_save_set_memory(bytes, *size, &set) == SL_OK);
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
    opt.null_pivots = way == SKIPPED || way == WEIGHTED ? SL_NULL_PIVOT_SKIP : SL_NULL_PIVOT_REFUSE;
    opt.mass = way == WEIGHTED ? mass : NULL;
    if (flags & HAS_SEVERAL && opt.null_pivots == SL_NULL_PIVOT_SKIP) {
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

/* ---- use ---- */

/* Every kind of call, on a factor whose structure was checked: any answer, but an end. */
static void use(const sl_symbolic *S, sl_factor *F) {
    const sl_int n = sl_symbolic_view(S).n, set[3] = {0, n / 2, n - 1};
    const sl_int count = n > 0 ? 3 : 0;
    const size_t ld = (size_t)n + 3;
    const matrix_t M = matrix_make(0, 0);
    const sl_csc A = view_of(&M);
    double *b = (double *)calloc(9 * ld, sizeof(double)),
           *x = (double *)calloc(9 * ld, sizeof(double));
    double log_abs, sign;
    sl_plan *P = NULL, *Q = NULL;
    sl_selected *Z = NULL;
    sl_region *R = NULL;
    sl_factor *G = NULL;
    sl_matrix *L = NULL;
    sl_options opt;
    PROMISE(b != NULL && x != NULL);
    for (size_t k = 0; k < 9 * ld; k++) {
        b[k] = 1.0 + (double)(k % 5);
    }
    ignore(sl_factor_solve(F, x, ld, b, ld, 9, NULL));
    ignore(sl_factor_solve(F, x, ld, b, ld, 1, NULL));
    ignore(sl_local_solve(F, set, count, set, count, x, ld, b, ld, 1, NULL, NULL));
    if (sl_plan_create(&P, S, set, count, set, count > 0 ? 1 : 0, NULL, NULL) == SL_OK) {
        ignore(sl_plan_solve(P, F, x, ld, b, ld, 2, NULL));
        ignore(sl_plan_solve_refined(P, F, x, ld, b, ld, 1, 1, NULL, NULL));
    }
    ignore(sl_inverse_diagonal(F, x, NULL, 0, NULL, NULL));
    ignore(sl_factor_defects(F, x, ld, b, ld, 1, NULL));
    ignore(sl_factor_logdet(F, &log_abs, &sign));
    ignore(sl_factor_lower(&L, F, NULL));
    if (sl_selected_create(&Z, F, NULL, 0, NULL, NULL) == SL_OK) {
        ignore(sl_selected_diagonal(Z, x, NULL, 0, NULL));
    }
    if (sl_region_create(&R, F, set, count, NULL, NULL, NULL) == SL_OK) {
        memset(&opt, 0, sizeof opt);
        opt.region = R;
        if (sl_plan_create(&Q, S, set, count, set, count, &opt, NULL) == SL_OK) {
            ignore(sl_plan_solve(Q, F, x, ld, b, ld, 1, NULL));
        }
    }
    ignore(sl_factor_create(&G, S, &A, NULL, NULL));
    ignore(sl_factor_refactor(F, &A, NULL));
    sl_factor_free(G);
    sl_plan_free(Q);
    sl_region_free(R);
    sl_selected_free(Z);
    sl_plan_free(P);
    sl_matrix_free(L);
    free(b);
    free(x);
}

/* Solves in a region, with b and x on its boundary and its whole subtrees. */
static void use_region(const sl_saved_set *set, const sl_region *R) {
    const sl_symbolic_arrays v = sl_symbolic_view(set->symbolic);
    const sl_region_arrays r = sl_region_view(R);
    sl_int *rows = (sl_int *)calloc((size_t)v.n + 1, sizeof *rows), count = 0;
    double *b = (double *)calloc(9 * ((size_t)v.n + 1), sizeof *b),
           *x = (double *)calloc(9 * ((size_t)v.n + 1), sizeof *x);
    sl_plan *P = NULL;
    sl_options opt;
    sl_stats stats;
    PROMISE(rows != NULL && b != NULL && x != NULL);
    PROMISE(r.n_boundary >= 0 && r.n_boundary <= v.n);
    for (; count < r.n_boundary; count++) {
        rows[count] = r.boundary[count];
        b[count] = 1.0 + count;
    }
    for (sl_int k = 0; k < r.n_roots && count < v.n; k++) {
        b[count] = -1.0;
        rows[count++] = v.perm[v.super_first[r.roots[k]]];
    }
    memset(&opt, 0, sizeof opt);
    opt.region = R;
    if (sl_plan_create(&P, set->symbolic, rows, count, rows, count, &opt, &stats) == SL_OK) {
        PROMISE(stats.plan.in_region);
        ignore(sl_plan_solve(P, set->factor, x, (size_t)v.n + 1, b, (size_t)v.n + 1, 1, NULL));
        ignore(sl_plan_solve(P, set->factor, x, (size_t)v.n + 1, b, (size_t)v.n + 1, 9, NULL));
    }
    sl_plan_free(P);
    free(rows);
    free(b);
    free(x);
}

/* Every kind of call on what comes with a factor, before and after a refactorization. */
static void use_set(const sl_saved_set *set) {
    const sl_int n = sl_symbolic_view(set->symbolic).n, row = n / 2;
    const matrix_t M = matrix_make(0, 0);
    const sl_csc A = view_of(&M);
    double *x = (double *)calloc((size_t)n + 1, sizeof *x);
    sl_region *R = NULL;
    size_t size = 0;
    PROMISE(x != NULL);
    ignore(sl_save_set_bytes(&size, set));
    for (sl_int k = 0; k < set->n_regions; k++) {
        use_region(set, set->regions[k]);
    }
    if (set->factor != NULL && n > 0) {
        ignore(sl_region_create(&R, set->factor, &row, 1, set->selected, NULL, NULL));
        ignore(sl_factor_refactor(set->factor, &A, NULL));
        sl_region_free(R);
    }
    for (sl_int k = 0; k < n && set->selected != NULL; k++) {
        ignore(sl_selected_diagonal(set->selected, x, &k, 1, NULL));
        ignore(sl_selected_entries(set->selected, x, &k, &row, 1, NULL));
    }
    if (set->selected != NULL) {
        ignore(sl_selected_diagonal(set->selected, x, NULL, 0, NULL));
        ignore(sl_selected_refactor(set->selected, set->factor, NULL));
    }
    for (sl_int k = 0; k < set->n_regions; k++) {
        ignore(sl_region_refactor(set->regions[k], set->factor, set->selected, NULL));
        use_region(set, set->regions[k]);
    }
    free(x);
}

static void load_set(const unsigned char *bytes, size_t size, int is_mapped,
                     sl_load_checks checks) {
    sl_options opt;
    sl_saved_set set;
    memset(&opt, 0, sizeof opt);
    opt.allocator.allocate = allocate;
    opt.allocator.release = release;
    limit = size + 4096;
    const sl_status status = is_mapped ? sl_map_set_memory(&set, bytes, size, checks, &opt)
                                       : sl_load_set_memory(&set, bytes, size, checks, &opt);
    limit = 0;
    PROMISE((set.symbolic != NULL) == (status == SL_OK));
    if (status == SL_OK && checks != SL_LOAD_TRUSTED) {
        use_set(&set);
    }
    sl_saved_set_free(&set);
}

static void load(const unsigned char *bytes, size_t size, int is_mapped, sl_load_checks checks) {
    sl_options opt;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    memset(&opt, 0, sizeof opt);
    opt.allocator.allocate = allocate;
    opt.allocator.release = release;
    limit = size + 4096;
    const sl_status status = is_mapped ? sl_map_memory(&S, &F, bytes, size, checks, &opt)
                                       : sl_load_memory(&S, &F, bytes, size, checks, &opt);
    limit = 0;
    PROMISE((S != NULL) == (status == SL_OK) && (S != NULL || F == NULL));
    if (F != NULL && checks != SL_LOAD_TRUSTED) {
        use(S, F);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
}

/* Loads and maps an aligned copy. */
static void try_bytes(const unsigned char *bytes, size_t size) {
    unsigned char *block = (unsigned char *)malloc(size + 63), *aligned;
    PROMISE(block != NULL);
    aligned = block + (64 - (uintptr_t)block % 64) % 64;
    memcpy(aligned, bytes, size);
    load(aligned, size, 1, SL_LOAD_TRUSTED);
    load(aligned, size, 1, SL_LOAD_CHECKED);
    load(aligned, size, 0, SL_LOAD_CHECKED);
    load(aligned, size, 0, SL_LOAD_VERIFIED);
    load_set(aligned, size, 1, SL_LOAD_TRUSTED);
    load_set(aligned, size, 1, SL_LOAD_VERIFIED);
    load_set(aligned, size, 0, SL_LOAD_CHECKED);
    free(block);
}

/* Damages a file: edits of 4 bytes, of which two name a word of it. */
static void edit(unsigned char *file, size_t size, const uint8_t *data, size_t count) {
    for (; count >= 4; data += 4, count -= 4) {
        const size_t word = (data[0] + 256u * data[1]) % (size / 4);
        unsigned char *at = file + 4 * word;
        const uint32_t value = data[3], old = saved_u32(at);
        switch (data[2] % 8) {
        case 0:
            saved_put32(at, value);
            break;
        case 1:
            saved_put32(at, old + value);
            break;
        case 2:
            saved_put32(at, old - value);
            break;
        case 3:
            saved_put32(at, old ^ 1u << value % 32);
            break;
        case 4:
            saved_put32(at, (uint32_t)INT32_MAX - value);
            break;
        case 5:
            saved_put32(at, 0u - value);
            break;
        case 6: /* the word of another place */
            saved_put32(at, saved_u32(file + 4 * (word + value < size / 4 ? word + value : 0)));
            break;
        default:
            saved_reverse(at, 4);
        }
    }
}

/* An undamaged file answers as what was saved, in either byte order. */
static void check_answers(const base_t *base, const unsigned char *bytes) {
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    double x[MOST];
    PROMISE(sl_load_memory(&S, &F, bytes, base->size, SL_LOAD_VERIFIED, NULL) == SL_OK);
    const sl_int n = sl_symbolic_view(S).n;
    PROMISE(ask(F, n, x) == base->status);
    for (sl_int i = 0; base->status == SL_OK && i < n; i++) {
        PROMISE(x[i] == base->x[i]);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static base_t bases[FLAGS * BASES];
    if (size >= 8 && data[0] == 0x89) { /* a file */
        try_bytes(data, size);
        unsigned char *copy = (unsigned char *)malloc(size);
        PROMISE(copy != NULL);
        memcpy(copy, data, size);
        saved_repair(copy, size);
        try_bytes(copy, size);
        free(copy);
    } else if (size >= 2) { /* a base, flags and edits */
        const int kind = data[0] % BASES, flags = (data[1] >> 1) % FLAGS;
        base_t *base = &bases[kind + flags * BASES];
        if (base->bytes == NULL) {
            *base = base_make(kind, flags);
        }
        unsigned char *copy = (unsigned char *)malloc(base->size);
        PROMISE(copy != NULL);
        memcpy(copy, base->bytes, base->size);
        if (data[1] & 1) {
            saved_change_order(copy);
        }
        if (size < 6) {
            check_answers(base, copy);
        }
        edit(copy, base->size, data + 2, size - 2);
        if (!(data[1] & 1)) {
            saved_repair(copy, base->size);
        }
        try_bytes(copy, base->size);
        free(copy);
    }
    return 0;
}
