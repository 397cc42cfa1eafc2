/* pins.h: sets of pins: created, added, released */
#ifndef SLI_CHANGE_PINS_H
#define SLI_CHANGE_PINS_H

#include "pins_matrix.h"

SL_API sl_status sl_pins_create(sl_pins **out, const sl_factor *F, const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sl_pins *P = NULL;
    sl_status status;
    status = sli_begin(out);
    status = status == SL_OK
                 ? sli_argument(F == NULL ? "F is NULL" : sli_options_wrong(opt, SLI_READS_NOTHING))
                 : status;
    status = status == SL_OK ? sli_pins_check(F) : status;
    if (status != SL_OK) {
        return status;
    }
    P = (sl_pins *)sli_alloc(&a, sizeof *P);
    if (P == NULL) {
        return sli_no_memory();
    }
    memset(P, 0, sizeof *P);
    P->allocator = a;
    P->F = P->base = F;
    sli_borrow(&F->borrowers);
    P->reason = SL_PINS_NO_MATRIX;
    status = sli_pins_take(P);
    if (status == SL_OK) {
        *out = P;
    } else {
        sl_pins_free(P);
    }
    return status;
}

SL_API void sl_pins_free(sl_pins *P) {
    if (P != NULL) {
        const sl_allocator a = P->allocator;
        sli_pins_release(P);
        sl_factor_free(P->G);
        sl_factor_free((sl_factor *)P->F);
        sli_free(&a, P->values);
        sli_free(&a, P);
    }
}

/* Takes pin number `index`, which is not held, out of the set. */
static void sli_pins_drop(sl_pins *P, sl_int index) {
    sl_int k, at = 0;
    while (P->pins[at]->index != index) {
        at++;
    }
    if (P->numbers.generation != 0) { /* else its null pivots may be those of another F */
        sli_pins_count_nulls(P, P->pins[at], 0);
    }
    sli_pin_free(P, P->pins[at]);
    sli_pins_remove(P, at);
    for (k = 0; k < P->n_pins; k++) {
        P->pins[k]->index -= P->pins[k]->index > index;
    }
    for (k = 0; k < P->n_held; k++) {
        P->held_pin[k] -= P->held_pin[k] > index;
    }
    P->count--;
    memmove(P->rows + index, P->rows + index + 1, (size_t)(P->count - index) * sizeof *P->rows);
}

SL_API sl_status sl_pins_add_equality(sl_pins *P, const sl_int *rows, const double *values,
                                      sl_int count, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    const sli_equality e = sli_equality_of(rows, values, count);
    sl_status status;
    sl_int k;
    sli_stats_clear_error(stats);
    status = sli_argument(P == NULL        ? "P is NULL"
                          : count < 1      ? "count is below 1"
                          : rows == NULL   ? "rows is NULL"
                          : values == NULL ? "values is NULL"
                                           : NULL);
    status = status == SL_OK ? sli_pins_are_current(P) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    for (k = 0; k < count; k++) {
        if (!sli_is_finite(values[k])) {
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, rows[k], -1, values[k],
                               "a value of the equality is not finite");
        }
    }
    status = sli_pins_reserve(P, P->count + 1);
    status = status == SL_OK ? sli_pins_push(P, P->count, &e, stats) : status;
    if (status == SL_OK) {
        P->rows[P->count++] = -1;
        sli_pins_report(P, started, stats);
    }
    return sli_report(stats, status);
}

/* Adds pins by the capacitance matrix: all of them, or none. */
static sl_status sli_pins_add_by_capacitance(sl_pins *P, const sl_int *rows, sl_int count,
                                             sl_stats *stats) {
    sl_status status = sli_pins_reserve(P, P->count + count);
    status = status == SL_OK ? sli_pins_push_rows(P, P->count, rows, count, stats) : status;
    if (status == SL_OK && count > 0) {
        memcpy(P->rows + P->count, rows, (size_t)count * sizeof *rows);
        P->count += count;
    }
    return status;
}

/* Adds pins by elimination if that is cheaper than what capacitance has cost since the last choice
 * and would cost now, *seconds. *is_done: they are added. */
