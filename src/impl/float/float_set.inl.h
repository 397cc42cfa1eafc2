/* float_set.inl.h: the table of the kernels of L in float, for one instruction set */

static const sli_float_kernels SLV_NAME(float_kernels) = {
    {{SLV_NAME(single_forward), SLV_NAME(single_forward2), SLV_NAME_SHORT(single_forward4),
      SLV_NAME(single_forward8), SLV_NAME(single_forward16), SLV_NAME(single_forward32),
      SLV_NAME(single_forward64)},
     {SLV_NAME(single_backward), SLV_NAME(single_backward2), SLV_NAME_SHORT(single_backward4),
      SLV_NAME(single_backward8), SLV_NAME(single_backward16), SLV_NAME(single_backward32),
      SLV_NAME(single_backward64)}},
    SLV_NAME_SHORT(single_round)};
