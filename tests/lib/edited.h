/* edited.h: a random edit of a generated matrix: rows and entries that come and go */
#ifndef SL_TEST_EDITED_H
#define SL_TEST_EDITED_H

#include "factored.h"

/* How the rows that stay are numbered. */
typedef enum edit_numbers_t {
    EDIT_IN_ORDER,  /* as before, the new ones last */
    EDIT_INTO_GAPS, /* the last ones fill the gaps */
    EDIT_SHUFFLED,
    EDIT_NUMBERS
} edit_numbers_t;

/* What changes, in percent of the rows; a cluster is a range of rows that are near each other. */
typedef struct edit_kind_t {
    int removed, added, joined; /* rows gone, new rows, new entries between old rows */
    int clustered;
    edit_numbers_t numbers;
} edit_kind_t;

/* From no edit at all to one of a tenth of the rows, in new numbers. */
static const edit_kind_t edit_kinds[4] = {{0, 0, 0, 0, EDIT_IN_ORDER},
                                          {2, 2, 2, 1, EDIT_IN_ORDER},
                                          {1, 3, 0, 0, EDIT_INTO_GAPS},
                                          {10, 12, 10, 1, EDIT_SHUFFLED}};

/* Numbers what stays of n rows, and `added` more. is_gone: n. Returns how many rows there are. */
static inline sl_int edited_numbers(sl_int *new_of, const char *is_gone, sl_int n, sl_int added,
                                    edit_numbers_t numbers, uint64_t *state) {
    sl_int count = 0;
    for (sl_int i = 0; i < n; i++) {
        count += !is_gone[i];
    }
    const sl_int total = count + added;
    sl_int *shuffled = test_ints((size_t)total), next = 0, gap = 0;
    gen_permutation(shuffled, total, gen_bits(state));
    for (sl_int i = 0; i < n; i++) {
        new_of[i] = is_gone[i] ? -1 : next++;
    }
    for (sl_int i = n - 1; i >= count && numbers == EDIT_INTO_GAPS; i--) {
        while (gap < count && !is_gone[gap]) {
            new_of[gap] = gap;
            gap++;
        }
        new_of[i] = is_gone[i] ? -1 : gap++;
    }
    for (sl_int i = 0; i < count && numbers == EDIT_INTO_GAPS; i++) {
        new_of[i] = is_gone[i] ? -1 : i;
    }
    for (sl_int i = 0; i < n && numbers == EDIT_SHUFFLED; i++) {
        new_of[i] = is_gone[i] ? -1 : shuffled[new_of[i]];
    }
    free(shuffled);
    return total;
}

/* A row of n that is near `center`, or any. */
static inline sl_int edited_row(sl_int n, sl_int center, int clustered, uint64_t *state) {
    const sl_int width = n / 16 + 3;
    return clustered ? (center + gen_below(state, width)) % n : gen_below(state, n);
}

/* An entry of the lower triangle of t, once. */
static inline void edited_add(gen_list_t *t, char *has, sl_int i, sl_int j, double x) {
    const size_t n = (size_t)t->n;
    const size_t at = (size_t)(i > j ? i : j) * n + (size_t)(i > j ? j : i);
    if (!has[at]) {
        has[at] = 1;
        gen_add(t, i, j, x);
    }
}

/* Edits t, whose diagonal is dominant in the end. new_of: t->n rows, room for more. */
static inline gen_list_t edited_list(const gen_list_t *t, edit_kind_t kind, sl_int *new_of,
                                     uint64_t *state) {
    const sl_int n = t->n, added = (n * kind.added + 99) / 100;
    const sl_int center = n > 0 ? gen_below(state, n) : 0;
    char *is_gone = (char *)test_array((size_t)n + 1, 1);
    for (sl_int k = 0; k < n * kind.removed / 100; k++) {
        is_gone[edited_row(n, center, kind.clustered, state)] = 1;
    }
    gen_list_t e = gen_list(edited_numbers(new_of, is_gone, n, added, kind.numbers, state));
    char *is_old = (char *)test_array((size_t)e.n + 1, 1);
    char *has = (char *)test_array((size_t)e.n * (size_t)e.n + 1, 1);
    for (sl_int i = 0; i < n; i++) {
        if (new_of[i] >= 0) {
            is_old[new_of[i]] = 1;
        }
    }
    for (size_t k = 0; k < t->count; k++) {
        const sl_int i = new_of[t->row[k]], j = new_of[t->col[k]];
        const int is_near = !kind.clustered || (t->row[k] - center + n) % n < n / 16;
        const int is_dropped = kind.joined > 0 && is_near && gen_below(state, 30) == 0;
        if (i >= 0 && j >= 0 && i != j && !is_dropped) {
            edited_add(&e, has, i, j, t->x[k]);
        }
    }
    for (sl_int v = 0; v < e.n && n > 0; v++) { /* new rows join old and new ones */
        for (int k = 0; k < 3 && !is_old[v]; k++) {
            const sl_int u = gen_below(state, 4) == 0
                                 ? gen_below(state, e.n)
                                 : new_of[edited_row(n, center, kind.clustered, state)];
            if (u >= 0 && u != v) {
                edited_add(&e, has, v, u, gen_real(state));
            }
        }
    }
    for (sl_int k = 0; k < n * kind.joined / 100; k++) {
        const sl_int i = new_of[edited_row(n, center, kind.clustered, state)],
                     j = new_of[edited_row(n, center, kind.clustered, state)];
        if (i >= 0 && j >= 0 && i != j) {
            edited_add(&e, has, i, j, gen_real(state));
        }
    }
    gen_dominate(&e, 1, state);
    free(is_gone);
    free(is_old);
    free(has);
    return e;
}

/* An analysis of M is right: order, tree, supernodes, structure; a factor over it solves. */
static inline void edited_check(const sl_symbolic *T, const gen_matrix_t *M, int exact) {
    const sl_symbolic_arrays v = sl_symbolic_view(T);
    const char *wrong = check_permutation(v.n, v.perm, v.iperm);
    sl_factor *F = NULL;
    wrong = wrong ? wrong : check_postorder(v.n_supers, v.super_parent);
    wrong = wrong ? wrong : check_supernodes(&v);
    wrong = wrong ? wrong : check_structure(&v, &M->view, exact);
    assert_null(wrong);
    SL_CHECK(sl_factor_create(&F, T, &M->view, NULL, NULL));
    const size_t n = (size_t)v.n;
    double *b = test_reals(n), *x = test_reals(n), *r = test_reals(n), error = 0.0;
    gen_reals(b, n, 5);
    SL_CHECK(sl_factor_solve(F, x, n, b, n, 1, NULL));
    SL_CHECK(sl_csc_residual(&M->view, r, n, &error, x, n, b, n, 1));
    assert_true(error <= 1e-14);
    free(b);
    free(x);
    free(r);
    sl_factor_free(F);
}

#endif
