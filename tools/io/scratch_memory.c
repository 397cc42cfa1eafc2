/* scratch_memory.c: an allocator whose large blocks are in files, which the system writes out */
#define _POSIX_C_SOURCE 200809L
#include "scratch_memory.h"

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

/* Before each block is its size in the file, or 0 for one of malloc, in as many bytes as keep the
 * block aligned. */
enum { HEAD = 64, NAME_MAX_BYTES = 4096 };

/* A file without a name in the folder; -1: none could be made. */
static int create_file(const char *folder) {
    char name[NAME_MAX_BYTES];
    const int length = snprintf(name, sizeof name, "%s/sparse-local.XXXXXX", folder);
    const int file = length > 0 && length < (int)sizeof name ? mkstemp(name) : -1;
    if (file >= 0) {
        (void)unlink(name);
    }
    return file;
}

static unsigned char *map_file(const char *folder, size_t bytes) {
    const int file = create_file(folder);
    void *at = MAP_FAILED;
    if (file >= 0 && posix_fallocate(file, 0, (off_t)bytes) == 0) {
        at = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    }
    if (file >= 0) {
        (void)close(file);
    }
    return at == MAP_FAILED ? NULL : at;
}

static void *allocate(void *context, size_t bytes) {
    unsigned char *block = NULL;
    const int in_file = bytes >= SCRATCH_BLOCK;
    if (bytes > (size_t)INT64_MAX - HEAD) {
        return NULL;
    }
    block = in_file ? map_file(context, bytes + HEAD) : malloc(bytes + HEAD);
    if (block == NULL) {
        return NULL;
    }
    *(size_t *)(void *)block = in_file ? bytes + HEAD : 0;
    return block + HEAD;
}

static void release(void *context, void *block) {
    (void)context;
    if (block != NULL) {
        unsigned char *head = (unsigned char *)block - HEAD;
        const size_t bytes = *(size_t *)(void *)head;
        if (bytes > 0) {
            (void)munmap(head, bytes);
        } else {
            free(head);
        }
    }
}

sl_allocator scratch_allocator(const char *folder) {
    sl_allocator a;
    a.context = (void *)(uintptr_t)folder;
    a.allocate = allocate;
    a.release = release;
    return a;
}
