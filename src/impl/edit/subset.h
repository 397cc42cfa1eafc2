/* subset.h: a set of rows of A as a sorted list of columns of L, and a map from columns to ranks */
#ifndef SLI_EDIT_SUBSET_H
#define SLI_EDIT_SUBSET_H

#include "../analysis/symbolic_types.h"
#include "../base/sort.h"
#include "../ordering/mindeg.h"

/* Fills the relative indices of the children of supernode s. local: n of scratch; on return it has
 * the local rows of s. */
static void sli_fill_relative_of(const sl_symbolic *S, sl_int s, sl_int *local) {
    const sl_off begin = S->rows_begin[s];
    const sl_int first = S->super_first[s], width = S->super_first[s + 1] - first;
    sl_int c;
    sl_off at;
    for (c = 0; c < width; c++) {
        local[first + c] = c;
    }
    for (at = begin; at < S->rows_begin[s + 1]; at++) {
        local[S->rows[at]] = width + (sl_int)(at - begin);
    }
    for (c = s - 1; c >= S->first_descendant[s]; c = S->first_descendant[c] - 1) {
        for (at = S->rows_begin[c]; at < S->rows_begin[c + 1]; at++) {
            S->relative[at] = local[S->rows[at]];
        }
    }
}

/* The rank of a column is its position in the sorted list. The set is a bitmap of the columns, in
 * words of 64, and for each word the rank of its first column. Time and memory go by the size of
 * the set, not by n: where it is small, only words that have a column are stored, and a hash table
 * finds them. */
#define SLI_SUBSET_BITS 64
#define SLI_SUBSET_WORDS 2 /* up to so many words for each column of the set there is no hash */

/* The permutation is read at random places: so many rows ahead they are fetched. */
#define SLI_SUBSET_AHEAD 16

typedef struct sli_subset {
    sl_int count;
    sl_int *columns;          /* count: columns of L, ascending */
    sl_int *row_of;           /* count: the position of each column's row in the caller's list */
    uint64_t *list, *scratch; /* count: for sorting; free once the set is filled */
    sl_int n_words;
    uint64_t *words; /* n_words: which columns are in the set */
    sl_int *before;  /* n_words: the columns of the set in earlier words */
    int is_hashed;
    int shift;       /* hashed words are searched from slot (number multiplier) >> shift on */
    uint32_t mask;   /* slots - 1 */
    sl_int *slots;   /* mask + 1: the words in the order of the table; -1: none */
    sl_int *numbers; /* n_words: hashed words: the first column / 64 */
} sli_subset;

static void sli_subset_layout(sli_subset *R, sli_block *b, sl_int n) {
    const sl_int words = n / SLI_SUBSET_BITS + 1;
    const sl_off count = R->count;
    int bits = 1;
    R->is_hashed = words > SLI_SUBSET_WORDS * count;
    while (R->is_hashed && ((sl_off)1 << bits) < 2 * count) {
        bits++;
    }
    R->mask = ((uint32_t)1 << bits) - 1;
    R->shift = 32 - bits;
    R->n_words = R->is_hashed ? R->count : words;
    R->columns = SLI_TAKE(b, sl_int, R->count);
    R->row_of = SLI_TAKE(b, sl_int, R->count);
    R->list = SLI_TAKE(b, uint64_t, R->count);
    R->scratch = SLI_TAKE(b, uint64_t, R->count);
    R->words = SLI_TAKE(b, uint64_t, R->n_words);
    R->before = SLI_TAKE(b, sl_int, R->n_words);
    R->slots = SLI_TAKE(b, sl_int, R->is_hashed ? (uint64_t)R->mask + 1 : 0);
    R->numbers = SLI_TAKE(b, sl_int, R->is_hashed ? R->count : 0);
}

