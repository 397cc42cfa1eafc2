/* save.h: a factor in a file or in memory: saved, loaded, and mapped without a copy */
#ifndef SL_PUBLIC_SAVE_H
#define SL_PUBLIC_SAVE_H

#include "options.h"

/* A saved factor outlives its process, and any number of processes can map one file and share one
 * copy of it in memory. The format is that of the arrays in memory: src/FORMAT.md specifies it. It
 * is the same for every instruction set and for 32 and 64 bits. Files of processors of the other
 * byte order are loaded, but not mapped. The same analysis and factor give the same bytes; times
 * are not saved.
 *
 * A loaded or mapped factor solves like the saved one, with the same bits on the same instruction
 * set. It works with plans, regions and selected inverses that are made over the analysis that came
 * with it. A plan of another analysis is refused (SL_ERR_STATE), also if both were loaded from one
 * file.
 *
 * Calls of saved_set.h save selected inverses and regions too. The calls below read their files and
 * leave those out.
 *
 * A loaded factor can be refactored; the first refactorization allocates the memory of its fronts.
 * A mapped one is immutable, so that refactorizations give SL_ERR_STATE. */

/** How a saved factor is checked before it is used. The header and the table of sections are always
 *  checked, with their checksums. */
typedef enum sl_load_checks {
    /* every index is in range and every structure consistent: with any bytes whatsoever, later
     * calls stay inside the memory of the objects and terminate. Numbers may be wrong */
    SL_LOAD_CHECKED = 0,
    /* no more than loading itself needs: for files that nobody else can write. A forged or damaged
     * file may crash the call or later ones */
    SL_LOAD_TRUSTED,
    /* as SL_LOAD_CHECKED, and the checksums of everything that is loaded: no byte of it has changed
     * by accident */
    SL_LOAD_VERIFIED
} sl_load_checks;

/** The bytes that an analysis and a factor take when they are saved.
 *
 *  bytes  [out]  a multiple of 64.
 *  S      [in]   the analysis.
 *  F      [in]   a factor over S, or NULL: the analysis alone.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_STATE: a failed factor, one over another analysis, or
 *           objects from a file that a newer version has written and this one reads in part;
 *           SL_ERR_TOO_LARGE: more than size_t holds.
 *  Cost     O(1).
 *  Threads  reads S and F.
 */
SL_API SL_WARN_UNUSED sl_status sl_save_bytes(size_t *bytes, const sl_symbolic *S,
                                              const sl_factor *F);

/** Saves an analysis and a factor in the caller's memory.
 *
 *  memory  [out]  of `bytes` bytes, at least those of sl_save_bytes; the rest is not written. For
 *                 sl_map_memory it must be aligned to 64 bytes.
 *  bytes   [in]   the size of memory.
 *  S, F    [in]   as in sl_save_bytes.
 *  Returns  as sl_save_bytes; SL_ERR_ARGUMENT: also if memory is too small.
 *  Cost     reads S and F twice.
 *  Threads  reads S and F.
 *  Example  tests/core/test_save.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_memory(void *memory, size_t bytes, const sl_symbolic *S,
                                               const sl_factor *F);

/** Saves an analysis and a factor in a file.
 *
 *  The file gets its name only when it is complete and, on Linux, macOS and Windows, on its device.
 *  An error, a full disk or a crash leaves the old file as it was, and processes that have mapped
 *  the old file keep it. On Linux, a process that is killed leaves no temporary file on most file
 *  systems. A device or a symbolic link is written in place.
 *
 *  path  [in]  the name of the file.
 *  S, F  [in]  as in sl_save_bytes.
 *  opt   [in]  allocator; may be NULL.
 *  Returns  as sl_save_bytes; SL_ERR_IO; SL_ERR_MEMORY.
 *  Cost     reads S and F twice; waits until the file is on its device.
 *  Threads  reads S and F.
 *  Example  tests/core/test_save_file.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save_file(const char *path, const sl_symbolic *S,
                                             const sl_factor *F, const sl_options *opt);

/** Creates the analysis and the factor that memory holds, as copies.
 *
 *  S       [out]  the analysis, or NULL on error; release with sl_symbolic_free, after the factor.
 *  F       [out]  the factor, NULL on error and if none was saved; release with sl_factor_free. If
 *                 F is NULL, the analysis alone is loaded.
 *  memory  [in]   what sl_save_memory or sl_save_file wrote, of any alignment.
 *  bytes   [in]   the size that was saved, exactly.
 *  checks  [in]   see sl_load_checks.
 *  opt     [in]   allocator, threads, isa; may be NULL. threads are those of refactorizations.
 *  Returns  SL_OK; SL_ERR_ARGUMENT; SL_ERR_UNSUPPORTED: not a saved factor, one that this version
 *           cannot read, or the isa; SL_ERR_IO: incomplete, damaged or inconsistent;
 *           SL_ERR_TOO_LARGE: sizes do not fit size_t; SL_ERR_MEMORY.
 *  Cost     the copy, and checks in O(n + rows of the supernodes + entries of A). Never allocates
 *           more than `bytes` and the size of the two objects, whatever the memory contains.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_save.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_memory(sl_symbolic **S, sl_factor **F, const void *memory,
                                               size_t bytes, sl_load_checks checks,
                                               const sl_options *opt);

/** sl_load_memory from a file, which is closed when the call returns.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_load_memory; SL_ERR_IO: also if the file
 *  cannot be read.
 *  Example  tests/core/test_save_file.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load_file(sl_symbolic **S, sl_factor **F, const char *path,
                                             sl_load_checks checks, const sl_options *opt);

/** Creates an analysis and a factor whose arrays are those in memory, without a copy.
 *
 *  memory  [in]  as in sl_load_memory, aligned to 64 bytes; borrowed, must outlive both objects and
 *                not change.
 *  S, F, bytes, checks, opt  as in sl_load_memory; isa only, threads are those of the inverse.
 *  Returns  as sl_load_memory; SL_ERR_ARGUMENT: also if memory is not aligned; SL_ERR_UNSUPPORTED:
 *           also if the byte order is not that of this processor.
 *  Cost     the checks; with SL_LOAD_TRUSTED O(1). Keeps less than 4 KB.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_save.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_memory(sl_symbolic **S, sl_factor **F, const void *memory,
                                              size_t bytes, sl_load_checks checks,
                                              const sl_options *opt);

/** sl_map_memory of a file that is mapped into memory, read-only and shared with other processes.
 *
 *  The file is unmapped by sl_symbolic_free. Replace it by sl_save_file or by renaming: the system
 *  stops a process that reads a part of a mapped file that was cut off, and changes show in the
 *  factor. Pages are read when they are first needed.
 *
 *  path  [in]  the file.
 *  Arguments, status, cost and threads otherwise as in sl_map_memory; SL_ERR_IO: the file cannot be
 *  read; SL_ERR_UNSUPPORTED: also with SL_NO_MMAP, and on systems other than POSIX and Windows.
 *  Example  tests/core/test_save_file.c
 */
SL_API SL_WARN_UNUSED sl_status sl_map_file(sl_symbolic **S, sl_factor **F, const char *path,
                                            sl_load_checks checks, const sl_options *opt);

#endif
