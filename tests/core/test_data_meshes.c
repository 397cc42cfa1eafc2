/* test_data_meshes.c: full and local solves with M + t L on the meshes of $SL_DATA; L is refused */
#include "tests/lib/real_data.h"

#include "tools/geometry/laplacian.h"
#include "tools/mesh/mesh.h"
#include "tools/mesh/adjacency.h"

/* A mesh with its systems M + t L, t = h^2 and 100 h^2, and L itself: one pattern, one analysis. */
typedef struct mesh_systems_t {
    mesh m;
    sl_matrix *system[2], *laplacian;
    adjacency neighbors;
    sl_symbolic *S;
} mesh_systems_t;

static mesh_systems_t mesh_systems_or_fail(const char *path) {
    mesh_systems_t y;
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
    assert_true(adjacency_from_mesh(&y.neighbors, &y.m));
    sl_csc A = sl_matrix_view(y.system[0]);
    SL_CHECK(sl_symbolic_create(&y.S, &A, NULL, NULL));
    return y;
}

static void mesh_systems_free(mesh_systems_t *y) {
    sl_symbolic_free(y->S);
    adjacency_free(&y->neighbors);
    sl_matrix_free(y->laplacian);
    sl_matrix_free(y->system[1]);
    sl_matrix_free(y->system[0]);
    mesh_free(&y->m);
}

/* b on a patch of 1, 40 or 500 vertices; x on the same patch, on another or everywhere, depending
 * on round; 1 and 8 right-hand sides. */
static void check_patches(const mesh_systems_t *y, const sl_factor *F, int round, sl_work *W) {
    static const sl_int sizes[3] = {1, 40, 500};
    sl_int n = y->m.n_vertices, here[500], there[500];
    unsigned char *seen = (unsigned char *)test_array((size_t)n, 1);
    uint64_t seed = 7 + (uint64_t)round;
    for (int k = 0; k < 6; k++) {
        sl_int nrhs = k % 2 ? 8 : 1;
        sl_int nb = adjacency_bfs(here, sizes[k / 2], &y->neighbors, gen_below(&seed, n), seen);
        sl_int nx =
            adjacency_bfs(there, sizes[2 - k / 2], &y->neighbors, gen_below(&seed, n), seen);
        const sl_int *xset[3] = {here, there, NULL};
        const sl_int counts[3] = {nb, nx, n};
        int which = (k + round) % 3;
        local_solve_t q = local_solve_make(F, here, nb, xset[which], counts[which], nrhs, seed);
        local_solve_check(y->S, F, &q, W);
        local_solve_free(&q);
    }
    free(seen);
}

/* The constants on each component are in the kernel of L: it has no factor, and after a failed
 * refactor a factor refuses solves until a refactor succeeds. */
static void assert_laplacian_is_refused(const mesh_systems_t *y, sl_factor *F,
                                        const sl_options *opt) {
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
        assert_int_equal(stats.factor.null, 1);
        assert_in_range(stats.error.row, 0, L.n_cols - 1);
        assert_true(isfinite(stats.error.value));
    }
    assert_null(G);
    SL_EXPECT(SL_ERR_STALE, sl_local_solve(F, &row, 1, &row, 1, &one, 1, &one, 1, 1, NULL, NULL));
    SL_CHECK(sl_factor_refactor(F, &A, NULL));
    SL_CHECK(sl_factor_create(&G, y->S, &A, opt, NULL));
    assert_same_bits(F, G);
    sl_factor_free(G);
}

/* Factors the first system, then the second one by a refactor. Returns the largest backward
 * error. */
static double check_systems(const mesh_systems_t *y, sl_isa isa, sl_work *W) {
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
        /* the matrix of each face is semidefinite, even with a negative weight, and M is
         * definite */
        assert_int_equal(stats.factor.positive, y->m.n_vertices);
        assert_int_equal(stats.factor.negative, 0);
        worst = fmax(worst, data_solve(F, &A, 2, DATA_STABLE, W));
        check_patches(y, F, k + 1, W);
    }
    if (y->m.n_faces > 0) {
        assert_laplacian_is_refused(y, F, &opt);
    }
    sl_factor_free(F);
    return worst;
}

static void systems_of_meshes_are_solved(void **state) {
    (void)state;
    dataset d = data_or_skip("meshes");
    isa_list_t isas = isas_present();
    double worst = 0.0;
    sl_work *W = NULL;
    SL_CHECK(sl_work_create(&W, NULL));
    for (size_t k = 0; k < d.count; k++) {
        mesh_systems_t y = mesh_systems_or_fail(d.paths[k]);
        for (int i = 0; i < isas.count; i++) {
            /* on large meshes only scalar and the best instruction set: size does not affect the
             * others differently */
            if (y.m.n_vertices <= 60000 || i == 0 || i == isas.count - 1) {
                worst = fmax(worst, check_systems(&y, isas.isa[i], W));
            }
        }
        mesh_systems_free(&y);
    }
    print_message("%lu meshes solved; backward error up to %.1f eps\n", (unsigned long)d.count,
                  worst / DBL_EPSILON);
    sl_work_free(W);
    dataset_free(&d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(systems_of_meshes_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
