/* simd_scalar.h: the kernels in plain C */
#ifndef SLI_KERNELS_SIMD_SCALAR_H
#define SLI_KERNELS_SIMD_SCALAR_H

#include "simd.h"
#include "../table.h"

/* One template for all numbers of right-hand sides, in groups of two: arrays gain nothing from
 * copies. */
#define SLV_SINGLE 0
#define SLV_COMPLEX 0
#define SLW_NRHS 2
#define SLW_GROUPS 64
#include "words_scalar.inl.h"
#include "lanes_scalar.inl.h"
#include "../sweeps/copy_rows.inl.h"
#include "../fronts/front.inl.h"
#include "../sweeps/sweeps.inl.h"
#include "../sweeps/multi_rhs.inl.h"
#include "../sweeps/multi_rhs_tiles.inl.h"
#include "../kernel_set.inl.h"
#include "lanes_undef.inl.h"
#include "words_undef.inl.h"

#endif
