/* test_sheet.c: sheets: gluing, orientation, boundaries, and cuts that leave a disk with holes */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/surfaces.h"

#include "tools/mesh/sheet_cut.h"
#include "tools/mesh/surface_generator.h"

static mesh generated(const char *name) {
    mesh m;
    assert_true(surface_generate(&m, name, NULL, 0));
    return m;
}

/* Mates point at each other and run in opposite directions; corners are those of the mesh. */
static void assert_is_sheet(const sheet *s) {
    for (sl_int side = 0; side < 3 * s->m.n_faces; side++) {
        const sl_int mate = s->mate[side];
        if (mate >= 0) {
            assert_int_equal(s->mate[mate], side);
            assert_true(sheet_from(s, side) == sheet_to(s, mate) &&
                        sheet_to(s, side) == sheet_from(s, mate));
            assert_int_equal(s->part[side / 3], s->part[mate / 3]);
        }
        assert_int_equal(s->vertex[s->m.faces[side]], s->whole->faces[s->corner[side]]);
    }
}

static sl_int count_loops(const sheet *s) {
    sl_int *loops = test_ints(3 * (size_t)s->m.n_faces + 1);
    sl_int *begin = test_ints(3 * (size_t)s->m.n_faces + 1);
    const sl_int count = sheet_boundary(s, loops, begin);
    free(begin);
    free(loops);
    return count;
}

/* V - E + F. */
static sl_int euler(const sheet *s) {
    sl_int edges = 0;
    for (sl_int side = 0; side < 3 * s->m.n_faces; side++) {
        edges += s->mate[side] < side;
    }
    return s->m.n_vertices - edges + s->m.n_faces;
}

/* Removes the faces from number `first` on, `count` of them. */
static void punch(unsigned char *taken, sl_int n_faces, sl_int first, sl_int count) {
    for (sl_int f = 0; f < n_faces; f++) {
        taken[f] = taken[f] && !(f >= first && f < first + count);
    }
}

/* Closed surfaces of genus 0 and 1, with and without holes, become connected and flat: of genus 0
 * with a boundary. Disks and disks with holes are not cut. */
static void cuts_leave_disks_with_holes(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int holes, cut;
    } cases[] = {{"sphere:2", 0, 1},   {"sphere:2", 1, 0},   {"sphere:2", 3, 0},
                 {"torus:20x9", 0, 1}, {"torus:20x9", 2, 1}, {"knot:40x8", 1, 1},
                 {"grid:9x7", 0, 0},   {"grid:9x7", 2, 0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        mesh m = generated(cases[k].name);
        unsigned char *taken = calloc((size_t)m.n_faces, 1);
        sheet s;
        sl_int edges;
        memset(taken, 1, (size_t)m.n_faces);
        for (int h = 0; h < cases[k].holes; h++) {
            punch(taken, m.n_faces, 20 + h * m.n_faces / 4, 1);
        }
        assert_true(sheet_create(&s, &m, taken));
        assert_is_sheet(&s);
        assert_int_equal(s.n_parts, 1);
        const sl_int before = count_loops(&s);
        assert_true(sheet_open(&s, &edges));
        assert_is_sheet(&s);
        assert_int_equal(edges > 0, cases[k].cut);
        assert_true(count_loops(&s) >= 1);
        assert_int_equal(euler(&s), 2 - count_loops(&s)); /* genus 0, connected */
        assert_true(cases[k].cut || count_loops(&s) == before);
        sheet_free(&s);
        free(taken);
        mesh_free(&m);
    }
}

/* A cut to a vertex inside reaches it: it is on the boundary then, and the part stays connected. */
/* How many faces are reached from face 0 over glued sides. */
static sl_int reached(const sheet *s) {
    sl_int *queue = test_ints((size_t)s->m.n_faces + 1), count = 0;
    unsigned char *seen = test_array((size_t)s->m.n_faces + 1, 1);
    seen[0] = 1;
    queue[count++] = 0;
    for (sl_int k = 0; k < count; k++) {
        for (sl_int side = 3 * queue[k]; side < 3 * queue[k] + 3; side++) {
            const sl_int other = s->mate[side] >= 0 ? s->mate[side] / 3 : queue[k];
            if (!seen[other]) {
                seen[other] = 1;
                queue[count++] = other;
            }
        }
    }
    free(queue);
    free(seen);
    return count;
}

/* Loops that pass many holes take no face off: all faces of a torus with random holes remain
 * joined, and it becomes a disk with holes. */
