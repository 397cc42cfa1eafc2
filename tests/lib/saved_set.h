/* saved_set.h: factors with selected inverses and regions, saved, and whether two sets are equal */
#ifndef SL_TEST_SAVED_SET_H
#define SL_TEST_SAVED_SET_H

#include "check_region.h"
#include "saved.h"

enum { SETS_REGIONS = 4, SETS_ROWS = 6 };

/* A factor of saved_case_make with a selected inverse and regions, as far as it can have them. */
typedef struct set_case_t {
    saved_case_t c;
    sl_saved_set set;
    sl_region *regions[SETS_REGIONS];
} set_case_t;

/* A way to create a set from saved bytes. */
typedef sl_status (*set_call_t)(sl_saved_set *set, const void *memory, size_t bytes,
                                unsigned checks, const sl_options *opt);

static sl_status set_load(sl_saved_set *set, const void *memory, size_t bytes, unsigned checks,
                          const sl_options *opt) {
    return sl_load(set, NULL, memory, bytes, checks, opt);
}

static sl_status set_map(sl_saved_set *set, const void *memory, size_t bytes, unsigned checks,
                         const sl_options *opt) {
    return sl_load(set, NULL, memory, bytes, checks | SL_LOAD_MAPPED, opt);
}

static const set_call_t set_calls[2] = {set_load, set_map};

/* is_whole: the selected inverse is that of all rows, not of a few. */
static inline set_case_t set_case_make(int way, gen_kind_t kind, sl_int size, int style,
                                       int is_whole, const sl_options *from) {
    set_case_t q;
    memset(&q, 0, sizeof q);
    q.c = saved_case_make(way, kind, size, style, from);
    const sl_factor *F = q.c.y.F;
    const sl_int n = q.c.y.M.view.n_rows, count = n < SETS_ROWS ? n : SETS_ROWS;
    sl_int *rows = test_ints((size_t)n); /* shuffled; the first count are the set */
    sl_status status;
    q.set.symbolic = q.c.y.S;
    q.set.factor = q.c.y.F;
    gen_set(rows, count, n, 8);
    status = sl_selected_create(&q.set.selected, F, is_whole ? NULL : rows,
                                is_whole ? SL_ALL : count, FOR_REGION(from), NULL);
    assert_true(status == SL_OK || way >= SAVED_PIVOTED);
    /* a few rows, all rows, one row out of the selected inverse, and none */
    const sl_int counts[SETS_REGIONS] = {count, n, n > 0, 0};
    for (int k = 0; k < SETS_REGIONS; k++) {
        status =
            sl_region_create(&q.regions[k], F, k == 1 ? NULL : rows, k == 1 ? SL_ALL : counts[k],
                             k == 2 ? q.set.selected : NULL, FOR_REGION(from), NULL);
        /* wrong signs make L grow, too much for some orders */
        assert_true(status == SL_OK || status == SL_ERR_UNSUPPORTED ||
                    (status == SL_ERR_INACCURATE && way == SAVED_SIGNED));
        q.set.n_regions += status == SL_OK;
    }
    free(rows);
    if (q.set.n_regions < SETS_REGIONS) { /* all or none */
        for (int k = 0; k < SETS_REGIONS; k++) {
            sl_region_free(q.regions[k]);
            q.regions[k] = NULL;
        }
        q.set.n_regions = 0;
    }
    return q;
}

/* For the regions of q, which must not be moved while the set is used. */
static inline const sl_saved_set *set_of(set_case_t *q) {
    q->set.regions = q->set.n_regions > 0 ? q->regions : NULL;
    return &q->set;
}

static inline void set_case_free(set_case_t *q) {
    for (int k = 0; k < SETS_REGIONS; k++) {
        sl_region_free(q->regions[k]);
    }
    sl_selected_free(q->set.selected);
    saved_case_free(&q->c);
}

static inline saved_t set_save(const sl_saved_set *set) {
    size_t size = 1;
    SL_CHECK(sl_save(NULL, NULL, &size, set, NULL));
    assert_int_equal(size % 64, 0);
    saved_t m = saved_of_size(size);
    memset(m.bytes, 0xA5, size);
    SL_CHECK(sl_save(NULL, m.bytes, &size, set, NULL));
    return m;
}

