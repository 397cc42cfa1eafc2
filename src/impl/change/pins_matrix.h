/* pins_matrix.h: sl_pins_refactor: new numbers, and the matrix, whose rows can be eliminated */
#ifndef SLI_CHANGE_PINS_MATRIX_H
#define SLI_CHANGE_PINS_MATRIX_H

#include "../factor/null_product.h"
#include "pins_rebuild.h"

/* Backward errors of a solve beyond which A is not the matrix of F. */
#define SLI_PINS_OTHER 1e-7
#define SLI_PINS_OTHER_FLOAT 1e-3

/* Is this the matrix of F? Solves A x = A z for a random z and tests the residual. A row i of a
 * definite matrix has an error of the size of |l_i| |D| |L'| |x| <= sqrt(a_ii) sum sqrt(a_jj) |x_j|
 * [Hi02] 10.1, which counts where rows are badly scaled. Sets *row to the worst one. */
static sl_status sli_pins_probe(const sl_factor *F, const sli_source *from, const sl_allocator *a,
                                sl_int *row, double *error) {
    const sl_symbolic *S = F->S;
    const sli_reach all = sli_reach_all(S);
    uint64_t random = 1;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    sli_null_row *rows = NULL;
    double *x = NULL, *y = NULL, *diagonal = NULL, *scratch = NULL, most = 0.0;
    sl_int k;
    SLI_LAYOUT(&b, a, status) {
        rows = SLI_TAKE(&b, sli_null_row, S->n);
        x = SLI_TAKE(&b, double, S->n);
        y = SLI_TAKE(&b, double, S->n);
        diagonal = SLI_TAKE(&b, double, S->n);
        scratch = SLI_TAKE(&b, double, sli_sweep_scratch(S->tallest, S->widest, 1));
    }
    *error = 0.0;
    *row = -1;
    for (k = 0; k < S->n && status == SL_OK; k++) {
        random = random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        x[k] = 0.5 + (double)(random >> 40) / 33554432.0;
    }
    if (status == SL_OK) {
        (void)sli_null_product(S, from, 0, rows, x, NULL);
        for (k = 0; k < S->n; k++) {
            x[k] = y[k] = rows[k].product;
        }
        sli_forward_sweep(F, SLI_NRHS_1, &all, x, scratch);
        for (k = 0; k < F->null.count; k++) {
            x[F->null.pivots[k]] = 0.0;
        }
        sli_backward_sweep(F, SLI_NRHS_1, &all, F->D, x, scratch);
        (void)sli_null_product(S, from, 0, rows, x, diagonal);
        for (k = 0; k < S->n; k++) {
            most = fmax(most, sqrt(fabs(diagonal[k])) * fabs(x[k]));
        }
    }
    for (k = 0; k < S->n && status == SL_OK; k++) {
        const double size = rows[k].size + fabs(y[k]) + sqrt(fabs(diagonal[k])) * most;
        const double r = fabs(rows[k].product - y[k]);
        if (size != 0.0 && !(r <= *error * size)) {
            *error = r / size;
            *row = S->perm[k];
            k = *error == *error ? k : S->n; /* not a number */
        }
    }
    sli_free(a, b.base);
    return status;
}

/* Can rows of F be eliminated? */
static int sli_pins_can_hold(const sl_factor *F) {
    return F->null.vectors == 1 && F->rule.regularization == 0.0 &&
           F->type->storage != SL_STORAGE_COMPLEX;
}

/* Reports the method in use. */
static void sli_pins_report(const sl_pins *P, double started, sl_stats *stats) {
    if (stats != NULL) {
        sl_pins_info *info = &stats->pins;
        info->method = P->n_held > 0 ? SL_PINS_ELIMINATION : SL_PINS_CAPACITANCE;
        info->reason = P->reason;
        info->count = P->count;
        info->eliminated = P->n_held;
        info->seconds_capacitance = P->capacitance;
        info->seconds_elimination = P->elimination;
        info->seconds = sli_seconds() - started;
    }
}

/* Takes the present numbers of F. values: those of A, or NULL. On error solves are refused. */
static sl_status sli_pins_renew(sl_pins *P, double *values, sl_stats *stats) {
    sli_pins_target t;
    sli_block b = {NULL, 0, 0};
    sl_status status = sli_pins_check(P->F);
    memset(&t, 0, sizeof t);
    status = status == SL_OK ? sli_pins_target_make(&t, &b, P, 0) : status;
    if (status == SL_OK) {
        sli_pins_target_add(&t, P, NULL);
        status = sli_pins_remake(P, &t, values, 1.0, 1, stats);
    }
    sli_free(&P->allocator, b.base);
    if (status != SL_OK) {
        P->numbers.generation = 0;
    }
    return status;
}

/* Takes a matrix that fits F and, after F has changed, the present numbers of F. */
static sl_status sli_pins_set_matrix(sl_pins *P, const sl_csc *A, sl_stats *stats) {
    const double one = 1.0;
    sli_source from;
    double *values, error;
    sl_status status;
    sl_int row;
    sl_off m, entries;
    entries = P->F->S->scatter_begin[P->F->S->n_supers];
    values = (double *)sli_alloc(&P->allocator, ((size_t)entries + 1) * sizeof *values);
    if (values == NULL) {
        return sli_no_memory();
    }
    for (m = 0; m < entries; m++) {
        values[m] = A->x[P->F->S->scatter_from[m]];
    }
    from.A = NULL;
    from.values = (const double *const *)&values;
    from.coefficients = &one;
    from.terms = 1;
    status = sli_pins_probe(P->F, &from, &P->allocator, &row, &error);
    if (status == SL_OK &&
        !(error <= (sli_is_float(P->F) ? SLI_PINS_OTHER_FLOAT : SLI_PINS_OTHER))) {
        status = sli_fail_at(stats, SL_ERR_ARGUMENT, row, -1, error,
                             "A is not the matrix that F was computed from");
    }
    if (status == SL_OK && !sli_pins_can_hold(P->F)) {
        status = sli_numbers_are_of(&P->numbers, P->F) ? SL_OK : sli_pins_renew(P, NULL, stats);
        P->reason = SL_PINS_UNSUITED;
        sli_free(&P->allocator, values);
    } else if (status == SL_OK && sli_numbers_are_of(&P->numbers, P->F)) {
        sli_free(&P->allocator, P->values);
        P->values = values;
        P->reason = SL_PINS_CHEAPEST;
        P->threshold = SLI_PINS_WORTH * sli_pins_least_cost(P);
    } else {
        status = status == SL_OK ? sli_pins_renew(P, values, stats) : status;
        if (status != SL_OK) {
            sli_free(&P->allocator, values);
        }
    }
    return status;
}

SL_API sl_status sl_pins_refactor(sl_pins *P, const sl_csc *A, sl_stats *stats) {
    const double started = sli_seconds();
    sl_status status;
    sli_stats_clear_error(stats);
    if (P == NULL) {
        return sli_report(stats, sli_argument("P is NULL"));
    }
    if (A == NULL) {
        status = sli_pins_renew(P, NULL, stats);
    } else {
        status = sli_factor_fits(P->F, A);
        status = status == SL_OK ? sli_pins_set_matrix(P, A, stats) : status;
    }
    if (status == SL_OK) {
        sli_pins_report(P, started, stats);
    }
    return sli_report(stats, status);
}

#endif
