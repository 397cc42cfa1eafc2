"""The names of sksparse.cholmod 0.5 on sparse_local: programs written for it run unchanged.

sparse_local.stand_in("sksparse", "0.5") lets `from sksparse.cholmod import cho_factor` find this
module. As there, one triangle is read: the upper one, if not lower. What 0.5 takes without a word,
and what is done with singular matrices, is as in sparse_local.sksparse.cholmod. Unlike there, a
matrix of single precision is decomposed in double precision, only results are rounded, and row
numbers have 32 bits. supernodal_mode chooses no algorithm.
"""
import warnings

import numpy as np
from scipy import sparse

from .. import _errors as ours
from .._analysis import Analysis
from ..sksparse import cholmod as _old
from ..sksparse._errors import (CholmodError, CholmodGpuProblemError, CholmodNotInstalledError,
                                CholmodNotPositiveDefiniteError, CholmodOutOfMemoryError,
                                CholmodWarning, translated)
from ..sksparse._errors import CholmodInvalidError as CholmodInvalidInputError
from ..sksparse._errors import CholmodTooLargeError as CholmodOverflowError
from ..sksparse._pattern import Pattern, product, readable
from ._orders import (SeparatorTree, bisect, etree, matrix_of, metis, nesdis, symbfact, tree_of)

__all__ = ["CholeskyFactor", "CholmodError", "CholmodGpuProblemError", "CholmodInvalidInputError",
           "CholmodNotInstalledError", "CholmodNotPositiveDefiniteError",
           "CholmodOutOfMemoryError", "CholmodOverflowError", "CholmodSmallDiagonalWarning",
           "CholmodWarning", "SeparatorTree", "bisect", "cho_factor", "cho_solve", "cholesky",
           "etree", "ldl", "ldl_factor", "metis", "nesdis", "symbfact"]

_orders = {None: "natural", "natural": "natural", "postordered": "natural", "default": "nd",
           "best": "nd", "metis": "nd", "nesdis": "nd", "amd": "mindeg", "colamd": "mindeg"}
_sym_kinds = (None, "sym", "row", "col")
_modes = (None, "auto", "simplicial", "supernodal")
# what solve_part calls the systems of L L^H, where D is the identity, and of L D L^H
_systems = {True: {"A": None, "LDLt": "L D LT", "LD": "L sqrtD", "DLt": "sqrtD LT",
                   "L": "L sqrtD", "Lt": "sqrtD LT", "D": ""},
            False: {"A": None, "LDLt": "L D LT", "LD": "L D", "DLt": "D LT", "L": "L", "Lt": "LT",
                    "D": "D"}}


class CholmodSmallDiagonalWarning(CholmodWarning):
    """Never given: see D."""


class _Numbers(_old.Factor):
    """The decomposition behind a CholeskyFactor. L L^H needs positive pivots, L D L^H does not."""

    is_ll = True
    rcond = None  # not computed for these numbers

    def _judge(self):
        self.rcond = None
        negative = self._numbers.inertia[1]
        if self.is_ll and negative:
            column = int(self.P()[int(np.argmax(self.D() < 0))])
            self._numbers = None
            raise CholmodNotPositiveDefiniteError(
                "not positive definite: %d negative pivots, the first in column %d" %
                (negative, column), column, self)


def _one_of(value, names, what):
    if value not in names:
        raise ValueError("%s is one of %s, not %r" % (what, ", ".join(map(repr, names)), value))


