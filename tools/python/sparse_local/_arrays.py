"""Arrays of NumPy as the library wants them: sets of rows, and dense blocks, in place if they fit.

REAL and COMPLEX say how rows of the user are rows of the library: a complex Hermitian matrix of n
rows is a real one of 2n, with real and imaginary parts in turn.
"""
import cmath
import ctypes
import sys

import numpy as np

from ._errors import ArgumentError, NotFiniteError, TooLargeError

LIMIT = 2**31 - 1
ALL = -1  # SL_ALL, the count of a set that is NULL: every row


def _address(array):
    """The address of an array's data; of something else if it is empty, since NULL is refused."""
    return array.ctypes.data if array.size else _NOTHING.ctypes.data


def _address_in_head(array, pointer=ctypes.c_void_p.from_address, head=object.__basicsize__):
    """The same, read from where CPython's NumPy has it, first in the object: 0.2 us, not 1."""
    return pointer(id(array) + head).value or _address(array)


_NOTHING = np.zeros(1)
_probes = [_NOTHING, np.arange(6.0)[2:], np.zeros((3, 4), np.int32).T, np.zeros(0)[:0]]
address = _address
if sys.implementation.name == "cpython" and all(
        _address_in_head(probe) == probe.ctypes.data for probe in _probes):
    address = _address_in_head
INDEX, DOUBLE, _COMPLEX = np.dtype(np.int32), np.dtype(np.float64), np.dtype(np.complex128)


def is_plain(array, dtype):
    """Whether the library takes an array as it is; this is what most calls pass."""
    if type(array) is not np.ndarray or array.dtype is not dtype:
        return False
    flags = array.flags
    return flags.c_contiguous and flags.aligned


def index_array(array, what):
    """Integers as int32; TypeError: other numbers or booleans; TooLargeError: beyond 32 bits."""
    if is_plain(array, INDEX):
        return array
    array = np.asarray(array)
    if array.size == 0:
        array = array.astype(INDEX)  # an empty list has no type of its own
    if array.dtype.kind not in "iu":
        raise TypeError("%s must be integers, not %s" % (what, array.dtype))
    if array.size and (array.max() > LIMIT or array.min() < -LIMIT):
        raise TooLargeError("%s exceed 32 bits" % what)
    return np.ascontiguousarray(array, dtype=np.int32)


def real_array(array, what):
    """Numbers as float64; TypeError: complex ones, booleans and objects."""
    array = np.asarray(array)
    if array.dtype.kind not in "fiu":
        raise TypeError("%s must be real numbers, not %s" % (what, array.dtype))
    return np.asarray(array, dtype=np.float64)


def number_array(array, what):
    """Numbers as float64 or complex128."""
    if is_plain(array, DOUBLE):
        return array
    array = np.asarray(array)
    if array.dtype.kind == "c":
        return np.asarray(array, dtype=np.complex128)
    return real_array(array, what)


def vector(array, count, what):
    """count real numbers in one dimension, contiguous."""
    array = np.ascontiguousarray(real_array(array, what))
    if array.shape != (count,):
        raise ArgumentError("%s: %d numbers are needed, the shape is %s" %
                            (what, count, array.shape))
    return array


def option_array(array, n, dtype, what):
    """An array of n numbers for an option; dtype float64 or int32."""
    array = np.asarray(array)
    array = index_array(array, what) if dtype == np.int32 else np.ascontiguousarray(
        real_array(array, what))
    if array.size != n:
        raise ArgumentError("%s needs %d numbers, and has %d" % (what, n, array.size))
    return array


def check_finite(array, what, rows=None, width=1):
    """Raises NotFiniteError with the first row, of rows // width if given, with a NaN or infinity.

    A sum of squares first, which is quicker than a test of each number; squares may overflow.
    """
    flat = array if array.ndim == 1 else array.ravel("K")
    if cmath.isfinite(flat.dot(flat)):
        return
    bad = np.argwhere(~np.isfinite(array))
    if bad.size:
        row = int(bad[0][0])
        raise NotFiniteError("NaN or infinity in %s" % what,
                             row if rows is None else int(rows[row * width]) // width,
                             int(bad[0][1]) if array.ndim == 2 else None,
                             float(np.real(array[tuple(bad[0])])))


# SL_ROW_MAJOR: the highest bit of a size_t
_ROW_MAJOR = 1 << (8 * ctypes.sizeof(ctypes.c_size_t) - 1)


