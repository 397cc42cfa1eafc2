/* status.h: status codes and errors as text, and where the reason of an error is kept */
#ifndef SLI_BASE_STATUS_H
#define SLI_BASE_STATUS_H

#include "../../public/stats.h"
#include "base.h"

SL_API int sl_version(void) {
    return SL_VERSION;
}

SL_API const char *sl_status_string(sl_status status) {
    switch (status) {
    case SL_OK:
        return "ok";
    case SL_ERR_ARGUMENT:
        return "invalid argument";
    case SL_ERR_MEMORY:
        return "out of memory";
    case SL_ERR_MALFORMED:
        return "malformed or unsymmetric pattern";
    case SL_ERR_PIVOT:
        return "refused pivot: singular matrix, or one that needs pivoting";
    case SL_ERR_NOT_FINITE:
        return "not a finite number";
    case SL_ERR_TOO_LARGE:
        return "too large for the integer type";
    case SL_ERR_UNSUPPORTED:
        return "not supported, or not compiled in: a pack, METIS or an instruction set";
    case SL_ERR_IO:
        return "file cannot be read, parsed or written";
    case SL_ERR_ORDERING:
        return "ordering failed";
    case SL_ERR_MISMATCH:
        return "objects that do not belong together";
    case SL_ERR_INCONSISTENT:
        return "inconsistent right-hand side of a singular system";
    case SL_ERR_INACCURATE:
        return "inaccurate: pivot growth or backward error above its limit";
    case SL_ERR_OTHER_PATTERN:
        return "not the analyzed pattern";
    case SL_ERR_STALE:
        return "numbers that are missing or out of date";
    case SL_ERR_READ_ONLY:
        return "read-only object";
    }
    return "unknown status";
}

SL_API size_t sl_stats_size(void) {
    return sizeof(sl_stats);
}

/* The last error of this thread. A function that fails for a reason of its own records it here and
 * returns its status (sli_refuse, sli_fail_at); the functions above it only pass the status on. So
 * every error has a text, through any number of functions, and also where a call has no stats. */
typedef struct sli_last_error {
    sl_status status;
    sl_error error;
} sli_last_error;

#if defined(SLI_THREAD_LOCAL)
static SLI_THREAD_LOCAL sli_last_error sli_last;
#endif

/* Reports an error in stats, which may be NULL, and as the last one; returns the status. The entry
 * at fault: -1, -1, 0 if there is none. */
SLI_NOINLINE static sl_status sli_fail_at(sl_stats *stats, sl_status status, sl_int row,
                                          sl_int column, double value, const char *what) {
    sl_error e;
    e.row = row;
    e.column = column;
    e.line = -1;
    e.value = value;
    e.what = what;
    if (stats != NULL) {
        stats->error = e;
    }
#if defined(SLI_THREAD_LOCAL)
    sli_last.status = status;
    sli_last.error = e;
#endif
    return status;
}

/* Reports an error that another thread or another stats has found; returns the status. An error
 * without a reason was recorded already, or sli_report gives it one. */
SLI_COLD static sl_status sli_fail_as(sl_stats *stats, sl_status status, const sl_error *e) {
    return e->what == NULL ? status
                           : sli_fail_at(stats, status, e->row, e->column, e->value, e->what);
}

/* Reports an error that no entry is at fault for; returns the status. */
SLI_COLD static sl_status sli_refuse(sl_status status, const char *what) {
    return sli_fail_at(NULL, status, -1, -1, 0.0, what);
}

/* Refuses a row. As -1 is no row in stats, a negative one is the value, too. */
SLI_COLD static sl_status sli_refuse_row(sl_stats *stats, sl_int row) {
    return sli_fail_at(stats, SL_ERR_ARGUMENT, row, -1, row < 0 ? row : 0.0,
                       "a row is out of range");
}

SLI_COLD static sl_status sli_no_memory(void) {
    return sli_refuse(SL_ERR_MEMORY, "the allocator returned NULL");
}

static const char sli_needs_threads[] =
    "threads.count is above 1: compile with SL_PTHREADS or OpenMP, or set threads.run";

/* Refuses arguments. wrong: what is wrong with them; NULL: nothing, which gives SL_OK. Threads that
 * are not compiled in are right, but unsupported. */
SLI_NOINLINE static sl_status sli_argument(const char *wrong) {
    return wrong == NULL
               ? SL_OK
               : sli_refuse(wrong == sli_needs_threads ? SL_ERR_UNSUPPORTED : SL_ERR_ARGUMENT,
                            wrong);
}

/* The list of rows of a call on n rows: NULL with SL_ALL or n is all rows, and stays NULL with the
 * count n; NULL with 0 is the empty list, and becomes a pointer. Every public call whose list may
 * be NULL begins with this. */
