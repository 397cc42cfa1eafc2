/* write.h: saves objects in memory or in a file */
#ifndef SLI_SAVE_WRITE_H
#define SLI_SAVE_WRITE_H

#include "file_map.h"
#include "../io/output_file.h"
#include "format.h"

static sli_saved_analysis sli_saved_analysis_of(const sl_symbolic *S) {
    const sl_symbolic_info *info = &S->stats.symbolic;
    sli_saved_analysis a;
    SLI_CLEAR(a);
    a.n = S->n;
    a.supers = S->n_supers;
    a.nodes = S->n_nodes;
    a.nnz_input = S->nnz_input;
    a.rows = S->rows_begin[S->n_supers];
    a.entries = S->scatter_begin[S->n_supers];
    a.panels = S->panel_begin[S->n_supers];
    a.tallest = S->tallest;
    a.widest = S->widest;
    a.triangle = info->triangle;
    a.nnz_l = info->nnz_l;
    a.fundamental = info->supernodes_fundamental;
    a.tree_height = info->tree_height;
    a.components = info->components;
    a.is_pivoted = S->is_pivoted;
    a.pairs = S->n_pairs;
    a.delayed = info->delayed;
    a.pattern[0] = S->pattern.a;
    a.pattern[1] = S->pattern.b;
    a.identity[0] = S->identity.a;
    a.identity[1] = S->identity.b;
    a.flops = info->flops;
    return a;
}

static sli_saved_factor sli_saved_factor_of(const sl_factor *F) {
    const sl_factor_info *info = &F->stats.factor;
    sli_saved_factor g;
    SLI_CLEAR(g);
    g.method = F->method;
    g.skips_null = sli_skips_nulls(F);
    g.has_mass = F->null.mass != NULL;
    g.has_signs = F->rule.regularization != 0.0 && F->rule.signs != NULL;
    g.checks = F->null.checks;
    g.is_centered = F->null.count > 0 && F->null.is_centered;
    g.nulls = F->null.count;
    g.anchors = g.is_centered ? F->null.n_anchors : 0;
    g.positive = info->positive;
    g.negative = info->negative;
    g.null = info->null;
    g.regularized = info->regularized;
    g.weak = info->weak;
    g.regular = info->regular;
    g.pivot_min = info->pivot_min;
    g.pivot_max = info->pivot_max;
    g.entry_max = info->entry_max;
    g.growth = info->growth;
    g.drift = F->history.drift;
    if (F->history.drift > SLI_CHANGE_DRIFT) { /* as an error it is growth times epsilon */
        g.entry_max = F->history.updates > 0 ? fmin(g.entry_max, F->history.scale) : g.entry_max;
        g.growth = fmax(g.growth, F->history.drift / DBL_EPSILON);
    }
    g.null_tolerance = F->rule.null_tolerance;
    g.regularization = F->rule.regularization;
    g.consistency = F->null.consistency;
    g.growth_limit = F->limits.growth;
    g.error_limit = F->limits.error;
    g.identity[0] = F->identity.a;
    g.identity[1] = F->identity.b;
    g.null_vectors = F->null.vectors > 1 ? F->null.vectors : 0;
    g.storage = F->type->storage;
    if (F->certificate.generation == F->generation) {
        g.eta = F->certificate.eta;
        g.certainty = F->certificate.certainty;
    }
    return g;
}

/* Where bytes go: memory or a file. */
typedef struct sli_sink {
    unsigned char *memory;
    FILE *file;
    int has_failed;
} sli_sink;

/* Writes bytes; if to is NULL, adds them to a checksum instead. */
static void sli_put(sli_sink *to, sli_checksum *sum, const void *data, uint64_t bytes) {
    if (to == NULL) {
        sli_checksum_add(sum, data, (size_t)bytes);
    } else if (bytes == 0 || to->has_failed) {
        return;
    } else if (to->file != NULL) {
        to->has_failed = fwrite(data, 1, (size_t)bytes, to->file) != bytes;
    } else {
        memcpy(to->memory, data, (size_t)bytes);
        to->memory += bytes;
    }
}

/* Puts `bytes` bytes, of which `used` are data and the others 0. */
SLI_HOT static void sli_put_filled(sli_sink *to, sli_checksum *sum, const void *data, uint64_t used,
                                   uint64_t bytes) {
    static const unsigned char zeros[128] = {0};
    uint64_t left, piece;
    sli_put(to, sum, data, used);
    for (left = bytes - (to == NULL ? sum->bytes : used); left > 0; left -= piece) {
        piece = left < sizeof zeros ? left : sizeof zeros;
        sli_put(to, sum, zeros, piece);
    }
}

