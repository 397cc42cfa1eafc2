/* simd_neon_single.h: the kernels of fronts in float in NEON: a vector of 8 is two registers */
#ifndef SLI_FLOAT_SIMD_NEON_SINGLE_H
#define SLI_FLOAT_SIMD_NEON_SINGLE_H

#include "../kernels/dispatch.h"

#if defined(SLI_ARM)

#define SLV_SINGLE 1
#define SLV_COMPLEX 0
#define SLV_NAME(f) sli_single_##f##_neon
#define SLV_FUNCTION
#define SLV_DECLARE(a) float32x4_t a##_0, a##_1;
#define SLV_ZERO(a) a##_0 = a##_1 = vdupq_n_f32(0.0F);
#define SLV_LOAD(a, p) a##_0 = vld1q_f32(p), a##_1 = vld1q_f32((p) + 4);
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_STORE(p, a) vst1q_f32((p), a##_0), vst1q_f32((p) + 4, a##_1);
#define SLV_BROADCAST(b, p) b##_0 = b##_1 = vld1q_dup_f32(p);
#define SLV_LANE(b, a, k) \
    b##_0 = b##_1 = vdupq_n_f32(vgetq_lane_f32((k) < 4 ? a##_0 : a##_1, (k) % 4));
#define SLV_ADD(a, b) a##_0 = vaddq_f32(a##_0, b##_0), a##_1 = vaddq_f32(a##_1, b##_1);
#define SLV_FNMA(a, b, c) \
    a##_0 = vfmsq_f32(a##_0, b##_0, c##_0), a##_1 = vfmsq_f32(a##_1, b##_1, c##_1);
#define SLV_MULTIPLY(a, b, c) a##_0 = vmulq_f32(b##_0, c##_0), a##_1 = vmulq_f32(b##_1, c##_1);
#define SLV_DIVIDE(a, b, c) a##_0 = vdivq_f32(b##_0, c##_0), a##_1 = vdivq_f32(b##_1, c##_1);
#define SLV_BELOW(a, k) \
    { \
        static const int32_t lanes_[SLI_TILE] = {0, 1, 2, 3, 4, 5, 6, 7}; \
        const int32x4_t k_ = vdupq_n_s32(k); \
        a##_0 = vreinterpretq_f32_u32( \
            vandq_u32(vreinterpretq_u32_f32(a##_0), vcgtq_s32(vld1q_s32(lanes_), k_))); \
        a##_1 = vreinterpretq_f32_u32( \
            vandq_u32(vreinterpretq_u32_f32(a##_1), vcgtq_s32(vld1q_s32(lanes_ + 4), k_))); \
    }
#define SLV_AHEAD 1
#define SLV_TILES 2
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
