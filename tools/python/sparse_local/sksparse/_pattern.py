"""Lower triangles in one pattern: what lets one analysis serve matrices that lack some entries."""
import warnings

import numpy as np
from scipy import sparse

from .._errors import PatternError
from .._matrix import Matrix
from ._errors import (CholmodError, CholmodInvalidError, CholmodTypeConversionWarning,
                      CholmodWarning, translated)


def checked(A):
    """A matrix of numbers in compressed columns of float64 or complex128."""
    if not sparse.issparse(A):
        raise CholmodError("a sparse matrix is needed, not %s" % type(A).__name__)
    if A.format != "csc":
        warnings.warn("a matrix in %s format is converted to csc" % A.format,
                      CholmodTypeConversionWarning, stacklevel=4)
    A = sparse.csc_matrix(A)
    if A.dtype.kind not in "fciub":
        raise CholmodError("numbers are needed, not %s" % A.dtype)
    return A.astype(np.complex128 if A.dtype.kind == "c" else np.float64, copy=False)


def lower(A):
    """The lower triangle of A, the only one that is read; warns if the other one differs."""
    A = checked(A)
    if A.shape[0] != A.shape[1]:
        raise CholmodError("a symmetric matrix is square, not %d x %d" % A.shape)
    low = sparse.tril(A, format="csc")
    if low.nnz < A.nnz:
        if sparse.tril(low, -1).nnz == 0:
            raise CholmodInvalidError("the lower triangle is read, and this matrix stores only "
                                      "the upper one")
        try:
            with translated(None):
                Matrix(A).check_symmetric()
        except CholmodInvalidError as error:
            if not isinstance(error.__cause__, PatternError):
                raise
            warnings.warn("only the lower triangle is read: %s" % error, CholmodWarning,
                          stacklevel=4)
    return low


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
    """The lower triangle of a pattern with its diagonal."""

    def __init__(self, low):
        self.shape = low.shape
        n = low.shape[0]
        self.is_complex = low.dtype.kind == "c"
        diagonal = np.arange(n, dtype=np.int64) * (n + 1)
        self.keys = np.union1d(_keys(low), diagonal)
        self.diagonal = np.searchsorted(self.keys, diagonal)
        columns = self.keys // max(n, 1)
        self.indices = (self.keys - columns * n).astype(np.int32)
        self.indptr = np.searchsorted(columns, np.arange(n + 1)).astype(np.int32)

    def matrix(self, low, beta=0.0):
        """A lower triangle plus beta I in this pattern. Entries of low outside raise an error."""
        if low.shape != self.shape:
            raise CholmodError("a matrix of %d x %d was analyzed, not %d x %d" %
                               (self.shape + low.shape))
        if low.dtype.kind == "c" and not self.is_complex:
            raise CholmodError("a real matrix was analyzed, and this one is complex")
        keys = _keys(low)
        at = np.searchsorted(self.keys, keys)
        outside = (at >= self.keys.size) | (self.keys[np.minimum(at, self.keys.size - 1)] != keys)
        if outside.any():
            row, column = _place(keys[np.argmax(outside)], self.shape[0])
            raise CholmodInvalidError("not the analyzed pattern: an entry in row %d, column %d" %
                                      (row, column))
        data = np.zeros(self.keys.size, np.complex128 if self.is_complex else np.float64)
        np.add.at(data, at, low.data)
        data[self.diagonal] += beta
        return sparse.csc_matrix((data, self.indices, self.indptr), shape=self.shape)


def _keys(low):
    """The positions of entries as numbers, column by column."""
    columns = np.repeat(np.arange(low.shape[1], dtype=np.int64), np.diff(low.indptr))
    return columns * low.shape[0] + low.indices


def _place(key, n):
    return key % n, key // n
