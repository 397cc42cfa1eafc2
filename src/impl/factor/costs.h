/* costs.h: what steps cost, by which packs choose between methods: counted, in entries of L that a
 * sweep of one vector reads */
#ifndef SLI_FACTOR_COSTS_H
#define SLI_FACTOR_COSTS_H

#include "../kernels/dispatch.h"

/* What begins and ends a front, whatever its size: its rows, its panel, its place in its parent. */
#define SLI_COST_FRONT 4000.0
/* An entry of A that is looked up and put into a front. */
#define SLI_COST_INPUT 20.0

/* A flop of a front. Its kernels do about as many in the time of an entry as a register has
 * doubles. */
SLI_INLINE double sli_cost_flop(const sli_kernels *kernels) {
    return 1.0 / (double)kernels->width;
}

/* A sweep of some lanes reads an entry once, and computes with it in each of them, in one operation
 * where 8 lanes fill a register. */
SLI_INLINE double sli_cost_lanes(const sli_kernels *kernels, sl_int lanes) {
    return kernels->width == 8 && lanes == 8 ? 2.1 : 0.7 + 0.3 * lanes;
}

#endif
