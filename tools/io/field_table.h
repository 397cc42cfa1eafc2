/* field_table.h: reads tables of numbers at vertices, as the commands write them with --csv */
#ifndef TOOLS_FIELD_TABLE_H
#define TOOLS_FIELD_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "sparse_local.h"

/** Columns of numbers, one number for each of n vertices. */
typedef struct field_table {
    size_t n_fields;
    char **names;    /* n_fields: from the first line */
    double **values; /* n_fields: n each; NAN where the table has no row for the vertex */
} field_table;

/** Reads a table: a first line "vertex,NAME,..." and lines with a vertex and the numbers. Numbers
 *  may be nan or inf. Of a vertex given twice the last row counts.
 *
 *  out      [out]  release with field_table_free; empty on error.
 *  path     [in]   plain or gzipped.
 *  n        [in]   number of vertices.
 *  message  [out]  the reason on error, with file and line; "" otherwise.
 *  Returns  true; false: no such file, no such first line, a row that is malformed, incomplete or
 *           of a vertex not below n, out of memory.
 *  Cost     O(n fields + length of the file).
 *  Example  tests/tools/test_view.c
 */
bool field_table_read(field_table *out, const char *path, sl_int n, char *message,
                      size_t message_size);

/** Releases the table and makes it empty. */
void field_table_free(field_table *t);

#endif
