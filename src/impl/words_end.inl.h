/* words_end.inl.h: takes the octet words back, for the next instruction set */
#undef SLV_NAME
#undef SLV_ISA
#undef SLV_FUNCTION
#undef SLV_DECLARE
#undef SLV_ZERO
#undef SLV_LOAD
#undef SLV_STORE
#undef SLV_ADD
#undef SLV_AXPY
#undef SLV_DOT
#undef SLV_SUM
#undef SLV_FNMA1
