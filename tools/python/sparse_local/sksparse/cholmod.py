"""The names of sksparse.cholmod on sparse_local: programs written for it run unchanged.

    from sparse_local.sksparse.cholmod import cholesky
    factor = cholesky(A)
    x = factor(b)

sparse_local.stand_in("sksparse") lets `from sksparse.cholmod import cholesky` find this module.

As there, only the lower triangle of A is read. Unlike there, these give a signal: a matrix that
stores only its upper triangle (CholmodInvalidError), triangles that differ (CholmodWarning),
negative pivots (CholmodWarning, or CholmodNotPositiveDefiniteError where D^(1/2) is needed), a
pattern that is not the analyzed one, NaN and infinity. mode chooses no algorithm; 'supernodal'
refuses indefinite matrices at once. use_long has no meaning.

A singular semidefinite matrix, such as the Laplacian of a closed mesh, has a null pivot in each
component: x is 0 in its row, and D is 0. A right-hand side that has no solution is a
CholmodWarning; the residual is then in these rows only.
"""
import warnings

import numpy as np
from scipy import sparse

from .. import _errors as ours
from .._analysis import Analysis
from .._factor import Factor as _Numbers
from ._errors import (CholmodError, CholmodGpuProblemError, CholmodInvalidError,
                      CholmodNotInstalledError, CholmodNotPositiveDefiniteError,
                      CholmodOutOfMemoryError, CholmodTooLargeError, CholmodTypeConversionWarning,
                      CholmodWarning, translated)
from ._pattern import Pattern, checked, product, product_pattern, readable, square

__all__ = ["analyze", "analyze_AAt", "cholesky", "cholesky_AAt", "CholmodError",
           "CholmodGpuProblemError", "CholmodInvalidError", "CholmodNotInstalledError",
           "CholmodNotPositiveDefiniteError", "CholmodOutOfMemoryError", "CholmodTooLargeError",
           "CholmodTypeConversionWarning", "CholmodWarning"]

_modes = {"simplicial": 0, "auto": 1, "supernodal": 2}
_ordering_methods = {"natural": "natural", "amd": "mindeg", "metis": "nd", "nesdis": "nd",
                     "colamd": "mindeg", "default": "nd", "best": "nd"}
_CONSISTENT = 1e-6  # |z' b| / sum |b| up to which b counts as consistent, as in sl_options
_COLUMNS = 64  # of a sparse right-hand side that are solved at once
_key = object()


