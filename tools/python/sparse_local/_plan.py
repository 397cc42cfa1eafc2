"""Plan and Region: prepared local solves, and parts of the matrix in which they stay."""
import ctypes
import threading

import numpy as np

from . import _arrays as arrays
from ._arrays import DOUBLE, address, is_plain
from ._errors import MismatchError
from ._files import check_limit
from ._library import Handle, Stats, as_dict, check, lib, new_options
from ._options import choice

_PARTS = {"P": 1, "L": 2, "D": 4, "sqrtD": 8, "LT": 16, "PT": 32}


class Region:
    """Rows inside which local solves cost the same whatever the size of the matrix.

    After factor.refactor call refactor(); until then plans in the region raise StateError. Use it
    by factor.plan(bset, xset, region=R), with both sets inside the region.

    max_bytes  upper bound on the memory of a region with a boundary; None: any.
    InaccurateError: solves would lose digits, as pivots have both signs; UnsupportedError: a factor
    with mass or with 2x2 pivots. Cost: forward sweeps from its boundary.
    """

    def __init__(self, factor, rows, *, max_bytes=None):
        keep, first, count = factor._kind.set(rows)
        options, pointer, stats = new_options(), ctypes.c_void_p(), Stats()
        check_limit(max_bytes, "max_bytes")
        options.region_bytes = 0 if max_bytes is None else max(max_bytes, 1)
        check(lib.sl_region_create(ctypes.byref(pointer), factor._pointer, first, count, None,
                                   ctypes.byref(options), ctypes.byref(stats)), stats,
              factor._kind.width)
        self._own(factor, pointer.value)
        self._made_with = _rows_of_user(factor, keep), max_bytes

    def _own(self, factor, pointer):
        self._factor = factor
        self._made_with = None
        self._region = Handle("region", pointer, factor._factor, factor._symbolic)

    def __reduce__(self):
        """A pickle is the factor and the rows."""
        if self._made_with is None:
            raise TypeError("a region of a file is not pickled: Region(factor, rows) is")
        return _unpickled_region, (self._factor,) + self._made_with

    def refactor(self):
        """Computes the region again from the present numbers of the factor."""
        check(lib.sl_region_refactor(self._region.pointer, self._factor._pointer, None,
                                     self._factor._work()))

    @property
    def stats(self):
        """Rows, boundary and bytes, by their C names."""
        return as_dict(lib.sl_region_view(self._region.pointer).info)


