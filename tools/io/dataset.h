/* dataset.h: lists the files of a folder, for programs that run over real meshes and matrices where there are any */
#ifndef TOOLS_DATASET_H
#define TOOLS_DATASET_H

#include <stdbool.h>
#include <stddef.h>

typedef struct dataset {
    size_t count;
    char **paths; /* count: folder/name, ascending by bytes */
} dataset;

/** Lists root/name (name NULL: root itself), hidden files and folders left out.
 *
 *  root  [in]   a folder; NULL or "": the environment variable SL_DATA, if it is set.
 *  name  [in]   "meshes" or "matrices", say; may be NULL.
 *  out   [out]  release with dataset_free; empty on error.
 *  Returns  true; false: no such folder (which is no error of the caller's: the data are optional), out of memory.
 */
bool dataset_list(dataset *out, const char *root, const char *name);

/** Releases the list and makes it empty. */
void dataset_free(dataset *d);

/** The name of a file without its folders: what follows the last slash. */
const char *dataset_basename(const char *path);

#endif