SLI_NOINLINE static sl_status sli_list(const sl_int **rows, sl_int *count, sl_int n) {
    static const sl_int sli_empty = 0;
    if (*rows != NULL) {
        return sli_argument(*count < 0 ? "the count of a list is below 0; SL_ALL goes with NULL"
                                       : NULL);
    }
    if (*count == 0) {
        *rows = &sli_empty;
    } else if (*count == SL_ALL || *count == n) {
        *count = n;
    } else {
        return sli_argument("the list is NULL: its count must be SL_ALL, n, or 0");
    }
    return SL_OK;
}

/* Sets *out of a call that creates an object to NULL; refuses out if it is NULL itself. */
SLI_NOINLINE static sl_status sli_begin(void *out) {
    static const void *const none = NULL;
    if (out != NULL) {
        memcpy(out, &none, sizeof none);
    }
    return sli_argument(out == NULL ? "out is NULL" : NULL);
}

/* Every call that takes stats begins with this. */
SLI_NOINLINE static void sli_stats_clear_error(sl_stats *stats) {
    (void)sli_fail_at(stats, SL_OK, -1, -1, 0.0, NULL);
}

/* Every call that takes stats ends with this: it gives the caller the last error. A status that
 * this thread has not recorded comes from a worker, usually one that has found no memory. Returns
 * the status. */
SLI_NOINLINE static sl_status sli_report(sl_stats *stats, sl_status status) {
    if (status == SL_OK) {
#if defined(SLI_THREAD_LOCAL)
        sli_last.status = SL_OK; /* what was tried in vain is no error of the call */
#endif
        return status;
    }
#if defined(SLI_THREAD_LOCAL)
    if (sli_last.status != status) {
        (void)sli_refuse(status, "in another thread of the call");
    }
    if (stats != NULL) {
        stats->error = sli_last.error;
    }
#else
    if (stats != NULL && stats->error.what == NULL) {
        stats->error.what = "no more is known";
    }
#endif
    return status;
}

/* The error of a call that is about to name it in other rows. Without thread-local storage only
 * stats have it. */
SLI_COLD static sl_error sli_found(const sl_stats *stats, sl_status status) {
    sl_stats found;
    memset(&found.error, 0, sizeof found.error);
    found.error.row = found.error.column = -1;
    if (stats != NULL) {
        found.error = stats->error;
    }
    (void)sli_report(&found, status);
    return found.error;
}

/* Adds the line of a file to the error that was reported last. */
SLI_NOINLINE static void sli_error_line(sl_stats *stats, sl_off line) {
    if (stats != NULL) {
        stats->error.line = line;
    }
#if defined(SLI_THREAD_LOCAL)
    sli_last.error.line = line;
#endif
}

/* Reports that the system has refused a file, with its reason, errno; returns the status. */
SLI_COLD static sl_status sli_file_fails(const char *what) {
    return sli_fail_at(NULL, SL_ERR_IO, -1, -1, (double)errno,
                       errno == ENOENT   ? "there is no such file or folder"
                       : errno == EACCES ? "permission is denied"
                                         : what);
}

/* What the text of an error says of its place, as " (row 3, value 0.5"; returns its length. */
static int sli_error_place(char *place, size_t size, sl_status status, const sl_error *e) {
    const char *const names[4] = {"row", "column", status == SL_ERR_ARGUMENT ? "least" : "line",
                                  status == SL_ERR_IO ? "errno" : "value"};
    const double numbers[4] = {(double)e->row, (double)e->column, (double)e->line, e->value};
    int k, length = 0;
    for (k = 0; k < 4; k++) {
        if (numbers[k] != (k < 3 ? -1.0 : 0.0)) {
            length += snprintf(place + length, size - (size_t)length, "%s%s %.10g",
                               length == 0 ? " (" : ", ", names[k], numbers[k]);
        }
    }
    return length;
}

SL_API size_t sl_error_text(char *buffer, size_t size, sl_status status, const sl_stats *stats) {
    const sl_error *e = stats == NULL ? NULL : &stats->error;
    char place[128];
    int has_place = 0;
    const char *text = sl_status_string(status), *what = NULL;
#if defined(SLI_THREAD_LOCAL)
    if (e == NULL && sli_last.status == status) {
        e = &sli_last.error;
    }
#endif
    if (e != NULL && status != SL_OK) {
        what = e->what;
        has_place = sli_error_place(place, sizeof place, status, e) > 0;
    }
    /* what the text of the status supposes after a colon gives way to what is known */
    return (size_t)snprintf(buffer, size, "%.*s%s%s%s%s",
                            (int)(what != NULL ? strcspn(text, ":") : strlen(text)), text,
                            what != NULL ? ": " : "", what != NULL ? what : "",
                            has_place ? place : "", has_place ? ")" : "");
}

#endif