class CholeskyFactor:
    """The analysis of A, and after factorize its decomposition L L^H or L D L^H = A[p][:, p].

    order     'default', 'best', 'metis', 'nesdis' (nested dissection), 'amd', 'colamd' (minimum
              degree); 'postordered'; None, 'natural': A itself is decomposed.
    sym_kind  'sym': A itself; 'row': A A^H; 'col': A^H A.
    """

    def __init__(self, A, *, lower=True, order="default", sym_kind=None, supernodal_mode=None):
        self._begin(A, 0.0, lower, order, sym_kind, supernodal_mode)

    def _begin(self, A, beta, lower, order, sym_kind, supernodal_mode):
        _one_of(order, tuple(_orders), "order")
        _one_of(sym_kind, _sym_kinds, "sym_kind")
        _one_of(supernodal_mode, _modes, "supernodal_mode")
        self._order, self._sym_kind, self._is_lower = order, sym_kind, bool(lower)
        A = matrix_of(A)
        kind = A.dtype.char if A.dtype.char in "fF" else "D" if A.dtype.kind == "c" else "d"
        self._dtype = np.dtype(kind)
        low = self._read(A, self._is_lower)
        natural = np.arange(low.shape[0], dtype=np.int32) if order in (None, "natural") else None
        self._analyze(Pattern(low, beta), {"ordering": _orders[order]}, natural)

    def _read(self, A, lower):
        """The matrix whose lower triangle is decomposed."""
        A = matrix_of(A)
        if self._sym_kind == "row":
            return product(A)
        if self._sym_kind == "col":
            return product(A.conj().T.tocsc())
        if A.shape[0] != A.shape[1]:
            raise ValueError("a square matrix is needed, not %d x %d" % A.shape)
        return readable(A, "lower" if lower else "upper")

    def _analyze(self, pattern, chosen, shown):
        with translated():
            analysis = Analysis(pattern.first, triangle="lower", **chosen)
        self._f = _Numbers(_old._key, analysis, pattern, "auto", shown)

    @classmethod
    def _of(cls, other, numbers):
        self = cls.__new__(cls)
        self.__dict__.update(other.__dict__)
        self._f = numbers
        return self

    # ---- factorization and changes; all return the object itself ----

    def factorize(self, A, ldl=None, beta=0.0, lower=None):
        """Decomposes A + beta I, whose pattern is in the analyzed one; ldl None: as the last time,
        L L^H at first. CholmodNotPositiveDefiniteError: L L^H of a matrix that is not positive
        semidefinite."""
        for name, flag in (("ldl", ldl), ("lower", lower)):
            if flag is not None and not isinstance(flag, (bool, np.bool_)):
                raise ValueError("%s is True, False or None, not %r" % (name, flag))
        if not np.isscalar(beta):
            raise ValueError("beta is a number")
        if ldl is not None:
            self._f.is_ll = not ldl
        self._is_lower = self._is_lower if lower is None else bool(lower)
        self._f._factor(self._read(A, self._is_lower), beta)
        return self

    def update(self, C):
        """Adds C C^H to the matrix; C is sparse, n x k, in the rows of A."""
        return self._changed(C, False)

    def downdate(self, C):
        """Subtracts C C^H from the matrix."""
        return self._changed(C, True)

    def _changed(self, C, is_less):
        if not sparse.issparse(C) or C.shape[0] != self.N:
            raise ValueError("C is a sparse matrix of %d rows" % self.N)
        self._f.update_inplace(C.tocsc(), subtract=is_less)
        self._f.rcond = None
        return self

    def rowadd(self, k, C):
        """Row and column k of the matrix in the order of the factor, A[perm][:, perm], become C,
        sparse, n x 1, whose rows are in this order, too."""
        if not sparse.issparse(C) or C.shape != (self.N, 1):
            raise ValueError("C is a sparse matrix of %d x 1" % self.N)
        C = C.tocoo()
        return self._with_row(k, C.row, C.data)

    def rowdel(self, k):
        """Row and column k of A[perm][:, perm] become those of the identity."""
        return self._with_row(k, np.array([k]), np.ones(1))

    def _with_row(self, k, rows, values):
        if not 0 <= k < self.N:
            raise IndexError("row %r of a matrix of %d rows" % (k, self.N))
        self._f._ready()
        p = self._f.P()
        k, rows = p[k], p[rows]
        low = self._f._low.copy()
        at_row = low.indices == k
        columns = np.union1d(np.repeat(np.arange(self.N), np.diff(low.indptr))[at_row], [k])
        low.data[at_row] = 0.0
        low.data[low.indptr[k]:low.indptr[k + 1]] = 0.0
        is_right = rows < k  # in row k of the lower triangle, where the entry is conjugate
        values = np.where(is_right, np.conj(values), values)
        places = np.where(is_right, k, rows), np.where(is_right, rows, k)
        added = low + sparse.csc_matrix((values, places), shape=low.shape)
        try:
            low = self._f._pattern.matrix(added)
        except CholmodInvalidInputError:
            added = _union(low, sparse.csc_matrix((values, places), shape=low.shape))
            return self._anew(added, added)
        columns = np.union1d(columns, rows[is_right])
        with translated(self):
            try:
                self._f._numbers.change_entries(low, columns=columns.astype(np.int32))
                self._f._low = low
                self._f._judge()
            except (ours.PivotError, ours.StateError):
                self._f._factor_in_pattern(low)
        return self

    def _anew(self, pattern, low):
        """Another pattern in the order of this one."""
        kept = self._f
        try:
            self._analyze(Pattern(pattern), {"perm": kept.P()}, kept.P())
            self._f.is_ll = kept.is_ll
            self._f._factor(low)
        except CholmodError:
            self._f = kept  # as it was
            raise
        return self

    def resymbol(self, A, is_permuted=True):
        """Analyzes the pattern of A in the order of this factor, as after changes that leave zeros;
        is_permuted: A is A[p][:, p] already. The numbers stay. CholmodInvalidInputError: the
        matrix has another entry than 0 outside."""
        self._f._ready()
        A = matrix_of(A)
        if A.shape != (self.N, self.N):
            raise ValueError("a matrix of %d rows is needed" % self.N)
        if is_permuted:
            back = np.argsort(self.perm)
            A = A[back][:, back].tocsc()
        low = self._f._low.copy()
        low.eliminate_zeros()
        ones = sparse.csc_matrix((np.ones(A.data.size, low.dtype), A.indices, A.indptr),
                                 shape=A.shape)
        return self._anew(sparse.tril(ones, format="csc"), low)

    def copy(self):
        """A factor with numbers of its own."""
        numbers = self._f.copy()
        numbers.__class__, numbers.is_ll = _Numbers, self._f.is_ll
        return self._of(self, numbers)

    # ---- what it is ----

    @property
    def N(self):
        return self._f._pattern.shape[0]

    @property
    def is_ll(self):
        return self._f.is_ll

    @property
    def is_numeric(self):
        return self._f._numbers is not None

    @property
    def sym_kind(self):
        return self._sym_kind or "sym"

    @property
    def is_lower(self):
        return self._is_lower

    @property
    def is_super(self):
        return False

    @property
    def itype(self):
        return np.dtype(np.int32)

    @property
    def dtype(self):
        return self._dtype

    @property
    def order(self):
        return self._order or "natural"

    @property
    def perm(self):
        p = self.get_perm()
        p.flags.writeable = False
        return p

    @property
    def colcount(self):
        """Entries of the columns of L."""
        return self._counts()[self.perm]

    def _counts(self):
        width = self._f._analysis._kind.width
        if width == 1:
            return tree_of(self._f._analysis)[1]
        L = self._f._lower()
        counts = np.empty(self.N, dtype=np.int32)
        counts[self.perm] = np.diff(L.indptr)
        return counts

    @property
    def nnz(self):
        return int(self.colcount.sum())

    @property
    def rcond(self):
        """A rough reciprocal condition number, from the pivots: the smallest by the largest; -1
        before factorize."""
        if not self.is_numeric:
            return -1.0
        if self._f.rcond is None:
            d = abs(self._f.D())
            self._f.rcond = (float(d.min() / d.max()) if d.size and d.max() > 0 else
                             float(d.size == 0))
        return self._f.rcond

    @property
    def factor(self):
        """L of L L^H, or L with D in place of its unit diagonal; lower triangular, read-only."""
        view = self._typed(self._f.L() if self.is_ll else self._f.LD())
        for array in (view.data, view.indices, view.indptr):
            array.flags.writeable = False
        return view

    def _typed(self, matrix):
        return sparse.csc_array(matrix, dtype=self.dtype)

    @property
    def L(self):
        """L of L L^H or of L D L^H, as the factor is."""
        return self._typed(self._f.L() if self.is_ll else self._f._lower())

    @property
    def R(self):
        """L^H."""
        return self.L.conj().T.tocsc()

    @property
    def D(self):
        """D of L D L^H; the identity for L L^H."""
        d = np.ones(self.N) if self.is_ll else self._f.D()
        return sparse.dia_array((d[None, :].astype(self.dtype), [0]), shape=(self.N, self.N))

    def change_factor(self, kind=None):
        """Makes this L L^H ('LL') or L D L^H ('LDL'); None: the other one. Returns the object."""
        _one_of(kind, (None, "LL", "LDL"), "kind")
        is_ll = not self.is_ll if kind is None else kind == "LL"
        self._f._ready()
        if is_ll:
            self._f._roots()  # raises an error where a pivot is negative
        self._f.is_ll = is_ll
        return self

    def get_factor(self, kind=None, lower=None):
        """L ('LL'), or L and D ('LDL'); None: as factorize made it. lower=False: L^H instead of L;
        None: as the triangle that was read."""
        _one_of(kind, (None, "LL", "LDL"), "kind")
        is_ll = self.is_ll if kind is None else kind == "LL"
        L = self._typed(self._f.L() if is_ll else self._f._lower())
        if not (self._is_lower if lower is None else lower):
            L = L.conj().T.tocsc()
        d = self._f.D()[None, :].astype(self.dtype)
        return L if is_ll else (L, sparse.dia_array((d, [0]), shape=L.shape))

    def get_perm(self):
        """p, with A[p][:, p] decomposed."""
        return np.array(self._f.P())

    def __repr__(self):
        return "CholeskyFactor(N=%d, is_ll=%s, order=%s)" % (self.N, self.is_ll, self.order)

    # ---- solves and numbers ----

    def solve(self, b, system="A"):
        """x with A x = b, dense or sparse as b, (n,) or (n, count).

        system  'LDLt', 'LD', 'DLt', 'L', 'Lt', 'D': that product in place of A, in the order of the
                factor, where b[perm] stands for b; of L L^H D is the identity.
        TypeError: b has a type that the one of the matrix does not hold. CholmodWarning: the pivots
        are so far apart that x may have no correct digit.
        """
        if not isinstance(b, np.ndarray) and not sparse.issparse(b):
            raise ValueError("b is an array or a sparse matrix, not %s" % type(b).__name__)
        if b.ndim not in (1, 2) or b.shape[0] != self.N:
            raise ValueError("b needs %d rows, and has the shape %s" % (self.N, b.shape))
        if not np.can_cast(b.dtype, self.dtype):
            raise TypeError("the matrix is %s, which does not hold b, %s" % (self.dtype, b.dtype))
        _one_of(system, tuple(_systems[True]), "system")
        self._f._ready()
        parts = _systems[self.is_ll][system]
        if parts == "":
            return self._typed(b.copy()) if sparse.issparse(b) else b.astype(self.dtype)
        if 0 < self.rcond < self.N * np.finfo(np.float64).eps:
            warnings.warn("nearly singular: rcond is %.2g" % self.rcond, CholmodWarning,
                          stacklevel=2)
        x = self._f._solve(b, parts)
        return self._typed(x) if sparse.issparse(b) else x.astype(self.dtype, copy=False)

    def logdet(self):
        """log det A, -inf if A is singular."""
        return self._f.logdet()

    def slogdet(self):
        """(1.0, log det A), as numpy.linalg.slogdet."""
        return self.dtype.type(1.0), self.logdet()

    def det(self):
        """det A, which may overflow."""
        return self.dtype.type(np.exp(self.logdet()))

    def inv(self):
        """A^-1 as a sparse matrix."""
        return self._typed(self._f.inv())


