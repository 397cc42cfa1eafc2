/* constraints_balance.h: null vectors in solves with pins: balance of forces, and motions */
#ifndef SLI_CONSTRAINTS_BALANCE_H
#define SLI_CONSTRAINTS_BALANCE_H

#include "constraints_capacitance.h"

/* Factors W' K^-1 W for the columns of W that are not left out. */
static sl_status sli_constraints_nulls_factor(const sli_constraints_nulls *w,
                                              const sl_constraints *P) {
    const size_t count = (size_t)P->n_pins, ld = (size_t)w->count;
    sl_int a, b, p, k;
    sli_constraints_nulls_begin(w, P);
    sli_constraints_nulls_load(w, P);
    memset(w->S, 0, ld * ld * sizeof(double));
    for (a = 0; a < w->count; a++) {
        sli_constraints_apply(P, w->W + (size_t)a * count, 1);
    }
    for (p = 0; p < P->n_pins; p++) {
        const sli_pin *pin = P->pins[p];
        for (k = 0; k < pin->n_nulls; k++) {
            const size_t row = (size_t)w->place[pin->nulls[k]];
            for (b = 0; b <= (sl_int)row; b++) {
                w->S[row * ld + (size_t)b] += pin->z[k] * w->W[(size_t)b * count + (size_t)p];
            }
        }
    }
    for (a = 0; a < w->count; a++) {
        double *row = w->S + (size_t)a * ld;
        for (b = 0; b < a; b++) {
            row[b] = w->is_free[a] || w->is_free[b] ? 0.0 : row[b];
        }
        row[a] = w->is_free[a] ? P->sign : row[a];
        sli_capacitance_factor(w->S, ld, a);
        if (!(row[a] * P->sign > 0.0)) {
            return sli_refuse(SL_ERR_INACCURATE,
                              "pins that nearly depend on each other, by null vectors of F");
        }
    }
    return SL_OK;
}

/* s := Z' b before the forward sweep. Returns 0 if b is inconsistent in a component without pins
 * that has several null vectors. norms: of b. */
static int sli_constraints_defects(const sl_constraints *P, const sli_constraints_nulls *w,
                                   const sli_packed *b, const double *norms) {
    const sl_factor *F = P->F;
    const sli_reach *R = b->R;
    const sl_int lanes = b->lanes;
    sl_int first = 0, s, k, r;
    SLI_ZERO(w->s, (size_t)w->count * (size_t)lanes);
    for (s = 0; s < R->count && (w->count > 0 || F->null.checks); s++) {
        sli_null_dot dot;
        if (R->steps[s].up != -1) {
            continue;
        }
        dot.next = sli_null_first(F, R, s);
        while (F->null.calls->next_dot(F, b, first, s, &dot)) {
            if (P->uses[dot.number] > 0) {
                SLI_COPY(w->s + (ptrdiff_t)w->place[dot.number] * lanes, dot.sums, lanes);
                continue;
            }
            for (r = 0; r < lanes && F->null.checks; r++) {
                if (fabs(dot.sums[r]) > F->null.consistency * norms[r]) {
                    return 0;
                }
            }
        }
        first = s + 1;
    }
    for (k = 0; k < w->count; k++) {
        const sl_int null = F->null.pivots[w->numbers[k]], at = sli_reach_index_of(R, null);
        if (at != -1 && sli_null_column(F, null) == -1) { /* a row of zeros */
            SLI_COPY(w->s + (ptrdiff_t)k * lanes, b->v + (ptrdiff_t)at * lanes, lanes);
        }
    }
    return 1;
}

/* y := 0 at null pivots after the forward sweep, but for those that weights will center. Returns 0
 * if b is inconsistent in a component without pins. norms: of b. */
