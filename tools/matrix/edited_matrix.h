/* edited_matrix.h: a symmetric matrix whose entries change one by one, also outside its pattern */
#ifndef TOOLS_EDITED_MATRIX_H
#define TOOLS_EDITED_MATRIX_H

#include <stdbool.h>

#include "triplets.h"

/** The lower triangle. Entries of a pattern, which was analyzed, and more that came later. */
typedef struct edited_matrix {
    sl_int n;
    sl_int *p; /* n + 1 */
    sl_int *i; /* ascending in each column */
    double *x;
    sl_int *row_p;  /* n + 1: the entries left of the diagonal, by rows */
    sl_int *row_j;  /* their columns */
    sl_int *row_at; /* their positions in x */
    triplets more;  /* entries (i, j), i > j, outside of the pattern; few, each once */
} edited_matrix;

/** Changes of entries: a_ij and a_ji by delta, as sl_factor_change_entries takes them. */
typedef triplets entry_changes;

/** Copies a matrix.
 *
 *  out  [out]  release with edited_matrix_free; all zero on error.
 *  A    [in]   lower triangle, rows ascending without duplicates; with values.
 *  Returns  true; false: an entry above the diagonal, rows that do not ascend, out of memory.
 *  Example  tests/tools/test_edited_matrix.c
 */
bool edited_matrix_create(edited_matrix *out, const sl_csc *A);

/** Releases the arrays and sets m to all zero. */
void edited_matrix_free(edited_matrix *m);

/** The pattern and its values, without the entries that came later. */
sl_csc edited_matrix_view(const edited_matrix *m);

/** The entry (i, j) = (j, i); 0 where there is none. */
double edited_matrix_get(const edited_matrix *m, sl_int i, sl_int j);

/** Applies changes; those outside of the pattern are added to m->more. False: out of memory, and
 *  m is as before but for entries of the value 0. */
bool edited_matrix_apply(edited_matrix *m, const entry_changes *changes);

/** Appends the nonzero entries (v, j), j != v, of row v to a list. False: out of memory. */
bool edited_matrix_row(const edited_matrix *m, sl_int v, triplets *row);

/** The matrix with all its entries, without zeros off the diagonal.
 *
 *  out   [out]  lower triangle, release with sl_matrix_free; NULL on error.
 *  keep  [in]   n: in rows and columns with 1 zeros are kept; NULL: nowhere.
 *  Returns  true; false: out of memory.
 */
bool edited_matrix_whole(sl_matrix **out, const edited_matrix *m, const unsigned char *keep);

#endif