def _union(low, more):
    """low + more with all entries of both, also those that are 0."""
    both = [M.tocoo() for M in (low, more)]
    rows, columns, values = (np.concatenate([getattr(M, name) for M in both])
                             for name in ("row", "col", "data"))
    return sparse.csc_matrix((values, (rows, columns)), shape=low.shape)


def cho_factor(A, beta=0.0, *, lower=False, order="default", sym_kind=None,
               supernodal_mode=None):
    """The CholeskyFactor L L^H of A + beta I."""
    return _factored(A, False, beta, lower, order, sym_kind, supernodal_mode)


def ldl_factor(A, beta=0.0, *, lower=True, order="default", sym_kind=None, supernodal_mode=None):
    """The CholeskyFactor L D L^H of A + beta I."""
    return _factored(A, True, beta, lower, order, sym_kind, supernodal_mode)


def _factored(A, ldl, beta, lower, order, sym_kind, supernodal_mode):
    made = CholeskyFactor.__new__(CholeskyFactor)
    made._begin(A, beta, lower, order, sym_kind, supernodal_mode)
    made._f.is_ll = not ldl
    made._f._factor_in_pattern(made._f._pattern.first)
    return made


def cho_solve(A, b, beta=0.0, *, lower=False, order="default", sym_kind=None,
              supernodal_mode=None):
    """x with (A + beta I) x = b, dense or sparse as b."""
    return cho_factor(A, beta, lower=lower, order=order, sym_kind=sym_kind,
                      supernodal_mode=supernodal_mode).solve(b)


def cholesky(A, beta=0.0, *, lower=False, order="default", sym_kind=None,
             supernodal_mode=None):
    """(R, p) with R^H R = (A + beta I)[p][:, p], or L with L L^H if lower; R alone if order is
    None, where A itself is decomposed."""
    f = cho_factor(A, beta, lower=lower, order=order, sym_kind=sym_kind,
                   supernodal_mode=supernodal_mode)
    return f.get_factor() if order is None else (f.get_factor(), f.get_perm())


def ldl(A, beta=0.0, *, lower=True, order="default", sym_kind=None, supernodal_mode=None):
    """(L, D, p) with L D L^H = (A + beta I)[p][:, p], or L^H in place of L if not lower; (L, D) if
    order is None."""
    f = ldl_factor(A, beta, lower=lower, order=order, sym_kind=sym_kind,
                   supernodal_mode=supernodal_mode)
    return f.get_factor() if order is None else f.get_factor() + (f.get_perm(),)
