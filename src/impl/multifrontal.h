/* multifrontal.h: the supernodal factorization: front by front, every child handing its update matrix to its parent */
#ifndef SLI_MULTIFRONTAL_H
#define SLI_MULTIFRONTAL_H

#include "factor_parts.h"
#include "fronts.h"

/* The front of supernode s: A, then what the children hand over, the last child first. */
static sl_status sli_front_load(sl_factor *F, const sl_csc *A, sl_int s, double *update) {
    const sl_symbolic *S = F->S;
    const sli_step *step = &S->steps[s];
    const sl_int w = step->width, tiles = sli_tiles(w + step->below);
    double *panel = F->L + step->panel;
    const sl_status status = sli_panel_load(F, A, s);
    sl_int k, c;
    if (status != SL_OK) {
        return status;
    }
    for (k = 0; k < w; k++) {
        F->magnitude[k] = fabs(panel[sli_panel_at(w, k, k)]);
    }
    memset(F->magnitude + w, 0, (size_t)(SLI_TILE * tiles - w) * sizeof(double));
    memset(update, 0, (size_t)sli_update_size(w, step->below) * sizeof(double));
    for (c = s - 1; c >= S->descendant[s]; c = S->descendant[c] - 1) {
        const sli_step *child = &S->steps[c];
        const sl_int *places = S->places + S->rows_begin[c];
        const double *from = F->waiting + S->waiting_begin[c];
        const double *magnitude =
            from + sli_update_size(child->width, child->below) + child->width % SLI_TILE;
        F->kernels->assemble(from, child->width, child->below, places, panel, w, update);
        for (k = 0; k < child->below; k++) {
            F->magnitude[places[k]] += magnitude[k];
        }
    }
    return SL_OK;
}

/* The whole factorization. A fits the analysis. [DR83], [Liu92] */
static sl_status sli_multifrontal(sl_factor *F, const sl_csc *A) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sl_int s, k;
    for (s = 0; s < S->n_supers && status == SL_OK; s++) {
        const sli_step *step = &S->steps[s];
        const sl_int w = step->width, whole = w / SLI_TILE * SLI_TILE;
        double *update = F->waiting + S->waiting_begin[s];
        status = sli_front_load(F, A, s, update);
        if (status == SL_OK) {
            F->kernels->front(F->L + step->panel, w, step->below, update, F->D + step->column,
                              F->magnitude, F->buffer);
            memcpy(update + sli_update_size(w, step->below), F->magnitude + whole,
                   (size_t)(sli_waiting_size(step) - sli_update_size(w, step->below)) *
                       sizeof(double));
        }
        for (k = 0; k < w && status == SL_OK; k++) {
            status = sli_take_pivot(F, step->column + k, F->D[step->column + k], F->magnitude[k]);
        }
    }
    return status;
}

#endif
