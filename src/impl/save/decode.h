/* decode.h: from the bytes of a header, a table and numbers to what they mean; byte order */
#ifndef SLI_SAVE_DECODE_H
#define SLI_SAVE_DECODE_H

#include "format.h"

SLI_INLINE void sli_swap(unsigned char *at, int bytes) {
    int k;
    for (k = 0; k < bytes / 2; k++) {
        const unsigned char keep = at[k];
        at[k] = at[bytes - 1 - k];
        at[bytes - 1 - k] = keep;
    }
}

/* Reverses the byte order of an array of words. */
static void sli_swap_words(void *data, uint32_t word, uint64_t bytes) {
    unsigned char *at = (unsigned char *)data, *end = at + bytes;
    for (; word > 1 && at < end; at += word) {
        uint32_t k = word == 4 ? 0 : 8; /* where the words of 4 bytes begin */
        sli_swap(at, word == 4 ? 4 : 8);
        if (word == 24) { /* an sli_extent: two reals and two numbers; an sli_step: one and six */
            sli_swap(at + k, 8);
            k += 8;
        }
        for (; word > 8 && k < word; k += 4) {
            sli_swap(at + k, 4);
        }
    }
}

SLI_COLD static sl_status sli_not_saved(void) {
    return sli_refuse(SL_ERR_UNSUPPORTED, "not a saved factor");
}

SLI_COLD static sl_status sli_truncated(void) {
    return sli_refuse(SL_ERR_IO, "truncated: bytes are missing at its end");
}

SLI_COLD static sl_status sli_damaged(void) {
    return sli_refuse(SL_ERR_IO, "damaged: sizes, numbers or indices are inconsistent");
}

/* The same, found by a checksum. */
SLI_COLD static sl_status sli_damaged_sum(void) {
    return sli_refuse(SL_ERR_IO, "damaged: a checksum is wrong");
}

/* Reads the header: is it that of a file that this library can read? *swapped: it has the other
 * byte order. */
static sl_status sli_decode_header(sli_saved_header *h, int *swapped) {
    if (memcmp(h->magic, sli_saved_magic, sizeof sli_saved_magic) != 0 ||
        (h->order_mark != SLI_ORDER_MARK && h->order_mark != SLI_ORDER_MARK_SWAPPED)) {
        return sli_not_saved();
    }
    *swapped = h->order_mark != SLI_ORDER_MARK;
    if (*swapped) {
        sli_swap_words(&h->order_mark, 4, 16);
        sli_swap_words(&h->bytes, 8, 16);
    }
    if (h->read_version < 1 || h->read_version > SLI_READ_VERSION) {
        return sli_refuse(SL_ERR_UNSUPPORTED, "a newer version of the library has saved it");
    }
    return h->sections <= SLI_SECTIONS_MAX ? SL_OK : sli_damaged();
}

/* Is a count in 0..most? */
SLI_INLINE int sli_count_is_valid(int64_t count, int64_t most) {
    return count >= 0 && count <= most;
}

/* Numbers of an analysis that no analysis has are refused here, so that sizes can be computed from
 * them. */
static int sli_decode_analysis(const sli_saved_analysis *a, sl_symbolic *S) {
    const int64_t many = INT64_C(1) << 58; /* 8 bytes each fit a positive int64_t */
    sl_symbolic_info *info = &S->stats.symbolic;
    if (!sli_count_is_valid(a->n, SLI_ROWS_MAX) || !sli_count_is_valid(a->supers, a->n) ||
        (a->n > 0) != (a->supers > 0) || !sli_count_is_valid(a->nodes, a->n + 1) ||
        !sli_count_is_valid(a->nnz_input, INT32_MAX) || !sli_count_is_valid(a->rows, many) ||
        !sli_count_is_valid(a->entries, a->nnz_input) || !sli_count_is_valid(a->panels, many) ||
        !sli_count_is_valid(a->tallest, a->n) || !sli_count_is_valid(a->widest, a->n) ||
        !sli_count_is_valid(a->triangle, SL_TRIANGLE_BOTH) || !sli_count_is_valid(a->nnz_l, many) ||
        !sli_count_is_valid(a->fundamental, a->n) || !sli_count_is_valid(a->tree_height, a->n) ||
        !sli_count_is_valid(a->components, a->n) || !sli_count_is_valid(a->is_pivoted, 1) ||
        !sli_count_is_valid(a->pairs, a->is_pivoted ? a->n / 2 : 0) ||
        !sli_count_is_valid(a->delayed, a->is_pivoted ? INT32_MAX : 0) || !(a->flops >= 0.0) ||
        !sli_is_finite(a->flops)) {
        return 0;
    }
    S->n = (sl_int)a->n;
    S->n_supers = (sl_int)a->supers;
    S->n_nodes = (sl_int)a->nodes;
    S->nnz_input = (sl_int)a->nnz_input;
    S->is_pivoted = (int)a->is_pivoted;
    S->n_pairs = (sl_int)a->pairs;
    S->tallest = (sl_int)a->tallest;
    S->widest = (sl_int)a->widest;
    S->pattern.a = a->pattern[0];
    S->pattern.b = a->pattern[1];
    S->identity.a = a->identity[0];
    S->identity.b = a->identity[1];
    info->n = S->n;
    info->triangle = (sl_triangle)a->triangle;
    info->nnz_a = a->entries;
    info->nnz_l = a->nnz_l;
    info->nnz_panels = a->panels;
    info->flops = a->flops;
    info->supernodes = S->n_supers;
    info->supernodes_fundamental = (sl_int)a->fundamental;
    info->tree_height = (sl_int)a->tree_height;
    info->components = (sl_int)a->components;
    info->pairs = S->n_pairs;
    info->delayed = (sl_int)a->delayed;
    return 1;
}

