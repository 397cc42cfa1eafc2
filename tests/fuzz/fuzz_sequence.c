/* fuzz_sequence.c: takes a sequence of calls on a pool of objects from any bytes, with allocations
 * that fail in between; compares every answer with dense matrices */
#include "sequence_factors.h"
#include "sequence_inverse.h"
#include "sequence_saved.h"
#include "sequence_solves.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { STEPS = 60 };

static void release_one(input_t *in) {
    const int which = take(in), kind = take(in) % 6;
    if (kind == 0) {
        free_factor(which % FACTORS);
    } else if (kind == 1) {
        free_region(which % REGIONS);
    } else if (kind == 2) {
        free_selected(&selected[which % SELECTED]);
    } else if (kind == 3) {
        free_plan(&plans[which % PLANS]);
    } else if (kind == 4) {
        free_analysis(which % ANALYSES);
    } else { /* a new workspace, which has to grow */
        const sl_options opt = options();
        left = -1;
        sl_work_free(work);
        PROMISE(sl_work_create(&work, &opt) == SL_OK);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static void (*const calls[])(input_t * in) = {
        create_analysis, create_factor, create_factor, combine, refactor,    change_columns,
        create_plan,     create_plan,   solve,         solve,   solve,       create_selected,
        create_region,   invert,        query,         reserve, solve_batch, release_one};
    static void (*const more[])(input_t * in) = {solve_rows,   multiply, build_matrices, look_into,
                                                 select_pairs, copy,     reserve_others, copy_set};
    enum { CALLS = (int)(sizeof calls / sizeof calls[0]) };
    enum { MORE = (int)(sizeof more / sizeof more[0]) };
    if (size == 0) {
        return 0;
    }
    input_t in = {data, data + size};
    const sl_options opt = options();
    left = -1;
    blocks = 0;
    PROMISE(sl_work_create(&work, &opt) == SL_OK);
    create_analysis(&in);
    create_factor(&in);
    for (int step = 0; step < STEPS && in.at < in.end; step++) {
        const int byte = take(&in);
        has_failed = 0;
        const int may_fail = byte >= 13 * CALLS || byte / 8 == 18; /* one call in nine */
        left = may_fail ? take(&in) % 24 : -1;
        if (byte / 8 >= 18 && byte < 13 * CALLS) {
            more[byte % MORE](&in);
        } else {
            calls[byte % CALLS](&in);
        }
        left = -1;
    }
    for (int k = 0; k < ANALYSES; k++) {
        free_analysis(k);
    }
    sl_work_free(work);
    work = NULL;
    PROMISE(blocks == 0);
    return 0;
}
