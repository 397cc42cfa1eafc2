/* reserved.h: workspaces that hold what a call took in another one, and no more */
#ifndef SL_TEST_RESERVED_H
#define SL_TEST_RESERVED_H

#include "test.h"

/* Makes the call in `trial`, a workspace of its own with the given options, and reserves in W what
 * it took there. */
#define RESERVE_FOR(W, opt, call) \
    do { \
        sl_work *trial = NULL; \
        SL_CHECK(sl_work_create(&trial, opt)); \
        SL_CHECK(call); \
        SL_CHECK(sl_work_reserve(W, sl_work_bytes(trial))); \
        sl_work_free(trial); \
    } while (0)

/* A workspace whose allocations are counted, and what they were when it had been reserved. */
typedef struct reserved_t {
    counter_t counter;
    sl_work *W;
    size_t calls, bytes;
} reserved_t;

static inline void reserved_begin(reserved_t *r) {
    sl_options opt;
    r->counter = counter_make();
    opt = options_counted(&r->counter);
    SL_CHECK(sl_work_create(&r->W, &opt));
}

static inline void reserved_done(reserved_t *r) {
    r->calls = r->counter.calls;
    r->bytes = sl_work_bytes(r->W);
}

static inline void reserved_end(reserved_t *r) {
    assert_int_equal(r->counter.calls, r->calls);
    assert_int_equal(sl_work_bytes(r->W), r->bytes);
    sl_work_free(r->W);
    COUNTER_CLEAN(&r->counter);
}

#endif