/* Are the numbers of a saved factor those of one that options can make? */
static int sli_saved_factor_is_valid(const sli_saved_factor *g, const sl_symbolic *S) {
    const int skips = g->skips_null != 0;
    const int64_t n = S->n;
    return !(
        (g->method != SL_METHOD_UP_LOOKING && g->method != SL_METHOD_SUPERNODAL) ||
        !sli_count_is_valid(g->skips_null, 1) || !sli_count_is_valid(g->has_mass, skips) ||
        !sli_count_is_valid(g->checks, skips) || !sli_count_is_valid(g->nulls, skips ? n : 0) ||
        g->null != g->nulls || !sli_count_is_valid(g->is_centered, g->nulls > 0 && g->has_mass) ||
        !sli_count_is_valid(g->anchors, g->is_centered ? S->stats.symbolic.components : 0) ||
        !(g->regularization >= 0.0) || !sli_is_finite(g->regularization) ||
        (skips && (g->regularization != 0.0 || S->is_pivoted)) ||
        (S->n_pairs > 0 && g->method != SL_METHOD_SUPERNODAL) || !(g->growth_limit > 0.0) ||
        !(g->error_limit > 0.0) || !(g->growth >= 0.0) || !(g->entry_max >= 0.0) ||
        !sli_count_is_valid(g->has_signs, g->regularization != 0.0) ||
        !sli_count_is_valid(g->regularized, g->regularization != 0.0 ? n : 0) ||
        !sli_count_is_valid(g->positive, n) || !sli_count_is_valid(g->negative, n) ||
        !sli_count_is_valid(g->weak, n) || !sli_count_is_valid(g->regular, n) ||
        !sli_count_is_valid(g->null_vectors, skips ? SLI_NULL_VECTORS_MAX : 1) ||
        !sli_count_is_valid(g->storage, g->method == SL_METHOD_SUPERNODAL ? SL_STORAGE_FLOAT : 0) ||
        !sli_count_is_valid(g->certainty, SL_GUARANTEED) || !(g->eta >= 0.0) || g->eta > 1.0 ||
        !(g->drift >= 0.0) || g->null_tolerance != g->null_tolerance ||
        g->consistency != g->consistency);
}

static int sli_decode_factor(const sli_saved_factor *g, const sl_symbolic *S, sl_factor *F) {
    const int skips = g->skips_null != 0;
    sl_factor_info *info = &F->stats.factor;
    if (!sli_saved_factor_is_valid(g, S)) {
        return 0;
    }
    F->S = S;
    F->method = (sl_method)g->method;
    F->type = sli_storage_type_of((sl_storage)g->storage);
    if (F->type == NULL) { /* untested: all storages are there */
        return 1;          /* untested: the same */
    }
    F->null.calls = sli_singular_of(skips);
    F->null.checks = (int)g->checks;
    F->null.is_centered = (int)g->is_centered;
    F->null.count = (sl_int)g->nulls;
    F->null.vectors = sli_max((sl_int)g->null_vectors, 1);
    F->null.n_anchors = (sl_int)g->anchors;
    F->null.consistency = g->consistency;
    F->limits.growth = g->growth_limit;
    F->limits.error = g->error_limit;
    F->rule.null_tolerance = g->null_tolerance;
    F->rule.regularization = g->regularization;
    F->rule.replaces = skips || g->regularization != 0.0;
    F->identity.a = g->identity[0];
    F->identity.b = g->identity[1];
    F->generation = F->certificate.generation = 1;
    F->history.drift = g->drift;
    F->certificate.eta = g->eta;
    F->certificate.certainty = (sl_certainty)g->certainty;
    F->is_valid = 1;
    F->status = SL_OK;
    info->positive = (sl_int)g->positive;
    info->negative = (sl_int)g->negative;
    info->null = (sl_int)g->null;
    info->regularized = (sl_int)g->regularized;
    info->weak = (sl_int)g->weak;
    info->regular = (sl_int)g->regular;
    info->pivot_min = g->pivot_min;
    info->pivot_max = g->pivot_max;
    info->entry_max = g->entry_max;
    info->growth = g->growth;
    return 1;
}

#endif
