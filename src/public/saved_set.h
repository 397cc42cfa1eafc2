/* saved_set.h: a factor with its selected inverse and regions in one file or block of memory */
#ifndef SL_PUBLIC_SAVED_SET_H
#define SL_PUBLIC_SAVED_SET_H

#include "region.h"
#include "save.h"
#include "selected.h"

/* Regions and selected inverses take longer to make than to read. The calls below save them
 * together with their factor. Without them, the file is the same as that of sl_save_file. */

/** What one file holds. The caller fills one in to save objects; a load fills in new ones, which
 *  sl_saved_set_free releases. */
typedef struct sl_saved_set {
    sl_symbolic *symbolic;
    sl_factor *factor;     /* over symbolic; NULL: none */
    sl_selected *selected; /* of the present numbers of factor, or alone; NULL: none */
    sl_region **regions;   /* n_regions, of the present numbers of factor; NULL if n_regions is 0 */
    sl_int n_regions;
    sl_allocator allocator; /* of the array regions; set by loads, not read by saves */
} sl_saved_set;

/** The bytes that a set takes when it is saved.
 *
 *  bytes  [out]  a multiple of 64.
 *  set    [in]   a selected inverse may be saved without a factor; regions may not. The same region
 *                may be given more than once.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: a NULL, n_regions below 0, or regions without a factor;
 *           SL_ERR_STATE: as sl_save_bytes, or a selected inverse or region that is of another
 *           analysis or not of the present numbers of factor; SL_ERR_TOO_LARGE.
 *  Cost     O(1 + n_regions).
 *  Threads  reads the objects.
 */
SL_API SL_WARN_UNUSED sl_status sl_save_set_bytes(size_t *bytes, const sl_saved_set *set);

/** Saves a set in the caller's memory. The same objects give the same bytes.
 *
 *  memory, bytes  [out]  as in sl_save_memory, at least what sl_save_set_bytes gives.
 *  set            [in]   as in sl_save_set_bytes.
 *  Returns  as sl_save_set_bytes; SL_ERR_ARGUMENT: also if memory is too small.
 *  Cost     reads the objects twice.
 *  Threads  reads the objects.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_set_memory(void *memory, size_t bytes,
                                                   const sl_saved_set *set);

/** Saves a set in a file, which is replaced as by sl_save_file.
 *
 *  path  [in]  the name of the file.
 *  set   [in]  as in sl_save_set_bytes.
 *  opt   [in]  allocator; may be NULL.
 *  Returns  as sl_save_set_bytes; SL_ERR_IO; SL_ERR_MEMORY.
 *  Cost     reads the objects twice; waits until the file is on its device.
 *  Threads  reads the objects.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_set_file(const char *path, const sl_saved_set *set,
                                                 const sl_options *opt);

/** Creates all objects that memory holds, as copies.
 *
 *  Selected inverse and regions are those of the loaded factor: they have the bits of the saved
 *  ones, and plans in the regions solve with it. They can be refactored with it. A selected inverse
 *  that was saved without a factor answers queries and can be refactored; sl_region_create refuses
 *  it.
 *
 *  set     [out]  the objects; all zero on error. Release with sl_saved_set_free.
 *  memory, bytes, checks  [in]  as in sl_load_memory.
 *  opt     [in]   allocator, threads, isa; may be NULL. threads are those of refactorizations.
 *  Returns  as sl_load_memory.
 *  Cost     the copy, and checks as in sl_load_memory, in O(supernodes) for the selected inverse
 *           and in O(roots and rows of the boundary, log n each, and rows below the roots) for the
 *           regions. Never allocates more than 8 times `bytes`, whatever the memory contains.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_set_memory(sl_saved_set *set, const void *memory,
                                                   size_t bytes, sl_load_checks checks,
                                                   const sl_options *opt);

/** sl_load_set_memory from a file, which is closed when the call returns.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_load_set_memory; SL_ERR_IO: also if the
 *  file cannot be read.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_set_file(sl_saved_set *set, const char *path,
                                                 sl_load_checks checks, const sl_options *opt);

/** Creates objects whose numbers are those in memory, without a copy.
 *
 *  All of them are immutable: sl_selected_refactor and sl_region_refactor give SL_ERR_STATE, as
 *  refactorizations do.
 *
 *  memory  [in]  as in sl_map_memory: borrowed, aligned to 64 bytes.
 *  set, bytes, checks, opt  as in sl_load_set_memory; isa only, threads are those of the inverse.
 *  Returns  as sl_map_memory.
 *  Cost     the checks; with SL_LOAD_TRUSTED O(1) and O(rows of the boundary) for each region.
 *           Keeps less than 4 KB, and for each region less than 500 bytes and 16 for each row of
 *           the boundary and each subtree.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_set_memory(sl_saved_set *set, const void *memory,
                                                  size_t bytes, sl_load_checks checks,
                                                  const sl_options *opt);

/** sl_map_set_memory of a file that is mapped into memory as by sl_map_file. The file is unmapped
 *  when the analysis is released.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_map_set_memory; SL_ERR_IO and
 *  SL_ERR_UNSUPPORTED also as in sl_map_file.
 *  Example  tests/core/test_saved_set.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_set_file(sl_saved_set *set, const char *path,
                                                sl_load_checks checks, const sl_options *opt);

/** Releases the objects of a set that a load filled in, then sets it to all zero. To keep an
 *  object, set its pointer to NULL before. NULL is allowed. */
SL_API void sl_saved_set_free(sl_saved_set *set);

#endif
