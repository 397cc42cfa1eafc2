"""Sparse matrices: those of SciPy, or anything with their arrays, as views of the library."""
import ctypes
from collections import namedtuple
from math import isfinite

import numpy as np

from . import _arrays as arrays
from ._arrays import DOUBLE, INDEX, address, is_plain
from ._errors import ArgumentError, MalformedError, NotFiniteError, TooLargeError
from ._library import Csc, Csc64, Handle, Hermitian, Stats, check, lib, new_options

_AS_SYMMETRIC, _AS_STORED = 0, 1
TRIANGLES = {None: 0, "lower": 1, "upper": 2, "both": 3}

_NEEDED = ("a sparse matrix in compressed columns is needed, not %s: scipy.sparse.csc_matrix(A) "
           "makes one")
_probe = np.random.default_rng(0).uniform(0.5, 1.5, 1000)  # of small matrices

CscArrays = namedtuple("CscArrays", "shape indptr indices data")
CscArrays.__doc__ = """A sparse matrix in compressed columns, where SciPy is not installed."""


class Matrix:
    """View of a sparse matrix: scipy.sparse, or anything with shape, indptr, indices and data.

    CSC with 32-bit indices and float64 values is used in place; p, i, x are its arrays. 64-bit
    indices are converted by the library. CSR is used in place as its transpose, so that its
    triangles change places (is_turned). A complex matrix becomes the real one of twice the size.
    is_ordered: a matrix that SciPy knows to have rows out of order, as sums have them, is copied in
    order, since an analysis takes other matrices with their entries in the same order only.
    """

    def __init__(self, A, is_ordered=True):
        form = getattr(A, "format", "csc")
        if form not in ("csc", "csr"):
            A = A.tocsc()
            form = "csc"
        try:
            A.shape, A.indptr, A.indices, A.data
        except AttributeError:
            raise TypeError(_NEEDED % type(A).__name__) from None
        if is_ordered and _is_out_of_order(A):
            A = A.copy()
            A.sum_duplicates()
        self.is_turned = form == "csr"
        rows, columns = A.shape
        if self.is_turned:
            rows, columns = columns, rows
        if rows > arrays.LIMIT or columns > arrays.LIMIT:
            raise TooLargeError("a matrix of %d x %d" % (rows, columns))
        self.p, self.i, self.x, is_wide = _as_wanted(A.indptr, A.indices, A.data)
        if self.p.shape != (columns + 1,):
            raise MalformedError("indptr needs one entry for each column and one more")
        count = self.p.item(columns)
        if self.p.item(0) != 0 or count > self.i.size or count > self.x.size:
            raise MalformedError("positions do not fit the arrays of indices and values")
        self.n = rows
        self.is_complex = self.x.dtype.kind == "c"
        if is_wide:
            self.csc = self._convert(rows, columns)
        else:
            self.csc = Csc(rows, columns, address(self.p), address(self.i), address(self.x))
        if self.is_complex:
            self.csc = self._as_real(rows, columns)

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

    def _as_real(self, rows, columns):
        """The real matrix of a Hermitian one. The transpose, which CSR is, is its conjugate."""
        if rows != columns:
            raise ArgumentError("a square matrix is needed, not %d x %d" % (rows, columns))
        values = self.x.conj() if self.is_turned else self.x
        view = Hermitian(rows, self.csc.p, self.csc.i, address(values), None)
        pointer, stats = ctypes.c_void_p(), Stats()
        check(lib.sl_matrix_from_hermitian(ctypes.byref(pointer), ctypes.byref(view), None,
                                           ctypes.byref(stats)), stats)
        self._doubled = Handle("matrix", pointer.value)
        csc = lib.sl_matrix_view(self._doubled.pointer)
        self.p, self.i, self.x = csc_arrays(csc)
        return csc

    def reference(self):
        return ctypes.byref(self.csc)

    def triangle(self, name):
        """The value of options.triangle for 'lower', 'upper' or None."""
        check_triangle(name)
        value = TRIANGLES[name]
        return 3 - value if value and self.is_turned else value

    def kind(self):
        """arrays.REAL or arrays.COMPLEX."""
        return arrays.COMPLEX if self.is_complex else arrays.REAL

    def check_symmetric(self, stored=None):
        """Raises PatternError if both triangles are stored and differ, NotFiniteError for a NaN.

        Compares two products with one vector: as stored, and as the lower triangle defines them.
        stored: the triangles of a matrix that was analyzed; None: it may be malformed.
        """
        if stored is None:
            stats, found = Stats(), ctypes.c_int()
            check(lib.sl_csc_triangle(self.reference(), found, new_options(), stats), stats)
            stored = found.value
        if stored != TRIANGLES["both"]:
            return
        n = self.csc.n_rows
        x = _probe[:n] if n <= _probe.size else np.random.default_rng(0).uniform(0.5, 1.5, n)
        as_stored, mirrored, lead, of_x = np.empty(n), np.empty(n), n or 1, address(x)
        for reading, y in ((_AS_STORED, as_stored), (_AS_SYMMETRIC, mirrored)):
            check(lib.sl_csc_multiply(self.csc, reading, address(y), lead, of_x, lead, 1))
        # the same terms in the same order, if all entries are in order
        if isfinite(as_stored.dot(mirrored)) and as_stored.tobytes() == mirrored.tobytes():
            return
        self._check_mirrored(x, as_stored, mirrored)

    def _check_mirrored(self, x, stored, mirrored):
        """Compares the products relative to the magnitudes that they are sums of."""
        width, n = self.kind().width, self.csc.n_rows
        bad = np.flatnonzero(~np.isfinite(self.x[:self.p[-1]]))
        if bad.size:
            column = int(np.searchsorted(self.p, bad[0], side="right")) - 1
            raise NotFiniteError("NaN or infinity", int(self.i[bad[0]]) // width, column // width,
                                 float(self.x[bad[0]]))
        scale, magnitude = np.empty(n), Csc(n, n, self.csc.p, self.csc.i, 0)
        values = np.abs(self.x)
        magnitude.x = address(values)
        check(lib.sl_csc_multiply(magnitude, _AS_STORED, address(scale), max(n, 1), address(x),
                                  max(n, 1), 1))
        differs = ~(np.abs(stored - mirrored) <= 1e-9 * scale)
        if differs.any():
            row = int(np.argmax(differs)) // width
            raise MalformedError("the two triangles differ", row,
                               advice="pass triangle='lower' or 'upper' to read one of them")


