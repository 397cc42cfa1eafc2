/* load_inverse.h: reads and checks a saved selected inverse and saved regions */
#ifndef SLI_SAVE_LOAD_INVERSE_H
#define SLI_SAVE_LOAD_INVERSE_H

#include "../inverse/region.h"
#include "load.h"

/* Reads section k to *data, or finds it in the mapped memory. */
static sl_status sli_read_section(sli_reading *r, uint32_t k, void **data) {
    const uint64_t bytes = sli_round_up(r->saved.table[k].bytes);
    sl_status status = SL_OK;
    SLI_ASSERT(r->at == r->saved.table[k].offset);
    if (r->is_mapped) {
        *data = (void *)(uintptr_t)(r->memory + r->at);
        r->at += bytes;
    } else if (bytes > 0) {
        status = sli_get(r, *data, bytes);
    }
    return status == SL_OK && !sli_section_accept(r, (sl_int)k, *data, 0) ? sli_damaged_sum()
                                                                          : status;
}

/* Reads the numbers of section k. Is what they describe of this factor? F NULL: of any. */
static sl_status sli_read_part(sli_reading *r, uint32_t k, const sl_symbolic *S, const sl_factor *F,
                               int64_t most, sli_saved_part *part) {
    const sl_status status = sli_read_numbers(r, (sl_int)k, part, sizeof *part);
    if (status != SL_OK) {
        return status;
    }
    return S->n_pairs == 0 && sli_count_is_valid(part->count, most) &&
                   (F == NULL ||
                    (part->identity[0] == F->identity.a && part->identity[1] == F->identity.b))
               ? SL_OK
               : sli_damaged();
}

/* ---- selected inverse ---- */

/* Does the list of supernodes ascend and contain the parents of all of them, and do the panels
 * follow each other? */
static int sli_check_selected(const sl_symbolic *S, const sl_int *supers, const sl_off *begin,
                              sl_int count) {
    sl_int k;
    if (!sli_check_columns(supers, count, S->n_supers) || begin[0] != 0) {
        return 0;
    }
    for (k = 0; k < count; k++) {
        const sl_int s = supers[k], up = S->super_parent[s];
        const sl_int at = up == -1 ? k : sli_lower_bound(supers, count, up);
        if (at == count || (up != -1 && supers[at] != up) ||
            begin[k + 1] != begin[k] + S->panel_begin[s + 1] - S->panel_begin[s]) {
            return 0;
        }
    }
    return 1;
}

/* Makes the object for these supernodes with memory of its own for the numbers. seeds: count
 * elements of scratch. */
static sl_status sli_selected_of_list(sl_selected **out, sl_selected *draft, const sl_int *supers,
                                      uint64_t *seeds) {
    const sl_symbolic *S = draft->traversal.S;
    const sl_int count = draft->traversal.forest.count;
    sl_status status;
    sl_int k;
    for (k = 0; k < count; k++) {
        seeds[k] = sli_keyed(S->super_first[supers[k]], 0);
    }
    status = sli_selected_plan(out, draft, count < S->n_supers ? seeds : NULL, count);
    if (status == SL_OK) {
        status = sli_selected_alloc_values(*out);
    }
    return status;
}

/* Makes the object over lists in mapped memory. */
static sl_status sli_selected_of_memory(sl_selected **out, sl_selected *draft, sl_int *supers,
                                        sl_off *begin) {
    draft->traversal.supers = supers;
    draft->begin = begin;
    draft->is_mapped = 1;
    draft->bytes = sizeof *draft + sizeof(double) * (size_t)begin[draft->traversal.forest.count];
    *out = (sl_selected *)sli_alloc(&draft->allocator, sizeof *draft);
    if (*out == NULL) {
        return sli_no_memory();
    }
    **out = *draft;
    sli_borrow(&draft->traversal.S->borrowers);
    return SL_OK;
}

/* Reads the lists, makes the object and reads its numbers. lists: scratch, or NULL if they are
 * mapped. */
