/* format.h: saved factors: header, table of sections, and which sections objects have */
#ifndef SLI_SAVE_FORMAT_H
#define SLI_SAVE_FORMAT_H

#include "../../public/save.h"
#include "../analysis/symbolic_build.h"
#include "../factor/factor_setup.h"
#include "../inverse/selected.h"
#include "../inverse/region_types.h"

/* src/FORMAT.md specifies the format. A change of it changes SLI_READ_VERSION if older libraries
 * must not read the new files, and SLI_WRITE_VERSION in any case. */
#define SLI_READ_VERSION 2
#define SLI_READ_VERSION_DOUBLE 1 /* of files without L in float */
#define SLI_WRITE_VERSION 2
#define SLI_WRITE_VERSION_PLAIN 1 /* of files without regions, selected inverse and floats */
#define SLI_ORDER_MARK 0x01020304u
#define SLI_ORDER_MARK_SWAPPED 0x04030201u
#define SLI_SECTIONS_MAX 64 /* of a file of a later version */

typedef struct sli_saved_header {
    unsigned char magic[8];
    uint32_t order_mark, read_version, write_version, sections;
    uint64_t bytes;    /* of the file */
    uint64_t checksum; /* of header and table, where this field counts as 0 */
    uint64_t reserved[3];
} sli_saved_header;

/* An entry of the table. Sections follow each other in the order of the table, each from the next
 * multiple of 64 bytes on, filled up with zeros. */
typedef struct sli_section {
    uint32_t id;
    uint32_t word; /* bytes of a word: 1, 4 or 8; 24: an sli_extent; 32: an sli_step */
    uint64_t offset, bytes;
    uint64_t checksum; /* of the section and the zeros after it */
} sli_section;

enum {
    SLI_SECTION_ANALYSIS = 1, /* the numbers of sli_saved_analysis */
    SLI_SECTION_FACTOR = 2,
    SLI_SECTION_PERM = 16,    /* arrays of an analysis, in the order of sli_symbolic_layout */
    SLI_SECTION_D = 64,       /* arrays of a factor, in the order of sli_factor_layout */
    SLI_FACTOR_SECTIONS = 17, /* one more, for L in float, where L is stored so */
    SLI_SECTION_REGIONS = 96, /* the numbers of sli_saved_part, and the following: */
    SLI_SECTION_REGION_LIST,  /* an sli_saved_region for each region */
    SLI_SECTION_REGION_ROOTS, /* in these three, each region begins at a multiple of 64 bytes */
    SLI_SECTION_REGION_ROWS,
    SLI_SECTION_REGION_Z,
    SLI_REGION_SECTIONS = 5,
    SLI_SECTION_SELECTED = 104, /* the numbers of sli_saved_part; supers; begin; Z */
    SLI_SELECTED_SECTIONS = 4
};

/* Words of the sections of regions and of a selected inverse. */
static const uint32_t sli_region_words[SLI_REGION_SECTIONS] = {8, 8, 4, 4, 8};
static const uint32_t sli_selected_words[SLI_SELECTED_SECTIONS] = {8, 4, 8, 8};

/* Words of 8 bytes only, so that any reader can change their byte order. */
typedef struct sli_saved_analysis {
    int64_t n, supers, nodes, nnz_input, rows, entries, panels;
    int64_t tallest, widest, triangle, nnz_l, fundamental, tree_height, components;
    int64_t is_pivoted, pairs, delayed;
    uint64_t pattern[2], identity[2];
    double flops;
    uint64_t reserved[2];
} sli_saved_analysis;

typedef struct sli_saved_factor {
    int64_t method, skips_null, has_mass, has_signs, checks, is_centered, nulls, anchors;
    int64_t positive, negative, null, regularized, weak, regular;
    double pivot_min, pivot_max, entry_max, growth;
    double null_tolerance, regularization, consistency, growth_limit, error_limit;
    uint64_t identity[2];
    int64_t null_vectors; /* columns of z and g; 0: 1, in files of earlier versions */
    int64_t storage;      /* sl_storage: of L */
    double eta;           /* of sl_factor_certify; 0: none, as in files of earlier versions */
    int64_t certainty;    /* sl_certainty */
    double drift;         /* of changes; 0: none, or a file of an earlier version */
    uint64_t reserved[2];
} sli_saved_factor;

