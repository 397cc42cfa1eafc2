/* saved_format.h: reads and rewrites saved factors by src/FORMAT.md, without the library */
#ifndef SL_TEST_SAVED_FORMAT_H
#define SL_TEST_SAVED_FORMAT_H

#include <stdint.h>
#include <string.h>

enum { SAVED_HEADER = 64, SAVED_ENTRY = 32, SAVED_KNOWN = 39 };

enum { SAVED_LATER = 3 }; /* a write version that the library does not know */

/* Ids of the first sections of regions and of a selected inverse. */
enum { SAVED_REGIONS = 96, SAVED_SELECTED = 104 };

/* Bytes of the sections with numbers. */
enum { SAVED_ANALYSIS_BYTES = 192, SAVED_FACTOR_BYTES = 256 };

/* Offsets in the header, and in an entry of the table. */
enum { SAVED_READ = 12, SAVED_WRITE = 16, SAVED_SECTIONS = 20, SAVED_BYTES = 24, SAVED_SUM = 32 };
enum { SAVED_ID = 0, SAVED_WORD = 4, SAVED_OFFSET = 8, SAVED_LENGTH = 16, SAVED_CHECKSUM = 24 };

static inline uint32_t saved_u32(const unsigned char *at) {
    uint32_t value;
    memcpy(&value, at, sizeof value);
    return value;
}

static inline uint64_t saved_u64(const unsigned char *at) {
    uint64_t value;
    memcpy(&value, at, sizeof value);
    return value;
}

static inline void saved_put32(unsigned char *at, uint32_t value) {
    memcpy(at, &value, sizeof value);
}

/* Number k of those whose differences, sums and products overflow, and of those beside n. */
enum { SAVED_EXTREMES = 16 };
static inline uint64_t saved_extreme(int k, uint64_t n) {
    static const uint64_t values[SAVED_EXTREMES - 3] = {0,
                                                        UINT64_MAX,
                                                        (uint64_t)INT64_MAX,
                                                        (uint64_t)INT64_MAX + 1,
                                                        UINT64_C(1) << 31,
                                                        (UINT64_C(1) << 31) - 1,
                                                        UINT64_C(1) << 32,
                                                        UINT64_C(1) << 58,
                                                        UINT64_C(1) << 62,
                                                        UINT64_C(0) - (UINT64_C(1) << 31),
                                                        UINT64_C(0x7fffffff7fffffff),
                                                        UINT64_C(0x8000000080000000),
                                                        1};
    return k < SAVED_EXTREMES - 3 ? values[k] : n + (uint64_t)(k - SAVED_EXTREMES + 2);
}

static inline void saved_put64(unsigned char *at, uint64_t value) {
    memcpy(at, &value, sizeof value);
}

/* The two halves of a 128-bit product, xored. */
static inline uint64_t saved_fold(uint64_t x, uint64_t y) {
    const uint64_t x0 = (uint32_t)x, x1 = x >> 32, y0 = (uint32_t)y, y1 = y >> 32;
    const uint64_t a = x0 * y0, b = x0 * y1, c = x1 * y0, d = x1 * y1;
    const uint64_t middle = (a >> 32) + (uint32_t)b + (uint32_t)c;
    return (middle << 32 | (uint32_t)a) ^ (d + (b >> 32) + (c >> 32) + (middle >> 32));
}

static inline uint64_t saved_little(const unsigned char *at) {
    uint64_t word = 0;
    for (int k = 7; k >= 0; k--) {
        word = word << 8 | at[k];
    }
    return word;
}

/* The checksum of `bytes` bytes, a multiple of 64. */
static inline uint64_t saved_checksum(const unsigned char *data, uint64_t bytes) {
    const uint64_t c1 = 0xa0761d6478bd642fu, c2 = 0xe7037ed1a0b428dbu, c3 = 0x8ebc6af09c88c6e3u,
                   c4 = 0x589965cc75374cc3u;
    uint64_t s[4] = {c2, c3, c4, c1};
    for (uint64_t at = 0; at < bytes; at += 64) {
        for (int c = 0; c < 4; c++) {
            s[c] = saved_fold(saved_little(data + at + 16 * c) ^ c1,
                              saved_little(data + at + 16 * c + 8) ^ s[c]);
        }
    }
    return (saved_fold(s[0] ^ bytes, s[1] ^ c2) ^ saved_fold(s[2] ^ c3, s[3] ^ c4)) ^
           (saved_fold(s[0] ^ c4, s[2] ^ c1) + saved_fold(s[1] ^ c3, s[3] ^ c2));
}

