/* hermitian.h: complex Hermitian matrices as real symmetric ones of twice the size */
#ifndef SLI_COMPLEX_HERMITIAN_H
#define SLI_COMPLEX_HERMITIAN_H

#include "../../public/complex.h"
#include "../matrix/csc.h"

/* Checks the view, and that the diagonal is real: an imaginary part would not be symmetric. */
static sl_status sli_hermitian_check(const sl_hermitian *H, sl_stats *stats) {
    sl_csc pattern = {0, 0, NULL, NULL, NULL};
    sl_status status;
    sl_int j, p;
    sli_stats_clear_error(stats);
    status = sli_argument(H == NULL                       ? "H is NULL"
                          : H->x == NULL && H->im != NULL ? "H.x is NULL, but H.im is not"
                                                          : NULL);
    if (status != SL_OK) {
        return status;
    }
    pattern.n_rows = pattern.n_cols = H->n;
    pattern.p = H->p;
    pattern.i = H->i;
    status = H->n > SLI_ROWS_MAX / 2 ? sli_refuse(SL_ERR_TOO_LARGE, "H has more than 2^30 - 4 rows")
                                     : sl_csc_check(&pattern, stats);
    for (j = 0; status == SL_OK && H->x != NULL && j < H->n; j++) {
        for (p = H->p[j]; p < H->p[j + 1]; p++) {
            const double im = H->im != NULL ? H->im[p] : H->x[2 * (size_t)p + 1];
            if (H->i[p] == j && !(im == 0.0)) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, j, j, im,
                                   "a diagonal entry of H has an imaginary part");
            }
        }
    }
    return status;
}

/* The triangles that H stores. */
typedef struct sli_hermitian_sides {
    int lower, upper;
} sli_hermitian_sides;

static sli_hermitian_sides sli_hermitian_sides_of(const sl_hermitian *H) {
    sli_hermitian_sides sides = {0, 0};
    sl_int j, p;
    for (j = 0; j < H->n; j++) {
        for (p = H->p[j]; p < H->p[j + 1]; p++) {
            sides.lower |= H->i[p] > j;
            sides.upper |= H->i[p] < j;
        }
    }
    sides.lower |= !sides.upper;
    return sides;
}

/* Entries of the real matrix: 4 for each complex entry, and on the diagonal 2 and a zero in each
 * triangle. The zeros make the two columns of a block follow each other in one supernode. */
static sl_off sli_hermitian_entries(const sl_hermitian *H, sli_hermitian_sides sides) {
    sl_off count = 0;
    sl_int j, p;
    for (j = 0; j < H->n; j++) {
        for (p = H->p[j]; p < H->p[j + 1]; p++) {
            count += H->i[p] == j ? 2 + sides.lower + sides.upper : 4;
        }
    }
    return count;
}

/* One column of a block: rows, and the values of an entry a + bi. second: the column of the
 * imaginary part, [-b a]. */
typedef struct sli_hermitian_column {
    sl_int row, count; /* rows `row` and, if count is 2, row + 1 */
    double x[2];
} sli_hermitian_column;

static sli_hermitian_column sli_hermitian_entry(const sl_hermitian *H, sli_hermitian_sides sides,
                                                sl_int p, sl_int j, int second) {
    const double a = H->x == NULL ? 0.0 : H->im != NULL ? H->x[p] : H->x[2 * (size_t)p];
    const double b = H->x == NULL ? 0.0 : H->im != NULL ? H->im[p] : H->x[2 * (size_t)p + 1];
    sli_hermitian_column out;
    if (H->i[p] == j) {
        const int whole = second ? sides.upper : sides.lower;
        out.row = 2 * j + (second && !whole);
        out.count = 1 + whole;
        out.x[0] = second && whole ? 0.0 : a;
        out.x[1] = second && whole ? a : 0.0;
    } else {
        out.row = 2 * H->i[p];
        out.count = 2;
        out.x[0] = second ? -b : a;
        out.x[1] = second ? a : b;
    }
    return out;
}

/* Writes positions, rows and values of the real matrix. */
static void sli_hermitian_fill(const sl_hermitian *H, sl_matrix *M) {
    const sli_hermitian_sides sides = sli_hermitian_sides_of(H);
    sl_int j, p, k, second, at = 0;
    M->p[0] = 0;
    for (j = 0; j < H->n; j++) {
        for (second = 0; second < 2; second++) {
            for (p = H->p[j]; p < H->p[j + 1]; p++) {
                const sli_hermitian_column e = sli_hermitian_entry(H, sides, p, j, second);
                for (k = 0; k < e.count; k++, at++) {
                    M->i[at] = e.row + k;
                    if (M->x != NULL) {
                        M->x[at] = e.x[k];
                    }
                }
            }
            M->p[2 * j + second + 1] = at;
        }
    }
}

SL_API sl_status sl_matrix_from_hermitian(sl_matrix **out, const sl_hermitian *H,
                                          const sl_options *opt, sl_stats *stats) {
    const sl_allocator a = sli_allocator(opt);
    sl_matrix *M;
    sl_status status;
    sl_off count;
    sli_stats_clear_error(stats);
    status = sli_begin(out);
    status = status == SL_OK ? sli_argument(sli_options_wrong(opt, SLI_READS_NOTHING)) : status;
    status = status == SL_OK ? sli_hermitian_check(H, stats) : status;
    if (status != SL_OK) {
        return sli_report(stats, status);
    }
    count = sli_hermitian_entries(H, sli_hermitian_sides_of(H));
    if (count > INT32_MAX) { /* untested: 2^29 entries */
        status = sli_refuse(SL_ERR_TOO_LARGE, "M would have 2^31 entries"); /* untested: the same */
        return sli_report(stats, status);                                   /* untested: the same */
    }
    status = sli_matrix_new(&M, 2 * H->n, 2 * H->n, (sl_int)count, H->x != NULL, &a);
    if (status == SL_OK) {
        sli_hermitian_fill(H, M);
        *out = M;
    }
    return sli_report(stats, status);
}

#endif
