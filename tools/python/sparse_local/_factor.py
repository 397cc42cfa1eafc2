"""Factor: factorization, full and local solves, entries of the inverse, files."""
import ctypes
import os
import threading

import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError, InconsistentError
from ._library import Handle, SavedSet, Stats, as_dict, check, lib, new_options
from ._plan import Plan, Region, choice, part_bits
from ._pseudo import NullSpace

_ORDERINGS = {"nd": 0, "metis": 1, "given": 3, "natural": 4, "mindeg": 5}
_NULL_PIVOTS = {"refuse": 0, "skip": 1}
_STORAGES = {"double": 0, "float": 1}
_CERTAINTIES = {"estimated": 1, "guaranteed": 2}
_INCONSISTENT = 11  # SL_ERR_INCONSISTENT
_SAVED_FACTOR = 1  # SL_SAVED_FACTOR: without what else the file has
CHECKS = {"checked": 0, "trusted": 1, "verified": 2}


class Factor:
    """P A P' = L D L' of a sparse symmetric matrix.

    A         n x n; scipy.sparse, one triangle or both. CSC and CSR with 32-bit indices and float64
              values are not copied. A matrix that stores both triangles has to be symmetric, which
              is checked.
    triangle  'lower' or 'upper': reads this triangle only, and ignores the other.
    ordering  'nd' (nested dissection), 'mindeg' (approximate minimum degree), 'natural', 'given'
              (perm), 'metis' if the library was compiled with METIS.
    perm      n row numbers: perm[k] is pivot k; implies 'given'.
    block_size      rows of one node, such as 3 for x, y and z.
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
                    need; not with null_pivots='skip', and without entries of the inverse.
    regularization  see sparse_local.h; 1e-8 suits refinement. signs: n signs of the pivots.
    storage         'double', or 'float': half the bytes for L; solutions have the accuracy of
                    float until refine.

    Threads   any number of threads may call all methods but refactor and update at once. Calls
              release the global interpreter lock.
    """

    def __init__(self, A, *, triangle=None, ordering="nd", perm=None, block_size=0,
                 null_pivots="refuse", null_tolerance=0.0, mass=None, null_vector=None,
                 consistency_tolerance=0.0, regularization=0.0, signs=None,
                 storage="double", pivoted=False):
        matrix = arrays.Matrix(A)
        options = new_options()
        self._triangle = triangle
        options.triangle = matrix.triangle(triangle)
        if perm is not None:
            ordering = "given"
        options.ordering = choice(_ORDERINGS, ordering, "ordering")
        options.null_pivots = choice(_NULL_PIVOTS, null_pivots, "null_pivots")
        options.storage = choice(_STORAGES, storage, "storage")
        options.null_tolerance = null_tolerance
        options.consistency_tolerance = consistency_tolerance
        options.regularization = regularization
        options.block_size = block_size
        kept = []  # until the calls below have read them

        def set_array(name, values, count, dtype):
            if values is not None:
                kept.append(arrays.option_array(values, count, dtype, name))
                setattr(options, name, arrays.address(kept[-1]))

        n = matrix.n
        if options.ordering == _ORDERINGS["given"] and perm is None:
            raise ArgumentError("ordering 'given' needs perm")
        set_array("perm", perm, n, np.int32)
        set_array("mass", mass, n, np.float64)
        if np.ndim(null_vector) == 2:
            options.null_vector_count = np.shape(null_vector)[1]
            null_vector = np.ravel(null_vector, order="F")
        set_array("null_vector", null_vector, n * max(options.null_vector_count, 1), np.float64)
        set_array("signs", signs, n, np.int32)

        stats = Stats()
        symbolic = ctypes.c_void_p()
        analyze = lib.sl_symbolic_create_pivoted if pivoted else lib.sl_symbolic_create
        check(analyze(ctypes.byref(symbolic), matrix.reference(), ctypes.byref(options),
                      ctypes.byref(stats)), stats)
        self._symbolic = Handle("symbolic", symbolic.value)
        if triangle is None:
            matrix.check_symmetric()
        factor = ctypes.c_void_p()
        check(lib.sl_factor_create(ctypes.byref(factor), self._symbolic.pointer,
                                   matrix.reference(), ctypes.byref(options),
                                   ctypes.byref(stats)), stats)
        self._factor = Handle("factor", factor.value, self._symbolic)
        self._consistency = consistency_tolerance or 1e-6
        self.n = n
        self._works = threading.local()
        self._nulls = None

    @property
    def shape(self):
        return (self.n, self.n)

    def _work(self):
        """The workspace of this thread, which grows and is used again."""
        work = getattr(self._works, "work", None)
        if work is None:
            pointer = ctypes.c_void_p()
            check(lib.sl_work_create(ctypes.byref(pointer), None))
            work = self._works.work = Handle("work", pointer.value)
        return work.pointer

    def refactor(self, A):
        """Factors a matrix of the same pattern, stored alike, with new values.

        PatternError: another pattern; the factor is as it was. After PivotError and NotFiniteError
        solves are refused (StateError) until a refactor succeeds. No other thread may use the
        factor meanwhile.
        """
        matrix = arrays.Matrix(A)
        stats = Stats()
        if self._triangle is None:
            matrix.check_symmetric()
        self._nulls = None
        check(lib.sl_factor_refactor(self._factor.pointer, matrix.reference(),
                                     ctypes.byref(stats)), stats)
        return self

    def update(self, A, columns=None):
        """Factors A again after changes in these columns only; None: anywhere, as refactor.

        Only what the changes reach in L is computed anew, which pays where they are in one place.
        A has the analyzed pattern. Errors as in refactor; StateError: the factor is mapped.
        """
        if columns is None:
            return self.refactor(A)
        keep, address, count = arrays.rows(columns)
        matrix, stats = arrays.Matrix(A), Stats()
        if self._triangle is None:
            matrix.check_symmetric()
        self._nulls = None
        check(lib.sl_factor_refactor_changed(self._factor.pointer, matrix.reference(), address,
                                             count, ctypes.byref(stats)), stats)
        return self

    def save(self, path):
        """Writes the analysis and the factor to a file, which load reads."""
        check(lib.sl_save_file(encoded(path), self._set(), None))

    @classmethod
    def load(cls, path, *, map=False, checks="checked", triangle=None):
        """A factor from a file that save has written; its solves have the same bits.

        map       True: maps the file, which processes then share; refactor raises StateError.
        checks    'checked': any bytes are safe; 'verified': checksums too; 'trusted': none.
        triangle  as for Factor, for later refactors.
        """
        call = lib.sl_map_file if map else lib.sl_load_file
        return cls._loaded(call, (encoded(path),), checks, triangle)

    def to_bytes(self):
        """The analysis and the factor as bytes, as save writes them; pickle uses this."""
        size = ctypes.c_size_t()
        check(lib.sl_save_bytes(ctypes.byref(size), self._set()))
        memory = np.empty(size.value, dtype=np.uint8)
        check(lib.sl_save_memory(arrays.address(memory), memory.size, self._set()))
        return memory.tobytes()

    def _set(self):
        return ctypes.byref(SavedSet(self._symbolic.pointer, self._factor.pointer))

    @classmethod
    def from_bytes(cls, data, *, checks="checked", triangle=None):
        """A factor from the bytes of to_bytes, as a copy."""
        memory = np.frombuffer(data, dtype=np.uint8)
        return cls._loaded(lib.sl_load_memory, (arrays.address(memory), memory.size), checks,
                           triangle)

    def __reduce__(self):
        return _unpickle, (self.to_bytes(), self._triangle)

    @classmethod
    def _loaded(cls, call, source, checks, triangle):
        arrays.check_triangle(triangle)
        loaded = SavedSet(wanted=_SAVED_FACTOR)
        check(call(ctypes.byref(loaded), *source, choice(CHECKS, checks, "checks"), None))
        return cls._of(loaded.symbolic, loaded.factor, triangle)

    @classmethod
    def _of(cls, symbolic, factor, triangle):
        """The owner of an analysis and a factor that were loaded."""
        self = cls.__new__(cls)
        self._triangle = triangle
        self._symbolic = Handle("symbolic", symbolic)
        self._factor = Handle("factor", factor, self._symbolic)
        self._consistency = None  # that of the file
        self.n = lib.sl_symbolic_view(self._symbolic.pointer).n
        self._works = threading.local()
        self._nulls = None
        return self

    def _null_space(self, pseudo=True):
        """What corrects entries to those of the pseudo-inverse; None: A is regular."""
        stats = Stats()
        lib.sl_factor_stats(self._factor.pointer, ctypes.byref(stats))
        if not pseudo or stats.factor.null == 0:
            return None
        if self._nulls is None:
            self._nulls = NullSpace(self)
        return self._nulls

    def solve_part(self, parts, B):
        """X = P' L'^-1 D^-1 L^-1 P B with only the parts that are named, as 'P L' or ['LT', 'PT'].

        parts   of 'P', 'L', 'D' or 'sqrtD', 'LT', 'PT'. 'P L' is the forward half of a solve,
                'D LT PT' the backward half. Without P, B is in the order of perm, and so is X
                without PT.
        PivotError: sqrtD with a negative pivot.
        """
        return self._part(lib.sl_factor_solve_part, parts, B)

    def multiply_part(self, parts, B):
        """X = P' L D L' P B with only the parts that are named; see solve_part."""
        return self._part(lib.sl_factor_multiply_part, parts, B)

    def _part(self, call, parts, B):
        dense = arrays.Dense(B, self.n, self.n)
        check(call(self._factor.pointer, part_bits(parts), *dense.arguments(), self._work()))
        return dense.X

    def sample(self, count=None, rng=None, *, pseudo=True):
        """Samples of the normal distribution with mean 0 and covariance A^-1, for a definite A, or
        A^+, for a semidefinite one: such samples have no part in the null space.

        count  columns of the result (n, count); None: one sample (n,).
        rng    numpy.random.Generator; None: a new one.
        """
        rng = np.random.default_rng() if rng is None else rng
        shape = self.n if count is None else (self.n, count)
        nulls = self._null_space(pseudo)
        samples = self.solve_part("sqrtD LT PT", rng.standard_normal(shape))
        return samples if nulls is None else nulls.project(samples)

    def solve(self, B):
        """X with A X = B; B has the shape (n,) or (n, count), and so has X.

        InconsistentError: A is singular and B has no solution (null_pivots='skip' without mass).
        """
        dense = arrays.Dense(B, self.n, self.n)
        status = lib.sl_factor_solve(self._factor.pointer, *dense.arguments(), self._work())
        self._check_consistent(status, dense.B)
        check(status)
        return dense.X

    def _check_consistent(self, status, B, rows=None):
        """Raises InconsistentError with its size; B in the given rows, None: all."""
        if status != _INCONSISTENT:
            return
        right = np.zeros((self.n, 1 if B.ndim == 1 else B.shape[1]), order="F")
        np.add.at(right, slice(None) if rows is None else rows, B.reshape(B.shape[0], -1))
        defects = np.zeros((self.stats["factor"]["null"], right.shape[1]), order="F")
        check(lib.sl_factor_defects(self._factor.pointer, arrays.address(defects),
                                    max(defects.shape[0], 1), arrays.address(right), self.n,
                                    right.shape[1], self._work()))
        sizes = abs(right).sum(axis=0)
        worst = (abs(defects).max(axis=0) / np.where(sizes > 0, sizes, 1)).max()
        text = ("%s: |z' b| for a null vector z is %.2g of sum |b|"
                % (lib.sl_status_string(status).decode(), worst))
        if self._consistency is not None:
            text += ", consistency_tolerance is %.2g" % self._consistency
        raise InconsistentError(text, value=float(worst))

    def refine(self, A, X, B, steps=2):
        """Improves X, a solution of A X = B, by at most steps corrections; returns a new X and the
        backward error that remains.

        InaccurateError: it remains above 1e-8.
        """
        matrix = arrays.Matrix(A)
        start = arrays.Dense(X, self.n, self.n)
        right = arrays.Dense(B, self.n, self.n)
        if start.B.shape != right.B.shape:
            raise ArgumentError("X and B have the same shape")
        out = np.array(start.B, order="F")
        B = np.asarray(right.B, order="F")
        stats = Stats()
        lead = max(self.n, 1)
        check(lib.sl_factor_refine(self._factor.pointer, matrix.reference(), arrays.address(out),
                                   lead, arrays.address(B), lead, right.count, steps, self._work(),
                                   ctypes.byref(stats)), stats)
        return out, stats.refine.backward_error

    def local(self, bset, B, xset):
        """The rows xset of the solution for a B that is 0 outside the rows bset.

        B has the shape (len(bset),) or (len(bset), count), the result (len(xset),) or
        (len(xset), count). None is the set of all rows. Rows given twice in bset add up.
        """
        keep_b, b_rows, nb = arrays.rows(bset)
        keep_x, x_rows, nx = arrays.rows(xset)
        dense = arrays.Dense(B, self.n if bset is None else nb, self.n if xset is None else nx)
        stats = Stats()
        status = lib.sl_local_solve(self._factor.pointer, b_rows, nb, x_rows, nx,
                                    *dense.arguments(), self._work(), ctypes.byref(stats))
        self._check_consistent(status, dense.B, keep_b)
        check(status, stats)
        return dense.X

    def plan(self, bset, xset, region=None):
        """Prepares local solves with these sets; valid after every refactor."""
        return Plan(self, bset, xset, region)

    def region(self, rows):
        """A part of the matrix in which local solves do not depend on the rest; see Region."""
        return Region(self, rows)

    def diagonal(self, rows=None, *, pseudo=True):
        """Diagonal entries of the inverse: (A^-1)[r, r] for r in rows; None: all. For a singular A
        those of A^+, the variances of samples."""
        keep, address, count = arrays.rows(rows)
        out = np.empty(self.n if rows is None else count)
        stats = Stats()
        check(lib.sl_inverse_diagonal(self._factor.pointer, arrays.address(out), address, count,
                                      self._work(), ctypes.byref(stats)), stats)
        nulls = self._null_space(pseudo)
        chosen = slice(None) if rows is None else keep
        return out if nulls is None else nulls.pairs(out, chosen, chosen)

    def block(self, rows, columns, *, pseudo=True):
        """The dense block (A^-1)[rows, columns] of the inverse; of A^+ for a singular A."""
        keep_r, r_rows, n_rows = arrays.rows(rows)
        keep_c, c_rows, n_columns = (keep_r, r_rows, n_rows) if columns is rows else arrays.rows(
            columns)
        if r_rows is None or c_rows is None:
            raise ArgumentError("a block needs two sets of rows")
        out = np.empty((n_rows, n_columns), order="F")
        stats = Stats()
        check(lib.sl_inverse_block(self._factor.pointer, arrays.address(out), max(n_rows, 1),
                                   r_rows, n_rows, c_rows, n_columns, self._work(),
                                   ctypes.byref(stats)), stats)
        nulls = self._null_space(pseudo)
        return out if nulls is None else nulls.block(out, keep_r, keep_c)

    def logdet(self, *, pseudo=True):
        """(sign, log |det A|), as numpy.linalg.slogdet; for a singular A of the pseudo-determinant,
        the product of the eigenvalues that are not 0."""
        log, sign = ctypes.c_double(), ctypes.c_double()
        check(lib.sl_factor_logdet(self._factor.pointer, ctypes.byref(log), ctypes.byref(sign)))
        nulls = self._null_space(pseudo)
        return sign.value, log.value + (0.0 if nulls is None else nulls.log_det)

    def certify(self, A, certainty="estimated"):
        """Finds eta, the largest relative error of any solve in the energy norm of A, which
        Plan.solve_bounded needs; A is the factored matrix. Returns eta.

        certainty  'estimated': from errors that are measured, 15 to 20 full solves; 'guaranteed': a
                   proved bound, much larger, 7 to 10 factorizations.
        InaccurateError: eta exceeds 1/16, as with a matrix that was not factored.
        """
        matrix, stats = arrays.Matrix(A), Stats()
        check(lib.sl_factor_certify(self._factor.pointer, matrix.reference(),
                                    choice(_CERTAINTIES, certainty, "certainty"), self._work(),
                                    ctypes.byref(stats)), stats)
        return stats.certificate.eta

    def rcond(self, A):
        """An estimate of 1 / (||A|| ||A^-1||) in the one-norm; A is the factored matrix."""
        matrix = arrays.Matrix(A)
        out = ctypes.c_double()
        check(lib.sl_factor_rcond(self._factor.pointer, matrix.reference(), ctypes.byref(out),
                                  self._work()))
        return out.value

    @property
    def perm(self):
        """perm[k] is the row of A that is pivot k; a copy."""
        view = lib.sl_symbolic_view(self._symbolic.pointer)
        if not self.n:
            return np.zeros(0, dtype=np.int32)
        return np.ctypeslib.as_array(ctypes.cast(view.perm, ctypes.POINTER(ctypes.c_int32)),
                                     (self.n,)).copy()

    @property
    def stats(self):
        """Counts, times and sizes of the analysis and the factorization, by their C names."""
        stats = Stats()
        lib.sl_symbolic_stats(self._symbolic.pointer, ctypes.byref(stats))
        lib.sl_factor_stats(self._factor.pointer, ctypes.byref(stats))
        return {"symbolic": as_dict(stats.symbolic), "factor": as_dict(stats.factor),
                "storage": stats.storage}

    def __repr__(self):
        info = self.stats
        return "<sparse_local.Factor of %d rows, %d entries in L>" % (self.n,
                                                                     info["symbolic"]["nnz_l"])


def encoded(path):
    """A path as the bytes that the library opens."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ArgumentError("a path without zero bytes is needed")
    return name


def _unpickle(data, triangle):
    return Factor.from_bytes(data, triangle=triangle)
