/* matrix_text.h: Matrix Market files as texts */
#ifndef SL_TEST_MATRIX_TEXT_H
#define SL_TEST_MATRIX_TEXT_H

#include "check_factor.h"

static inline sl_status parse(sl_matrix **M, const char *text, sl_stats *stats) {
    /* an exact copy on the heap: sanitizers see a read past the end, and there is no terminating
     * zero */
    size_t length = strlen(text);
    char *copy = (char *)test_array(length, 1);
    memcpy(copy, text, length);
    sl_status status = sl_matrix_parse(M, copy, length, NULL, stats);
    free(copy);
    assert_true((*M != NULL) == (status == SL_OK));
    return status;
}

#define BANNER(kind) "%%MatrixMarket matrix coordinate " kind "\n"

#endif