/* Regions or a selected inverse: how many regions or supernodes, and the identity of the factor. */
typedef struct sli_saved_part {
    int64_t count;
    uint64_t identity[2];
    int64_t reserved[5];
} sli_saved_part;

typedef struct sli_saved_region {
    int64_t roots, rows, is_copied;
    int64_t reserved[5];
} sli_saved_region;

/* A file in progress: the header, the table, and where the contents of each section are. */
typedef struct sli_saved {
    sli_saved_header header;
    sli_section table[SLI_SECTIONS_MAX];
    sli_saved_analysis analysis;
    sli_saved_factor factor;
    sli_saved_part regions, selected;
    const sl_saved_set *set; /* whose regions are written */
    /* the first `used` bytes of each section, the others are 0; NULL while only sizes are known */
    const void *data[SLI_SECTIONS_MAX];
    uint64_t used[SLI_SECTIONS_MAX];
    sl_int first_array;  /* the section with the first array of the analysis */
    sl_int first_number; /* the section with the first array of the factor */
} sli_saved;

static const unsigned char sli_saved_magic[8] = {0x89, 'S', 'L', 'F', 13, 10, 26, 10};

SLI_INLINE uint64_t sli_round_up(uint64_t bytes) {
    return (bytes + SLI_ALIGN - 1) / SLI_ALIGN * SLI_ALIGN;
}

/* Bytes of the header and the table. */
SLI_INLINE uint64_t sli_saved_prefix(const sli_saved *f) {
    return sli_round_up(sizeof f->header + f->header.sections * sizeof(sli_section));
}

/* Appends a section of `count` words, of which `used` have contents. */
SLI_NOINLINE static void sli_saved_add(sli_saved *f, uint32_t id, uint32_t word, const void *data,
                                       uint64_t count, uint64_t used) {
    const uint32_t k = f->header.sections++;
    f->table[k].id = id;
    f->table[k].word = word;
    f->table[k].bytes = count * word;
    f->data[k] = data;
    f->used[k] = used * word;
}

SLI_NOINLINE static void sli_saved_add_analysis(sli_saved *f, const sl_symbolic *S) {
    const sli_saved_analysis *a = &f->analysis;
    const uint64_t n = (uint64_t)a->n, supers = (uint64_t)a->supers, rows = (uint64_t)a->rows,
                   entries = (uint64_t)a->entries, nodes = (uint64_t)a->nodes;
    uint32_t id = SLI_SECTION_PERM;
#define SLI_ADD(word, array, count) sli_saved_add(f, id++, word, S->array, count, count)
    f->first_array = (sl_int)f->header.sections;
    SLI_ADD(4, perm, n);
    SLI_ADD(4, iperm, n);
    SLI_ADD(4, parent, n);
    SLI_ADD(4, counts, n);
    SLI_ADD(4, super_of, n);
    SLI_ADD(4, super_first, supers + 1);
    SLI_ADD(4, super_parent, supers);
    SLI_ADD(8, rows_begin, supers + 1);
    SLI_ADD(4, rows, rows);
    SLI_ADD(8, panel_begin, supers + 1);
    SLI_ADD(32, steps, supers);
    SLI_ADD(4, first_descendant, supers);
    SLI_ADD(1, pairs, a->pairs > 0 ? n : 0);
    SLI_ADD(4, relative, rows);
    SLI_ADD(8, scatter_begin, supers + 1);
    SLI_ADD(4, scatter_from, entries);
    SLI_ADD(8, scatter_to, entries);
    SLI_ADD(4, node_of, nodes > 0 ? n : 0);
    SLI_ADD(4, node_parent, nodes);
    SLI_ADD(4, node_level, nodes);
#undef SLI_ADD
}

