/* test_disk.c: patches that are topological disks: grown, made from a list, refused */
#include "tests/lib/surfaces.h"
#include "tests/lib/check_disk.h"
#include "tests/lib/real_meshes.h"

/* Corners of local faces are those of the mesh, vertices keep their coordinates, and the rim is the
 * vertices that miss a face of the mesh. */
static void assert_is_part_of(const submesh *p, const incidence *a) {
    const mesh *m = a->m;
    sl_int interface = 0;
    for (sl_int f = 0; f < p->m.n_faces; f++) {
        const sl_int *there = m->faces + 3 * (size_t)p->mesh_faces[f];
        sl_int here[3];
        for (int c = 0; c < 3; c++) {
            here[c] = p->vertices[p->m.faces[3 * f + c]];
        }
        for (int c = 0; c < 3; c++) {
            assert_true(there[c] == here[0] || there[c] == here[1] || there[c] == here[2]);
        }
    }
    for (sl_int v = 0; v < p->m.n_vertices; v++) {
        sl_int faces = 0;
        SAME_VALUES(p->m.xyz + 3 * v, m->xyz + 3 * (size_t)p->vertices[v], 3);
        for (size_t c = 0; c < 3 * (size_t)p->m.n_faces; c++) {
            faces += p->m.faces[c] == v;
        }
        if (faces < a->begin[p->vertices[v] + 1] - a->begin[p->vertices[v]]) {
            assert_true(interface < p->n_interface && p->interface[interface] == v);
            interface++;
        }
    }
    assert_int_equal(interface, p->n_interface);
}

static void grown_patches_are_disks(void **state) {
    (void)state;
    mesh_factor_t w;
    for (int which = 0; which < 3; which++) {
        mesh_factor_make(&w, which == 0   ? flat_grid(14, 0.2)
                       : which == 1 ? torus_grid(12, 9)
                                    : sphere_grid(14, 1));
        for (sl_int start = 0; start < w.m.n_vertices; start += 13) {
            for (sl_int count = 3; count <= w.m.n_vertices; count = 2 * count + 1) {
                disk_patch d = grown_disk(&w, start, count);
                bool has_start = false;
                assert_true(d.p.m.n_vertices <= count);
                assert_true(which == 1 || d.p.m.n_vertices == count);
                for (sl_int k = 0; k < d.p.m.n_vertices; k++) {
                    has_start = has_start || d.p.vertices[k] == start;
                }
                assert_true(has_start);
                assert_is_disk(&d);
                assert_is_part_of(&d.p, &w.inc);
                assert_scratch_is_clean(&w.inc);
                disk_patch_free(&d);
            }
        }
        mesh_factor_free(&w);
    }
}

/* A disk of the whole grid has no rim, and its boundary is that of the mesh. On a torus a seam
 * remains. */
static void rims_and_seams_are_found(void **state) {
    (void)state;
    mesh_factor_t w;
    disk_patch d;
    sl_int seam = -1;
    mesh_factor_make(&w, flat_grid(9, 0.1));
    assert_true(disk_patch_grow(&d, &w.inc, 40, 1000, &seam, NULL, 0));
    assert_int_equal(d.p.m.n_faces, w.m.n_faces);
    assert_int_equal(d.p.n_interface, 0);
    assert_int_equal(d.n_boundary, 32);
    assert_int_equal(seam, 0);
    disk_patch_free(&d);
    mesh_factor_free(&w);
    mesh_factor_make(&w, torus_grid(8, 7));
    assert_true(disk_patch_grow(&d, &w.inc, 0, 1000, &seam, NULL, 0));
    assert_is_disk(&d);
    /* Faces with all corners in the disk. */
    sl_int between = 0;
    for (sl_int f = 0; f < w.m.n_faces; f++) {
        int in = 0;
        for (sl_int k = 0; k < d.p.m.n_vertices; k++) {
            for (int c = 0; c < 3; c++) {
                in += w.m.faces[3 * f + c] == d.p.vertices[k];
            }
        }
        between += in == 3;
    }
    assert_true(seam > 0);
    assert_int_equal(seam, between - d.p.m.n_faces);
    disk_patch_free(&d);
    mesh_factor_free(&w);
}

