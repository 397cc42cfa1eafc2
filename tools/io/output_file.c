/* output_file.c: writes files that are replaced as a whole or not at all; checks standard output */
#define _XOPEN_SOURCE 700
#include "output_file.h"
#include "path_message.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct output output;
struct output {
    FILE *stream;
    char *path;      /* as the caller gave it */
    char *target;    /* path without symbolic links; NULL: written in place */
    char *temporary; /* the file that becomes the target; NULL: written in place */
    bool exists;     /* whether the temporary file exists */
    output *next;
};

/* Files being written. A signal handler walks the list at any time: a file enters it completely
 * initialized and leaves it before it is freed. */
static output *volatile open_files = NULL;
static const char *program_name = "";
static int standard_output = 1; /* where files called - go */

/* ---- memory and messages ---- */

static void output_free(output *o) {
    free(o->temporary);
    free(o->target);
    free(o->path);
    free(o);
}

static char *copy_of(const char *text, size_t room) {
    char *copy = (char *)malloc(strlen(text) + room + 1);
    return copy != NULL ? strcpy(copy, text) : NULL;
}

/* error: an errno; 0: unknown. */
static void explain(char *message, size_t size, const char *path, const char *what, int error) {
    const char *reason = error != 0 ? strerror(error) : "";
    if (message != NULL && size > 0) {
        const size_t rest = strlen(what) + strlen(reason) + sizeof ": : ";
        const size_t used = path_message_begin(message, size, path, rest);
        (void)snprintf(message + used, size - used, ": %s%s%s", what, error != 0 ? ": " : "",
                       reason);
    }
}

/* Removes a file from the list and returns it. */
static output *take(FILE *stream) {
    output *o = open_files;
    if (o != NULL && o->stream == stream) {
        open_files = o->next;
        return o;
    }
    for (; o != NULL; o = o->next) {
        output *found = o->next;
        if (found != NULL && found->stream == stream) {
            o->next = found->next;
            return found;
        }
    }
    return NULL;
}

/* ---- opening ---- */

/* Copies the folder of a path to `folder`, size bytes; false: it does not fit. */
static bool folder_of(char *folder, size_t size, const char *path) {
    const char *slash = strrchr(path, '/');
    size_t length = slash == NULL ? 1 : slash == path ? 1 : (size_t)(slash - path);
    if (length >= size) {
        return false;
    }
    memcpy(folder, slash == NULL ? "." : path, length);
    folder[length] = '\0';
    return true;
}

bool output_is_possible(const char *path, char *message, size_t message_size) {
    char folder[4096];
    struct stat file, around;
    int error = 0;
    const bool exists = stat(path, &file) == 0;
    if (strcmp(path, "-") == 0) {
        return true;
    }
    if (exists && S_ISDIR(file.st_mode)) {
        error = EISDIR;
    } else if (!exists && errno != ENOENT) {
        error = errno;
    } else if (!folder_of(folder, sizeof folder, path) || (exists && access(path, W_OK) == 0)) {
        error = 0; /* a path that is too long is left to output_open */
    } else if (stat(folder, &around) != 0) {
        error = errno;
    } else if (!S_ISDIR(around.st_mode)) {
        error = ENOTDIR;
    } else if (access(folder, W_OK | X_OK) != 0) {
        error = exists ? EACCES : errno;
    }
    if (error != 0) {
        explain(message, message_size, path, "cannot be written", error);
    }
    return error == 0;
}

/* Whether the name belongs to an open file of this process, whatever kind of file that is. */
static bool is_open_descriptor(const char *path) {
    return strncmp(path, "/dev/fd/", 8) == 0 || strncmp(path, "/proc/", 6) == 0;
}

