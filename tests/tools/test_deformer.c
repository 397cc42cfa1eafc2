/* test_deformer.c: deformations by handles: exact answers, invariance, a new factor's positions */
#include "tests/lib/test.h"

#include "tools/geometry/deformer_relax.h"
#include "tools/mesh/insert_point.h"
#include "tools/mesh/surface_generator.h"
#include "tests/lib/constraint_calls.h"

static const char *const surfaces[] = {"star:3", "hills:15x12", "torus:18x9"};
enum { N_SURFACES = sizeof surfaces / sizeof *surfaces, N_HANDLES = 7 };

typedef struct scene_t {
    mesh m;
    deformer d;
    sl_int handles[N_HANDLES];
} scene_t;

static void scene_make(scene_t *s, const char *surface, deform_method method) {
    assert_true(surface_generate(&s->m, surface, NULL, 0));
    SL_CHECK(deformer_create(&s->d, &s->m, method));
    assert_int_equal(s->d.n_components, 1);
    for (sl_int k = 0; k < N_HANDLES; k++) {
        s->handles[k] = (sl_int)((long)(k + 1) * 7919 % s->m.n_vertices);
        SL_CHECK(deformer_hold(&s->d, &s->handles[k], 1));
    }
}

static void scene_free(scene_t *s) {
    deformer_free(&s->d);
    mesh_free(&s->m);
}

/* Moves handle k by a rotation about the z axis and a shift. */
static void move_rigidly(scene_t *s, int k, double angle, const double shift[3], double to[3]) {
    const double *x = s->m.xyz + 3 * (size_t)s->handles[k];
    to[0] = cos(angle) * x[0] - sin(angle) * x[1] + shift[0];
    to[1] = sin(angle) * x[0] + cos(angle) * x[1] + shift[1];
    to[2] = x[2] + shift[2];
    deformer_move(&s->d, s->handles[k], to);
}

static void solve(scene_t *s, int iterations) {
    for (int k = 0; k < iterations; k++) {
        (void)deformer_rotations(&s->d);
        SL_CHECK(deformer_solve(&s->d));
    }
}

static void assert_agrees_with_new_factor(scene_t *s) {
    double difference, seconds;
    SL_CHECK(deformer_compare(&s->d, &difference, &seconds));
    assert_true(difference < 1e-10 && seconds >= 0);
}

/* Held vertices are where they were moved, also those that stay; the others follow a translation
 * of all handles exactly, and a rotation after many rounds if they are as rigid as possible. */
static void rigid_motions_of_all_handles_move_everything(void **state) {
    (void)state;
    const double shift[3] = {0.3, -0.2, 0.5};
    for (int k = 0; k < 2 * N_SURFACES; k++) {
        const deform_method method = k % 2 ? DEFORM_BIHARMONIC : DEFORM_ARAP;
        scene_t s;
        scene_make(&s, surfaces[k / 2], method);
        const size_t n = (size_t)s.m.n_vertices;
        for (int turn = 0; turn < 2; turn++) {
            const double angle = turn == 0 ? 0 : 0.5;
            double to[3];
            for (int h = 0; h < N_HANDLES; h++) {
                move_rigidly(&s, h, angle, shift, to);
            }
            solve(&s, turn == 0 ? 1 : 1000);
            for (size_t v = 0; v < n; v++) {
                const double *x = s.m.xyz + 3 * v;
                const double want[3] = {cos(angle) * x[0] - sin(angle) * x[1] + shift[0],
                                        sin(angle) * x[0] + cos(angle) * x[1] + shift[1],
                                        x[2] + shift[2]};
                const double allowed = turn == 0 || s.d.is_held[v] ? 1e-11
                                       : method == DEFORM_ARAP     ? 1e-2
                                                                   : HUGE_VAL;
                for (size_t c = 0; c < 3; c++) {
                    assert_true(fabs(s.d.Y[c * n + v] - want[c]) < allowed);
                }
            }
            assert_agrees_with_new_factor(&s);
        }
        scene_free(&s);
    }
}

