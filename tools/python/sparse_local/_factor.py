"""Factor: the numbers of L and D over an analysis, what they are made from, and their life."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._analysis import Analysis
from ._changes import Changes
from ._entries import Entries
from ._errors import PivotError, StaleError
from ._files import Files
from ._library import Handle, Stats, as_dict, check, lib
from ._matrix import Matrix
from ._options import POSITIVE, Chosen, choice, default_options, split
from ._pseudo import NullSpace
from ._shared import forget_closed
from ._solves import Solves
from ._threads import calls
from ._works import Works

_PIVOTS = {"null": 0, "regularized": 1}


class Factor(Solves, Entries, Changes, Files):
    """P A P' = L D L' of a sparse symmetric or complex Hermitian matrix.

    A         n x n; scipy.sparse, one triangle or both. CSC and CSR with 32-bit indices and float64
              values are not copied. A matrix that stores both triangles has to be symmetric, which
              is checked.
    triangle  'lower' or 'upper': reads this triangle only, and ignores the other.
    ordering  'nd' (nested dissection, the default), 'mindeg' (approximate minimum degree),
              'natural', 'given' (perm), 'metis' if the library was compiled with METIS.
    perm      n row numbers: perm[k] is pivot k; without ordering, or with 'given'.
    purpose   'many solves', or 'one factor': the first factor as early as possible.
    threads   number of threads for the analysis, factorizations and full solves; None: one. Results
              have the same bits for any number.
    block_size      rows of one node, such as 3 for x, y and z.
    definite        True: PivotError with the row of a negative pivot unless A is positive definite
                    (semidefinite with null_pivots='skip'). Otherwise pivots may have any sign:
                    see inertia.
    null_pivots     'refuse' (PivotError), or 'skip': singular semidefinite matrices, Laplacians.
                    The inverse is then the pseudo-inverse: diagonal, block, Selected, sample and
                    logdet are those of A^+, unless pseudo=False asks for those of the matrix
                    without the null rows, which depend on the order.
    null_tolerance  see sparse_local.h; 0 is its default, negative: only an exact 0 is null.
    mass            n weights m: solutions of a singular A have sum m x = 0 in each component.
    null_vector     n numbers, if the null vector is not constant; n x k: several null vectors a
                    component, such as the 3 or 6 rigid motions of an elastic body; with mass,
                    solutions have sum m z x = 0 for each of these vectors z.
    pivoted         True: 1x1 and 2x2 pivots are chosen by the values of A, as indefinite matrices
                    need; not with null_pivots='skip', and without entries of the inverse. refactor
                    keeps them: make a new Factor where refine with 0 steps finds a large error.
    regularization  see sparse_local.h; 1e-8 suits refinement. signs: n signs of the pivots.
    growth_limit, error_limit  see sparse_local.h; 0: the defaults.
    scratch         a folder: arrays of 16 MB and more are mapped files there, without a name, which
                    the system writes out where memory is short, so that a factor may exceed it.
    storage         'double', 'float': half the bytes for L; solutions have the accuracy of float
                    until refine; 'complex': half of L of a complex matrix.

    Complex     values of A that are complex make a Hermitian system: rows, n, right-hand sides and
                entries of the inverse are complex; counts in stats are those of the real system of
                twice the size.
    Errors      PivotError, NotFiniteError, PatternError, ArgumentError and others with the row.
    Cost        the order, the analysis, and O(sum over columns of L of entries^2) flops.
    Threads     any number of threads may call all methods at once, but those that change the
                factor: refactor, change_entries, rank_update, certify, close. Calls release the
                global interpreter lock.
    """

    def __init__(self, A, **options):
        chosen, numbers = split(options)
        matrix = Matrix(A)
        analysis = Analysis._made(matrix, **chosen)
        if chosen.get("triangle") is None:
            matrix.check_symmetric(analysis._read)
        self._set_up(analysis, matrix, numbers)

    @classmethod
    def _create(cls, analysis, matrix, numbers):
        if numbers and split(numbers)[1].keys() != numbers.keys():
            raise TypeError("%s are options of the analysis" %
                            ", ".join(numbers.keys() - split(numbers)[1].keys()))
        self = cls.__new__(cls)
        self._set_up(analysis, matrix, numbers)
        return self

    def _set_up(self, analysis, matrix, numbers):
        definite, options = False, default_options()
        if numbers:
            numbers = dict(numbers)
            definite = numbers.pop("definite", False)
            chosen = Chosen(analysis.n, analysis._kind is arrays.COMPLEX).numbers(**numbers)
            options = chosen.options
        # the library's own refusal comes earlier, but does not go with these
        if definite and not (options.regularization or options.pivots):
            options.pivots = POSITIVE
        stats, factor = Stats(), ctypes.c_void_p()
        status = calls(numbers.get("threads")).sl_factor_create(
            factor, analysis._symbolic.pointer, matrix.csc, options, stats)
        if status:
            check(status, stats, analysis._kind.width)
        self._own(analysis, factor.value, numbers.get("threads"), definite)
        self._consistency = numbers.get("consistency_tolerance") or 1e-6
        self._has_mass = numbers.get("mass") is not None
        if definite:
            self._check_definite()

    def _own(self, analysis, factor, threads=None, definite=False):
        """Takes over an object of the library."""
        self.analysis = analysis
        self._kind = analysis._kind
        self._factor = Handle("factor", factor, analysis._symbolic)
        self.n = analysis.n
        self._threads = threads
        self._lib = calls(threads)
        self._solve_call = self._lib.sl_factor_solve
        self._definite = definite
        self._source = None  # of a mapped factor
        self._refused = None  # why the numbers are not to be used
        self._consistency = None  # that of a file
        self._has_mass = False
        self._works = Works(threads)
        self._nulls = None
        return self

    @classmethod
    def _of(cls, analysis, factor, threads=None, definite=False):
        return cls.__new__(cls)._own(analysis, factor, threads, definite)

    @property
    def shape(self):
        return (self.n, self.n)

    @property
    def _pointer(self):
        """The factor for a call that reads its numbers."""
        if self._refused is not None:
            raise StaleError(self._refused)
        return self._factor._pointer or self._factor.pointer

    @property
    def _symbolic(self):
        return self.analysis._symbolic

    def _work(self):
        """The workspace of this thread."""
        return self._works.pointer()

    def refactor(self, A):
        """Factors a matrix of the same pattern, stored alike, with new values.

        PatternError: another pattern; the factor is as it was. After PivotError and NotFiniteError
        solves are refused (StateError) until a refactor succeeds. No other thread may use the
        factor meanwhile.
        """
        matrix, stats = self.analysis._matrix(A), Stats()
        self._nulls = None
        self._checked(self._lib.sl_factor_refactor(self._factor.pointer, matrix.reference(),
                                                   ctypes.byref(stats)), stats)
        return self

    def _checked(self, status, stats):
        """After new numbers: raises what is wrong with them."""
        check(status, stats, self._kind.width)
        self._refused = None
        self._check_definite()

    def _check_definite(self):
        """Refuses the numbers of a factor that has to be definite and is not."""
        if not self._definite:
            return
        negative = lib.sl_factor_view(self._factor.pointer).info.negative
        if negative == 0:
            return
        pivots = self._pivots()
        k = int(np.argmin(pivots > 0))
        row, value = int(self.perm[k // self._kind.width]), float(pivots[k])
        self._refused = "a failed factor: not positive definite"
        raise PivotError("not positive definite: %d negative pivots, the first of them %.3g" %
                         (negative // self._kind.width, value), row, value=value)

    def _pivots(self):
        """D in the order of the pivots, those of the library; a view."""
        view = lib.sl_factor_view(self._factor.pointer)
        if not self.n:
            return np.zeros(0)
        return np.ctypeslib.as_array(ctypes.cast(view.D, ctypes.POINTER(ctypes.c_double)),
                                     (self.n * self._kind.width,))

    def pivot_rows(self, kind="null"):
        """(rows, shifts): the rows whose pivots were not taken as they came, in the order of the
        pivots, and what was added to them. kind: 'null' (skipped, shifts 0), or 'regularized'."""
        number, count = choice(_PIVOTS, kind, "kind"), ctypes.c_int32()
        info = self.stats["factor"]
        rows = np.zeros(max(info["null"], info["regularized"], 1), dtype=np.int32)
        shifts = np.zeros(rows.size)
        check(lib.sl_factor_pivot_rows(self._pointer, number, arrays.address(rows),
                                       arrays.address(shifts), rows.size, ctypes.byref(count)))
        return rows[:count.value] // self._kind.width, shifts[:count.value]

    def _null_space(self, pseudo=True):
        """What corrects entries to those of the pseudo-inverse; None: A is regular."""
        null = lib.sl_factor_view(self._pointer).info.null
        if not pseudo or null == 0 or self._kind is arrays.COMPLEX:
            return None
        if self._nulls is None:
            self._nulls = NullSpace(self)
        return self._nulls

    def close(self):
        """Releases the memory of the factor; every later use of it, of its plans, regions and pins
        raises StateError. Without close, this happens when nothing refers to it any more."""
        self._factor.close()
        if self._source is not None:
            forget_closed()

    def __enter__(self):
        return self

    def __exit__(self, *reason):
        self.close()

    @property
    def perm(self):
        """perm[k] is the row of A that is pivot k; a copy."""
        return self.analysis.perm

    @property
    def inertia(self):
        """(positive, negative, null): the signs of the eigenvalues of A, counted by the pivots."""
        info, width = self.stats["factor"], self._kind.width
        return tuple(info[name] // width for name in ("positive", "negative", "null"))

    @property
    def stats(self):
        """Counts, times and sizes of the analysis and the factorization, by their C names."""
        return {"symbolic": as_dict(lib.sl_symbolic_view(self._symbolic.pointer).info),
                "factor": as_dict(lib.sl_factor_view(self._factor.pointer).info)}

    def __repr__(self):
        return "<sparse_local.Factor of %d rows, %d entries in L, inertia %s>" % (
            self.n, self.stats["symbolic"]["nnz_l"], self.inertia)


def cholesky(A, **options):
    """Factor(A, definite=True, **options): of positive definite matrices, all others are refused.

    PivotError: A is singular or indefinite, with the row that shows it.
    """
    return Factor(A, **{"definite": True, **options})
