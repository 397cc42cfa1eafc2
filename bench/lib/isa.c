/* isa.c: instruction sets: their names, and which of them this processor has */
#include "bench.h"

const char *bench_isa_name(sl_isa isa) {
    static const char *const names[] = {"auto", "scalar", "avx2", "avx512", "neon"};
    return (size_t)isa < sizeof names / sizeof *names ? names[isa] : "?";
}

int bench_isa_is_present(sl_isa isa) {
#if defined(__GNUC__) && defined(__x86_64__)
    return isa == SL_ISA_SCALAR ||
           (isa == SL_ISA_AVX2 && __builtin_cpu_supports("avx2") &&
            __builtin_cpu_supports("fma")) ||
           (isa == SL_ISA_AVX512 && __builtin_cpu_supports("avx512f"));
#elif defined(__aarch64__)
    return isa == SL_ISA_SCALAR || isa == SL_ISA_NEON;
#else
    return isa == SL_ISA_SCALAR;
#endif
}