/* The energy never rises from round to round while the handles rest. */
static void energies_fall(void **state) {
    (void)state;
    const double shift[3] = {0.5, 0.4, -0.3};
    for (int k = 0; k < N_SURFACES; k++) {
        scene_t s;
        scene_make(&s, surfaces[k], DEFORM_ARAP);
        double to[3], last = HUGE_VAL;
        move_rigidly(&s, 1, 0, shift, to);
        solve(&s, 1);
        for (int round = 0; round < 60; round++) {
            const double energy = deformer_rotations(&s.d);
            assert_true(energy >= 0 && energy <= last * (1 + 1e-12));
            last = energy;
            SL_CHECK(deformer_solve(&s.d));
        }
        assert_agrees_with_new_factor(&s);
        scene_free(&s);
    }
}

/* After 30 solves a relaxed surface is within 1 % of the diagonal of where 400 lead; the energy is
 * below that of as many global steps. Motions are large: a turn by 70 degrees, and arms pulled. */
static void relaxation_reaches_the_limit(void **state) {
    (void)state;
    for (int k = 0; k < 3; k++) {
        mesh m;
        deformer d[3];
        double energy[3];
        assert_true(surface_generate(&m, k == 1 ? "star:4" : "hills:25x25", NULL, 0));
        const size_t n = (size_t)m.n_vertices;
        for (int run = 0; run < 3; run++) {
            SL_CHECK(deformer_create(&d[run], &m, DEFORM_ARAP));
            const double angle = k == 0 ? 1.2 : k == 1 ? 0.6 : 2.2;
            const sl_int count = k == 1 ? 7 : 25;
            for (sl_int j = 0; j < 2 * count; j++) {
                const bool moves = j >= count;
                const sl_int v = k == 1 ? j * 181 : moves ? 600 + j - count : j;
                const double *x = m.xyz + 3 * (size_t)v;
                const double to[3] = {x[0] + (k == 1) * 0.5, cos(angle) * x[1] - sin(angle) * x[2],
                                      sin(angle) * x[1] + cos(angle) * x[2]};
                SL_CHECK(deformer_hold(&d[run], &v, 1));
                deformer_move(&d[run], v, moves ? to : x);
            }
            deformer_rest how = {0, 0, 0, 0, false};
            for (int step = 0; step < 30 && run == 2; step++) {
                (void)deformer_rotations(&d[run]);
                SL_CHECK(deformer_solve(&d[run]));
            }
            if (run < 2) {
                SL_CHECK(deformer_relax(&d[run], run == 0 ? 1e-12 : 0, run == 0 ? 400 : 30, &how));
                assert_true(run == 1 || how.converged);
            }
            energy[run] = deformer_rotations(&d[run]);
        }
        double worst = 0;
        for (size_t j = 0; j < 3 * n; j++) {
            worst = fmax(worst, fabs(d[0].Y[j] - d[1].Y[j]) / d[0].diameter);
        }
        print_message("%.2g of the diagonal; energies %.6g, %.6g, %.6g\n", worst, energy[0],
                      energy[1], energy[2]);
        assert_true(worst < 0.01 && energy[1] < energy[2] && energy[0] <= energy[1] * (1 + 1e-9));
        for (int run = 0; run < 3; run++) {
            deformer_free(&d[run]);
        }
        mesh_free(&m);
    }
}

/* Seven vertices are turned by 69 degrees, seven stay: steps past points where the Hessian is near
 * to indefinite are lengthened, or 30 solves do not settle. What ends before says how far it came
 * lately, which tells how far the limit is. */
