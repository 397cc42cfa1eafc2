/* test_faults.c: METIS that fails, separators of no flow, processors without FMA, sizes
 * beyond memory: what calls cannot reach on this machine, by replaced functions and direct calls */
#define SPARSE_LOCAL_IMPLEMENTATION
#define SLI_FLOW_VISITS flow_visits /* 0: no flow ends in time, each separator is a border */
#define SLI_MARKS_BEGIN marks_begin /* of minimum degree: near their largest number, on demand */
static int flow_visits, marks_begin = 2;

#if defined(SL_METIS) && !defined(SL_NO_METIS)
#include <metis.h>

static int metis_fault; /* 0: none, or the status that is returned */

#define METIS_NodeND(...) (metis_fault != 0 ? metis_fault : (METIS_NodeND)(__VA_ARGS__))
#endif

#if defined(__linux__) && defined(__GNUC__)
static unsigned slept; /* microseconds */

/* The header calls this one, whose declaration has the name of the system's. */
int usleep(unsigned microseconds);
int usleep(unsigned microseconds) {
    slept += microseconds;
    return 0;
}
#endif

#include "tests/lib/check_factor.h"

/* The status of an ordering; if it is SL_OK, the order and its separator tree are valid. */
static sl_status order(gen_kind_t kind, sl_int size, sl_ordering ordering) {
    gen_matrix_t M = gen_matrix(kind, size, 1, 3);
    sl_options opt = options_none();
    sl_symbolic *S = (sl_symbolic *)(void *)&M;
    opt.ordering = ordering;
    const sl_status status = sl_symbolic_create(&S, &M.view, &opt, NULL);
    assert_true((S != NULL) == (status == SL_OK));
    if (S) {
        const sl_symbolic_arrays v = sl_symbolic_view(S);
        NOTHING_WRONG(check_permutation(v.n, v.perm, v.iperm));
        NOTHING_WRONG(check_septree(&v, &M.view));
    }
    sl_symbolic_free(S);
    gen_matrix_free(&M);
    return status;
}

#if defined(SL_METIS) && !defined(SL_NO_METIS)

static void errors_of_metis_are_reported(void **state) {
    (void)state;
    metis_fault = METIS_ERROR_MEMORY;
    SL_EXPECT(SL_ERR_MEMORY, order(GEN_GRID2, 900, SL_ORDERING_METIS));
    metis_fault = METIS_ERROR;
    SL_EXPECT(SL_ERR_ORDERING, order(GEN_GRID2, 900, SL_ORDERING_METIS));
    metis_fault = 0;
    SL_CHECK(order(GEN_GRID2, 900, SL_ORDERING_METIS));
}

#endif

/* The separators that take the place of those that a flow did not find in time separate too. Some
 * flows end in time, some not at once. */
static void borders_separate(void **state) {
    (void)state;
    static const gen_kind_t kinds[5] = {GEN_GRID2, GEN_GRID3, GEN_FOREST, GEN_RANDOM,
                                        GEN_COMPONENTS};
    for (int kind = 0; kind < 10; kind++) {
        flow_visits = kind / 5;
        SL_CHECK(order(kinds[kind % 5], 1500, SL_ORDERING_ND));
    }
    flow_visits = 0;
}

/* Eight of `count` numbers, at a multiple of 64 bytes. */
static double *at_line(double *numbers, size_t count, uint64_t seed) {
    gen_reals(numbers, count, seed);
    return numbers + (64 - (uintptr_t)numbers % 64) / sizeof(double) % 8;
}

/* A trial of a change leaves the columns as they are, and the vectors as the change does: with each
 * number of vectors, of which some are never tried on some instruction sets. */
