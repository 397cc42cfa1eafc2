/* float_storage.h: options for L in float */
#ifndef SL_TEST_FLOAT_STORAGE_H
#define SL_TEST_FLOAT_STORAGE_H

#include "test.h"

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
