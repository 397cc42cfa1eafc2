/* simd_avx512.h: the kernels in AVX-512F; some are those of AVX2 */
#ifndef SLI_KERNELS_SIMD_AVX512_H
#define SLI_KERNELS_SIMD_AVX512_H

#include "simd_avx2.h"
#include "simd.h"
#include "../table.h"

#if defined(SLI_X86) && !defined(SL_NO_AVX512)

#define SLI_AVX512 1

#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLW_NRHS 8
#include "words_avx512.inl.h"
#include "lanes_avx512.inl.h"
#include "../sweeps/copy_rows.inl.h"
#include "../fronts/front.inl.h"
#include "../sweeps/sweeps.inl.h"
#include "../sweeps/two_rhs.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/multi_rhs_tiles.inl.h"
#include "lanes_undef.inl.h"

#define SLW_NRHS 16
#define SLW_GROUPS 64
#include "lanes_avx512.inl.h"
#include "../sweeps/copy_rows.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/multi_rhs_tiles.inl.h"
#include "../kernel_set.inl.h"
#include "lanes_undef.inl.h"
#include "words_undef.inl.h"

#endif

#endif