SLI_COLD static sl_status sli_read_selected_arrays(sli_reading *r, sl_selected **out,
                                                   sl_selected *draft, sli_block *lists) {
    const uint32_t k = r->first_selected;
    const sl_int count = draft->traversal.forest.count;
    const uint64_t bytes = r->saved.table[k + 3].bytes;
    void *supers = lists == NULL ? NULL : SLI_TAKE(lists, sl_int, count);
    void *begin = lists == NULL ? NULL : SLI_TAKE(lists, sl_off, (uint64_t)count + 1);
    uint64_t *seeds = lists == NULL ? NULL : SLI_TAKE(lists, uint64_t, count);
    const sl_off *ends;
    void *values = NULL;
    sl_status status = sli_read_section(r, k + 1, &supers);
    status = status == SL_OK ? sli_read_section(r, k + 2, &begin) : status;
    if (status != SL_OK) {
        return status;
    }
    ends = (const sl_off *)begin;
    if (bytes % sizeof(double) != 0 || (uint64_t)ends[count] != bytes / sizeof(double) ||
        (((r->flags & SL_LOAD_TRUSTED) == 0 || !r->is_mapped) && /* copies use the list at once */
         !sli_check_selected(draft->traversal.S, (const sl_int *)supers, ends, count))) {
        return sli_damaged();
    }
    status = r->is_mapped ? sli_selected_of_memory(out, draft, (sl_int *)supers, (sl_off *)begin)
                          : sli_selected_of_list(out, draft, (const sl_int *)supers, seeds);
    if (status == SL_OK) {
        values = (*out)->Z;
        status = sli_read_section(r, k + 3, &values);
        (*out)->Z = (double *)values;
    }
    return status;
}

/* Creates the selected inverse. On error *out is NULL or to be released. */
SLI_COLD static sl_status sli_read_selected(sli_reading *r, const sl_symbolic *S,
                                            const sl_factor *F, sl_selected **out) {
    const sli_section *table = &r->saved.table[r->first_selected];
    sli_block lists = {NULL, 0};
    sli_saved_part part;
    sl_selected draft;
    sl_status status = sli_read_part(r, r->first_selected, S, F, S->n_supers, &part);
    if (status != SL_OK || table[1].bytes != 4 * (uint64_t)part.count ||
        table[2].bytes != 8 * ((uint64_t)part.count + 1)) {
        return status != SL_OK ? status : sli_damaged();
    }
    SLI_CLEAR(draft);
    draft.allocator = r->allocator;
    draft.is_immutable = r->is_mapped || S->is_partial;
    if (r->opt != NULL) {
        draft.threads = r->opt->threads;
    }
    if (F != NULL) {
        draft.numbers = sli_numbers_of(F);
    } else {
        draft.numbers.identity.a = part.identity[0];
        draft.numbers.identity.b = part.identity[1];
    }
    draft.traversal =
        sli_traversal_of(S, (sl_int)part.count, sli_traversal_workers(S, &draft.threads));
    if (r->is_mapped) {
        return sli_read_selected_arrays(r, out, &draft, NULL);
    }
    (void)SLI_TAKE(&lists, sl_int, part.count);
    (void)SLI_TAKE(&lists, sl_off, (uint64_t)part.count + 1);
    (void)SLI_TAKE(&lists, uint64_t, part.count);
    status = sli_block_alloc(&lists, &r->allocator);
    status = status == SL_OK ? sli_read_selected_arrays(r, out, &draft, &lists) : status;
    sli_free(&r->allocator, lists.base);
    return status;
}

/* ---- regions ---- */

/* Saved regions that are being read: their records and the lists of all of them. */
typedef struct sli_saved_regions {
    sl_int count;
    void *list, *roots, *rows;
} sli_saved_regions;

