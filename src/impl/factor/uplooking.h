/* uplooking.h: up-looking factorization: row by row, each a sparse triangular solve */
#ifndef SLI_FACTOR_UPLOOKING_H
#define SLI_FACTOR_UPLOOKING_H

#include "multifrontal.h"
#include "../base/sort.h"

/* Links supernode s into the list of its next row below, if it has one. */
static void sli_row_link(sl_factor *F, sl_int s) {
    const sl_off at = F->S->rows_begin[s] + F->row.position[s];
    if (at < F->S->rows_begin[s + 1]) {
        const sl_int k = F->S->rows[at];
        F->row.next[s] = F->row.head[k];
        F->row.head[k] = s;
    }
}

/* Computes row k: first from the supernodes linked to it, ascending so that descendants come first,
 * then from its own. */
static void sli_row_solve(sl_factor *F, sl_int k, sli_row *row) {
    const sl_symbolic *S = F->S;
    const sl_int own = S->super_of[k];
    uint64_t *list = F->row.list + S->n_supers; /* filled from its end: in a star it is ascending */
    sl_int s, m, count = 0;
    for (s = F->row.head[k]; s != -1; s = F->row.next[s]) {
        *--list = sli_keyed(s, 0);
        count++;
    }
    sli_sort(list, count, F->row.list_scratch);
    for (m = 0; m < count; m++) {
        s = sli_key(list[m]);
        F->kernels->row(row, &S->steps[s], S->steps[s].width + F->row.position[s],
                        S->rows + S->rows_begin[s]);
        F->row.position[s]++;
        sli_row_link(F, s);
    }
    if (k > S->super_first[own]) {
        F->kernels->row(row, &S->steps[own], k - S->super_first[own], NULL);
    }
}

/* Factors the whole matrix, which has the analyzed pattern. [LDL05], [Davis06] 4.7 */
static sl_status sli_uplooking(sl_factor *F, const sli_source *from, sli_failure *failure) {
    const sl_symbolic *S = F->S;
    sl_status status = SL_OK;
    sli_row row;
    sl_int k;
    row.L = (double *)F->values;
    row.D = F->D;
    row.x = F->row.x;
    row.scratch = F->work.buffer;
    for (k = 0; k < S->n; k++) {
        F->row.head[k] = -1;
        F->row.x[k] = 0.0;
    }
    for (k = 0; k < S->n && status == SL_OK; k++) {
        const sl_int s = S->super_of[k], q = k - S->super_first[s];
        double *panel = row.L + S->steps[s].panel, *diagonal, pivot;
        if (q == 0) {
            const sl_off size = S->panel_begin[s + 1] - S->panel_begin[s];
            SLI_ZERO(panel, size);
            status = sli_double_panel_load(F, from, s, panel, failure);
            if (status != SL_OK) {
                break;
            }
        }
        diagonal = panel + sli_panel_at(S->steps[s].width, q, q);
        row.pivot = *diagonal;
        row.magnitude = fabs(row.pivot);
        *diagonal = 0.0;
        sli_row_solve(F, k, &row);
        pivot =
            F->rule.replaces ? sli_pivot_by_rule(&F->rule, k, row.pivot, row.magnitude) : row.pivot;
        F->D[k] = pivot;
        status = sli_check_pivot(F, s, k, pivot, row.magnitude, failure);
        if (q == S->steps[s].width - 1) {
            F->row.position[s] = 0;
            sli_row_link(F, s);
        }
    }
    return status;
}

#endif
