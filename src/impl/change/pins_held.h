/* pins_held.h: eliminated rows: the factor of A with identity rows, and what they hand to others */
#ifndef SLI_CHANGE_PINS_HELD_H
#define SLI_CHANGE_PINS_HELD_H

#include "choose.h"
#include "pins_rows.h"

/* A pin is eliminated by replacing its row and column of A by those of a multiple of the identity.
 * The factor of this matrix is that of the other rows, with zeros in between, over the analysis of
 * A. With H the held rows and g their values, the others solve A x = b - A(:, H) g. */

/* A new set of held rows in preparation. */
typedef struct sli_holding {
    sl_int count;
    sl_int *columns;        /* count: columns of L, ascending */
    sl_int *index;          /* count: their pins */
    uint64_t *list;         /* 2 count: for sorting */
    unsigned char *marks;   /* n: 1: held, 2: held until now */
    double *values;         /* of A, as changed */
    uint64_t *room, *seeds; /* n_seeds: columns of supernodes whose values change, ascending */
    sl_int n_seeds;
    sl_off couplings; /* nonzero entries between a held row and another one */
    sl_int *from; /* n_supers: scratch */
    void *block;
    sli_change_choice choice; /* costs */
    int is_new, is_local;     /* G has no numbers of this matrix; it is computed in the reach */
} sli_holding;

static void sli_holding_layout(sli_holding *h, sli_block *b, const sl_symbolic *S) {
    h->columns = SLI_TAKE(b, sl_int, h->count);
    h->index = SLI_TAKE(b, sl_int, h->count);
    h->list = SLI_TAKE(b, uint64_t, 2 * (uint64_t)h->count);
    h->marks = SLI_TAKE(b, unsigned char, S->n);
    h->values = SLI_TAKE(b, double, S->scatter_begin[S->n_supers]);
    h->room = SLI_TAKE(b, uint64_t, S->n_supers);
    h->from = SLI_TAKE(b, sl_int, S->n_supers);
}

/* Sets the values of A with identity rows in the held columns, and finds what changes. */
static void sli_holding_mask(sli_holding *h, const sl_pins *P) {
    const sl_symbolic *S = P->F->S;
    sl_off m;
    sl_int s, k, j;
    h->n_seeds = S->n_supers;
    h->couplings = 0;
    for (s = S->n_supers - 1; s >= 0; s--) {
        sl_int tile = sli_last_tile(S, s);
        int is_changed = 0;
        for (m = S->scatter_begin[s + 1] - 1; m >= S->scatter_begin[s]; m--) {
            int marks;
            sli_scatter_map_pivots(S, s, m, &tile, &k, &j);
            marks = h->marks[k] | h->marks[j];
            h->values[m] = P->values[m];
            if ((marks & 1) != 0) { /* duplicates are neighbors in the map */
                const int is_last =
                    m + 1 == S->scatter_begin[s + 1] || S->scatter_to[m + 1] != S->scatter_to[m];
                h->values[m] = k == j && is_last ? P->delta : 0.0;
                h->couplings += ((h->marks[k] ^ h->marks[j]) & 1) != 0 && P->values[m] != 0.0;
            }
            is_changed |= marks == 1 || marks == 2;
        }
        if (is_changed) {
            h->room[--h->n_seeds] = sli_keyed(S->super_first[s], 0);
        }
    }
    h->seeds = h->room + h->n_seeds;
    h->n_seeds = S->n_supers - h->n_seeds;
}

/* Prepares to hold the rows of pins; rows: of all pins, -1 for equalities. Refuses one twice.
 * is_stale: the present ones are those of another matrix. */
