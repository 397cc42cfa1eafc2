/* matrix_file.h: reads Matrix Market, Rutherford-Boeing and triplet files, plain or gzipped */
#ifndef TOOLS_MATRIX_FILE_H
#define TOOLS_MATRIX_FILE_H

#include <stdbool.h>
#include <stddef.h>

#include "sparse_local.h"

/** Reads a matrix. The end of the file name, optionally followed by .gz, selects the format.
 *
 *  .mtx          Matrix Market, as sl_matrix_parse reads it.
 *  .rb           Rutherford-Boeing, assembled; real, integer or pattern; symmetric (gives the lower
 *                triangle), unsymmetric or rectangular (gives all entries).
 *  _csparse.txt  lines "i j value", 0-based, without a header: a square matrix whose size follows
 *                from its largest index.
 *  _cholmod.txt  a line "rows columns entries [stype]", then lines "i j value", 0-based. stype -1
 *                gives the lower triangle, 1 the upper one (entries of the other triangle are
 *                mirrored); 0 or none gives all entries.
 *
 *  Duplicates are summed and explicit zeros kept. A pattern without values gets the value 1
 *  everywhere.
 *
 *  out           [out]  the matrix, release with sl_matrix_free; NULL on error.
 *  message       [out]  the reason on error, with file and line; "" otherwise; may be NULL.
 *  message_size  [in]   bytes at message.
 *  Returns  true; false: no such file, unknown format, malformed or truncated file; a complex,
 *           skew-symmetric or elemental matrix, or an array; a symmetric .mtx file of both
 *           triangles; more rows or columns than its length allows (input_allows); more than
 *           2 GiB of content; out of memory.
 *  Cost     O(file size), for .mtx plus O(rows + columns).
 *  Example  tests/tools/test_matrix_file.c
 */
bool matrix_file_read(sl_matrix **out, const char *path, char *message, size_t message_size);

#endif
