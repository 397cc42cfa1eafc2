/* triplets.h: a growing list of matrix entries, and the matrix made of it */
#ifndef TOOLS_TRIPLETS_H
#define TOOLS_TRIPLETS_H

#include <stdbool.h>
#include <stddef.h>

#include "../sparse_local.h"

/** Entries (i[k], j[k]) = x[k]; all zero is an empty list. */
typedef struct triplets {
    size_t count;
    size_t room;
    sl_int *i;
    sl_int *j;
    double *x;
} triplets;

/** Makes room for this many entries in all, if there is not yet; false: out of memory, the list as before. */
bool triplets_reserve(triplets *t, size_t room);

/** Adds an entry, growing when full; false: out of memory. */
bool triplets_add(triplets *t, sl_int i, sl_int j, double x);

/** Makes the matrix (duplicates summed) and empties the list, also on error; with_values false: a pattern. */
sl_status triplets_finish(sl_matrix **out, sl_int n_rows, sl_int n_cols, triplets *t,
                          bool with_values);

/** Releases the arrays and makes it empty. */
void triplets_free(triplets *t);

#endif