static void large_turns_settle(void **state) {
    (void)state;
    mesh m;
    deformer d[3];
    deformer_rest how[3];
    assert_true(surface_generate(&m, "star:4", NULL, 0));
    const size_t n = (size_t)m.n_vertices;
    for (int run = 0; run < 3; run++) { /* to the limit, 30 solves, 12 solves */
        SL_CHECK(deformer_create(&d[run], &m, DEFORM_ARAP));
        for (sl_int j = 0; j < 14; j++) {
            const sl_int v = j * (m.n_vertices / 14);
            const double *x = m.xyz + 3 * (size_t)v, c = cos(1.2043), s = sin(1.2043);
            const double to[3] = {x[0] + 0.5, c * x[1] - s * x[2], s * x[1] + c * x[2]};
            SL_CHECK(deformer_hold(&d[run], &v, 1));
            deformer_move(&d[run], v, j < 7 ? x : to);
        }
        SL_CHECK(deformer_relax(&d[run], run == 0 ? 1e-10 : 1e-4,
                                run == 0   ? 200
                                : run == 1 ? 30
                                           : 12,
                                &how[run]));
        double far = 0;
        for (size_t v = 0; v < n; v++) {
            double square = 0;
            for (size_t c = 0; c < 3; c++) {
                square += pow(d[run].Y[c * n + v] - d[0].Y[c * n + v], 2);
            }
            far = fmax(far, sqrt(square) / d[0].diameter);
        }
        print_message("%d solves: %.2g from the limit, %.2g lately\n", how[run].solves, far,
                      how[run].lately);
        assert_true(how[run].converged == (run < 2));
        assert_true(run < 2 ? far < 1e-4 && how[run].lately == 0
                            : far > 0.01 && far < 3 * how[run].lately && how[run].lately < 3 * far);
    }
    for (int run = 0; run < 3; run++) {
        deformer_free(&d[run]);
    }
    mesh_free(&m);
}

/* Handles released and grabbed again, in any order, leave the same problem. */
static void handles_come_and_go(void **state) {
    (void)state;
    const double shift[3] = {0.2, 0.1, 0.3};
    for (int k = 0; k < 2 * N_SURFACES; k++) {
        scene_t s;
        scene_make(&s, surfaces[k / 2], k % 2 ? DEFORM_BIHARMONIC : DEFORM_ARAP);
        const size_t n = (size_t)s.m.n_vertices;
        double to[N_HANDLES][3];
        for (int h = 0; h < N_HANDLES; h++) {
            move_rigidly(&s, h, 0.1 * h, shift, to[h]);
        }
        solve(&s, 3);
        double *before = test_reals(3 * n);
        memcpy(before, s.d.Y, 3 * n * sizeof *before);
        for (int h = 0; h < N_HANDLES; h += 2) {
            SL_CHECK(deformer_release(&s.d, &s.handles[h], 1));
            SL_CHECK(deformer_release(&s.d, &s.handles[h], 1)); /* nothing */
        }
        SL_CHECK(deformer_hold(&s.d, &s.handles[1], 1)); /* held already */
        assert_int_equal(pins_count(s.d.pins), N_HANDLES / 2);
        SL_CHECK(deformer_solve(&s.d)); /* with the same rotations */
        assert_agrees_with_new_factor(&s);
        for (int h = 0; h < N_HANDLES; h += 2) {
            SL_CHECK(deformer_hold(&s.d, &s.handles[h], 1));
            deformer_move(&s.d, s.handles[h], to[h]);
        }
        SL_CHECK(deformer_solve(&s.d));
        for (size_t v = 0; v < 3 * n; v++) {
            assert_true(fabs(s.d.Y[v] - before[v]) < 1e-9);
        }
        for (int h = 0; h < N_HANDLES; h++) {
            SL_CHECK(deformer_release(&s.d, &s.handles[h], 1));
        }
        double mean[3] = {0}, after[3] = {0};
        for (size_t v = 0; v < 3 * n; v++) {
            mean[v / n] += (k % 2 ? s.d.rest[v] : s.d.Y[v]) / (double)n;
        }
        solve(&s, 1);
        for (size_t v = 0; v < 3 * n; v++) {
            after[v / n] += s.d.Y[v] / (double)n;
        }
        for (int c = 0; c < 3; c++) {
            assert_true(fabs(after[c] - mean[c]) < 1e-9);
        }
        free(before);
        scene_free(&s);
    }
}

