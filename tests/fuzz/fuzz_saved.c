/* fuzz_saved.c: loads, maps and uses saved factors, some with regions and a selected inverse, that
 * are arbitrary bytes, or damaged in a few words with checksums that agree; what is not damaged has
 * to give the answers of what was saved */
#include "saved_bases.h"
#include "tests/lib/saved_format.h"
#include "tests/lib/saved_pair.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

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
        ignore(sl_plan_solve_regularized(P, F, x, ld, b, ld, 1, 1, NULL, NULL));
    }
    ignore(sl_inverse_diagonal(F, x, NULL, SL_ALL, NULL, NULL));
    ignore(sl_factor_defects(F, x, ld, b, ld, 1, NULL));
    ignore(sl_factor_logdet(F, &log_abs, &sign));
    ignore(sl_factor_lower(&L, F, NULL));
    if (sl_selected_create(&Z, F, NULL, SL_ALL, NULL, NULL) == SL_OK) {
        ignore(sl_selected_entries(Z, x, NULL, NULL, SL_ALL, NULL));
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
    ignore(sl_save(NULL, NULL, &size, set, NULL));
    for (sl_int k = 0; k < set->n_regions; k++) {
        use_region(set, set->regions[k]);
    }
    if (set->factor != NULL && n > 0) {
        ignore(sl_region_create(&R, set->factor, &row, 1, set->selected, NULL, NULL));
        ignore(sl_factor_refactor(set->factor, &A, NULL));
        sl_region_free(R);
    }
    for (sl_int k = 0; k < n && set->selected != NULL; k++) {
        ignore(sl_selected_entries(set->selected, x, &k, NULL, 1, NULL));
        ignore(sl_selected_entries(set->selected, x, &k, &row, 1, NULL));
    }
    if (set->selected != NULL) {
        ignore(sl_selected_entries(set->selected, x, NULL, NULL, SL_ALL, NULL));
        ignore(sl_selected_refactor(set->selected, set->factor, NULL));
    }
    for (sl_int k = 0; k < set->n_regions; k++) {
        ignore(sl_region_refactor(set->regions[k], set->factor, set->selected, NULL));
        use_region(set, set->regions[k]);
    }
    free(x);
}

static void load_set(const unsigned char *bytes, size_t size, int is_mapped, unsigned checks) {
    sl_options opt;
    sl_saved_set set;
    memset(&set, 0, sizeof set);
    memset(&opt, 0, sizeof opt);
    opt.allocator.allocate = allocate;
    opt.allocator.release = release;
    limit = size + 4096;
    const sl_status status = is_mapped
                                 ? sl_load(&set, NULL, bytes, size, checks | SL_LOAD_MAPPED, &opt)
                                 : sl_load(&set, NULL, bytes, size, checks, &opt);
    limit = 0;
    PROMISE((set.symbolic != NULL) == (status == SL_OK));
    if (status == SL_OK && checks != SL_LOAD_TRUSTED) {
        use_set(&set);
    }
    sl_saved_set_free(&set);
}

static void load(const unsigned char *bytes, size_t size, int is_mapped, unsigned checks) {
    sl_options opt;
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    memset(&opt, 0, sizeof opt);
    opt.allocator.allocate = allocate;
    opt.allocator.release = release;
    limit = size + 4096;
    const sl_status status = is_mapped ? pair_map_memory(&S, &F, bytes, size, checks, &opt)
                                       : pair_load_memory(&S, &F, bytes, size, checks, &opt);
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

/* Sets a word of 8 or 4 bytes to the ends of its range, or beside the number of rows. */
static void set_extreme(unsigned char *file, size_t size, size_t word, uint32_t value) {
    const uint64_t numbers = saved_u64(saved_entry(file, 0) + SAVED_OFFSET) % (size / 8);
    const uint64_t n = saved_u64(file + numbers);
    const uint64_t extreme = saved_extreme((int)(value / 2 % SAVED_EXTREMES), n);
    if (value % 2 == 0 && word + 1 < size / 4) {
        saved_put64(file + 4 * (word - word % 2), extreme);
    } else {
        saved_put32(file + 4 * word, (uint32_t)(extreme >> (extreme > UINT32_MAX ? 32 : 0)));
    }
}

/* Damages a file: edits of 4 bytes, of which two name a word of it. */
static void edit(unsigned char *file, size_t size, const uint8_t *data, size_t count) {
    for (; count >= 4; data += 4, count -= 4) {
        const size_t word = (data[0] + 256u * data[1]) % (size / 4);
        unsigned char *at = file + 4 * word;
        const uint32_t value = data[3], old = saved_u32(at);
        if (data[2] >= 0xc0) {
            set_extreme(file, size, word, value);
            continue;
        }
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
    PROMISE(pair_load_memory(&S, &F, bytes, base->size, SL_LOAD_VERIFIED, NULL) == SL_OK);
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
