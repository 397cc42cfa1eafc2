/* constraints_types.h: a set of pins: the method, and what it keeps */
#ifndef SLI_CONSTRAINTS_TYPES_H
#define SLI_CONSTRAINTS_TYPES_H

#include "../../public/constraints.h"
#include "../solve/plan.h"
#include "../solve/sweep.h"

/* Minimize x' A x / 2 - b' x with c_p' x = g_p for the columns c_p of a matrix C:
 *
 *     A x = b + C f,  K f = g - C' A^-1 b,  K = C' A^-1 C.
 *
 * With Y = L^-1 P C, kept in the reaches of its columns, K = Y' D^-1 Y, and C' A^-1 b = Y' D^-1 y
 * after the forward sweep y = L^-1 P b: a solve takes one forward and one backward sweep.
 *
 * In singular components let the columns of Z span the null space, Z = I in the null rows N, and G
 * be the inverse of A without the rows N, 0 in these rows. Y is 0 there. Then
 *
 *     x = G (b + C f) + Z v,  Z' (b + C f) = 0,  C' x = g.
 *
 * C' G C may be singular, as it is for a pin in N. With W = C' Z and any delta of the sign of A,
 *
 *     K = C' G C + W W' / delta,  K f + W v = g - C' G b - W Z' b / delta,  W' f = -Z' b
 *
 * is the same system with a definite K. Columns of W that depend on others are left out, and their
 * v is 0: motions that the pins do not rule out. */

static const char sli_pinned_twice[] = "the row is pinned twice";
static const char sli_nulls_unknown[] =
    "null vectors of F are not known in the tree of this row: options.null_vector";

/* One equality. */
typedef struct sli_pin {
    sl_int count;
    sl_int *rows;   /* count: the rows of c, in the order of L */
    double *values; /* count: its entries, of which the largest is between 1 and 2 */
    int exponent;   /* these are the caller's times 2^exponent */
    sli_reach R;    /* of c */
    double *y;      /* R.columns: L^-1 P c, 0 at null pivots */
    double *u;      /* R.columns: D^-1 y */
    sl_int n_nulls; /* null pivots in its trees */
    sl_int *nulls;  /* n_nulls: their numbers, ascending; the first array of its own block */
    double *z;      /* n_nulls: z' c of their null vectors, the entries of W */
} sli_pin;

struct sl_constraints {
    sl_allocator allocator;
    const sl_factor *F; /* borrowed */
    sli_numbers numbers;
    double sign;  /* of all pivots */
    double delta; /* takes the place of null pivots */
    sl_int n_pins, capacity;
    sli_pin **pins;  /* capacity: in their order */
    double *K;       /* capacity x capacity, row-major: the factor L D L' of K, D on the diagonal */
    double *scratch; /* 2 capacity */
    sl_int *uses;    /* of each null pivot: the pins in its tree; NULL: there are no null pivots */
    sl_int n_used;   /* null pivots with pins */
};

/* sum a(k) b(k) */
static double sli_dot(const double *a, const double *b, sl_int count) {
    double chains[SLI_TILE] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, sum;
    sl_int k;
    sli_chains_dot(chains, a, b, SLI_TILE, count, 1);
    sum = chains[0];
    for (k = 1; k < SLI_TILE; k++) {
        sum += chains[k];
    }
    return sum;
}

/* Refuses pins on older numbers of their factor. */
static sl_status sli_constraints_are_current(const sl_constraints *P) {
    const sl_status status = sli_factor_has_numbers(P->F);
    return status == SL_OK && !sli_numbers_are_of(&P->numbers, P->F)
               ? sli_refuse(SL_ERR_STALE,
                            "F has changed since the pins were made: sl_constraints_refactor")
               : status;
}

#endif
