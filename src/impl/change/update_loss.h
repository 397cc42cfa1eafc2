/* update_loss.h: what the rows of a definite matrix lose by changes, relative to what is left */
#ifndef SLI_CHANGE_UPDATE_LOSS_H
#define SLI_CHANGE_UPDATE_LOSS_H

#include "../factor/factor.h"

/* Each pass leaves an error of epsilon times the numbers that a pivot was computed from. It remains
 * where a_kk falls later, by one pass or by many. So each row has the sum of these numbers: one row
 * may rise and fall beside others whose entries are larger. */

/* Where that sum exceeds a pivot by less, no more than two digits are lost. */
#define SLI_LOSS_SMALL 256.0

/* Makes the sums, before the first change of a factor: no row is visited before a change reaches
 * it. A loaded factor has its drift: so much each row may have lost. */
static sl_status sli_loss_begin(sl_factor *F) {
    const sl_symbolic *S = F->S;
    sli_history *h = &F->history;
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    if (h->updates > 0 && h->base > 0.0) {
        return SL_OK;
    }
    if (h->loss == NULL) {
        SLI_LAYOUT(&b, &F->allocator, status) {
            h->loss = SLI_TAKE(&b, double, S->n);
            h->known = SLI_TAKE(&b, unsigned char, S->n_supers);
        }
        if (status != SL_OK) {
            h->loss = NULL;
            return status;
        }
        h->bytes = b.used;
    }
    SLI_ZERO(h->known, S->n_supers);
    h->base = fmax(1.0, h->drift / DBL_EPSILON);
    return SL_OK;
}

/* The rows of supernode s begin with what they have lost before the first change of them. */
SLI_NOINLINE static void sli_loss_open(sl_factor *F, sl_int s) {
    sl_int k;
    if (F->history.known[s]) {
        return;
    }
    for (k = F->S->super_first[s]; k < F->S->super_first[s + 1]; k++) {
        F->history.loss[k] = fabs(F->D[k]) * F->history.base;
    }
    F->history.known[s] = 1;
}

/* Returns a_kk, as L D L' has it. *magnitude := the sum of the magnitudes |a_kk| + sum
 * |l_kj d_j l_kj| that pivot k was computed from, at most. O(descendants). */
SLI_COLD static double sli_update_entry(const sl_factor *F, sl_int k, double *magnitude) {
    const sl_symbolic *S = F->S;
    const sl_int own = S->super_of[k];
    double sum = 0.0, entry = F->D[k];
    sl_int d, j;
    for (d = own; d >= S->first_descendant[own];) {
        const sli_step *step = &S->steps[d];
        const sl_int *rows = S->rows + S->rows_begin[d];
        const sl_int at = d == own ? 0 : sli_lower_bound(rows, step->below, k);
        const sl_int r = d == own ? k - step->column : step->width + at;
        if (d != own && at == step->below) { /* no descendant has a row there */
            d = S->first_descendant[d] - 1;
            continue;
        }
        for (j = 0; j < sli_min(r, step->width) && (d == own || rows[at] == k); j++) {
            const double l = sli_entry(F, step->panel + sli_panel_at(step->width, r, j));
            sum += fabs(l * F->D[step->column + j] * l);
            entry += l * F->D[step->column + j] * l;
        }
        d--;
    }
    *magnitude = 2.0 * sum + fabs(F->D[k]);
    return entry;
}

static double sli_update_magnitude(const sl_factor *F, sl_int k) {
    double magnitude;
    (void)sli_update_entry(F, k, &magnitude);
    return magnitude;
}

#endif
