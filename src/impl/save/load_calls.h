/* load_calls.h: loads and maps sets from memory and files; sl_saved_set_free */
#ifndef SLI_SAVE_LOAD_CALLS_H
#define SLI_SAVE_LOAD_CALLS_H

#include "file_map.h"
#include "load_inverse.h"

SL_API void sl_saved_set_free(sl_saved_set *set) {
    sl_int k;
    if (set == NULL) {
        return;
    }
    for (k = 0; k < set->n_regions && set->regions != NULL; k++) {
        sl_region_free(set->regions[k]);
    }
    if (set->regions != NULL) {
        sli_free(&set->allocator, set->regions);
    }
    sl_selected_free(set->selected);
    sl_factor_free(set->factor);
    sl_symbolic_free(set->symbolic);
    memset(set, 0, sizeof *set);
}

/* Reads the objects in their order in the file. */
SLI_COLD static sl_status sli_read(sli_reading *r, sl_saved_set *set) {
    const sl_saved_content wanted = set->wanted;
    sl_status status = sli_read_front(r);
    if (status == SL_OK && r->is_mapped && r->swapped) {
        return sli_refuse(SL_ERR_UNSUPPORTED, "the byte order is not that of this processor: "
                                              "load without SL_LOAD_MAPPED");
    }
    status = status == SL_OK ? sli_read_analysis(r, &set->symbolic) : status;
    if (status == SL_OK && wanted != SL_SAVED_ANALYSIS && r->has_factor) {
        status = sli_read_factor(r, set->symbolic, &set->factor);
    }
    if (status == SL_OK && wanted == SL_SAVED_ALL && r->first_region > 0) {
        status = sli_read_regions(r, set->factor, set);
    }
    if (status == SL_OK && wanted == SL_SAVED_ALL && r->first_selected > 0) {
        status = sli_read_selected(r, set->symbolic, set->factor, &set->selected);
    }
    if (status != SL_OK) {
        sl_saved_set_free(set);
        set->wanted = wanted;
    }
    return status;
}

static sl_status sli_read_path(sli_reading *r, const char *path, sl_saved_set *set) {
    sl_status status;
    r->file = fopen(path, "rb");
    if (r->file == NULL) {
        return sli_file_fails("the file cannot be opened");
    }
    r->size = sli_file_size(r->file);
    status = r->size > 0 ? sli_read(r, set) : sli_refuse(SL_ERR_IO, sli_no_file);
    fclose(r->file);
    return status;
}

static sl_status sli_read_memory(sli_reading *r, const void *memory, size_t bytes,
                                 sl_saved_set *set) {
    r->memory = (const unsigned char *)memory;
    r->size = bytes;
    return sli_read(r, set);
}

static sl_status sli_map_path(sli_reading *r, const char *path, sl_saved_set *set) {
    sli_mapping map;
    sl_status status = sli_map(path, &map);
    if (status == SL_OK) {
        status = sli_read_memory(r, map.bytes, map.size, set);
        if (status == SL_OK) {
            set->symbolic->backing.release = sli_unmap;
            set->symbolic->backing.bytes = map.bytes;
            set->symbolic->backing.size = map.size;
        } else {
            sli_unmap(map.bytes, map.size);
        }
    }
    return status;
}

/* What is wrong with where a set is loaded from, or NULL. */
static const char *sli_load_wrong(const char *path, const void *memory, unsigned flags) {
    const unsigned both = SL_LOAD_TRUSTED | SL_LOAD_VERIFIED;
    return (flags & ~(both | SL_LOAD_MAPPED)) != 0 ? "flags has a bit that is not of sl_load_flag"
           : (flags & both) == both                ? "SL_LOAD_TRUSTED excludes SL_LOAD_VERIFIED"
           : path == NULL && memory == NULL        ? "path and memory are both NULL"
           : path != NULL && memory != NULL        ? "path and memory are both given"
           : path == NULL && (flags & SL_LOAD_MAPPED) != 0 && (uintptr_t)memory % SLI_ALIGN != 0
               ? "memory is not aligned to 64 bytes"
               : NULL;
}

SL_API sl_status sl_load(sl_saved_set *set, const char *path, const void *memory, size_t bytes,
                         unsigned flags, const sl_options *opt) {
    const int saved = errno;
    const char *wrong;
    sl_saved_content wanted;
    int has_more;
    sli_reading r;
    sl_status status;
    if (set == NULL) {
        return sli_argument("set is NULL");
    }
    errno = 0;
    wanted = set->wanted;
    has_more = sli_set_has_more(set);
    memset(set, 0, sizeof *set);
    set->wanted = wanted;
    wrong = has_more ? sli_set_reserved
            : (unsigned)wanted > (unsigned)SL_SAVED_ANALYSIS
                ? "set.wanted is not a value of sl_saved_content: is the set initialized?"
                : sli_load_wrong(path, memory, flags);
    status = sli_argument(wrong != NULL ? wrong : sli_options_wrong(opt, SLI_READS_ISA));
    if (status == SL_OK) {
        SLI_CLEAR(r);
        r.flags = flags;
        r.opt = opt;
        r.allocator = sli_allocator(opt);
        r.is_mapped = (flags & SL_LOAD_MAPPED) != 0;
        status = path == NULL  ? sli_read_memory(&r, memory, bytes, set)
                 : r.is_mapped ? sli_map_path(&r, path, set)
                               : sli_read_path(&r, path, set);
    }
    errno = saved;
    return status;
}

#endif