static int sli_constraints_clear(const sl_constraints *P, const sli_reach *R, double *y,
                                 sl_int lanes, const double *norms) {
    const sl_factor *F = P->F;
    sl_int m, r;
    for (m = 0; m < F->null.count; m++) {
        const sl_int at = sli_reach_index_of(R, F->null.pivots[m]);
        double *row = y + (ptrdiff_t)at * lanes;
        const int is_known = F->null.vectors > 1 && sli_null_column(F, F->null.pivots[m]) != -1;
        for (r = 0; r < lanes && at != -1 && F->null.checks && !is_known; r++) {
            if (P->uses[m] == 0 && fabs(row[r]) > F->null.consistency * norms[r]) {
                return 0;
            }
        }
        if (at != -1 && (P->uses[m] > 0 || !F->null.is_centered)) {
            SLI_ZERO(row, lanes);
        }
    }
    return 1;
}

/* s := v, where W' f = -Z' b; f := that of this v. Returns 0 if b is out of balance with a motion
 * that the pins leave. norms: of b. */
static int sli_constraints_balance(const sl_constraints *P, const sli_constraints_nulls *w,
                                   double *f, sl_int lanes, const double *norms) {
    const size_t count = (size_t)P->n_pins;
    sl_int p, k, r;
    for (k = 0; k < w->count * lanes; k++) {
        w->defects[k] = w->s[k];
        w->sizes[k] = norms[k % lanes];
    }
    for (p = 0; p < P->n_pins; p++) {
        for (k = 0; k < P->pins[p]->n_nulls; k++) {
            double *s = w->s + (ptrdiff_t)w->place[P->pins[p]->nulls[k]] * lanes;
            for (r = 0; r < lanes; r++) {
                s[r] += P->pins[p]->z[k] * f[(ptrdiff_t)p * lanes + r];
            }
        }
    }
    for (k = 0; k < w->count * lanes; k++) {
        w->s[k] = w->is_free[k / lanes] ? 0.0 : w->s[k];
    }
    sli_capacitance_solve(w->S, (size_t)w->count, w->count, w->s, lanes);
    for (k = 0; k < w->count * lanes; k++) {
        for (p = 0; p < P->n_pins && w->s[k] != 0.0; p++) {
            f[p * lanes + k % lanes] -= w->W[(size_t)(k / lanes) * count + (size_t)p] * w->s[k];
        }
    }
    for (p = 0; p < P->n_pins; p++) {
        for (k = 0; k < P->pins[p]->n_nulls * lanes; k++) {
            const sl_int at = w->place[P->pins[p]->nulls[k / lanes]] * lanes + k % lanes;
            const double force = P->pins[p]->z[k / lanes] * f[p * lanes + k % lanes];
            w->defects[at] += force;
            w->sizes[at] += fabs(force);
        }
    }
    for (k = 0; k < w->count * lanes && P->F->null.consistency >= 0.0; k++) {
        if (w->is_free[k / lanes] && fabs(w->defects[k]) > P->F->null.consistency * w->sizes[k]) {
            return 0;
        }
    }
    return 1;
}

/* x += Z v */
static void sli_constraints_shift(const sl_constraints *P, const sli_query *q,
                                  const sli_constraints_nulls *w, double *x, sl_int lanes) {
    const sl_factor *F = P->F;
    const sli_reach *R = &q->backward;
    sl_int first = 0, root, s, m, k, r;
    for (root = 0; root < R->count && w->count > 0; root++) {
        sl_int last;
        if (R->steps[root].up != -1) {
            continue;
        }
        last = sli_tree_range_of(F->S, &R->steps[root]).root;
        for (m = sli_null_first(F, R, root); m < F->null.count && F->null.pivots[m] <= last; m++) {
            const sl_int null = F->null.pivots[m], column = sli_null_column(F, null);
            const double *g = F->null.g + (size_t)sli_max(column, 0) * (size_t)F->S->n;
            const double *v = P->uses[m] > 0 ? w->s + (ptrdiff_t)w->place[m] * lanes : NULL;
            for (s = first; s <= root && v != NULL; s++) {
                const sli_step *step = &R->steps[s];
                double *row = x + (ptrdiff_t)step->base * lanes;
                for (k = step->column; k < step->column + sli_step_columns(step); k++) {
                    const double z = column != -1 ? g[k] / g[null] : k == null ? 1.0 : 0.0;
                    for (r = 0; r < lanes; r++) {
                        *row++ += z * v[r];
                    }
                }
            }
        }
        first = root + 1;
    }
}

#endif
