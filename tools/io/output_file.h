/* output_file.h: writes files that are replaced as a whole or not at all; checks standard output */
#ifndef TOOLS_OUTPUT_FILE_H
#define TOOLS_OUTPUT_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/** Opens a file for writing. The name - is standard output (output_take_standard).
 *
 *  A regular file or a new name: the stream writes to a temporary file PATH.tmpPID-K in the same
 *  folder. output_close renames it to PATH, so that an error or a kill leaves the old file as it
 *  was. Symbolic links are followed, and the new file gets the permissions, the owner and the group
 *  of the old one. Another hard link to the old file keeps the old content.
 *
 *  Written in place: what is not a regular file (device, FIFO, socket); a symbolic link to a file
 *  that does not exist; a file of /dev/fd or /proc; a mount point; a file in a folder where no file
 *  can be created; a file whose owner or group this process cannot give to a new file. If PATH is
 *  the file that standard output or standard error writes to, the stream continues it.
 *
 *  A file still open when the program exits is discarded. Not thread-safe.
 *
 *  message  [out]  the reason on error, "PATH: cannot be written: REASON"; may be NULL.
 *  Returns  the stream, to be closed by output_close or output_discard; NULL on error.
 */
FILE *output_open(const char *path, char *message, size_t message_size);

/** Whether output_open is likely to succeed, without creating anything: the folder exists, and the
 *  file or its folder can be written.
 *
 *  message  [out]  the reason, as that of output_open.
 */
bool output_is_possible(const char *path, char *message, size_t message_size);

/** Whether two outputs would be one file, so that the later one would replace the other: a regular
 *  file, or one that does not exist yet. False for what is written in place, such as standard
 *  output. */
bool output_is_same(const char *a, const char *b);

/** Flushes the stream, checks that everything was written, and gives the file its name. The stream
 *  is closed in any case.
 *
 *  message  [out]  on error "PATH: could not be written completely: REASON"; may be NULL.
 *  Returns  true; false: the old file is as it was, unless it was written in place.
 */
bool output_close(FILE *stream, char *message, size_t message_size);

/** Prepares standard output for a file that is called -: what the program prints from now on goes
 *  to standard error, so that only the file is there. */
void output_take_standard(void);

/** Closes the stream and removes the temporary file; the old file remains. */
void output_discard(FILE *stream);

/** Prepares a program; to be called first in main. Then
 *
 *  - the program ends with status 1 and a message if standard output cannot be written completely,
 *    whichever way it exits;
 *  - a closed standard stream is never taken for a file that is opened later; output to a closed
 *    standard output is such an error;
 *  - a file beyond the limit on its size (ulimit -f) is an error of writing and not a signal;
 *  - SIGPIPE, SIGHUP, SIGINT and SIGTERM end the program as usual, without a message, but temporary
 *    files are removed first. A signal that is ignored remains ignored.
 *
 *  name  [in]  of the program, for the message; not copied.
 */
void output_begin_program(const char *name);

#endif
