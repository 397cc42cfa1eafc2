/* test_update_memory.c: update matrices of fronts that several workers factor share memory */
#define _POSIX_C_SOURCE 200112L /* nanosleep */
#include "tests/lib/no_kernels.h"
#define SPARSE_LOCAL_IMPLEMENTATION
#define SLI_SMALL_TASKS 1 /* small matrices have many tasks, and large fronts above them */
#include "tests/lib/threads.h"

/* Where a front above the tasks, or the root of a task, begins and ends. */
typedef struct piece_t {
    sl_int s;
    sl_off begin, end;
} piece_t;

static piece_t piece_of(const sl_factor *F, sl_int s, int is_top) {
    piece_t piece = {s, F->schedule.stack_begin[s], 0};
    piece.end = piece.begin + sli_waiting_size(&F->schedule, F->S, s, is_top);
    return piece;
}

/* May both exist at the same time? Those of a front and of its child, and of disjoint subtrees. */
static int may_coexist(const sl_symbolic *S, sl_int low, sl_int high) {
    return S->super_parent[low] == high || low < S->first_descendant[high];
}

/* Returns by how much the memory is less than that of all of them side by side. */
static sl_off assert_pieces_are_apart(const sl_factor *F) {
    const sli_schedule *p = &F->schedule;
    const sl_int count = p->n_tasks + p->n_tops;
    piece_t *piece = test_array((size_t)count + 1, sizeof *piece);
    sl_off sum = p->workers * p->own;
    for (sl_int k = 0, next = 0; next < count; next++) {
        piece[k] = next < p->n_tasks ? piece_of(F, p->last[next], 0)
                                     : piece_of(F, p->top[next - p->n_tasks], 1);
        if (piece[k].end == piece[k].begin) { /* a column without a front */
            continue;
        }
        sum += piece[k].end - piece[k].begin;
        assert_true(piece[k].begin >= p->workers * p->own && piece[k].end <= p->stack);
        for (sl_int m = 0; m < k; m++) {
            const int is_lower = piece[m].s < piece[k].s;
            if (may_coexist(F->S, piece[is_lower ? m : k].s, piece[is_lower ? k : m].s)) {
                assert_true(piece[m].end <= piece[k].begin || piece[k].end <= piece[m].begin);
            }
        }
        k++;
    }
    free(piece);
    return sum - p->stack;
}

static void fronts_that_wait_for_each_other_share_no_memory(void **state) {
    (void)state;
    for (int kind = 0; kind < GEN_REGULAR; kind++) {
        for (sl_int workers = 1; workers <= 8; workers += workers < 3 ? 1 : 5) {
            int calls = 0;
            const sl_options opt = options_with_threads(run_backwards, workers, &calls);
            factored_t y = factored_make((gen_kind_t)kind, 600, 0, 0, &opt);
            const sl_off less = assert_pieces_are_apart(y.F);
            assert_true(less >= 0);
            if (workers > 1 && (kind == GEN_PATH || kind == GEN_GRID2 || kind == GEN_GRID3)) {
                assert_true(less > 0);
            }
            factored_free(&y);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fronts_that_wait_for_each_other_share_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
