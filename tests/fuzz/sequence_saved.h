/* sequence_saved.h: the calls of fuzz_sequence.c that save objects and load them again */
#ifndef SL_FUZZ_SEQUENCE_SAVED_H
#define SL_FUZZ_SEQUENCE_SAVED_H

#include "sequence_objects.h"
#include "tests/lib/saved_pair.h"

/* An aligned place for saved bytes; *block is to be freed. */
static unsigned char *aligned_room(size_t bytes, unsigned char **block) {
    *block = (unsigned char *)malloc(bytes + 63);
    PROMISE(*block != NULL);
    return *block + (64 - (uintptr_t)*block % 64) % 64;
}

/* Options of loads; the bits of solves are those of one instruction set. */
static sl_options load_options(const factor_t *f) {
    sl_options opt = options();
    sl_stats stats;
    stats.factor = sl_factor_view(f->F).info;
    opt.isa = stats.factor.isa;
    return opt;
}

/* Solves with a factor and with the loaded one have the same bits. */
static void compare_loaded(const factor_t *f, const sl_factor *F, const double *B) {
    double X[MOST], Y[MOST];
    const sl_status loaded = sl_factor_solve(F, X, MOST, B, MOST, 1, work);
    const sl_status saved = sl_factor_solve(f->F, Y, MOST, B, MOST, 1, work);
    PROMISE(loaded == saved);
    for (sl_int i = 0; loaded == SL_OK && i < order_of(f); i++) {
        check_same(X[i], Y[i]);
    }
}

/* A factor that was saved and loaded, or whose bytes are used in place, gives the same bits. */
static void copy(input_t *in) {
    const factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in);
    sl_symbolic *S = NULL;
    sl_factor *F = NULL;
    size_t bytes = 0;
    double B[MOST];
    if (!f->F) {
        return;
    }
    fill(in, B, MOST);
    sl_status status = pair_save_memory(NULL, &bytes, analyses[f->analysis].S, f->F);
    PROMISE(status == (f->is_valid ? SL_OK : SL_ERR_STALE));
    if (status != SL_OK) {
        return;
    }
    unsigned char *block, *aligned = aligned_room(bytes, &block);
    PROMISE(pair_save_memory(aligned, &bytes, analyses[f->analysis].S, f->F) == SL_OK);
    const sl_options opt = load_options(f);
    const unsigned checks = (unsigned)(form / 2 % 3);
    status = form % 2 ? pair_map_memory(&S, &F, aligned, bytes, checks, &opt)
                      : pair_load_memory(&S, &F, aligned, bytes, checks, &opt);
    PROMISE((F != NULL) == (status == SL_OK) && (S != NULL) == (status == SL_OK));
    PROMISE(status == SL_OK || no_memory(status));
    left = -1;
    if (F) {
        compare_loaded(f, F, B);
    }
    sl_factor_free(F);
    sl_symbolic_free(S);
    free(block);
}

/* Solves in a region, with b and x on its boundary, or without one in a row; returns the status. */
static sl_status solve_in(const sl_symbolic *S, const sl_factor *F, const sl_region *R, double *X) {
    const sl_region_arrays v = sl_region_view(R);
    const sl_symbolic_arrays s = sl_symbolic_view(S);
    sl_int rows[MOST], count = 0;
    double B[MOST];
    sl_plan *P = NULL;
    sl_stats stats;
    sl_options opt = options();
    opt.region = R;
    for (; count < v.n_boundary; count++) {
        rows[count] = v.boundary[count];
    }
    for (sl_int k = 0; k < v.n_roots; k++) {
        rows[count++] = s.perm[s.super_first[v.roots[k]]];
    }
    for (sl_int k = 0; k < MOST; k++) {
        B[k] = 1.0 + k;
        X[k] = 0.0;
    }
    PROMISE(sl_plan_create(&P, S, rows, count, rows, count, &opt, &stats) == SL_OK);
    PROMISE(stats.plan.in_region);
    const sl_status status = sl_plan_solve(P, F, X, MOST, B, MOST, 1, work);
    sl_plan_free(P);
    return status;
}

