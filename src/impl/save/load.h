/* load.h: reads the table, an analysis and a factor from saved bytes, as copies or in place */
#ifndef SLI_SAVE_LOAD_H
#define SLI_SAVE_LOAD_H

#include "check.h"
#include "decode.h"

/* Saved objects that are being read, from the first byte to the last. */
typedef struct sli_reading {
    const unsigned char *memory; /* all bytes; NULL: they are read from the file */
    FILE *file;
    uint64_t size, at; /* bytes in all, and read so far */
    int is_mapped;     /* the objects use the memory itself */
    int swapped;       /* the bytes have the other order */
    unsigned flags;    /* sl_load_flag */
    const sl_options *opt;
    sl_allocator allocator;
    sli_saved saved; /* with the table that was read */
    sl_symbolic S;   /* drafts of the objects */
    sl_factor F;
    int has_factor;
    uint32_t first_region, first_selected; /* sections; 0: none */
} sli_reading;

/* Copies the next bytes. */
static sl_status sli_get(sli_reading *r, void *to, uint64_t bytes) {
    if (bytes > r->size - r->at) {
        return sli_truncated();
    }
    if (r->memory != NULL) {
        memcpy(to, r->memory + r->at, (size_t)bytes);
    } else if (fread(to, 1, (size_t)bytes, r->file) != (size_t)bytes) {
        return ferror(r->file) ? sli_file_fails("the file cannot be read") : sli_truncated();
    }
    r->at += bytes;
    return SL_OK;
}

/* Reads and verifies the header and the table. */
static sl_status sli_read_table(sli_reading *r) {
    unsigned char prefix[sizeof(sli_saved_header) + SLI_SECTIONS_MAX * sizeof(sli_section)];
    sli_saved_header *h = &r->saved.header;
    const size_t first = r->size < sizeof *h ? (size_t)r->size : sizeof *h;
    sl_status status = sli_get(r, prefix, first);
    size_t size;
    uint32_t k;
    if (status == SL_OK && first < sizeof *h) {
        return memcmp(prefix, sli_saved_magic, first < sizeof h->magic ? first : sizeof h->magic) ==
                       0
                   ? sli_truncated()
                   : sli_not_saved();
    }
    if (status != SL_OK) {
        return status;
    }
    memcpy(h, prefix, sizeof *h);
    status = sli_decode_header(h, &r->swapped);
    if (status != SL_OK) {
        return status;
    }
    size = (size_t)sli_saved_prefix(&r->saved);
    if (h->bytes != r->size) {
        return h->bytes > r->size ? sli_truncated() : sli_damaged();
    }
    status = sli_get(r, prefix + sizeof *h, size - sizeof *h);
    if (status != SL_OK || sli_prefix_checksum(prefix, size) != h->checksum) {
        return status != SL_OK ? status : sli_damaged_sum();
    }
    memcpy(r->saved.table, prefix + sizeof *h, h->sections * sizeof(sli_section));
    for (k = 0; k < h->sections && r->swapped; k++) {
        sli_swap_words(&r->saved.table[k].id, 4, 8);
        sli_swap_words(&r->saved.table[k].offset, 8, 24);
    }
    return SL_OK;
}

/* Do the sections from k on have these ids and words? Their lengths are checked when they are
 * read. */
static int sli_sections_are(const sli_saved *f, uint32_t k, uint32_t id, const uint32_t *words,
                            uint32_t count) {
    uint32_t m;
    if (f->header.sections - k < count) {
        return 0;
    }
    for (m = 0; m < count; m++) {
        if (f->table[k + m].id != id + m || f->table[k + m].word != words[m]) {
            return 0;
        }
    }
    return 1;
}

/* Is the table the one that objects of these sizes have? All sections follow each other. Regions
 * and a selected inverse come after the factor, and what a later version adds comes last. Finds
 * the sections of regions and selected inverse; 0: none. */