static sl_status sli_holding_begin(sli_holding *h, const sl_pins *P, const sl_int *rows,
                                   sl_int count, int is_stale, sl_stats *stats) {
    const sl_symbolic *S = P->F->S;
    sli_block b = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int k;
    memset(h, 0, sizeof *h);
    for (k = 0; k < count; k++) {
        h->count += rows[k] != -1;
    }
    SLI_LAYOUT(&b, &P->allocator, status) {
        sli_holding_layout(h, &b, S);
    }
    h->block = b.base;
    if (status != SL_OK) {
        return status;
    }
    h->is_new = is_stale || P->n_held == 0;
    h->count = 0;
    for (k = 0; k < count; k++) {
        if (rows[k] != -1) {
            h->list[h->count++] = sli_keyed(S->iperm[rows[k]], k);
        }
    }
    sli_sort(h->list, h->count, h->list + h->count);
    memset(h->marks, 0, (size_t)S->n);
    for (k = 0; k < h->count; k++) {
        h->columns[k] = sli_key(h->list[k]);
        h->index[k] = sli_value(h->list[k]);
        if (h->marks[h->columns[k]]) {
            return sli_fail_at(stats, SL_ERR_PIVOT, S->perm[h->columns[k]], -1, 0.0,
                               sli_pinned_twice);
        }
        h->marks[h->columns[k]] = 1;
    }
    for (k = 0; k < P->n_held && !h->is_new; k++) {
        h->marks[P->held[k]] |= 2;
    }
    sli_holding_mask(h, P);
    return SL_OK;
}

/* A factor over the analysis of F, with its rules and without numbers. */
static sl_status sli_held_factor(sl_factor **G, const sl_factor *F, const sl_allocator *a) {
    sl_options opt = sli_options_with(a);
    sl_status status;
    opt.isa = F->kernels->isa;
    opt.method = F->method;
    opt.storage = F->type->storage;
    opt.threads = F->threads;
    opt.null_pivots = F->null.mode;
    opt.null_tolerance = sli_tolerance_option(F);
    opt.consistency_tolerance = F->null.consistency;
    opt.mass = F->null.mass; /* in another order: below */
    opt.growth_limit = sli_limit_option(F->growth_limit);
    status = sli_factor_new(G, F->S, &opt, NULL);
    if (status == SL_OK && F->null.mode == SL_NULL_PIVOT_SKIP) {
        memcpy((*G)->null.z, F->null.z, (size_t)F->S->n * sizeof(double));
        if (F->null.mass != NULL) {
            memcpy((*G)->null.mass, F->null.mass, (size_t)F->S->n * sizeof(double));
        }
    }
    return status;
}

/* Can G be computed in the reach of the changes? is_new: from the numbers of F, whose null pivots
 * need not remain. */
static int sli_held_is_local(const sl_factor *F, int is_new) {
    return F->method == SL_METHOD_SUPERNODAL && F->type->storage == SL_STORAGE_DOUBLE &&
           (F->null.mode == SL_NULL_PIVOT_REFUSE || !is_new);
}

/* Computes G: from its present numbers, or those of F if it is new, or from A alone. */
static sl_status sli_held_numbers(sl_factor *G, const sl_factor *F, const sli_holding *h) {
    const double started = sli_seconds(), one = 1.0;
    const double *const values = h->values;
    sli_block room = {NULL, 0, 0};
    sl_status status = SL_OK;
    sli_kept kept;
    sli_source from;
    sl_int k;
    from.A = NULL;
    from.values = &values;
    from.coefficients = &one;
    from.terms = 1;
    if (!h->is_local) {
        sli_factor_begin(G);
        return sli_factor_numbers(G, &from, started, NULL);
    }
    sli_reached_begin(&kept, h->is_new ? F : G, h->from);
    for (k = 0; k < h->n_seeds; k++) {
        sli_reached_mark(F->S, h->from, sli_key(h->seeds[k]));
    }
    status = sli_kept_room(&kept, G, &room);
    if (status == SL_OK) {
        sli_factor_begin(G);
        sli_factor_identify(G, &from);
        status = sli_reached_numbers(G, &kept, &from, started, NULL);
    }
    sli_free(&G->allocator, room.base);
    return status;
}

/* Was a null pivot skipped in a component that is coupled to held rows? Where the couplings are as
 * small as rounding, the null vector of A passes for one of the rest, too. */
