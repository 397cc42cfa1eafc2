/* small.h: minimum degree order of a small matrix from its pattern as bits, without a graph */
#ifndef SLI_ORDERING_SMALL_H
#define SLI_ORDERING_SMALL_H

#include "mindeg.h"
#include "job.h"

/* Systems of up to this many rows are ordered here. A dissection would not divide most of them, and
 * saves some 10 % of a local solve in the others, 28 % at most. For one factor, levels are found
 * sooner from 64 rows on. */
#define SLI_SMALL_ROWS 256
#define SLI_SMALL_WORDS (SLI_SMALL_ROWS / 64)
#define SLI_SMALL_ROWS_ONE_FACTOR 64

/* Rows that few are next to count as if they had this many neighbors, where paths matter: chains
 * and strips are then eliminated from all places at once, not from their ends. */
#define SLI_SMALL_DEGREE 3

/* A matrix of n <= SLI_SMALL_ROWS rows while it is ordered. */
typedef struct sli_small {
    sl_int n;
    sl_int floor;   /* no degree counts as less */
    uint64_t *rows; /* n x words: rows left that are next to each row, and itself */
    /* n: degree, height, number, of 8 bits each, or SLI_MINDEG_ELIMINATED, as in those up to a
     * multiple of 8. The height is that of the path of columns before it. */
    uint32_t key[SLI_SMALL_ROWS];
} sli_small;

SLI_INLINE uint32_t sli_small_key(const sli_small *m, sl_int degree, uint32_t height, sl_int v) {
    return (uint32_t)sli_max(degree, m->floor) << 16 | height << 8 | (uint32_t)v;
}

SLI_INLINE uint32_t sli_small_height(const sli_small *m, sl_int v) {
    return m->key[v] >> 8 & 255u;
}

SLI_ALWAYS_INLINE sl_int sli_small_count(const uint64_t *row, size_t words) {
    uint32_t count = 0;
    size_t k;
    for (k = 0; k < words; k++) {
        count += sli_popcount(row[k]);
    }
    return (sl_int)count;
}

/* Fills the rows from the entries that are read. Returns whether this order is wanted: no row is a
 * constraint, which sli_order_border would move, and not more than half of many rows have at most
 * two neighbors: eliminating those first (sli_peel) takes less time. Nor, for one factor, if there
 * are so few edges that sli_order_forest has seen a forest unless an edge was given twice. */
SLI_ALWAYS_INLINE int sli_small_fill(sli_small *m, const sli_order_job *job, size_t words) {
    const sl_csc *A = job->A;
    const sl_int nnz = sli_nnz(A);
    sl_int p, v, few = 0, edges = 0;
    memset(m->rows, 0, (size_t)m->n * words * sizeof(uint64_t));
    for (p = 0; p < nnz; p++) {
        const sl_int i = A->i[p], j = job->column[p];
        if (sli_is_read(job->triangle, i, j)) {
            m->rows[(size_t)i * words + (size_t)j / 64] |= (uint64_t)1 << (j % 64);
            m->rows[(size_t)j * words + (size_t)i / 64] |= (uint64_t)1 << (i % 64);
        }
    }
    for (v = 0; v < m->n; v++) {
        uint64_t *row = m->rows + (size_t)v * words;
        const sl_int degree = sli_small_count(row, words);
        const sl_int has_diagonal = (sl_int)(row[v / 64] >> (v % 64) & 1);
        if (!has_diagonal && degree >= 8 &&
            degree * degree >= m->n) { /* branches untested: n is 3 .. 64 in a copy */
            return 0;
        }
        row[v / 64] |= (uint64_t)1 << (v % 64);
        m->key[v] = sli_small_key(m, degree - has_diagonal, 0, v);
        few += degree - has_diagonal <= 2;
        edges += degree - has_diagonal;
    }
    if ((m->n > 64 && few > m->n / 2) || /* branches untested: n is 3 .. 64, or more, in copies */
        (job->is_hurried && edges < 2 * m->n)) {
        return 0;
    }
    for (; v == 0 || v % 8 != 0; v++) { /* branches untested: the same */
        m->key[v] = SLI_MINDEG_ELIMINATED;
    }
    return 1;
}

/* Eliminates v, and with it the rows whose neighbors are then the same, unless they have few: see
 * SLI_SMALL_DEGREE. Returns the new end of the order. */
