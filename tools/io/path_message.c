/* path_message.c: error texts that begin with the path of a file */
#include "path_message.h"

#include <stdio.h>
#include <string.h>

size_t path_message_begin(char *message, size_t size, const char *path, size_t rest) {
    static const char cut[] = "...";
    const size_t length = strlen(path), others = rest + strlen(cut);
    const size_t room = size > others ? size - others : 0;
    if (length <= room) {
        (void)snprintf(message, size, "%s", path);
    } else {
        (void)snprintf(message, size, "%s%s", cut, path + length - room);
    }
    return strlen(message);
}
