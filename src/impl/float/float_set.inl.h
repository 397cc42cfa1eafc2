/* float_set.inl.h: the table of the kernels of L in float, for one instruction set */

#if defined(SLW_LAST) /* once for each instruction set */

#if defined(SLV_OWN_SHORT) && !defined(SLV_OWN_ROUND)
static int SLV_NAME(single_round)(float *to, const double *from, ptrdiff_t count) {
    ptrdiff_t k;
    int is_odd = 0;
    for (k = 0; k < count; k++) {
        const double size = fabs(from[k]);
        is_odd |= (size > (double)FLT_MAX) | ((size < (double)FLT_MIN) & (size > 0.0));
        to[k] = (float)from[k];
    }
    return is_odd;
}
#endif

static const sli_float_kernels SLV_NAME(float_kernels) = {
    {{SLV_NAME(single_forward), SLV_NAME(single_forward2), SLV_NAME_SHORT(single_forward4),
      SLV_NAME(single_forward8), SLV_NAME(single_forward16), SLV_NAME(single_forward32),
      SLV_NAME(single_forward64)},
     {SLV_NAME(single_backward), SLV_NAME(single_backward2), SLV_NAME_SHORT(single_backward4),
      SLV_NAME(single_backward8), SLV_NAME(single_backward16), SLV_NAME(single_backward32),
      SLV_NAME(single_backward64)}},
    SLV_NAME_SHORT(single_round)};

#endif
