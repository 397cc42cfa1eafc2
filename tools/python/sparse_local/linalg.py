"""spsolve, factorized and splu for any matrix of SciPy, and operators for its eigsh.

    from sparse_local.linalg import spsolve              # instead of scipy.sparse.linalg
    x = spsolve(A, b)
    w, V = eigsh(A, 6, M=M, sigma=0, OPinv=shift_invert(A, 0, M))

Real symmetric and complex Hermitian matrices, with both triangles, are solved by this package. All
others, and those that it refuses as singular, are given to SciPy, and get its answers and errors.
"""
import numpy as np
from scipy import sparse
from scipy.sparse import linalg as scipys

from ._errors import Error, InaccurateError, PivotError
from ._factor import Factor

__all__ = ["spsolve", "factorized", "splu", "operator", "shift_invert", "SymmetricLU"]

_ROUNDING = 16 * np.finfo(float).eps  # between the two entries of a pair
_GROWTH = 1e8  # of L, beyond which pivots are chosen by the values
_COLUMNS = 64  # of a sparse right-hand side that are solved at once


class SymmetricLU:
    """What splu and factorized return for a symmetric matrix: factor is the Factor behind it."""

    def __init__(self, factor, dtype):
        self.factor, self.shape, self._dtype = factor, factor.shape, dtype

    @property
    def nnz(self):
        """Entries of L and of its transpose, as SuperLU counts them."""
        stats = self.factor.stats["symbolic"]
        return 2 * stats["nnz_l"] // self.factor._kind.width ** 2

    def solve(self, b, trans="N", *, rows=None):
        """x with A x = b; trans 'T': A' x = b, 'H': A^H x = b. b (n,) or (n, count), may be sparse.

        rows  of x that are wanted, in this order; of a sparse b nothing else of their size is
              allocated than these rows.
        """
        if trans not in ("N", "T", "H"):
            raise ValueError("trans is 'N', 'T' or 'H', not %r" % (trans,))
        b = b if sparse.issparse(b) else np.asarray(b)
        is_conjugate = trans == "T" and self._dtype.kind == "c"  # A' is the conjugate of A
        x = self.factor.solve(b.conj() if is_conjugate else b, rows=rows)
        return (x.conj() if is_conjugate else x).astype(
            np.result_type(self._dtype, b.dtype, np.float32), copy=False)

    __call__ = solve


def _sparse(A, name="A"):
    if not sparse.issparse(A):
        raise TypeError("%s is %s, and not sparse: numpy.linalg.solve solves dense systems, and "
                        "scipy.sparse.csc_matrix(%s) makes a sparse matrix" %
                        (name, type(A).__name__, name))
    return A


def _compressed(A):
    """A as SciPy's spsolve takes it, whose class its sparse answer has."""
    return A if A.format in ("csc", "csr") else sparse.csc_matrix(A)


def _symmetric(A):
    """The SymmetricLU of A; None: SciPy has to solve this."""
    if A.ndim != 2 or A.shape[0] != A.shape[1] or A.dtype.kind not in "fciu":
        return None
    C = A if A.format in ("csc", "csr") else A.tocsc()
    differing = C - C.conj().T
    if differing.nnz and (abs(differing) - _ROUNDING * abs(C)).max() > 0:
        return None
    if C.dtype.kind == "c" and C.diagonal().imag.any():  # only rounding errors, as of U A U^H
        C = C.copy()
        C.setdiag(C.diagonal().real)
    for pivoted in (False, True):
        try:
            F = Factor(C, pivoted=pivoted)
        except (PivotError, InaccurateError):
            continue
        except Error:
            return None  # a NaN, or too large
        if pivoted or F.stats["factor"]["growth"] < _GROWTH:
            return SymmetricLU(F, A.dtype)
    return None


def splu(A, permc_spec=None, diag_pivot_thresh=None, relax=None, panel_size=None, options=None):
    """An object that solves with A: a SymmetricLU, or SciPy's SuperLU, which alone reads the
    options."""
    return _symmetric(_sparse(A)) or scipys.splu(
        A.tocsc(), permc_spec=permc_spec, diag_pivot_thresh=diag_pivot_thresh, relax=relax,
        panel_size=panel_size, options=options or {})


def factorized(A):
    """A function of b that returns the x with A x = b."""
    lu = splu(A)
    return lu.solve


def spsolve(A, b, permc_spec=None, use_umfpack=True):
    """x with A x = b, of the shape that scipy.sparse.linalg.spsolve gives it: (n,) for a b of one
    column, (n, count) for others, sparse for a sparse b of several columns, in the class of A."""
    lu = _symmetric(_sparse(A))
    if lu is None:
        return scipys.spsolve(_compressed(A), b, permc_spec, use_umfpack)
    if sparse.issparse(b):
        b = b.tocsc()
        if b.shape[1] != 1:
            return type(_compressed(A))(_sparse_solution(lu, b))
        b = b.toarray()
    b = np.asarray(b)
    return lu.solve(b.ravel() if b.ndim == 2 and b.shape[1] == 1 else b)


def _sparse_solution(lu, b):
    """A sparse X, made of blocks of dense columns."""
    dtype = np.result_type(lu._dtype, b.dtype, np.float32)
    blocks = [sparse.csc_matrix(lu.factor.solve(b[:, k:k + _COLUMNS]))
              for k in range(0, b.shape[1], _COLUMNS)]
    X = sparse.hstack(blocks, "csc") if blocks else sparse.csc_matrix(b.shape)
    return X.astype(dtype)


def operator(factor):
    """A^-1 as a scipy.sparse.linalg.LinearOperator, which is its own adjoint."""
    from ._arrays import COMPLEX
    dtype = np.complex128 if factor._kind is COMPLEX else np.float64
    return scipys.LinearOperator(factor.shape, matvec=lambda b: factor.solve(b.ravel()),
                                 rmatvec=lambda b: factor.solve(b.ravel()),
                                 matmat=factor.solve, rmatmat=factor.solve, dtype=dtype)


def shift_invert(A, sigma=0.0, M=None, **options):
    """(A - sigma M)^-1 as a LinearOperator, for OPinv of scipy.sparse.linalg.eigsh; M None: I.

    options  of Factor. Without any, pivots are chosen by the values where the order of the pattern
             does not suit. PivotError: sigma is an eigenvalue; take one nearby.
    """
    _sparse(A)
    M = sparse.identity(A.shape[0], format="csc") if M is None else _sparse(M, "M")
    shifted = (A - sigma * M).tocsc() if sigma else A
    if options:
        return operator(Factor(shifted, **options))
    lu = _symmetric(shifted)
    return operator(Factor(shifted) if lu is None else lu.factor)
