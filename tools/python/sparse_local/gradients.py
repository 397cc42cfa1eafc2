"""Derivatives of solves and determinants, exact, with NumPy alone; autograd.py is for torch.

Let A x = b, let l be a number computed from x, and g = dl/dx. With lambda = A^-1 g

    dl/db = lambda,   dl/da(i, j) = -(lambda(i) x(j) + lambda(j) x(i)) for a pair a(i, j) = a(j, i),
    dl/da(i, i) = -lambda(i) x(i),
    d log |det A| / da(i, j) = 2 (A^-1)(i, j),   d log |det A| / da(i, i) = (A^-1)(i, i),
    d sum g(r, c) (A^-1)(r, c) = -trace(A^-1 G A^-1 dA) with the matrix G = (g + g') / 2.

Gradients by the stored values of a matrix have the order of A.data. Where A stores one triangle, a
value is a pair of equal entries. Where it stores both, each of the two values gets half of the
derivative of the pair, so that the gradient is symmetric.

A factor made with mass is refused: its solutions are not A^-1 b. With null_pivots='skip' the
formulas hold for changes that leave the null vectors as they are, such as weights of edges, and for
g with the sum 0 over each component, which solves check. With regularization they are those of
A + E, with storage='float' they have the accuracy of float.
"""
import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError, UnsupportedError
from ._factor import Factor
from ._matrix import Matrix, from_triplets
from ._saved_set import Selected

__all__ = ["solve_gradient", "logdet_gradient", "pairs_gradient", "LocalGradient", "Stored"]

_SOLVED = 128  # columns of G up to which solves take less time than a factor of twice the size
_TOGETHER = 64  # columns of such a solve
_STEP = 1e-60  # its square is nothing beside 1, and its third power a normal number


class Stored:
    """Rows i and columns j of the stored values of A, and the weight of each: 1 for a pair of equal
    entries that is stored once, 1/2 for entries of the diagonal and of pairs that are stored
    twice."""

    def __init__(self, A, triangle=None):
        if triangle is not None:
            raise ArgumentError("a matrix that is read by one of its two triangles: store one")
        A = _compressed(A)
        view = Matrix(A, is_ordered=False)
        if view.is_complex:
            raise UnsupportedError("derivatives by a complex matrix")
        p, i = np.asarray(A.indptr), np.asarray(A.indices)
        j = np.repeat(np.arange(len(p) - 1), np.diff(p))
        self.rows, self.columns = (j, i[:j.size]) if view.is_turned else (i[:j.size], j)
        has_both = (self.rows > self.columns).any() and (self.rows < self.columns).any()
        self.weights = np.where((self.rows == self.columns) | has_both, 0.5, 1.0)

    def has(self, rows, columns):
        """Are all of these entries stored, in one of the triangles?"""
        n = 1 + max(s.max(initial=0) for s in (self.rows, self.columns, rows, columns))
        keys = [np.maximum(i, j) * np.int64(n) + np.minimum(i, j)
                for i, j in ((rows, columns), (self.rows, self.columns))]
        return bool(np.isin(*keys).all())

    def products(self, lam, x):
        """The gradient by the stored values, from lambda and x of all rows."""
        lam, x = np.asarray(lam), np.asarray(x)
        if lam.ndim == 1:
            lam, x = lam[:, None], x[:, None]
        i, j = self.rows, self.columns
        sums = np.zeros(i.size)
        for k in range(x.shape[1]):
            sums += lam[i, k] * x[j, k] + lam[j, k] * x[i, k]
        return -self.weights * sums


def _compressed(A):
    return A if getattr(A, "format", "csc") in ("csc", "csr") else A.tocsc()


def _check_kind(factor):
    if factor._kind is arrays.COMPLEX:
        raise UnsupportedError("derivatives by a complex matrix")
    if factor._has_mass:
        raise UnsupportedError("derivatives of solutions with mass")


def solve_gradient(factor, A, x, g):
    """(dl/db, dl/dA.data) for x = factor.solve(b) and g = dl/dx.

    A     the factored matrix, of which only the pattern is read.
    x, g  (n,) or (n, count); the gradient by A is the sum over the columns.
    Errors as Factor.solve with g. Cost: a full solve, and O(entries of A) for each column.
    """
    _check_kind(factor)
    stored = Stored(A, factor.analysis._triangle)
    x = arrays.real_array(x, "x")
    lam = factor.solve(arrays.real_array(g, "g"))
    if x.shape != lam.shape or A.shape != factor.shape:
        raise ArgumentError("x, g and A do not fit: shapes %s, %s, %s" %
                            (x.shape, lam.shape, A.shape))
    return lam, stored.products(lam, x)


def logdet_gradient(factor, A, selected=None):
    """d log |det A| / dA.data. Cost: a selected inverse, about two factorizations, unless one is
    given. UnsupportedError: 2x2 pivots."""
    _check_kind(factor)
    stored = Stored(A, factor.analysis._triangle)
    if A.shape != factor.shape:
        raise ArgumentError("a matrix of another size")
    selected = Selected(factor) if selected is None else selected
    return 2.0 * stored.weights * selected.entries(stored.rows, stored.columns)


