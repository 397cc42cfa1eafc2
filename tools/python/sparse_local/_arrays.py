"""Arrays of NumPy and SciPy as the library wants them: in place where their types fit."""
import ctypes

import numpy as np

from ._errors import ArgumentError, NotFiniteError, PatternError, TooLargeError
from ._library import Csc, Csc64, Handle, Stats, check, lib, new_options

_LIMIT = 2**31 - 1
_AS_SYMMETRIC, _AS_STORED = 0, 1
TRIANGLES = {None: 0, "lower": 1, "upper": 2, "both": 3}


def address(array):
    """The address of an array's data; of something else if it is empty, since NULL is refused."""
    return array.ctypes.data if array.size else _NOTHING.ctypes.data


_NOTHING = np.zeros(1)


def _index_array(array, what):
    array = np.asarray(array)
    if array.dtype.kind not in "iu":
        raise TypeError("%s must be integers, not %s" % (what, array.dtype))
    if array.size and (array.max() > _LIMIT or array.min() < -_LIMIT):
        raise TooLargeError("%s exceed 32 bits" % what)
    return np.ascontiguousarray(array, dtype=np.int32)


def _wide_array(array, what):
    return np.ascontiguousarray(array)


def _real_array(array, what):
    array = np.asarray(array)
    if array.dtype.kind not in "fiu":
        raise TypeError("%s must be real numbers, not %s" % (what, array.dtype))
    return np.asarray(array, dtype=np.float64)


class Matrix:
    """View of a sparse matrix: scipy.sparse, or anything with shape, indptr, indices and data.

    CSC with 32-bit indices and float64 values is used in place; p, i, x are its arrays. 64-bit
    indices are converted by the library. CSR is
    used in place as its transpose, so that its triangles change places (is_turned).
    """

    def __init__(self, A):
        form = getattr(A, "format", "csc")
        if form not in ("csc", "csr"):
            A = A.tocsc()
            form = "csc"
        elif not all(hasattr(A, name) for name in ("shape", "indptr", "indices", "data")):
            raise TypeError("a sparse matrix in compressed columns is needed (scipy.sparse.csc)")
        self.is_turned = form == "csr"
        rows, columns = A.shape
        if self.is_turned:
            rows, columns = columns, rows
        if max(rows, columns) > _LIMIT:
            raise TooLargeError("a matrix of %d x %d" % (rows, columns))
        is_wide = np.asarray(A.indptr).dtype == np.asarray(A.indices).dtype == np.int64
        as_array = _wide_array if is_wide else _index_array
        self.p = as_array(A.indptr, "positions")
        self.i = as_array(A.indices, "row indices")
        self.x = np.ascontiguousarray(_real_array(A.data, "values"))
        if self.p.ndim != 1 or self.p.size != columns + 1:
            raise PatternError("indptr needs one entry for each column and one more")
        if self.p[0] != 0 or not self.p[-1] <= min(self.i.size, self.x.size):
            raise PatternError("positions do not fit the arrays of indices and values")
        self.n = rows
        if is_wide:
            self.csc = self._convert(rows, columns)
        else:
            self.csc = Csc(rows, columns, address(self.p), address(self.i), address(self.x))

    def _convert(self, rows, columns):
        """The view with 32-bit indices of a matrix with 64-bit ones; values stay in place."""
        wide = Csc64(rows, columns, address(self.p), address(self.i), 0)
        pointer, stats = ctypes.c_void_p(), Stats()
        check(lib.sl_matrix_from_csc64(ctypes.byref(pointer), ctypes.byref(wide), None,
                                       ctypes.byref(stats)), stats)
        self._converted = Handle("matrix", pointer.value)
        csc = lib.sl_matrix_view(self._converted.pointer)
        csc.x = address(self.x)
        return csc

    def reference(self):
        return ctypes.byref(self.csc)

    def triangle(self, name):
        """The value of options.triangle for 'lower', 'upper' or None."""
        if name not in TRIANGLES or name == "both":
            raise ArgumentError("triangle is 'lower', 'upper' or None, not %r" % (name,))
        value = TRIANGLES[name]
        return 3 - value if value and self.is_turned else value

    def check_symmetric(self):
        """Raises PatternError if both triangles are stored and differ, NotFiniteError for a NaN.

        Compares two products with one vector: as stored, and as the lower triangle defines them.
        """
        stats, found = Stats(), ctypes.c_int()
        options = new_options()
        check(lib.sl_csc_triangle(self.reference(), ctypes.byref(found), ctypes.byref(options),
                                  ctypes.byref(stats)), stats)
        if found.value != TRIANGLES["both"]:
            return
        bad = np.flatnonzero(~np.isfinite(self.x[:self.p[-1]]))
        if bad.size:
            column = int(np.searchsorted(self.p, bad[0], side="right")) - 1
            raise NotFiniteError("NaN or infinity", int(self.i[bad[0]]), column,
                                 float(self.x[bad[0]]))
        x = np.random.default_rng(0).uniform(0.5, 1.5, self.n)
        stored, mirrored, scale = np.empty(self.n), np.empty(self.n), np.empty(self.n)
        magnitude = Csc(self.csc.n_rows, self.csc.n_cols, self.csc.p, self.csc.i, 0)
        values = np.abs(self.x)
        magnitude.x = address(values)
        for csc, reading, y in ((self.csc, _AS_STORED, stored), (self.csc, _AS_SYMMETRIC, mirrored),
                                (magnitude, _AS_STORED, scale)):
            check(lib.sl_csc_multiply(ctypes.byref(csc), reading, address(y), max(self.n, 1),
                                      address(x), max(self.n, 1), 1))
        differs = ~(np.abs(stored - mirrored) <= 1e-9 * scale)
        if differs.any():
            row = int(np.argmax(differs))
            raise PatternError("the two triangles differ; pass triangle='lower' or 'upper' to read "
                               "one of them", row)


