/* fronts_undef.inl.h: undefines the parameters of fronts.inl.h */

#undef SLF_NAME
#undef SLF_HALF