static void watched_vertices_are_those_of_the_surface(void **state) {
    (void)state;
    for (int k = 0; k < N_SURFACES; k++) {
        scene_t s;
        scene_make(&s, surfaces[k], DEFORM_BIHARMONIC);
        const size_t n = (size_t)s.m.n_vertices;
        const sl_int near[5] = {s.handles[2], 3, 90, 0, 17};
        const double shift[3] = {0.2, 0.5, 0.3};
        double Y[15], to[3];
        SL_EXPECT(SL_ERR_ARGUMENT, deformer_watch(&s.d, &s.m.n_vertices, 1));
        SL_CHECK(deformer_watch(&s.d, near, 5));
        for (int h = 0; h < N_HANDLES; h++) {
            move_rigidly(&s, h, 0.3 * h, shift, to);
            SL_CHECK(deformer_solve_watched(&s.d, Y));
            SL_CHECK(deformer_solve(&s.d));
            for (size_t i = 0; i < 15; i++) {
                assert_true(fabs(Y[i] - s.d.Y[i / 5 * n + (size_t)near[i % 5]]) < 1e-11);
            }
        }
        for (int h = 0; h < N_HANDLES; h++) {
            SL_CHECK(deformer_release(&s.d, &s.handles[h], 1));
        }
        SL_CHECK(deformer_solve_watched(&s.d, Y));
        for (size_t i = 0; i < 15; i++) {
            assert_true(Y[i] == s.d.rest[i / 5 * n + (size_t)near[i % 5]]);
        }
        scene_free(&s);
    }
    scene_t s;
    scene_make(&s, "star:2", DEFORM_ARAP);
    SL_EXPECT(SL_ERR_UNSUPPORTED, deformer_watch(&s.d, s.handles, 1));
    scene_free(&s);
}

/* Two tetrahedra and a vertex without faces: what is not held stays, whatever is not joined. */
static void components_move_by_themselves(void **state) {
    (void)state;
    static double xyz[27] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0,
                             0, 6, 0, 0, 5, 1, 0, 5, 0, 1, 9, 9, 9};
    static sl_int faces[24] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2,
                               4, 6, 5, 4, 5, 7, 5, 6, 7, 4, 7, 6};
    const mesh m = {9, 8, xyz, faces};
    const double to[3] = {2, 2, 2};
    for (int k = 0; k < 2; k++) {
        deformer d;
        SL_CHECK(deformer_create(&d, &m, k ? DEFORM_BIHARMONIC : DEFORM_ARAP));
        assert_int_equal(d.n_components, 3);
        SL_CHECK(deformer_hold(&d, (const sl_int[]){1}, 1));
        deformer_move(&d, 1, to);
        (void)deformer_rotations(&d);
        SL_CHECK(deformer_solve(&d));
        for (size_t v = 0; v < 27; v++) { /* one held vertex moves its component by itself */
            const double shift[3] = {1, 2, 2};
            const double want = xyz[v % 9 * 3 + v / 9] + (v % 9 < 4 ? shift[v / 9] : 0);
            assert_true(fabs(d.Y[v] - want) < 1e-12);
        }
        SL_CHECK(deformer_hold(&d, (const sl_int[]){8}, 1));
        deformer_move(&d, 8, to);
        SL_CHECK(deformer_solve(&d));
        assert_true(d.Y[8] == 2 && d.Y[17] == 2 && d.Y[26] == 2);
        double difference, seconds;
        SL_CHECK(deformer_compare(&d, &difference, &seconds));
        assert_true(difference < 1e-14);
        d.U[2] += 0.01; /* the comparison notices a wrong position */
        SL_CHECK(deformer_compare(&d, &difference, &seconds));
        assert_true(difference > 1e-4);
        deformer_free(&d);
    }
}

