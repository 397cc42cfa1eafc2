/* inverse_set.inl.h: the table of the kernels of the inverse, for one instruction set */

static const sli_inverse_kernels SLV_NAME(inverse_kernels) = {
    SLV_NAME(products8), SLV_NAME(gather), SLV_NAME(inverse_phase), SLV_NAME(takahashi)};
