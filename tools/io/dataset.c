/* dataset.c: lists the files of a folder of optional test data (meshes, matrices) */
#define _POSIX_C_SOURCE 200809L
#include "dataset.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static char *joined(const char *folder, const char *name) {
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = (char *)malloc(size);
    if (path != NULL) {
        (void)snprintf(path, size, "%s/%s", folder, name);
    }
    return path;
}

static bool is_file(const char *path) {
    struct stat about;
    return stat(path, &about) == 0 && S_ISREG(about.st_mode);
}

/* Takes ownership of path, also on error. Skips what is not a regular file. */
static bool append(dataset *d, char *path) {
    if (path != NULL && !is_file(path)) {
        free(path);
        return true;
    }
    char **paths = path != NULL ? (char **)realloc(d->paths, (d->count + 1) * sizeof *paths) : NULL;
    if (paths == NULL) {
        free(path);
        return false;
    }
    d->paths = paths;
    d->paths[d->count++] = path;
    return true;
}

static int by_bytes(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static bool list_folder(dataset *out, const char *folder) {
    DIR *dir = opendir(folder);
    if (dir == NULL) {
        return false;
    }
    bool ok = true;
    for (struct dirent *entry = readdir(dir); entry != NULL && ok; entry = readdir(dir)) {
        ok = entry->d_name[0] == '.' || append(out, joined(folder, entry->d_name));
    }
    (void)closedir(dir);
    if (!ok) {
        dataset_free(out);
    } else if (out->count > 0) {
        qsort(out->paths, out->count, sizeof *out->paths, by_bytes);
    }
    return ok;
}

bool dataset_list(dataset *out, const char *root, const char *name) {
    out->count = 0;
    out->paths = NULL;
    const char *top = root != NULL && root[0] != '\0' ? root : getenv("SL_DATA");
    if (top == NULL || top[0] == '\0') {
        return false;
    }
    char *folder = joined(top, name != NULL ? name : ".");
    bool ok = folder != NULL && list_folder(out, folder);
    free(folder);
    return ok;
}

void dataset_free(dataset *d) {
    for (size_t k = 0; k < d->count; k++) {
        free(d->paths[k]);
    }
    free(d->paths);
    d->count = 0;
    d->paths = NULL;
}

const char *dataset_basename(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}
