/* fixed_ways.h: the ways to fix rows that are compiled in beside a factor of the free rows */
#ifndef SLI_PACKS_FIXED_WAYS_H
#define SLI_PACKS_FIXED_WAYS_H

#if defined(SL_WITH_CHANGE)
#include "../fixed/fixed_reuse.h"
#else
#include "../fixed/fixed.h"
#endif

static const sli_fixed_ways *sli_fixed_ways_of(void) {
#if defined(SL_WITH_CHANGE)
    return &sli_fixed_reuse;
#else
    return NULL;
#endif
}

#endif
