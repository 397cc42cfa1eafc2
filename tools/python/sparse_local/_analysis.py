"""Analysis: the order and the structure of L for one pattern, without numbers."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError
from ._library import Handle, SavedSet, Stats, as_dict, check, lib
from ._matrix import CscArrays, Matrix, check_triangle
from ._options import Chosen, default_options, split
from ._threads import calls

_SAVED_ANALYSIS = 2  # SL_SAVED_ANALYSIS: without numbers


class Analysis:
    """The analysis of a symmetric pattern, for any number of factors with that pattern.

    A           n x n, as for Factor. Values are read only with pivoted=True.
    triangle    'lower' or 'upper': reads this triangle only; None: both triangles are the same
                matrix, or one is stored.
    ordering, perm, block_size, purpose, threads, pivoted, scratch  as for Factor.

    Errors    PatternError: not square, malformed, or both triangles with different patterns;
              ArgumentError: an option, or a perm that is no permutation (row: its first wrong
              place).
    Cost      the ordering, and nearly O(entries of A and of the structure of L).
    Threads   immutable; may be shared.
    """

    def __init__(self, A, **options):
        chosen, numbers = split(options)
        only = numbers.keys() - chosen.keys()
        if only:
            raise TypeError("%s are options of factor" % ", ".join(only))
        self._analyze(Matrix(A), **chosen)

    @classmethod
    def _made(cls, matrix, **options):
        """The analysis of a view."""
        self = cls.__new__(cls)
        self._analyze(matrix, **options)
        return self

    def _analyze(self, matrix, triangle=None, pivoted=False, **options):
        width = matrix.kind().width
        chosen = default_options()
        if options or triangle is not None or matrix.is_complex:
            kept = Chosen(matrix.n, matrix.is_complex).analysis(**options)
            chosen = kept.options
            chosen.triangle = matrix.triangle(triangle)
        stats, symbolic = Stats(), ctypes.c_void_p()
        ours = calls(options.get("threads"))
        analyze = ours.sl_symbolic_create_pivoted if pivoted else ours.sl_symbolic_create
        status = analyze(symbolic, matrix.csc, chosen, stats)
        if status:
            check(status, stats, width)
        self._take(symbolic.value, triangle, matrix.kind(), matrix.n, stats.symbolic.triangle)

    def _own(self, symbolic, triangle, kind, is_ordered=True):
        view = lib.sl_symbolic_view(symbolic)
        return self._take(symbolic, triangle, kind, view.n // kind.width, view.info.triangle,
                          is_ordered)

    def _take(self, symbolic, triangle, kind, n, read, is_ordered=True):
        """read: the triangles of the matrix that was analyzed, of which it read one."""
        self._symbolic = Handle("symbolic", symbolic)
        self._triangle = triangle
        self._kind = kind
        self._is_ordered = is_ordered
        self.n = n
        self._read = read
        return self

    @classmethod
    def _of(cls, symbolic, triangle, kind, is_ordered=True):
        """The owner of an analysis; is_ordered: of a matrix that was put in order."""
        return cls.__new__(cls)._own(symbolic, triangle, kind, is_ordered)

    def factor(self, A, **numbers):
        """A Factor of a matrix with this pattern, stored alike; numbers: the options of Factor that
        the factorization reads. PatternError: another pattern."""
        from ._factor import Factor
        return Factor._create(self, self._matrix(A), numbers)

    def _matrix(self, A):
        """The view of a matrix as the analyzed one was viewed, checked for symmetry."""
        matrix = Matrix(A, self._is_ordered)
        if self._kind is arrays.COMPLEX and not matrix.is_complex:
            A = A.astype(complex) if hasattr(A, "astype") else CscArrays(
                A.shape, A.indptr, A.indices, np.asarray(A.data).astype(complex))
            matrix = Matrix(A, self._is_ordered)
        elif matrix.is_complex and self._kind is arrays.REAL:
            raise TypeError("a real matrix was analyzed, and this one is complex")
        if self._triangle is None:
            matrix.check_symmetric()
            return matrix
        read = self._read
        if read in (1, 2) and matrix.triangle(self._triangle) != read:
            # stored by rows where the analyzed matrix was stored by columns, or the reverse
            if not hasattr(A, "tocsr"):
                raise ArgumentError("the analyzed matrix was stored by rows")
            matrix = Matrix(A.tocsc() if matrix.is_turned else A.tocsr(), self._is_ordered)
        return matrix

    def save(self, path):
        """Writes the analysis to a file, which load reads; replaced as by Factor.save."""
        from ._files import encoded
        check(lib.sl_save(encoded(path), None, None, SavedSet(self._symbolic.pointer), None),
              path=path)

    @classmethod
    def load(cls, path, *, map=False, checks="checked", triangle=None, is_complex=False):
        """An analysis from a file, also from that of a factor; the arguments as for Factor.load."""
        from ._files import load_flags, encoded
        check_triangle(triangle)
        loaded = SavedSet(wanted=_SAVED_ANALYSIS)
        check(lib.sl_load(loaded, encoded(path), None, 0, load_flags(checks, map), None), path=path)
        return cls._of(loaded.symbolic, triangle, arrays.COMPLEX if is_complex else arrays.REAL,
                       is_ordered=False)

    @property
    def perm(self):
        """perm[k] is the row of A that is pivot k; n numbers, a copy."""
        view = lib.sl_symbolic_view(self._symbolic.pointer)
        if not self.n:
            return np.zeros(0, dtype=np.int32)
        width = self._kind.width
        perm = np.ctypeslib.as_array(ctypes.cast(view.perm, ctypes.POINTER(ctypes.c_int32)),
                                     (self.n * width,))
        return perm[::width] // width

    @property
    def stats(self):
        """Counts, times and sizes of the analysis, by their C names."""
        return as_dict(lib.sl_symbolic_view(self._symbolic.pointer).info)

    def __repr__(self):
        return "<sparse_local.Analysis of %d rows, %d entries in L>" % (self.n,
                                                                        self.stats["nnz_l"])


def analyze(A, **options):
    """Analysis(A, **options): the order and the structure of L, without numbers."""
    return Analysis(A, **options)
