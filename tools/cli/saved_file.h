/* saved_file.h: opens a file of sparse-local save */
#ifndef TOOLS_SAVED_FILE_H
#define TOOLS_SAVED_FILE_H

#include "sparse_local.h"

/** Maps the objects of a file; loads them where it cannot be mapped, because it has the other byte
 *  order or the system maps no files. Ends the program with a message if that fails, or if the file
 *  has no factor.
 *
 *  set  [out]  release with sl_saved_set_free.
 */
void saved_file_open(sl_saved_set *set, const char *path, unsigned checks);

#endif
