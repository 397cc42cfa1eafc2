/* output_file.h: a file that takes the place of an old one only once it is complete */
#ifndef SLI_IO_OUTPUT_FILE_H
#define SLI_IO_OUTPUT_FILE_H

#include "../base/alloc.h"
#include "../base/status.h"

#define SLI_TEMPORARY_NAMES 100 /* tried beside a file: path.tmp00 to path.tmp99 */
#define SLI_TEMPORARY_SUFFIX 16 /* bytes of ".tmp" and any int, as compilers count them */

/* Files without a name, and how they get one: of Linux, where the headers show the constant. */
#if defined(SLI_FSYNC) && defined(__linux__) && defined(__O_TMPFILE)
#define SLI_UNNAMED_FILES 1
#define SLI_FILE_NAME_MAX 32 /* of /proc/self/fd/ and any int */
#define SLI_HERE (-100)      /* AT_FDCWD */
#define SLI_FOLLOW 0x400     /* AT_SYMLINK_FOLLOW */
#endif

typedef struct sli_output {
    FILE *file;
    const char *path;
    char *temporary; /* name of the file that is renamed to path; NULL: path itself is written */
    int is_unnamed;  /* the file gets the temporary name only when it is complete */
} sli_output;

#if defined(SLI_POSIX)
/* Whether a file can take this name by rename: nothing has the name yet, or a regular file that may
 * be written. Not a device, pipe or symbolic link, whose name would be lost. *exists: whether it is
 * such a file. */
static int sli_is_replaceable(const char *path, int *exists) {
    struct stat found;
    FILE *probe;
    *exists = 0;
    if (sli_is_link(path) || strncmp(path, "/dev/", 5) == 0) {
        return 0;
    }
    if (stat(path, &found) != 0) {
        return errno == ENOENT;
    }
    if (!S_ISREG(found.st_mode)) {
        return 0;
    }
    *exists = 1;
    probe = fopen(path, "ab");
    if (probe != NULL) {
        fclose(probe);
    }
    return probe != NULL;
}

/* Gives the new file the permissions of the old one. Returns 0 if that fails or the new one has
 * another owner or group, or is on another device: the old one is a mount point then. */
static int sli_take_attributes(const char *name, const char *old_name) {
    struct stat made, old;
    int can = stat(name, &made) == 0 && stat(old_name, &old) == 0; /* untested: one vanished */
    can = can && made.st_dev == old.st_dev;                        /* untested: a mount point */
    can = can && made.st_uid == old.st_uid && made.st_gid == old.st_gid; /* untested: a group */
    return can && ((made.st_mode & 0777) == (old.st_mode & 0777) ||
                   chmod(name, old.st_mode & 0777) == 0); /* untested: an owner may */
}
#else
/* The same with the means of C: what has no length, such as a device, is written in place. */
static int sli_is_replaceable(const char *path, int *exists) {
    FILE *probe;
    long length = 0;
    *exists = 0; /* no attributes to keep */
#if defined(SLI_WINDOWS)
    if (sli_is_link(path)) {
        return 0;
    }
#endif
    probe = fopen(path, "r+b");
    if (probe != NULL) {
        length = fseek(probe, 0, SEEK_END) == 0 ? ftell(probe) : 0;
        fclose(probe);
        return length != 0; /* -1: longer than a long can say */
    }
    probe = fopen(path, "rb"); /* can be read and not written: not to be replaced */
    if (probe != NULL) {
        fclose(probe);
    }
    return probe == NULL;
}
#endif

/* Creates a file that did not exist. The mode "x" is of C11; the C libraries of POSIX systems had
 * it before. Elsewhere another program may create the file between the two calls. */
static FILE *sli_create_new(const char *name) {
#if defined(SLI_POSIX)
    return fopen(name, "wbx");
#else
    FILE *old = fopen(name, "rb");
    if (old != NULL) {
        fclose(old);
        return NULL;
    }
    return fopen(name, "wb");
#endif
}

#if defined(SLI_UNNAMED_FILES)
/* Opens a file without a name in the folder of o->path, which vanishes if the process is killed.
 * o->temporary is used to name the folder. Returns 0, without a file, where the file system has no
 * such files or this one could not take the place of path. */
static int sli_create_unnamed(sli_output *o, int exists) {
    const char *slash = strrchr(o->path, '/');
    const size_t length = slash == NULL ? 0 : (size_t)(slash - o->path) + 1;
    char name[SLI_FILE_NAME_MAX];
    int file;
    memcpy(o->temporary, o->path, length);
    memcpy(o->temporary + length, ".", 2);
    file = open(o->temporary, __O_TMPFILE | O_WRONLY, 0666);
    if (file < 0) {
        return 0;
    }
    snprintf(name, sizeof name, "/proc/self/fd/%d", file);
    exists = exists ? sli_take_attributes(name, o->path) : sli_is_link(name); /* is /proc there? */
    o->file = exists ? sli_fdopen(file, "wb") : NULL;
    if (o->file == NULL) {
        close(file);
    }
    return o->file != NULL;
}

