"""Constraints: rows of a system that solves hold at given values, on top of a factor."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError, Error, PivotError, UnsupportedError
from ._fixed import FixedRows
from ._library import Handle, Stats, as_dict, check, lib


# Beyond so many rows, measured on biharmonic systems of 4,000 and 12,000 rows, pins cost more than
# a factor of the other rows; below half of it they are pins again.
MANY = 400


class Constraints:
    """Rows, or linear combinations of rows, that solves hold at given values. The factor stays.

    For a definite A this minimizes x' A x / 2 - b' x under these equalities. A singular Laplacian
    (null_pivots='skip') becomes regular with one pin in each component. Made by Factor.constraints.
    With A, the matrix of the factor, more than 400 rows are fixed in a factor of the others instead
    (FixedRows), which the next solve makes; equalities and plans then raise ArgumentError.

    Errors    UnsupportedError: pivots of both signs, 2x2 pivots; StateError: the factor has changed
              since (refactor); PivotError: a row is held already.
    Cost      a forward sweep for each pin, a full solve for each solution; without A, the square of
              the number of pins.
    Threads   add, release and refactor need the pins for themselves; solve does not.
    """

    def __init__(self, factor, rows=(), *, A=None):
        pointer = ctypes.c_void_p()
        check(lib.sl_constraints_create(ctypes.byref(pointer), factor._pointer, None))
        self._factor, self._lib = factor, factor._lib
        self._held = Handle("constraints", pointer.value, factor._factor, factor._symbolic)
        self._count = 0
        self._check_size(A)
        self._A, self._rows, self._fixed, self._equalities = A, [], None, 0
        self._is_many = False
        self.stats = {}
        if len(np.asarray(rows)):
            self.add(rows)

    def _check_size(self, A):
        n = self._factor.n
        if A is not None and getattr(A, "shape", None) != (n, n):
            raise ArgumentError("A has to be the matrix of the factor, %d x %d" % (n, n))

    def __len__(self):
        return self._count

    def _done(self, status, stats, count):
        check(status, stats, self._factor._kind.width)
        self._count = count
        self.stats = as_dict(stats.constraints)
        return self

    def add(self, rows, values=None):
        """Adds pins, all or none; they become the last ones, in the order of rows. With values,
        adds one equality: the sum of values[k] x[rows[k]] is held. Of real matrices."""
        if values is not None:
            return self._add_equality(rows, values)
        keep, address, count = self._factor._kind.set(rows)
        if address is None:
            raise ArgumentError("a set of rows is needed")
        stats, width = Stats(), self._factor._kind.width
        self._factor._pointer
        new = [int(row) for row in np.asarray(rows).ravel()]
        if self._is_many or (self._A is not None and new and not self._equalities and
                             self._count + len(new) > MANY):
            return self._fix(self._rows + new)
        self._done(self._lib.sl_constraints_add(
            self._held.pointer, address, None, count, ctypes.byref(stats)), stats,
                   self._count + count // width)
        self._rows += new
        return self

    def _fix(self, rows):
        """Holds these rows, and no others, in a factor of the other rows."""
        if min(rows) < 0 or max(rows) >= self._factor.n:
            raise ArgumentError("rows are from 0 to %d" % (self._factor.n - 1))
        if len(set(rows)) < len(rows):
            raise PivotError("a row is held already")
        if not self._is_many:
            self._release(range(self._count))
            self._is_many = True
        self._rows, self._count, self._fixed = rows, len(rows), None
        self.stats = {"count": len(rows)}
        return self

    def _add_equality(self, rows, values):
        if self._factor._kind is arrays.COMPLEX:
            raise UnsupportedError("equalities on a factor of a complex matrix")
        keep, address, count = arrays.rows(rows)
        if keep is None or not count:
            raise ArgumentError("an equality needs rows")
        if self._is_many:
            raise ArgumentError("equalities need at most %d held rows" % MANY)
        values, stats = arrays.vector(values, count, "values"), Stats()
        self._factor._pointer
        return self._done(self._lib.sl_constraints_add(
            self._held.pointer, address, arrays.address(values), count, ctypes.byref(stats)),
                          stats, self._count + 1)._note_equality()

    def _note_equality(self):
        self._equalities += 1
        self._rows.append(None)
        return self

    def release(self, indices):
        """Releases pins by their numbers, 0-based; the others move together."""
        indices = np.asarray(indices)
        if indices.size and ((indices < 0).any() or (indices >= self._count).any()):
            raise ArgumentError("pins have numbers from 0 to %d" % (self._count - 1))
        gone = set(int(k) for k in indices.ravel())
        left = [row for k, row in enumerate(self._rows) if k not in gone]
        if not self._is_many:
            self._release(indices)
            self._rows, self._equalities = left, left.count(None)
        elif len(left) > MANY // 2:
            self._fix(left)
        else:
            self._check_current()
            before = self._rows, self._count, self._fixed, self._is_many
            self._rows, self._count, self._fixed, self._is_many = [], 0, None, False
            try:
                if left:
                    self.add(left)
            except Error:  # pins may need more than a factor of the other rows
                self._rows, self._count, self._fixed, self._is_many = before
                raise
        return self

    def _check_current(self):
        """StaleError if the factor has changed since, also while other rows hold the pins."""
        check(self._lib.sl_constraints_solve(self._held.pointer, None, None, 1, None, 1, None, 1, 0,
                                             None))

    def _release(self, indices):
        keep, address, count = self._factor._kind.set(indices)
        stats, width = Stats(), self._factor._kind.width
        self._factor._pointer  # refuses a failed or closed factor
        if not count:
            return self
        return self._done(self._lib.sl_constraints_release(self._held.pointer, address, count,
                                                    ctypes.byref(stats)),
                          stats, self._count - count // width)

    def refactor(self, A=None):
        """Takes the present numbers of the factor, after it has changed; A: its new matrix."""
        self._factor._pointer
        if self._A is not None and A is None:
            raise ArgumentError("constraints with a matrix need the new one")
        self._check_size(A)
        self._A, self._fixed = A, None
        stats, kept = Stats(), self.stats
        self._done(self._lib.sl_constraints_refactor(self._held.pointer, ctypes.byref(stats)),
                   stats, self._count)
        self.stats = kept if self._is_many else self.stats
        return self

    def solve(self, B, values, *, plan=None):
        """x with A x = B in all other rows and x = values in the pinned ones.

        B       (n,) or (n, count); None: zeros. With a plan its rows are those of the plan's bset.
        values  (len(self),) or (len(self), count), in the order of the pins.
        plan    Factor.plan without a region: x is computed in its xset only.
        Returns an array of the shape of B; if B is None, (n,) or (n, count) as values.
        InaccurateError: rounding lost the equalities; InconsistentError: B is out of balance with a
        motion that the pins leave.
        """
        factor = self._factor
        kind, width = factor._kind, factor._kind.width
        n_b, n_x = (factor.n, factor.n) if plan is None else (plan.nb, plan.nx)
        held = arrays.number_array(values, "values")
        if B is None:
            B = np.zeros((n_b,) + held.shape[1:])
        B, held = np.asarray(B), np.asarray(held)
        if held.ndim not in (1, 2) or held.shape[0] != self._count or held.shape[1:] != B.shape[1:]:
            raise ArgumentError("%d pins need values of the shape %s, not %s" % (
                self._count, (self._count,) + B.shape[1:], held.shape))
        if kind is arrays.REAL and "c" in (B.dtype.kind, held.dtype.kind):
            raise TypeError("pins of a real matrix have real values")
        if self._is_many:
            if plan is not None:
                raise ArgumentError("a plan needs at most %d held rows" % MANY)
            self._factor._pointer
            self._check_current()
            if self._fixed is None:
                skips = factor.stats["factor"]["null"] > 0
                self._fixed = FixedRows(self._A, self._rows, triangle=factor.analysis._triangle,
                                        null_pivots="skip" if skips else "refuse")
            return self._fixed.solve(B, held)
        # column-major: pins take no rows of right-hand sides
        dense = kind.dense(np.asfortranarray(B), n_b, n_x)
        right = kind.dense(np.asfortranarray(held), self._count, self._count)
        out = np.empty((max(n_x * width, 1), dense.count), order="F")
        check(self._lib.sl_constraints_solve(
            self._held.pointer, None if plan is None else plan._plan.pointer, arrays.address(out),
            out.shape[0], arrays.address(dense.B), dense.ldb, arrays.address(right.B), right.ldb,
            dense.count, self._solving()))
        return dense.shaped(out[:n_x * width])

    def _solving(self):
        self._factor._pointer  # refuses a failed or closed factor
        return self._factor._work()