/* A closed tube of `rings` rings of 8 vertices. The last two vertices close its ends. */
static mesh closed_tube(sl_int rings) {
    mesh m = {8 * rings + 2, 16 * rings, NULL, NULL};
    m.xyz = test_reals(3 * (size_t)m.n_vertices);
    m.faces = test_ints(3 * (size_t)m.n_faces);
    sl_int *f = m.faces;
    for (sl_int r = 0; r < rings; r++) {
        for (sl_int k = 0; k < 8; k++) {
            sl_int here = 8 * r + k, next = 8 * r + (k + 1) % 8;
            double *x = m.xyz + 3 * (size_t)here;
            x[0] = cos(k * 3.14159265358979 / 4);
            x[1] = sin(k * 3.14159265358979 / 4);
            x[2] = r;
            if (r == 0) {
                const sl_int low[3] = {next, here, 8 * rings};
                memcpy(f, low, sizeof low);
                f += 3;
            }
            const sl_int side[3] = {here, next, r + 1 < rings ? here + 8 : 8 * rings + 1};
            const sl_int other[3] = {next, next + 8, here + 8};
            memcpy(f, side, sizeof side);
            f += 3;
            if (r + 1 < rings) {
                memcpy(f, other, sizeof other);
                f += 3;
            }
        }
    }
    m.xyz[24 * rings + 2] = -1;
    m.xyz[24 * rings + 5] = rings;
    return m;
}

/* A patch that meets itself around a finger includes the tip if the tip is smaller than the
 * patch. */
static void enclosed_tips_are_included(void **state) {
    (void)state;
    mesh_factor_t w;
    disk_patch d;
    sl_int seam;
    mesh_factor_make(&w, closed_tube(60));
    for (sl_int ring = 0; ring < 60; ring += 4) {
        for (sl_int count = 20; count <= 200; count += 30) {
            assert_true(disk_patch_grow(&d, &w.inc, 8 * ring + 3, count, &seam, NULL, 0));
            assert_is_disk(&d);
            assert_is_part_of(&d.p, &w.inc);
            assert_true(d.p.m.n_vertices < 2 * count);
            /* The tip, vertex 480, is in the disk. */
            if (ring == 0 || (ring == 4 && count >= 80)) {
                bool tip = false;
                for (sl_int k = 0; k < d.p.m.n_vertices; k++) {
                    tip = tip || d.p.vertices[k] == 480;
                }
                assert_true(tip && seam == 0);
            }
            /* Both ends are larger than the patch. */
            if (ring == 28 && (count == 80 || count == 110)) {
                assert_true(seam > 0 && d.p.m.n_vertices <= count);
            }
            disk_patch_free(&d);
        }
    }
    mesh_factor_free(&w);
}

static void assert_refused(mesh_factor_t *w, const sl_int *list, sl_int count, const char *reason) {
    disk_patch d;
    char message[200] = "";
    assert_false(disk_patch_from_vertices(&d, &w->inc, list, count, message, sizeof message));
    if (strstr(message, reason) == NULL) {
        print_error("\"%s\" instead of \"%s\"\n", message, reason);
        fail();
    }
    assert_null(d.boundary);
    assert_null(d.p.vertices);
    assert_scratch_is_clean(&w->inc);
    assert_false(disk_patch_from_vertices(&d, &w->inc, list, count, NULL, 0));
}

