/* words_neon.inl.h: the vocabulary SLV_ in NEON: a vector of 8 doubles is four registers */

#define SLV_NAME(f) sli_##f##_neon
#define SLV_ISA SL_ISA_NEON
#define SLV_WIDTH 2
#define SLV_FUNCTION
#define SLV_FNMA1(a, b, c) SLI_FNMA1(a, b, c)
#define SLV_DECLARE(a) float64x2_t a##_0, a##_1, a##_2, a##_3;
#define SLV_ZERO(a) a##_0 = a##_1 = a##_2 = a##_3 = vdupq_n_f64(0.0);
#define SLV_LOAD(a, p) \
    a##_0 = vld1q_f64((p) + 0), a##_1 = vld1q_f64((p) + 2), a##_2 = vld1q_f64((p) + 4), \
    a##_3 = vld1q_f64((p) + 6);
#define SLV_STORE(p, a) \
    vst1q_f64((p) + 0, a##_0), vst1q_f64((p) + 2, a##_1), vst1q_f64((p) + 4, a##_2), \
        vst1q_f64((p) + 6, a##_3);
#define SLV_ADD(a, b) \
    a##_0 = vaddq_f64(a##_0, b##_0), a##_1 = vaddq_f64(a##_1, b##_1), \
    a##_2 = vaddq_f64(a##_2, b##_2), a##_3 = vaddq_f64(a##_3, b##_3);
/* The first 2 of 8 values. */
#define SLV_READ_0(l) vld1q_f64(l)
#define SLV_READ_1(l) vcvt_f64_f32(vld1_f32(l))
#define SLV_WIDEN_ROWS(v, l, rows) \
    { \
        int i_; \
        for (i_ = 0; i_ < (rows); i_ += 2) { \
            vst1q_f64((v) + i_, vcvt_f64_f32(vld1_f32((l) + i_))); \
        } \
    }
#define SLV_AXPY(a, l, p) \
    { \
        const float64x2_t s_ = vld1q_dup_f64(p); \
        a##_0 = vfmsq_f64(a##_0, SLV_READ((l) + 0), s_); \
        a##_1 = vfmsq_f64(a##_1, SLV_READ((l) + 2), s_); \
        a##_2 = vfmsq_f64(a##_2, SLV_READ((l) + 4), s_); \
        a##_3 = vfmsq_f64(a##_3, SLV_READ((l) + 6), s_); \
    }
#define SLV_DOT(a, l, v) \
    a##_0 = vfmsq_f64(a##_0, SLV_READ((l) + 0), v##_0), \
    a##_1 = vfmsq_f64(a##_1, SLV_READ((l) + 2), v##_1), \
    a##_2 = vfmsq_f64(a##_2, SLV_READ((l) + 4), v##_2), \
    a##_3 = vfmsq_f64(a##_3, SLV_READ((l) + 6), v##_3);
#define SLV_STORE_ANY(p, a) SLV_STORE(p, a)
#define SLV_TURN_2(a, re, im) vcombine_f64(re(vget_high_f64(a)), im(vget_low_f64(a)))
#define SLV_SAME(a) (a)
#define SLV_TURN(a, b) \
    a##_0 = SLV_TURN_2(b##_0, vneg_f64, SLV_SAME), a##_1 = SLV_TURN_2(b##_1, vneg_f64, SLV_SAME), \
    a##_2 = SLV_TURN_2(b##_2, vneg_f64, SLV_SAME), a##_3 = SLV_TURN_2(b##_3, vneg_f64, SLV_SAME);
#define SLV_TURN_BACK(a, b) \
    a##_0 = SLV_TURN_2(b##_0, SLV_SAME, vneg_f64), a##_1 = SLV_TURN_2(b##_1, SLV_SAME, vneg_f64), \
    a##_2 = SLV_TURN_2(b##_2, SLV_SAME, vneg_f64), a##_3 = SLV_TURN_2(b##_3, SLV_SAME, vneg_f64);
#define SLV_FNMA(a, b, c) \
    a##_0 = vfmsq_f64(a##_0, b##_0, c##_0), a##_1 = vfmsq_f64(a##_1, b##_1, c##_1), \
    a##_2 = vfmsq_f64(a##_2, b##_2, c##_2), a##_3 = vfmsq_f64(a##_3, b##_3, c##_3);
#define SLV_LOAD_PART(a, p, count, rest) \
    { \
        double part_[SLI_TILE]; \
        sl_int i_; \
        for (i_ = 0; i_ < SLI_TILE; i_++) { \
            part_[i_] = i_ < (count) ? (p)[i_] : (rest); \
        } \
        SLV_LOAD(a, part_) \
    }
#define SLV_FIRST(a, count) \
    { \
        double part_[SLI_TILE]; \
        sl_int i_; \
        SLV_STORE(part_, a) \
        for (i_ = (count); i_ < SLI_TILE; i_++) { \
            part_[i_] = 0.0; \
        } \
        SLV_LOAD(a, part_) \
    }
#define SLV_LANE(b, a, k) \
    b##_0 = b##_1 = b##_2 = b##_3 = vdupq_n_f64(vgetq_lane_f64((k) < 2   ? a##_0 \
                                                               : (k) < 4 ? a##_1 \
                                                               : (k) < 6 ? a##_2 \
                                                                         : a##_3, \
                                                               (k) % 2));
