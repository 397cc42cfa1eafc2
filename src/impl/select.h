/* select.h: the kernel table for an instruction set */
#ifndef SLI_SELECT_H
#define SLI_SELECT_H

#include "cpu.h"
#include "isa_avx2.h"
#include "isa_avx512.h"
#include "isa_neon.h"
#include "isa_scalar.h"

/* The table of an ISA, the best one for SL_ISA_AUTO; NULL where it is not compiled in or this
 * processor lacks it. */
static const sli_kernels *sli_kernels_select(sl_isa isa) {
    const sl_isa best = sli_cpu_best();
    if (isa == SL_ISA_AUTO) {
        isa = best;
    }
    if (isa == SL_ISA_SCALAR) {
        return &sli_kernels_scalar;
    }
#if defined(SLI_X86)
    if (isa == SL_ISA_AVX512 && best == SL_ISA_AVX512) {
        return &sli_kernels_avx512;
    }
    if (isa == SL_ISA_AVX2 && best != SL_ISA_SCALAR) {
        return &sli_kernels_avx2;
    }
#elif defined(SLI_ARM)
    if (isa == SL_ISA_NEON) {
        return &sli_kernels_neon;
    }
#endif
    return NULL;
}

#endif