static sl_status sli_pins_add_by_elimination(sl_pins *P, const sl_int *rows, sl_int count,
                                             double *seconds, int *is_done, sl_stats *stats) {
    const sl_symbolic *S = P->F->S;
    sli_pins_target t;
    sli_holding h;
    sli_block b = {NULL, 0, 0};
    uint64_t one = sli_keyed(S->iperm[rows[0]], 0);
    double elimination = 0.0;
    sl_status status;
    sl_int k;
    *seconds = count > 1 ? 0.0 : sli_pins_capacitance_cost(S, &one, 1, P->n_pins, NULL);
    if (count == 1 && P->spent + *seconds <= P->threshold) {
        return SL_OK;
    }
    status = sli_pins_target_make(&t, &b, P, count);
    if (status == SL_OK && count > 1) {
        for (k = 0; k < count; k++) {
            t.list[k] = sli_keyed(S->iperm[rows[k]], 0);
        }
        sli_sort(t.list, count, t.list + count);
        *seconds = sli_pins_capacitance_cost(S, t.list, count, P->n_pins, t.uses);
    }
    memset(&h, 0, sizeof h);
    if (status == SL_OK && P->spent + *seconds > P->threshold) {
        sli_pins_target_add(&t, P, NULL);
        memcpy(t.rows + t.count, rows, (size_t)count * sizeof *rows);
        t.count += count;
        status = sli_holding_begin(&h, P, t.rows, t.count, 0, stats);
        if (status == SL_OK) {
            P->capacitance = P->spent + *seconds;
            P->elimination = elimination = sli_pins_elimination_cost(P, &h);
            *is_done = P->capacitance > elimination;
            P->threshold = *is_done ? P->threshold : fmax(0.9 * elimination, 1.2 * P->capacitance);
        }
    }
    if (*is_done) {
        status = sli_pins_rebuild(P, &t, &h, 0, stats);
        *is_done = status == SL_OK;
        if (*is_done) {
            P->reason = SL_PINS_CHEAPEST;
            P->spent = 0.0;
            P->threshold = SLI_PINS_WORTH * sli_pins_least_cost(P);
        } else if (sli_pins_is_refused(status)) {
            P->reason = SL_PINS_REFUSED;
            P->threshold = (double)INFINITY;
            status = SL_OK;
        }
    }
    sli_free(&P->allocator, h.block);
    sli_free(&P->allocator, b.base);
    return status;
}

SL_API sl_status sl_pins_add(sl_pins *P, const sl_int *rows, sl_int count, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    double seconds = 0.0, threshold;
    sl_pins_reason reason;
    sl_status status;
    sl_int k;
    int is_done = 0;
    sli_stats_clear_error(stats);
    status = sli_argument(P == NULL                   ? "P is NULL"
                          : count < 0                 ? "count is below 0"
                          : count > 0 && rows == NULL ? "rows is NULL"
                                                      : NULL);
    status = status == SL_OK ? sli_pins_are_current(P) : status;
    if (status == SL_OK && count > INT32_MAX - P->count) {
        status = sli_refuse(SL_ERR_TOO_LARGE, "more than 2^31 - 1 pins");
    }
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    reason = P->reason;
    threshold = P->threshold;
    for (k = 0; k < count; k++) {
        if (rows[k] < 0 || rows[k] >= P->F->S->n) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, rows[k], -1, 0.0, "a row is out of range");
        }
        if (sli_held_find(P, P->F->S->iperm[rows[k]]) != -1) {
            return sli_fail_at(stats, SL_ERR_PIVOT, rows[k], -1, 0.0, sli_pinned_twice);
        }
    }
    if (P->values != NULL && count > 0) {
        status = sli_pins_add_by_elimination(P, rows, count, &seconds, &is_done, stats);
    }
    if (status == SL_OK && !is_done) {
        status = sli_pins_add_by_capacitance(P, rows, count, stats);
        P->spent += status == SL_OK ? seconds : 0.0;
    }
    if (status == SL_OK) {
        sli_pins_report(P, started, stats);
    } else { /* both methods have refused them */
        P->reason = reason;
        P->threshold = threshold;
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_pins_release(sl_pins *P, const sl_int *indices, sl_int count, sl_stats *stats) {
    const double started = stats == NULL ? 0.0 : sli_seconds(); /* half a microsecond */
    sli_pins_target t;
    sli_block b = {NULL, 0, 0}, targets = {NULL, 0, 0};
    unsigned char *gone = NULL;
    sl_status status;
    sl_int k, held = 0;
    sli_stats_clear_error(stats);
    status = sli_argument(P == NULL                      ? "P is NULL"
                          : count < 0                    ? "count is below 0"
                          : count > 0 && indices == NULL ? "indices is NULL"
                                                         : NULL);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    if (count == 0) {
        sli_pins_report(P, started, stats);
        return SL_OK;
    }
    SLI_LAYOUT(&b, &P->allocator, status) {
        gone = SLI_TAKE(&b, unsigned char, P->count);
    }
    if (status == SL_OK && P->count > 0) {
        memset(gone, 0, (size_t)P->count);
    }
    for (k = 0; k < count && status == SL_OK; k++) {
        if (indices[k] < 0 || indices[k] >= P->count || gone[indices[k]]) {
            status = sli_fail_at(stats, SL_ERR_ARGUMENT, -1, -1, (double)indices[k],
                                 "no pin has this index, value, or it is given twice");
        } else {
            gone[indices[k]] = 1;
        }
    }
    for (k = 0; k < P->n_held && status == SL_OK; k++) {
        held += gone[P->held_pin[k]];
    }
    if (status == SL_OK && held > 0) {
        status = sli_pins_are_current(P);
        status = status == SL_OK ? sli_pins_target_make(&t, &targets, P, 0) : status;
        if (status == SL_OK) {
            sli_pins_target_add(&t, P, gone);
            status = sli_pins_remake(P, &t, P->values, 2.0, 0, stats);
        }
        sli_free(&P->allocator, targets.base);
    }
    for (k = P->count - 1; k >= 0 && status == SL_OK && held == 0; k--) {
        if (gone[k]) {
            sli_pins_drop(P, k);
        }
    }
    sli_free(&P->allocator, b.base);
    if (status == SL_OK) {
        sli_pins_report(P, started, stats);
    }
    return sli_report(stats, status);
}

#endif