static void trials_change_the_vectors_alone(void **state) {
    (void)state;
    enum { COLUMNS = 5, TILE = 64, ROOM = 2 * TILE + 2 * 8 * COLUMNS + 8 };
    const isa_list_t isas = isas_present();
    for (int k = 0; k < isas.count; k++) {
        const sli_change_kernels *kernels = sli_change_kernels_of(isas.isa[k]);
        for (int kind = 0; kind < SLI_NRHS_KINDS; kind++) { /* the last one: two tiles at once */
            double numbers[5][ROOM], *l[2], *w[2];
            const double *c = at_line(numbers[4], ROOM, 3);
            for (int is_trial = 0; is_trial < 2; is_trial++) {
                l[is_trial] = at_line(numbers[is_trial], ROOM, 1);
                w[is_trial] = at_line(numbers[2 + is_trial], ROOM, 2);
                if (kind < SLI_NRHS_KINDS - 1) {
                    kernels->change[kind](l[is_trial], COLUMNS, c, w[is_trial], is_trial);
                } else {
                    kernels->pair(l[is_trial], l[is_trial] + TILE, COLUMNS, c, w[is_trial],
                                  is_trial);
                }
            }
            assert_memory_equal(w[0], w[1], 2 * TILE * sizeof(double));
            assert_true(memcmp(l[0], l[1], 2 * TILE * sizeof(double)) != 0);
            (void)at_line(numbers[0], ROOM, 1);
            assert_memory_equal(l[0], l[1], 2 * TILE * sizeof(double));
        }
    }
}

/* A leaf has the same order with and without the instruction, and keeps its own if the bit matrix
 * does not fit. */
static void minimum_degree_on_any_processor(void **state) {
    (void)state;
    enum { SIDE = 12, LEAF = 100, KEYS = 104 };
    gen_list_t t = gen_list(SIDE * SIDE);
    uint64_t seed = 1;
    gen_edges_grid(&t, SIDE, SIDE, 1, &seed);
    gen_matrix_t M = gen_store(&t, gen_style(2), 1);
    sl_off begin[SIDE * SIDE + 1];
    sl_int local[SIDE * SIDE], scratch[SIDE * SIDE], first[LEAF], vertices[LEAF], bit[4 * LEAF];
    uint32_t key[KEYS];
    uint64_t rows[LEAF * 3];
    sli_level g;
    sli_mindeg m;
    memset(&g, 0, sizeof g);
    memset(&m, 0, sizeof m);
    g.n = SIDE * SIDE;
    g.begin = begin;
    g.to = M.i;
    m.key = key;
    m.rows = rows;
    m.local = local;
    m.order = scratch;
    m.bit = bit;
    for (sl_int v = 0; v <= g.n; v++) {
        begin[v] = M.p[v];
    }
    for (sl_int v = 0; v < g.n; v++) {
        local[v] = -1;
    }
    for (int turn = 0; turn < 3; turn++) {
        int moved = 0;
        for (sl_int k = 0; k < LEAF; k++) {
            vertices[k] = (k * 37) % LEAF;
        }
        m.room = turn < 2 ? LEAF * 3 : LEAF;
        m.has_avx2 = turn == 1 && isas_present().count > 1;
        sli_mindeg_order(&m, &g, vertices, LEAF);
        for (sl_int k = 0; k < LEAF; k++) {
            first[k] = turn == 0 ? vertices[k] : first[k];
            assert_int_equal(vertices[k], turn < 2 ? first[k] : (k * 37) % LEAF);
            moved += vertices[k] != (k * 37) % LEAF;
        }
        assert_true((moved > 0) == (turn < 2));
    }
    gen_matrix_free(&M);
    gen_list_free(&t);
}

/* Larger leaves keep their order: the bit matrix has no room for them. */
static void large_leaves_keep_their_order(void **state) {
    (void)state;
    enum { LEAF = 8 * sizeof(((sli_mindeg *)0)->alive) + 1 };
    static sl_off begin[LEAF + 1];
    static sl_int local[LEAF], vertices[LEAF], scratch[LEAF];
    sli_level g;
    sli_mindeg m;
    memset(&g, 0, sizeof g);
    memset(&m, 0, sizeof m);
    g.n = LEAF;
    g.begin = begin;
    m.room = LEAF * LEAF;
    m.local = local;
    m.order = scratch;
    for (sl_int v = 0; v < LEAF; v++) {
        local[v] = -1;
        vertices[v] = (v * 37) % LEAF;
    }
    sli_mindeg_order(&m, &g, vertices, LEAF);
    for (sl_int v = 0; v < LEAF; v++) {
        assert_int_equal(vertices[v], (v * 37) % LEAF);
        assert_int_equal(local[v], -1);
    }
}

