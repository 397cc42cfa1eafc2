"""Lower triangles in one pattern: what lets one analysis serve matrices that lack some entries."""
import ctypes
import warnings

import numpy as np
from scipy import sparse

from .._errors import PatternError
from .._library import Csc, Handle, Stats, check, lib, new_options
from .._matrix import TRIANGLES, Matrix, csc_arrays
from ._errors import (CholmodError, CholmodInvalidError, CholmodTypeConversionWarning,
                      CholmodWarning, translated)


def checked(A):
    """A matrix of numbers in compressed columns of float64 or complex128."""
    if not sparse.issparse(A):
        raise CholmodError("a sparse matrix is needed, not %s; scipy.sparse.csc_matrix(A) makes "
                           "one" % type(A).__name__)
    if A.format != "csc":
        warnings.warn("a matrix in %s format is converted to csc" % A.format,
                      CholmodTypeConversionWarning, stacklevel=4)
        A = A.tocsc()
    if A.dtype.kind not in "fciub":
        raise CholmodError("numbers are needed, not %s" % A.dtype)
    return A.astype(np.complex128 if A.dtype.kind == "c" else np.float64, copy=False)


def square(A):
    """The same for a square matrix."""
    A = checked(A)
    if A.shape[0] != A.shape[1]:
        raise CholmodError("a symmetric matrix is square, not %d x %d" % A.shape)
    return A


def readable(A, triangle="lower"):
    """A matrix whose lower triangle is the one of A that is read; warns if the other differs."""
    A = square(A)
    if triangle == "upper" and A.dtype.kind == "c":
        A, triangle = A.conj().T.tocsc(), "lower"
    try:
        with translated(None):
            view = Matrix(A)
            stored = _stored_triangle(view)
            if stored == TRIANGLES["both"]:
                view.check_symmetric()
    except CholmodInvalidError as error:
        if not isinstance(error.__cause__, PatternError) or not _is_well_formed(A):
            raise
        warnings.warn("only the %s triangle is read: %s" % (triangle, error), CholmodWarning,
                      stacklevel=4)
        return sparse.tril(A if triangle == "lower" else A.T, format="csc")
    other = "upper" if triangle == "lower" else "lower"
    if stored == TRIANGLES[other]:
        raise CholmodInvalidError("the %s triangle is read, and this matrix stores only the %s "
                                  "one" % (triangle, other))
    return A.T.tocsc() if stored == TRIANGLES["upper"] else A


def _stored_triangle(view):
    found, stats = ctypes.c_int(), Stats()
    check(lib.sl_csc_triangle(view.reference(), ctypes.byref(found), new_options(), stats), stats)
    return found.value


def _is_well_formed(A):
    try:
        A.check_format()
    except ValueError:
        return False
    return True


def product(A):
    """The lower triangle of A A^H."""
    A = checked(A)
    return sparse.tril(A @ A.conj().T, format="csc")


def product_pattern(A):
    """The lower triangle of the pattern of A A^H, whatever cancels."""
    A = checked(A)
    ones = sparse.csc_matrix((np.ones(A.nnz), A.indices, A.indptr), shape=A.shape)
    pattern = sparse.tril(ones @ ones.T, format="csc")
    return pattern.astype(np.complex128) if A.dtype.kind == "c" else pattern


