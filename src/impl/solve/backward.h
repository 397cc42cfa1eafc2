/* backward.h: the backward sweep of one block: 2x2 pivots first, then the kernel */
#ifndef SLI_SOLVE_BACKWARD_H
#define SLI_SOLVE_BACKWARD_H

#include "../analysis/reach.h"
#include "../factor/storage_type.h"

/* x := D^-1 x in the columns of 2x2 pivots. A reach begins at a whole tile, and a pair is in one
 * tile, so both of its columns are there or none. */
static void sli_pairs_apply(const sl_factor *F, const sli_reach *R, double *x, sl_int lanes) {
    sl_int s, k, r;
    for (s = 0; s < R->count; s++) {
        const sli_step *step = &R->steps[s];
        const sl_int first = step->column, columns = sli_step_columns(step);
        double *row = x + (ptrdiff_t)step->base * lanes;
        for (k = first; k < first + columns; k++, row += lanes) {
            sli_pair_steps steps;
            if (F->S->pairs[k] != SLI_PAIR_FIRST) {
                continue;
            }
            steps = sli_pair_eliminate(F->D[k], F->D[k + 1], F->E[k]);
            for (r = 0; r < lanes; r++) {
                sli_pair_solve(&steps, row[r], row[lanes + r], &row[r], &row[lanes + r]);
            }
        }
    }
}

/* x := L'^-1 D^-1 x over a reach. scratch: sli_sweep_scratch doubles. */
static void sli_backward(const sl_factor *F, const sli_reach *R, int kind, double *x,
                         double *scratch) {
    if (F->E != NULL) {
        sli_pairs_apply(F, R, x, (sl_int)1 << kind);
    }
    sli_backward_sweep(F, kind, R, F->null.is_centered || F->E != NULL ? F->divisors : F->D, x,
                       scratch);
}

/* Are so many numbers finite? No branch for each: the largest exponent carries into the sign. */
SLI_NOINLINE static int sli_are_finite(const double *x, ptrdiff_t count) {
    uint64_t bits, beyond = 0;
    ptrdiff_t k;
    SLI_UNROLL
    for (k = 0; k < count; k++) {
        memcpy(&bits, &x[k], sizeof bits);
        beyond |= (bits & (UINT64_MAX >> 1)) + ((uint64_t)1 << 52);
    }
    return beyond >> 63 == 0;
}

/* Is a solution in the vector of a reach, which ends at the roots, finite? A number of b that is
 * not shows at the root of its tree: sums, products and quotients with it, also those with 0, are
 * not finite either. So only the roots are looked at. Where components have several null vectors,
 * x is 0 at their null pivots. The last two rows of a complex matrix are a number. */
SLI_AT_LINE static int sli_reach_is_finite(const sl_factor *F, const sli_reach *R, const double *x,
                                           sl_int lanes) {
    const sl_symbolic *S = F->S;
    const sl_int *low = R->count == S->n_supers ? S->first_descendant : NULL;
    const sl_int least = S->stats.symbolic.components == 1 ? sli_max(R->count - 1, 0) : 0;
    const sl_int last = 1 + F->type->half;
    const sli_step *steps = R->steps;
    sl_int s;
    int is_finite = 1;
    if (F->null.vectors > 1) {
        return sli_are_finite(x, (ptrdiff_t)R->columns * lanes);
    }
    for (s = R->count - 1; s >= least; s = (low != NULL ? low[s] : s) - 1) {
        ptrdiff_t first, end;
        if (steps[s].up != -1) {
            continue;
        }
        end = (ptrdiff_t)steps[s].base + sli_step_columns(&steps[s]);
        first = end - last;
        while (s > least && steps[s].base == first && steps[s - 1].up == -1) { /* nothing else */
            s--;
            first -= last;
        }
        is_finite &= sli_are_finite(x + first * lanes, (end - first) * lanes);
    }
    return is_finite;
}

#endif