/* Do the records agree with the lengths of the sections? Each step is bounded by the file. */
static int sli_check_records(const sli_reading *r, const sl_symbolic *S,
                             const sli_saved_regions *q) {
    const sli_section *table = &r->saved.table[r->first_region];
    const sli_saved_region *record = (const sli_saved_region *)q->list;
    uint64_t left[SLI_REGION_SECTIONS - 1], bytes[SLI_REGION_SECTIONS - 1];
    sl_int k;
    int m;
    for (m = 0; m < SLI_REGION_SECTIONS - 1; m++) {
        left[m] = table[m + 1].bytes;
    }
    for (k = 0; k < q->count; k++, record++) {
        if (!sli_count_is_valid(record->roots, S->n_supers) ||
            !sli_count_is_valid(record->rows, S->n) || !sli_count_is_valid(record->is_copied, 1) ||
            4 * (uint64_t)record->rows > left[2]) {
            return 0;
        }
        sli_saved_region_bytes(record, bytes);
        for (m = 0; m < SLI_REGION_SECTIONS - 1; m++) {
            if (bytes[m] > left[m]) {
                return 0;
            }
            left[m] -= bytes[m];
        }
    }
    return left[1] == 0 && left[2] == 0 && left[3] == 0; /* the records are q->count */
}

/* Is the boundary outside of the subtrees, and does it have every row below them? These are the
 * rows below their roots. So no subtree is inside another: it would have rows below in that one.
 * Both lists ascend. */
static int sli_check_extent(const sl_symbolic *S, const sli_region_extent *extent) {
    sl_int k, i;
    for (k = 0; k < extent->n_rows; k++) {
        if (sli_extent_find(S, extent, S->super_of[extent->rows[k]]) != -1) {
            return 0;
        }
    }
    for (k = 0; k < extent->n_roots; k++) {
        const sl_int s = extent->roots[k], *below = S->rows + S->rows_begin[s];
        for (i = 0; i < S->steps[s].below; i++) {
            if (sli_extent_boundary(extent, below[i]) == -1) {
                return 0;
            }
        }
    }
    return 1;
}

/* Creates a region from its record and its lists, all but its numbers. */
static sl_status sli_region_of_lists(const sli_reading *r, const sl_factor *F,
                                     const sli_saved_region *record, const sl_int *roots,
                                     const sl_int *rows, sl_region **out) {
    sli_block b = {NULL, 0};
    sl_status status = SL_OK;
    sl_region draft;
    SLI_CLEAR(draft);
    draft.allocator = r->allocator;
    draft.S = F->S;
    draft.numbers = sli_numbers_of(F);
    draft.extent.n_roots = (sl_int)record->roots;
    draft.extent.n_rows = (sl_int)record->rows;
    draft.extent.roots = roots;
    draft.extent.rows = rows;
    draft.is_copied = (int)record->is_copied;
    draft.is_mapped = r->is_mapped;
    draft.is_immutable = r->is_mapped || F->S->is_partial;
    if (!sli_check_columns(roots, draft.extent.n_roots, F->S->n_supers) ||
        !sli_check_columns(rows, draft.extent.n_rows, F->S->n) ||
        ((r->flags & SL_LOAD_TRUSTED) == 0 && !sli_check_extent(F->S, &draft.extent))) {
        return sli_damaged();
    }
    SLI_LAYOUT(&b, &r->allocator, status) {
        sli_region_layout(&draft, &b);
    }
    if (status == SL_OK) {
        SLI_COPY(draft.roots, roots, draft.extent.n_roots);
        SLI_COPY(draft.rows, rows, draft.extent.n_rows);
        sli_region_index(&draft);
        *out = (sl_region *)(void *)b.base;
        **out = draft;
        sli_borrow(&F->S->borrowers);
    }
    return status;
}

