/* lanes_ymm.inl.h: four right-hand sides in one 256-bit register, for AVX2 and AVX-512 alike */

#define SLW_LANES 4
#define SLW_ROWS 8
#define SLW_DECLARE(a) __m256d a;
#define SLW_ZERO(a) a = _mm256_setzero_pd();
#define SLW_LOAD(a, p) a = _mm256_loadu_pd(p);
#define SLW_STORE(p, a) _mm256_storeu_pd((p), a);
#define SLW_FNMA(a, s, b) a = _mm256_fnmadd_pd(_mm256_broadcast_sd(&(s)), b, a);
#define SLW_ADD(a, b) a = _mm256_add_pd(a, b);
#define SLW_DIVIDE(a, s) a = _mm256_div_pd(a, _mm256_set1_pd(s));
#include "lanes.inl.h"
