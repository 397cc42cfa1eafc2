/* saved_file.c: opens a file of sparse-local save */
#include "saved_file.h"

#include "app.h"

#include <string.h>

void saved_file_open(sl_saved_set *set, const char *path, unsigned checks) {
    memset(set, 0, sizeof *set);
    sl_status status = sl_load(set, path, NULL, 0, checks | SL_LOAD_MAPPED, NULL);
    if (status == SL_ERR_UNSUPPORTED) {
        status = sl_load(set, path, NULL, 0, checks, NULL);
    }
    app_must(status, path, NULL);
    if (set->factor == NULL) {
        app_die("%s: holds an analysis without a factor", path);
    }
}