/* Whether an object of analysis and values is of the numbers of f, as far as these show it. */
static int may_belong(const factor_t *f, int analysis, const double *a) {
    return analysis == f->analysis && memcmp(a, f->v.a, sizeof f->v.a) == 0;
}

/* What was loaded answers as what was saved, bit for bit. */
static void compare_sets(const factor_t *f, const sl_saved_set *saved, const sl_saved_set *loaded,
                         const double *B) {
    double x[MOST], y[MOST];
    PROMISE((saved->factor != NULL) == (loaded->factor != NULL));
    PROMISE((saved->selected != NULL) == (loaded->selected != NULL));
    PROMISE(saved->n_regions == loaded->n_regions);
    if (loaded->factor) {
        compare_loaded(f, loaded->factor, B);
    }
    for (sl_int row = 0; loaded->selected && row < order_of(f); row++) {
        const sl_status status = sl_selected_entries(loaded->selected, x, &row, NULL, 1, NULL);
        PROMISE(status == sl_selected_entries(saved->selected, y, &row, NULL, 1, NULL));
        PROMISE(status == SL_OK || status == SL_ERR_OTHER_PATTERN);
        if (status == SL_OK) {
            check_same(x[0], y[0]);
        }
    }
    for (sl_int k = 0; k < loaded->n_regions; k++) {
        const sl_status status = solve_in(loaded->symbolic, loaded->factor, loaded->regions[k], x);
        PROMISE(status == solve_in(saved->symbolic, saved->factor, saved->regions[k], y));
        PROMISE(status == SL_OK || status == SL_ERR_INCONSISTENT || status == SL_ERR_NOT_FINITE);
        for (int i = 0; status == SL_OK && i < MOST; i++) {
            check_same(x[i], y[i]);
        }
    }
}

/* A set with a selected inverse and regions: refused if one of them is of other numbers. */
static void copy_set(input_t *in) {
    factor_t *f = &factors[take(in) % FACTORS];
    const int form = take(in), which = take(in);
    sl_region *both[REGIONS];
    sl_saved_set set, loaded;
    size_t bytes = 0;
    double B[MOST];
    if (!f->F) {
        return;
    }
    fill(in, B, MOST);
    const selected_t *z = &selected[which % SELECTED];
    int may_be_saved = 1;
    memset(&set, 0, sizeof set);
    memset(&loaded, 0, sizeof loaded);
    set.symbolic = analyses[f->analysis].S;
    set.factor = form % 2 ? f->F : NULL;
    set.regions = both;
    if (which / 2 % 2 && z->Z) {
        set.selected = z->Z;
        may_be_saved &= form % 2 ? may_belong(f, z->analysis, z->a) : z->analysis == f->analysis;
    }
    for (int k = 0; k < REGIONS && form % 2; k++) {
        if (which >> (2 + k) & 1 && regions[k].R) {
            both[set.n_regions++] = regions[k].R;
            may_be_saved &= may_belong(f, regions[k].analysis, regions[k].a);
        }
    }
    sl_status status = sl_save(NULL, NULL, &bytes, &set, NULL);
    PROMISE(status == SL_OK || is_apart(status));
    PROMISE(is_apart(status) || (may_be_saved && (f->is_valid || !set.factor)));
    if (status != SL_OK) {
        return;
    }
    unsigned char *block, *aligned = aligned_room(bytes, &block);
    PROMISE(sl_save(NULL, aligned, &bytes, &set, NULL) == SL_OK);
    const sl_options opt = load_options(f);
    const unsigned checks = (unsigned)(form / 4 % 3);
    status = form / 2 % 2 ? sl_load(&loaded, NULL, aligned, bytes, checks | SL_LOAD_MAPPED, &opt)
                          : sl_load(&loaded, NULL, aligned, bytes, checks, &opt);
    PROMISE((loaded.symbolic != NULL) == (status == SL_OK));
    PROMISE(status == SL_OK || no_memory(status));
    left = -1;
    if (status == SL_OK) {
        compare_sets(f, &set, &loaded, B);
    }
    sl_saved_set_free(&loaded);
    free(block);
}

#endif
