/* no_kernels.h: before the bodies of a test: without SIMD kernels they compile in half the time */
/* Coverage has one list of branches a line, over all objects: there, all have the same kernels. */
#if !defined(SL_NO_SIMD) && !defined(TEST_ALL_KERNELS)
#define SL_NO_SIMD
#endif
