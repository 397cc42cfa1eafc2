/* test_tools_disk.c: patches as disks: grown from a vertex, refused as lists with the reason, numbered locally */
#include "bent_grids.h"
#include "disk_checks.h"
#include "each_mesh.h"

/* Corners of local faces are those of the mesh's, vertices stand where they stood, the rim is where faces are missing. */
static void is_part_of(const part *p, const incidence *a) {
    const mesh *m = a->m;
    sl_int rim = 0;
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
            assert_true(rim < p->n_rim && p->rim[rim] == v);
            rim++;
        }
    }
    assert_int_equal(rim, p->n_rim);
}

static void grown_disks(void **state) {
    (void)state;
    whole_t w;
    for (int which = 0; which < 3; which++) {
        whole_make(&w, which == 0   ? flat_grid(14, 0.2)
                       : which == 1 ? torus_grid(12, 9)
                                    : sphere_grid(14, 1));
        for (sl_int start = 0; start < w.m.n_vertices; start += 13) {
            for (sl_int count = 3; count <= w.m.n_vertices; count = 2 * count + 1) {
                disk d = grown_disk(&w, start, count);
                bool has_start = false;
                assert_true(d.p.m.n_vertices <= count);
                assert_true(which == 1 || d.p.m.n_vertices == count);
                for (sl_int k = 0; k < d.p.m.n_vertices; k++) {
                    has_start = has_start || d.p.vertices[k] == start;
                }
                assert_true(has_start);
                is_disk(&d);
                is_part_of(&d.p, &w.around);
                scratch_is_clean(&w.around);
                disk_free(&d);
            }
        }
        whole_free(&w);
    }
}

/* A disk of the whole grid has no rim: the mesh's boundary is its own. On the torus a seam remains. */
static void rims_and_seams(void **state) {
    (void)state;
    whole_t w;
    disk d;
    sl_int seam = -1;
    whole_make(&w, flat_grid(9, 0.1));
    assert_true(disk_grow(&d, &w.around, 40, 1000, &seam, NULL, 0));
    assert_int_equal(d.p.m.n_faces, w.m.n_faces);
    assert_int_equal(d.p.n_rim, 0);
    assert_int_equal(d.n_boundary, 32);
    assert_int_equal(seam, 0);
    disk_free(&d);
    whole_free(&w);
    whole_make(&w, torus_grid(8, 7));
    assert_true(disk_grow(&d, &w.around, 0, 1000, &seam, NULL, 0));
    is_disk(&d);
    sl_int between = 0; /* faces with all corners in the disk */
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
    disk_free(&d);
    whole_free(&w);
}

/* A closed tube of `rings` rings of 8 vertices, the last two vertices its ends. */
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

/* A patch that meets itself around a finger takes the tip too, if it is smaller than the patch. */
static void enclosed_tips(void **state) {
    (void)state;
    whole_t w;
    disk d;
    sl_int seam;
    whole_make(&w, closed_tube(60));
    for (sl_int ring = 0; ring < 60; ring += 4) {
        for (sl_int count = 20; count <= 200; count += 30) {
            assert_true(disk_grow(&d, &w.around, 8 * ring + 3, count, &seam, NULL, 0));
            is_disk(&d);
            is_part_of(&d.p, &w.around);
            assert_true(d.p.m.n_vertices < 2 * count);
            if (ring == 0 || (ring == 4 && count >= 80)) { /* the tip, vertex 480, is in */
                bool tip = false;
                for (sl_int k = 0; k < d.p.m.n_vertices; k++) {
                    tip = tip || d.p.vertices[k] == 480;
                }
                assert_true(tip && seam == 0);
            }
            if (ring == 28 && (count == 80 || count == 110)) { /* both ends are larger */
                assert_true(seam > 0 && d.p.m.n_vertices <= count);
            }
            disk_free(&d);
        }
    }
    whole_free(&w);
}