/* A hierarchy of as many levels as there may be gets no more. */
static void levels_end(void **state) {
    (void)state;
    static sli_dissection d;
    const int most = sizeof d.levels / sizeof *d.levels;
    int working;
    d.n_levels = most;
    d.levels[0].n = d.total = 4000;
    d.levels[most - 1].n = 1000;
    SL_CHECK(sli_dissect_coarsen(&d, &working));
    assert_int_equal(d.n_levels, most);
    assert_int_equal(working, most - 1);
}

/* Marks that have used up their numbers begin again, and the order stays the same. */
static void marks_begin_again(void **state) {
    (void)state;
    gen_matrix_t M = gen_matrix(GEN_GRID2, 900, 1, 3);
    sl_symbolic *S[2];
    sl_options opt = options_none();
    opt.ordering = SL_ORDERING_MINDEG;
    for (int turn = 0; turn < 2; turn++) {
        marks_begin = turn ? INT32_MAX - 3 * 900 - 50 : 2;
        SL_CHECK(sl_symbolic_create(&S[turn], &M.view, &opt, NULL));
    }
    const sl_symbolic_arrays v = sl_symbolic_view(S[0]), w = sl_symbolic_view(S[1]);
    assert_memory_equal(v.perm, w.perm, 900 * sizeof *v.perm);
    marks_begin = 2;
    sl_symbolic_free(S[0]);
    sl_symbolic_free(S[1]);
    gen_matrix_free(&M);
}

#if defined(__x86_64__) && !defined(SL_NO_SIMD) && !defined(_WIN32)

/* What CPUID and XCR0 must say for each instruction set: all of its bits. */
static void instruction_sets_are_recognized(void **state) {
    (void)state;
    const unsigned avx = 1u << 28, fma = 1u << 12, avx2 = 1u << 5, avx512 = 1u << 16;
    const sl_isa best = sli_isa_of(7, avx | fma, avx2 | avx512, 0xe6);
    assert_true(best == SL_ISA_AVX512 || best == SL_ISA_AVX2); /* as compiled in */
    assert_int_equal(sli_isa_of(7, avx | fma, avx2, 0xe6), SL_ISA_AVX2);
    assert_int_equal(sli_isa_of(7, avx | fma, avx2 | avx512, 0x6), SL_ISA_AVX2);
    assert_int_equal(sli_isa_of(7, avx | fma, avx2 | avx512, 0x66), SL_ISA_AVX2);
    assert_int_equal(sli_isa_of(6, avx | fma, avx2 | avx512, 0xe6), SL_ISA_SCALAR);
    assert_int_equal(sli_isa_of(7, avx, avx2 | avx512, 0xe6), SL_ISA_SCALAR);
    assert_int_equal(sli_isa_of(7, fma, avx2 | avx512, 0xe6), SL_ISA_SCALAR);
    assert_int_equal(sli_isa_of(7, avx | fma, avx512, 0xe6), SL_ISA_SCALAR);
    assert_int_equal(sli_isa_of(7, avx | fma, avx2 | avx512, 0xe2), SL_ISA_SCALAR);
    assert_int_equal(sli_isa_of(7, avx | fma, avx2 | avx512, 0), SL_ISA_SCALAR);
}

/* What the compiler's library has asked at the start of the program is what CPUID says now. */
static void the_processor_is_that_of_the_start(void **state) {
    (void)state;
    unsigned one[4], seven[4];
    sli_cpuid(1, one);
    sli_cpuid(7, seven);
    const int has_xgetbv = (one[2] & 1u << 27) != 0;
    assert_int_equal(sli_cpu_best(), sli_isa_of(7, one[2], seven[1], has_xgetbv ? sli_xcr0() : 0));
}

#endif

