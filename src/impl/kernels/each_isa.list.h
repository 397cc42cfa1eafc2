/* each_isa.list.h: all instruction sets: includes SLI_FOR_ISA once for each that is compiled in
 *
 * SLI_FOR_ISA is a list of templates. It includes the words SLI_WORDS, and SLI_LANES, those for
 * several right-hand sides. With SLI_FOR_STORAGE it is for a storage of L: beside SIMD, plain C has
 * no kernels for it, which would be 60 kB of the object, and keeps L in double (factor_setup.h).
 * Paths in macros begin at a folder beside this one, so that they are the same in all packs. */

#if !defined(SLI_SIMD) || !defined(SLI_FOR_STORAGE)
#define SLI_WORDS "../kernels/words/words_scalar.inl.h"
#define SLI_LANES "../kernels/words/lanes_scalar.inl.h"
#include SLI_FOR_ISA
#undef SLI_WORDS
#undef SLI_LANES
#endif

#if defined(SLI_X86)
#define SLI_WORDS "../kernels/words/words_avx2.inl.h"
#define SLI_LANES "../kernels/words/lanes_avx2.inl.h"
#include SLI_FOR_ISA
#undef SLI_WORDS
#undef SLI_LANES
#endif

#if defined(SLI_AVX512) /* calls kernels of AVX2 */
#define SLI_WORDS "../kernels/words/words_avx512.inl.h"
#define SLI_LANES "../kernels/words/lanes_avx512.inl.h"
#include SLI_FOR_ISA
#undef SLI_WORDS
#undef SLI_LANES
#endif

#if defined(SLI_ARM)
#define SLI_WORDS "../kernels/words/words_neon.inl.h"
#define SLI_LANES "../kernels/words/lanes_neon.inl.h"
#include SLI_FOR_ISA
#undef SLI_WORDS
#undef SLI_LANES
#endif
