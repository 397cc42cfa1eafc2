/* pins_rebuild.h: sets of pins made again: other numbers, or the other method */
#ifndef SLI_CHANGE_PINS_REBUILD_H
#define SLI_CHANGE_PINS_REBUILD_H

#include "pins_choose.h"

/* Prepares a set without pins for the numbers of its base. */
static sl_status sli_pins_take(sl_pins *P) {
    const sl_factor *F = P->F;
    const sl_factor_info *info = &F->stats.factor;
    P->sign = info->negative > 0 ? -1.0 : 1.0;
    P->delta = P->sign * (info->pivot_max > 0.0 ? info->pivot_max : 1.0);
    P->numbers = sli_numbers_of(F);
    P->n_used = 0;
    P->uses = NULL;
    if (P->base->null.count > 0) {
        const size_t bytes = (size_t)P->base->null.count * sizeof *P->uses;
        P->uses = (sl_int *)sli_alloc(&P->allocator, bytes);
        if (P->uses == NULL) {
            return sli_no_memory();
        }
        memset(P->uses, 0, bytes);
    }
    return SL_OK;
}

/* May F have pins? */
static sl_status sli_pins_check(const sl_factor *F) {
    const sl_factor_info *info = &F->stats.factor;
    const sl_status status = sli_factor_has_numbers(F);
    if (status != SL_OK || (F->E == NULL && (info->positive == 0 || info->negative == 0))) {
        return status;
    }
    return sli_refuse(SL_ERR_UNSUPPORTED, "pins with pivots of both signs or 2x2 pivots");
}

/* Releases what a set has made on top of its factors and of A. */
static void sli_pins_release(sl_pins *P) {
    sl_int k;
    for (k = 0; k < P->n_pins; k++) {
        sli_pin_free(P, P->pins[k]);
    }
    sli_free(&P->allocator, P->pins);
    sli_free(&P->allocator, P->uses);
    sli_free(&P->allocator, P->rows);
    sli_free(&P->allocator, P->held);
}

/* Room for the rows of `count` pins in all. */
static sl_status sli_pins_reserve(sl_pins *P, sl_int count) {
    const sl_off room = 2 * (sl_off)count + 8;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int *rows = NULL;
    if (count <= P->room) {
        return SL_OK;
    }
    SLI_LAYOUT(&b, &P->allocator, status) {
        rows = SLI_TAKE(&b, sl_int, room);
    }
    if (status != SL_OK) {
        return status;
    }
    if (P->count > 0) {
        memcpy(rows, P->rows, (size_t)P->count * sizeof *rows);
    }
    sli_free(&P->allocator, P->rows);
    P->rows = rows;
    P->room = room;
    return SL_OK;
}

/* The pins that a set is going to have. */
typedef struct sli_pins_target {
    sl_int count;
    sl_int *rows;   /* count: as in sl_pins */
    sl_int *from;   /* count: the number in `pins` of an equality */
    uint64_t *list; /* 2 count: scratch */
    sl_int *uses;   /* supernodes: scratch, 0 */
} sli_pins_target;

static sl_status sli_pins_target_make(sli_pins_target *t, sli_block *b, const sl_pins *P,
                                      sl_int more) {
    const sl_int count = P->count + more;
    sl_status status = SL_OK;
    SLI_LAYOUT(b, &P->allocator, status) {
        t->rows = SLI_TAKE(b, sl_int, count);
        t->from = SLI_TAKE(b, sl_int, count);
        t->list = SLI_TAKE(b, uint64_t, 2 * (uint64_t)count);
        t->uses = SLI_TAKE(b, sl_int, P->F->S->n_supers);
    }
    if (status == SL_OK) {
        memset(t->uses, 0, (size_t)P->F->S->n_supers * sizeof(sl_int));
    }
    t->count = 0;
    return status;
}

/* Adds all pins of P but those with a flag. */
static void sli_pins_target_add(sli_pins_target *t, const sl_pins *P, const unsigned char *gone) {
    sl_int k, at = 0;
    for (k = 0; k < P->count; k++) {
        while (at < P->n_pins && P->pins[at]->index < k) {
            at++;
        }
        if (gone == NULL || !gone[k]) {
            t->from[t->count] = at;
            t->rows[t->count++] = P->rows[k];
        }
    }
}

/* Seconds of all pins by the capacitance matrix. */
static double sli_pins_target_cost(const sli_pins_target *t, const sl_pins *P) {
    sl_int k, count = 0;
    for (k = 0; k < t->count; k++) {
        if (t->rows[k] != -1) {
            t->list[count++] = sli_keyed(P->F->S->iperm[t->rows[k]], 0);
        }
    }
    sli_sort(t->list, count, t->list + count);
    return sli_pins_capacitance_cost(P->F->S, t->list, count, t->count - count, t->uses);
}