/* Puts a piece of a section, and zeros up to the next multiple of 64 bytes where it is written. */
static void sli_put_piece(sli_sink *to, sli_checksum *sum, const void *data, uint64_t bytes) {
    if (to == NULL) {
        sli_put(to, sum, data, bytes);
    } else {
        sli_put_filled(to, sum, data, bytes, sli_round_up(bytes));
    }
}

/* The pieces of all regions in one of their sections. */
static void sli_put_regions(const sli_saved *f, uint32_t id, sli_sink *to, sli_checksum *sum) {
    sl_int k;
    for (k = 0; k < f->set->n_regions; k++) {
        const sl_region *R = f->set->regions[k];
        const sli_saved_region record = sli_saved_region_of(R);
        if (id == SLI_SECTION_REGION_LIST) {
            sli_put_piece(to, sum, &record, sizeof record);
        } else if (id == SLI_SECTION_REGION_Z) {
            sli_put_piece(to, sum, R->Z, 8 * (uint64_t)sli_region_entries(R->extent.n_rows));
        } else {
            const int is_roots = id == SLI_SECTION_REGION_ROOTS;
            sli_put_piece(to, sum, is_roots ? R->extent.roots : R->extent.rows,
                          4 * (uint64_t)(is_roots ? R->extent.n_roots : R->extent.n_rows));
        }
    }
}

/* Writes section k, or adds it to a checksum. */
SLI_HOT static void sli_put_section(const sli_saved *f, uint32_t k, sli_sink *to,
                                    sli_checksum *sum) {
    const uint32_t id = f->table[k].id;
    if (id > SLI_SECTION_REGIONS && id < SLI_SECTION_SELECTED) {
        sli_put_regions(f, id, to, sum);
    } else {
        sli_put_filled(to, sum, f->data[k], f->used[k], sli_round_up(f->table[k].bytes));
    }
}

/* Do the objects of a set belong together? */
static sl_status sli_save_check(const sl_saved_set *set) {
    const sl_symbolic *S = set->symbolic;
    const sl_factor *F = set->factor;
    const sl_selected *Z = set->selected;
    sl_int k;
    sl_status status =
        sli_argument(S == NULL                                    ? "set.symbolic is NULL"
                     : sli_set_has_more(set)                      ? sli_set_reserved
                     : set->n_regions < 0                         ? "set.n_regions is below 0"
                     : set->n_regions > 0 && F == NULL            ? "regions without set.factor"
                     : set->n_regions > 0 && set->regions == NULL ? "set.regions is NULL"
                                                                  : NULL);
    for (k = 0; status == SL_OK && k < set->n_regions; k++) {
        status = sli_argument(set->regions[k] == NULL ? "a region is NULL" : NULL);
    }
    if (status == SL_OK && S->is_partial) {
        status =
            sli_refuse(SL_ERR_MISMATCH, "an analysis of sl_factor_submatrix, or from a file of a "
                                        "newer version");
    }
    status = status == SL_OK && F != NULL ? sli_factor_has_numbers(F) : status;
    if (status != SL_OK) {
        return status;
    }
    if ((F != NULL && F->S != S) || (Z != NULL && Z->traversal.S != S)) {
        return sli_refuse(SL_ERR_MISMATCH, "the set has objects of different analyses");
    }
    if (Z != NULL && F != NULL && !sli_numbers_are_of(&Z->numbers, F)) {
        return sli_refuse(SL_ERR_STALE, "the selected inverse is not of the present factor");
    }
    for (k = 0; k < set->n_regions; k++) {
        const sl_region *R = set->regions[k];
        if (R->S != S) {
            return sli_refuse(SL_ERR_MISMATCH, "the set has objects of different analyses");
        }
        if (!sli_region_fits(R, F)) {
            return sli_refuse(SL_ERR_STALE, "a region is not of the present factor");
        }
    }
    return SL_OK;
}

