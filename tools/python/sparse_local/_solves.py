"""Solves with a factor: full, local, in halves; samples, refinement, bounds."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._arrays import DOUBLE, address, is_plain
from ._errors import ArgumentError, InconsistentError
from ._library import Stats, check, lib
from ._matrix import columns_of, is_sparse
from ._options import choice
from ._constraints import Constraints
from ._plan import Plan, Region, part_bits

_CERTAINTIES = {"estimated": 1, "guaranteed": 2}
_COLUMNS = 64  # of a sparse right-hand side that are solved at once
_INCONSISTENT = 11  # SL_ERR_INCONSISTENT


class Solves:
    """What Factor inherits: solves."""

    def solve(self, B, *, rows=None):
        """X with A X = B; B has the shape (n,) or (n, count), and so has X.

        B     float64 is used in place, in either order; complex is allowed. A sparse B (n, count)
              gives a dense X by solves that begin in the rows where B has entries.
        rows  of X that are wanted, in this order: X has the shape (len(rows), count), and nothing
              else of its size is allocated if B is sparse.
        ArgumentError: another shape; NotFiniteError: a NaN or infinity in B; StateError: a failed
        factor; InconsistentError: A is singular and B has no solution (null_pivots='skip' without
        mass). Cost: two passes over L for up to 64 columns of B.
        """
        if rows is None and is_plain(B, DOUBLE) and B.shape == (self.n,) and \
                self._kind is arrays.REAL:
            X = np.empty_like(B)
            n = self.n or 1
            if not self._solve_call(self._pointer, address(X), n, address(B), n, 1, self._work()):
                return X  # what most calls are; errors are found below
        if type(B) is not np.ndarray and is_sparse(B):
            if tuple(B.shape[:1]) != (self.n,) or len(B.shape) != 2:
                raise ArgumentError("the right-hand side needs %d rows, and has the shape %s" %
                                    (self.n, B.shape))
            return self._solve_sparse(B.tocsc() if hasattr(B, "tocsc") else B, rows)
        if rows is not None:
            return self.local(None, B, rows)
        dense = self._kind.dense(B, self.n, self.n)
        status = self._lib.sl_factor_solve(self._pointer, *dense.arguments(), self._work())
        if status:
            self._check_consistent(status, dense)
            check(status)
        return dense.X

    __call__ = solve

    def _solve_sparse(self, B, rows):
        """The same for a sparse B, some columns at a time."""
        count = B.shape[1]
        if count <= _COLUMNS:
            return self.local(*columns_of(B), rows)
        chosen = self._kind.set(rows)[0]  # read once
        kept = None if rows is None else chosen[::self._kind.width] // self._kind.width
        is_complex = self._kind is arrays.COMPLEX or np.asarray(B.data).dtype.kind == "c"
        X = np.empty((self.n if kept is None else kept.size, count),
                     complex if is_complex else float)
        for k in range(0, count, _COLUMNS):
            X[:, k:k + _COLUMNS] = self.local(*columns_of(B, k, k + _COLUMNS), kept)
        return X

    def _check_consistent(self, status, dense, rows=None):
        """Raises InconsistentError with its size; B in the given rows, None: all."""
        if status != _INCONSISTENT:
            return
        worst = self._inconsistency(dense, rows)
        text = ("%s: |z' b| for a null vector z is %.2g of sum |b|"
                % (lib.sl_status_string(status).decode(), worst))
        if self._consistency is not None:
            text += ", consistency_tolerance is %.2g" % self._consistency
        raise InconsistentError(text, value=worst)

    def _inconsistency(self, dense, rows=None):
        """The largest |z' b| / sum |b| of null vectors z of a singular A; 0: none is skipped."""
        null = self.stats["factor"]["null"]
        B, n = dense.right(), self.n * self._kind.width
        right = np.zeros((n, B.shape[1]), order="F")
        np.add.at(right, slice(None) if rows is None else rows, B)
        defects = np.zeros((null, right.shape[1]), order="F")
        check(self._lib.sl_factor_defects(self._pointer, arrays.address(defects),
                                          max(defects.shape[0], 1), arrays.address(right), n,
                                          right.shape[1], self._work()))
        sizes = abs(right).sum(axis=0)
        ratios = abs(defects).max(axis=0, initial=0.0) / np.where(sizes > 0, sizes, 1)
        return float(ratios.max(initial=0.0))

    def local(self, bset, B, xset):
        """The rows xset of the solution for a B that is 0 outside the rows bset.

        B has the shape (len(bset),) or (len(bset), count), the result (len(xset),) or
        (len(xset), count). None is the set of all rows. Rows given twice in bset add up.
        """
        keep_b, b_rows, nb = self._kind.set(bset)
        keep_x, x_rows, nx = self._kind.set(xset)
        width = self._kind.width
        dense = self._kind.dense(B, self.n if bset is None else nb // width,
                                 self.n if xset is None else nx // width, keep_b)
        stats = Stats()
        status = self._lib.sl_local_solve(self._pointer, b_rows, nb, x_rows, nx, *dense.arguments(),
                                          self._work(), stats)
        if status:
            self._check_consistent(status, dense, keep_b)
            check(status, stats, width)
        return dense.X

    def plan(self, bset, xset, *, region=None):
        """Prepares local solves with these sets; valid after every refactor."""
        return Plan(self, bset, xset, region=region)

    def region(self, rows, *, max_bytes=None):
        """A part of the matrix in which local solves do not depend on the rest; see Region."""
        return Region(self, rows, max_bytes=max_bytes)

    def constraints(self, rows=(), *, A=None):
        """Pins: rows that solves hold at given values, on top of this factor; see Constraints."""
        return Constraints(self, rows, A=A)

    def solve_part(self, parts, B):
        """X = P' L'^-1 D^-1 L^-1 P B with only the parts that are named, as 'P L' or ['LT', 'PT'].

        parts   of 'P', 'L', 'D' or 'sqrtD', 'LT', 'PT'. 'P L' is the forward half of a solve,
                'D LT PT' the backward half. Without P, B is in the order of perm, and so is X
                without PT.
        PivotError: sqrtD with a negative pivot.
        """
        return self._part(self._lib.sl_factor_solve_part, parts, B, None)

    def multiply_part(self, parts, B):
        """X = P' L D L' P B with only the parts that are named; see solve_part."""
        return self._part(self._lib.sl_factor_multiply_part, parts, B)

    def _part(self, call, parts, B, *plan):
        dense = self._kind.dense(B, self.n, self.n)
        check(call(self._pointer, *plan, part_bits(parts), *dense.arguments(), self._work()))
        return dense.X

    def sample(self, count=None, *, rng=None, pseudo=True):
        """Samples of the normal distribution with mean 0 and covariance A^-1, for a definite A, or
        A^+, for a semidefinite one: such samples have no part in the null space.

        count  columns of the result (n, count); None: one sample (n,).
        rng    numpy.random.Generator; None: a new one.
        """
        rng = np.random.default_rng() if rng is None else rng
        shape = self.n if count is None else (self.n, count)
        nulls = self._null_space(pseudo)
        normal = rng.standard_normal(shape)
        if self._kind is arrays.COMPLEX:
            normal = (normal + 1j * rng.standard_normal(shape)) / np.sqrt(2.0)
        samples = self.solve_part("sqrtD LT PT", normal)
        return samples if nulls is None else nulls.project(samples)

    def refine(self, A, X, B, *, steps=5):
        """Improves X, a solution of A X = B, by at most steps corrections; returns a new X and the
        backward error that remains.

        InaccurateError: it remains above error_limit, 1e-8 by default. steps 0 only measures, as
        where it is in doubt whether this is a factor of A.
        """
        matrix = self.analysis._matrix(A)
        start = self._kind.dense(X, self.n, self.n)
        right = self._kind.dense(B, self.n, self.n)
        if start.B.shape != right.B.shape:
            raise ArgumentError("X and B have the same shape")
        out, b = start.right(), right.right()
        stats, lead = Stats(), max(self.n * self._kind.width, 1)
        check(self._lib.sl_factor_refine(
            self._pointer, matrix.reference(), arrays.address(out), lead, arrays.address(b), lead,
            right.count, steps, self._work(), ctypes.byref(stats)), stats)
        return right.shaped(out), stats.refine.backward_error

    def certify(self, A, *, certainty="estimated"):
        """Finds eta, the largest relative error of any solve in the energy norm of A, which
        Plan.solve_bounded needs; A is the factored matrix. Returns eta. EXPERIMENTAL, as in C.

        certainty  'estimated': from errors that are measured, 15 to 45 full solves; 'guaranteed': a
                   proved bound, much larger, 7 to 10 factorizations.
        InaccurateError: eta exceeds 1/16, as with a matrix that was not factored.
        """
        matrix, stats = self.analysis._matrix(A), Stats()
        check(self._lib.sl_factor_certify(
            self._pointer, matrix.reference(), choice(_CERTAINTIES, certainty, "certainty"),
            self._work(), ctypes.byref(stats)), stats)
        return stats.certificate.eta

    def rcond(self, A):
        """An estimate of 1 / (||A|| ||A^-1||) in the one-norm; A is the factored matrix."""
        matrix = self.analysis._matrix(A)
        out = ctypes.c_double()
        check(self._lib.sl_factor_rcond(self._pointer, matrix.reference(), ctypes.byref(out),
                                        self._work()))
        return out.value
