/* storage_types.h: the storages of L that are compiled in */
#ifndef SLI_PACKS_STORAGE_TYPES_H
#define SLI_PACKS_STORAGE_TYPES_H

#include "../factor/multifrontal.h"
#if defined(SL_WITH_FLOAT)
#include "../float/float_storage.h"
#endif
#if defined(SL_WITH_COMPLEX)
#include "../complex/complex_storage.h"
#endif

static const sli_storage_type *sli_storage_type_of(sl_storage storage) {
    switch (storage) { /* branches untested: all packs are there */
    case SL_STORAGE_DOUBLE:
        return &sli_storage_double;
#if defined(SL_WITH_FLOAT)
    case SL_STORAGE_FLOAT:
        return &sli_storage_float;
#endif
#if defined(SL_WITH_COMPLEX)
    case SL_STORAGE_COMPLEX:
        return &sli_storage_complex;
#endif
    default:         /* untested: the same */
        return NULL; /* untested: the same */
    }
}

static const char *sli_storage_needs(sl_storage storage) {
    return storage == SL_STORAGE_DOUBLE    ? ""
           : storage == SL_STORAGE_FLOAT   ? "options.storage needs SL_WITH_FLOAT"
           : storage == SL_STORAGE_COMPLEX ? "options.storage needs SL_WITH_COMPLEX"
                                           : NULL;
}

#endif
