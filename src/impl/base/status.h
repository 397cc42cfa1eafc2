/* status.h: status codes as text, and the error group of stats */
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
    case SL_ERR_PATTERN:
        return "malformed or unsymmetric pattern";
    case SL_ERR_PIVOT:
        return "null pivot: singular matrix, or one that needs pivoting";
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
    case SL_ERR_STATE:
        return "failed factor, or objects that do not belong together";
    case SL_ERR_INCONSISTENT:
        return "inconsistent right-hand side of a singular system";
    case SL_ERR_INACCURATE:
        return "inaccurate: pivot growth or backward error above its limit";
    }
    return "unknown status";
}

SL_API size_t sl_stats_size(void) {
    return sizeof(sl_stats);
}

/* Every call that takes stats begins with this. */
SLI_INLINE void sli_stats_clear_error(sl_stats *stats) {
    if (stats != NULL) {
        stats->error.row = -1;
        stats->error.column = -1;
        stats->error.line = -1;
        stats->error.value = 0.0;
        stats->error.what = NULL;
    }
}

/* Names the option that cannot be served in stats; returns the status. */
SLI_INLINE sl_status sli_unsupported(sl_stats *stats, const char *what) {
    if (stats != NULL) {
        stats->error.what = what;
    }
    return SL_ERR_UNSUPPORTED;
}

/* Reports the entry at fault in stats; returns the status. */
SLI_NOINLINE static sl_status sli_fail_at(sl_stats *stats, sl_status status, sl_int row,
                                          sl_int column, double value) {
    if (stats != NULL) {
        stats->error.row = row;
        stats->error.column = column;
        stats->error.value = value;
    }
    return status;
}

#endif
