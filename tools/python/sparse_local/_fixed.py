"""FixedRows: systems of which some rows are fixed at given values."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError
from ._library import Handle, Stats, as_dict, check, lib
from ._matrix import Matrix
from ._options import POSITIVE, Chosen, split
from ._threads import calls
from ._works import Works


class FixedRows:
    """A x = b in the free rows, where x is given in the others: harmonic maps, interpolation.

    A        n x n, as for Factor; it may be singular as long as A[free, free] is not.
    rows     the fixed rows, each once.
    options  of Factor, in rows of A; not pivoted.

    Errors   PivotError: A[free, free] is singular, as where no row of a component of a Laplacian is
             fixed, with one of its rows; ArgumentError: a row out of range or given twice; others
             as Factor.
    Cost     the analysis and the factorization of A[free, free].
    Threads  any number may solve at once; refactor and close need the object for themselves.
    """

    def __init__(self, A, rows, **options):
        chosen, numbers = split(options)
        if chosen.pop("pivoted", False):
            raise TypeError("pivoted is no option of fixed rows")
        self._triangle = chosen.pop("triangle", None)
        matrix = self._checked(A)
        self._kind, self._is_turned = matrix.kind(), matrix.is_turned
        keep, address, count = self._kind.set(rows)
        if address is None:
            raise ArgumentError("a set of fixed rows is needed")
        definite = numbers.pop("definite", False)
        both = Chosen(matrix.n, matrix.is_complex).analysis(**chosen).numbers(**numbers)
        both.options.triangle = matrix.triangle(self._triangle)
        if definite and both.options.pivots:
            raise ArgumentError("definite excludes null_pivots='skip'")
        both.options.pivots = POSITIVE if definite else both.options.pivots
        self._lib = calls(options.get("threads"))
        pointer, stats = ctypes.c_void_p(), Stats()
        check(self._lib.sl_fixed_create(
            ctypes.byref(pointer), matrix.reference(), address, count,
            ctypes.byref(both.options), ctypes.byref(stats)), stats, self._kind.width)
        self._fixed = Handle("fixed", pointer.value)
        self._works = Works(options.get("threads"))
        self.n, self.stats = matrix.n, as_dict(stats.fixed)
        self._count = count // self._kind.width

    def _checked(self, A):
        matrix = Matrix(A)
        if self._triangle is None:
            matrix.check_symmetric()
        return matrix

    @property
    def free_rows(self):
        """The rows that are not fixed, ascending."""
        view, width = lib.sl_fixed_view(self._fixed.pointer), self._kind.width
        if not view.n_free:
            return np.zeros(0, dtype=np.int32)
        rows = np.ctypeslib.as_array(ctypes.cast(view.free_rows, ctypes.POINTER(ctypes.c_int32)),
                                     (view.n_free,))
        return rows[::width] // width

    def refactor(self, A):
        """Takes new values of A, with the same pattern.

        PatternError: another pattern; the object is as it was. After PivotError and NotFiniteError
        solves raise StateError until a refactor succeeds.
        """
        matrix = self._checked(A)
        if self._triangle is not None and matrix.is_turned != self._is_turned:
            matrix = Matrix(A.tocsr() if self._is_turned else A.tocsc())
        if matrix.kind() is not self._kind:
            raise TypeError("both matrices are real, or both complex")
        stats = Stats()
        check(self._lib.sl_fixed_refactor(self._fixed.pointer, matrix.reference(),
                                          ctypes.byref(stats)), stats, self._kind.width)
        self.stats = as_dict(stats.fixed)
        return self

    def solve(self, B, values):
        """x with A x = B in the free rows, and x = values in the fixed ones.

        B       (n,) or (n, count), of which fixed rows are not used; None: zeros.
        values  (fixed rows,) or (fixed rows, count), in the order of rows.
        Returns (n,) or (n, count). Cost: a full solve of the free rows.
        NotFiniteError: values or B; StateError: a failed refactor.
        """
        values = arrays.number_array(values, "values")
        if B is not None:
            B = arrays.number_array(B, "right-hand sides")
            if B.shape != (self.n,) + values.shape[1:]:
                raise ArgumentError("the right-hand side has the shape %s, and values %s" %
                                    (B.shape, values.shape))
            if B.dtype.kind == "c":
                values = values.astype(complex)
        held = self._kind.dense(values, self._count, self.n)
        X, ldx, G, ldg, count = held.arguments()
        right, ldb = None, ldx
        if B is not None:
            arrays.check_finite(B, "the right-hand side")
            B = np.require(B, held.X.dtype, ["C" if held.is_by_rows() else "F", "A"])
            right = arrays.address(B)
        check(self._lib.sl_fixed_solve(self._fixed.pointer, X, ldx, right, ldb, G, ldg,
                                       count, self._works.pointer()))
        return held.X

    def close(self):
        """Releases the memory; every later use raises StateError."""
        self._fixed.close()

    def __len__(self):
        """The number of fixed rows."""
        return self._count

    def __repr__(self):
        return "<sparse_local.FixedRows of %d rows, %d of them fixed>" % (self.n, self._count)
