/* matrix_read.h: what the readers of the matrix formats share: a file that becomes triplets that become a matrix */
#ifndef TOOLS_MATRIX_READ_H
#define TOOLS_MATRIX_READ_H

#include "input.h"
#include "triplets.h"

typedef struct matrix_read {
    input *in;
    int64_t n_rows;
    int64_t n_cols;
    triplets entries;
    bool pattern; /* the values are not meant */
} matrix_read;

/** Are these sizes that a file of this length can be believed to have? Sets the message if not. */
bool matrix_read_check_size(matrix_read *r, int64_t n_rows, int64_t n_cols);

/** Reads a Rutherford-Boeing file. */
bool matrix_read_rb(matrix_read *r);

/** Read lines "i j value", without a header and with CHOLMOD's. */
bool matrix_read_csparse(matrix_read *r);
bool matrix_read_cholmod(matrix_read *r);

#endif