class Dense:
    """A right-hand side B and its solution X: vectors or matrices, in rows or in columns.

    A matrix is used in place, in row-major order (NumPy's default) or in column-major order: the
    leading dimensions tell the library which (SL_ROWS). A complex B of a real matrix is twice as
    many columns. width: rows of the library for each row.
    """

    def __init__(self, B, n_b, n_x, width=1, rows=None):
        if type(B) is not np.ndarray or B.dtype is not DOUBLE:
            B = number_array(B, "right-hand sides")
        shape = B.shape
        if not 1 <= len(shape) <= 2 or shape[0] != n_b:
            raise ArgumentError("the right-hand side needs %d rows, and has the shape %s" %
                                (n_b, shape))
        check_finite(B, "the right-hand side", rows, width)
        columns = shape[1] if len(shape) == 2 else 1
        is_doubled = width == 1 and B.dtype.kind == "c"  # each column is two real ones
        self.count = 2 * columns if is_doubled else columns
        if self.count > LIMIT:
            raise TooLargeError("%d right-hand sides" % columns)
        flags = B.flags
        by_rows = is_doubled or (width == 1 and self.count > 1 and not flags.f_contiguous)
        order = "C" if by_rows else "F"
        dtype = _COMPLEX if width == 2 or is_doubled else DOUBLE
        if B.dtype is not dtype or not flags.aligned or not (
                flags.c_contiguous if by_rows else flags.f_contiguous):
            B = np.require(B, dtype, [order, "A"])
        self.B = B
        self.X = np.empty((n_x,) if len(shape) == 1 else (n_x, columns), dtype, order)
        self.ldb = self.count | _ROW_MAJOR if by_rows else max(n_b * width, 1)
        self.ldx = self.count | _ROW_MAJOR if by_rows else max(n_x * width, 1)

    def arguments(self):
        """X, ldx, B, ldb, nrhs of a call."""
        return address(self.X), self.ldx, address(self.B), self.ldb, self.count

    def is_by_rows(self):
        """Whether B and X are row-major."""
        return bool(self.ldb & _ROW_MAJOR)

    def right(self):
        """B in real rows and columns, as the library reads it; a copy."""
        B = self.B if self.B.ndim == 2 else self.B[:, None]
        if B.dtype.kind != "c":
            return np.array(B, order="F")
        if self.ldb & _ROW_MAJOR:
            return np.asfortranarray(np.ascontiguousarray(B).view(np.float64))
        return np.array(np.ascontiguousarray(B.T).view(np.float64).T, order="F")

    def shaped(self, out):
        """A block like right(), as an array of the shape and type of B."""
        if self.B.dtype.kind == "c":
            if self.ldb & _ROW_MAJOR:
                out = np.ascontiguousarray(out).view(np.complex128)
            else:
                out = np.ascontiguousarray(out.T).view(np.complex128).T
        return out if self.B.ndim == 2 else out[:, 0]


class _Real:
    """Rows of the user are those of the library."""
    width = 1

    @staticmethod
    def set(chosen):
        """A set of rows as (array of the library, address, count); None is every row: SL_ALL."""
        if chosen is None:
            return None, None, ALL
        if type(chosen) is list and len(chosen) == 1 and type(chosen[0]) is int and \
                0 <= chosen[0] <= LIMIT:
            array = np.array(chosen, INDEX)
            return array, address(array), 1
        array = np.asarray(chosen)
        if array.size == 0:
            array = np.zeros(0, dtype=np.int32)
        if array.ndim != 1:
            raise ArgumentError("a set of rows has one dimension")
        array = index_array(array, "rows")
        if array.size > LIMIT:
            raise TooLargeError("a set of %d rows" % array.size)
        return array, address(array), array.size

    @staticmethod
    def dense(B, n_b, n_x, rows=None):
        """A right-hand side with n_b rows of the user; rows of the library name them in errors."""
        return Dense(B, n_b, n_x, 1, rows)


class _Complex:
    """Row k of the user is rows 2k and 2k + 1 of the library."""
    width = 2

    @staticmethod
    def set(chosen):
        rows, _, count = _Real.set(chosen)
        if rows is None:
            return None, None, ALL
        if count and (rows.max() > LIMIT // 2 or rows.min() < 0):
            raise ArgumentError("a row out of range", int(rows.max() if rows.min() >= 0
                                                         else rows.min()))
        pairs = np.empty(2 * count, dtype=np.int32)
        pairs[0::2], pairs[1::2] = 2 * rows, 2 * rows + 1
        return pairs, address(pairs), 2 * count

    @staticmethod
    def dense(B, n_b, n_x, rows=None):
        return Dense(B, n_b, n_x, 2, rows)


REAL, COMPLEX = _Real(), _Complex()
rows = REAL.set
