/* table.h: the table of kernels, which every instruction set fills */
#ifndef SLI_KERNELS_TABLE_H
#define SLI_KERNELS_TABLE_H

#include "../../public/types.h"
#include "front.h"
#include "pairs.h"
#include "step.h"

/* Copies 8 columns of M, ldm apart, to the given rows of v, and back. v is 64-byte aligned, the
 * rows have a multiple of 8 lanes. is_streamed: v is not read before it would have left the caches.
 */
typedef void (*sli_interleave_kernel)(double *v, sli_rows rows, const double *M, size_t ldm,
                                      int is_streamed);
typedef void (*sli_separate_kernel)(double *M, size_t ldm, const double *v, sli_rows rows);

/* The kernels of the core. A pack has tables of its own, one for each instruction set. */
typedef struct sli_kernels {
    sl_isa isa;
    sl_int width;            /* doubles of a register; 1 in plain C */
    sli_sweeps sweeps;       /* over L in double */
    sli_front_kernels front; /* in double */
    sli_row_kernel row;
    sli_interleave_kernel interleave;
    sli_separate_kernel separate;
} sli_kernels;

#endif