#define SLV_GATHER_2(x, i, j) vcombine_f64(vld1_f64((x) + (i)), vld1_f64((x) + (j)))
#define SLV_GATHER(a, x, at) \
    a##_0 = SLV_GATHER_2(x, at(0), at(1)), a##_1 = SLV_GATHER_2(x, at(2), at(3)), \
    a##_2 = SLV_GATHER_2(x, at(4), at(5)), a##_3 = SLV_GATHER_2(x, at(6), at(7));
#define SLV_SUM_DECLARE(a) float64x2_t a;
#define SLV_SUM_ZERO(a) a = vdupq_n_f64(0.0);
#define SLV_SUM_LOAD(a, p) a = vld1q_f64(p);
#define SLV_SUM_STORE(p, a) vst1q_f64((p), a);
#define SLV_SUM_DOT(a, l, v) \
    a = vfmsq_f64(a, SLV_READ((l) + 0), v##_0); \
    a = vfmsq_f64(a, SLV_READ((l) + 2), v##_1); \
    a = vfmsq_f64(a, SLV_READ((l) + 4), v##_2); \
    a = vfmsq_f64(a, SLV_READ((l) + 6), v##_3);
#define SLV_SUMS(r, a) \
    r##_0 = vpaddq_f64(a##0, a##1), r##_1 = vpaddq_f64(a##2, a##3), \
    r##_2 = vpaddq_f64(a##4, a##5), r##_3 = vpaddq_f64(a##6, a##7);
#define SLV_TRANSPOSE(to, from) \
    { \
        int i_, k_; \
        for (i_ = 0; i_ < SLI_TILE; i_ += 2) { \
            for (k_ = 0; k_ < SLI_TILE; k_ += 2) { \
                const float64x2_t low_ = vld1q_f64((from) + SLI_TILE * k_ + i_); \
                const float64x2_t high_ = vld1q_f64((from) + SLI_TILE * (k_ + 1) + i_); \
                vst1q_f64((to) + SLI_TILE * i_ + k_, vtrn1q_f64(low_, high_)); \
                vst1q_f64((to) + SLI_TILE * (i_ + 1) + k_, vtrn2q_f64(low_, high_)); \
            } \
        } \
    }
#define SLV_TILES 1
#define SLV_COLUMNS 4
#define SLV_EACH_COLUMN SLI_EACH4
#define SLV_LOAD_PINNED(a, p) SLV_LOAD(a, p)
#define SLV_BROADCAST(b, p) b##_0 = b##_1 = b##_2 = b##_3 = vld1q_dup_f64(p);
#define SLV_MULTIPLY(a, b, c) \
    a##_0 = vmulq_f64(b##_0, c##_0), a##_1 = vmulq_f64(b##_1, c##_1), \
    a##_2 = vmulq_f64(b##_2, c##_2), a##_3 = vmulq_f64(b##_3, c##_3);
#define SLV_DIVIDE(a, b, c) \
    a##_0 = vdivq_f64(b##_0, c##_0), a##_1 = vdivq_f64(b##_1, c##_1), \
    a##_2 = vdivq_f64(b##_2, c##_2), a##_3 = vdivq_f64(b##_3, c##_3);
#define SLV_BELOW_2(a, k) \
    a = vreinterpretq_f64_u64(vandq_u64(vreinterpretq_u64_f64(a), \
                                        vcombine_u64(vcreate_u64((k) < 0 ? ~(uint64_t)0 : 0), \
                                                     vcreate_u64((k) < 1 ? ~(uint64_t)0 : 0))));
#define SLV_BELOW(a, k) \
    SLV_BELOW_2(a##_0, k) \
    SLV_BELOW_2(a##_1, (k)-2) SLV_BELOW_2(a##_2, (k)-4) SLV_BELOW_2(a##_3, (k)-6)
#define SLV_EXPAND SLI_EXPAND_PLAIN
#define SLV_EXPAND_ADD SLI_EXPAND_ADD_PLAIN
#define SLV_REPEAT_ROWS(t, l, k) \
    t##_0 = vdupq_n_f64((l)[4 * (k)]), t##_1 = vdupq_n_f64((l)[4 * (k) + 1]), \
    t##_2 = vdupq_n_f64((l)[4 * (k) + 2]), t##_3 = vdupq_n_f64((l)[4 * (k) + 3]);
#define SLV_REPEAT(b, p) b##_0 = b##_1 = b##_2 = b##_3 = vld1q_f64(p);
#define SLV_STREAM(p, a) SLV_STORE(p, a)
#define SLV_STREAM_END
#define SLV_VECTOR_TILES 1
#define SLV_LOAD_TILES(a, p, q) SLV_LOAD(a, p)
#define SLV_STORE_TILES(p, q, a) SLV_STORE(p, a)
#define SLV_NAME_SHORT SLV_NAME
#define SLV_OWN_SHORT