class Factor:
    """The decomposition of A, or of A A^H, or only its analysis. Made by analyze and cholesky.

    L D L^H = A[P][:, P] with a unit lower triangular L; L L^H with the L of L().
    """

    def __init__(self, key, *parts):
        if key is not _key:
            raise CholmodError("a Factor is made by analyze and cholesky")
        self._analysis, self._pattern, self._mode, self._shown = parts
        self._numbers = None
        self._is_singular = False  # null pivots are skipped
        self._low = None  # the lower triangle that is factored
        self._order()

    def _order(self):
        """Places in the order of the library, which keeps the order that is shown (a given one, or
        the natural one) in effect but not in sequence. None: it is the order of the library."""
        if self._shown is not None:
            self._from = np.argsort(self._analysis.perm)[self._shown]

    # ---- factorization ----

    def cholesky_inplace(self, A, beta=0):
        """Factors A + beta I, whose pattern is in the analyzed one."""
        self._factor(readable(A), beta)

    def cholesky_AAt_inplace(self, A, beta=0):
        """Factors A A^H + beta I."""
        self._factor(product(A), beta)

    def _factor(self, low, beta=0.0):
        self._factor_in_pattern(self._pattern.matrix(low, beta))

    def _factor_in_pattern(self, low):
        with translated(self):
            try:
                if self._numbers is None or self._is_singular:
                    self._numbers = None
                    self._numbers = self._analysis.factor(low)
                else:
                    self._numbers.refactor(low)
                self._is_singular = False
            except ours.PivotError as error:
                self._numbers = self._without_null_pivots(low, error)
                self._is_singular = True
        self._low = low
        self._judge()

    def _without_null_pivots(self, low, error):
        """A factor that skips null pivots of a semidefinite matrix; others raise the first error.
        Solves check the right-hand side themselves: what has no solution is a warning."""
        self._numbers = None
        try:
            return self._analysis.factor(low, null_pivots="skip", consistency_tolerance=-1.0)
        except ours.Error:
            raise error from None

    def _judge(self):
        negative = self._numbers.inertia[1]
        if negative == 0:
            return
        column = int(self.P()[int(np.argmax(self.D() < 0))])
        text = "not positive definite: %d negative pivots, the first in column %d" % (negative,
                                                                                     column)
        if self._mode == "supernodal":
            raise CholmodNotPositiveDefiniteError(text, column, self)
        warnings.warn(text, CholmodWarning, stacklevel=5)

    def copy(self):
        """A Factor with numbers of its own."""
        other = Factor(_key, self._analysis, self._pattern, self._mode, self._shown)
        other._low, other._is_singular = self._low, self._is_singular
        if self._numbers is not None:
            with translated(self):
                other._numbers = _Numbers.from_bytes(self._numbers.to_bytes(),
                                                     is_complex=self._pattern.is_complex)
                other._analysis = other._numbers.analysis
        return other

    def cholesky(self, A, beta=0):
        """A new Factor of A + beta I with this analysis."""
        other = Factor(_key, self._analysis, self._pattern, self._mode, self._shown)
        other.cholesky_inplace(A, beta)
        return other

    def cholesky_AAt(self, A, beta=0):
        """A new Factor of A A^H + beta I with this analysis."""
        other = Factor(_key, self._analysis, self._pattern, self._mode, self._shown)
        other.cholesky_AAt_inplace(A, beta)
        return other

    def update_inplace(self, C, subtract=False):
        """Makes this the Factor of A + C C^H, or A - C C^H; C is n x k, sparse, in the rows of A.

        Rank-one changes where L has the entries; else the sum is factored, in the order of the
        analysis if its entries are in L's pattern, and analyzed again if not.
        """
        F, C = self._ready(), checked(C)
        if C.shape[0] != F.n:
            raise CholmodError("C needs %d rows, and has %d" % (F.n, C.shape[0]))
        low = self._low + (-1 if subtract else 1) * product(C)
        with translated(self):
            try:
                F.rank_update(C, np.full(C.shape[1], -1.0 if subtract else 1.0))
                self._low = low
                return
            except (ours.PatternError, ours.UnsupportedError, ours.InaccurateError, TypeError):
                pass
        try:
            self._factor(low)
        except CholmodInvalidError:
            self._pattern = Pattern(low)
            with translated(self):
                self._shown = self.P()
                self._analysis = Analysis(self._pattern.first, triangle="lower",
                                          perm=self._shown)
                self._numbers = None
                self._order()
            self._factor_in_pattern(self._pattern.first)

    # ---- the parts ----

    def _ready(self):
        if self._numbers is None:
            raise CholmodInvalidError("a matrix was analyzed, but not factored")
        return self._numbers

    def P(self):
        """The order as n row numbers: A[P][:, P] is decomposed."""
        return self._analysis.perm if self._shown is None else self._shown.copy()

    def D(self):
        """D as n numbers."""
        with translated(self):
            d = self._ready().pivots()[0]
        return d if self._shown is None else d[self._from]

    def _lower(self):
        with translated(self):
            L = self._ready().lower()
        if self._shown is not None:
            L = L[self._from][:, self._from].tocsc()
            L.sort_indices()
        return L

    def L_D(self):
        """(L, D): a unit lower triangular sparse matrix and a diagonal one."""
        return self._lower(), sparse.dia_matrix((self.D()[None, :], [0]), shape=self._low.shape)

    def LD(self):
        """L with D in place of its diagonal."""
        L = self._lower()
        return (sparse.tril(L, -1) + sparse.diags(self.D())).tocsc()

    def _roots(self):
        d = self.D()
        if (d < 0).any():
            column = int(self.P()[int(np.argmax(d < 0))])
            raise CholmodNotPositiveDefiniteError("not positive definite: column %d" % column,
                                                  column, self)
        return np.sqrt(d)

    def L(self):
        """The L of L L^H, lower triangular; CholmodNotPositiveDefiniteError: a negative pivot."""
        return (self._lower() @ sparse.diags(self._roots())).tocsc()

    # ---- solves ----

    def solve_A(self, b):
        """x with A x = b; b is dense or sparse, (n,) or (n, count), and so is x."""
        return self._solve(b, None)

    __call__ = solve_A

    def solve_LDLt(self, b):
        """x with L D L^H x = b, without the order."""
        return self._solve(b, "L D LT")

    def solve_LD(self, b):
        """x with L D x = b."""
        return self._solve(b, "L D")

    def solve_DLt(self, b):
        """x with D L^H x = b."""
        return self._solve(b, "D LT")

    def solve_L(self, b, use_LDLt_decomposition=True):
        """x with L x = b, for the L of L_D() or, if False, of L()."""
        if not use_LDLt_decomposition:
            self._roots()
        return self._solve(b, "L" if use_LDLt_decomposition else "L sqrtD")

    def solve_Lt(self, b, use_LDLt_decomposition=True):
        """x with L^H x = b, for the L of L_D() or, if False, of L()."""
        if not use_LDLt_decomposition:
            self._roots()
        return self._solve(b, "LT" if use_LDLt_decomposition else "sqrtD LT")

    def solve_D(self, b):
        """x with D x = b."""
        return self._solve(b, "D")

    def apply_P(self, b):
        """P b: the rows of b in the order P()."""
        return self._solve(b, "P")

    def apply_Pt(self, b):
        """P' b: the reverse of apply_P."""
        return self._solve(b, "PT")

    def _solve(self, b, parts):
        F = self._ready()
        if sparse.issparse(b):
            if b.shape[0] != F.n:
                raise CholmodError("b needs %d rows, and has %d" % (F.n, b.shape[0]))
            b = b.tocsc()
            blocks = [sparse.csc_matrix(self._solve(b[:, k:k + _COLUMNS].toarray(), parts))
                      for k in range(0, b.shape[1], _COLUMNS)]
            return sparse.hstack(blocks, "csc") if blocks else sparse.csc_matrix(b.shape)
        b = np.asarray(b)
        if b.ndim not in (1, 2) or b.shape[0] != F.n:
            raise CholmodError("b needs %d rows, and has the shape %s" % (F.n, b.shape))
        if b.dtype.kind == "c" and not self._pattern.is_complex:
            raise CholmodError("the matrix is real, and b is complex")
        with translated(self):
            if parts is None:
                x = F.solve(b)
                self._warn_if_inconsistent(b)
                return x
            if parts in ("P", "PT"):
                order = self.P() if parts == "P" else np.argsort(self.P())
                return np.array(F._kind.dense(b, F.n, F.n).B[order])
            if self._shown is None:
                return F.solve_part(parts, b)
            return F.solve_part(parts, b[np.argsort(self._from)])[self._from]

    def _warn_if_inconsistent(self, b):
        if not self._is_singular:
            return
        F = self._numbers
        worst = F._inconsistency(F._kind.dense(b, F.n, F.n))
        if worst > _CONSISTENT:
            warnings.warn("the matrix is singular and b has no solution: |z' b| for a null vector "
                          "z is %.2g of sum |b|" % worst, CholmodWarning, stacklevel=4)

    # ---- numbers of the whole matrix ----

    def logdet(self):
        """log det A, -inf if A is singular; CholmodNotPositiveDefiniteError: a negative pivot."""
        with np.errstate(divide="ignore"):
            return float(2.0 * np.sum(np.log(self._roots())))

    def slogdet(self):
        """(1.0, log det A), as numpy.linalg.slogdet."""
        return 1.0, self.logdet()

    def det(self):
        """det A, which may overflow."""
        return float(np.exp(self.logdet()))

    def inv(self):
        """A^-1 as a sparse matrix (n, n), which has n^2 entries as a rule."""
        n = self._ready().n
        dtype = complex if self._pattern.is_complex else float
        return self.solve_A(sparse.identity(n, dtype, "csc"))