/* Checks the arguments of a save and fills in everything but the checksums. */
SLI_COLD static sl_status sli_save_prepare(sli_saved *f, const sl_saved_set *set) {
    const sl_factor *F = set->factor;
    const sl_status status = F != NULL && F->type->storage > SL_STORAGE_FLOAT
                                 ? sli_refuse(SL_ERR_UNSUPPORTED, "SL_STORAGE_COMPLEX is not saved")
                                 : sli_save_check(set);
    sl_factor none;
    int fits = 1;
    memset(f, 0, sizeof *f);
    SLI_CLEAR(none);
    if (status != SL_OK) {
        return status;
    }
    memcpy(f->header.magic, sli_saved_magic, sizeof sli_saved_magic);
    f->header.order_mark = SLI_ORDER_MARK;
    f->header.read_version = SLI_READ_VERSION_DOUBLE;
    f->header.write_version = SLI_WRITE_VERSION_PLAIN;
    if (F != NULL && F->type->storage != SL_STORAGE_DOUBLE) {
        f->header.read_version = SLI_READ_VERSION;
        f->header.write_version = SLI_WRITE_VERSION;
    }
    f->analysis = sli_saved_analysis_of(set->symbolic);
    if (F != NULL) {
        f->factor = sli_saved_factor_of(F);
    }
    sli_saved_add_base(f, set->symbolic, F != NULL ? F : &none, F != NULL);
    if (set->n_regions > 0) {
        f->header.write_version = SLI_WRITE_VERSION;
        memcpy(f->regions.identity, f->factor.identity, sizeof f->regions.identity);
        fits = sli_saved_add_regions(f, set);
    }
    if (set->selected != NULL) {
        f->header.write_version = SLI_WRITE_VERSION;
        f->selected.identity[0] = set->selected->numbers.identity.a;
        f->selected.identity[1] = set->selected->numbers.identity.b;
        sli_saved_add_selected(f, set->selected);
    }
    fits = fits && sli_saved_place(f) && f->header.bytes <= SIZE_MAX; /* untested: 2^62 bytes */
    return fits ? SL_OK                                               /* untested: the same */
                : sli_refuse(SL_ERR_TOO_LARGE, "the saved bytes");    /* untested: the same */
}

/* Computes the checksums, then writes everything. */
SLI_COLD static void sli_save_write(sli_saved *f, sli_sink *to) {
    unsigned char prefix[sizeof(sli_saved_header) + SLI_SECTIONS_MAX * sizeof(sli_section)];
    const size_t size = (size_t)sli_saved_prefix(f);
    uint32_t k;
    for (k = 0; k < f->header.sections; k++) {
        sli_checksum sum = sli_checksum_begin();
        sli_put_section(f, k, NULL, &sum);
        f->table[k].checksum = sli_checksum_end(&sum);
    }
    memset(prefix, 0, sizeof prefix);
    memcpy(prefix, &f->header, sizeof f->header);
    memcpy(prefix + sizeof f->header, f->table, f->header.sections * sizeof(sli_section));
    f->header.checksum = sli_prefix_checksum(prefix, size);
    memcpy(prefix, &f->header, sizeof f->header);
    sli_put(to, NULL, prefix, size);
    for (k = 0; k < f->header.sections; k++) {
        sli_put_section(f, k, to, NULL);
    }
}

SLI_COLD static sl_status sli_save_to_file(sli_saved *f, const char *path, const sl_allocator *a) {
    const int saved = errno;
    sli_output output;
    sli_sink to;
    sl_status status = sli_output_open(&output, path, a);
    if (status == SL_OK) {
        int complete;
        to.memory = NULL;
        to.file = output.file;
        to.has_failed = 0;
        sli_save_write(f, &to);
        complete = !to.has_failed && sli_flush(output.file);
        status = sli_output_close(&output, complete, a);
    }
    errno = saved;
    return status;
}

SL_API sl_status sl_save(const char *path, void *memory, size_t *bytes, const sl_saved_set *set,
                         const sl_options *opt) {
    const sl_allocator a = sli_allocator(opt);
    sli_saved f;
    sli_sink to;
    sl_status status;
    int is_short = 0;
    status = sli_argument(path != NULL && memory != NULL  ? "path and memory are both given"
                          : path == NULL && bytes == NULL ? "path and bytes are NULL"
                          : set == NULL                   ? "set is NULL"
                                        : sli_options_wrong(opt, SLI_READS_NOTHING));
    status = status == SL_OK ? sli_save_prepare(&f, set) : status;
    if (status == SL_OK && path != NULL) {
        status = sli_save_to_file(&f, path, &a);
    }
    if (status == SL_OK && bytes != NULL) {
        is_short = memory != NULL && *bytes < f.header.bytes;
        *bytes = (size_t)f.header.bytes;
        status = sli_argument(is_short ? "memory is smaller than the set" : NULL);
    }
    if (status == SL_OK && memory != NULL) {
        to.memory = (unsigned char *)memory;
        to.file = NULL;
        to.has_failed = 0;
        sli_save_write(&f, &to);
    }
    return status;
}

#endif
