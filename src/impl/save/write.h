/* write.h: sl_save_bytes, sl_save_memory, sl_save_file */
#ifndef SLI_SAVE_WRITE_H
#define SLI_SAVE_WRITE_H

#include "../matrix/output_file.h"
#include "format.h"

static sli_saved_analysis sli_saved_analysis_of(const sl_symbolic *S) {
    const sl_symbolic_info *info = &S->stats.symbolic;
    sli_saved_analysis a;
    memset(&a, 0, sizeof a);
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
    memset(&g, 0, sizeof g);
    g.method = F->method;
    g.null_pivots = F->null_pivots;
    g.has_mass = F->mass != NULL;
    g.has_signs = F->rule.regularization != 0.0 && F->rule.signs != NULL;
    g.checks = F->checks;
    g.is_centered = F->n_nulls > 0 && F->is_centered;
    g.nulls = F->n_nulls;
    g.anchors = g.is_centered ? F->n_anchors : 0;
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
    g.null_tolerance = F->rule.null_tolerance;
    g.regularization = F->rule.regularization;
    g.consistency = F->consistency;
    g.growth_limit = F->growth_limit;
    g.error_limit = F->error_limit;
    g.identity[0] = F->identity.a;
    g.identity[1] = F->identity.b;
    return g;
}

/* Where bytes go: memory or a file. */
typedef struct sli_sink {
    unsigned char *memory;
    FILE *file;
    int has_failed;
} sli_sink;

static void sli_put(sli_sink *to, const void *data, size_t bytes) {
    if (bytes == 0 || to->has_failed) {
        return;
    }
    if (to->file != NULL) {
        to->has_failed = fwrite(data, 1, bytes, to->file) != bytes;
    } else {
        memcpy(to->memory, data, bytes);
        to->memory += bytes;
    }
}

/* Writes `bytes` bytes, of which `used` are data and the others 0. If to is NULL, adds them to a
 * checksum instead. */
static void sli_put_filled(sli_sink *to, sli_checksum *sum, const void *data, uint64_t used,
                           uint64_t bytes) {
    static const unsigned char zeros[1024] = {0};
    uint64_t left = bytes - used;
    if (to == NULL) {
        sli_checksum_add(sum, data, (size_t)used);
        left = bytes - sum->bytes;
    } else {
        sli_put(to, data, (size_t)used);
    }
    while (left > 0) {
        const size_t piece = left < sizeof zeros ? (size_t)left : sizeof zeros;
        if (to == NULL) {
            sli_checksum_add(sum, zeros, piece);
        } else {
            sli_put(to, zeros, piece);
        }
        left -= piece;
    }
}

/* Checks the arguments of a save and fills in everything but the checksums. */
static sl_status sli_save_prepare(sli_saved *f, const sl_symbolic *S, const sl_factor *F) {
    sl_factor none;
    memset(f, 0, sizeof *f);
    memset(&none, 0, sizeof none);
    if (S == NULL) {
        return SL_ERR_ARGUMENT;
    }
    if (S->is_partial || (F != NULL && (!F->is_valid || !sli_factor_is_over(F, S, S->identity)))) {
        return SL_ERR_STATE;
    }
    memcpy(f->header.magic, sli_saved_magic, sizeof sli_saved_magic);
    f->header.order_mark = SLI_ORDER_MARK;
    f->header.read_version = SLI_READ_VERSION;
    f->header.write_version = SLI_WRITE_VERSION;
    f->analysis = sli_saved_analysis_of(S);
    if (F != NULL) {
        f->factor = sli_saved_factor_of(F);
    }
    return sli_saved_table(f, S, F != NULL ? F : &none, F != NULL) && f->header.bytes <= SIZE_MAX
               ? SL_OK
               : SL_ERR_TOO_LARGE;
}

/* Computes the checksums, then writes everything. */
static void sli_save_write(sli_saved *f, sli_sink *to) {
    unsigned char prefix[sizeof(sli_saved_header) + SLI_SECTIONS_MAX * sizeof(sli_section)];
    const size_t size = (size_t)sli_saved_prefix(f);
    uint32_t k;
    for (k = 0; k < f->header.sections; k++) {
        sli_checksum sum = sli_checksum_begin();
        sli_put_filled(NULL, &sum, f->data[k], f->used[k], sli_round_up(f->table[k].bytes));
        f->table[k].checksum = sli_checksum_end(&sum);
    }
    memset(prefix, 0, sizeof prefix);
    memcpy(prefix, &f->header, sizeof f->header);
    memcpy(prefix + sizeof f->header, f->table, f->header.sections * sizeof(sli_section));
    f->header.checksum = sli_prefix_checksum(prefix, size);
    memcpy(prefix, &f->header, sizeof f->header);
    sli_put(to, prefix, size);
    for (k = 0; k < f->header.sections; k++) {
        sli_put_filled(to, NULL, f->data[k], f->used[k], sli_round_up(f->table[k].bytes));
    }
}

SL_API sl_status sl_save_bytes(size_t *bytes, const sl_symbolic *S, const sl_factor *F) {
    sli_saved f;
    sl_status status;
    if (bytes == NULL) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_save_prepare(&f, S, F);
    if (status == SL_OK) {
        *bytes = (size_t)f.header.bytes;
    }
    return status;
}

SL_API sl_status sl_save_memory(void *memory, size_t bytes, const sl_symbolic *S,
                                const sl_factor *F) {
    sli_saved f;
    sli_sink to;
    sl_status status = sli_save_prepare(&f, S, F);
    if (status == SL_OK && (memory == NULL || bytes < f.header.bytes)) {
        status = SL_ERR_ARGUMENT;
    }
    if (status == SL_OK) {
        to.memory = (unsigned char *)memory;
        to.file = NULL;
        to.has_failed = 0;
        sli_save_write(&f, &to);
    }
    return status;
}

SL_API sl_status sl_save_file(const char *path, const sl_symbolic *S, const sl_factor *F,
                              const sl_options *opt) {
    const int saved = errno;
    const sl_allocator a = sli_allocator(opt);
    sli_output output;
    sli_saved f;
    sli_sink to;
    sl_status status;
    if (path == NULL || !sli_options_are_valid(opt, SLI_READS_NOTHING)) {
        return SL_ERR_ARGUMENT;
    }
    status = sli_save_prepare(&f, S, F);
    status = status == SL_OK ? sli_output_open(&output, path, &a) : status;
    if (status == SL_OK) {
        int complete;
        to.memory = NULL;
        to.file = output.file;
        to.has_failed = 0;
        sli_save_write(&f, &to);
        complete = !to.has_failed && sli_flush(output.file);
        status = sli_output_close(&output, complete, &a) ? SL_OK : SL_ERR_IO;
    }
    errno = saved;
    return status;
}

#endif
