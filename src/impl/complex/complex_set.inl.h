/* complex_set.inl.h: the table of the kernels of complex matrices, for one instruction set */

#if defined(SLW_LAST) /* once for each instruction set */

static const sli_complex_kernels SLV_NAME(complex_kernels) = {
    {{SLV_NAME(complex_forward), SLV_NAME_SHORT(complex_forward2), SLV_NAME_SHORT(complex_forward4),
      SLV_NAME(complex_forward8), SLV_NAME(complex_forward16), SLV_NAME(complex_forward32),
      SLV_NAME(complex_forward64)},
     {SLV_NAME(complex_backward), SLV_NAME_SHORT(complex_backward2),
      SLV_NAME_SHORT(complex_backward4), SLV_NAME(complex_backward8), SLV_NAME(complex_backward16),
      SLV_NAME(complex_backward32), SLV_NAME(complex_backward64)}},
    {SLV_NAME(complex_pivots), SLV_NAME(complex_rows), SLV_NAME(complex_update),
     SLV_NAME(complex_assemble)}};

#endif
