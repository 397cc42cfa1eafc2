/* path_message.h: error texts that begin with the path of a file */
#ifndef TOOLS_PATH_MESSAGE_H
#define TOOLS_PATH_MESSAGE_H

#include <stddef.h>

/** Begins a message with a path. If the path leaves less than `rest` bytes for the text that
 *  follows, only its end is written, after "...".
 *
 *  message  [out]  size bytes, size > 0.
 *  rest     [in]   bytes of the text that follows, with its zero byte.
 *  Returns  the number of characters written, less than size.
 */
size_t path_message_begin(char *message, size_t size, const char *path, size_t rest);

#endif