static inline uint64_t saved_round(uint64_t bytes) {
    return (bytes + 63) / 64 * 64;
}

static inline unsigned char *saved_entry(unsigned char *file, uint32_t k) {
    return file + SAVED_HEADER + SAVED_ENTRY * (size_t)k;
}

/* The section with this id and its length; NULL: there is none. */
static inline unsigned char *saved_section(unsigned char *file, uint32_t id, uint64_t *bytes) {
    for (uint32_t k = 0; k < saved_u32(file + SAVED_SECTIONS); k++) {
        const unsigned char *entry = saved_entry(file, k);
        if (saved_u32(entry + SAVED_ID) == id) {
            *bytes = saved_u64(entry + SAVED_LENGTH);
            return file + saved_u64(entry + SAVED_OFFSET);
        }
    }
    return NULL;
}

/* Makes all checksums right that can be computed: those of sections that are inside the file. */
static inline void saved_repair(unsigned char *file, uint64_t size) {
    uint32_t sections;
    uint64_t prefix;
    if (size < SAVED_HEADER) {
        return;
    }
    sections = saved_u32(file + SAVED_SECTIONS);
    prefix = saved_round(SAVED_HEADER + SAVED_ENTRY * (uint64_t)sections);
    if (sections > 64 || prefix > size) {
        return;
    }
    for (uint32_t k = 0; k < sections; k++) {
        unsigned char *entry = saved_entry(file, k);
        const uint64_t offset = saved_u64(entry + SAVED_OFFSET),
                       length = saved_u64(entry + SAVED_LENGTH);
        if (offset <= size && length <= size && saved_round(length) <= size - offset) {
            saved_put64(entry + SAVED_CHECKSUM, saved_checksum(file + offset, saved_round(length)));
        }
    }
    saved_put64(file + SAVED_SUM, 0);
    saved_put64(file + SAVED_SUM, saved_checksum(file, prefix));
}

static inline void saved_reverse(unsigned char *at, int bytes) {
    for (int k = 0; k < bytes / 2; k++) {
        const unsigned char keep = at[k];
        at[k] = at[bytes - 1 - k];
        at[bytes - 1 - k] = keep;
    }
}

/* Rewrites a valid file in the other byte order, as a processor of that order would have written
 * it. */
static inline void saved_change_order(unsigned char *file) {
    const uint32_t sections = saved_u32(file + SAVED_SECTIONS);
    const uint64_t prefix = saved_round(SAVED_HEADER + SAVED_ENTRY * (uint64_t)sections);
    for (uint32_t k = 0; k < sections; k++) {
        unsigned char *entry = saved_entry(file, k);
        const uint32_t word = saved_u32(entry + SAVED_WORD);
        unsigned char *data = file + saved_u64(entry + SAVED_OFFSET);
        const uint64_t length = saved_u64(entry + SAVED_LENGTH);
        for (uint64_t at = 0; at < length; at += word) {
            saved_reverse(data + at, word > 8 ? 8 : (int)word);
            if (word == 24) {
                saved_reverse(data + at + 8, 8);
            }
            for (uint32_t part = word == 24 ? 16 : 8; part < word; part += 4) {
                saved_reverse(data + at + part, 4);
            }
        }
        saved_put64(entry + SAVED_CHECKSUM, saved_checksum(data, saved_round(length)));
        for (int part = 0; part < 8; part += 4) {
            saved_reverse(entry + part, 4);
        }
        for (int part = 8; part < 32; part += 8) {
            saved_reverse(entry + part, 8);
        }
    }
    for (int part = 8; part < 24; part += 4) {
        saved_reverse(file + part, 4);
    }
    saved_reverse(file + SAVED_BYTES, 8);
    saved_put64(file + SAVED_SUM, 0);
    saved_put64(file + SAVED_SUM, saved_checksum(file, prefix));
    saved_reverse(file + SAVED_SUM, 8);
}

#endif
