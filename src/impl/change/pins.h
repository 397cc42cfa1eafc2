/* pins.h: sets of pins: created, added, released, refactored */
#ifndef SLI_CHANGE_PINS_H
#define SLI_CHANGE_PINS_H

#include "pins_capacitance.h"

/* Takes the numbers of F. */
static sl_status sli_pins_take(sl_pins *P) {
    const sl_factor *F = P->F;
    const sl_factor_info *info = &F->stats.factor;
    sl_status status = SL_OK;
    sl_int *uses = NULL;
    if (!F->is_valid) {
        return SL_ERR_STATE;
    }
    if (F->E != NULL || (info->positive > 0 && info->negative > 0)) {
        return SL_ERR_UNSUPPORTED;
    }
    P->sign = info->negative > 0 ? -1.0 : 1.0;
    P->delta = P->sign * (info->pivot_max > 0.0 ? info->pivot_max : 1.0);
    if (F->n_nulls > 0) {
        status = SL_ERR_MEMORY;
        uses = (sl_int *)sli_alloc(&P->allocator, (size_t)F->n_nulls * sizeof *uses);
        if (uses != NULL) {
            memset(uses, 0, (size_t)F->n_nulls * sizeof *uses);
            status = SL_OK;
        }
    }
    if (status == SL_OK) {
        sli_free(&P->allocator, P->uses);
        P->uses = uses;
        P->n_used = 0;
        P->numbers = sli_numbers_of(F);
    }
    return status;
}

SL_API sl_status sl_pins_create(sl_pins **out, const sl_factor *F, const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sli_block b = {NULL, 0, 0};
    sl_pins *P = NULL;
    sl_status status = SL_OK;
    int pass;
    if (out == NULL) {
        return SL_ERR_ARGUMENT;
    }
    *out = NULL;
    if (F == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
        return SL_ERR_ARGUMENT;
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        P = (sl_pins *)sli_take(&b, 1, sizeof *P);
        status = pass == 0 ? sli_block_alloc(&b, &a) : SL_OK;
    }
    if (status == SL_OK) {
        memset(P, 0, sizeof *P);
        P->allocator = a;
        P->F = F;
        status = sli_pins_take(P);
        if (status == SL_OK) {
            *out = P;
        } else {
            sl_pins_free(P);
        }
    }
    return status;
}

SL_API void sl_pins_free(sl_pins *P) {
    if (P != NULL) {
        const sl_allocator a = P->allocator;
        sl_int k;
        for (k = 0; k < P->count; k++) {
            sli_pin_free(P, P->pins[k]);
        }
        sli_free(&a, P->pins);
        sli_free(&a, P->uses);
        sli_free(&a, P);
    }
}

SL_API sl_status sl_pins_add_equality(sl_pins *P, const sl_int *rows, const double *values,
                                      sl_int count, sl_stats *stats) {
    sli_pin *pin = NULL;
    double *y = NULL;
    sl_status status;
    sl_int k;
    sli_stats_clear_error(stats);
    if (P == NULL || count < 1 || rows == NULL || values == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (!P->F->is_valid || !sli_numbers_are_of(&P->numbers, P->F)) {
        return SL_ERR_STATE;
    }
    for (k = 0; k < count; k++) {
        if (!sli_is_finite(values[k])) {
            return sli_fail_at(stats, SL_ERR_NOT_FINITE, rows[k], -1, values[k]);
        }
    }
    status = sli_pins_grow(P);
    status = status == SL_OK ? sli_pin_create(&pin, P, rows, values, count, stats) : status;
    if (status != SL_OK) {
        return status;
    }
    y = (double *)sli_alloc(&P->allocator, (size_t)pin->R.columns * sizeof *y);
    status = y == NULL ? SL_ERR_MEMORY : sli_pins_append(P, pin, y);
    sli_free(&P->allocator, y);
    if (status != SL_OK) {
        sli_pin_free(P, pin);
        return status == SL_ERR_MEMORY ? status : sli_fail_at(stats, status, rows[0], -1, 0.0);
    }
    sli_pins_count_nulls(P, pin, 1);
    P->pins[P->count++] = pin;
    return SL_OK;
}

SL_API sl_status sl_pins_add(sl_pins *P, sl_int row, sl_stats *stats) {
    const double one = 1.0;
    return sl_pins_add_equality(P, &row, &one, 1, stats);
}

SL_API sl_status sl_pins_release(sl_pins *P, sl_int index) {
    sli_pin *pin;
    if (P == NULL || index < 0 || index >= P->count) {
        return SL_ERR_ARGUMENT;
    }
    pin = P->pins[index];
    sli_pins_remove(P, index);
    if (P->numbers.generation != 0) { /* else its null pivots may be those of another F */
        sli_pins_count_nulls(P, pin, 0);
    }
    sli_pin_free(P, pin);
    return SL_OK;
}

SL_API sl_int sl_pins_count(const sl_pins *P) {
    return P == NULL ? 0 : P->count;
}

SL_API sl_status sl_pins_refactor(sl_pins *P) {
    sli_block b = {NULL, 0, 0};
    double *scratch = NULL, *y = NULL;
    sl_status status;
    sl_int count, k, row, columns = 0;
    int pass;
    if (P == NULL) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_pins_take(P);
    P->numbers.generation = 0; /* until all of them are there */
    for (k = 0; k < P->count; k++) {
        columns = sli_max(columns, P->pins[k]->R.columns);
    }
    for (pass = 0; pass < 2 && status == SL_OK; pass++) {
        scratch = SLI_TAKE(&b, double, sli_sweep_scratch(P->F->S->tallest, P->F->S->widest, 1));
        y = SLI_TAKE(&b, double, columns);
        status = pass == 0 ? sli_block_alloc(&b, &P->allocator) : SL_OK;
    }
    count = P->count;
    P->count = 0;
    for (k = 0; k < count && status == SL_OK; k++) {
        status = sli_pin_sweep(P, P->pins[k], scratch, &row);
        status = status == SL_OK ? sli_pins_append(P, P->pins[k], y) : status;
        P->count++;
    }
    P->count = count;
    for (k = 0; k < count && status == SL_OK; k++) {
        sli_pins_count_nulls(P, P->pins[k], 1);
    }
    P->numbers.generation = status == SL_OK ? P->F->generation : 0;
    sli_free(&P->allocator, b.base);
    return status;
}

#endif
