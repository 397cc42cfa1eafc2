/* scalar.c: numbers in binary files: integers and floats of 1 to 8 bytes, either order */
#include "scalar.h"

#include <stdint.h>
#include <string.h>

int scalar_bytes(scalar_type type) {
    static const int bytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return bytes[type];
}

double scalar_decode(scalar_type type, bool big_endian, const char *at) {
    const int bytes = scalar_bytes(type);
    uint64_t bits = 0;
    for (int k = 0; k < bytes; k++) {
        bits = bits << 8 | (unsigned char)at[big_endian ? k : bytes - 1 - k];
    }
    uint32_t low = (uint32_t)bits;
    float single;
    double result;
    switch (type) {
    case SCALAR_INT8:
        return (int8_t)low;
    case SCALAR_INT16:
        return (int16_t)low;
    case SCALAR_INT32:
        return (int32_t)low;
    case SCALAR_INT64:
        return (double)(int64_t)bits;
    case SCALAR_UINT64:
        return (double)bits;
    case SCALAR_FLOAT:
        memcpy(&single, &low, sizeof single);
        return (double)single;
    case SCALAR_DOUBLE:
        memcpy(&result, &bits, sizeof result);
        return result;
    default:
        return (double)low;
    }
}

bool scalar_read(input *in, bool ascii, scalar_type type, bool big_endian, double *x) {
    if (ascii) {
        return input_more(in) && input_number(in, x) && input_at_word_end(in);
    }
    if (in->end - in->at < scalar_bytes(type)) {
        return false;
    }
    *x = scalar_decode(type, big_endian, in->at);
    in->at += scalar_bytes(type);
    return true;
}

bool scalar_is_index(double x) {
    return x >= 0 && x <= 4294967295.0 && x == (double)(int64_t)x;
}
