/* disk_checks.h: what a disk must be, checked without disk.c */
#ifndef SL_TEST_DISK_CHECKS_H
#define SL_TEST_DISK_CHECKS_H

#include "test.h"

#include "../tools/disk.h"

/* Independent of disk.c: every edge of one or two faces that run it in opposite directions, the boundary a loop. */
static inline void is_disk(const disk *d) {
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
    /* V - E + F = 1, of E edges 3 F - E have two faces */
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