SLI_ALWAYS_INLINE sl_int sli_small_eliminate(sli_small *m, sl_int v, size_t words, sl_int *order,
                                             sl_int at) {
    uint64_t *row = m->rows + (size_t)v * words, left[SLI_SMALL_WORDS], gone[SLI_SMALL_WORDS];
    const sl_int degree = sli_small_count(row, words) - 1, first = at;
    uint32_t height = sli_small_height(m, v) + 1;
    size_t k, w;
    m->key[v] = SLI_MINDEG_ELIMINATED;
    order[at++] = v;
    row[v / 64] &= ~((uint64_t)1 << (v % 64));
    memset(gone, 0, sizeof gone);
    memcpy(left, row, words * sizeof(uint64_t));
    for (k = 0; k < words; k++) {
        for (; left[k] != 0; left[k] &= left[k] - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(left[k]);
            uint64_t *other = m->rows + (size_t)u * words;
            sl_int count = 0;
            other[v / 64] &= ~((uint64_t)1 << (v % 64));
            for (w = 0; w < words; w++) {
                other[w] |= row[w];
                count += (sl_int)sli_popcount(other[w]);
            }
            if (count == degree && degree > m->floor - 1) {
                gone[k] |= (uint64_t)1 << (u % 64);
                order[at++] = u;
                m->key[u] = SLI_MINDEG_ELIMINATED;
            } else {
                const uint32_t before = sli_small_height(m, u);
                m->key[u] = sli_small_key(m, count - 1, before > height ? before : height, u);
            }
        }
    }
    height += (uint32_t)(at - first - 1);
    for (k = 0; k < words && at > first + 1; k++) {
        for (left[k] = row[k] & ~gone[k]; left[k] != 0; left[k] &= left[k] - 1) {
            const sl_int u = (sl_int)(64 * k) + sli_lowest_bit(left[k]);
            const uint32_t before = sli_small_height(m, u);
            uint64_t *other = m->rows + (size_t)u * words;
            for (w = 0; w < words; w++) {
                other[w] &= ~gone[w];
            }
            m->key[u] = sli_small_key(m, sli_small_count(other, words) - 1,
                                      before > height ? before : height, u);
        }
    }
    return at;
}

/* The row with the least key. */
SLI_ALWAYS_INLINE sl_int sli_small_best(const sli_small *m) {
    uint32_t least[8];
    sl_int v, k;
    if (m->n <= 32) { /* vectors would wait for the last keys to be stored */
        uint32_t first = m->key[0];
        for (v = 1; v < m->n; v++) { /* branches untested: the same */
            first = m->key[v] < first ? m->key[v] : first;
        }
        return (sl_int)(first & 255u);
    }
    memcpy(least, m->key, sizeof least);
    for (v = 8; v < m->n; v += 8) {
        for (k = 0; k < 8; k++) {
            least[k] = m->key[v + k] < least[k] ? m->key[v + k] : least[k];
        }
    }
    for (k = 4; k > 0; k /= 2) {
        for (v = 0; v < k; v++) {
            least[v] = least[v + k] < least[v] ? least[v + k] : least[v];
        }
    }
    return (sl_int)(least[0] & 255u);
}

/* Finds the order, unless there is a constraint. Of equal degrees the least height comes first,
 * which keeps paths short, then the least number. */
SLI_ALWAYS_INLINE int sli_small_run_body(sli_small *m, const sli_order_job *job, size_t words) {
    sl_int at = 0;
    if (!sli_small_fill(m, job, words)) {
        return 0;
    }
    while (at < m->n) {
        at = sli_small_eliminate(m, sli_small_best(m), words,
                                 job->perm, at); /* branches untested: the same */
    }
    return 1;
}

static int sli_small_run(sli_small *m, const sli_order_job *job) {
    return sli_small_run_body(m, job, ((size_t)m->n + 63) / 64);
}

#if defined(SLI_X86) && defined(SLI_GNU)
SLI_TARGET("avx2,popcnt")
static int sli_small_run_avx2(sli_small *m, const sli_order_job *job) {
    return m->n <= 64 ? sli_small_run_body(m, job, 1)
                      : sli_small_run_body(m, job, SLI_SMALL_WORDS);
}
#endif

/* Orders a matrix of at most SLI_SMALL_ROWS rows. Returns 0 if a row is a constraint. */
static int sli_order_small(const sli_order_job *job) {
    sli_small m;
    m.n = job->A->n_cols;
    m.floor = job->is_hurried ? 1 : SLI_SMALL_DEGREE;
    m.rows = job->bits;
#if defined(SLI_X86) && defined(SLI_GNU)
    if (m.n > 2 && sli_cpu_best() != SL_ISA_SCALAR) { /* untested: without AVX2 */
        return sli_small_run_avx2(&m, job);
    }
#endif
    return sli_small_run(&m, job);
}

#endif
