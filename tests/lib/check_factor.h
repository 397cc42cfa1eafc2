/* check_factor.h: validators of permutations, trees, analyses and factors */
#ifndef SL_TEST_CHECK_FACTOR_H
#define SL_TEST_CHECK_FACTOR_H

#include "gen_matrices.h"
#include "dense_reference.h"

/* NULL, or what is wrong with perm and iperm. */
static inline const char *check_permutation(sl_int n, const sl_int *perm, const sl_int *iperm) {
    char *seen = (char *)test_array((size_t)n, 1);
    const char *wrong = NULL;
    for (sl_int k = 0; k < n && !wrong; k++) {
        if (perm[k] < 0 || perm[k] >= n) {
            wrong = "perm out of range";
        } else if (seen[perm[k]]++) {
            wrong = "perm has a row twice";
        } else if (iperm[perm[k]] != k) {
            wrong = "iperm is not the inverse of perm";
        }
    }
    free(seen);
    return wrong;
}

/* NULL, or the invariant of supernodes, rows and panels in sl_symbolic_arrays that does not hold.
 * Needs no dense matrix. */
static inline const char *check_supernodes(const sl_symbolic_arrays *v) {
    if (v->super_first[0] != 0 || v->super_first[v->n_supers] != v->n) {
        return "supernodes do not span the columns";
    }
    if (v->rows_begin[0] != 0 || v->panel_begin[0] != 0) {
        return "rows or panels do not begin at 0";
    }
    for (sl_int s = 0; s < v->n_supers; s++) {
        sl_int last = v->super_first[s + 1] - 1;
        if (last < v->super_first[s]) {
            return "empty supernode";
        }
        for (sl_int k = v->super_first[s]; k <= last; k++) {
            if (v->super_of[k] != s) {
                return "super_of contradicts super_first";
            }
        }
        sl_off begin = v->rows_begin[s], end = v->rows_begin[s + 1];
        if (end < begin) {
            return "rows_begin decreases";
        }
        for (sl_off q = begin; q < end; q++) {
            if (v->rows[q] >= v->n || v->rows[q] <= (q > begin ? v->rows[q - 1] : last)) {
                return "rows not ascending, or not below the supernode";
            }
        }
        if (v->super_parent[s] != (begin < end ? v->super_of[v->rows[begin]] : -1)) {
            return "super_parent is not the supernode of the first row";
        }
        const sl_off stored = v->panel_begin[s] + ref_panel_size(ref_width(v, s), ref_height(v, s));
        const sl_int next = s + 1 < v->n_supers ? ref_width(v, s + 1) : 1;
        if (v->panel_begin[s + 1] != ref_panel_start(next, stored)) {
            return "wrong panel size";
        }
        /* the rows beyond the parent's columns must be rows of the parent */
        if (begin < end) {
            sl_int up = v->super_parent[s];
            sl_off at = v->rows_begin[up];
            for (sl_off q = begin; q < end; q++) {
                if (v->rows[q] >= v->super_first[up + 1]) {
                    while (at < v->rows_begin[up + 1] && v->rows[at] < v->rows[q]) {
                        at++;
                    }
                    if (at == v->rows_begin[up + 1] || v->rows[at] != v->rows[q]) {
                        return "a row is missing in the parent supernode";
                    }
                }
            }
        }
    }
    return NULL;
}

/* NULL, or the invariant of the separator tree in sl_symbolic_arrays that does not hold. */
static inline const char *check_septree(const sl_symbolic_arrays *v, const sl_csc *A) {
    if (v->n_nodes == 0) {
        return v->node_of || v->node_parent || v->node_level ? "arrays without a tree" : NULL;
    }
    sl_int *sizes = test_ints((size_t)v->n_nodes);
    const char *wrong = NULL;
    for (sl_int k = 0; k < v->n && !wrong; k++) {
        if (v->node_of[k] < 0 || v->node_of[k] >= v->n_nodes) {
            wrong = "a column without a node";
        } else {
            sizes[v->node_of[k]]++;
        }
    }
    for (sl_int t = 0; t < v->n_nodes && !wrong; t++) {
        const sl_int up = v->node_parent[t];
        if (sizes[t] == 0) {
            wrong = "an empty node";
        } else if (up != -1 && (up <= t || up >= v->n_nodes)) {
            wrong = "a parent before its child";
        } else if (v->node_level[t] != (up == -1 ? 0 : v->node_level[up] + 1)) {
            wrong = "wrong level";
        }
    }
    for (sl_int j = 0; j < A->n_cols && !wrong; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            sl_int a = v->node_of[v->iperm[j]], b = v->node_of[v->iperm[A->i[p]]];
            /* move the lower node up */
            while (a != b && a != -1 && b != -1) {
                if (a < b) {
                    a = v->node_parent[a];
                } else {
                    b = v->node_parent[b];
                }
                if (a == -1 || b == -1) {
                    wrong = "an entry joins two nodes of different trees";
                }
            }
            /* If both moved, neither node is an ancestor of the other. */
            if (!wrong && a != v->node_of[v->iperm[j]] && a != v->node_of[v->iperm[A->i[p]]]) {
                wrong = "an entry joins two nodes that a separator divides";
            }
        }
    }
    free(sizes);
    return wrong;
}