/* Many handles are fixed in a factor of the others and give the positions of a new factor. */
static void many_handles_are_fixed(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        scene_t s;
        sl_int held[900], count = 0;
        assert_true(surface_generate(&s.m, "hills:40x40", NULL, 0));
        SL_CHECK(deformer_create(&s.d, &s.m, k == 0 ? DEFORM_ARAP : DEFORM_BIHARMONIC));
        for (sl_int v = 0; v < s.m.n_vertices && count < 900; v += 1 + v % 2) {
            held[count++] = v;
        }
        SL_CHECK(deformer_hold(&s.d, held, count));
        assert_true(s.d.anew && !s.d.refused);
        deformer_move(&s.d, held[7], (const double[3]){1, 2, 3});
        solve(&s, 2);
        assert_agrees_with_new_factor(&s);
        SL_CHECK(deformer_release(&s.d, held, count / 2));
        solve(&s, 2);
        assert_agrees_with_new_factor(&s);
        scene_free(&s);
    }
}

/* Gaussian elimination with partial pivoting: A is n x n by rows, B n x 3; B becomes X. */
static void eliminate(long double *A, long double *B, size_t n) {
    for (size_t k = 0; k < n; k++) {
        size_t best = k;
        for (size_t i = k; i < n; i++) {
            best = fabsl(A[i * n + k]) > fabsl(A[best * n + k]) ? i : best;
        }
        for (size_t j = 0; j < n + 3; j++) {
            long double *p = j < n ? &A[k * n + j] : &B[k * 3 + j - n];
            long double *q = j < n ? &A[best * n + j] : &B[best * 3 + j - n], t = *p;
            *p = *q;
            *q = t;
        }
        for (size_t i = 0; i < n; i++) {
            const long double f = i == k ? 0 : A[i * n + k] / A[k * n + k];
            for (size_t j = k; j < n + 3 && f != 0; j++) {
                *(j < n ? &A[i * n + j] : &B[i * 3 + j - n]) -=
                    f * (j < n ? A[k * n + j] : B[k * 3 + j - n]);
            }
        }
    }
    for (size_t k = 0; k < 3 * n; k++) {
        B[k] /= A[k / 3 * n + k / 3];
    }
}

/* The farthest that displacements are from those of the mixed system in long double. */
static double error_of_biharmonic(const deformer *d) {
    const size_t n = (size_t)d->n;
    const sl_csc L = sl_matrix_view(d->L);
    size_t *at = (size_t *)test_array(n, sizeof *at), size = n;
    double worst = 0;
    for (size_t v = 0; v < n; v++) { /* the unknown of its displacement */
        at[v] = d->is_held[v] ? SIZE_MAX : size++;
    }
    long double *A = (long double *)test_array(size * size, sizeof *A);
    long double *B = (long double *)test_array(3 * size, sizeof *B);
    for (size_t v = 0; v < n; v++) {
        A[v * size + v] = -(long double)d->mass[v];
    }
    for (size_t k = 0; k < 2 * n; k++) { /* both triangles */
        const sl_int j = (sl_int)(k / 2);
        for (sl_int p = L.p[j]; p < L.p[j + 1]; p++) {
            const size_t r = (size_t)(k % 2 ? L.i[p] : j), c = (size_t)(k % 2 ? j : L.i[p]);
            if (at[c] != SIZE_MAX && (r != c || k % 2)) {
                A[r * size + at[c]] = A[at[c] * size + r] = L.x[p];
            }
            for (size_t e = 0; e < 3 && at[c] == SIZE_MAX && (r != c || k % 2); e++) {
                B[3 * r + e] -=
                    L.x[p] * ((long double)d->target[3 * c + e] - (long double)d->rest[e * n + c]);
            }
        }
    }
    eliminate(A, B, size);
    for (size_t k = 0; k < 3 * n; k++) {
        const size_t row = at[k % n];
        if (row != SIZE_MAX) {
            const double want = (double)B[3 * row + k / n];
            worst = fmax(worst, fabs(d->Y[k] - d->rest[k] - want));
        }
    }
    free(A);
    free(B);
    free(at);
    return worst / d->diameter;
}

