/* check_disk.h: checks that a mesh is a topological disk, without using disk_patch.c */
#ifndef SL_TEST_CHECK_DISK_H
#define SL_TEST_CHECK_DISK_H

#include "test.h"

#include "tools/mesh/disk_patch.h"

/* Each edge belongs to one face, or to two that traverse it in opposite directions; the edges of
 * one face form one loop, the boundary; the Euler characteristic is 1. */
static inline void assert_is_disk(const disk_patch *d) {
    const mesh *m = &d->p.m;
    sl_int n = m->n_vertices;
    sl_int once = 0;
    for (sl_int f = 0; f < m->n_faces; f++) {
        for (int c = 0; c < 3; c++) {
            sl_int u = m->faces[3 * f + c], v = m->faces[3 * f + (c + 1) % 3];
            int same = 0, opposite = 0;
            for (sl_int g = 0; g < m->n_faces; g++) {
                for (int e = 0; e < 3; e++) {
                    sl_int a = m->faces[3 * g + e], b = m->faces[3 * g + (e + 1) % 3];
                    same += a == u && b == v;
                    opposite += a == v && b == u;
                }
            }
            assert_int_equal(same, 1);
            assert_true(opposite <= 1);
            once += opposite == 0;
        }
    }
    assert_int_equal(once, d->n_boundary);
    /* V - E + F = 1; of the E edges, 3 F - E belong to two faces */
    assert_int_equal(n - (3 * m->n_faces + once) / 2 + m->n_faces, 1);
    for (sl_int k = 0; k < d->n_boundary; k++) {
        sl_int u = d->boundary[k], v = d->boundary[(k + 1) % d->n_boundary];
        bool found = false;
        for (size_t c = 0; c < 3 * (size_t)m->n_faces; c++) {
            found = found || (m->faces[c] == u && m->faces[c / 3 * 3 + (c + 1) % 3] == v);
        }
        assert_true(found);
        for (sl_int j = 0; j < k; j++) {
            assert_true(d->boundary[j] != u);
        }
    }
}

static inline sl_int *first_vertices(sl_int n) {
    sl_int *list = test_ints((size_t)n);
    for (sl_int k = 0; k < n; k++) {
        list[k] = k;
    }
    return list;
}

#endif