/* Arrays that the factor does not have take no bytes, but have their entry in the table. */
static void sli_saved_add_factor(sli_saved *f, const sl_factor *F, int has_factor) {
    const sli_saved_factor *g = &f->factor;
    const uint64_t n = has_factor ? (uint64_t)f->analysis.n : 0;
    const uint64_t regularized = g->regularization != 0.0 ? n : 0;
    const uint64_t skipped = g->skips_null ? n : 0;
    const uint64_t vectors = g->null_vectors > 1 ? skipped * (uint64_t)g->null_vectors : skipped;
    const uint64_t weighted = g->has_mass ? n : 0;
    const uint64_t centers = weighted * (g->null_vectors > 1 ? 2 * (uint64_t)g->null_vectors : 1);
    const uint64_t trees = g->has_mass ? (uint64_t)f->analysis.components : 0;
    const uint64_t anchors = g->is_centered ? (uint64_t)g->anchors : 0;
    const uint64_t panels = has_factor ? (uint64_t)f->analysis.panels : 0;
    const uint64_t supers = has_factor ? (uint64_t)f->analysis.supers : 0;
    const uint64_t paired = f->analysis.pairs > 0 ? n : 0;
    const uint64_t divisors = paired > 0 ? n : weighted;
    uint32_t id = SLI_SECTION_D;
#define SLI_ADD(word, array, count, used) sli_saved_add(f, id++, word, F->array, count, used)
    f->first_number = (sl_int)f->header.sections;
    SLI_ADD(8, D, n, n);
    SLI_ADD(8, E, paired, paired);
    SLI_ADD(8, divisors, divisors, paired > 0 || g->is_centered ? divisors : 0);
    SLI_ADD(24, extents, supers, supers);
    SLI_ADD(1, rule.signs, regularized, g->has_signs ? n : 0);
    SLI_ADD(8, rule.shifts, regularized, regularized);
    SLI_ADD(4, rule.regularized, regularized, (uint64_t)g->regularized);
    SLI_ADD(4, null.pivots, skipped, (uint64_t)g->nulls);
    SLI_ADD(1, rule.kinds, skipped, skipped);
    SLI_ADD(8, null.z, vectors, vectors);
    SLI_ADD(8, null.g, vectors, g->nulls > 0 ? vectors : 0);
    SLI_ADD(4, null.anchors, trees, anchors);
    SLI_ADD(8, null.squares, trees, anchors);
    SLI_ADD(8, null.mass, weighted, weighted);
    SLI_ADD(8, null.center, centers, g->is_centered ? centers : 0);
    SLI_ADD(8, null.ratios, trees, anchors);
    if (g->storage != SL_STORAGE_DOUBLE) {
        SLI_ADD(8, values, 0, 0);
        SLI_ADD(4, values, panels, panels);
    } else {
        SLI_ADD(8, values, panels, panels);
    }
#undef SLI_ADD
}

/* The bytes that a region takes in each of its sections. */
static void sli_saved_region_bytes(const sli_saved_region *record, uint64_t *bytes) {
    bytes[0] = sizeof *record;
    bytes[1] = sli_round_up(4 * (uint64_t)record->roots);
    bytes[2] = sli_round_up(4 * (uint64_t)record->rows);
    bytes[3] = 8 * (uint64_t)sli_region_entries((sl_int)record->rows);
}

static sli_saved_region sli_saved_region_of(const sl_region *R) {
    sli_saved_region record;
    SLI_CLEAR(record);
    record.roots = R->extent.n_roots;
    record.rows = R->extent.n_rows;
    record.is_copied = R->is_copied;
    return record;
}

/* Appends the sections of regions, which are written one after the other; returns 0 if their size
 * is out of range. */
static int sli_saved_add_regions(sli_saved *f, const sl_saved_set *set) {
    const uint32_t first = f->header.sections + 1;
    sl_int k;
    int m;
    f->regions.count = set->n_regions;
    f->set = set;
    for (m = 0; m < SLI_REGION_SECTIONS; m++) {
        sli_saved_add(f, (uint32_t)SLI_SECTION_REGIONS + (uint32_t)m, sli_region_words[m],
                      m == 0 ? &f->regions : NULL, m == 0 ? sizeof f->regions / 8 : 0,
                      m == 0 ? sizeof f->regions / 8 : 0);
    }
    for (k = 0; k < set->n_regions; k++) {
        const sli_saved_region record = sli_saved_region_of(set->regions[k]);
        uint64_t bytes[SLI_REGION_SECTIONS - 1];
        sli_saved_region_bytes(&record, bytes);
        for (m = 0; m < SLI_REGION_SECTIONS - 1; m++) {
            f->table[first + (uint32_t)m].bytes += bytes[m];
        }
        if (f->table[first + 3].bytes >> 62 != 0) { /* untested: 2^62 bytes */
            return 0;                               /* untested: the same */
        }
    }
    return 1;
}