static inline void assert_same_selected(const sl_selected *Z, const sl_selected *Y) {
    sl_stats a, b;
    assert_true((Z == NULL) == (Y == NULL));
    if (Z == NULL) {
        return;
    }
    const sl_selected_arrays z = sl_selected_view(Z), y = sl_selected_view(Y);
    const sl_int n = sl_symbolic_view(z.symbolic).n;
    double *p = test_reals((size_t)n), *q = test_reals((size_t)n);
    assert_int_equal(z.count, y.count);
    assert_memory_equal(z.supers, y.supers, (size_t)z.count * sizeof *z.supers);
    assert_memory_equal(z.begin, y.begin, ((size_t)z.count + 1) * sizeof *z.begin);
    assert_memory_equal(z.Z, y.Z, (size_t)z.begin[z.count] * sizeof *z.Z);
    for (sl_int k = 0; k < n; k++) {
        const sl_status status = sl_selected_entries(Z, p, &k, NULL, 1, NULL);
        SL_EXPECT(status, sl_selected_entries(Y, q, &k, NULL, 1, NULL));
        assert_true(status == SL_ERR_OTHER_PATTERN || memcmp(p, q, sizeof *p) == 0);
    }
    a.selected = sl_selected_view(Z).info;
    b.selected = sl_selected_view(Y).info;
    assert_int_equal(a.selected.columns, b.selected.columns);
    assert_true(a.selected.entries == b.selected.entries && b.selected.bytes > 0);
    free(p);
    free(q);
}

/* Solves in the regions have the same bits. R belongs to F, Q to G. */
static inline void assert_same_region(const sl_region *R, const sl_factor *F, const sl_region *Q,
                                      const sl_factor *G) {
    const sl_region_arrays r = sl_region_view(R), q = sl_region_view(Q);
    sl_stats a, b;
    sl_options opt = options_none();
    sl_plan *P = NULL, *T = NULL;
    memset(&a, 0, sizeof a);
    memset(&b, 0, sizeof b);
    assert_int_equal(r.n_roots, q.n_roots);
    assert_memory_equal(r.roots, q.roots, (size_t)r.n_roots * sizeof *r.roots);
    assert_int_equal(r.n_boundary, q.n_boundary);
    assert_memory_equal(r.boundary, q.boundary, (size_t)r.n_boundary * sizeof *r.boundary);
    a.region = sl_region_view(R).info;
    b.region = sl_region_view(Q).info;
    a.region.seconds = b.region.seconds = 0; /* is not saved */
    a.region.bytes = b.region.bytes;         /* of the factor in memory: Z as well */
    assert_memory_equal(&a.region, &b.region, sizeof a.region);
    const sl_int n = sl_symbolic_view(r.symbolic).n;
    sl_int *rows = test_ints((size_t)n);
    const sl_int count = region_rows(R, rows);
    const size_t ld = n > 0 ? (size_t)n : 1;
    double *B = test_reals(9 * ld), *X = test_reals(9 * ld), *Y = test_reals(9 * ld);
    gen_reals(B, 9 * ld, 5);
    opt.region = R;
    SL_CHECK(sl_plan_create(&P, r.symbolic, rows, count, rows, count, &opt, &a));
    opt.region = Q;
    SL_CHECK(sl_plan_create(&T, q.symbolic, rows, count, rows, count, &opt, &b));
    assert_true(a.plan.in_region && b.plan.in_region);
    static const sl_int lanes[3] = {1, 3, 9};
    for (int k = 0; k < 3; k++) {
        SL_CHECK(sl_plan_solve(P, F, X, ld, B, ld, lanes[k], NULL));
        SL_CHECK(sl_plan_solve(T, G, Y, ld, B, ld, lanes[k], NULL));
        assert_memory_equal(X, Y, 9 * ld * sizeof *X);
    }
    if (F != G) {
        SL_EXPECT(SL_ERR_MISMATCH, sl_plan_solve(P, G, X, ld, B, ld, 1, NULL));
    }
    sl_plan_free(P);
    sl_plan_free(T);
    free(rows);
    free(B);
    free(X);
    free(Y);
}

static inline void assert_same_set(const sl_saved_set *a, const sl_saved_set *b) {
    assert_true((a->factor == NULL) == (b->factor == NULL));
    if (a->factor != NULL) {
        assert_same_answers(a->factor, b->factor);
    }
    assert_same_selected(a->selected, b->selected);
    assert_int_equal(a->n_regions, b->n_regions);
    for (sl_int k = 0; k < a->n_regions; k++) {
        assert_same_region(a->regions[k], a->factor, b->regions[k], b->factor);
    }
}

#endif
