/* scratch_memory.h: an allocator whose large blocks are in files, which the system writes out */
#ifndef TOOLS_SCRATCH_MEMORY_H
#define TOOLS_SCRATCH_MEMORY_H

#include "sparse_local.h"

/** Memory for objects that are larger than the memory of the machine.
 *
 *  A block of at least SCRATCH_BLOCK bytes is a file of a folder, mapped into memory. When memory
 *  is short, the system writes its pages to the device and reads them again where they are used.
 *  The file has no name: it vanishes with the block or the process. Its space is reserved, so that
 *  a full disk is an allocation that fails. Smaller blocks are of malloc.
 *
 *  A factorization writes the panels one after the other, each once; its update stack is used again
 *  soon and stays in memory. An ordering reads at random, and is slow where memory is short.
 *
 *  Processes share these pages after fork: one that changes an object changes it in the others.
 */
enum { SCRATCH_BLOCK = 16 << 20 };

/** folder  [in]  must live as long as the allocator is used. */
sl_allocator scratch_allocator(const char *folder);

#endif
