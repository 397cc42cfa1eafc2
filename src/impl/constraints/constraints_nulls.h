/* constraints_nulls.h: null vectors under pins: their products with the pins, and what remains free
 * */
#ifndef SLI_CONSTRAINTS_NULLS_H
#define SLI_CONSTRAINTS_NULLS_H

#include "constraints_types.h"

/* The tree of a column. */
static sli_tree_range sli_tree_of(const sl_symbolic *S, sl_int column) {
    sli_tree_range tree;
    sl_int s = S->super_of[column];
    while (S->super_parent[s] != -1) {
        s = S->super_parent[s];
    }
    tree.first = S->super_first[S->first_descendant[s]];
    tree.root = S->super_first[s + 1] - 1;
    return tree;
}

/* Is null pivot k, whose null vector is not in g, a row of zeros? tree: its own. */
static int sli_null_is_zero_row(const sl_factor *F, const sli_tree_range *tree, sl_int k) {
    sl_int m = sli_lower_bound(F->null.pivots, F->null.count, tree->first);
    int has_known = F->null.vectors > 1 || tree->first == tree->root;
    for (; m < F->null.count && F->null.pivots[m] <= tree->root && !has_known; m++) {
        has_known =
            sli_null_column(F, F->null.pivots[m]) != -1; /* then its component is the only one */
    }
    return has_known && F->rule.kinds[k] == SLI_PIVOT_NULL;
}

/* The rows first .. last-1 of an equality, which are those in one tree. */
typedef struct sli_pin_part {
    const sli_pin *pin;
    sl_int first, last;
    sli_tree_range tree;
} sli_pin_part;

/* z' c for the rows of a part. Returns 0 if the null vector is not known. */
static int sli_pin_null(const sl_factor *F, const sli_pin_part *part, sl_int null, double *sum) {
    const sl_int column = sli_null_column(F, null), *iperm = F->S->iperm;
    const double *g = F->null.g + (size_t)sli_max(column, 0) * (size_t)F->S->n;
    sl_int i;
    *sum = 0.0;
    for (i = part->first; i < part->last; i++) {
        const sl_int k = iperm[part->pin->rows[i]];
        *sum += part->pin->values[i] * (column != -1 ? g[k] / g[null] : k == null ? 1.0 : 0.0);
    }
    return column != -1 || sli_null_is_zero_row(F, &part->tree, null);
}

/* Visits the null pivots of an equality's trees. `fills`: stores them. Sets *row where a null
 * vector is not known. */
SLI_HOT static sl_status sli_pin_visit_nulls(const sl_factor *F, sli_pin *pin, int fills,
                                             sl_int *row) {
    const sl_int *iperm = F->S->iperm;
    sli_pin_part p;
    pin->n_nulls = 0;
    p.pin = pin;
    for (p.first = 0; p.first < pin->count; p.first = p.last) {
        sl_int m;
        p.tree = sli_tree_of(F->S, iperm[pin->rows[p.first]]);
        for (p.last = p.first + 1;
             p.last < pin->count && iperm[pin->rows[p.last]] <= p.tree.root;) {
            p.last++;
        }
        m = sli_lower_bound(F->null.pivots, F->null.count, p.tree.first);
        for (; m < F->null.count && F->null.pivots[m] <= p.tree.root; m++, pin->n_nulls++) {
            double z;
            if (!sli_pin_null(F, &p, F->null.pivots[m], &z)) {
                *row = pin->rows[p.first];
                return sli_refuse(SL_ERR_UNSUPPORTED, sli_nulls_unknown);
            }
            if (fills) {
                pin->nulls[pin->n_nulls] = m;
                pin->z[pin->n_nulls] = z;
            }
        }
    }
    return SL_OK;
}

/* Finds the null pivots of an equality and the entries of W. */
static sl_status sli_pin_find_nulls(const sl_constraints *P, sli_pin *pin, sl_int *row) {
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sli_free(&P->allocator, pin->nulls);
    pin->nulls = NULL;
    pin->n_nulls = 0;
    if (P->F->null.count > 0) {
        status = sli_pin_visit_nulls(P->F, pin, 0, row);
    }
    if (status == SL_OK && pin->n_nulls > 0) {
        SLI_LAYOUT(&b, &P->allocator, status) {
            pin->nulls = SLI_TAKE(&b, sl_int, pin->n_nulls);
            pin->z = SLI_TAKE(&b, double, pin->n_nulls);
        }
        status = status == SL_OK ? sli_pin_visit_nulls(P->F, pin, 1, row) : status;
    }
    pin->n_nulls = status == SL_OK ? pin->n_nulls : 0;
    pin->nulls = (sl_int *)(void *)b.base;
    return status;
}

