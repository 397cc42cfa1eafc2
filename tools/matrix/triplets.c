/* triplets.c: a growing list of matrix entries (i, j, value), and its conversion to a matrix */
#include "triplets.h"

#include <stdlib.h>
#include <string.h>

bool triplets_reserve(triplets *t, size_t capacity) {
    if (capacity <= t->capacity) {
        return true;
    }
    if (capacity > SIZE_MAX / sizeof(double)) {
        return false;
    }
    /* an array that has moved is kept even if a later realloc fails, so that nothing is lost */
    sl_int *i = (sl_int *)realloc(t->i, capacity * sizeof *i);
    t->i = i != NULL ? i : t->i;
    sl_int *j = (sl_int *)realloc(t->j, capacity * sizeof *j);
    t->j = j != NULL ? j : t->j;
    double *x = (double *)realloc(t->x, capacity * sizeof *x);
    t->x = x != NULL ? x : t->x;
    if (i == NULL || j == NULL || x == NULL) {
        return false;
    }
    t->capacity = capacity;
    return true;
}

bool triplets_add(triplets *t, sl_int i, sl_int j, double x) {
    if (t->count == t->capacity && !triplets_reserve(t, t->capacity < 64 ? 64 : 2 * t->capacity)) {
        return false;
    }
    t->i[t->count] = i;
    t->j[t->count] = j;
    t->x[t->count] = x;
    t->count++;
    return true;
}

sl_status triplets_finish(sl_matrix **out, sl_int n_rows, sl_int n_cols, triplets *t,
                          bool with_values) {
    /* an empty list has no arrays, but NULL values would mean a pattern */
    sl_status status = triplets_reserve(t, 1) ? SL_OK : SL_ERR_MEMORY;
    *out = NULL;
    if (status == SL_OK) {
        status = sl_matrix_from_triplets(out, n_rows, n_cols, (sl_off)t->count, t->i, t->j,
                                         with_values ? t->x : NULL, NULL, NULL);
    }
    triplets_free(t);
    return status;
}

void triplets_free(triplets *t) {
    free(t->i);
    free(t->j);
    free(t->x);
    memset(t, 0, sizeof *t);
}
