/* test_data_meshes.c: real meshes of $SL_DATA: M + t L is solved, whole and local, and L, being singular, refused */
#include "data.h"

#include "../tools/laplacian.h"
#include "../tools/mesh.h"
#include "../tools/patch.h"

/* A mesh with its two systems M + t L, t = h^2 and 100 h^2, and L itself: one pattern, so one analysis. */
typedef struct subject_t {
    mesh m;
    sl_matrix *system[2], *laplacian;
    adjacency neighbours;
    sl_symbolic *S;
} subject_t;

static subject_t subject_or_fail(const char *path) {
    subject_t y;
    char message[300];
    memset(&y, 0, sizeof y);
    if (!mesh_read(&y.m, path, message, sizeof message)) {
        print_error("%s\n", message);
        fail();
    }
    double h = mesh_mean_edge_length(&y.m);
    assert_true(laplacian_system(&y.system[0], &y.m, h * h));
    assert_true(laplacian_system(&y.system[1], &y.m, 100 * h * h));
    assert_true(laplacian_cotangent(&y.laplacian, &y.m));
    assert_true(adjacency_from_mesh(&y.neighbours, &y.m));
    sl_csc A = sl_matrix_view(y.system[0]);
    SL_CHECK(sl_symbolic_create(&y.S, &A, NULL, NULL));
    return y;
}

static void subject_free(subject_t *y) {
    sl_symbolic_free(y->S);
    adjacency_free(&y->neighbours);
    sl_matrix_free(y->laplacian);
    sl_matrix_free(y->system[1]);
    sl_matrix_free(y->system[0]);
    mesh_free(&y->m);
}

/* b on a patch of 1, 40 or 500 vertices, x on the same, on another or everywhere (the round turns which), 1 and
 * 8 right-hand sides. */
static void try_patches(const subject_t *y, const sl_factor *F, int round, sl_work *W) {
    static const sl_int sizes[3] = {1, 40, 500};
    sl_int n = y->m.n_vertices, here[500], there[500];
    unsigned char *seen = (unsigned char *)test_array((size_t)n, 1);
    uint64_t seed = 7 + (uint64_t)round;
    for (int k = 0; k < 6; k++) {
        sl_int nrhs = k % 2 ? 8 : 1;
        sl_int nb = patch_bfs(here, sizes[k / 2], &y->neighbours, gen_below(&seed, n), seen);
        sl_int nx = patch_bfs(there, sizes[2 - k / 2], &y->neighbours, gen_below(&seed, n), seen);
        const sl_int *xset[3] = {here, there, NULL};
        const sl_int counts[3] = {nb, nx, n};
        int which = (k + round) % 3;
        question_t q = ask_sets(F, here, nb, xset[which], counts[which], nrhs, seed);
        answer(y->S, F, &q, W);
        forget(&q);
    }
    free(seen);
}

/* The constants on a component are in L's kernel: it gives no factor, and spoils one until that is filled again. */
static void laplacian_is_refused(const subject_t *y, sl_factor *F, const sl_options *opt) {
    sl_csc L = sl_matrix_view(y->laplacian), A = sl_matrix_view(y->system[0]);
    sl_factor *G = NULL;
    sl_stats stats;
    double one = 1.0;
    const sl_int row = 0;
    for (int again = 0; again < 2; again++) {
        memset(&stats, 0, sizeof stats);
        if (again) {
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_refactor(F, &L, &stats));
        } else {
            SL_EXPECT(SL_ERR_PIVOT, sl_factor_create(&G, y->S, &L, opt, &stats));
        }
        assert_int_equal(stats.null, 1);
        assert_in_range(stats.error_row, 0, L.n_cols - 1);
        assert_true(isfinite(stats.error_value));
    }
    assert_null(G);
    SL_EXPECT(SL_ERR_STATE, sl_local_solve(F, &one, 1, &row, 1, &one, 1, &row, 1, 1, NULL, NULL));
    SL_CHECK(sl_factor_refactor(F, &A, NULL));
    SL_CHECK(sl_factor_create(&G, y->S, &A, opt, NULL));
    assert_same_bits(F, G);
    sl_factor_free(G);
}

/* Returns the worst backward error. The second system goes into the factor of the first. */
static double try_subject(const subject_t *y, sl_isa isa, sl_work *W) {
    sl_factor *F = NULL;
    sl_options opt = options_none();
    double worst = 0.0;
    opt.isa = isa;
    for (int k = 0; k < 2; k++) {
        sl_csc A = sl_matrix_view(y->system[k]);
        sl_stats stats;
        memset(&stats, 0, sizeof stats);
        if (F) {
            SL_CHECK(sl_factor_refactor(F, &A, &stats));
        } else {
            SL_CHECK(sl_factor_create(&F, y->S, &A, &opt, &stats));
        }
        /* each face's own matrix is semi-definite, also where a weight is negative, and M is definite */
        assert_int_equal(stats.positive, y->m.n_vertices);
        assert_int_equal(stats.negative, 0);
        worst = fmax(worst, data_solve(F, &A, 2, DATA_STEADY, W));
        try_patches(y, F, k + 1, W);
    }
    if (y->m.n_faces > 0) {
        laplacian_is_refused(y, F, &opt);
    }
    sl_factor_free(F);
    return worst;
}

static void meshes_are_solved(void **state) {
    (void)state;
    dataset d = data_or_skip("meshes");
    isa_list_t isas = isas_present();
    double worst = 0.0;
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    for (size_t k = 0; k < d.count; k++) {
        subject_t y = subject_or_fail(d.paths[k]);
        for (int i = 0; i < isas.count; i++) {
            /* scalar and the best alone on a large one: the others differ from them in no way that size would show */
            if (y.m.n_vertices <= 60000 || i == 0 || i == isas.count - 1) {
                worst = fmax(worst, try_subject(&y, isas.isa[i], W));
            }
        }
        subject_free(&y);
    }
    print_message("%lu meshes solved; backward error up to %.1f eps\n", (unsigned long)d.count,
                  worst / DBL_EPSILON);
    sl_work_free(W);
    dataset_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