/* With faces as thin as 1e-7 the squared system loses all digits, without a word. Displacements
 * are those of the mixed system, by corrections or by its factor; also at the wanted vertices
 * alone, and a new factor agrees. */
static void thin_faces_cost_no_digits(void **state) {
    (void)state;
    static const double thin[3] = {1e-3, 1e-5, 1e-7};
    for (int k = 0; k < 3; k++) {
        scene_t s;
        double to[3], difference, seconds, Y[6];
        assert_true(surface_generate(&s.m, "sphere:2", NULL, 0));
        for (sl_int j = 0; j < 40; j++) { /* two in each of 20 faces, near a corner */
            const face_point p = {7 * (j / 2), thin[k], thin[k] / (1 + j % 2)};
            sl_int vertex;
            assert_true(insert_face_point(&s.m, &p, &vertex));
        }
        SL_CHECK(deformer_create(&s.d, &s.m, DEFORM_BIHARMONIC));
        for (int h = 0; h < N_HANDLES; h++) {
            s.handles[h] = h * 23;
            SL_CHECK(deformer_hold(&s.d, &s.handles[h], 1));
            move_rigidly(&s, h, 0.3 * h, (const double[3]){0.1, 0.2, 0.3}, to);
        }
        const sl_int near[2] = {100, s.m.n_vertices - 1};
        SL_CHECK(deformer_watch(&s.d, near, 2));
        SL_CHECK(deformer_solve_watched(&s.d, Y));
        SL_CHECK(deformer_solve(&s.d));
        const double error = error_of_biharmonic(&s.d);
        print_message("thin %.0e: off by %.2g, %s\n", thin[k], error,
                      s.d.squared ? "squared" : "mixed");
        assert_true(error < 1e-8 && s.d.squared == (k == 0));
        for (size_t i = 0; i < 6; i++) {
            const size_t v = (size_t)near[i % 2];
            assert_true(fabs(Y[i] - s.d.Y[i / 2 * (size_t)s.d.n + v]) < (k == 0 ? 1e-6 : 1e-12));
        }
        SL_CHECK(deformer_compare(&s.d, &difference, &seconds));
        assert_true(difference < 1e-8);
        SL_CHECK(deformer_release(&s.d, s.handles, 2));
        SL_CHECK(deformer_solve(&s.d));
        assert_true(error_of_biharmonic(&s.d) < 1e-8);
        scene_free(&s);
    }
}

/* Positions beyond the range of numbers are an error and change nothing. */
static void overflow_is_an_error(void **state) {
    (void)state;
    scene_t s;
    scene_make(&s, "star:1", DEFORM_ARAP);
    const double far[3] = {1e308, 0, 0}, back[3] = {-1e308, 0, 0};
    deformer_move(&s.d, s.handles[0], far);
    deformer_move(&s.d, s.handles[1], back);
    SL_EXPECT(SL_ERR_NOT_FINITE, deformer_solve(&s.d));
    for (sl_int v = 0; v < 3 * s.d.n; v++) {
        assert_true(s.d.Y[v] == s.d.rest[v]);
    }
    scene_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rigid_motions_of_all_handles_move_everything),
        cmocka_unit_test(energies_fall),
        cmocka_unit_test(relaxation_reaches_the_limit),
        cmocka_unit_test(large_turns_settle),
        cmocka_unit_test(handles_come_and_go),
        cmocka_unit_test(watched_vertices_are_those_of_the_surface),
        cmocka_unit_test(components_move_by_themselves),
        cmocka_unit_test(many_handles_are_fixed),
        cmocka_unit_test(thin_faces_cost_no_digits),
        cmocka_unit_test(overflow_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