static void cuts_beside_holes_keep_the_sheet_whole(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 200; seed++) {
        mesh m = generated("torus:16x10");
        unsigned char *taken = test_array((size_t)m.n_faces, 1);
        double *x = test_reals((size_t)m.n_faces);
        sheet all, s;
        sl_int *sizes = test_ints((size_t)m.n_faces), largest = 0, cut = 0;
        gen_reals(x, (size_t)m.n_faces, seed);
        for (sl_int f = 0; f < m.n_faces; f++) {
            taken[f] = fabs(x[f]) > 0.02 * (double)(1 + seed % 10);
        }
        assert_true(sheet_create(&all, &m, taken));
        for (sl_int f = 0; f < all.m.n_faces; f++) {
            sizes[all.part[f]]++;
            largest = sizes[all.part[f]] > sizes[largest] ? all.part[f] : largest;
        }
        assert_true(sheet_take_part(&s, &all, largest) && sheet_open(&s, &cut));
        assert_is_sheet(&s);
        assert_int_equal(reached(&s), s.m.n_faces);
        assert_int_equal(euler(&s) + count_loops(&s), 2);
        sheet_free(&s);
        sheet_free(&all);
        free(sizes);
        free(x);
        free(taken);
        mesh_free(&m);
    }
}

static void cuts_reach_their_vertex(void **state) {
    (void)state;
    mesh m = generated("grid:9x9");
    sheet s;
    sl_int edges;
    assert_true(sheet_create(&s, &m, NULL));
    assert_true(sheet_cut_to(&s, s.m.faces[3 * 60], &edges));
    assert_true(edges >= 1 && edges <= 4);
    assert_int_equal(s.m.n_vertices, 81 + edges);
    assert_int_equal(euler(&s), 1);
    sheet_free(&s);
    mesh_free(&m);
}

/* Turned faces are turned back; a Moebius strip is separated along an edge instead. */
static void faces_are_oriented(void **state) {
    (void)state;
    mesh m = generated("torus:12x7");
    sheet s;
    for (sl_int f = 1; f < m.n_faces; f += 3) {
        const sl_int kept = m.faces[3 * f];
        m.faces[3 * f] = m.faces[3 * f + 1];
        m.faces[3 * f + 1] = kept;
    }
    assert_true(sheet_create(&s, &m, NULL));
    assert_is_sheet(&s);
    assert_true(s.m.n_vertices == m.n_vertices && count_loops(&s) == 0);
    sheet_free(&s);
    mesh_free(&m);
    /* five triangles around: 0 1 2, 1 2 3, ... of five vertices */
    sl_int faces[15];
    double xyz[15] = {0};
    mesh strip = {5, 5, xyz, faces};
    for (sl_int k = 0; k < 15; k++) {
        faces[k] = (k / 3 + k % 3) % 5;
    }
    assert_true(sheet_create(&s, &strip, NULL));
    assert_is_sheet(&s);
    assert_true(s.n_parts == 1 && count_loops(&s) == 1 && euler(&s) == 1);
    sheet_free(&s);
}

/* Three faces at an edge, two surfaces at a vertex, and a face with a repeated vertex. */
static void what_is_no_surface_is_separated(void **state) {
    (void)state;
    sl_int faces[] = {0, 1, 2, 1, 0, 3, 0, 1, 4, 2, 5, 6, 3, 3, 1};
    double xyz[21] = {0};
    mesh m = {7, 5, xyz, faces};
    sheet s;
    assert_true(sheet_create(&s, &m, NULL));
    assert_true(s.left_out == 1 && s.m.n_faces == 4 && s.n_parts == 4 && s.m.n_vertices == 12);
    sheet_free(&s);
    faces[14] = 7;
    assert_false(sheet_create(&s, &m, NULL));
}

/* A tetrahedron with a third face at an edge stays closed, and the face is a part of its own. */
static void slits_are_closed(void **state) {
    (void)state;
    sl_int faces[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 1, 4};
    double xyz[15] = {0};
    mesh m = {5, 5, xyz, faces};
    sheet s;
    assert_true(sheet_create(&s, &m, NULL));
    assert_is_sheet(&s);
    assert_true(s.n_parts == 2 && s.m.n_vertices == 7 && count_loops(&s) == 1);
    sheet_free(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_leave_disks_with_holes),
        cmocka_unit_test(cuts_beside_holes_keep_the_sheet_whole),
        cmocka_unit_test(cuts_reach_their_vertex),
        cmocka_unit_test(faces_are_oriented),
        cmocka_unit_test(what_is_no_surface_is_separated),
        cmocka_unit_test(slits_are_closed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