static int sli_held_is_loose(const sl_pins *P) {
    const sl_factor *G = P->G;
    sl_int k;
    for (k = 0; k < P->n_couplings && G->null.count > 0; k++) {
        if (sli_is_skipped(G, G->null.last[P->coupling_column[k]])) {
            return 1;
        }
    }
    return 0;
}

/* Lists the entries of A that couple held rows to others: the other row, the number of the held
 * one, the value. */
static void sli_held_couplings(sl_pins *P, const sli_holding *h, sl_int *rows, sl_int *held,
                               double *values) {
    const sl_symbolic *S = P->F->S;
    const sl_off total = S->scatter_begin[S->n_supers];
    sl_int k, j, s = 0;
    sl_off m;
    for (m = 0, P->n_couplings = 0; m < total; m++) {
        sl_int tile;
        if (h->values[m] == P->values[m]) {
            continue;
        }
        while (m >= S->scatter_begin[s + 1]) {
            s++;
        }
        tile = sli_last_tile(S, s);
        sli_scatter_map_pivots(S, s, m, &tile, &k, &j);
        if (((h->marks[k] ^ h->marks[j]) & 1) != 0) {
            const sl_int at = P->n_couplings++, out = (h->marks[k] & 1) != 0 ? k : j;
            rows[at] = S->perm[out == k ? j : k];
            held[at] = sli_lower_bound(h->columns, h->count, out);
            values[at] = P->values[m];
        }
    }
}

/* Takes the held rows into P: their columns and pins, the entries of A that couple them to others,
 * and the reach of these. Refuses what the capacitance matrix has to hold. */
static sl_status sli_held_take(sl_pins *P, const sli_holding *h) {
    const sl_symbolic *S = P->F->S;
    sli_block b = {NULL, 0, 0}, kept = {NULL, 0, 0};
    sl_status status = SL_OK;
    sl_int *rows = NULL, *held = NULL, k;
    double *values = NULL;
    sli_set set;
    SLI_LAYOUT(&b, &P->allocator, status) {
        rows = SLI_TAKE(&b, sl_int, h->couplings);
        held = SLI_TAKE(&b, sl_int, h->couplings);
        values = SLI_TAKE(&b, double, h->couplings);
        set = sli_set_of(S, rows == NULL ? S->perm : rows, (sl_int)h->couplings);
        sli_set_layout_seeds(&set, &b);
    }
    P->n_couplings = 0;
    if (status == SL_OK) {
        sli_held_couplings(P, h, rows, held, values);
        status = sli_set_sort(S, &set, NULL);
    }
    if (status == SL_OK) {
        sli_set_measure(S, &set, &P->held_reach);
    }
    SLI_LAYOUT(&kept, &P->allocator, status) {
        P->held = SLI_TAKE(&kept, sl_int, h->count);
        P->held_pin = SLI_TAKE(&kept, sl_int, h->count);
        P->coupling_from = SLI_TAKE(&kept, sl_int, h->couplings);
        P->coupling_column = SLI_TAKE(&kept, sl_int, h->couplings);
        P->couplings = SLI_TAKE(&kept, double, h->couplings);
        sli_set_layout_reach(&set, &kept, &P->held_reach);
    }
    P->held = (sl_int *)(void *)kept.base;
    if (status == SL_OK) {
        P->n_held = h->count;
        memcpy(P->held, h->columns, (size_t)h->count * sizeof(sl_int));
        memcpy(P->held_pin, h->index, (size_t)h->count * sizeof(sl_int));
        memcpy(P->coupling_from, held, (size_t)h->couplings * sizeof(sl_int));
        memcpy(P->couplings, values, (size_t)h->couplings * sizeof(double));
        sli_set_fill(S, &set, &P->held_reach, &P->coupling_to);
        for (k = 0; k < P->n_couplings; k++) {
            P->coupling_column[k] = S->iperm[rows[k]];
        }
        if (sli_held_is_loose(P)) {
            status = sli_refuse(SL_ERR_PIVOT, "the pins do not hold a component whose couplings "
                                              "are as small as rounding");
        }
    }
    sli_free(&P->allocator, b.base);
    return status;
}

#endif
