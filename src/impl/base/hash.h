/* hash.h: 128-bit hashes of arrays, by which objects recognize the contents of others */
#ifndef SLI_BASE_HASH_H
#define SLI_BASE_HASH_H

#include "base.h"

/* An identity by content. An address or a counter does not identify an object: memory is used again
 * after a release, and every counter starts at 1. Two different contents have equal hashes with a
 * probability of about 2^-64, as long as nobody constructs them: the hash is not cryptographic, so
 * whatever must hold for memory safety is checked separately. */
typedef struct sli_hash {
    uint64_t a, b;
} sli_hash;

#define SLI_HASH_STRIPE 64 /* bytes: 16 for each of four chains */
#define SLI_HASH_1 0xa0761d6478bd642fu
#define SLI_HASH_2 0xe7037ed1a0b428dbu
#define SLI_HASH_3 0x8ebc6af09c88c6e3u
#define SLI_HASH_4 0x589965cc75374cc3u

SLI_INLINE int sli_hash_equals(sli_hash g, sli_hash h) {
    return ((g.a ^ h.a) | (g.b ^ h.b)) == 0;
}

/* The two halves of the 128-bit product, added without carry. */
SLI_INLINE uint64_t sli_fold(uint64_t x, uint64_t y) {
#if defined(__SIZEOF_INT128__)
    __extension__ typedef unsigned __int128 sli_wide;
    const sli_wide product = (sli_wide)x * y;
    return (uint64_t)product ^ (uint64_t)(product >> 64);
#else
    const uint64_t x0 = (uint32_t)x, x1 = x >> 32, y0 = (uint32_t)y, y1 = y >> 32;
    const uint64_t low = x0 * y0, middle = x1 * y0 + (low >> 32);
    const uint64_t other = x0 * y1 + (uint32_t)middle;
    return x * y ^ (x1 * y1 + (middle >> 32) + (other >> 32));
#endif
}

/* What an array consists of. Its hash does not depend on the byte order of the processor: words are
 * read as a little-endian processor reads them. */
typedef enum sli_hashed { SLI_HASH_INTS, SLI_HASH_WORDS, SLI_HASH_BYTES } sli_hashed;

SLI_ALWAYS_INLINE uint64_t sli_word(const void *bytes, sli_hashed kind) {
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
#if defined(SLI_BIG_ENDIAN)
    word = kind == SLI_HASH_WORDS  ? word
           : kind == SLI_HASH_INTS ? word << 32 | word >> 32
                                   : __builtin_bswap64(word);
#else
    (void)kind;
#endif
    return word;
}

/* Hashes one stripe. A 31-bit half of a word that reaches 2^31 - `room`, and one with its highest
 * bit set, sets bit 31 or 63 of the result. */
SLI_ALWAYS_INLINE uint64_t sli_hash_stripe(uint64_t *chain, const unsigned char *bytes,
                                           sli_hashed kind, uint64_t room) {
    uint64_t beyond = 0;
    int c;
    SLI_UNROLL
    for (c = 0; c < 4; c++) {
        const uint64_t x = sli_word(bytes + 16 * c, kind), y = sli_word(bytes + 16 * c + 8, kind);
        chain[c] = sli_fold(x ^ SLI_HASH_1, y ^ chain[c]);
        beyond |= (x + room) | x | (y + room) | y;
    }
    return beyond;
}

/* The chains of an array that is mixed into h. They are independent, because the multiplications of
 * one chain wait for each other: 12 bytes a cycle. */
SLI_INLINE void sli_hash_begin(sli_hash h, uint64_t *chain) {
    chain[0] = h.a ^ SLI_HASH_2;
    chain[1] = h.b ^ SLI_HASH_3;
    chain[2] = h.a + SLI_HASH_4;
    chain[3] = h.b + SLI_HASH_1;
}

SLI_INLINE sli_hash sli_hash_end(const uint64_t *chain, uint64_t bytes) {
    sli_hash h;
    h.a = sli_fold(chain[0] ^ bytes, chain[1] ^ SLI_HASH_2) ^
          sli_fold(chain[2] ^ SLI_HASH_3, chain[3] ^ SLI_HASH_4);
    h.b = sli_fold(chain[0] ^ SLI_HASH_4, chain[2] ^ SLI_HASH_1) +
          sli_fold(chain[1] ^ SLI_HASH_3, chain[3] ^ SLI_HASH_2);
    return h;
}

/* Hashes bytes in stripes; the last one is filled up with zeros. */
SLI_ALWAYS_INLINE uint64_t sli_hash_stripes(uint64_t *chain, const void *data, size_t bytes,
                                            sli_hashed kind, uint64_t room) {
    uint64_t found = 0;
    const unsigned char *at = (const unsigned char *)data;
    size_t left = bytes;
    for (; left >= SLI_HASH_STRIPE; left -= SLI_HASH_STRIPE, at += SLI_HASH_STRIPE) {
        found |= sli_hash_stripe(chain, at, kind, room);
    }
    if (left > 0) {
        unsigned char last[SLI_HASH_STRIPE] = {0};
        memcpy(last, at, left);
        found |= sli_hash_stripe(chain, last, kind, room);
    }
    return found;
}

/* Mixes an array into h. */
SLI_ALWAYS_INLINE sli_hash sli_hash_checked(sli_hash h, const void *data, size_t bytes,
                                            sli_hashed kind, uint64_t room, uint64_t *beyond) {
    uint64_t chain[4];
    sli_hash_begin(h, chain);
    *beyond = sli_hash_stripes(chain, data, bytes, kind, room);
    return sli_hash_end(chain, bytes);
}

#if defined(SLI_BIG_ENDIAN)
static sli_hash sli_hash_ints(sli_hash h, const sl_int *a, sl_off count) {
    uint64_t unused;
    return sli_hash_checked(h, a, (size_t)count * sizeof *a, SLI_HASH_INTS, 0, &unused);
}

/* Words of 8 bytes: double, uint64_t. */
static sli_hash sli_hash_words(sli_hash h, const void *a, sl_off count) {
    uint64_t unused;
    return sli_hash_checked(h, a, (size_t)count * 8, SLI_HASH_WORDS, 0, &unused);
}
#else
static sli_hash sli_hash_bytes(sli_hash h, const void *data, size_t bytes) {
    uint64_t unused;
    return sli_hash_checked(h, data, bytes, SLI_HASH_BYTES, 0, &unused);
}

SLI_INLINE sli_hash sli_hash_ints(sli_hash h, const sl_int *a, sl_off count) {
    return sli_hash_bytes(h, a, (size_t)count * sizeof *a);
}

/* Words of 8 bytes: double, uint64_t. */
SLI_INLINE sli_hash sli_hash_words(sli_hash h, const void *a, sl_off count) {
    return sli_hash_bytes(h, a, (size_t)count * 8);
}
#endif

/* Mixes indices into *h; returns whether all of them are in 0..n-1. */
static int sli_hash_indices(sli_hash *h, const sl_int *a, sl_int count, sl_int n) {
    const uint64_t room = ((uint64_t)1 << 31) - (uint64_t)n;
    uint64_t beyond;
    *h = sli_hash_checked(*h, a, (size_t)count * sizeof *a, SLI_HASH_INTS, room << 32 | room,
                          &beyond);
    return count == 0 || (beyond & 0x8000000080000000u) == 0;
}

#endif
