/* sort.h: sorts pairs (key, value): insertion sort for few, radix sort for many; binary search */
#ifndef SLI_BASE_SORT_H
#define SLI_BASE_SORT_H

#include "base.h"

/* A key in the upper half (a row, column or supernode) and its value in the lower half, in one
 * word. */
SLI_INLINE uint64_t sli_keyed(sl_int key, sl_int value) {
    return (uint64_t)(uint32_t)key << 32 | (uint32_t)value;
}

SLI_INLINE sl_int sli_key(uint64_t keyed) {
    return (sl_int)(keyed >> 32);
}

SLI_INLINE sl_int sli_value(uint64_t keyed) {
    return (sl_int)(uint32_t)(keyed & 0xffffffffu);
}

/* The number of elements below a bound, of count ascending elements. */
SLI_NOINLINE static sl_int sli_lower_bound(const sl_int *a, sl_int count, sl_int bound) {
    sl_int low = 0, high = count;
    while (low < high) {
        const sl_int middle = low + (high - low) / 2;
        if (a[middle] < bound) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Up to this count the moves of insertion cost less than the 256 counters of a radix pass. */
#define SLI_SORT_SMALL 48

/* Sorts by key, ascending and stable; keys are not negative. scratch holds count elements. O(count)
 * per byte of the largest key. */
static void sli_sort(uint64_t *a, sl_int count, uint64_t *scratch) {
    sl_int i, k;
    sl_int largest = 0;
    int shift, is_sorted = 1;
    if (count <= SLI_SORT_SMALL) {
        for (i = 1; i < count; i++) {
            const uint64_t here = a[i];
            for (k = i; k > 0 && a[k - 1] >> 32 > here >> 32; k--) {
                a[k] = a[k - 1];
            }
            a[k] = here;
        }
        return;
    }
    for (i = 0; i < count; i++) {
        is_sorted &= sli_key(a[i]) >= largest;
        largest = sli_max(largest, sli_key(a[i]));
    }
    for (shift = 32; shift < 64 && largest > 0 && !is_sorted; shift += 8, largest >>= 8) {
        sl_int start[256], total = 0;
        memset(start, 0, sizeof start);
        for (i = 0; i < count; i++) {
            start[(a[i] >> shift) & 255]++;
        }
        for (k = 0; k < 256; k++) {
            const sl_int here = start[k];
            start[k] = total;
            total += here;
        }
        for (i = 0; i < count; i++) {
            scratch[start[(a[i] >> shift) & 255]++] = a[i];
        }
        SLI_COPY(a, scratch, count);
    }
}

/* Turns the lengths of n lists, and begin[n] = 0, into their starts: sums of the lengths before.
 * Returns the sum of all. */
SLI_INLINE sl_off sli_starts(sl_off *begin, sl_int n) {
    sl_off total = 0;
    sl_int k;
    for (k = 0; k <= n; k++) {
        const sl_off here = begin[k];
        begin[k] = total;
        total += here;
    }
    return begin[n];
}

/* Undoes that each start has advanced to the end of its list. */
SLI_INLINE void sli_starts_restore(sl_off *begin, sl_int n) {
    memmove(begin + 1, begin, (size_t)n * sizeof(sl_off));
    begin[0] = 0;
}

#endif
