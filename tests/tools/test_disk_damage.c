/* test_disk_damage.c: randomly damaged meshes are accepted as disks only if they are disks */
#include "tests/lib/gen_matrices.h"

#include "tests/lib/surfaces.h"
#include "tests/lib/check_disk.h"

/* Gives all members of the class of a the class of b. */
static void unite(sl_int *class_of, sl_int n, sl_int a, sl_int b) {
    sl_int from = class_of[a], to = class_of[b];
    for (sl_int k = 0; k < n; k++) {
        class_of[k] = class_of[k] == from ? to : class_of[k];
    }
}

/* Is the whole mesh a disk, for some orientation of its faces? By definition: every edge is in one
 * or two faces, the faces around a vertex form one fan, all faces are connected, and
 * V - E + F = 1. */
static bool is_disk_by_definition(const mesh *m) {
    sl_int n = m->n_vertices, edges = 0, piece[64], corner[192];
    for (sl_int f = 0; f < m->n_faces; f++) {
        piece[f] = f;
    }
    for (sl_int k = 0; k < 3 * m->n_faces; k++) {
        /* Corners at one vertex are joined across the edges there. */
        corner[k] = k;
    }
    for (sl_int u = 0; u < n; u++) {
        for (sl_int v = 0; v < u; v++) {
            sl_int at[64], count = 0;
            for (sl_int f = 0; f < m->n_faces; f++) {
                bool has_u = false, has_v = false;
                for (int c = 0; c < 3; c++) {
                    has_u = has_u || m->faces[3 * f + c] == u;
                    has_v = has_v || m->faces[3 * f + c] == v;
                }
                if (has_u && has_v) {
                    at[count++] = f;
                }
            }
            if (count > 2) {
                return false;
            }
            edges += count > 0;
            if (count == 2) {
                unite(piece, m->n_faces, at[0], at[1]);
                for (int c = 0; c < 9; c++) {
                    sl_int a = 3 * at[0] + c / 3, b = 3 * at[1] + c % 3;
                    if (m->faces[a] == m->faces[b]) {
                        unite(corner, 3 * m->n_faces, a, b);
                    }
                }
            }
        }
    }
    for (sl_int f = 0; f < m->n_faces; f++) {
        if (piece[f] != piece[0]) {
            return false;
        }
    }
    for (sl_int v = 0; v < n; v++) {
        sl_int fan = -1;
        for (sl_int k = 0; k < 3 * m->n_faces; k++) {
            if (m->faces[k] == v) {
                if (fan >= 0 && corner[k] != fan) {
                    return false;
                }
                fan = corner[k];
            }
        }
        if (fan < 0) {
            return false;
        }
    }
    return m->n_faces > 0 && n - edges + m->n_faces == 1;
}

/* Small meshes, randomly damaged: a mesh is accepted exactly if it is a disk, and what grows is a
 * disk. */
static void exactly_the_disks_are_accepted(void **state) {
    (void)state;
    uint64_t chance = 21;
    sl_int disks = 0, others = 0, *list = first_vertices(16);
    for (int round = 0; round < 3000; round++) {
        mesh m = round % 3 ? flat_grid(4, 0) : torus_grid(4, 4);
        incidence a;
        disk_patch d;
        for (sl_int damage = gen_below(&chance, 4); damage > 0; damage--) {
            sl_int f = gen_below(&chance, m.n_faces), g = gen_below(&chance, m.n_faces);
            sl_int how = gen_below(&chance, 4), c = gen_below(&chance, 3);
            if (how == 0) { /* one face removed */
                memcpy(m.faces + 3 * f, m.faces + 3 * (m.n_faces - 1), 3 * sizeof(sl_int));
                m.n_faces--;
            } else if (how == 1) { /* one face repeated in place of another */
                memcpy(m.faces + 3 * f, m.faces + 3 * g, 3 * sizeof(sl_int));
            } else if (how == 2) { /* one face turned over */
                sl_int v = m.faces[3 * f];
                m.faces[3 * f] = m.faces[3 * f + 1];
                m.faces[3 * f + 1] = v;
            } else { /* one corner moved to another vertex */
                sl_int v = gen_below(&chance, 16);
                if (m.faces[3 * f] != v && m.faces[3 * f + 1] != v && m.faces[3 * f + 2] != v) {
                    m.faces[3 * f + c] = v;
                }
            }
        }
        assert_true(incidence_create(&a, &m));
        bool wanted = is_disk_by_definition(&m);
        assert_int_equal(disk_patch_from_vertices(&d, &a, list, 16, NULL, 0), wanted);
        if (wanted) {
            assert_is_disk(&d);
            disk_patch_free(&d);
        }
        disks += wanted;
        others += !wanted;
        sl_int start = gen_below(&chance, 16);
        if (a.begin[start] < a.begin[start + 1]) {
            assert_true(disk_patch_grow(&d, &a, start, 3 + gen_below(&chance, 14), NULL, NULL, 0));
            assert_is_disk(&d);
            assert_true(is_disk_by_definition(&d.p.m));
            disk_patch_free(&d);
        }
        assert_scratch_is_clean(&a);
        incidence_free(&a);
        mesh_free(&m);
    }
    print_message("%d disks, %d others\n", (int)disks, (int)others);
    assert_true(disks > 500 && others > 1000);
    free(list);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exactly_the_disks_are_accepted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
