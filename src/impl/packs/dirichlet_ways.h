/* dirichlet_ways.h: the ways to fix rows that are compiled in beside a factor of the free rows */
#ifndef SLI_PACKS_DIRICHLET_WAYS_H
#define SLI_PACKS_DIRICHLET_WAYS_H

#if defined(SL_WITH_CHANGE)
#include "../dirichlet/dirichlet_reuse.h"
#else
#include "../dirichlet/dirichlet.h"
#endif

static const sli_dirichlet_ways *sli_dirichlet_ways_of(void) {
#if defined(SL_WITH_CHANGE)
    return &sli_dirichlet_reuse;
#else
    return NULL;
#endif
}

#endif
