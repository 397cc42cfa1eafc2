/* replay.c: runs a fuzz target on files, without a fuzzer, with any compiler */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Runs one file in a block of exactly its size, so that a read past its end is detected. Returns
 * whether it was read. */
static int replay(const char *path) {
    FILE *f = fopen(path, "rb");
    long size = -1;
    if (f && fseek(f, 0, SEEK_END) == 0) size = ftell(f);
    if (size < 0 || fseek(f, 0, SEEK_SET) != 0) {
        if (f) fclose(f);
        return 0;
    }
    uint8_t *data = (uint8_t *)malloc(size > 0 ? (size_t)size : 1);
    int is_read = data && fread(data, 1, (size_t)size, f) == (size_t)size;
    fclose(f);
    if (is_read) LLVMFuzzerTestOneInput(data, (size_t)size);
    free(data);
    return is_read;
}

int main(int argc, char **argv) {
    uint8_t nothing = 0;
    LLVMFuzzerTestOneInput(&nothing, 0);
    int failed = 0;
    for (int k = 1; k < argc; k++) {
        printf("%s\n", argv[k]); /* the last line printed names the input that crashed */
        fflush(stdout);
        if (!replay(argv[k])) {
            fprintf(stderr, "%s: cannot be read\n", argv[k]);
            failed++;
        }
    }
    printf("%d inputs\n%d passed, %d failed\n", argc - 1, failed == 0, failed);
    return failed > 0;
}
