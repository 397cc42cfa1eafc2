/* float_storage.h: options for L in float */
#ifndef SL_TEST_FLOAT_STORAGE_H
#define SL_TEST_FLOAT_STORAGE_H

#include "test.h"

/* Both ways to have L in float: rounded, and computed. */
static const sl_storage floats[2] = {SL_STORAGE_FLOAT, SL_STORAGE_FLOAT_FRONTS};

static inline sl_options options_of(sl_storage storage, sl_isa isa) {
    sl_options opt = options_none();
    opt.isa = isa;
    opt.method = SL_METHOD_SUPERNODAL;
    opt.storage = storage;
    return opt;
}

static inline sl_options options_float(sl_isa isa) {
    return options_of(SL_STORAGE_FLOAT, isa);
}

#endif
