"""The names of the package qdldl on sparse_local: programs written for it run unchanged.

    from sparse_local import qdldl
    F = qdldl.Solver(A)
    x = F.solve(b)

sparse_local.stand_in("qdldl") lets `import qdldl` find this module. Otherwise than there, update
refuses another pattern and a matrix that cannot be factored, NaN and infinity raise ValueError, and
values that are not symmetric raise ValueError unless upper=True.
"""
import numpy as np
from scipy import sparse

from ._errors import Error, PivotError
from ._factor import Factor

__all__ = ["Solver"]


class Solver:
    """L D L' of a square quasi-definite matrix: D has both signs.

    A      n x n, sparse; both triangles, of which upper=False reads the upper one.
    upper  True: A is its upper triangle.
    ValueError: not square, empty, malformed; RuntimeError: a null pivot.
    """

    def __init__(self, A, upper=False):
        rows, columns = A.shape
        if rows != columns:
            raise ValueError("Matrix A is not square")
        A = _upper(A, upper)
        if A.nnz == 0:
            raise ValueError("Matrix A is empty")
        self._factor = _tried(lambda: Factor(A, triangle="upper", ordering="mindeg"))

    def solve(self, b):
        """x with A x = b; b has n numbers, and x the shape (n,). ValueError: another length."""
        b = np.asarray(b, dtype=float).ravel()
        if b.size != self._factor.n:
            raise ValueError("Length of b does not match size of A")
        return _tried(lambda: self._factor.solve(b))

    def update(self, Anew, upper=False):
        """Factors a matrix of the same pattern. ValueError: another pattern; RuntimeError: a null
        pivot, after which solve raises RuntimeError until an update succeeds."""
        A = _upper(Anew, upper)
        _tried(lambda: self._factor.refactor(A))

    def factors(self):
        """(L, D, p): L n x n without its unit diagonal, D n numbers, p the order, with
        A[p][:, p] = (L + I) diag(D) (L + I)'."""
        L = self._factor.lower()
        return sparse.tril(L, -1, format="csc"), self._factor.pivots()[0], self._factor.perm


def _upper(A, upper):
    """The upper triangle of A in compressed columns, with its diagonal."""
    A = sparse.csc_matrix(A)
    triangle = A if upper else sparse.triu(A, format="csc")
    if not upper and triangle.nnz < A.nnz:
        mirrored = abs(A - A.T)
        if mirrored.nnz and not mirrored.max() <= 1e-9 * abs(A).max():
            raise ValueError("Matrix A is not symmetric; upper=True reads its upper triangle")
    return triangle


def _tried(call):
    """Null pivots, failed factors and the like are RuntimeError, as in qdldl."""
    try:
        return call()
    except PivotError as error:
        raise RuntimeError("Error in matrix factorization: %s" % error.cause) from error
    except Error as error:
        kind = RuntimeError if isinstance(error, RuntimeError) else ValueError
        raise kind(error.cause) from error
