/* near_word.h: the word of a list that was probably meant by one with a typing error */
#ifndef TOOLS_NEAR_WORD_H
#define TOOLS_NEAR_WORD_H

#include <stddef.h>

/** The number of letters to insert, remove, replace or swap with the next to make one word of the
 *  other; at most `most`, else most + 1. Words of 24 letters or more are that far apart. */
int near_word_distance(const char *a, const char *b, int most);

/** Keeps the nearer word: returns `candidate` if it is nearer to `word` than `best`, which may be
 *  NULL, and within 2 changes or a third of the letters; else best. */
const char *near_word(const char *word, const char *best, const char *candidate);

#endif
