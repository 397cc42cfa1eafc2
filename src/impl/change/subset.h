/* subset.h: a set of rows of A as a sorted list of columns of L, and a map from columns to ranks */
#ifndef SLI_CHANGE_SUBSET_H
#define SLI_CHANGE_SUBSET_H

#include "../analysis/symbolic_types.h"
#include "../base/sort.h"

/* The rank of a column is its position in the sorted list. The map takes time and memory by the
 * size of the set, not by n: columns are grouped into pages of 16, and a hash table finds the
 * page. Where the set is not small, the table has a slot for each page, which also sorts it. */
#define SLI_PAGE_BITS 4
#define SLI_PAGE_COLUMNS (1 << SLI_PAGE_BITS)
#define SLI_PAGES_PER_COLUMN 8 /* up to so many pages for each column of the set there is no hash */

/* The permutation is read at random places: so many rows ahead they are fetched. */
#define SLI_SUBSET_AHEAD 16

typedef struct sli_subset {
    sl_int count;
    sl_int *columns; /* count: columns of L, ascending */
    sl_int *row_of;  /* count: the position of each column's row in the caller's list */
    sl_int n_pages, most_pages;
    int is_hashed;
    int shift;       /* hashed pages are searched from slot (page multiplier) >> shift on */
    uint32_t mask;   /* slots - 1 */
    sl_int *slots;   /* the pages in the order of the table; -1: none */
    sl_int *numbers; /* most_pages: which columns a page has */
    sl_int *ranks;   /* most_pages x 16; -1: not in the set */
} sli_subset;

static void sli_subset_layout(sli_subset *R, sli_block *b, sl_int n) {
    const sl_int pages = n / SLI_PAGE_COLUMNS + 1;
    const sl_off count = R->count;
    int bits = 1;
    R->most_pages = sli_min(R->count, pages);
    R->is_hashed = pages > SLI_PAGES_PER_COLUMN * count;
    while (((sl_off)1 << bits) < (R->is_hashed ? 2 * count : pages)) {
        bits++;
    }
    R->mask = ((uint32_t)1 << bits) - 1;
    R->shift = 32 - bits;
    R->columns = SLI_TAKE(b, sl_int, R->count);
    R->row_of = SLI_TAKE(b, sl_int, R->count);
    R->slots = SLI_TAKE(b, sl_int, R->is_hashed ? (uint64_t)R->mask + 1 : (uint64_t)pages);
    R->numbers = SLI_TAKE(b, sl_int, R->most_pages);
    R->ranks = SLI_TAKE(b, sl_int, (uint64_t)R->most_pages * SLI_PAGE_COLUMNS);
}

/* The slot of a page, or the free one where it belongs. */
SLI_INLINE sl_int *sli_subset_slot(const sli_subset *R, sl_int page) {
    uint32_t k;
    if (!R->is_hashed) {
        return &R->slots[page];
    }
    k = ((uint32_t)page * 2654435769u) >> R->shift; /* 2^32 / the golden ratio */
    while (R->slots[k] != -1 && R->numbers[R->slots[k]] != page) {
        k = (k + 1) & R->mask;
    }
    return &R->slots[k];
}

/* The rank of a column, or -1. */
SLI_INLINE sl_int sli_subset_find(const sli_subset *R, sl_int column) {
    const sl_int at = *sli_subset_slot(R, column >> SLI_PAGE_BITS);
    return at == -1 ? -1 : R->ranks[(ptrdiff_t)at * SLI_PAGE_COLUMNS + column % SLI_PAGE_COLUMNS];
}

/* The place of a column's rank, on a page that is made if there is none. */
static sl_int *sli_subset_place(sli_subset *R, sl_int column) {
    sl_int *slot = sli_subset_slot(R, column >> SLI_PAGE_BITS);
    if (*slot == -1) {
        sl_int *page = R->ranks + (ptrdiff_t)R->n_pages * SLI_PAGE_COLUMNS;
        sl_int m;
        *slot = R->n_pages;
        R->numbers[R->n_pages++] = column >> SLI_PAGE_BITS;
        for (m = 0; m < SLI_PAGE_COLUMNS; m++) {
            page[m] = -1;
        }
    }
    return &R->ranks[(ptrdiff_t)*slot * SLI_PAGE_COLUMNS + column % SLI_PAGE_COLUMNS];
}

SLI_INLINE void sli_subset_append(sli_subset *R, sl_int rank, sl_int column, sl_int *place) {
    R->columns[rank] = column;
    R->row_of[rank] = *place;
    *place = rank;
}

/* Fills the set from rows of A. Refuses a row out of range or given twice. list, scratch: count. */
static sl_status sli_subset_fill(sli_subset *R, const sl_symbolic *S, const sl_int *rows,
                                 uint64_t *list, uint64_t *scratch, sl_stats *stats) {
    const sl_int pages = S->n / SLI_PAGE_COLUMNS + 1;
    sl_int k, m, rank = 0;
    R->n_pages = 0;
    memset(R->slots, 0xff,
           (R->is_hashed ? (size_t)R->mask + 1 : (size_t)pages) * sizeof(sl_int)); /* -1 */
    for (k = 0; k < R->count; k++) {
        const sl_int row = rows[k];
        const sl_int ahead = rows[sli_min(k + SLI_SUBSET_AHEAD, R->count - 1)];
        sl_int *place = row < 0 || row >= S->n ? NULL : sli_subset_place(R, S->iperm[row]);
        if (ahead >= 0 && ahead < S->n) {
            SLI_PREFETCH(S->iperm + ahead, 0);
        }
        if (place == NULL || *place != -1) {
            return sli_fail_at(stats, SL_ERR_ARGUMENT, row, -1, 0.0);
        }
        *place = k;
        list[k] = sli_keyed(S->iperm[row], k);
    }
    if (R->is_hashed) {
        sli_sort(list, R->count, scratch);
    }
    for (k = 0; k < R->count && R->is_hashed; k++) {
        sli_subset_append(R, rank++, sli_key(list[k]), sli_subset_place(R, sli_key(list[k])));
    }
    for (k = 0; k < pages && !R->is_hashed; k++) {
        for (m = 0; m < SLI_PAGE_COLUMNS && R->slots[k] != -1; m++) {
            sl_int *place = R->ranks + (ptrdiff_t)R->slots[k] * SLI_PAGE_COLUMNS + m;
            if (*place != -1) {
                sli_subset_append(R, rank++, k * SLI_PAGE_COLUMNS + m, place);
            }
        }
    }
    return SL_OK;
}

#endif
