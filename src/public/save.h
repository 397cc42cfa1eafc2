/* save.h: a factor and what belongs to it in a file or in memory: saved, loaded, mapped */
#ifndef SL_PUBLIC_SAVE_H
#define SL_PUBLIC_SAVE_H

#include "options.h"

/* A saved factor outlives its process, and any number of processes can map one file and share one
 * copy of it in memory:
 *
 *     sl_saved_set set = {0}, got = {0};
 *     set.symbolic = S;  set.factor = F;
 *     sl_save(path, NULL, NULL, &set, NULL);
 *     sl_load(&got, path, NULL, 0, SL_LOAD_MAPPED, NULL);   here or in any other process
 *     sl_factor_solve(got.factor, x, n, b, n, 1, NULL);     the bits that F gives
 *     sl_saved_set_free(&got);
 *
 * The format is that of the arrays in memory: src/FORMAT.md specifies it. It is the same for every
 * instruction set and for 32 and 64 bits. Files of processors of the other byte order are loaded,
 * but not mapped. The same objects give the same bytes; times are not saved.
 *
 * A loaded or mapped factor solves like the saved one, with the same bits on the same instruction
 * set. It works with plans, regions and selected inverses that are made over the analysis that came
 * with it, and with those that were loaded with it. A plan of another analysis is refused
 * (SL_ERR_MISMATCH), also if both were loaded from one file.
 *
 * Loaded objects can be refactored; the first refactorization of a factor allocates the memory of
 * its fronts. Mapped ones are immutable, and so are those in a file that a newer version has
 * written and this one reads in part: refactorizations give SL_ERR_READ_ONLY. */

/** How much of a file a load creates. */
typedef enum sl_saved_content {
    SL_SAVED_ALL = 0, /* every object that was saved */
    SL_SAVED_FACTOR,  /* the analysis and the factor */
    SL_SAVED_ANALYSIS /* the analysis */
} sl_saved_content;

/** What one file holds. All zero at first: then the caller fills in objects to save, or a load
 *  does. A load replaces all fields but `wanted`. */
typedef struct sl_saved_set {
    sl_symbolic *symbolic;
    sl_factor *factor;     /* over symbolic; NULL: none */
    sl_selected *selected; /* of the present numbers of factor, or alone; NULL: none */
    sl_region **regions;   /* n_regions, of the present numbers of factor; NULL if n_regions is 0 */
    sl_int n_regions;
    sl_allocator allocator;  /* of the array regions; set by loads, not read by saves */
    sl_saved_content wanted; /* read by loads: the others are left out, and take no time */
    void *reserved[6];       /* must be NULL; new fields take their place */
} sl_saved_set;

/** How sl_load reads, to be combined by |. The header and the table of sections are always checked,
 *  with their checksums. */
typedef enum sl_load_flag {
    /* every index is in range and every structure consistent: with any bytes whatsoever, later
     * calls stay inside the memory of the objects and terminate. Numbers may be wrong */
    SL_LOAD_CHECKED = 0,
    /* no more than loading itself needs: for files that nobody else can write. A forged or damaged
     * file may crash the call or later ones */
    SL_LOAD_TRUSTED = 1,
    /* as SL_LOAD_CHECKED, and the checksums of everything that is loaded: no byte of it has changed
     * by accident. Not with SL_LOAD_TRUSTED */
    SL_LOAD_VERIFIED = 2,
    /* the arrays of the objects are those in the file or in memory, without a copy */
    SL_LOAD_MAPPED = 4
} sl_load_flag;