static void refused(whole_t *w, const sl_int *list, sl_int count, const char *reason) {
    disk d;
    char message[200] = "";
    assert_false(disk_of_list(&d, &w->around, list, count, message, sizeof message));
    if (strstr(message, reason) == NULL) {
        print_error("\"%s\" instead of \"%s\"\n", message, reason);
        fail();
    }
    assert_null(d.boundary);
    assert_null(d.p.vertices);
    scratch_is_clean(&w->around);
    assert_false(disk_of_list(&d, &w->around, list, count, NULL, 0));
}

/* Lists on a grid of 6 x 6: vertex (x, y) is x + 6 y. */
static void lists_on_a_grid(void **state) {
    (void)state;
    whole_t w;
    disk d;
    whole_make(&w, flat_grid(6, 0));
    const sl_int square[4] = {8, 7, 14, 13}, range[3] = {0, 1, 36}, low[2] = {-1, 3};
    const sl_int twice[5] = {7, 8, 13, 14, 7}, lone[5] = {7, 8, 13, 14, 33};
    const sl_int few[2] = {0, 1}, pieces[8] = {0, 1, 6, 7, 22, 23, 28, 29};
    const sl_int touching[7] = {1, 2, 7, 8, 6, 12, 13}; /* squares 1 2 7 8 and 6 7 12 13 */
    assert_true(disk_of_list(&d, &w.around, square, 4, NULL, 0));
    is_disk(&d);
    is_part_of(&d.p, &w.around);
    assert_int_equal(d.p.vertices[2], 14);
    assert_int_equal(d.p.m.n_faces, 2);
    disk_free(&d);
    refused(&w, range, 3, "vertex 36 of a mesh of 36");
    refused(&w, low, 2, "vertex -1");
    refused(&w, twice, 5, "vertex 7 is listed twice");
    refused(&w, lone, 5, "no face of it is at vertex 33");
    refused(&w, few, 2, "no face has all its corners");
    refused(&w, few, 0, "no face has all its corners");
    refused(&w, pieces, 8, "several pieces");
    refused(&w, touching, 7, "several pieces");
    whole_free(&w);
}

static void lists_that_are_no_disks(void **state) {
    (void)state;
    whole_t w;
    whole_make(&w, flat_grid(12, 0)); /* without its middle: a ring */
    sl_int *list = first_vertices(144), count = 0;
    for (sl_int v = 0; v < 144; v++) {
        sl_int x = v % 12, y = v / 12;
        if (x < 4 || x > 7 || y < 4 || y > 7) {
            list[count++] = v;
        }
    }
    refused(&w, list, count, "more than one boundary");
    free(list);
    whole_free(&w);
    whole_make(&w, torus_grid(9, 8));
    list = first_vertices(72);
    refused(&w, list, 72, "closed");
    refused(&w, list, 71, "handle");            /* a torus less a fan */
    refused(&w, list + 8, 56, "more than one"); /* a tube */
    free(list);
    whole_free(&w);
}

