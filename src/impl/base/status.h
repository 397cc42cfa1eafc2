/* status.h: status codes in words, and the error fields of stats */
#ifndef SLI_STATUS_H
#define SLI_STATUS_H

#include "../public/types.h"
#include "base.h"

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
        return "not supported";
    case SL_ERR_IO:
        return "file cannot be read, parsed or written";
    case SL_ERR_ORDERING:
        return "ordering failed";
    case SL_ERR_STATE:
        return "failed factor, or objects that do not belong together";
    case SL_ERR_INCONSISTENT:
        return "inconsistent right-hand side of a singular system";
    }
    return "unknown status";
}

/* Every call that takes stats starts by forgetting the last error. */
SLI_INLINE void sli_stats_clear_error(sl_stats *stats) {
    if (stats != NULL) {
        stats->error_row = -1;
        stats->error_column = -1;
        stats->error_line = -1;
        stats->error_value = 0.0;
    }
}

/* Names the entry at fault and passes the status on. */
SLI_INLINE sl_status sli_fail_at(sl_stats *stats, sl_status status, sl_int row, sl_int column,
                                 double value) {
    if (stats != NULL) {
        stats->error_row = row;
        stats->error_column = column;
        stats->error_value = value;
    }
    return status;
}

#endif
