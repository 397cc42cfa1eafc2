/* int_list.h: a growing array of vertex or face numbers */
#ifndef TOOLS_INT_LIST_H
#define TOOLS_INT_LIST_H

#include <stdbool.h>
#include <stdlib.h>

#include "sparse_local.h"

/** All zero is an empty list; release with free(at). */
typedef struct int_list {
    sl_int *at;
    size_t count;
    size_t capacity; /* elements at `at` */
} int_list;

/** Appends a value. The capacity doubles when the list is full.
 *
 *  Returns  true; false: out of memory, the list is unchanged.
 */
static inline bool int_list_add(int_list *list, sl_int value) {
    if (list->count == list->capacity) {
        size_t wanted = list->capacity < 64 ? 64 : 2 * list->capacity;
        sl_int *larger = (sl_int *)realloc(list->at, wanted * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        list->at = larger;
        list->capacity = wanted;
    }
    list->at[list->count++] = value;
    return true;
}

#endif
