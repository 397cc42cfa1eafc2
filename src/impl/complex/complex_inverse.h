/* complex_inverse.h: entries of the inverse of complex matrices */
#ifndef SLI_COMPLEX_COMPLEX_INVERSE_H
#define SLI_COMPLEX_COMPLEX_INVERSE_H

#include "../../public/complex_inverse.h"
#include "../inverse/block.h"
#include "../inverse/entries_calls.h"
#include "complex_rows.h"

SL_API sl_status sl_complex_inverse_block(const sl_factor *F, double *Z, size_t ldz,
                                          const sl_int *rows, sl_int n_rows, const sl_int *columns,
                                          sl_int n_columns, sl_work *W, sl_stats *stats) {
    sli_complex_sets c;
    sl_status status;
    sl_int k;
    sli_stats_clear_error(stats);
    status = sli_argument(F == NULL                           ? "F is NULL"
                          : ldz > SIZE_MAX / 2                ? "ldz is too large"
                          : rows == NULL && n_rows != 0       ? "rows is NULL"
                          : columns == NULL && n_columns != 0 ? "columns is NULL"
                                                              : NULL);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    c = sli_complex_sets_of(rows, n_rows, columns, n_columns, 1);
    status = sli_complex_sets_create(&c, F->S->n, &F->allocator, stats);
    if (status == SL_OK) {
        for (k = 0; k < n_columns;
             k++) { /* the column of the real part has both parts of entries */
            c.second.real[k] = 2 * columns[k];
        }
        status = sl_inverse_block(F, Z, 2 * ldz, c.first.real, 2 * n_rows, c.second.real, n_columns,
                                  W, stats);
        sli_free(&F->allocator, c.memory);
    }
    return sli_report(stats, status);
}

SL_API sl_status sl_complex_inverse_pairs(const sl_factor *F, double *out, const sl_int *rows,
                                          const sl_int *columns, sl_int count, sl_work *W,
                                          sl_stats *stats) {
    sli_complex_sets c;
    sl_status status;
    sl_int k;
    sli_stats_clear_error(stats);
    status = sli_argument(F == NULL                       ? "F is NULL"
                          : rows == NULL && count != 0    ? "rows is NULL"
                          : columns == NULL && count != 0 ? "columns is NULL"
                                                          : NULL);
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    c = sli_complex_sets_of(rows, count, columns, count, 1);
    status = sli_complex_sets_create(&c, F->S->n, &F->allocator, stats);
    if (status == SL_OK) {
        for (k = 0; k < count;
             k++) { /* both parts of an entry are in the column of the real part */
            c.second.real[2 * (size_t)k + 1] = c.second.real[2 * (size_t)k];
        }
        status = sl_inverse_pairs(F, out, c.first.real, c.second.real, 2 * count, W, stats);
        sli_free(&F->allocator, c.memory);
    }
    return sli_report(stats, status);
}

#endif
