/* cpu.h: which instruction sets this processor and operating system run */
#ifndef SLI_CPU_H
#define SLI_CPU_H

#include "../public/types.h"
#include "base.h"

#if defined(SLI_X86)
/* The register states that the operating system saves: XCR0. */
SLI_INLINE unsigned sli_xcr0(void) {
    unsigned low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}
#endif

/* The best instruction set here. CPUID traps under a hypervisor (microseconds), so this runs once a
 * factor. */
static sl_isa sli_cpu_best(void) {
#if defined(SLI_X86)
    unsigned a, b, c, d, xcr0;
    const unsigned osxsave_avx_fma = (1u << 27) | (1u << 28) | (1u << 12);
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & osxsave_avx_fma) != osxsave_avx_fma) {
        return SL_ISA_SCALAR;
    }
    xcr0 = sli_xcr0();
    if ((xcr0 & 0x6u) != 0x6u || !__get_cpuid_count(7, 0, &a, &b, &c, &d) || !(b & (1u << 5))) {
        return SL_ISA_SCALAR;
    }
    return (xcr0 & 0xe6u) == 0xe6u && (b & (1u << 16)) ? SL_ISA_AVX512 : SL_ISA_AVX2;
#elif defined(SLI_ARM)
    return SL_ISA_NEON;
#else
    return SL_ISA_SCALAR;
#endif
}

#endif