/* Reads the numbers of all regions, or finds them in the mapped memory. */
static sl_status sli_read_regions_numbers(sli_reading *r, const sl_saved_set *set) {
    const uint32_t k = r->first_region + SLI_REGION_SECTIONS - 1;
    const sli_section *section = &r->saved.table[k];
    const int verifies = (r->flags & SL_LOAD_VERIFIED) != 0;
    sli_checksum sum = sli_checksum_begin();
    sl_int m;
    for (m = 0; m < set->n_regions; m++) {
        sl_region *R = set->regions[m];
        const size_t bytes = sizeof(double) * (size_t)R->begin[sli_region_chunks(R->extent.n_rows)];
        if (r->is_mapped) {
            R->Z = (double *)(uintptr_t)(r->memory + r->at);
            R->bytes += bytes;
            r->at += bytes;
        } else if (bytes > 0) {
            const sl_status status = sli_get(r, R->Z, bytes);
            if (status != SL_OK) {
                return status;
            }
        }
        if (verifies) {
            sli_checksum_add(&sum, R->Z, bytes);
        }
        if (r->swapped) {
            sli_swap_words(R->Z, section->word, bytes);
        }
    }
    return verifies && sli_checksum_end(&sum) != section->checksum ? sli_damaged_sum() : SL_OK;
}

/* Creates the regions from their lists. */
static sl_status sli_read_regions_lists(sli_reading *r, const sl_factor *F, sli_saved_regions *q,
                                        sl_saved_set *set) {
    const uint32_t first = r->first_region;
    const sli_saved_region *record;
    const sl_int *roots, *rows;
    sl_status status = sli_read_section(r, first + 1, &q->list);
    sl_int k;
    status = status == SL_OK ? sli_read_section(r, first + 2, &q->roots) : status;
    status = status == SL_OK ? sli_read_section(r, first + 3, &q->rows) : status;
    if (status != SL_OK || !sli_check_records(r, F->S, q)) {
        return status != SL_OK ? status : sli_damaged();
    }
    set->regions = (sl_region **)sli_alloc(&r->allocator, (size_t)q->count * sizeof *set->regions);
    if (set->regions == NULL) {
        return sli_no_memory();
    }
    set->allocator = r->allocator;
    record = (const sli_saved_region *)q->list;
    roots = (const sl_int *)q->roots;
    rows = (const sl_int *)q->rows;
    for (k = 0; k < q->count && status == SL_OK; k++, record++) {
        uint64_t bytes[SLI_REGION_SECTIONS - 1];
        sli_saved_region_bytes(record, bytes);
        status = sli_region_of_lists(r, F, record, roots, rows, &set->regions[k]);
        set->n_regions += status == SL_OK;
        roots += bytes[1] / sizeof *roots;
        rows += bytes[2] / sizeof *rows;
    }
    return status;
}

/* Creates the regions of a factor. On error the set has those that are to be released. */
static sl_status sli_read_regions(sli_reading *r, const sl_factor *F, sl_saved_set *set) {
    const sli_section *table = &r->saved.table[r->first_region];
    sli_block lists = {NULL, 0};
    sli_saved_regions q;
    sli_saved_part part;
    sl_status status;
    SLI_CLEAR(q);
    if (F == NULL || F->null.is_centered) {
        return sli_damaged();
    }
    status = sli_read_part(r, r->first_region, F->S, F, INT32_MAX, &part);
    if (status != SL_OK || part.count == 0 ||
        table[1].bytes != sizeof(sli_saved_region) * (uint64_t)part.count) {
        return status != SL_OK ? status : sli_damaged();
    }
    q.count = (sl_int)part.count;
    if (!r->is_mapped) {
        SLI_LAYOUT(&lists, &r->allocator, status) {
            q.list = SLI_TAKE(&lists, unsigned char, table[1].bytes);
            q.roots = SLI_TAKE(&lists, unsigned char, table[2].bytes);
            q.rows = SLI_TAKE(&lists, unsigned char, table[3].bytes);
        }
    }
    if (status == SL_OK) {
        status = sli_read_regions_lists(r, F, &q, set);
    }
    if (status == SL_OK) {
        status = sli_read_regions_numbers(r, set);
    }
    sli_free(&r->allocator, lists.base);
    return status;
}

#endif
