/* dispatch.h: detects the instruction sets of this processor and selects a kernel table */
#ifndef SLI_KERNELS_DISPATCH_H
#define SLI_KERNELS_DISPATCH_H

#include "kernels.h"

#if defined(SLI_X86)
/* What CPUID says of a leaf: eax, ebx, ecx, edx. Not by <cpuid.h>, which conflicts with <intrin.h>.
 */
SLI_INLINE void sli_cpuid(unsigned leaf, unsigned *r) {
#if defined(SLI_GNU)
    __asm__ volatile("cpuid" : "=a"(r[0]), "=b"(r[1]), "=c"(r[2]), "=d"(r[3]) : "a"(leaf), "c"(0));
#else
    __cpuidex((int *)r, (int)leaf, 0);
#endif
}

/* XCR0: the register states that the operating system saves. */
SLI_INLINE unsigned sli_xcr0(void) {
#if defined(SLI_GNU)
    unsigned low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
#else
    return (unsigned)_xgetbv(0);
#endif
}
#endif

#if defined(SLI_X86)
#define SLI_OSXSAVE (1u << 27)

/* The best instruction set, from the last leaf of CPUID, ecx of leaf 1, ebx of leaf 7, and XCR0 (0
 * without SLI_OSXSAVE). */
SLI_INLINE sl_isa sli_isa_of(unsigned leaves, unsigned ecx1, unsigned ebx7, unsigned xcr0) {
    const unsigned avx_fma = 1u << 28 | 1u << 12;
    /* 0x6: SSE and AVX state; 0xe0: AVX-512 state; bit 5: AVX2; bit 16: AVX512F */
    if (leaves < 7 || (ecx1 & avx_fma) != avx_fma || (xcr0 & 0x6u) != 0x6u || !(ebx7 & 1u << 5)) {
        return SL_ISA_SCALAR;
    }
#if defined(SLI_AVX512)
    if ((xcr0 & 0xe0u) == 0xe0u && (ebx7 & 1u << 16)) {
        return SL_ISA_AVX512;
    }
#endif
    return SL_ISA_AVX2;
}
#endif

/* The best instruction set that is compiled in and that the processor and the operating system
 * support. CPUID traps under a hypervisor, which takes as long as a factor of 100 rows: gcc and
 * clang have asked it when the program was started. Elsewhere this runs once for each factor. */
static sl_isa sli_cpu_best(void) {
#if defined(SLI_X86) && defined(SLI_GNU) && !defined(_WIN32)
    __builtin_cpu_init(); /* if a constructor calls before the program has started */
    if (!__builtin_cpu_supports("avx2") || /* untested: without AVX2 */
        !__builtin_cpu_supports("fma")) {  /* untested: the same */
        return SL_ISA_SCALAR;              /* untested: the same */
    }
#if defined(SLI_AVX512)
    if (__builtin_cpu_supports("avx512f")) { /* untested: with AVX2 alone */
        return SL_ISA_AVX512;
    }
#endif
    return SL_ISA_AVX2; /* untested: with AVX-512 */
#elif defined(SLI_X86)
    const unsigned last =
        13; /* AVX, without which the rest is not looked at, comes with this leaf */
    unsigned one[4], seven[4], xcr0;
    sli_cpuid(1, one);
    sli_cpuid(7, seven);                          /* of a processor without this leaf: anything */
    xcr0 = one[2] & SLI_OSXSAVE ? sli_xcr0() : 0; /* untested: every processor here has it */
    return sli_isa_of(last, one[2], seven[1], xcr0);
#elif defined(SLI_ARM)
    return SL_ISA_NEON;
#else
    return SL_ISA_SCALAR;
#endif
}

/* The kernel table of an instruction set; SL_ISA_AUTO: of the best one. NULL if the instruction set
 * is not compiled in or not supported here. */
static const sli_kernels *sli_kernels_select(sl_isa isa) {
    const sl_isa best = isa == SL_ISA_SCALAR ? SL_ISA_SCALAR : sli_cpu_best();
    if (isa == SL_ISA_AUTO) {
        isa = best;
    }
    if (isa == SL_ISA_SCALAR) {
        return &sli_kernels_scalar;
    }
#if defined(SLI_AVX512)
    if (isa == SL_ISA_AVX512 && best == SL_ISA_AVX512) { /* untested: with AVX2 alone */
        return &sli_kernels_avx512;
    }
#endif
#if defined(SLI_X86)
    if (isa == SL_ISA_AVX2 && best != SL_ISA_SCALAR) { /* untested: without AVX2 */
        return &sli_kernels_avx2;
    }
#elif defined(SLI_ARM)
    if (isa == SL_ISA_NEON) {
        return &sli_kernels_neon;
    }
#endif
    return NULL;
}

/* The tables of a pack by sl_isa, up to the last instruction set that is compiled in; NULL for one
 * that is not. scalar: the table in plain C. */
#if defined(SLI_AVX512)
#define SLI_TABLES(name, scalar) \
    { NULL, scalar, &name##_avx2, &name##_avx512 }
#elif defined(SLI_X86)
#define SLI_TABLES(name, scalar) \
    { NULL, scalar, &name##_avx2 }
#elif defined(SLI_ARM)
#define SLI_TABLES(name, scalar) \
    { NULL, scalar, NULL, NULL, &name##_neon }
#else
#define SLI_TABLES(name, scalar) \
    { NULL, scalar }
#endif
#define SLI_ISA_TABLES(name) SLI_TABLES(name, &name##_scalar)

/* The same of a pack that adds a storage of L, with SLI_FOR_STORAGE (each_isa.list.h). */
#if defined(SLI_SIMD)
#define SLI_STORAGE_TABLES(name) SLI_TABLES(name, NULL)
#else
#define SLI_STORAGE_TABLES SLI_ISA_TABLES
#endif

#endif