/* NULL, or what shows that parent is not postordered: the descendants of a node must directly
 * precede it. */
static inline const char *check_postorder(sl_int n, const sl_int *parent) {
    sl_int *size = test_ints((size_t)n), *first = test_ints((size_t)n);
    const char *wrong = NULL;
    for (sl_int k = 0; k < n; k++) {
        first[k] = k;
    }
    /* children come before parents: first[k] is final when k is visited */
    for (sl_int k = 0; k < n && !wrong; k++) {
        size[k]++;
        if (k - first[k] + 1 != size[k]) {
            wrong = "not a postorder";
        } else if (parent[k] != -1 && (parent[k] <= k || parent[k] >= n)) {
            wrong = "a parent that is not after its child";
        } else if (parent[k] != -1) {
            sl_int up = parent[k];
            size[up] += size[k];
            first[up] = first[k] < first[up] ? first[k] : first[up];
        }
    }
    free(size);
    free(first);
    return wrong;
}

/* Compares the tree, the counts and the stored rows with dense symbolic elimination. exact: no row
 * is stored that L does not have. */
static inline const char *check_structure(const sl_symbolic_arrays *v, const sl_csc *A, int exact) {
    sl_int n = v->n, *parent = test_ints((size_t)n), *counts = test_ints((size_t)n);
    char *M = ref_pattern(A), *fill = ref_permute_pattern(n, M, v->perm), *stored = NULL;
    const char *wrong = NULL;
    ref_fill(n, fill);
    ref_etree(n, fill, parent);
    ref_counts(n, fill, counts);
    for (sl_int k = 0; k < n && !wrong; k++) {
        wrong = parent[k] != v->parent[k]   ? "wrong parent"
                : counts[k] != v->counts[k] ? "wrong count"
                                            : NULL;
    }
    stored = (char *)test_array((size_t)n * (size_t)n, 1);
    for (sl_int s = 0; s < v->n_supers; s++) {
        for (sl_int c = 0; c < ref_width(v, s); c++) {
            for (sl_int r = c; r < ref_height(v, s); r++) {
                AT(stored, ref_row(v, s, r), v->super_first[s] + c) = 1;
            }
        }
    }
    for (sl_int j = 0; j < n && !wrong; j++) {
        for (sl_int i = j; i < n && !wrong; i++) {
            if (AT(fill, i, j) && !AT(stored, i, j)) {
                wrong = "an entry of L is not stored";
            } else if (exact && AT(stored, i, j) && !AT(fill, i, j)) {
                wrong = "a zero is stored without relaxation";
            }
        }
    }
    free(parent);
    free(counts);
    free(M);
    free(fill);
    free(stored);
    return wrong;
}

/* L as a dense matrix, expanded from the panels. *wrong is NULL, or says that a stored value which
 * must be 0 is not. */
static inline double *check_expand(const sl_factor *F, const char **wrong) {
    sl_factor_arrays f = sl_factor_view(F);
    sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    sl_int n = v.n;
    double *L = test_reals((size_t)n * (size_t)n);
    *wrong = NULL;
    for (sl_int s = 0; s < v.n_supers; s++) {
        sl_int width = ref_width(&v, s), height = ref_height(&v, s);
        const double *panel = f.L + v.panel_begin[s];
        for (sl_int r = 0; r < (width == 1 ? height : (height + 7) / 8 * 8); r++) {
            for (sl_int c = 0; c < width; c++) {
                sl_off at = ref_position(width, r, c);
                double value = at < 0 ? 0.0 : panel[at];
                if (r >= height || r <= c) {
                    *wrong = value != 0.0 ? "a padding, diagonal or upper entry is not 0" : *wrong;
                } else {
                    AT(L, ref_row(&v, s, r), v.super_first[s] + c) = value;
                }
            }
        }
    }
    for (sl_int k = 0; k < n; k++) {
        AT(L, k, k) = 1.0;
    }
    return L;
}