/* Meshes in memory that no surface is: three faces at an edge, a Moebius strip, a pinch, faces turned at random. */
static void no_surfaces(void **state) {
    (void)state;
    whole_t w;
    disk d;
    mesh m = flat_grid(6, 0);
    m.faces[3 * 7] = m.faces[0]; /* some face now hangs on another edge */
    m.faces[3 * 7 + 1] = m.faces[2];
    whole_make(&w, m);
    sl_int *list = first_vertices(36);
    refused(&w, list, 36, "three faces at the edge of vertices 0 and 7");
    for (sl_int start = 0; start < 36; start++) { /* growing goes around it */
        if (w.around.begin[start] < w.around.begin[start + 1]) {
            d = grown_disk(&w, start, 36);
            is_disk(&d);
            disk_free(&d);
        }
    }
    whole_free(&w);

    m = flat_grid(6, 0); /* turned faces are turned back */
    for (sl_int f = 1; f < m.n_faces; f += 3) {
        sl_int v = m.faces[3 * f];
        m.faces[3 * f] = m.faces[3 * f + 1];
        m.faces[3 * f + 1] = v;
    }
    whole_make(&w, m);
    assert_true(disk_of_list(&d, &w.around, list, 36, NULL, 0));
    is_disk(&d);
    disk_free(&d);
    d = grown_disk(&w, 17, 20);
    is_disk(&d);
    disk_free(&d);
    whole_free(&w);

    sl_int strip
        [30]; /* a band of 5 squares whose end is glued on turned over: vertices 2k and 2k + 1 */
    m = flat_grid(4, 0);
    for (sl_int k = 0; k < 5; k++) {
        sl_int a = 2 * k, b = 2 * k + 1, c = k < 4 ? 2 * k + 2 : 1, e = k < 4 ? 2 * k + 3 : 0;
        const sl_int corners[6] = {a, b, c, b, e, c};
        memcpy(strip + 6 * k, corners, sizeof corners);
    }
    memcpy(m.faces, strip, sizeof strip);
    m.n_faces = 10;
    whole_make(&w, m);
    refused(&w, list, 10, "one side only");
    whole_free(&w);

    const sl_int pinched[15] = {0, 1, 2, 0, 3, 4, 2, 1, 5, 2, 5, 3, 3, 5, 4};
    m = flat_grid(4, 0); /* two fans around 0 that hang together elsewhere */
    memcpy(m.faces, pinched, sizeof pinched);
    m.n_faces = 5;
    whole_make(&w, m);
    refused(&w, list, 6, "touches itself at vertex 0");
    whole_free(&w);
    free(list);
}

static void what_cannot_grow(void **state) {
    (void)state;
    whole_t w;
    disk d;
    char message[200];
    mesh m = flat_grid(5, 0);
    for (sl_int k = 0; k < 3 * m.n_faces; k++) {
        m.faces[k] = m.faces[k] == 24 ? 23 : m.faces[k]; /* 24 has no face; one face has 23 twice */
    }
    whole_make(&w, m);
    assert_false(disk_grow(&d, &w.around, 25, 5, NULL, message, sizeof message));
    assert_non_null(strstr(message, "no vertex 25"));
    assert_false(disk_grow(&d, &w.around, -1, 5, NULL, message, sizeof message));
    assert_false(disk_grow(&d, &w.around, 24, 5, NULL, message, sizeof message));
    assert_non_null(strstr(message, "no face is at vertex 24"));
    assert_false(disk_grow(&d, &w.around, 3, 2, NULL, message, sizeof message));
    assert_non_null(strstr(message, "3 or more"));
    assert_true(disk_grow(&d, &w.around, 3, 3, NULL, message, sizeof message));
    is_disk(&d);
    disk_free(&d);
    whole_free(&w);
    m = flat_grid(1, 0);
    incidence a;
    assert_true(incidence_create(&a, &m));
    assert_false(disk_grow(&d, &a, 0, 3, NULL, NULL, 0));
    incidence_free(&a);
    mesh_free(&m);
}

/* Every development mesh: disks from many vertices, also where the mesh is no surface. */
static void try_mesh(const char *name, mesh m) {
    incidence a;
    (void)name;
    assert_true(incidence_create(&a, &m));
    for (sl_int s = 0; s < 7; s++) {
        sl_int start = (sl_int)((int64_t)m.n_vertices * s / 7);
        disk d;
        bool grows = a.begin[start] < a.begin[start + 1];
        assert_int_equal(disk_grow(&d, &a, start, 400, NULL, NULL, 0), grows);
        if (grows) {
            is_disk(&d);
            disk_free(&d);
        }
    }
    scratch_is_clean(&a);
    incidence_free(&a);
    mesh_free(&m);
}

static void real_meshes(void **state) {
    (void)state;
    each_mesh(NULL, 0, INT32_MAX, try_mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grown_disks),
        cmocka_unit_test(rims_and_seams),
        cmocka_unit_test(enclosed_tips),
        cmocka_unit_test(lists_on_a_grid),
        cmocka_unit_test(lists_that_are_no_disks),
        cmocka_unit_test(no_surfaces),
        cmocka_unit_test(what_cannot_grow),
        cmocka_unit_test(real_meshes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
