/* lanes_undef.inl.h: undefines the SIMD vocabulary of one number of right-hand sides */

#undef SLW_NAME
#undef SLW_NRHS
#undef SLW_HALF
#undef SLW_GROUPS
#undef SLW_EACH
#undef SLW_EACH_AGAIN
#undef SLW_HIGH
#undef SLW_LOW
#undef SLW_ROWS
#undef SLW_DECLARE
#undef SLW_ZERO
#undef SLW_LOAD
#undef SLW_STORE
#undef SLW_FNMA
#undef SLW_ADD
#undef SLW_DIVIDE