def analyze(A, mode="auto", ordering_method="default", use_long=None):
    """The order and the structure of L for a symmetric A, as a Factor without numbers."""
    return _analyze(_entries(A), mode, ordering_method)


def analyze_AAt(A, mode="auto", ordering_method="default", use_long=None):
    """The same for A A^H."""
    return _analyze(product_pattern(A), mode, ordering_method)


def cholesky(A, beta=0, mode="auto", ordering_method="default", use_long=None):
    """The Factor of A + beta I; only the lower triangle of A is read."""
    return _made(readable(A), beta, mode, ordering_method)


def cholesky_AAt(A, beta=0, mode="auto", ordering_method="default", use_long=None):
    """The Factor of A A^H + beta I."""
    factor = _analyze(product_pattern(A), mode, ordering_method)
    factor._factor(product(A), beta)
    return factor


def _entries(A):
    """The lower triangle, whose values are not looked at."""
    A = square(A)
    return A if A.nnz and np.isfinite(A.data).all() else _with_zeros(A)


def _with_zeros(A):
    return sparse.csc_matrix((np.zeros(A.data.size, A.dtype), A.indices, A.indptr), shape=A.shape)


def _made(low, beta, mode, ordering_method):
    """The Factor of low + beta I."""
    factor = _analyze(low, mode, ordering_method, beta)
    factor._factor_in_pattern(factor._pattern.first)
    return factor


def _analyze(low, mode, ordering_method, beta=0.0):
    if mode not in _modes:
        raise CholmodError("mode is one of %s, not %r" % (", ".join(_modes), mode))
    if ordering_method is not None and ordering_method not in _ordering_methods:
        raise CholmodError("ordering_method is one of %s, not %r" %
                           (", ".join(_ordering_methods), ordering_method))
    pattern = Pattern(low, beta)
    with translated():
        ordering = _ordering_methods[ordering_method or "default"]
        analysis = Analysis(pattern.first, triangle="lower", ordering=ordering)
    natural = np.arange(analysis.n, dtype=np.int32) if ordering == "natural" else None
    return Factor(_key, analysis, pattern, mode, natural)
