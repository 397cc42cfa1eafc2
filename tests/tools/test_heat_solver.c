/* test_heat_solver.c: solvers of the heat method: other times, adopted factors, refusals */
#include "tests/lib/heat_mesh.h"

#include "tools/mesh/surface_generator.h"

/* Long faces with obtuse angles: with a small time the heat is negative somewhere, with a larger
 * one it is not. Changing the time gives the bits of a solver created with it. */
static void obtuse_faces_need_a_larger_time(void **state) {
    (void)state;
    heat_mesh_t y, z;
    heat_field f;
    sl_int source = 100;
    mesh m, same;
    assert_true(surface_generate(&m, "star:5", NULL, 0));
    assert_true(surface_generate(&same, "star:5", NULL, 0));
    heat_mesh_make(&y, m, 1);
    heat_mesh_make(&z, same, 32);
    SL_CHECK(heat_distance(&f, &y.s, &source, 1, NULL));
    assert_true(f.negative > 100);
    heat_field_free(&f);
    SL_CHECK(heat_solver_set_time(&y.s, z.s.t));
    SL_CHECK(heat_distance(&f, &y.s, &source, 1, NULL));
    assert_int_equal(f.negative, 0);
    double *d = distance_by_vertex(&z, &source, 1, NULL);
    for (sl_int k = 0; k < f.n; k++) {
        assert_true(d[f.vertices[k]] == f.distance[k]);
        assert_true(f.distance[k] <= 1.1 * f.path[k] + 0.1);
    }
    SL_EXPECT(SL_ERR_ARGUMENT, heat_solver_set_time(&y.s, 0));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_solver_set_time(&y.s, NAN));
    free(d);
    heat_field_free(&f);
    heat_mesh_free(&y);
    heat_mesh_free(&z);
}

/* Adopted factors give the bits of those that were made, and their time. Of another mesh, even one
 * with the same faces and most of the vertices, they are refused. */
static void adopted_factors_give_the_same_distances(void **state) {
    (void)state;
    heat_mesh_t y;
    heat_solver s;
    sl_saved_set sets[2];
    const sl_int source = 11;
    heat_mesh_make(&y, flat_grid(10, 0.2), 4);
    double *d = distance_by_vertex(&y, &source, 1, NULL);
    for (int damage = 0; damage < 4; damage++) {
        heat_mesh_t made;
        mesh m = flat_grid(damage == 1 ? 9 : 10, 0.2);
        heat_mesh_make(&made, flat_grid(10, 0.2), 4);
        memset(sets, 0, sizeof sets);
        sets[0].symbolic = made.s.S;
        sets[0].factor = made.s.heat;
        sets[1].symbolic = made.s.S;
        sets[1].factor = damage == 3 ? NULL : made.s.poisson;
        sl_factor *left = damage == 3 ? made.s.poisson : NULL;
        made.s.S = made.s.poisson_S = NULL;
        made.s.heat = made.s.poisson = NULL;
        if (damage == 2) {
            m.xyz[3 * 44] += 1e-3;
        }
        sl_status status = heat_solver_adopt(&s, &m, NULL, &sets[0], &sets[1]);
        assert_true(sets[0].factor == NULL && sets[1].symbolic == NULL);
        assert_int_equal(status, damage == 0   ? SL_OK
                                 : damage == 3 ? SL_ERR_ARGUMENT
                                               : SL_ERR_MALFORMED);
        if (damage == 0) {
            heat_field f;
            assert_true(fabs(s.t - y.s.t) <= 1e-12 * y.s.t);
            SL_CHECK(heat_distance(&f, &s, &source, 1, NULL));
            assert_int_equal(f.n, 100);
            for (sl_int k = 0; k < f.n; k++) {
                assert_true(d[f.vertices[k]] == f.distance[k]);
            }
            heat_field_free(&f);
        }
        assert_true(status == SL_OK || s.S == NULL);
        heat_solver_free(&s);
        sl_factor_free(left);
        heat_mesh_free(&made);
        mesh_free(&m);
    }
    free(d);
    heat_mesh_free(&y);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    heat_mesh_t y;
    heat_field f;
    heat_solver s;
    const sl_int twice[2] = {3, 3}, beyond[1] = {100}, low[1] = {-1}, fine[1] = {3};
    const heat_options negative = {-1, 0, 0}, no_number = {NAN, 0, 0}, bad_margin = {1, -1, 0};
    sl_int cell[100];
    double most[100];
    heat_mesh_make(&y, flat_grid(10, 0), 1);
    SL_EXPECT(SL_ERR_ARGUMENT, heat_distance(&f, &y.s, twice, 2, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_distance(&f, &y.s, beyond, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_distance(&f, &y.s, low, 1, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_distance(&f, &y.s, fine, 0, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_distance(&f, &y.s, fine, 1, &negative));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_distance(&f, &y.s, fine, 1, &no_number));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_distance(&f, &y.s, fine, 1, &bad_margin));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_cells(cell, most, &y.s, twice, 2, 0, NULL, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_cells(cell, most, &y.s, fine, 1, -1, NULL, NULL));
    assert_null(f.vertices);
    SL_EXPECT(SL_ERR_ARGUMENT, heat_solver_create(&s, &y.m, 0, NULL));
    SL_EXPECT(SL_ERR_ARGUMENT, heat_solver_create(&s, &y.m, NAN, NULL));
    y.m.faces[5] = 100;
    SL_EXPECT(SL_ERR_ARGUMENT, heat_solver_create(&s, &y.m, 1, NULL));
    assert_null(s.S);
    y.m.faces[5] = 0;
    heat_mesh_free(&y);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obtuse_faces_need_a_larger_time),
        cmocka_unit_test(adopted_factors_give_the_same_distances),
        cmocka_unit_test(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