/* Lists on a grid of 6 x 6, where vertex (x, y) is x + 6 y. */
static void lists_on_a_grid_are_checked(void **state) {
    (void)state;
    mesh_factor_t w;
    disk_patch d;
    mesh_factor_make(&w, flat_grid(6, 0));
    const sl_int square[4] = {8, 7, 14, 13}, range[3] = {0, 1, 36}, low[2] = {-1, 3};
    const sl_int twice[5] = {7, 8, 13, 14, 7}, lone[5] = {7, 8, 13, 14, 33};
    const sl_int few[2] = {0, 1}, pieces[8] = {0, 1, 6, 7, 22, 23, 28, 29};
    /* The squares 1 2 7 8 and 6 7 12 13 touch in vertex 7. */
    const sl_int touching[7] = {1, 2, 7, 8, 6, 12, 13};
    assert_true(disk_patch_from_vertices(&d, &w.inc, square, 4, NULL, 0));
    assert_is_disk(&d);
    assert_is_part_of(&d.p, &w.inc);
    assert_int_equal(d.p.vertices[2], 14);
    assert_int_equal(d.p.m.n_faces, 2);
    disk_patch_free(&d);
    assert_refused(&w, range, 3, "vertex 36 is out of range: the mesh has 36 vertices");
    assert_refused(&w, low, 2, "vertex -1");
    assert_refused(&w, twice, 5, "vertex 7 is listed twice");
    assert_refused(&w, lone, 5, "it has no face at vertex 33");
    assert_refused(&w, few, 2, "no face has all its corners");
    assert_refused(&w, few, 0, "no face has all its corners");
    assert_refused(&w, pieces, 8, "several pieces");
    assert_refused(&w, touching, 7, "several pieces");
    mesh_factor_free(&w);
}

static void lists_that_are_not_disks_are_refused(void **state) {
    (void)state;
    mesh_factor_t w;
    /* Without its middle the grid is a ring. */
    mesh_factor_make(&w, flat_grid(12, 0));
    sl_int *list = first_vertices(144), count = 0;
    for (sl_int v = 0; v < 144; v++) {
        sl_int x = v % 12, y = v / 12;
        if (x < 4 || x > 7 || y < 4 || y > 7) {
            list[count++] = v;
        }
    }
    assert_refused(&w, list, count, "more than one boundary");
    free(list);
    mesh_factor_free(&w);
    mesh_factor_make(&w, torus_grid(9, 8));
    list = first_vertices(72);
    assert_refused(&w, list, 72, "closed");
    assert_refused(&w, list, 71, "handle"); /* a torus without the faces around one vertex */
    assert_refused(&w, list + 8, 56, "more than one"); /* a tube */
    free(list);
    mesh_factor_free(&w);
}

/* Meshes that are not surfaces: three faces at an edge, a Moebius strip, a pinch. Faces of random
 * orientation are accepted. */
static void meshes_that_are_not_surfaces_are_refused(void **state) {
    (void)state;
    mesh_factor_t w;
    disk_patch d;
    mesh m = flat_grid(6, 0);
    m.faces[3 * 7] = m.faces[0]; /* one face now shares another edge */
    m.faces[3 * 7 + 1] = m.faces[2];
    mesh_factor_make(&w, m);
    sl_int *list = first_vertices(36);
    assert_refused(&w, list, 36, "the edge of vertices 0 and 7 has three faces");
    /* Growing avoids that edge. */
    for (sl_int start = 0; start < 36; start++) {
        if (w.inc.begin[start] < w.inc.begin[start + 1]) {
            d = grown_disk(&w, start, 36);
            assert_is_disk(&d);
            disk_patch_free(&d);
        }
    }
    mesh_factor_free(&w);

    /* Faces of the wrong orientation are turned back. */
    m = flat_grid(6, 0);
    for (sl_int f = 1; f < m.n_faces; f += 3) {
        sl_int v = m.faces[3 * f];
        m.faces[3 * f] = m.faces[3 * f + 1];
        m.faces[3 * f + 1] = v;
    }
    mesh_factor_make(&w, m);
    assert_true(disk_patch_from_vertices(&d, &w.inc, list, 36, NULL, 0));
    assert_is_disk(&d);
    disk_patch_free(&d);
    d = grown_disk(&w, 17, 20);
    assert_is_disk(&d);
    disk_patch_free(&d);
    mesh_factor_free(&w);

    /* A band of 5 squares whose ends are joined with a half twist; square k starts at vertices 2k
     * and 2k + 1. */
    sl_int strip[30];
    m = flat_grid(4, 0);
    for (sl_int k = 0; k < 5; k++) {
        sl_int a = 2 * k, b = 2 * k + 1, c = k < 4 ? 2 * k + 2 : 1, e = k < 4 ? 2 * k + 3 : 0;
        const sl_int corners[6] = {a, b, c, b, e, c};
        memcpy(strip + 6 * k, corners, sizeof corners);
    }
    memcpy(m.faces, strip, sizeof strip);
    m.n_faces = 10;
    mesh_factor_make(&w, m);
    assert_refused(&w, list, 10, "one side only");
    mesh_factor_free(&w);

    const sl_int nonmanifold_vertices[15] = {0, 1, 2, 0, 3, 4, 2, 1, 5, 2, 5, 3, 3, 5, 4};
    /* Two fans around vertex 0 that are connected elsewhere. */
    m = flat_grid(4, 0);
    memcpy(m.faces, nonmanifold_vertices, sizeof nonmanifold_vertices);
    m.n_faces = 5;
    mesh_factor_make(&w, m);
    assert_refused(&w, list, 6, "touches itself at vertex 0");
    mesh_factor_free(&w);
    free(list);
}

