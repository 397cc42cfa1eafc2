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

/* Writes a general file of all entries, which reads back to the same bits. */
static inline void matrix_write(const sl_csc *A, const char *path) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "%%%%MatrixMarket matrix coordinate %s general\n%ld %ld %ld\n",
            A->x ? "real" : "pattern", (long)A->n_rows, (long)A->n_cols, (long)A->p[A->n_cols]);
    for (sl_int j = 0; j < A->n_cols; j++) {
        for (sl_int q = A->p[j]; q < A->p[j + 1]; q++) {
            fprintf(file, "%ld %ld", (long)A->i[q] + 1, (long)j + 1);
            if (A->x) {
                fprintf(file, " %.17g", A->x[q]);
            }
            fputc('\n', file);
        }
    }
    assert_int_equal(fclose(file), 0);
}

#define BANNER(kind) "%%MatrixMarket matrix coordinate " kind "\n"

#endif