/* Counts the null pivots of an equality that comes or goes. */
static void sli_constraints_count_nulls(sl_constraints *P, const sli_pin *pin, int comes) {
    sl_int k;
    for (k = 0; k < pin->n_nulls; k++) {
        sl_int *uses = &P->uses[pin->nulls[k]];
        P->n_used += comes ? *uses == 0 : -(*uses == 1);
        *uses += comes ? 1 : -1;
    }
}

/* The row of W of one equality times that of another. */
static double sli_pin_nulls_dot(const sli_pin *a, const sli_pin *b) {
    double sum = 0.0;
    sl_int i = 0, j = 0;
    while (i < a->n_nulls && j < b->n_nulls) {
        if (a->nulls[i] == b->nulls[j]) {
            sum += a->z[i++] * b->z[j++];
        } else if (a->nulls[i] < b->nulls[j]) {
            i++;
        } else {
            j++;
        }
    }
    return sum;
}

/* The null vectors of components with pins, for solves. */
typedef struct sli_constraints_nulls {
    sl_int count;
    sl_int *numbers;        /* count: among the null pivots of F */
    sl_int *place;          /* by null pivot of F: here; undefined where there are no pins */
    unsigned char *is_free; /* count: left out */
    double *W;              /* count x pins: first an orthogonal basis, then K^-1 W */
    double *S;              /* count x count: the factor L D L' of W' K^-1 W */
    double *s;              /* count x lanes: Z' b, then v */
    double *defects;        /* count x lanes: Z' (b + C f) */
    double *sizes;          /* count x lanes: of the terms of defects */
} sli_constraints_nulls;

static void sli_constraints_nulls_layout(sli_constraints_nulls *w, sli_block *b,
                                         const sl_constraints *P) {
    const uint64_t count = (uint64_t)P->n_used;
    w->count = P->n_used;
    w->numbers = SLI_TAKE(b, sl_int, count);
    w->place = SLI_TAKE(b, sl_int, count > 0 ? (uint64_t)P->F->null.count : 0);
    w->is_free = SLI_TAKE(b, unsigned char, count);
    w->W = SLI_TAKE(b, double, count *(uint64_t)P->n_pins);
    w->S = SLI_TAKE(b, double, count *count);
    w->s = SLI_TAKE(b, double, SLI_TILE *count);
    w->defects = SLI_TAKE(b, double, SLI_TILE *count);
    w->sizes = SLI_TAKE(b, double, SLI_TILE *count);
}

/* Fills W, and s with the size of what its columns are computed from. A single null vector is not
 * combined from several, and exact. */
static void sli_constraints_nulls_load(const sli_constraints_nulls *w, const sl_constraints *P) {
    sl_int p, k;
    SLI_ZERO(w->W, (size_t)w->count * (size_t)P->n_pins);
    SLI_ZERO(w->s, w->count);
    for (p = 0; p < P->n_pins; p++) {
        const sli_pin *pin = P->pins[p];
        const double square = sli_dot(pin->values, pin->values, pin->count);
        for (k = 0; k < pin->n_nulls; k++) {
            const sl_int at = w->place[pin->nulls[k]];
            w->W[(size_t)at * (size_t)P->n_pins + (size_t)p] = pin->z[k];
            w->s[at] += P->F->null.vectors > 1 ? square : 0.0;
        }
    }
}

/* Marks the columns of W that depend on those before them. */
static void sli_constraints_nulls_mark(const sli_constraints_nulls *w, const sl_constraints *P) {
    const size_t count = (size_t)P->n_pins;
    sl_int a, b, p;
    for (a = 0; a < w->count; a++) {
        double *x = w->W + (size_t)a * count;
        double after = sqrt(sli_dot(x, x, P->n_pins));
        const double least = SLI_NULL_DEPENDENT * fmax(after, sqrt(w->s[a]));
        int pass;
        for (pass = 0; pass < 2 && after > 0.0; pass++) {
            for (b = 0; b < a; b++) {
                const double *q = w->W + (size_t)b * count;
                const double c = w->is_free[b] ? 0.0 : sli_dot(q, x, P->n_pins);
                for (p = 0; c != 0.0 && p < P->n_pins; p++) {
                    x[p] -= c * q[p];
                }
            }
            after = sqrt(sli_dot(x, x, P->n_pins));
            after = after > least ? after : 0.0;
        }
        w->is_free[a] = after == 0.0;
        for (p = 0; p < P->n_pins; p++) {
            x[p] = after == 0.0 ? 0.0 : x[p] / after;
        }
    }
}

/* Lists the null vectors of components with pins and marks those that stay free. */
static void sli_constraints_nulls_begin(const sli_constraints_nulls *w, const sl_constraints *P) {
    sl_int m, at = 0;
    for (m = 0; at < w->count; m++) {
        if (P->uses[m] > 0) {
            w->place[m] = at;
            w->numbers[at++] = m;
        }
    }
    sli_constraints_nulls_load(w, P);
    sli_constraints_nulls_mark(w, P);
}

#endif
