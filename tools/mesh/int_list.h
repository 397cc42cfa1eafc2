/* int_list.h: a growing list of numbers of vertices or faces */
#ifndef TOOLS_INT_LIST_H
#define TOOLS_INT_LIST_H

#include <stdbool.h>
#include <stdlib.h>

#include "../sparse_local.h"

/** All zero is an empty list; free(at) releases it. */
typedef struct int_list {
    sl_int *at;
    size_t count;
    size_t room;
} int_list;

/** Appends one, doubling the room when full; false: out of memory, the list is as it was. */
static inline bool int_list_add(int_list *list, sl_int value) {
    if (list->count == list->room) {
        size_t wanted = list->room < 64 ? 64 : 2 * list->room;
        sl_int *larger = (sl_int *)realloc(list->at, wanted * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        list->at = larger;
        list->room = wanted;
    }
    list->at[list->count++] = value;
    return true;
}

#endif
