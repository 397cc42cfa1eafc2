/* scalar.h: numbers in binary files: integers and floats of 1 to 8 bytes, either order */
#ifndef TOOLS_SCALAR_H
#define TOOLS_SCALAR_H

#include "input.h"

typedef enum scalar_type {
    SCALAR_INT8,
    SCALAR_UINT8,
    SCALAR_INT16,
    SCALAR_UINT16,
    SCALAR_INT32,
    SCALAR_UINT32,
    SCALAR_INT64,
    SCALAR_UINT64,
    SCALAR_FLOAT,
    SCALAR_DOUBLE
} scalar_type;

/** The size of a number: 1, 2, 4 or 8 bytes. */
int scalar_bytes(scalar_type type);

/** Decodes the number at `at`. Integers of 8 bytes beyond 2^53 are rounded. */
double scalar_decode(scalar_type type, bool big_endian, const char *at);

/** Reads the next number: a word of text if ascii, otherwise the bytes of its type.
 *
 *  Returns  false at the end of the input, and for a word that is no number.
 */
bool scalar_read(input *in, bool ascii, scalar_type type, bool big_endian, double *x);

/** Whether x is an integer in 0..2^32-1. */
bool scalar_is_index(double x);

#endif
