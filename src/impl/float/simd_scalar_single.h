/* simd_scalar_single.h: the kernels of fronts in float in plain C: a vector is an array */
#ifndef SLI_FLOAT_SIMD_SCALAR_SINGLE_H
#define SLI_FLOAT_SIMD_SCALAR_SINGLE_H

#include "../kernels/dispatch.h"

#if !defined(SLI_SIMD)

#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLV_NAME(f) sli_single_##f##_scalar
#define SLV_FUNCTION
#define SLV_DECLARE(a) float a[SLI_TILE];
#define SLV_ZERO(a) SLI_LOOP(SLI_TILE, a[i_] = 0.0F)
#define SLV_LOAD(a, p) memcpy(a, (p), sizeof a);
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_STORE(p, a) memcpy((p), a, sizeof a);
#define SLV_BROADCAST(b, p) SLI_LOOP(SLI_TILE, b[i_] = *(p))
#define SLV_LANE(b, a, k) SLI_LOOP(SLI_TILE, b[i_] = a[k])
#define SLV_ADD(a, b) SLI_LOOP(SLI_TILE, a[i_] += b[i_])
#define SLV_FNMA(a, b, c) SLI_LOOP(SLI_TILE, a[i_] -= b[i_] * c[i_])
#define SLV_MULTIPLY(a, b, c) SLI_LOOP(SLI_TILE, a[i_] = b[i_] * c[i_])
#define SLV_DIVIDE(a, b, c) SLI_LOOP(SLI_TILE, a[i_] = b[i_] / c[i_])
#define SLV_BELOW(a, k) SLI_LOOP((k) + 1, a[i_] = 0.0F)
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_EXPAND SLI_EXPAND_PLAIN
#define SLV_EXPAND_ADD SLI_EXPAND_ADD_PLAIN
#define SLV_VECTOR_TILES 1
#define SLV_LOAD_TILES(a, p, q) SLV_LOAD(a, p)
#define SLV_STORE_TILES(p, q, a) SLV_STORE(p, a)
#define SLV_NAME_PIVOTS SLV_NAME
#define SLV_OWN_PIVOTS
#include "../kernels/front.inl.h"
#include "../kernels/words_undef.inl.h"

#endif

#endif