static int sli_table_is_expected(const sli_saved *f, const sli_saved *expected,
                                 uint32_t *first_region, uint32_t *first_selected) {
    uint32_t k, known = expected->header.sections;
    uint64_t at = sli_saved_prefix(f);
    *first_region = *first_selected = 0;
    if (f->header.sections < known) {
        return 0;
    }
    for (k = 0; k < f->header.sections; k++) {
        const sli_section *s = &f->table[k], *e = &expected->table[k];
        if (s->offset != at || s->bytes > f->header.bytes - at ||
            (k < known && (s->id != e->id || s->word != e->word || s->bytes != e->bytes))) {
            return 0;
        }
        at += sli_round_up(s->bytes);
        if (at > f->header.bytes) {
            return 0;
        }
    }
    if (f->header.write_version > SLI_WRITE_VERSION_PLAIN) {
        if (sli_sections_are(f, known, SLI_SECTION_REGIONS, sli_region_words,
                             SLI_REGION_SECTIONS)) {
            *first_region = known;
            known += SLI_REGION_SECTIONS;
        }
        if (sli_sections_are(f, known, SLI_SECTION_SELECTED, sli_selected_words,
                             SLI_SELECTED_SECTIONS)) {
            *first_selected = known;
            known += SLI_SELECTED_SECTIONS;
        }
    }
    return at == f->header.bytes &&
           (f->header.sections == known || f->header.write_version > SLI_WRITE_VERSION);
}

/* Checks the checksum of section k if `always` or if all are requested, and gives its words the
 * byte order of this processor. */
static int sli_section_accept(const sli_reading *r, sl_int k, void *data, int always) {
    const sli_section *section = &r->saved.table[k];
    if (always || (r->flags & SL_LOAD_VERIFIED) != 0) {
        sli_checksum sum = sli_checksum_begin();
        sli_checksum_add(&sum, data, (size_t)sli_round_up(section->bytes));
        if (sli_checksum_end(&sum) != section->checksum) {
            return 0;
        }
    }
    if (r->swapped) {
        sli_swap_words(data, section->word, section->bytes);
    }
    return 1;
}

/* Reads the numbers of an object, section k. They are few, and always verified. */
static sl_status sli_read_numbers(sli_reading *r, sl_int k, void *numbers, size_t bytes) {
    const sli_section *section = &r->saved.table[k];
    const int fits = section->bytes == bytes && section->offset == r->at && section->word == 8;
    const sl_status status = fits ? sli_get(r, numbers, bytes) : sli_damaged();
    return status == SL_OK && !sli_section_accept(r, k, numbers, 1) ? sli_damaged_sum() : status;
}

/* Reads everything before the arrays: afterwards all sizes are known, and each array is inside the
 * file. */
static sl_status sli_read_front(sli_reading *r) {
    sli_saved expected, *f = &r->saved;
    sl_status status = sli_read_table(r);
    if (status == SL_OK && f->header.sections < 2) {
        return sli_damaged();
    }
    status = status == SL_OK ? sli_read_numbers(r, 0, &f->analysis, sizeof f->analysis) : status;
    if (status != SL_OK || !sli_decode_analysis(&f->analysis, &r->S)) {
        return status != SL_OK ? status : sli_damaged();
    }
    r->F.type = sli_storage_type_of(SL_STORAGE_DOUBLE);
    r->has_factor = f->table[1].bytes > 0;
    if (r->has_factor) {
        status = sli_read_numbers(r, 1, &f->factor, sizeof f->factor);
        if (status != SL_OK || !sli_decode_factor(&f->factor, &r->S, &r->F)) {
            return status != SL_OK ? status : sli_damaged();
        }
        if (r->F.type == NULL) {                  /* untested: all storages are there */
            return sli_refuse(SL_ERR_UNSUPPORTED, /* untested: the same */
                              sli_storage_needs(SL_STORAGE_FLOAT)); /* untested: the same */
        }
        if (f->factor.skips_null && !sli_skips_nulls(&r->F)) { /* branches untested: as above */
            return sli_refuse(SL_ERR_UNSUPPORTED,              /* untested: null spaces are there */
                              "a factor with null pivots: compiled with SL_NO_SINGULAR");
        }
    }
    if ((r->F.type->storage != SL_STORAGE_DOUBLE) !=
        (f->header.read_version > SLI_READ_VERSION_DOUBLE)) {
        return sli_damaged();
    }
    SLI_CLEAR(expected);
    expected.analysis = f->analysis;
    expected.factor = f->factor;
    sli_saved_add_base(&expected, &r->S, &r->F, r->has_factor);
    if (!sli_saved_place(&expected) ||
        !sli_table_is_expected(f, &expected, &r->first_region, &r->first_selected)) {
        return sli_damaged();
    }
    f->first_array = expected.first_array;
    f->first_number = expected.first_number;
    return SL_OK;
}

/* The arrays of one object: sections first .. last-1, contiguous in the file and in memory. */
typedef struct sli_image {
    sl_int first, last;
    size_t head, bytes;   /* of the object's struct, and of the arrays */
    unsigned char *block; /* the struct, and the arrays unless they are mapped */
    unsigned char *arrays;
} sli_image;

