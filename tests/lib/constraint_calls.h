/* constraint_calls.h: one pin added or released, and how many there are */
#ifndef SL_TEST_CONSTRAINT_CALLS_H
#define SL_TEST_CONSTRAINT_CALLS_H

#include "sparse_local.h"

static inline sl_status pin_row(sl_constraints *P, sl_int row, sl_stats *stats) {
    return sl_constraints_add(P, &row, NULL, 1, stats);
}

static inline sl_status unpin(sl_constraints *P, sl_int index) {
    return sl_constraints_release(P, &index, 1, NULL);
}

/* The number of pins and equalities; NULL has none. A release of nothing says it. */
static inline sl_int pins_count(sl_constraints *P) {
    sl_stats stats;
    return sl_constraints_release(P, NULL, 0, &stats) == SL_OK ? stats.constraints.count : 0;
}

#endif
