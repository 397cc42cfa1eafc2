/* mesh_sink.c: where mesh writers put text and numbers: a plain or gzipped file */
#include "mesh_sink.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

void sink_put(mesh_sink *s, const void *bytes, size_t length) {
    s->failed = s->failed || (length > 0 && gzwrite(s->file, bytes, (unsigned)length) <= 0);
}

void sink_print(mesh_sink *s, const char *format, ...) {
    char line[512];
    va_list list;
    va_start(list, format);
    int length = vsnprintf(line, sizeof line, format, list);
    va_end(list);
    s->failed = s->failed || length < 0 || (size_t)length >= sizeof line;
    if (!s->failed) {
        sink_put(s, line, (size_t)length);
    }
}

static void put_bits(mesh_sink *s, uint64_t bits, int bytes, bool big_endian) {
    unsigned char at[8];
    for (int k = 0; k < bytes; k++) {
        at[big_endian ? bytes - 1 - k : k] = (unsigned char)(bits >> (8 * k));
    }
    sink_put(s, at, (size_t)bytes);
}

void sink_double(mesh_sink *s, double x, bool big_endian) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    put_bits(s, bits, 8, big_endian);
}

void sink_int(mesh_sink *s, sl_int k, bool big_endian) {
    put_bits(s, (uint32_t)k, 4, big_endian);
}
