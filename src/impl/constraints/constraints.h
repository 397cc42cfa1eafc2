/* constraints.h: sets of pins: created, added, released, and made again for other numbers */
#ifndef SLI_CONSTRAINTS_H
#define SLI_CONSTRAINTS_H

#include "../factor/factor_setup.h"
#include "constraints_rows.h"

/* Prepares a set without pins for the numbers of its base. */
static sl_status sli_constraints_take(sl_constraints *P) {
    const sl_factor *F = P->F;
    const sl_factor_info *info = &F->stats.factor;
    P->sign = info->negative > 0 ? -1.0 : 1.0;
    P->delta = P->sign * (info->pivot_max > 0.0 ? info->pivot_max : 1.0);
    P->numbers = sli_numbers_of(F);
    P->n_used = 0;
    P->uses = NULL;
    if (P->F->null.count > 0) {
        const size_t bytes = (size_t)P->F->null.count * sizeof *P->uses;
        P->uses = (sl_int *)sli_alloc(&P->allocator, bytes);
        if (P->uses == NULL) {
            return sli_no_memory();
        }
        memset(P->uses, 0, bytes);
    }
    return SL_OK;
}

/* May F have pins? A regularized factor is that of A + E, and a set of pins has no refinement. */
static sl_status sli_constraints_check(const sl_factor *F) {
    const sl_factor_info *info = &F->stats.factor;
    const sl_status status = sli_factor_has_numbers(F);
    if (status != SL_OK || (F->E == NULL && info->regularized == 0 &&
                            (info->positive == 0 || info->negative == 0))) {
        return status;
    }
    return sli_refuse(SL_ERR_UNSUPPORTED,
                      info->regularized > 0 ? "pins with regularized pivots"
                                            : "pins with pivots of both signs or 2x2 pivots");
}

/* Releases what a set has made on top of its factor. */
static void sli_constraints_release(sl_constraints *P) {
    sl_int k;
    for (k = 0; k < P->n_pins; k++) {
        sli_pin_free(P, P->pins[k]);
    }
    sli_free(&P->allocator, P->pins);
    sli_free(&P->allocator, P->uses);
}

SLI_NOINLINE static void sli_constraints_report(const sl_constraints *P, double started,
                                                sl_stats *stats) {
    if (stats != NULL) {
        stats->constraints.count = P->n_pins;
        stats->constraints.seconds = sli_seconds() - started;
    }
}

SL_API sl_status sl_constraints_create(sl_constraints **out, const sl_factor *F,
                                       const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sl_constraints *P = NULL;
    sl_status status;
    status = sli_begin(out);
    status = status == SL_OK
                 ? sli_argument(F == NULL ? "F is NULL" : sli_options_wrong(opt, SLI_READS_NOTHING))
                 : status;
    status = status == SL_OK ? sli_constraints_check(F) : status;
    if (status != SL_OK) {
        return status;
    }
    P = (sl_constraints *)sli_alloc(&a, sizeof *P);
    if (P == NULL) {
        return sli_no_memory();
    }
    memset(P, 0, sizeof *P);
    P->allocator = a;
    P->F = F;
    sli_borrow(&F->borrowers);
    status = sli_constraints_take(P);
    if (status == SL_OK) {
        *out = P;
    } else {
        sl_constraints_free(P);
    }
    return status;
}

SL_API void sl_constraints_free(sl_constraints *P) {
    if (P != NULL) {
        const sl_allocator a = P->allocator;
        sli_constraints_release(P);
        sl_factor_free((sl_factor *)P->F);
        sli_free(&a, P);
    }
}

/* Takes a pin out of the set. */
static void sli_constraints_drop(sl_constraints *P, sl_int index) {
    if (P->numbers.generation != 0) { /* else its null pivots may be those of another F */
        sli_constraints_count_nulls(P, P->pins[index], 0);
    }
    sli_pin_free(P, P->pins[index]);
    sli_constraints_remove(P, index);
}

/* Checks rows that are held, and the values of an equality. */
static sl_status sli_constraints_check_rows(const sl_constraints *P, const sl_int *rows,
                                            const double *values, sl_int count, sl_stats *stats) {
    sl_int k;
    sl_status status = sli_argument(P == NULL                      ? "P is NULL"
                                    : count < 0                    ? "count is below 0"
                                    : count == 0 && values != NULL ? "an equality has no rows"
                                    : count > 0 && rows == NULL    ? "rows is NULL"
                                                                   : NULL);
    status = status == SL_OK ? sli_constraints_are_current(P) : status;
    if (status == SL_OK && count > INT32_MAX - P->n_pins) {
        status = sli_refuse(SL_ERR_TOO_LARGE, "more than 2^31 - 1 pins");
    }
    for (k = 0; k < count && status == SL_OK; k++) {
        if (rows[k] < 0 || rows[k] >= P->F->S->n) {
            return sli_refuse_row(stats, rows[k]);
        }
        if (values != NULL && !sli_is_finite(values[k])) {
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, rows[k], -1, values[k],
                               "a value of the equality is not finite");
        }
    }
    return status;
}

