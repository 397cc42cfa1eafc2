/* factor_query.h: read access to a factor: its arrays, null rows, determinant, L as a matrix */
#ifndef SLI_FACTOR_FACTOR_QUERY_H
#define SLI_FACTOR_FACTOR_QUERY_H

#include "factor.h"
#include "pivot_check.h"
#include "storage_type.h"

SL_API sl_status sl_factor_logdet(const sl_factor *F, double *log_abs_det, double *sign) {
    double sum = 0.0;
    sl_int k;
    sl_status status = sli_argument(F == NULL             ? "F is NULL"
                                    : log_abs_det == NULL ? "log_abs_det is NULL"
                                    : sign == NULL        ? "sign is NULL"
                                                          : NULL);
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status != SL_OK) {
        return status;
    }
    for (k = 0; k < F->S->n; k++) {
        if (F->E != NULL && F->S->pairs[k] == SLI_PAIR_FIRST) {
            double values[2];
            sli_pair_eigenvalues(F, k++, values);
            sum += log(fabs(values[0])) + log(fabs(values[1]));
        } else {
            sum += sli_is_skipped(F, k) ? 0.0 : log(fabs(F->D[k]));
        }
    }
    *log_abs_det = sum;
    *sign = F->stats.factor.negative % 2 == 0 ? 1.0 : -1.0;
    return SL_OK;
}

SL_API sl_status sl_factor_pivot_rows(const sl_factor *F, sl_pivot_kind kind, sl_int *rows,
                                      double *shifts, sl_int capacity, sl_int *count) {
    const sl_int *pivots;
    sl_int m;
    sl_status status = sli_argument(F == NULL                      ? "F is NULL"
                                    : count == NULL                ? "count is NULL"
                                    : capacity < 0                 ? "capacity is below 0"
                                    : capacity > 0 && rows == NULL ? "rows is NULL"
                                    : kind != SL_PIVOT_NULL && kind != SL_PIVOT_REGULARIZED
                                        ? "kind is not a value of sl_pivot_kind"
                                        : NULL);
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status != SL_OK) {
        return status;
    }
    pivots = kind == SL_PIVOT_NULL ? F->null.pivots : F->rule.regularized;
    *count = kind == SL_PIVOT_NULL ? F->null.count : F->stats.factor.regularized;
    for (m = 0; m < sli_min(capacity, *count); m++) {
        rows[m] = F->S->perm[pivots[m]];
        if (shifts != NULL) {
            shifts[m] = kind == SL_PIVOT_NULL ? 0.0 : F->rule.shifts[pivots[m]];
        }
    }
    return SL_OK;
}

/* Counts the entries of L: the unit diagonal and the nonzeros of the panels. Writes them to M
 * unless M is NULL. */
SLI_HOT static sl_off sli_factor_entries(const sl_factor *F, sl_matrix *M) {
    const sl_symbolic *S = F->S;
    sl_int s, j, r;
    sl_off count = 0;
    for (s = 0; s < S->n_supers; s++) {
        const sl_int first = S->super_first[s], width = S->steps[s].width,
                     height = width + S->steps[s].below;
        for (j = 0; j < width; j++) {
            for (r = j; r < height; r++) {
                const double l =
                    r == j ? 1.0 : sli_entry(F, S->panel_begin[s] + sli_panel_at(width, r, j));
                if (l != 0.0) {
                    if (M != NULL) {
                        M->i[count] = r < width ? first + r : S->rows[S->rows_begin[s] + r - width];
                        M->x[count] = l;
                    }
                    count++;
                }
            }
            if (M != NULL) {
                M->p[first + j + 1] = (sl_int)count;
            }
        }
    }
    return count;
}

SL_API sl_status sl_factor_lower(sl_matrix **out, const sl_factor *F, const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sl_off count;
    sl_status status;
    status = sli_begin(out);
    status = status == SL_OK
                 ? sli_argument(F == NULL ? "F is NULL" : sli_options_wrong(opt, SLI_READS_NOTHING))
                 : status;
    status = status == SL_OK ? sli_factor_has_numbers(F) : status;
    if (status != SL_OK) {
        return status;
    }
    count = sli_factor_entries(F, NULL);
    if (count > INT32_MAX) {                                   /* untested: 2^31 entries */
        return sli_refuse(SL_ERR_TOO_LARGE,                    /* untested: the same */
                          "L has more than 2^31 - 1 entries"); /* untested: the same */
    }
    status = sli_matrix_new(out, F->S->n, F->S->n, (sl_int)count, 1, &a);
    if (status == SL_OK) {
        (*out)->p[0] = 0;
        (void)sli_factor_entries(F, *out);
    }
    return status;
}

SL_API sl_factor_arrays sl_factor_view(const sl_factor *F) {
    sl_factor_arrays v;
    SLI_CLEAR(v);
    if (F != NULL) {
        v.info = F->stats.factor;
        v.symbolic = F->S;
        v.L = F->type->storage == SL_STORAGE_DOUBLE ? (const double *)F->values : NULL;
        v.L_float = sli_is_float(F) ? (const float *)F->values : NULL;
        v.D = F->D;
        v.E = F->E;
    }
    return v;
}

#endif