def pairs_gradient(factor, A, rows, columns, g):
    """d sum(g * factor.pairs(rows, columns)) / dA.data, for variances rows is columns.

    A  the factored matrix.
    UnsupportedError: 2x2 pivots, skipped null pivots. Cost: two full solves for each column that
    occurs, or each row if these are fewer; where they are many, a factor and a selected inverse of
    twice the size, about ten times the time of those of A.
    """
    _check_kind(factor)
    stored = Stored(A, factor.analysis._triangle)
    if rows is None or columns is None:
        raise ArgumentError("sets of rows are needed")
    rows, columns = (arrays.rows(s)[0].astype(np.int64) for s in (rows, columns))
    g = arrays.vector(g, rows.size, "g")
    arrays.check_finite(g, "g")
    if columns.size != rows.size or A.shape != factor.shape:
        raise ArgumentError("rows, columns and A do not fit")
    if rows.size and not (0 <= min(rows.min(), columns.min()) and
                          max(rows.max(), columns.max()) < factor.n):
        raise ArgumentError("a row out of range")
    info = factor.stats["factor"]
    if info["null"]:
        raise UnsupportedError("derivatives of entries of a pseudo-inverse")
    ends = np.unique(columns)
    if np.unique(rows).size < ends.size:
        rows, columns = columns, rows
        ends = np.unique(columns)
    if ends.size > _SOLVED and not info["regularized"] and stored.has(rows, columns):
        return _by_twins(factor, A, stored, rows, columns, g)
    order = np.argsort(columns, kind="stable")
    rows, columns, g = rows[order], columns[order], g[order]
    sums = np.zeros(stored.rows.size)
    for k in range(0, ends.size, _TOGETHER):
        some = ends[k:k + _TOGETHER]
        first, last = np.searchsorted(columns, [some[0], some[-1] + 1])
        place = np.searchsorted(some, columns[first:last])
        right = np.zeros((2, some.size, factor.n))
        np.add.at(right[0], (place, rows[first:last]), g[first:last])
        right[1, np.arange(some.size), some] = 1.0
        sums += stored.products(factor.solve(right[0].T), factor.solve(right[1].T))
    return sums


def _by_twins(factor, A, stored, rows, columns, g):
    """The same from the selected inverse of [A, t G; t G, A] with a tiny t. The block beside the
    diagonal of that inverse is -t A^-1 G A^-1, up to the relative size t^2: each of its terms has t
    as a factor, so that nothing cancels. Rows k and n + k are 2 k and 2 k + 1 here."""
    size = abs(g).max(initial=0.0)
    if size == 0.0:
        return np.zeros(stored.rows.size)
    values = np.asarray(_compressed(A).data[:stored.rows.size], dtype=float)
    t = _STEP * abs(values).max(initial=0.0)
    low = stored.rows >= stored.columns
    if (stored.rows < stored.columns).any() and not (stored.rows > stored.columns).any():
        i, j = stored.columns, stored.rows
    else:
        i, j, values = stored.rows[low], stored.columns[low], values[low]
    off, zeros = i > j, np.zeros(i.size)
    r, c = np.maximum(rows, columns), np.minimum(rows, columns)
    g = np.where(r == c, 1.0, 0.5) * (g / size) * t
    apart = r > c
    twins = from_triplets(
        2 * factor.n,
        np.concatenate([2 * i, 2 * i + 1, 2 * i + 1, 2 * i[off], 2 * r + 1, 2 * r[apart]]),
        np.concatenate([2 * j, 2 * j + 1, 2 * j, 2 * j[off] + 1, 2 * c, 2 * c[apart] + 1]),
        np.concatenate([values, values, zeros, zeros[off], g, g[apart]]))
    order = np.stack([2 * factor.perm, 2 * factor.perm + 1], axis=1).ravel()
    inverse = Selected(Factor(twins, perm=order, threads=factor._threads))
    found = inverse.entries(2 * stored.rows + 1, 2 * stored.columns)
    return 2.0 * stored.weights * (found / t) * size


class LocalGradient:
    """Local solves with their derivatives by b and by chosen entries of A: two local solves.

    bset, xset     rows where b is not 0, and where x is wanted.
    rows, columns  entries (i, j) of A, each pair a(i, j) = a(j, i) once.

    Nothing takes time proportional to n, neither this nor the solves. The plans stay valid after
    refactor and change_entries of the factor.
    """

    def __init__(self, factor, bset, xset, rows=(), columns=()):
        _check_kind(factor)
        self._factor = factor
        self.bset, self.xset = (arrays.rows(s)[0] for s in (bset, xset))
        self.rows, self.columns = (arrays.rows(s)[0] for s in (rows, columns))
        if self.bset is None or self.xset is None:
            raise ArgumentError("sets of rows are needed")
        if self.rows.size != self.columns.size:
            raise ArgumentError("as many columns as rows are needed")
        ends = np.concatenate([self.rows, self.columns])
        self._forth = factor.plan(self.bset, np.concatenate([self.xset, ends]))
        self._back = factor.plan(self.xset, np.concatenate([self.bset, ends]))

    def solve(self, b):
        """(x on xset, kept): b has the shape (len(bset),) or (len(bset), count); kept is what
        gradient needs of this solve."""
        x = self._forth.solve(arrays.real_array(b, "b"))
        n = self.xset.size
        return x[:n].copy(), x[n:]

    def gradient(self, kept, g):
        """(dl/db on bset, dl/da of the entries) for g = dl/dx on xset, of the shape of x.

        The factor has the numbers that it had in solve. The second is the sum over the columns."""
        lam = self._back.solve(arrays.real_array(g, "g"))
        n, m = self.bset.size, self.rows.size
        lam_i, lam_j = lam[n:n + m], lam[n + m:]
        x_i, x_j = kept[:m], kept[m:]
        if lam_i.shape != x_i.shape:
            raise ArgumentError("g has the shape of x")
        sums = lam_i * x_j + lam_j * x_i
        sums = sums if sums.ndim == 1 else sums.sum(axis=1)
        return lam[:n].copy(), -np.where(self.rows == self.columns, 0.5, 1.0) * sums