/* The descriptor of standard output or standard error if it writes to this file; otherwise -1. */
static int standard_descriptor(const struct stat *file) {
    for (int fd = 1; fd <= 2; fd++) {
        struct stat s;
        if (fstat(fd, &s) == 0 && s.st_dev == file->st_dev && s.st_ino == file->st_ino &&
            (fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY) {
            return fd;
        }
    }
    return -1;
}

bool output_is_same(const char *a, const char *b) {
    const char *last_a = strrchr(a, '/'), *last_b = strrchr(b, '/');
    char folder_a[4096], folder_b[4096];
    struct stat of_a, of_b;
    if (strcmp(a, "-") == 0 || strcmp(b, "-") == 0) {
        return strcmp(a, b) == 0;
    }
    const bool a_exists = stat(a, &of_a) == 0, b_exists = stat(b, &of_b) == 0;
    if (a_exists || b_exists) {
        return a_exists && b_exists && S_ISREG(of_a.st_mode) && of_a.st_dev == of_b.st_dev &&
               of_a.st_ino == of_b.st_ino && standard_descriptor(&of_a) < 0;
    }
    return strcmp(last_a != NULL ? last_a + 1 : a, last_b != NULL ? last_b + 1 : b) == 0 &&
           folder_of(folder_a, sizeof folder_a, a) && folder_of(folder_b, sizeof folder_b, b) &&
           stat(folder_a, &of_a) == 0 && stat(folder_b, &of_b) == 0 && of_a.st_dev == of_b.st_dev &&
           of_a.st_ino == of_b.st_ino;
}

/* Gives the new file the owner, group and permissions of the old one; false if that is refused, or
 * if the old file is on another device than its folder: a mount point, which cannot be renamed
 * onto. */
static bool take_attributes(int fd, const struct stat *old) {
    struct stat s;
    if (fstat(fd, &s) != 0 || s.st_dev != old->st_dev) {
        return false;
    }
    if ((s.st_uid != old->st_uid || s.st_gid != old->st_gid) &&
        fchown(fd, old->st_uid, old->st_gid) != 0) {
        return false;
    }
    return (s.st_mode & 0777) == (old->st_mode & 0777) || fchmod(fd, old->st_mode & 0777) == 0;
}

/* Creates the temporary file of o->target; old is NULL if there is no target yet. Returns its
 * descriptor; -1 with errno 0: it has to be written in place; -1 with another errno: neither is
 * possible. */
static int create_temporary(output *o, const struct stat *old) {
    size_t length = strlen(o->target);
    int fd = -1;
    o->temporary = copy_of(o->target, 48);
    if (o->temporary == NULL) {
        errno = ENOMEM;
        return -1;
    }
    for (int k = 0; k < 100 && fd < 0; k++) {
        (void)snprintf(o->temporary + length, 48, ".tmp%ld-%d", (long)getpid(), k);
        fd = open(o->temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOCTTY,
                  old != NULL ? old->st_mode & 0777 : 0666);
        if (fd < 0 && errno != EEXIST) {
            break;
        }
    }
    if (fd < 0) {
        bool refused = errno == EACCES || errno == EPERM || errno == EROFS || errno == ENAMETOOLONG;
        errno = refused ? 0 : errno;
        return -1;
    }
    o->exists = true;
    if (old != NULL && !take_attributes(fd, old)) {
        (void)close(fd);
        (void)unlink(o->temporary);
        o->exists = false;
        errno = 0;
        return -1;
    }
    return fd;
}

/* Opens o->path and sets o->target unless it is written in place. Returns a descriptor, or -1 with
 * errno. */
static int open_descriptor(output *o) {
    struct stat file, link;
    if (strcmp(o->path, "-") == 0) {
        (void)fflush(stdout);
        return dup(standard_output);
    }
    bool known = stat(o->path, &file) == 0;
    int standard = known ? standard_descriptor(&file) : -1, fd = -1;
    if (standard >= 0) {
        (void)fflush(standard == 1 ? stdout : stderr);
        return dup(standard);
    }
    bool is_new = !known && errno == ENOENT && o->path[0] != '\0' && lstat(o->path, &link) != 0;
    bool is_replaced = known && S_ISREG(file.st_mode) && !is_open_descriptor(o->path);
    if (is_new || is_replaced) {
        if (is_replaced && access(o->path, W_OK) != 0) {
            return -1; /* renaming would replace a write-protected file */
        }
        o->target = is_new ? copy_of(o->path, 0) : realpath(o->path, NULL);
        if (o->target == NULL) {
            return -1;
        }
        fd = create_temporary(o, known ? &file : NULL);
        if (fd >= 0 || errno != 0) {
            return fd;
        }
        free(o->temporary);
        o->temporary = NULL;
    }
    return open(o->path, O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY, 0666);
}

static void discard_all(void) {
    while (open_files != NULL) {
        output_discard(open_files->stream);
    }
}

FILE *output_open(const char *path, char *message, size_t message_size) {
    static bool is_registered = false;
    output *o = (output *)calloc(1, sizeof *o);
    int fd = -1, error = ENOMEM;
    if (!is_registered) {
        is_registered = atexit(discard_all) == 0;
    }
    if (o != NULL && (o->path = copy_of(path, 0)) != NULL) {
        /* In the list first, so that a signal finds the temporary file as soon as it exists. */
        o->next = open_files;
        open_files = o;
        errno = 0;
        fd = open_descriptor(o);
        o->stream = fd >= 0 ? fdopen(fd, "w") : NULL;
        error = errno;
        if (o->stream != NULL) {
            return o->stream;
        }
        open_files = o->next;
        if (fd >= 0) {
            (void)close(fd);
        }
        if (o->exists) {
            (void)unlink(o->temporary);
        }
    }
    if (o != NULL) {
        output_free(o);
    }
    explain(message, message_size, path, "cannot be written", error);
    return NULL;
}

/* ---- closing ---- */

/* Flushes and closes a stream. Returns whether everything was written; error: the errno, 0 if not
 * known any more. to_disk: waits until the file is on the disk, where the file system offers it. */
static bool close_checked(FILE *stream, bool to_disk, int *error) {
    bool failed = ferror(stream) != 0;
    *error = 0;
    errno = 0;
    if (fflush(stream) != 0) {
        failed = true;
        *error = errno;
    }
    if (!failed && to_disk && fsync(fileno(stream)) != 0 && errno != EINVAL && errno != ENOSYS) {
        failed = true;
        *error = errno;
    }
    errno = 0;
    if (fclose(stream) != 0) {
        failed = true;
        *error = *error != 0 ? *error : errno;
    }
    return !failed;
}

bool output_close(FILE *stream, char *message, size_t message_size) {
    int error = 0;
    output *o = open_files;
    while (o != NULL && o->stream != stream) {
        o = o->next;
    }
    if (o == NULL) {
        return false;
    }
    bool ok = close_checked(stream, o->exists, &error);
    if (ok && o->exists && rename(o->temporary, o->target) != 0) {
        ok = false;
        error = errno;
    }
    if (!ok && o->exists) {
        (void)unlink(o->temporary);
    }
    (void)take(stream);
    if (!ok) {
        explain(message, message_size, o->path, "could not be written completely", error);
    }
    output_free(o);
    return ok;
}

void output_take_standard(void) {
    const int copy = standard_output == 1 ? dup(1) : -1;
    (void)fflush(stdout);
    if (copy >= 0 && dup2(2, 1) == 1) {
        standard_output = copy;
    }
}

void output_discard(FILE *stream) {
    output *o = take(stream);
    if (o != NULL) {
        if (o->exists) {
            (void)unlink(o->temporary);
        }
        (void)fclose(o->stream);
        output_free(o);
    }
}

/* ---- the program's own streams and signals ---- */

static void check_standard_output(void) {
    int error = 0;
    if (!close_checked(stdout, false, &error)) {
        (void)fprintf(stderr, "%s: standard output could not be written completely%s%s\n",
                      program_name, error != 0 ? ": " : "", error != 0 ? strerror(error) : "");
        (void)fflush(stderr);
        _exit(1);
    }
}

static void remove_temporary_files(int signal_number) {
    for (const output *o = open_files; o != NULL; o = o->next) {
        if (o->exists) {
            (void)unlink(o->temporary);
        }
    }
    (void)raise(signal_number); /* SA_RESETHAND: with its default action, once this returns */
}

void output_begin_program(const char *name) {
    static const int ends[] = {SIGPIPE, SIGHUP, SIGINT, SIGTERM};
    struct sigaction action, old;
    program_name = name;
    /* Each missing descriptor becomes one that cannot be written. open takes the lowest. */
    for (int fd = 0; fd <= 2; fd++) {
        if (fcntl(fd, F_GETFD) == -1 && errno == EBADF) {
            (void)open("/", O_RDONLY);
        }
    }
    memset(&action, 0, sizeof action);
    (void)sigemptyset(&action.sa_mask);
    action.sa_handler = SIG_IGN;
    (void)sigaction(SIGXFSZ, &action, NULL);
    action.sa_handler = remove_temporary_files;
    action.sa_flags = (int)SA_RESETHAND;
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
        if (sigaction(ends[k], NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
            (void)sigaction(ends[k], &action, NULL);
        }
    }
    (void)atexit(check_standard_output);
}
