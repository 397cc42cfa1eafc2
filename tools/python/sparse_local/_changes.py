"""Changes of a factor in place, and factors that are made from one: submatrices, edited meshes."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError, UnsupportedError
from ._library import Stats, as_dict, check, lib, new_options
from ._matrix import Matrix
from ._options import Chosen

_METHODS = ("none", "update", "reach", "refactor")
_REASONS = ("cheapest", "unsuited", "drift", "refused", "columns")


class Changes:
    """What Factor inherits: changes. No other thread may use the factor during change_entries and
    rank_update; submatrix and edit read it only."""

    def change_entries(self, A=None, rows=None, columns=None, deltas=None, *, was=None):
        """Follows changes of some entries or columns of A. changed["method"] is the way that was
        taken: 'none', 'update' (rank-one changes), 'reach' (what the changes reach in L is computed
        anew) or 'refactor'. changed["reason"] is why: 'cheapest', 'unsuited' (null or 2x2 pivots,
        or no numbers), 'drift' (errors of earlier changes), 'refused' (a pivot) or 'columns'.

        A        the changed matrix, in the analyzed pattern. By entries the cheapest way is taken;
                 without A rank-one changes, with the errors of rank_update.
        rows, columns, deltas  entries: a(i, j) = a(j, i) has changed by delta, each pair once. An
                 edge between i and j that gains the weight w is (i, j, -w), (i, i, w) and
                 (j, j, w).
        was      in place of them the matrix before the change, stored as A: the entries that differ
                 are found.
        columns  alone: columns in which entries have changed; what they reach in L is computed
                 anew, which pays where they are in one place.
        Errors   as in refactor, after which the factor may have no numbers; ArgumentError: an index
                 out of range; StateError: the factor is mapped. Entries that have changed and are
                 not named are not noticed: the backward error of refine with 0 steps tells whether
                 this is a factor of A.
        Cost     nothing of O(n) by rank-one changes, but for was: one pass over both arrays.
        """
        by_columns = columns is not None and rows is None and deltas is None
        if not by_columns:
            self._refuse_complex("change_entries by entries", "refactor, or columns alone")
        matrix = None if A is None else self.analysis._matrix(A)
        if was is not None:
            if matrix is None or not (rows is None and columns is None and deltas is None):
                raise ArgumentError("was needs the changed matrix, and no entries or columns")
            rows, columns, deltas = _differences(matrix, self.analysis._matrix(was),
                                                 self.analysis.stats["triangle"])
        if by_columns:
            if matrix is None:
                raise ArgumentError("columns alone need the changed matrix")
            keep, j, count = self._kind.set(columns)
            i = delta = None
        else:
            numbers = _entries(rows, columns, deltas)
            i, j, delta = map(arrays.address, numbers)
            count = numbers[0].size
        has_way_out = matrix is not None and not by_columns  # a failed factor is refactored
        pointer, stats = self._factor.pointer if has_way_out else self._pointer, Stats()
        self._nulls = None
        self._checked(self._lib.sl_factor_change_entries(
            pointer, None if matrix is None else matrix.reference(), i, j, delta,
            count, self._work(), ctypes.byref(stats)), stats)
        return self._note(stats)

    def _note(self, stats):
        self.changed = as_dict(stats.change)
        self.changed["method"] = _METHODS[stats.change.method]
        self.changed["reason"] = _REASONS[stats.change.reason]
        return self

    def rank_update(self, V, sigma=None):
        """Makes this the factor of A + V diag(sigma) V'.

        V      n x k, sparse. The rows of a vector are in the column of L of the first of them: e_i,
               and e_i - e_j for an entry (i, j) of A.
        sigma  k weights of any sign; None: 1.
        Errors    PatternError: V would create entries; PivotError: a pivot would change its sign or
                  vanish. The factor is then as it was, bit for bit. UnsupportedError: null or 2x2
                  pivots, L in float.
        Cost      4 flops per vector and entry of L in the columns on its path.
        """
        self._refuse_complex("rank_update", "refactor")
        matrix, stats = Matrix(V.tocsc() if hasattr(V, "tocsc") else V), Stats()
        if matrix.is_complex:
            raise TypeError("V must be real")
        if sigma is not None:
            sigma = arrays.vector(sigma, matrix.csc.n_cols, "sigma")
        self._nulls = None
        self._checked(self._lib.sl_factor_rank_update(self._pointer, matrix.reference(),
                                                 None if sigma is None else arrays.address(sigma),
                                                 self._work(), ctypes.byref(stats)), stats)
        return self._note(stats)

    def _refuse_complex(self, what, instead):
        if self._kind is arrays.COMPLEX:
            raise UnsupportedError("%s of a complex matrix; use %s" % (what, instead))

    def submatrix(self, A, rows):
        """The Factor of A[rows][:, rows], from this one; row k of it is row rows[k] of A.

        A is the factored matrix. The result does not depend on this factor; refactor, changes and
        save raise StateError, and what compares a matrix with the pattern PatternError.
        PivotError: the submatrix is singular. Cost: 0.4 to 1.5 of analyzing and factoring the
        submatrix in a given order: less, the more supernodes are in it as a whole.
        """
        from ._analysis import Analysis
        keep, address, count = self._kind.set(rows)
        if address is None:
            raise ArgumentError("a set of rows is needed")
        matrix, stats = self.analysis._matrix(A), Stats()
        symbolic, factor = ctypes.c_void_p(), ctypes.c_void_p()
        check(lib.sl_factor_submatrix(ctypes.byref(symbolic), ctypes.byref(factor), self._pointer,
                                     matrix.reference(), address, count, None,
                                     ctypes.byref(stats)), stats, self._kind.width)
        analysis = Analysis._of(symbolic.value, None, self._kind)
        return type(self)._of(analysis, factor.value, None, self._definite)

    def edit(self, A, B, new_of, **numbers):
        """The Factor of B, an edited A: rows and entries came and went, as in a remeshed surface.

        A        the factored matrix; B: the edited one, of any size.
        new_of   n rows of A: new_of[i] is the row of B that row i has become, or -1. Rows of B that
                 do not occur are new.
        numbers  options of Factor that the factorization reads.
        Errors   as Factor, and ArgumentError: a row of B out of range or twice. This factor stays
                 as it is. Cost: where few rows are edited in one place, about a third of a
                 factorization and little of an analysis. See analysis.edited of the result.
        """
        from ._analysis import Analysis
        matrix, other = self.analysis._matrix(A), Matrix(B)
        if other.is_complex != (self._kind is arrays.COMPLEX):
            raise TypeError("both matrices are real, or both complex")
        width, triangle = self._kind.width, self.analysis._triangle
        new_of = arrays.option_array(new_of, self.n, np.int32, "new_of")
        if width == 2:
            new_of = np.stack([np.where(new_of < 0, -1, 2 * new_of),
                               np.where(new_of < 0, -1, 2 * new_of + 1)], 1).ravel()
            new_of = np.ascontiguousarray(new_of, dtype=np.int32)
        options, stats, symbolic = new_options(), Stats(), ctypes.c_void_p()
        options.triangle = other.triangle(triangle)
        check(self._lib.sl_symbolic_edit(
            ctypes.byref(symbolic), self._symbolic.pointer, matrix.reference(), other.reference(),
            arrays.address(new_of), ctypes.byref(options), ctypes.byref(stats)), stats, width)
        analysis = Analysis._of(symbolic.value, triangle, self._kind)
        analysis.edited = as_dict(stats.edit)
        if triangle is None:
            other.check_symmetric()
        numbers = {"definite": self._definite, "threads": self._threads, **numbers}
        definite = numbers.pop("definite")
        chosen, factor = Chosen(other.n, width == 2).numbers(**numbers), ctypes.c_void_p()
        check(self._lib.sl_factor_edit(
            ctypes.byref(factor), self._pointer, symbolic.value, other.reference(),
            arrays.address(new_of), ctypes.byref(chosen.options), ctypes.byref(stats)), stats,
            width)
        edited = type(self)._of(analysis, factor.value, numbers["threads"], definite)
        edited.reused = as_dict(stats.reuse)
        edited.reused["reason"] = _REASONS[stats.reuse.reason]
        edited._consistency = numbers.get("consistency_tolerance") or 1e-6
        edited._has_mass = numbers.get("mass") is not None
        edited._check_definite()
        return edited


def _entries(rows, columns, deltas):
    """Entries that change, as arrays of one length, and finite."""
    if rows is None or columns is None or deltas is None:
        raise ArgumentError("rows, columns and deltas are needed, or columns alone, or was")
    i, j = arrays.rows(rows)[0], arrays.rows(columns)[0]
    delta = arrays.vector(deltas, i.size, "deltas")
    if i.size != j.size:
        raise ArgumentError("as many columns as rows are needed")
    arrays.check_finite(delta, "deltas", i)
    return i, j, delta


def _differences(matrix, was, triangle):
    """Entries of the triangle that the factor reads in which two matrices of a pattern differ."""
    if not (np.array_equal(matrix.p, was.p) and np.array_equal(matrix.i, was.i)):
        raise ArgumentError("both matrices need the same pattern, stored alike")
    at = np.flatnonzero(matrix.x != was.x)
    columns = (np.searchsorted(matrix.p, at, side="right") - 1).astype(np.int32)
    rows = matrix.i[at].astype(np.int32)
    read = rows <= columns if triangle == 2 else rows >= columns
    return rows[read], columns[read], (matrix.x - was.x)[at][read]