/* A graph of triangles or tetrahedra, w rows in each direction. */
static gen_list_t lattice(sl_int w, int dimensions) {
    const sl_int n = dimensions == 2 ? w * w : w * w * w, step[3] = {1, w, w * w};
    gen_list_t t = gen_list(n);
    for (sl_int k = 0; k < n; k++) {
        const sl_int at[3] = {k % w, k / w % w, k / (w * w)};
        gen_add(&t, k, k, 1.0);
        for (int way = 1; way < 1 << dimensions; way++) {
            sl_int other = k;
            for (int c = 0; c < dimensions; c++) {
                other = (way >> c & 1) == 0 || other == -1 ? other
                        : at[c] + 1 < w                    ? other + step[c]
                                                           : -1;
            }
            if (other != -1) {
                gen_add(&t, other, k, -1.0);
            }
        }
    }
    return t;
}

/* Each allocation of an ordering fails once, also of those that otherwise use borrowed memory.
 * Returns how many there are. */
static int allocations_of(const gen_list_t *t, int style, sl_ordering ordering) {
    gen_matrix_t M = gen_store(t, gen_style(style), 1);
    const sl_csc *A = &M.view;
    const sl_int n = A->n_cols;
    sl_int *column = test_ints((size_t)A->p[n] + 1), *perm = test_ints((size_t)n),
           *scratch = test_ints(4 * (size_t)n), *seen = test_ints((size_t)n);
    sli_septree septree = {0, test_ints((size_t)n), test_ints((size_t)n + 1)};
    sli_order_choice choice = {test_ints((size_t)n), 0};
    sl_status status = SL_ERR_MEMORY;
    int k = 0;
    for (sl_int j = 0; j < n; j++) {
        for (sl_int p = A->p[j]; p < A->p[j + 1]; p++) {
            column[p] = j;
        }
    }
    for (; status != SL_OK; k++) {
        counter_t counter = counter_make();
        sl_options opt = options_counted(&counter);
        sli_team alone = sli_team_of(1);
        opt.ordering = ordering;
        counter.fail_at = k;
        sli_order_job job;
        memset(&job, 0, sizeof job);
        job.A = A;
        job.column = column;
        job.triangle = gen_style(style).triangle;
        job.opt = &opt;
        job.perm = perm;
        job.scratch = scratch;
        job.septree = &septree;
        job.choice = &choice;
        job.team = &alone;
        job.a = &opt.allocator;
        status = sli_order(&job);
        assert_true(status == SL_OK || status == SL_ERR_MEMORY);
        assert_int_equal(status == SL_ERR_MEMORY, counter.calls > (size_t)k);
        COUNTER_CLEAN(&counter);
    }
    for (sl_int j = 0; j < n; j++) {
        seen[perm[j]]++;
    }
    for (sl_int j = 0; j < n; j++) {
        assert_int_equal(seen[j], 1);
    }
    free(column);
    free(perm);
    free(scratch);
    free(seen);
    free(septree.node_of);
    free(septree.parent);
    free(choice.parent);
    gen_matrix_free(&M);
    return k - 1;
}

static void orderings_may_lack_memory(void **state) {
    (void)state;
    static const struct {
        gen_kind_t kind;
        sl_int size;
    } kinds[5] = {{GEN_GRID2, 900},
                  {GEN_GRID2, 2500},
                  {GEN_FOREST, 300},
                  {GEN_COMPONENTS, 900},
                  {GEN_STAR, 300}};
    static const sl_ordering orderings[3] = {SL_ORDERING_ND, SL_ORDERING_MINDEG, SL_ORDERING_METIS};
    for (int k = 0; k < 5; k++) {
        gen_list_t t = gen_make(kinds[k].kind, kinds[k].size, 1, 3);
        for (sl_int row = 1; row < t.n && k < 2; row++) { /* a dense row */
            gen_add(&t, row, 0, 1.0);
        }
        for (int m = 0; m < 3; m++) {
            if (ordering_is_present(orderings[m])) {
                assert_true(allocations_of(&t, 11 * (m % 2), orderings[m]) > 0);
            }
        }
        gen_list_free(&t);
    }
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        gen_list_t t = lattice(dimensions == 2 ? 100 : 26, dimensions);
        assert_true(allocations_of(&t, 0, SL_ORDERING_ND) > 0);
        gen_list_free(&t);
    }
}