class Plan:
    """A prepared local solve: b on bset, x wanted on xset. Made by Factor.plan.

    Immutable; any number of threads may solve with it. A plan belongs to the analysis: on(factor)
    is the same plan for another factor of it.
    """

    def __init__(self, factor, bset, xset, *, region=None):
        keep_b, b_rows, nb = factor._kind.set(bset)
        keep_x, x_rows, nx = factor._kind.set(xset)
        options, width = new_options(), factor._kind.width
        if region is not None:
            options.region = region._region.pointer
        pointer, stats = ctypes.c_void_p(), Stats()
        check(lib.sl_plan_create(ctypes.byref(pointer), factor._symbolic.pointer, b_rows, nb,
                                 x_rows, nx, ctypes.byref(options), ctypes.byref(stats)), stats,
              width)
        self._factor = factor
        self._bset, self._xset, self._region = keep_b, keep_x, region  # rows of the library
        self._plan = Handle("plan", pointer.value, factor._symbolic,
                            region._region if region is not None else None)
        self._scales = threading.local()
        self.nb = factor.n if bset is None else nb // width
        self.nx = factor.n if xset is None else nx // width

    def __reduce__(self):
        """A pickle is the factor, the rows and the region."""
        sets = (_rows_of_user(self._factor, rows) for rows in (self._bset, self._xset))
        return _unpickled_plan, (self._factor, *sets, self._region)

    def on(self, factor):
        """This plan for another factor of the same analysis; nothing is computed."""
        if factor._symbolic is not self._factor._symbolic:
            raise MismatchError("a factor of another analysis than the plan's")
        other = Plan.__new__(Plan)
        other.__dict__.update(self.__dict__)
        other._factor, other._scales = factor, threading.local()
        return other

    def _dense(self, B):
        return self._factor._kind.dense(B, self.nb, self.nx, self._bset)

    def solve(self, B):
        """x on xset; B has the shape (nb,) or (nb, count), the result (nx,) or (nx, count)."""
        factor = self._factor
        if is_plain(B, DOUBLE) and B.shape == (self.nb,) and factor._kind is arrays.REAL:
            X = np.empty(self.nx)
            if not lib.sl_plan_solve(self._plan.pointer, factor._pointer, address(X), self.nx or 1,
                                     address(B), self.nb or 1, 1, factor._work()):
                return X  # what most calls are; errors are found below
        dense = self._dense(B)
        status = lib.sl_plan_solve(self._plan.pointer, factor._pointer, *dense.arguments(),
                                   factor._work())
        if status:
            factor._check_consistent(status, dense, self._bset)
            check(status)
        return dense.X

    def solve_bounded(self, B):
        """x as solve returns it, and a bound for the error of each number. EXPERIMENTAL, as in C.

        The factor has been certified: Factor.certify. Of complex numbers the bounds are those of
        their real and imaginary parts. The first call computes what the bounds need
        of the plan and the factor; it is kept for each thread.
        """
        if np.iscomplexobj(B) and self._factor._kind is arrays.REAL:
            raise TypeError("bounds of complex right-hand sides of a real matrix are not computed")
        dense = self._dense(B)
        bounds = np.empty_like(dense.X)
        if not hasattr(self._scales, "numbers"):
            self._scales.numbers = np.zeros(4 * self.nx * self._factor._kind.width + 2)
        factor, stats = self._factor, Stats()
        x, ldx, b, ldb, count = dense.arguments()
        check(lib.sl_plan_solve_bounded(self._plan.pointer, factor._pointer, x, ldx,
                                        arrays.address(bounds), b, ldb, count,
                                        arrays.address(self._scales.numbers), factor._work(),
                                        ctypes.byref(stats)), stats)
        return dense.X, bounds

    def solve_regularized(self, B, *, steps=5):
        """(x, error): x as solve returns it, without what regularization changed, by at most steps
        corrections; error is the backward error that is left.

        Both reaches have to contain the regularized rows, as where these are in both sets
        (Factor.pivot_rows): ArgumentError names one that they do not. InaccurateError: the error is
        above error_limit. Cost: 1 + steps local solves.
        """
        width = self._factor._kind.width
        dense = self._dense(np.asfortranarray(B))
        b = dense.right()
        out = np.empty((max(self.nx * width, 1), dense.count), order="F")
        factor, stats = self._factor, Stats()
        check(lib.sl_plan_solve_regularized(self._plan.pointer, factor._pointer,
                                            arrays.address(out), out.shape[0], arrays.address(b),
                                            max(self.nb * width, 1), dense.count, steps,
                                            factor._work(), ctypes.byref(stats)),
              stats, width)
        return dense.shaped(out[:self.nx * width]), stats.refine.backward_error

    def solve_part(self, parts, B):
        """Half of the solve: 'P L' forward, 'LT PT' backward, either with 'D' or 'sqrtD'.

        Forward, B has nb rows and the result one for each of columns('L'). Backward, B has one row
        for each of columns('LT') and the result nx rows.
        """
        bits = part_bits(parts)
        is_forward = bits & _PARTS["P"]
        info = self.stats
        factor = self._factor
        width = factor._kind.width
        dense = factor._kind.dense(B, self.nb if is_forward else info["x_columns"] // width,
                                   info["b_columns"] // width if is_forward else self.nx)
        check(lib.sl_factor_solve_part(factor._pointer, self._plan.pointer, bits,
                                     *dense.arguments(), factor._work()))
        return dense.X

    def columns(self, part):
        """The columns of L, ascending, that the forward ('L') or backward ('LT') sweep visits."""
        info = self.stats
        out = np.empty(info["b_columns"] if part == "L" else info["x_columns"], dtype=np.int32)
        count = ctypes.c_int32()
        check(lib.sl_plan_columns(self._plan.pointer, choice(_PARTS, part, "part"),
                                  arrays.address(out), out.size, ctypes.byref(count)))
        width = self._factor._kind.width
        return out[::width] // width

    @property
    def stats(self):
        """Columns and entries of L that a solve visits, by their C names."""
        stats = Stats()
        lib.sl_plan_stats(self._plan.pointer, ctypes.byref(stats))
        return as_dict(stats.plan)


def _unpickled_region(factor, rows, max_bytes):
    return Region(factor, rows, max_bytes=max_bytes)


def _unpickled_plan(factor, bset, xset, region):
    return Plan(factor, bset, xset, region=region)


def _rows_of_user(factor, rows):
    """A set of rows of the library as it was given; None: all."""
    width = factor._kind.width
    return None if rows is None else rows[::width] // width


def part_bits(parts):
    """The bits of parts: a string of names, or the names."""
    bits = 0
    for name in parts.split() if isinstance(parts, str) else parts:
        bits |= choice(_PARTS, name, "a part")
    return bits

