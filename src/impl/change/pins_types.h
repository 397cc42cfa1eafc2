/* pins_types.h: a set of pins: the method, and what it keeps */
#ifndef SLI_CHANGE_PINS_TYPES_H
#define SLI_CHANGE_PINS_TYPES_H

#include "../../public/pins.h"
#include "../solve/plan.h"
#include "../solve/sweep.h"

/* Minimize x' A x / 2 - b' x with c_p' x = g_p for the columns c_p of a matrix C:
 *
 *     A x = b + C f,  K f = g - C' A^-1 b,  K = C' A^-1 C.
 *
 * With Y = L^-1 P C, kept in the reaches of its columns, K = Y' D^-1 Y, and C' A^-1 b = Y' D^-1 y
 * after the forward sweep y = L^-1 P b: a solve takes one forward and one backward sweep.
 *
 * In a singular component with null vector z, whose null pivot is N, let D(N) = delta. L is that of
 * a regular A + delta e e', e the unit vector of N. The solution of A is then that of this matrix
 * plus v z, where z' (b + C f) = 0, and v is the unknown that belongs to this equation. */

/* One equality. */
typedef struct sli_pin {
    sl_int null; /* the null pivot of its component; -1: none */
    double z;    /* z' c of the null vector, scaled to 1 at the null pivot; 0: none */
    sl_int count;
    sl_int *rows; /* count: the rows of c, and its entries */
    double *values;
    sli_reach R; /* of c */
    double *y;   /* R.columns: L^-1 P c */
} sli_pin;

struct sl_pins {
    sl_allocator allocator;
    const sl_factor *F; /* borrowed */
    sli_numbers numbers;
    double sign;      /* of all pivots */
    double delta;     /* takes the place of null pivots */
    double *divisors; /* n: D, with 1 at null pivots; NULL: there are none */
    sl_int count, capacity;
    sli_pin **pins;  /* capacity */
    double *K;       /* capacity x capacity, row-major: the factor L D L' of K, D on the diagonal */
    double *scratch; /* 2 capacity */
};

/* D^-1 of a column where null pivots are delta. */
SLI_INLINE double sli_pins_inverse(const sl_pins *P, sl_int column) {
    const double d = P->F->D[column];
    return 1.0 / (P->divisors != NULL && d == SLI_NULL_PIVOT ? P->delta : d);
}

#endif