/* NULL, or a message if |P A P' - L D L'| > c n eps |L| |D| |L'| in some entry. This is the
 * entrywise bound of elimination; it does not hide pivot growth. c = 4 covers products, sums and
 * the division. */
static inline const char *check_product(sl_int n, const double *C, const double *L,
                                        const double *D) {
    double *sum = test_reals((size_t)n), *size = test_reals((size_t)n);
    const char *wrong = NULL;
    for (sl_int j = 0; j < n && !wrong; j++) { /* column j of L D L' */
        for (sl_int i = j; i < n; i++) {
            sum[i] = size[i] = 0.0;
        }
        for (sl_int k = 0; k <= j; k++) {
            const double factor = D[k] * AT(L, j, k);
            for (sl_int i = j; i < n && AT(L, j, k) != 0.0; i++) {
                const double term = AT(L, i, k) * factor;
                sum[i] += term;
                size[i] += fabs(term);
            }
        }
        for (sl_int i = j; i < n; i++) {
            if (!(fabs(AT(C, i, j) - sum[i]) <= 4.0 * (double)n * DBL_EPSILON * size[i])) {
                wrong = "L D L' is not P A P'";
            }
        }
    }
    free(sum);
    free(size);
    return wrong;
}

static inline const char *check_factor(const sl_factor *F, const sl_csc *A) {
    sl_factor_arrays f = sl_factor_view(F);
    sl_symbolic_arrays v = sl_symbolic_view(f.symbolic);
    const char *wrong = NULL;
    double *M = ref_dense(A), *C = ref_permute(v.n, M, v.perm), *L = check_expand(F, &wrong);
    if (!wrong) {
        wrong = check_product(v.n, C, L, f.D);
    }
    free(M);
    free(C);
    free(L);
    return wrong;
}

/* Prints the reason and fails if check returns one. */
#define NOTHING_WRONG(check) \
    do { \
        const char *wrong_ = (check); \
        if (wrong_) { \
            print_error("%s: %s\n", #check, wrong_); \
            fail(); \
        } \
    } while (0)

/* Both analyses have the same arrays. */
static inline void assert_same_arrays(const sl_symbolic *S, const sl_symbolic *T) {
    sl_symbolic_arrays s = sl_symbolic_view(S), t = sl_symbolic_view(T);
    assert_int_equal(s.n, t.n);
    assert_int_equal(s.n_supers, t.n_supers);
    assert_int_equal(s.n_nodes, t.n_nodes);
#define SAME(array, count) \
    if ((count) > 0) assert_memory_equal(s.array, t.array, (size_t)(count) * sizeof *s.array)
    SAME(perm, s.n);
    SAME(iperm, s.n);
    SAME(parent, s.n);
    SAME(counts, s.n);
    SAME(super_first, s.n_supers + 1);
    SAME(super_of, s.n);
    SAME(super_parent, s.n_supers);
    SAME(rows_begin, s.n_supers + 1);
    SAME(rows, s.rows_begin[s.n_supers]);
    SAME(panel_begin, s.n_supers + 1);
    assert_true((s.pairs == NULL) == (t.pairs == NULL));
    SAME(pairs, s.pairs != NULL ? s.n : 0);
    SAME(node_of, s.n_nodes > 0 ? s.n : 0);
    SAME(node_parent, s.n_nodes);
    SAME(node_level, s.n_nodes);
#undef SAME
}

/* An analysis of which each allocation fails once leaves nothing behind. */
static inline void analysis_may_lack_memory(const sl_csc *A, sl_ordering ordering) {
    sl_status status = SL_ERR_MEMORY;
    for (int64_t k = 0; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sl_symbolic *S = NULL;
        opt.ordering = ordering;
        counter.fail_at = k;
        status = sl_symbolic_create(&S, A, &opt, NULL);
        assert_true(status == SL_OK || (status == SL_ERR_MEMORY && S == NULL));
        sl_symbolic_free(S);
        COUNTER_CLEAN(&counter);
    }
}

#endif