def _is_out_of_order(A):
    """Whether A is a well-formed matrix of SciPy with rows out of order, or with duplicates."""
    if getattr(A, "_has_canonical_format", False) or not hasattr(A, "_has_canonical_format") and \
            not hasattr(type(A), "has_canonical_format"):
        return False  # known to be in order, or not of SciPy
    p = np.asarray(A.indptr)  # SciPy looks through the arrays without a check
    return (p.ndim == 1 and p.size == A.shape[0 if A.format == "csr" else 1] + 1 and p[0] == 0 and
            (p[1:] >= p[:-1]).all() and p[-1] <= min(np.size(A.indices), np.size(A.data)) and
            not A.has_canonical_format)


def _as_wanted(p, i, x):
    """(positions, rows, values, whether the indices have 64 bits): in place if they fit."""
    if is_plain(p, INDEX) and is_plain(i, INDEX) and is_plain(x, DOUBLE):
        return p, i, x, False  # what most calls pass
    x = np.ascontiguousarray(arrays.number_array(x, "values"))
    if np.asarray(p).dtype == np.asarray(i).dtype == np.int64:
        return np.ascontiguousarray(p), np.ascontiguousarray(i), x, True
    return arrays.index_array(p, "positions"), arrays.index_array(i, "row indices"), x, False


def check_triangle(name):
    if name not in TRIANGLES or name == "both":
        raise ArgumentError("triangle is 'lower', 'upper' or None, not %r" % (name,))


def csc_arrays(csc):
    """Copies of the positions, rows and values of a view."""
    def copy(pointer, kind, count):
        if not count:
            return np.zeros(0, dtype=kind)
        return np.ctypeslib.as_array(ctypes.cast(pointer, ctypes.POINTER(kind)), (count,)).copy()

    p = copy(csc.p, ctypes.c_int32, csc.n_cols + 1)
    count = int(p[-1])
    x = copy(csc.x, ctypes.c_double, count) if csc.x else np.zeros(count)
    return p, copy(csc.i, ctypes.c_int32, count), x


def from_arrays(shape, p, i, x):
    """scipy.sparse.csc_matrix, or CscArrays if SciPy is not installed."""
    try:
        import scipy.sparse
    except ImportError:
        return CscArrays(tuple(shape), p, i, x)
    return scipy.sparse.csc_matrix((x, i, p), shape=shape)


def from_triplets(n, rows, columns, values):
    """The n x n matrix with values[k] at (rows[k], columns[k]); equal positions are summed.

    Of a symmetric matrix one triangle is enough. Without SciPy the result is a tuple with the
    fields shape, indptr, indices and data, which every call of this package takes.
    ArgumentError: an index out of range. O(n + entries).
    """
    i, j = arrays.index_array(rows, "rows"), arrays.index_array(columns, "columns")
    if i.ndim != 1 or i.shape != j.shape:
        raise ArgumentError("triplets need as many rows as columns")
    x = arrays.vector(values, i.size, "values")
    pointer, stats = ctypes.c_void_p(), Stats()
    check(lib.sl_matrix_from_triplets(ctypes.byref(pointer), n, n, i.size, address(i), address(j),
                                      address(x), None, ctypes.byref(stats)), stats)
    matrix = Handle("matrix", pointer.value)
    return from_arrays((n, n), *csc_arrays(lib.sl_matrix_view(matrix.pointer)))


def columns_of(B, first=0, end=None):
    """Columns of a sparse right-hand side in compressed columns: (rows that have an entry, dense
    block of these rows)."""
    p = np.asarray(B.indptr)[first:None if end is None else end + 1]
    data = arrays.number_array(B.data, "right-hand sides")[p[0]:p[-1]]
    columns = np.repeat(np.arange(p.size - 1), np.diff(p))
    rows, places = np.unique(np.asarray(B.indices)[p[0]:p[-1]], return_inverse=True)
    block = np.zeros((rows.size, p.size - 1), data.dtype)
    np.add.at(block, (places, columns), data)
    return rows, block


def is_sparse(B):
    return hasattr(B, "indptr") or hasattr(B, "tocsc")
