"""Matrices of files that strangers send: limits are compared before anything is allocated."""
import ctypes
import os

import numpy as np

from ._errors import IoError, TooLargeError
from ._files import check_bytes, check_limit, encoded
from ._library import Handle, Stats, check, lib
from ._matrix import csc_arrays, from_arrays

_LINE = 65536  # bytes of a line that is not a comment, as in the library
_FREE = 65536  # entries more than there are for which a file may have rows, 16 for each


def read_matrix(path, *, max_rows=None, max_entries=None, max_bytes=None):
    """The sparse matrix of a Matrix Market file: coordinate; real, integer or pattern.

    A symmetric file gives its lower triangle, which Factor takes as it is. Values of a pattern are
    1. Equal positions are summed.

    max_rows, max_entries  what the file may claim, also of columns; None: what its size allows,
              four bytes for an entry, and 2^20 rows and 16 for each entry.
    max_bytes  of the file; None: any size.
    Errors    TooLargeError: a limit, before memory is allocated; IoError: no ordinary file, or
              malformed, with its line; UnsupportedError: complex, array, skew-symmetric.
    Cost      O(bytes + rows); the memory is in proportion to the file.
    """
    check_bytes(path, max_bytes)
    if not os.path.isfile(path):
        raise IoError("no ordinary file: %s" % os.fsdecode(path))
    sizes = _claimed(path)
    if sizes is not None:
        _check_claims(path, sizes, max_rows, max_entries)
    pointer, stats = ctypes.c_void_p(), Stats()
    check(lib.sl_matrix_read(pointer, encoded(path), None, stats), stats, path=path)
    matrix = Handle("matrix", pointer.value)
    csc = lib.sl_matrix_view(matrix.pointer)
    p, i, x = csc_arrays(csc)
    return from_arrays((csc.n_rows, csc.n_cols), p, i, x if csc.x else np.ones(i.size))


def _claimed(path):
    """(rows, columns, entries) of the line of sizes; None: the library says what is wrong."""
    with open(path, "rb") as file:
        line, is_comment = file.readline(_LINE), True  # the banner, even after a byte order mark
        while line:
            text = line.strip(b" \t\r\n")
            is_comment = is_comment or text[:1] == b"%"
            if text and not is_comment:
                line += file.readline(_LINE) if line[-1:] != b"\n" else b""
                break
            is_comment = is_comment and line[-1:] != b"\n"
            line = file.readline(_LINE)
    try:
        sizes = tuple(int(word) for word in line.split())
    except ValueError:
        return None
    return sizes if len(sizes) == 3 else None


def _check_claims(path, sizes, max_rows, max_entries):
    rows, entries = max(sizes[:2]), sizes[2]
    fitting = os.path.getsize(path) // 4 + 1
    for count, what, most in ((entries, "entries", max_entries),
                              (rows, "rows or columns", max_rows)):
        check_limit(most, "a limit")
        if most is not None and count > most:
            raise TooLargeError("%d %s, of which %d are allowed, %s" %
                                (count, what, most, os.fsdecode(path)))
    if entries > fitting:
        raise TooLargeError("%d entries, more than its size allows, %s" %
                            (entries, os.fsdecode(path)))
    if rows // 16 > _FREE + entries:
        raise TooLargeError("%d rows or columns, and %d entries, %s" %
                            (rows, entries, os.fsdecode(path)))
