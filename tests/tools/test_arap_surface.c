/* test_arap_surface.c: nearest rotations, and the steps of as-rigid-as-possible deformations */
#include "tests/lib/test.h"

#include "tools/geometry/arap_surface.h"
#include "tools/geometry/laplacian.h"
#include "tools/geometry/rotation_fit.h"
#include "tools/mesh/surface_generator.h"

static double random_real(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 33) * 0x1p-30 - 1;
}

/* R (column-major) of a unit quaternion. */
static void random_rotation(double R[9], uint64_t *state) {
    double q[4], length = 0;
    for (int k = 0; k < 4; k++) {
        q[k] = random_real(state);
        length += q[k] * q[k];
    }
    const double w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / length;
    const double M[9] = {1 - s * (y * y + z * z), s * (x * y + w * z),     s * (x * z - w * y),
                         s * (x * y - w * z),     1 - s * (x * x + z * z), s * (y * z + w * x),
                         s * (x * z + w * y),     s * (y * z - w * x),     1 - s * (x * x + y * y)};
    memcpy(R, M, sizeof M);
}

static double trace_of_product(const double *R, const double *S) {
    double trace = 0;
    for (int k = 0; k < 9; k++) {
        trace += R[k] * S[k];
    }
    return trace;
}

static void assert_is_rotation(const double *R) {
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const double dot =
                R[3 * i] * R[3 * j] + R[3 * i + 1] * R[3 * j + 1] + R[3 * i + 2] * R[3 * j + 2];
            assert_true(fabs(dot - (i == j)) < 1e-14);
        }
    }
    const double det = R[0] * (R[4] * R[8] - R[5] * R[7]) - R[3] * (R[1] * R[8] - R[2] * R[7]) +
                       R[6] * (R[1] * R[5] - R[2] * R[4]);
    assert_true(fabs(det - 1) < 1e-14);
}

/* No rotation near the fitted one and none of many random ones has a larger trace. The matrices
 * are of every rank and orientation, also a reflection with equal singular values. */
static void no_rotation_fits_better(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int turn = 0; turn < 600; turn++) {
        double S[9], R[9], other[9], size = 0;
        const int rank = turn % 4;
        const double scale = pow(10, turn % 7 * 40 - 120);
        memset(S, 0, sizeof S);
        for (int r = 0; r < rank; r++) {
            const double u[3] = {random_real(&seed), random_real(&seed), random_real(&seed)};
            const double v[3] = {random_real(&seed), random_real(&seed), random_real(&seed)};
            for (int k = 0; k < 9; k++) {
                S[k] += scale * u[k % 3] * v[k / 3];
            }
        }
        if (turn % 8 == 4) { /* a multiple of a reflection, or of -I */
            for (int k = 0; k < 9; k++) {
                S[k] = k % 4 != 0 ? 0 : k == 0 || turn % 16 == 4 ? -scale : scale;
            }
        }
        for (int k = 0; k < 9; k++) {
            size += fabs(S[k]);
        }
        const double trace = rotation_fit(R, S);
        assert_is_rotation(R);
        assert_true(trace == trace_of_product(R, S));
        for (int k = 0; k < 200; k++) {
            random_rotation(other, &seed);
            assert_true(trace_of_product(other, S) <= trace + 1e-13 * size);
        }
        for (int k = 0; k < 9; k++) { /* R' S is symmetric where the trace is stationary */
            const int i = k % 3, j = k / 3;
            double a = 0, b = 0;
            for (int d = 0; d < 3; d++) {
                a += R[3 * i + d] * S[3 * j + d];
                b += R[3 * j + d] * S[3 * i + d];
            }
            assert_true(fabs(a - b) <= 1e-7 * size);
        }
    }
}

static void special_matrices_are_fitted(void **state) {
    (void)state;
    uint64_t seed = 8;
    for (int turn = 0; turn < 200; turn++) {
        double Q[9], R[9];
        random_rotation(Q, &seed);
        assert_true(fabs(rotation_fit(R, Q) - 3) < 1e-14); /* a rotation is its own */
        for (int k = 0; k < 9; k++) {
            assert_true(fabs(R[k] - Q[k]) < 1e-14);
        }
    }
    const double bad[9] = {NAN, 1, 0, 0, INFINITY, 0, 0, 0, 1}, zero[9] = {0};
    double R[9];
    (void)rotation_fit(R, bad);
    assert_is_rotation(R);
    assert_true(rotation_fit(R, zero) == 0 && R[0] == 1 && R[4] == 1 && R[8] == 1);
}