/* Gives an unnamed file the first temporary name that is free. Returns whether it has one. */
static int sli_name_unnamed(sli_output *o) {
    const size_t length = strlen(o->path);
    char name[SLI_FILE_NAME_MAX];
    int k, is_named = 0;
    snprintf(name, sizeof name, "/proc/self/fd/%d", sli_fileno(o->file));
    memcpy(o->temporary, o->path, length);
    for (k = 0; k < SLI_TEMPORARY_NAMES && !is_named; k++) {
        snprintf(o->temporary + length, SLI_TEMPORARY_SUFFIX, ".tmp%02d", k);
        is_named = sli_linkat(SLI_HERE, name, SLI_HERE, o->temporary, SLI_FOLLOW) == 0;
    }
    return is_named;
}
#endif

/* Creates the file o->temporary. Returns 0, without a file, if it could not take the place of path,
 * so that path itself must be written. Returns 1 with the file, or with o->file NULL if there is no
 * space for it or no name. */
static int sli_create_beside(sli_output *o, int exists) {
    const size_t length = strlen(o->path);
    int k;
#if defined(SLI_UNNAMED_FILES)
    o->is_unnamed = sli_create_unnamed(o, exists);
#endif
    memcpy(o->temporary, o->path, length);
    for (k = 0; k < SLI_TEMPORARY_NAMES && o->file == NULL; k++) {
        snprintf(o->temporary + length, SLI_TEMPORARY_SUFFIX, ".tmp%02d", k);
        o->file = sli_create_new(o->temporary);
    }
    if (o->file == NULL) {
        return errno != EACCES && errno != EPERM && errno != EROFS && errno != ENAMETOOLONG;
    }
#if defined(SLI_POSIX)
    if (exists && !o->is_unnamed &&
        !sli_take_attributes(o->temporary, o->path)) { /* untested: a mount point */
        fclose(o->file);
        o->file = NULL;
        remove(o->temporary);
        return 0;
    }
#else
    (void)exists;
#endif
    return 1;
}

/* Opens o->file for what path shall contain. On error o needs no closing. */
SLI_COLD static sl_status sli_output_open(sli_output *o, const char *path, const sl_allocator *a) {
    int exists, could_replace;
    errno = 0;
    o->path = path;
    o->temporary = NULL;
    o->file = NULL;
    o->is_unnamed = 0;
    if (sli_is_replaceable(path, &exists)) {
        o->temporary = (char *)sli_alloc(a, strlen(path) + SLI_TEMPORARY_SUFFIX);
        if (o->temporary == NULL) {
            return sli_no_memory();
        }
        could_replace = sli_create_beside(o, exists);
        if (o->file != NULL) {
            return SL_OK;
        }
        sli_free(a, o->temporary);
        o->temporary = NULL;
        if (could_replace) {
            return sli_file_fails("no file can be created beside it");
        }
    }
    o->file = fopen(path, "wb");
    return o->file != NULL ? SL_OK : sli_file_fails("the file cannot be opened");
}

/* Gives the temporary file the name of the old one, which it replaces in one step. Returns whether
 * that succeeded; *is_only_copy: it did not, and the old file is gone. */
static int sli_replace(const sli_output *o, int *is_only_copy) {
    *is_only_copy = 0;
#if defined(SLI_WINDOWS)
    if (MoveFileExA(o->temporary, o->path, 1) != 0) { /* 1: replaces an existing file */
        return 1;
    }
#endif
    if (rename(o->temporary, o->path) == 0) {
        return 1;
    }
#if !defined(SLI_POSIX) /* rename may refuse an existing name */
    *is_only_copy = remove(o->path) == 0;
    if (*is_only_copy && rename(o->temporary, o->path) == 0) {
        return 1;
    }
#endif
    return 0;
}

/* Closes the file and, if it is complete, gives it its name. Returns whether both succeeded. */
static sl_status sli_output_close(sli_output *o, int complete, const sl_allocator *a) {
    int ok = fflush(o->file) == 0 && complete, has_name = 1, is_only_copy = 0;
    sl_status status;
#if defined(SLI_UNNAMED_FILES)
    has_name = !o->is_unnamed || (ok && sli_name_unnamed(o));
    ok = ok && has_name;
#endif
    ok = fclose(o->file) == 0 && ok; /* untested: it has been flushed */
    status = ok ? SL_OK : sli_file_fails("the file cannot be written");
    if (o->temporary != NULL) {
        if (ok && !sli_replace(o, &is_only_copy)) {
            ok = 0;
            status = sli_file_fails("the old file cannot be replaced");
        }
        if (!ok && has_name && !is_only_copy) { /* untested: without POSIX */
            remove(o->temporary);
        }
        sli_free(a, o->temporary);
    }
    return status;
}

#endif
