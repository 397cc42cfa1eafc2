/* simd_neon.h: the kernels in NEON */
#ifndef SLI_KERNELS_SIMD_NEON_H
#define SLI_KERNELS_SIMD_NEON_H

#include "simd.h"
#include "../table.h"

#if defined(SLI_ARM)

#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLW_NRHS 4
#include "words_neon.inl.h"
#include "lanes_neon.inl.h"
#include "../sweeps/copy_rows.inl.h"
#include "../fronts/front.inl.h"
#include "../sweeps/sweeps.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/multi_rhs_tiles.inl.h"
#include "lanes_undef.inl.h"

#define SLW_NRHS 2
#include "lanes_neon.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/two_rhs.inl.h"
#include "lanes_undef.inl.h"

#define SLW_NRHS 8
#define SLW_GROUPS 64
#include "lanes_neon.inl.h"
#include "../sweeps/copy_rows.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/multi_rhs_tiles.inl.h"
#include "../kernel_set.inl.h"
#include "lanes_undef.inl.h"
#include "words_undef.inl.h"

#endif

#endif
