/* test_edit_rare.c: smallest separators near an edit, against a search over all sets of rows */
#include "tests/lib/no_kernels.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#include "tests/lib/gen_graphs.h"

enum { ROWS = 24, MOVABLE = 5, OUTER = 3 /* the layer around what may move */ };
enum { BELOW_LEFT, BELOW_RIGHT, TOP }; /* two subtrees and the node above them */
enum { LEFT = MOVABLE, RIGHT, INNER }; /* the outer row of each side, and the first other row */

/* The rows near an edit, of which the first ones separate two subtrees, and their band. */
typedef struct near_t {
    sl_symbolic S;
    sli_edit e;
    sli_band w;
    sl_int parent[3], first_descendant[3];
    sl_int node[ROWS], number[ROWS], cursor[ROWS], to[ROWS * ROWS];
    sl_off begin[ROWS + 1];
    unsigned char layer[ROWS], mark[4];
    sl_int row[ROWS], before[ROWS], behind[ROWS], queue[2 * ROWS], search[2 * ROWS];
    unsigned char kind[ROWS], seen[2 * ROWS];
    uint32_t neighbors[ROWS]; /* as bits */
} near_t;

/* A random sparse graph of n rows in which no entry joins the subtrees. */
static void near_fill(near_t *b, sl_int n, uint64_t *state) {
    memset(b, 0, sizeof *b);
    for (sl_int k = 0; k < n; k++) {
        b->node[k] = k < MOVABLE ? TOP
                     : k < INNER ? k - MOVABLE
                                 : (gen_below(state, 2) ? BELOW_LEFT : BELOW_RIGHT);
        b->layer[k] = (unsigned char)(k == LEFT || k == RIGHT ? OUTER : 1 + gen_below(state, 2));
        b->number[k] = k;
    }
    for (sl_int k = 0; k < 2 * n; k++) {
        const sl_int i = gen_below(state, n), j = gen_below(state, n);
        if (i != j && (i < MOVABLE || j < MOVABLE || b->node[i] == b->node[j])) {
            b->neighbors[i] |= (uint32_t)1 << j;
            b->neighbors[j] |= (uint32_t)1 << i;
        }
    }
    for (sl_int k = 0; k < n; k++) {
        b->begin[k + 1] = b->begin[k];
        for (sl_int j = 0; j < n; j++) {
            if (b->neighbors[k] >> j & 1) {
                b->to[b->begin[k + 1]++] = j;
            }
        }
    }
}

/* Cuts the band as an edit does, and moves its rows. */
static void near_cut(near_t *b) {
    sli_band *w = &b->w;
    b->S.n_supers = 3;
    b->S.super_parent = b->parent;
    b->S.first_descendant = b->first_descendant;
    b->parent[BELOW_LEFT] = b->parent[BELOW_RIGHT] = TOP;
    b->parent[TOP] = -1;
    b->first_descendant[BELOW_RIGHT] = BELOW_RIGHT;
    b->e.S = &b->S;
    b->e.node = b->node;
    b->e.is_active = b->layer;
    b->e.number = b->number;
    b->e.cursor = b->cursor;
    b->e.begin = b->begin;
    b->e.to = b->to;
    b->e.mark = b->mark;
    b->e.steps = 100000;
    w->e = &b->e;
    w->node = TOP;
    w->row = b->row;
    w->from = b->before;
    w->to = b->behind;
    w->queue = b->queue;
    w->parent = b->search;
    w->kind = b->kind;
    w->seen = b->seen;
    for (w->n = 0; w->n < MOVABLE; w->n++) {
        w->row[w->n] = w->n;
        b->cursor[w->n] = w->n + 1;
    }
    w->n_movable = w->n;
    sli_band_cut(w);
}

/* Does a path lead from one outer row to the other, past these rows? */
static int is_connected(const near_t *b, sl_int n, uint32_t without) {
    uint32_t seen = (uint32_t)1 << LEFT, last = 0;
    while (seen != last) {
        last = seen;
        for (sl_int k = 0; k < n; k++) {
            seen |= last >> k & 1 ? b->neighbors[k] & ~without : 0;
        }
    }
    return (int)(seen >> RIGHT & 1);
}

/* The size of the smallest set of rows past which no path leads, or MOVABLE, which suffice. */
static sl_int smallest(const near_t *b, sl_int n) {
    const uint32_t outer = (uint32_t)1 << LEFT | (uint32_t)1 << RIGHT;
    if (!is_connected(b, n, 0)) {
        return 0;
    }
    for (sl_int size = 1; size < MOVABLE; size++) {
        uint32_t set = ((uint32_t)1 << size) - 1;
        while (set < (uint32_t)1 << n) { /* all sets of so many bits, in ascending order */
            const uint32_t low = set & (~set + 1), high = set + low;
            if ((set & outer) == 0 && !is_connected(b, n, set)) {
                return size;
            }
            set = high | (((set ^ high) >> 2) / low);
        }
    }
    return MOVABLE;
}

/* The flow has as many disjoint paths as the smallest separator has rows. Some lead back through a
 * row of an earlier path, which then leaves it. */
static void separators_are_smallest(void **state) {
    (void)state;
    uint64_t random = 1;
    int sizes[MOVABLE + 1] = {0};
    for (int turn = 0; turn < 20000; turn++) {
        near_t b;
        const sl_int n = INNER + 6 + gen_below(&random, ROWS - INNER - 5);
        sl_int paths = 0, cut = 0;
        near_fill(&b, n, &random);
        near_cut(&b);
        for (sl_int k = 0; k < b.w.n; k++) {
            const sl_int from = b.before[k], to = b.behind[k];
            assert_true((from == SLI_BAND_NONE) == (to == SLI_BAND_NONE));
            assert_true((from < 0 || b.behind[from] == k) && (to < 0 || b.before[to] == k));
            paths += from == SLI_BAND_END;
            cut += b.seen[2 * k] && !b.seen[2 * k + 1];
        }
        assert_int_equal(paths, smallest(&b, n));
        if (paths > 0 && paths < MOVABLE) { /* else nothing moves */
            assert_int_equal(cut, paths);
        }
        for (sl_int k = 0; k < n; k++) {
            assert_int_equal(b.cursor[k], 0);
            for (sl_int j = 0; j < k; j++) {
                assert_true((b.neighbors[k] >> j & 1) == 0 || b.node[k] == TOP ||
                            b.node[j] == TOP || b.node[k] == b.node[j]);
            }
        }
        sizes[paths]++;
    }
    for (int k = 0; k < MOVABLE; k++) {
        print_message("%d separators of %d rows\n", sizes[k], k);
        assert_true(sizes[k] > 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(separators_are_smallest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
