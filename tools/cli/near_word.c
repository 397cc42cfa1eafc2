/* near_word.c: the word of a list that was probably meant by one with a typing error */
#include "near_word.h"

#include <string.h>

enum { LETTERS = 24 };

static int least(int a, int b) {
    return a < b ? a : b;
}

/* Damerau: A technique for computer detection and correction of spelling errors, 1964. */
int near_word_distance(const char *a, const char *b, int most) {
    int d[LETTERS + 1][LETTERS + 1];
    const int m = (int)strlen(a), n = (int)strlen(b);
    if (m >= LETTERS || n >= LETTERS) {
        return most + 1;
    }
    for (int i = 0; i <= m; i++) {
        for (int k = 0; k <= n; k++) {
            if (i == 0 || k == 0) {
                d[i][k] = i + k;
                continue;
            }
            d[i][k] = least(least(d[i - 1][k], d[i][k - 1]) + 1,
                            d[i - 1][k - 1] + (a[i - 1] != b[k - 1]));
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1]) {
                d[i][k] = least(d[i][k], d[i - 2][k - 2] + 1);
            }
        }
    }
    return least(d[m][n], most + 1);
}

const char *near_word(const char *word, const char *best, const char *candidate) {
    const int letters = (int)strlen(word);
    const int allowed = letters < 4 ? 1 : letters < 9 ? 2 : letters / 3;
    const int so_far = best != NULL ? near_word_distance(word, best, allowed) : allowed + 1;
    return near_word_distance(word, candidate, allowed) < so_far ? candidate : best;
}
