/* matrix_file.h: reads matrices from Matrix Market, Rutherford-Boeing and plain triplet files, also gzipped */
#ifndef TOOLS_MATRIX_FILE_H
#define TOOLS_MATRIX_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "../sparse_local.h"

/** Reads a matrix; the ending of the name tells the format, each plain or with .gz after it.
 *
 *  .mtx          Matrix Market, as sl_matrix_parse reads it.
 *  .rb           Rutherford-Boeing, assembled; real, integer or pattern; symmetric (the lower triangle comes out),
 *                unsymmetric or rectangular (the entries as they stand).
 *  _csparse.txt  lines "i j value", 0-based, no header: a square matrix, as large as its largest index says.
 *  _cholmod.txt  a line "rows columns entries [stype]", then lines "i j value", 0-based; stype -1 gives the lower
 *                triangle, 1 the upper one (entries of the other are mirrored), 0 or none the entries as they stand.
 *
 *  Duplicates are summed, explicit zeros kept. A pattern without values gets the value 1 everywhere.
 *
 *  out           [out]  the matrix, release with sl_matrix_free; NULL on error.
 *  message       [out]  on error what is wrong, with file and line; "" otherwise; may be NULL.
 *  message_size  [in]   bytes at message.
 *  Returns  true; false: no such file, another format, malformed, truncated, complex, skew-symmetric, hermitian or
 *           elemental, more rows or columns than the file has bytes (.mtx aside), more than 2 GiB of content, out of
 *           memory.
 *  Cost     O(file size), and for .mtx O(rows + columns).
 *  Example  tests/test_matrix_file.c
 */
bool matrix_file_read(sl_matrix **out, const char *path, char *message, size_t message_size);

#endif