/** Saves a set in a file or in the caller's memory, or counts its bytes.
 *
 *  A file gets its name only when it is complete and, on Linux, macOS and Windows, on its device.
 *  An error, a full disk or a crash leaves the old file as it was, and processes that have mapped
 *  the old file keep it. On Linux a killed process leaves no temporary file on most file systems.
 *  A device or a symbolic link is written in place.
 *
 *  path    [in]      the name of the file, or NULL.
 *  memory  [out]     of any alignment; SL_LOAD_MAPPED needs 64 bytes. Not written on error, nor
 *                    beyond what the set takes. NULL: to path or, without one, only *bytes is set.
 *  bytes   [in,out]  in: the size of memory, if that is not NULL. Out: what the set takes, a
 *                    multiple of 64, also if memory is too small; as before on any other error. May
 *                    be NULL with a path.
 *  set     [in]      an analysis and what belongs to it. A selected inverse may be saved without a
 *                    factor; regions may not. The same region may be given more than once.
 *  opt     [in]      allocator.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also memory that is too small, and regions without a factor;
 *           SL_ERR_STALE: a failed factor, or a selected inverse or region that is not of its
 *           present numbers; SL_ERR_MISMATCH: objects of different analyses, or from
 *           a file that a newer version has written and this one reads in part;
 *           SL_ERR_UNSUPPORTED: SL_STORAGE_COMPLEX; SL_ERR_TOO_LARGE: more than size_t holds;
 *           SL_ERR_IO; SL_ERR_MEMORY: of a file.
 *  Cost     reads the objects twice, and waits until a file is on its device; O(1 + n_regions) to
 *           count.
 *  Threads  reads the objects.
 *  Example  tests/core/test_save.c, test_saved_set.c, test_save_file.c
 */
SL_API SL_WARN_UNUSED sl_status sl_save(const char *path, void *memory, size_t *bytes,
                                        const sl_saved_set *set, const sl_options *opt);

/** Creates the objects that a file or memory holds, as copies or, by SL_LOAD_MAPPED, in place.
 *
 *  Mapped memory must outlive the objects and not change. A mapped file is read-only and shared
 *  with other processes; it is unmapped when the last object is released, and its pages are read
 *  when they are first needed. Replace it by sl_save or a rename: the system stops a process that
 *  reads a part of a mapped file that was cut off, and changes show in the factor.
 *
 *  A selected inverse that was saved without a factor answers queries and can be refactored;
 *  sl_region_create refuses it.
 *
 *  set     [in,out]  in: `wanted` and `reserved`. Out: the objects, or NULL and 0 on error and for
 *                    what was not saved or is not wanted. Release with sl_saved_set_free.
 *  path    [in]      the file, or NULL.
 *  memory  [in]      NULL, or what sl_save wrote, of any alignment; aligned to 64 bytes if mapped.
 *  bytes   [in]      the size that was saved in memory, exactly; not read with a path.
 *  flags   [in]      any of sl_load_flag, but not both SL_LOAD_TRUSTED and SL_LOAD_VERIFIED.
 *  opt     [in]      allocator, threads, isa. threads are those of refactorizations;
 *                    of mapped objects those of the inverse.
 *  Returns  SL_OK; SL_ERR_ARGUMENT: also if path and memory are both given or both NULL;
 *           SL_ERR_UNSUPPORTED: not a saved factor, one that this version cannot read, the isa, or
 *           L in float where isa keeps it in double (sl_storage); mapped: also the other byte
 *           order and, of a file, SL_NO_MMAP and systems other than POSIX and Windows; SL_ERR_IO:
 *           unreadable, incomplete, damaged or inconsistent; SL_ERR_TOO_LARGE: sizes do not fit
 *           size_t; SL_ERR_MEMORY.
 *  Cost     the copy, and checks in O(n + rows of the supernodes + entries of A) and, for regions,
 *           O(rows of the boundary and below the roots, log n each). Never allocates more than
 *           `bytes` and the size of analysis and factor, or 8 times `bytes` with regions, whatever
 *           the memory contains. Mapped: the checks; with SL_LOAD_TRUSTED O(1) and O(rows of the
 *           boundary) for each region. Keeps less than 4 KB, and for each region 500 bytes and 16
 *           for each row of the boundary and each subtree.
 *  Threads  any number of calls at once.
 *  Example  tests/core/test_save.c
 */
SL_API SL_WARN_UNUSED sl_status sl_load(sl_saved_set *set, const char *path, const void *memory,
                                        size_t bytes, unsigned flags, const sl_options *opt);

/** Releases what a load put into a set, then sets it to all zero: regions and their array, selected
 *  inverse, factor, and the analysis at last.
 *
 *  To keep an object, copy its pointer and set the field to NULL before. Objects that are kept may
 *  be freed in any order. A set that the caller has filled in to save owns nothing: do not pass it.
 *  NULL is allowed.
 */
SL_API void sl_saved_set_free(sl_saved_set *set);

#endif
