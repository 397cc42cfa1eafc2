/* matrix_read.h: what the matrix format readers share: a file, its size and its entries so far */
#ifndef TOOLS_MATRIX_READ_H
#define TOOLS_MATRIX_READ_H

#include "input.h"
#include "tools/matrix/triplets.h"

/** A matrix being read. */
typedef struct matrix_read {
    input *in;
    int64_t n_rows;
    int64_t n_cols;
    triplets entries;
    bool pattern; /* the format has no values; those in entries are meaningless */
} matrix_read;

/** Sets the size of the matrix. Returns false and sets the message if the size is out of range or
 *  too large for the length of the file (input_allows). */
bool matrix_read_set_size(matrix_read *r, int64_t n_rows, int64_t n_cols);

/* One reader per format. Each reads all of r->in into r; false: r->in has the message. */

/** Rutherford-Boeing. */
bool matrix_read_rb(matrix_read *r);

/** Lines "i j value" without a header. */
bool matrix_read_csparse(matrix_read *r);

/** Lines "i j value" with the header of CHOLMOD's test matrices. */
bool matrix_read_cholmod(matrix_read *r);

#endif