def check_triangle(name):
    if name not in TRIANGLES:
        raise ArgumentError("triangle is 'lower', 'upper' or None, not %r" % (name,))


def rows(chosen):
    """A set of rows as (keeper, address, count); None is every row: address NULL."""
    if chosen is None:
        return None, None, 0
    array = np.asarray(chosen)
    if array.size == 0:
        array = np.zeros(0, dtype=np.int32)
    if array.ndim != 1:
        raise ArgumentError("a set of rows has one dimension")
    array = _index_array(array, "rows")
    if array.size > _LIMIT:
        raise TooLargeError("a set of %d rows" % array.size)
    return array, address(array), array.size


# SL_ROW_MAJOR: the highest bit of a size_t
_ROW_MAJOR = 1 << (8 * ctypes.sizeof(ctypes.c_size_t) - 1)


class Dense:
    """A right-hand side B and its solution: vectors or matrices, in rows or in columns.

    A matrix is used in place, in row-major order (NumPy's default) or in column-major order: the
    leading dimensions tell the library which (SL_ROWS).
    """

    def __init__(self, B, n_b, n_x):
        B = _real_array(B, "right-hand sides")
        if B.ndim not in (1, 2) or B.shape[0] != n_b:
            raise ArgumentError("the right-hand side needs %d rows, and has the shape %s" %
                                (n_b, B.shape))
        self.count = B.shape[1] if B.ndim == 2 else 1
        if self.count > _LIMIT:
            raise TooLargeError("%d right-hand sides" % self.count)
        by_rows = B.ndim == 2 and self.count > 1 and not B.flags.f_contiguous
        order = "C" if by_rows else "F"
        self.B = np.require(B, requirements=[order, "A"])
        shape = (n_x,) if B.ndim == 1 else (n_x, self.count)
        self.X = np.empty(shape, order=order)
        self.ldb = self.count | _ROW_MAJOR if by_rows else max(n_b, 1)
        self.ldx = self.count | _ROW_MAJOR if by_rows else max(n_x, 1)

    def arguments(self):
        """X, ldx, B, ldb, nrhs of a call."""
        return address(self.X), self.ldx, address(self.B), self.ldb, self.count


def option_array(array, n, dtype, what):
    """An array of n numbers for an option; dtype float64 or int32."""
    array = np.asarray(array)
    array = _index_array(array, what) if dtype == np.int32 else np.ascontiguousarray(
        _real_array(array, what))
    if array.size != n:
        raise ArgumentError("%s needs %d numbers, and has %d" % (what, n, array.size))
    return array