/* Sums of sizes that no memory holds are noticed: they are reached where size_t has 32 bits. */
static void sizes_beyond_memory_are_refused(void **state) {
    (void)state;
    counter_t counter = counter_make();
    const sl_options opt = options_counted(&counter);
    for (int kind = 0; kind < 2; kind++) {
        sli_block b = {NULL, 0};
        (void)sli_take(&b, kind ? SIZE_MAX / 32 : UINT64_MAX / 4, sizeof(double));
        (void)sli_take(&b, SIZE_MAX / 32, sizeof(double));
        (void)sli_take(&b, SIZE_MAX / 32, sizeof(double));
        SL_EXPECT(SL_ERR_TOO_LARGE, sli_block_alloc(&b, &opt.allocator));
        assert_null(b.base);
        sl_work W = sli_work_own(&opt.allocator);
        SL_EXPECT(SL_ERR_TOO_LARGE, sli_work_block(&W, &b));
        assert_null(W.block);
#if SIZE_MAX > UINT32_MAX
        b.used = 0;
        (void)sli_cut(&b, (uint64_t)1 << (kind ? 47 : 62), sizeof(double), 1);
        (void)sli_cut(&b, 1, sizeof(double), 0);
        SL_EXPECT(SL_ERR_TOO_LARGE, sli_block_alloc(&b, &opt.allocator));
#endif
    }
    assert_null(sli_alloc(&opt.allocator, SIZE_MAX));
    assert_int_equal(counter.calls, 0);
}

/* More new columns than 32 bits count, and the error that a restriction gives for them. */
static void more_entries_than_indices_are_refused(void **state) {
    (void)state;
    counter_t counter = counter_make();
    const sl_options opt = options_counted(&counter);
    sli_restriction r;
    memset(&r, 0, sizeof r);
    const sl_status status = sli_restriction_work(&r, (uint64_t)INT32_MAX + 1, &opt.allocator);
    assert_int_equal(status, SL_ERR_TOO_LARGE);
    assert_null(r.blocks[2]);
    assert_int_equal(counter.calls, 0);
    r.n_fresh = 2;
    SL_CHECK(sli_restriction_work(&r, 3, &opt.allocator));
    assert_true(r.entry_column == r.entry_row + 3);
    sli_free(&opt.allocator, r.blocks[2]);
    COUNTER_CLEAN(&counter);
}

#if defined(__linux__) && defined(__GNUC__)

/* Who waits for long leaves the processor to others: it sleeps from the 1200th turn on. */
static void long_waits_sleep(void **state) {
    (void)state;
    for (int turn = 0; turn < 1210; turn++) {
        sli_pause(turn);
        assert_int_equal(slept, turn < 1200 ? 0 : 50 * (turn - 1199));
    }
}

#endif

int main(void) {
    const struct CMUnitTest tests[] = {
#if defined(SL_METIS) && !defined(SL_NO_METIS)
        cmocka_unit_test(errors_of_metis_are_reported),
#endif
        cmocka_unit_test(borders_separate),
        cmocka_unit_test(trials_change_the_vectors_alone),
        cmocka_unit_test(minimum_degree_on_any_processor),
        cmocka_unit_test(large_leaves_keep_their_order),
        cmocka_unit_test(levels_end),
        cmocka_unit_test(marks_begin_again),
#if defined(__x86_64__) && !defined(SL_NO_SIMD) && !defined(_WIN32)
        cmocka_unit_test(instruction_sets_are_recognized),
        cmocka_unit_test(the_processor_is_that_of_the_start),
#endif
        cmocka_unit_test(orderings_may_lack_memory),
        cmocka_unit_test(sizes_beyond_memory_are_refused),
        cmocka_unit_test(more_entries_than_indices_are_refused),
#if defined(__linux__) && defined(__GNUC__)
        cmocka_unit_test(long_waits_sleep),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