class Pattern:
    """The lower triangle of a pattern with its diagonal. first: low + beta I in it."""

    def __init__(self, low, beta=0.0):
        self.shape = low.shape
        self.is_complex = low.dtype.kind == "c"
        self._identity = sparse.identity(low.shape[0], format="csc")
        real = _real_parts(low)
        union = _sum([real[0], self._identity], [1.0, beta])
        self.indices, self.indptr = union.indices, union.indptr
        self._zeros = np.zeros(union.nnz)
        self._layout = self._taken = None  # of matrices that are stored like the last one
        self.first = union if len(real) == 1 else self.matrix(low, beta)

    def matrix(self, low, beta=0.0):
        """A lower triangle plus beta I in this pattern. Entries of low outside raise an error."""
        if low.shape != self.shape:
            raise CholmodError("a matrix of %d x %d was analyzed, not %d x %d" %
                               (self.shape + low.shape))
        if low.dtype.kind == "c" and not self.is_complex:
            raise CholmodError("a real matrix was analyzed, and this one is complex")
        taken = None if self.is_complex else self._places(low)
        if taken is not None:
            data = low.data[taken]
            if beta:
                data[self.indptr[:-1]] += beta  # the diagonal is first in each lower column
            return _in_order(data, self.indices, self.indptr, self.shape)
        pattern = _in_order(self._zeros, self.indices, self.indptr, self.shape)
        terms, weights = [pattern, self._identity], [0.0, beta]
        real = _real_parts(low)
        parts = [_sum([part] + terms, [1.0] + weights) for part in real[:1]]
        parts += [_sum([part] + terms, [1.0, 0.0, 0.0]) for part in real[1:]]
        for part in parts:
            self._check_inside(part)
        if not self.is_complex:
            return parts[0]
        data = parts[0].data.astype(np.complex128)
        if len(parts) > 1:
            data += 1j * parts[1].data
        return _in_order(data, self.indices, self.indptr, self.shape)

    def _places(self, low):
        """Where the values of the pattern are in low.data; None: it lacks some, or repeats some.
        They are found by a sum whose values are the places, once for matrices stored alike."""
        if self._layout is None or not (np.array_equal(self._layout[0], low.indptr) and
                                        np.array_equal(self._layout[1], low.indices)):
            self._layout, self._taken = (low.indptr.copy(), low.indices.copy()), None
            if low.has_canonical_format:
                numbered = _sum([_with(low, np.arange(1.0, low.data.size + 1.0))], [1.0])
                if numbered.nnz == self.indices.size and np.array_equal(numbered.indices,
                                                                        self.indices):
                    self._taken = numbered.data.astype(np.intp) - 1
        return self._taken

    def _check_inside(self, total):
        if total.nnz == self.indices.size:
            return
        total.data[:] = 1.0
        known = _in_order(np.ones(self.indices.size), self.indices, self.indptr, self.shape)
        outside = (total - known).tocoo()
        raise CholmodInvalidError("not the analyzed pattern: an entry in row %d, column %d" %
                                  (outside.row[0], outside.col[0]))


def _with(A, data):
    return sparse.csc_matrix((data, A.indices, A.indptr), shape=A.shape)


def _real_parts(low):
    """The matrix, or the lower triangles of the real and imaginary parts of a complex one."""
    if low.dtype.kind != "c":
        return [low]
    low = sparse.tril(low, format="csc")  # whose imaginary part has no other triangle
    return [_with(low, low.data.real), _with(low, low.data.imag)]


def _sum(terms, weights):
    """The weighted sum of lower triangles in the union of their patterns, by the library."""
    views = [Matrix(A, is_ordered=False) for A in terms]
    structs = (Csc * len(views))(*(view.csc for view in views))
    options, stats, pointer = new_options(), Stats(), ctypes.c_void_p()
    options.triangle = TRIANGLES["lower"]
    with translated(None):
        check(lib.sl_matrix_sum(ctypes.byref(pointer), (ctypes.c_double * len(weights))(*weights),
                                structs, len(views), options, stats), stats)
    matrix = Handle("matrix", pointer.value)
    p, i, x = csc_arrays(lib.sl_matrix_view(matrix.pointer))
    return _in_order(x, i, p, terms[0].shape)


def _in_order(x, i, p, shape):
    """A matrix of SciPy whose entries are known to be in order."""
    A = sparse.csc_matrix(shape, dtype=x.dtype)
    A.data, A.indices, A.indptr = x, i, p
    A.has_canonical_format = True
    return A