/* The slot of a hashed word, or the free one where it belongs. */
SLI_INLINE sl_int *sli_subset_slot(const sli_subset *R, sl_int number) {
    uint32_t k = ((uint32_t)number * 2654435769u) >> R->shift; /* 2^32 / the golden ratio */
    while (R->slots[k] != -1 && R->numbers[R->slots[k]] != number) {
        k = (k + 1) & R->mask;
    }
    return &R->slots[k];
}

/* The rank of a column, or -1. */
SLI_NOINLINE static sl_int sli_subset_find(const sli_subset *R, sl_int column) {
    const sl_int number = column / SLI_SUBSET_BITS;
    const sl_int w = R->is_hashed ? *sli_subset_slot(R, number) : number;
    const uint64_t bit = (uint64_t)1 << (column % SLI_SUBSET_BITS);
    if (w == -1 || (R->words[w] & bit) == 0) {
        return -1;
    }
    return R->before[w] + (sl_int)sli_popcount(R->words[w] & (bit - 1));
}

/* Adds the columns of the sorted list to the words. */
static void sli_subset_hash(sli_subset *R) {
    const uint64_t *list = R->list;
    sl_int k, w = -1;
    SLI_NONE(R->slots, (size_t)R->mask + 1);
    for (k = 0; k < R->count; k++) {
        const sl_int column = sli_key(list[k]), number = column / SLI_SUBSET_BITS;
        if (w == -1 || R->numbers[w] != number) {
            *sli_subset_slot(R, number) = ++w;
            R->numbers[w] = number;
            R->words[w] = 0;
            R->before[w] = k;
        }
        R->words[w] |= (uint64_t)1 << (column % SLI_SUBSET_BITS);
        R->columns[k] = column;
        R->row_of[k] = sli_value(list[k]);
    }
}

/* Fills the set from rows of A, and rank_of: the rank of each. Refuses a row out of range or given
 * twice. */
SLI_HOT static sl_status sli_subset_fill(sli_subset *R, const sl_symbolic *S, const sl_int *rows,
                                         sl_int *rank_of, sl_stats *stats) {
    static const char sli_row_twice[] = "a row is given twice";
    sl_int k, rank = 0;
    if (!R->is_hashed) {
        SLI_ZERO(R->words, R->n_words);
    }
    for (k = 0; k < R->count; k++) {
        const sl_int row = rows[k];
        const sl_int ahead = rows[sli_min(k + SLI_SUBSET_AHEAD, R->count - 1)];
        if (row < 0 || row >= S->n) {
            return sli_refuse_row(stats, row);
        }
        if (ahead >= 0 && ahead < S->n) {
            SLI_PREFETCH(S->iperm + ahead, 0);
        }
        if (R->is_hashed) {
            R->list[k] = sli_keyed(S->iperm[row], k);
        } else {
            const sl_int column = rank_of[k] = S->iperm[row];
            uint64_t *word = &R->words[column / SLI_SUBSET_BITS];
            const uint64_t bit = (uint64_t)1 << (column % SLI_SUBSET_BITS);
            if ((*word & bit) != 0) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, row, -1, 0.0, sli_row_twice);
            }
            *word |= bit;
        }
    }
    if (R->is_hashed) {
        sli_sort(R->list, R->count, R->scratch);
        sli_subset_hash(R);
        for (k = 0; k < R->count; k++) {
            rank_of[R->row_of[k]] = k;
            if (k > 0 && R->columns[k] == R->columns[k - 1]) {
                return sli_fail_at(stats, SL_ERR_ARGUMENT, S->perm[R->columns[k]], -1, 0.0,
                                   sli_row_twice);
            }
        }
        return SL_OK;
    }
    for (k = 0; k < R->n_words; k++) {
        uint64_t word = R->words[k];
        R->before[k] = rank;
        for (; word != 0; word &= word - 1) {
            R->columns[rank++] = SLI_SUBSET_BITS * k + sli_lowest_bit(word);
        }
    }
    for (k = 0; k < R->count; k++) {
        rank_of[k] = sli_subset_find(R, rank_of[k]);
        R->row_of[rank_of[k]] = k;
    }
    return SL_OK;
}

#endif
