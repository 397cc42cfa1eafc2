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
                                              "sl_load_file");
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

/* Where the bytes are: in memory, which may be used in place, or in a file. */
typedef struct sli_origin {
    const void *memory;
    size_t bytes;
    const char *path; /* NULL: in memory */
    int is_mapped;
} sli_origin;

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

/* Checks the arguments and reads. */
static sl_status sli_read_set(const sli_origin *from, sl_saved_set *set, sl_load_checks checks,
                              const sl_options *opt) {
    const int saved = errno;
    const int is_file = from->path != NULL;
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
    status = sli_argument(
        has_more ? sli_set_reserved
        : (unsigned)wanted > (unsigned)SL_SAVED_ANALYSIS
            ? "set.wanted is not a value of sl_saved_content: is the set initialized?"
        : (unsigned)checks > (unsigned)SL_LOAD_VERIFIED ? "checks is not a value of sl_load_checks"
        : !is_file && from->memory == NULL              ? "path or memory is NULL"
        : !is_file && from->is_mapped && (uintptr_t)from->memory % SLI_ALIGN != 0
            ? "memory is not aligned to 64 bytes"
            : sli_options_wrong(opt, SLI_READS_ISA));
    if (status != SL_OK) {
        errno = saved;
        return status;
    }
    SLI_CLEAR(r);
    r.checks = checks;
    r.opt = opt;
    r.allocator = sli_allocator(opt);
    r.is_mapped = from->is_mapped;
    if (!is_file) {
        status = sli_read_memory(&r, from->memory, from->bytes, set);
    } else if (from->is_mapped) {
        status = sli_map_path(&r, from->path, set);
    } else {
        status = sli_read_path(&r, from->path, set);
    }
    errno = saved;
    return status;
}

static sli_origin sli_origin_in_memory(const void *memory, size_t bytes, int is_mapped) {
    sli_origin from;
    from.memory = memory;
    from.bytes = bytes;
    from.path = NULL;
    from.is_mapped = is_mapped;
    return from;
}

static sli_origin sli_origin_in_file(const char *path, int is_mapped) {
    sli_origin from = sli_origin_in_memory(NULL, 0, is_mapped);
    from.path = path; /* NULL is refused, as memory without an address */
    return from;
}

SL_API sl_status sl_load_memory(sl_saved_set *set, const void *memory, size_t bytes,
                                sl_load_checks checks, const sl_options *opt) {
    const sli_origin from = sli_origin_in_memory(memory, bytes, 0);
    return sli_read_set(&from, set, checks, opt);
}

SL_API sl_status sl_map_memory(sl_saved_set *set, const void *memory, size_t bytes,
                               sl_load_checks checks, const sl_options *opt) {
    const sli_origin from = sli_origin_in_memory(memory, bytes, 1);
    return sli_read_set(&from, set, checks, opt);
}

SL_API sl_status sl_load_file(sl_saved_set *set, const char *path, sl_load_checks checks,
                              const sl_options *opt) {
    const sli_origin from = sli_origin_in_file(path, 0);
    return sli_read_set(&from, set, checks, opt);
}

SL_API sl_status sl_map_file(sl_saved_set *set, const char *path, sl_load_checks checks,
                             const sl_options *opt) {
    const sli_origin from = sli_origin_in_file(path, 1);
    return sli_read_set(&from, set, checks, opt);
}

#endif