SL_API sl_status sl_constraints_add(sl_constraints *P, const sl_int *rows, const double *values,
                                    sl_int count, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    const sli_equality e = sli_equality_of(rows, values, count);
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_constraints_check_rows(P, rows, values, count, stats);
    if (status == SL_OK) {
        status = values == NULL ? sli_constraints_push_rows(P, rows, count, stats)
                                : sli_constraints_push(P, &e, stats);
    }
    if (status == SL_OK) {
        sli_constraints_report(P, started, stats);
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_constraints_release(sl_constraints *P, const sl_int *indices, sl_int count,
                                        sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_block b = {NULL, 0};
    unsigned char *gone = NULL;
    sl_status status;
    sl_int k;
    sli_stats_clear_error(stats);
    status = sli_argument(P == NULL                      ? "P is NULL"
                          : count < 0                    ? "count is below 0"
                          : count > 0 && indices == NULL ? "indices is NULL"
                                                         : NULL);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    if (count == 0) {
        sli_constraints_report(P, started, stats);
        return SL_OK;
    }
    SLI_LAYOUT(&b, &P->allocator, status) {
        gone = SLI_TAKE(&b, unsigned char, P->n_pins);
    }
    for (k = 0; k < P->n_pins && status == SL_OK; k++) {
        gone[k] = 0;
    }
    for (k = 0; k < count && status == SL_OK; k++) {
        if (indices[k] < 0 || indices[k] >= P->n_pins || gone[indices[k]]) {
            status = sli_fail_at(stats, SL_ERR_ARGUMENT, -1, -1, (double)indices[k],
                                 "no pin has this index, or the index is given twice");
        } else {
            gone[indices[k]] = 1;
        }
    }
    for (k = P->n_pins - 1; k >= 0 && status == SL_OK; k--) {
        if (gone[k]) {
            sli_constraints_drop(P, k);
        }
    }
    sli_free(&P->allocator, b.base);
    if (status == SL_OK) {
        sli_constraints_report(P, started, stats);
    }
    return sli_report(stats, status);
}

/* Is it the pin of a row? */
SLI_INLINE int sli_pin_is_row(const sli_pin *pin) {
    return pin->count == 1 && pin->values[0] == 1.0 && pin->exponent == 0;
}

/* Fills a new set, D, from the pins of P; rows: P->n_pins of scratch. */
static sl_status sli_constraints_fill(sl_constraints *D, const sl_constraints *P, sl_int *rows,
                                      sl_stats *stats) {
    sl_status status = sli_constraints_take(D);
    sl_int k, last;
    for (k = 0; k < P->n_pins && status == SL_OK; k = last) {
        const sli_pin *pin = P->pins[k];
        for (last = k; last < P->n_pins && sli_pin_is_row(P->pins[last]); last++) {
            rows[last - k] = P->pins[last]->rows[0];
        }
        if (last == k) {
            const sli_equality e = sli_equality_of(pin->rows, pin->values, pin->count);
            status = sli_constraints_push(D, &e, stats);
            if (status == SL_OK) {
                D->pins[k]->exponent = pin->exponent; /* of the caller's values */
            }
            last = k + 1;
        } else {
            status = sli_constraints_push_rows(D, rows, last - k, stats);
        }
    }
    return status;
}

/* Makes the set again for the present numbers of F. On error solves are refused. */
static sl_status sli_constraints_renew(sl_constraints *P, sl_stats *stats) {
    sl_constraints D = *P;
    sli_block b = {NULL, 0};
    sl_int *rows = NULL;
    sl_status status = sli_constraints_check(P->F);
    D.n_pins = D.capacity = 0;
    D.pins = NULL;
    D.uses = NULL;
    SLI_LAYOUT(&b, &P->allocator, status) {
        rows = SLI_TAKE(&b, sl_int, P->n_pins);
    }
    status = status == SL_OK ? sli_constraints_fill(&D, P, rows, stats) : status;
    sli_free(&P->allocator, b.base);
    if (status != SL_OK) {
        P->numbers.generation = 0;
    }
    sli_constraints_release(status == SL_OK ? P : &D);
    if (status == SL_OK) {
        *P = D;
    }
    return status;
}

SL_API sl_status sl_constraints_refactor(sl_constraints *P, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sl_status status;
    sli_stats_clear_error(stats);
    status = sli_argument(P == NULL ? "P is NULL" : NULL);
    status = status == SL_OK ? sli_constraints_renew(P, stats) : status;
    if (status == SL_OK) {
        sli_constraints_report(P, started, stats);
    }
    return sli_report(stats, status);
}

#endif