/* Allocates an object and reads its arrays, or finds them in the mapped memory. */
static sl_status sli_read_image(sli_reading *r, sli_image *m) {
    sl_status status = SL_OK;
    sl_int k;
    m->head = (size_t)sli_round_up(m->head);
    m->block = (unsigned char *)sli_alloc(&r->allocator, m->head + (r->is_mapped ? 0 : m->bytes));
    if (m->block == NULL) {
        return sli_no_memory();
    }
    m->arrays = m->block + m->head;
    if (r->is_mapped) {
        m->arrays = (unsigned char *)(uintptr_t)(r->memory + r->at);
        r->at += m->bytes;
    } else {
        status = sli_get(r, m->arrays, m->bytes);
    }
    for (k = m->first; k < m->last && status == SL_OK; k++) {
        unsigned char *data =
            m->arrays + (r->saved.table[k].offset - r->saved.table[m->first].offset);
        status = sli_section_accept(r, k, data, 0) ? SL_OK : sli_damaged_sum();
    }
    if (status != SL_OK) {
        sli_free(&r->allocator, m->block);
    }
    return status;
}

/* Creates the analysis. */
static sl_status sli_read_analysis(sli_reading *r, sl_symbolic **out) {
    const sli_saved_analysis *a = &r->saved.analysis;
    sl_symbolic *S = &r->S;
    sli_block b = {NULL, 0};
    sli_image m;
    sl_status status;
    sli_symbolic_layout(S, &b, a->rows, a->entries);
    m.first = r->saved.first_array;
    m.last = r->saved.first_number;
    m.head = sizeof *S + (r->is_mapped ? 0 : (size_t)S->n_supers * sizeof(sl_int));
    m.bytes = b.used;
    if (b.used % SLI_ALIGN != 0) {                           /* untested: on 32 bits only */
        return sli_refuse(SL_ERR_TOO_LARGE, "the analysis"); /* untested: the same */
    }
    status = sli_read_image(r, &m);
    if (status != SL_OK) {
        return status;
    }
    b.base = m.arrays;
    b.used = 0;
    sli_symbolic_layout(S, &b, a->rows, a->entries);
    S->allocator = r->allocator;
    S->stats.symbolic.bytes = m.head + m.bytes;
    S->is_partial = r->saved.header.write_version > SLI_WRITE_VERSION;
    if (S->rows_begin[S->n_supers] != a->rows || S->panel_begin[S->n_supers] != a->panels ||
        S->scatter_begin[S->n_supers] != a->entries ||
        ((r->flags & SL_LOAD_TRUSTED) == 0 && !sli_check_analysis(S, a))) {
        sli_free(&r->allocator, m.block);
        return sli_damaged();
    }
    if (!r->is_mapped) {
        S->plain = (sl_int *)(void *)(m.block + sizeof *S);
        sli_fill_plain(S);
    }
    *out = (sl_symbolic *)(void *)m.block;
    **out = *S;
    return SL_OK;
}

/* Creates the factor over an analysis. */
static sl_status sli_read_factor(sli_reading *r, const sl_symbolic *S, sl_factor **out) {
    const sli_saved_factor *g = &r->saved.factor;
    sl_factor *F = &r->F;
    sli_block b = {NULL, 0};
    sli_image m;
    sl_status status;
    F->S = S;
    F->allocator = r->allocator;
    F->is_immutable = r->is_mapped || S->is_partial;
    status = sli_factor_use(F, r->opt);
    sli_factor_layout(F, &b, (int)g->has_mass);
    m.first = r->saved.first_number;
    m.last = m.first + SLI_FACTOR_SECTIONS + (F->type->storage != SL_STORAGE_DOUBLE);
    m.head = sizeof *F;
    m.bytes = b.used;
    if (b.used % SLI_ALIGN != 0) {                           /* untested: on 32 bits only */
        status = sli_refuse(SL_ERR_TOO_LARGE, "the factor"); /* untested: the same */
    }
    status = status == SL_OK ? sli_read_image(r, &m) : status;
    if (status != SL_OK) {
        return status;
    }
    b.base = m.arrays;
    b.used = 0;
    sli_factor_layout(F, &b, (int)g->has_mass);
    F->rule.signs = g->has_signs ? F->rule.signs : NULL;
    F->stats.factor.bytes = m.head + m.bytes;
    if ((r->flags & SL_LOAD_TRUSTED) == 0 && !sli_check_factor(F)) {
        sli_free(&r->allocator, m.block);
        return sli_damaged();
    }
    *out = (sl_factor *)(void *)m.block;
    **out = *F;
    sli_borrow(&S->borrowers);
    return SL_OK;
}

#endif
