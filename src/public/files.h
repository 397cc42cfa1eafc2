/* files.h: matrices in Matrix Market files, and with 64-bit indices */
#ifndef SL_PUBLIC_FILES_H
#define SL_PUBLIC_FILES_H

#include "csc.h"

/** Reads a Matrix Market file: coordinate; real, integer or pattern; general, symmetric or
 *  hermitian, which is symmetric here. A UTF-8 byte order mark is skipped; an exponent may begin
 *  with D, as in Fortran.
 *
 *  A symmetric file gives the lower triangle; entries above the diagonal are mirrored into it. A
 *  general file gives its entries as they are. Duplicates are summed. A pattern file gives a matrix
 *  with x = NULL.
 *
 *  out    [out]  the matrix.
 *  path   [in]   name of the file.
 *  opt    [in]   allocator.
 *  stats  [out]  error.
 *  Returns  SL_OK; SL_ERR_IO: no such file, or malformed at error.line, also by a line of 65536
 *           bytes or more that is not a comment; SL_ERR_UNSUPPORTED: complex, array or
 *           skew-symmetric, which error.what names; SL_ERR_MALFORMED: a symmetric file with an
 *           entry (error.row, error.column) in both triangles; SL_ERR_TOO_LARGE: also for more
 *           than 2^20 rows or columns, if over 16 for each entry; SL_ERR_MEMORY. NaN and
 *           infinity are accepted.
 *  Cost     O(file size + n_rows + n_cols). Memory grows with the entries read, so that a device
 *           without an end does not fill it.
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_read(sl_matrix **out, const char *path,
                                               const sl_options *opt, sl_stats *stats);

/** sl_matrix_read from memory: length bytes of text, which need no terminating zero. */
SL_API SL_WARN_UNUSED sl_status sl_matrix_parse(sl_matrix **out, const char *text, size_t length,
                                                const sl_options *opt, sl_stats *stats);

/** View of a sparse matrix with 64-bit indices, otherwise as sl_csc: the arrays of MATLAB, Julia,
 *  SuiteSparse's long interface and SciPy's int64. */
typedef struct sl_csc64 {
    int64_t n_rows, n_cols;
    const int64_t *p; /* n_cols + 1 */
    const int64_t *i; /* p[n_cols] */
    const double *x;  /* p[n_cols]; NULL: pattern only */
} sl_csc64;

/** Copies a matrix with 64-bit indices into one with 32-bit indices, entry by entry.
 *
 *  Convert once for each pattern. Entries keep their order, so new values need no conversion: set x
 *  of the view (sl_matrix_view) to the caller's values. With A->x = NULL only the indices are
 *  copied.
 *
 *  out    [out]  the matrix.
 *  opt    [in]   allocator.
 *  stats  [out]  error.column: positions that are not ascending; with error.row, if it fits its
 *                type, an index out of range.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_MALFORMED; SL_ERR_TOO_LARGE: more than 2^31 - 8 rows or
 *           columns, or more than 2^31 - 1 entries; SL_ERR_MEMORY.
 *  Cost     O(n_cols + nnz).
 *  Threads  any number with different outputs.
 *  Example  tests/core/test_csc64.c
 */
SL_API SL_WARN_UNUSED sl_status sl_matrix_from_csc64(sl_matrix **out, const sl_csc64 *A,
                                                     const sl_options *opt, sl_stats *stats);

#endif