/* Gives G its old numbers again. */
static void sli_held_restore(const sl_pins *P, sli_holding *h) {
    sl_int k;
    for (k = 0; k < P->F->S->n; k++) {
        h->marks[k] = h->marks[k] >> 1;
    }
    sli_holding_mask(h, P);
    h->is_local = 0;
    (void)sli_held_numbers(P->G, P->F, h);
}

/* Fills a new set, D, from the pins of P. */
static sl_status sli_pins_fill(sl_pins *D, const sl_pins *P, const sli_pins_target *t,
                               const sli_holding *h, sl_stats *stats) {
    sl_status status = h == NULL ? SL_OK : sli_held_take(D, h);
    sl_int k, last;
    D->base = h == NULL ? D->F : D->G;
    status = status == SL_OK ? sli_pins_take(D) : status;
    status = status == SL_OK ? sli_pins_reserve(D, t->count) : status;
    for (k = 0; k < t->count && status == SL_OK; k = last) {
        last = k + 1;
        if (t->rows[k] == -1) {
            const sli_pin *pin = P->pins[t->from[k]];
            const sli_equality e = sli_equality_of(pin->rows, pin->values, pin->count);
            status = sli_pins_push(D, k, &e, stats);
        } else {
            while (last < t->count && t->rows[last] != -1) {
                last++;
            }
            status = h == NULL ? sli_pins_push_rows(D, k, t->rows + k, last - k, stats) : SL_OK;
        }
    }
    if (status == SL_OK && t->count > 0) {
        memcpy(D->rows, t->rows, (size_t)t->count * sizeof(sl_int));
    }
    D->count = t->count;
    return status;
}

/* Makes the set again: with its rows held as h says, or, if that is NULL, all by the capacitance
 * matrix. On error P is as before. is_stale: F has changed. */
static sl_status sli_pins_rebuild(sl_pins *P, const sli_pins_target *t, sli_holding *h,
                                  int is_stale, sl_stats *stats) {
    sl_pins D = *P;
    sl_status status = SL_OK;
    D.count = D.n_pins = D.capacity = D.n_held = D.n_couplings = 0;
    D.room = 0;
    D.rows = D.uses = D.held = NULL;
    D.pins = NULL;
    if (h != NULL && P->G == NULL) {
        status = sli_held_factor(&D.G, P->F, &P->allocator);
    }
    status = status == SL_OK && h != NULL ? sli_held_numbers(D.G, P->F, h) : status;
    status = status == SL_OK ? sli_pins_fill(&D, P, t, h, stats) : status;
    if (status != SL_OK) {
        sli_pins_release(&D);
        if (D.G != P->G) {
            sl_factor_free(D.G);
        } else if (h != NULL && P->n_held > 0 && !is_stale) {
            sli_held_restore(P, h);
        }
        return status;
    }
    sli_pins_release(P);
    *P = D; /* G stays, for the next elimination: new memory costs more than numbers */
    return SL_OK;
}

/* Is this the outcome of numbers, after which the other method may be tried? */
static int sli_pins_is_refused(sl_status status) {
    return status != SL_OK && status != SL_ERR_MEMORY;
}

/* Makes the set again by the cheaper method, with the values of A, or NULL. margin: elimination may
 * cost this much more. */
static sl_status sli_pins_remake(sl_pins *P, const sli_pins_target *t, double *values,
                                 double margin, int is_stale, sl_stats *stats) {
    const double capacitance = sli_pins_target_cost(t, P);
    double elimination = 0.0, *old = P->values;
    sl_status status = SL_OK;
    sli_holding h;
    int is_held = 0, is_refused = 0;
    memset(&h, 0, sizeof h);
    P->values = values;
    if (values != NULL) {
        status = sli_holding_begin(&h, P, t->rows, t->count, is_stale, stats);
        elimination = status == SL_OK ? sli_pins_elimination_cost(P, &h) : 0.0;
        is_held = status == SL_OK && margin * capacitance > elimination;
    }
    if (is_held) {
        status = sli_pins_rebuild(P, t, &h, is_stale, stats);
        is_refused = sli_pins_is_refused(status);
        is_held = !is_refused;
    }
    if (!is_held && (status == SL_OK || is_refused)) {
        status = sli_pins_rebuild(P, t, NULL, is_stale, stats);
    }
    sli_free(&P->allocator, h.block);
    if (status != SL_OK) {
        P->values = old;
        return status;
    }
    if (old != values) {
        sli_free(&P->allocator, old);
    }
    P->reason = is_refused       ? SL_PINS_REFUSED
                : values == NULL ? SL_PINS_NO_MATRIX
                                 : SL_PINS_CHEAPEST;
    P->spent = is_held ? 0.0 : capacitance;
    P->threshold = is_refused ? (double)INFINITY : elimination;
    P->capacitance = capacitance;
    P->elimination = elimination;
    return SL_OK;
}

#endif
