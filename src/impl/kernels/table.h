/* table.h: the table of kernels, which every instruction set fills */
#ifndef SLI_KERNELS_TABLE_H
#define SLI_KERNELS_TABLE_H

#include "../../public/types.h"
#include "front.h"
#include "pairs.h"
#include "step.h"

/* Copies rows 0 .. count-1 of 8 columns of M, ldm apart, to v + index[k] stride, and back. v is
 * 64-byte aligned, stride is a multiple of 8. is_streamed: v is not read before it would have left
 * the caches. */
typedef void (*sli_interleave_kernel)(double *v, sl_int stride, const sl_int *index, sl_int count,
                                      const double *M, size_t ldm, int is_streamed);
typedef void (*sli_separate_kernel)(double *M, size_t ldm, const double *v, sl_int stride,
                                    const sl_int *index, sl_int count);

/* The kernels of the core. A pack has tables of its own, one for each instruction set, in the order
 * of sli_isa_row. */
typedef struct sli_kernels {
    sl_isa isa;
    sli_sweeps sweeps;       /* over L in double */
    sli_front_kernels front; /* in double */
    sli_row_kernel row;
    sli_interleave_kernel interleave;
    sli_separate_kernel separate;
} sli_kernels;

#endif