static const char *const surfaces[] = {"star:2", "hills:9x8", "grid:7x9", "torus:9x7"};
enum { N_SURFACES = sizeof surfaces / sizeof *surfaces };

/* y = R x + shift gives the energy 0, and forces b(R) = L y. */
static void rigid_motions_have_no_energy(void **state) {
    (void)state;
    uint64_t seed = 3;
    for (int s = 0; s < N_SURFACES; s++) {
        mesh m;
        arap_surface a;
        sl_matrix *L = NULL;
        double R[9];
        assert_true(surface_generate(&m, surfaces[s], NULL, 0) && arap_surface_create(&a, &m) &&
                    laplacian_cotangent(&L, &m));
        const size_t n = (size_t)m.n_vertices;
        const sl_csc A = sl_matrix_view(L);
        double *y = test_reals(3 * n), *b = test_reals(3 * n), *Ly = test_reals(3 * n);
        random_rotation(R, &seed);
        for (size_t k = 0; k < 3 * n; k++) {
            const double *x = m.xyz + 3 * (k % n);
            const size_t c = k / n;
            y[k] = R[c] * x[0] + R[c + 3] * x[1] + R[c + 6] * x[2] + (double)c;
        }
        assert_true(fabs(arap_surface_rotations(&a, y)) < 1e-12);
        arap_surface_forces(&a, b);
        SL_CHECK(sl_csc_multiply(&A, SL_AS_SYMMETRIC, Ly, n, y, n, 3));
        for (size_t k = 0; k < 3 * n; k++) {
            assert_true(fabs(b[k] - Ly[k]) < 1e-12);
        }
        for (size_t k = 0; k < 9 * n; k++) {
            assert_true(fabs(a.rotations[k] - R[k % 9]) < 1e-11);
        }
        free(y);
        free(b);
        free(Ly);
        sl_matrix_free(L);
        arap_surface_free(&a);
        mesh_free(&m);
    }
}

/* Whatever the positions, E >= 0, and a step against its gradient 2 (L y - b(R)) lowers it: the
 * forces belong to the energy. */
static void forces_are_those_of_the_energy(void **state) {
    (void)state;
    uint64_t seed = 4;
    for (int s = 0; s < N_SURFACES; s++) {
        mesh m;
        arap_surface a;
        sl_matrix *L = NULL;
        assert_true(surface_generate(&m, surfaces[s], NULL, 0) && arap_surface_create(&a, &m) &&
                    laplacian_cotangent(&L, &m));
        const size_t n = (size_t)m.n_vertices;
        const sl_csc A = sl_matrix_view(L);
        double *y = test_reals(3 * n), *b = test_reals(3 * n), *g = test_reals(3 * n);
        double along = 0;
        for (size_t k = 0; k < 3 * n; k++) {
            y[k] = m.xyz[3 * (k % n) + k / n] + 0.05 * random_real(&seed);
        }
        const double energy = arap_surface_rotations(&a, y), h = 1e-6;
        assert_true(energy > 0);
        arap_surface_forces(&a, b);
        SL_CHECK(sl_csc_multiply(&A, SL_AS_SYMMETRIC, g, n, y, n, 3));
        for (size_t k = 0; k < 3 * n; k++) {
            g[k] = 2 * (g[k] - b[k]);
            along += g[k] * g[k];
        }
        for (size_t k = 0; k < 3 * n; k++) {
            y[k] -= h * g[k];
        }
        /* the best rotations change the energy in second order only */
        const double slope = (arap_surface_rotations(&a, y) - energy) / h;
        assert_true(fabs(slope + along) < 1e-3 * along);
        free(y);
        free(b);
        free(g);
        sl_matrix_free(L);
        arap_surface_free(&a);
        mesh_free(&m);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_rotation_fits_better),
        cmocka_unit_test(special_matrices_are_fitted),
        cmocka_unit_test(rigid_motions_have_no_energy),
        cmocka_unit_test(forces_are_those_of_the_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