/* Appends the sections of a selected inverse. */
static void sli_saved_add_selected(sli_saved *f, const sl_selected *Z) {
    const uint64_t count = (uint64_t)Z->traversal.forest.count, entries = (uint64_t)Z->begin[count];
    const uint64_t counts[SLI_SELECTED_SECTIONS] = {sizeof f->selected / 8, count, count + 1,
                                                    entries};
    const void *data[SLI_SELECTED_SECTIONS];
    int m;
    f->selected.count = (int64_t)count;
    data[0] = &f->selected;
    data[1] = Z->traversal.supers;
    data[2] = Z->begin;
    data[3] = Z->Z;
    for (m = 0; m < SLI_SELECTED_SECTIONS; m++) {
        sli_saved_add(f, (uint32_t)SLI_SECTION_SELECTED + (uint32_t)m, sli_selected_words[m],
                      data[m], counts[m], counts[m]);
    }
}

/* Appends the sections of an analysis and a factor to the empty table, from their numbers and,
 * where they are known, their arrays. */
SLI_COLD static void sli_saved_add_base(sli_saved *f, const sl_symbolic *S, const sl_factor *F,
                                        int has_factor) {
    f->header.sections = 0;
    sli_saved_add(f, SLI_SECTION_ANALYSIS, 8, &f->analysis, sizeof f->analysis / 8,
                  sizeof f->analysis / 8);
    sli_saved_add(f, SLI_SECTION_FACTOR, 8, &f->factor, has_factor ? sizeof f->factor / 8 : 0,
                  has_factor ? sizeof f->factor / 8 : 0);
    sli_saved_add_analysis(f, S);
    sli_saved_add_factor(f, F, has_factor);
}

/* Places the sections of the table in the file. Returns 0 if the sizes overflow. */
static int sli_saved_place(sli_saved *f) {
    const uint64_t limit = UINT64_C(1) << 62;
    uint64_t at = sli_saved_prefix(f);
    uint32_t k;
    for (k = 0; k < f->header.sections; k++) {
        f->table[k].offset = at;
        at += sli_round_up(f->table[k].bytes);
        if (at >= limit) {
            return 0;
        }
    }
    f->header.bytes = at;
    return 1;
}

/* A checksum in progress: that of a sequence of bytes, in which zeros fill up each piece to a
 * multiple of 64 bytes. */
typedef struct sli_checksum {
    uint64_t chain[4];
    uint64_t bytes;
} sli_checksum;

static sli_checksum sli_checksum_begin(void) {
    const sli_hash none = {0, 0};
    sli_checksum c;
    sli_hash_begin(none, c.chain);
    c.bytes = 0;
    return c;
}

SLI_HOT static void sli_checksum_add(sli_checksum *c, const void *data, size_t bytes) {
    (void)sli_hash_stripes(c->chain, data, bytes, SLI_HASH_BYTES, 0);
    c->bytes += sli_round_up(bytes);
}

static uint64_t sli_checksum_end(const sli_checksum *c) {
    const sli_hash h = sli_hash_end(c->chain, c->bytes);
    return h.a ^ h.b;
}

/* The checksum of the header and the table, whose bytes are given. */
static uint64_t sli_prefix_checksum(const unsigned char *prefix, size_t bytes) {
    sli_checksum c = sli_checksum_begin();
    sli_saved_header header;
    memcpy(&header, prefix, sizeof header);
    header.checksum = 0;
    sli_checksum_add(&c, &header, sizeof header);
    sli_checksum_add(&c, prefix + sizeof header, bytes - sizeof header);
    return sli_checksum_end(&c);
}

static const char sli_set_reserved[] =
    "a reserved field of set is not NULL: is the set initialized?";

/* Has the caller set fields of a later version? */
static int sli_set_has_more(const sl_saved_set *set) {
    size_t k;
    int has_more = 0;
    for (k = 0; k < sizeof set->reserved / sizeof set->reserved[0]; k++) {
        has_more |= set->reserved[k] != NULL;
    }
    return has_more;
}

#endif
