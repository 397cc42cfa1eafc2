/* kernels.h: the kernels of the core, for every instruction set */
#ifndef SLI_KERNELS_KERNELS_H
#define SLI_KERNELS_KERNELS_H

#include "table.h"
#include "words/simd.h"
#include "words/simd_avx2.h"

#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLI_FOR_ISA "../kernels/each_lanes.list.h"
#define SLI_FOR_LANES "../kernels/kernels.list.h"
#include "each_isa.list.h"
#undef SLI_FOR_ISA
#undef SLI_FOR_LANES
#undef SLV_SINGLE
#undef SLV_COMPLEX

#endif
