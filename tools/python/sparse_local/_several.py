"""Several factors of one analysis: sums of matrices, and batches that threads share."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._analysis import Analysis
from ._errors import ArgumentError, Error, UnsupportedError
from ._factor import Factor
from ._library import Csc, Handle, Request, Stats, check, lib, new_options
from ._matrix import Matrix, csc_arrays, from_arrays
from ._options import Chosen, split
from ._plan import Plan
from ._threads import calls, set_threads


class Sum:
    """Factors of weighted sums of matrices, such as M + t L for many t, over one analysis.

    terms    real symmetric matrices of one size, any patterns, each with one triangle or both.
    options  of Factor; those of the factorization are the same for all factors.

    The union of the patterns is analyzed, and each term is read once; a factorization then adds the
    weighted terms, and nothing is permuted or searched again.
    """

    def __init__(self, terms, **options):
        chosen, self._numbers = split(options)
        if "triangle" in chosen or chosen.get("pivoted"):
            raise TypeError("triangle and pivoted are no options of sums")
        views = [Matrix(A) for A in terms]
        for view in views:
            if view.is_complex:
                raise UnsupportedError("sums of complex matrices")
            view.check_symmetric()
        self._views = views
        union = self._added(None)
        self.analysis = Analysis._of(self._analyzed(union, chosen), None, arrays.REAL)
        self.n = self.analysis.n
        self._values = []
        count = max(self.analysis.stats["nnz_a"], 1)
        for view in views:
            stats, values = Stats(), np.empty(count)
            check(lib.sl_symbolic_scatter(self.analysis._symbolic.pointer, arrays.address(values),
                                          view.reference(), ctypes.byref(stats)), stats)
            self._values.append(values)

    def _added(self, coefficients):
        """The sum as a matrix of the library; coefficients None: its pattern."""
        views = (Csc * max(len(self._views), 1))(*(view.csc for view in self._views))
        pointer, stats = ctypes.c_void_p(), Stats()
        check(lib.sl_matrix_sum(ctypes.byref(pointer), coefficients, views, len(self._views), None,
                                ctypes.byref(stats)), stats)
        return Handle("matrix", pointer.value)

    @staticmethod
    def _analyzed(matrix, chosen):
        csc = lib.sl_matrix_view(matrix.pointer)
        options = Chosen(csc.n_cols).analysis(**{k: v for k, v in chosen.items()
                                                 if k != "pivoted"})
        symbolic, stats = ctypes.c_void_p(), Stats()
        ours = calls(chosen.get("threads"))
        check(ours.sl_symbolic_create(ctypes.byref(symbolic), ctypes.byref(csc),
                                      ctypes.byref(options.options), ctypes.byref(stats)), stats)
        return symbolic.value

    def matrix(self, coefficients):
        """The lower triangle of the sum with these coefficients, one for each term."""
        c = arrays.vector(coefficients, len(self._views), "coefficients")
        arrays.check_finite(c, "coefficients")
        matrix = self._added(arrays.address(c))
        return from_arrays((self.n, self.n), *csc_arrays(lib.sl_matrix_view(matrix.pointer)))

    def _coefficients(self, coefficients):
        c = arrays.real_array(coefficients, "coefficients")
        if c.ndim not in (1, 2) or c.shape[-1] != len(self._views):
            raise ArgumentError("coefficients have the shape (%d,) or (count, %d), not %s" %
                                (len(self._views), len(self._views), c.shape))
        arrays.check_finite(c, "coefficients")
        return np.ascontiguousarray(np.atleast_2d(c)), c.ndim == 1

    def _pointers(self):
        return (ctypes.c_void_p * max(len(self._values), 1))(*map(arrays.address, self._values))

    def factor(self, coefficients):
        """The Factor of one sum, for coefficients (terms,); a list of them for (count, terms).

        Threads (an option of the sum) each compute whole factors. Errors as Factor; the number of
        the first factor that failed is failed of the exception.
        """
        c, is_one = self._coefficients(coefficients)
        numbers = dict(self._numbers)
        definite = numbers.pop("definite", False)
        chosen = Chosen(self.n).numbers(**numbers)
        out = (ctypes.c_void_p * max(len(c), 1))()
        failed, stats = ctypes.c_int32(), Stats()
        ours = calls(numbers.get("threads"))
        status = ours.sl_factor_create_sums(out, len(c), self.analysis._symbolic.pointer,
                                      arrays.address(c), self._pointers(), len(self._values),
                                      ctypes.byref(chosen.options), ctypes.byref(failed),
                                      ctypes.byref(stats))
        factors = [Factor._of(self.analysis, pointer, numbers.get("threads"), definite)
                   for pointer in out[:len(c)] if pointer]
        _checked(status, stats, failed.value)
        for k, factor in enumerate(factors):
            factor._consistency = numbers.get("consistency_tolerance") or 1e-6
            factor._has_mass = numbers.get("mass") is not None
            _named(factor._check_definite, k)
        return factors[0] if is_one else factors

    def refactor(self, factors, coefficients):
        """Factors sums again with other coefficients, (terms,) or (len(factors), terms).

        A factor that fails has no numbers afterwards; the others have. Exclusive use of the
        factors.
        """
        many = [factors] if isinstance(factors, Factor) else list(factors)
        c, _ = self._coefficients(coefficients)
        if len(c) != len(many):
            raise ArgumentError("%d factors need as many coefficients, not %d" %
                                (len(many), len(c)))
        options, failed, stats = new_options(), ctypes.c_int32(), Stats()
        set_threads(options, self._numbers.get("threads"))
        handles = (ctypes.c_void_p * max(len(many), 1))(*(F._factor.pointer for F in many))
        for F in many:
            if F._symbolic is not self.analysis._symbolic:
                raise ArgumentError("a factor of another sum")
            F._nulls = None
        ours = calls(self._numbers.get("threads"))
        status = ours.sl_factor_refactor_sums(handles, len(many), arrays.address(c),
                                              self._pointers(), len(self._values),
                                              ctypes.byref(options), ctypes.byref(failed),
                                              ctypes.byref(stats))
        for F in many:
            F._refused = None
        _checked(status, stats, failed.value)
        for k, F in enumerate(many):
            _named(F._check_definite, k)
        return factors


def _checked(status, stats, failed):
    _named(lambda: check(status, stats), failed)


def _named(call, number):
    """Runs a check and notes the number of the factor or request that failed."""
    try:
        call()
    except Error as error:
        error.failed = number
        raise


def solve_batch(requests, *, threads=None):
    """Many solves by one call: a list of X for a list of pairs (plan or factor, B).

    The bits of Plan.solve and Factor.solve, for any number of threads. On an error no solution is
    returned; the number of the first request that failed is failed of the exception.
    """
    requests, options = list(requests), new_options()
    set_threads(options, threads)
    structs = (Request * max(len(requests), 1))()
    blocks = []
    for k, (what, B) in enumerate(requests):
        plan = what if isinstance(what, Plan) else None
        factor = what._factor if plan is not None else what
        dense = plan._dense(B) if plan is not None else factor._kind.dense(B, factor.n, factor.n)
        blocks.append(dense)
        X, ldx, right, ldb, count = dense.arguments()
        structs[k] = Request(plan._plan.pointer if plan is not None else None, X, ldx, right, ldb,
                             count, factor._pointer)
    failed = ctypes.c_int32()
    ours = calls(threads)
    status = ours.sl_batch_solve(None, structs, len(requests), ctypes.byref(options), None,
                                 ctypes.byref(failed))
    _named(lambda: check(status), failed.value)
    return [dense.X for dense in blocks]
