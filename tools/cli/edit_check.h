/* edit_check.h: compares a factor that followed edits with a new one */
#ifndef TOOLS_EDIT_CHECK_H
#define TOOLS_EDIT_CHECK_H

#include <stdint.h>

#include "sparse_local.h"

typedef struct edit_check {
    double difference;     /* of the solutions of a random system, relative to the largest entry */
    double backward_error; /* of the solution by the factor that followed */
    double refactor_ms;    /* processor time of a refactorization */
    double anew_ms;        /* of order, analysis and factorization */
} edit_check;

/** Compares F with a new factor of A. Ends the program with a message on errors.
 *
 *  random  [in,out]  state of app_random.
 */
edit_check edit_check_factor(const sl_csc *A, const sl_factor *F, sl_work *W, uint64_t *random);

#endif