static void bad_starts_are_refused(void **state) {
    (void)state;
    mesh_factor_t w;
    disk_patch d;
    char message[200];
    mesh m = flat_grid(5, 0);
    for (sl_int k = 0; k < 3 * m.n_faces; k++) {
        /* Then vertex 24 has no face, and one face has vertex 23 twice. */
        m.faces[k] = m.faces[k] == 24 ? 23 : m.faces[k];
    }
    mesh_factor_make(&w, m);
    assert_false(disk_patch_grow(&d, &w.inc, 25, 5, NULL, message, sizeof message));
    assert_non_null(strstr(message, "vertex 25: the mesh has no such vertex"));
    assert_false(disk_patch_grow(&d, &w.inc, -1, 5, NULL, message, sizeof message));
    assert_false(disk_patch_grow(&d, &w.inc, 24, 5, NULL, message, sizeof message));
    assert_non_null(strstr(message, "vertex 24: it has no face"));
    assert_false(disk_patch_grow(&d, &w.inc, 3, 2, NULL, message, sizeof message));
    assert_non_null(strstr(message, "3 or more"));
    assert_true(disk_patch_grow(&d, &w.inc, 3, 3, NULL, message, sizeof message));
    assert_is_disk(&d);
    disk_patch_free(&d);
    mesh_factor_free(&w);
    m = flat_grid(1, 0);
    incidence a;
    assert_true(incidence_create(&a, &m));
    assert_false(disk_patch_grow(&d, &a, 0, 3, NULL, NULL, 0));
    incidence_free(&a);
    mesh_free(&m);
}

/* Grows disks from several vertices, also where the mesh is not a surface. */
static void check_mesh(const char *name, mesh m) {
    incidence a;
    (void)name;
    assert_true(incidence_create(&a, &m));
    for (sl_int s = 0; s < 7; s++) {
        sl_int start = (sl_int)((int64_t)m.n_vertices * s / 7);
        disk_patch d;
        bool grows = a.begin[start] < a.begin[start + 1];
        assert_int_equal(disk_patch_grow(&d, &a, start, 400, NULL, NULL, 0), grows);
        if (grows) {
            assert_is_disk(&d);
            disk_patch_free(&d);
        }
    }
    assert_scratch_is_clean(&a);
    incidence_free(&a);
    mesh_free(&m);
}

static void real_meshes_give_disks(void **state) {
    (void)state;
    each_mesh(NULL, 0, INT32_MAX, check_mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grown_patches_are_disks),
        cmocka_unit_test(rims_and_seams_are_found),
        cmocka_unit_test(enclosed_tips_are_included),
        cmocka_unit_test(lists_on_a_grid_are_checked),
        cmocka_unit_test(lists_that_are_not_disks_are_refused),
        cmocka_unit_test(meshes_that_are_not_surfaces_are_refused),
        cmocka_unit_test(bad_starts_are_refused),
        cmocka_unit_test(real_meshes_give_disks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
