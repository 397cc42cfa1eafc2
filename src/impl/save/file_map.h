/* file_map.h: files mapped into memory, read-only, and the size of a file */
#ifndef SLI_SAVE_FILE_MAP_H
#define SLI_SAVE_FILE_MAP_H

#include "../../public/types.h"
#include "../base/status.h"

typedef struct sli_mapping {
    const void *bytes; /* NULL: nothing is mapped */
    size_t size;
} sli_mapping;

static const char sli_no_file[] = "it is empty, or not an ordinary file";
static const char sli_unmappable[] = "the system cannot map the file";

#if defined(SLI_MMAP) || defined(SLI_MAP_VIEW)
static sl_status sli_map_allows(int64_t size) {
    if (size <= 0) {
        return sli_refuse(SL_ERR_IO, sli_no_file);
    }
    return (uint64_t)size <= SIZE_MAX / 2
               ? SL_OK
               : sli_refuse(SL_ERR_TOO_LARGE, /* branches untested: on 32 bits only */
                            "the file is larger than the address space");
}
#endif

/* Maps a file. An empty file cannot be mapped, and gives SL_ERR_IO like one that cannot be read. */
static sl_status sli_map(const char *path, sli_mapping *out) {
    sl_status status;
    out->bytes = NULL;
    out->size = 0;
#if defined(SLI_MMAP)
    {
        const int file = open(path, O_RDONLY);
        struct stat found;
        if (file < 0) {
            return sli_file_fails("the file cannot be opened");
        }
        status = sli_map_allows(
            fstat(file, &found) == 0 && S_ISREG(found.st_mode) ? (int64_t)found.st_size : 0);
        if (status == SL_OK) {
            void *bytes = mmap(NULL, (size_t)found.st_size, PROT_READ, MAP_SHARED, file, 0);
            if (bytes == MAP_FAILED) {
                status = errno == ENOMEM ? sli_no_memory() : sli_file_fails(sli_unmappable);
            } else {
                out->bytes = bytes;
                out->size = (size_t)found.st_size;
            }
        }
        close(file);
    }
#elif defined(SLI_MAP_VIEW)
    {
        /* GENERIC_READ; FILE_SHARE_READ and FILE_SHARE_DELETE; OPEN_EXISTING; an ordinary file */
        void *const file = CreateFileA(path, 0x80000000u, 1 | 4, NULL, 3, 0x80, NULL);
        void *section;
        int64_t size = 0;
        if ((intptr_t)file == -1) { /* INVALID_HANDLE_VALUE */
            return sli_refuse(SL_ERR_IO, "the file cannot be opened");
        }
        status = sli_map_allows(GetFileSizeEx(file, (sli_windows_number)(void *)&size) ? size : 0);
        section = status != SL_OK ? NULL : CreateFileMappingA(file, NULL, 2, 0, 0, NULL);
        if (section != NULL) { /* 2: PAGE_READONLY, 4: FILE_MAP_READ */
            out->bytes = MapViewOfFile(section, 4, 0, 0, 0);
            CloseHandle(section);
        }
        if (status == SL_OK && out->bytes == NULL) {
            status = sli_refuse(SL_ERR_IO, sli_unmappable);
        } else if (status == SL_OK) {
            out->size = (size_t)size;
        }
        CloseHandle(file);
    }
#else
    (void)path;
    status =
        sli_refuse(SL_ERR_UNSUPPORTED, "files cannot be mapped here: load without SL_LOAD_MAPPED");
#endif
    return status;
}

static void sli_unmap(const void *bytes, size_t size) {
#if defined(SLI_MMAP)
    munmap((void *)(uintptr_t)bytes, size);
#elif defined(SLI_MAP_VIEW)
    UnmapViewOfFile(bytes);
#endif
    (void)bytes;
    (void)size;
}

/* The bytes of an open file, which is left at its start; 0 if it has no size, as a pipe. */
static uint64_t sli_file_size(FILE *file) {
#if defined(_WIN32)
    const int64_t size = _fseeki64(file, 0, SEEK_END) == 0 ? _ftelli64(file) : 0;
#else
    const int64_t size = fseek(file, 0, SEEK_END) == 0 ? (int64_t)ftell(file) : 0;
#endif
    rewind(file);
    return size > 0 ? (uint64_t)size : 0;
}

/* Writes what was written to a file so far to its device, where the system can. Returns whether
 * that succeeded. */
static int sli_flush(FILE *file) {
    if (fflush(file) != 0) {
        return 0;
    }
#if defined(SLI_FSYNC)
    return sli_fsync(sli_fileno(file)) == 0 || errno == EINVAL || errno == EROFS; /* a device */
#elif defined(_WIN32)
    return _commit(_fileno(file)) == 0 || _isatty(_fileno(file)); /* a device, such as NUL */
#else
    return 1;
#endif
}

#endif
