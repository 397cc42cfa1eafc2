/* dataset.h: lists the files of a folder of optional test data (meshes, matrices) */
#ifndef TOOLS_DATASET_H
#define TOOLS_DATASET_H

#include <stdbool.h>
#include <stddef.h>

/** A sorted list of paths. */
typedef struct dataset {
    size_t count;
    char **paths; /* count: folder/name, ascending by bytes */
} dataset;

/** Lists the regular files in root/name, or in root if name is NULL. Hidden files and subfolders
 *  are left out.
 *
 *  out   [out]  release with dataset_free; empty on error.
 *  root  [in]   a folder; NULL or "": the value of the environment variable SL_DATA.
 *  name  [in]   a subfolder, for example "meshes" or "matrices"; may be NULL.
 *  Returns  true; false: no such folder, which callers treat as "no data" because the data are
 *           optional; out of memory.
 */
bool dataset_list(dataset *out, const char *root, const char *name);

/** Releases the list and makes it empty. */
void dataset_free(dataset *d);

/** Returns the part of a path after its last slash. */
const char *dataset_basename(const char *path);

#endif
