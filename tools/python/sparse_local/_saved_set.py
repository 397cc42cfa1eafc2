"""Selected: kept entries of the inverse. save_set, load_set: a factor with what is made over it."""
import ctypes
from collections import namedtuple

import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError
from ._factor import Factor
from ._files import check_bytes, encoded, load_flags, mapped
from ._library import Handle, SavedSet, Stats, as_dict, check, lib, new_options
from ._matrix import check_triangle
from ._plan import Region
from ._threads import calls, set_threads


class Selected:
    """The entries of the inverse in the pattern of the factor: all, or those that rows need.

    They are those of the numbers that the factor had; refactor() computes them again. Reading an
    entry takes less than a microsecond, whatever the size of the matrix. Of a singular matrix they
    are those of the pseudo-inverse, unless pseudo=False is passed where they are read.

    threads  None: those of the factor. UnsupportedError: 2x2 pivots. Cost: about twice the flops of
    the factorization of the same part.
    """

    def __init__(self, factor, rows=None, *, threads=None):
        keep, address, count = factor._kind.set(rows)
        options, pointer, stats = new_options(), ctypes.c_void_p(), Stats()
        set_threads(options, threads)
        self._lib = calls(factor._threads if threads is None else threads)
        check(self._lib.sl_selected_create(ctypes.byref(pointer), factor._pointer, address, count,
                                           ctypes.byref(options), ctypes.byref(stats)), stats,
              factor._kind.width)
        self._own(factor, pointer.value)

    def _own(self, factor, pointer):
        self._factor = factor
        self._selected = Handle("selected", pointer, factor._factor, factor._symbolic)
        self._lib = getattr(self, "_lib", factor._lib)
        self._nulls = factor._null_space()

    def refactor(self):
        """Computes the entries from the present numbers of the factor; StateError: mapped."""
        check(self._lib.sl_selected_refactor(self._selected.pointer, self._factor._pointer,
                                             self._factor._work()))
        self._nulls = self._factor._null_space()

    def diagonal(self, rows=None, *, pseudo=True):
        """(A^-1)[r, r] for r in rows; None: all. PatternError: a row that is not kept."""
        keep, address, count = arrays.rows(rows)
        if self._factor._kind is arrays.COMPLEX:
            keep = 2 * (np.arange(self._factor.n, dtype=np.int32) if rows is None else keep)
            address, count = arrays.address(keep), keep.size
        out, stats = np.empty(self._factor.n if rows is None else count), Stats()
        check(lib.sl_selected_entries(self._selected.pointer, arrays.address(out), address, None,
                                      count, ctypes.byref(stats)), stats, self._factor._kind.width)
        chosen = slice(None) if rows is None else keep
        return self._nulls.pairs(out, chosen, chosen) if pseudo and self._nulls else out

    def entries(self, rows, columns, *, pseudo=True):
        """(A^-1)[r, c] for the pairs of rows and columns. PatternError: one is not kept."""
        keep_r, r_rows, count = arrays.rows(rows)
        keep_c, c_rows, n_columns = arrays.rows(columns)
        if r_rows is None or c_rows is None or count != n_columns:
            raise ArgumentError("entries need as many rows as columns")
        if self._factor._kind is arrays.COMPLEX:
            keep_r, r_rows, count = self._factor._kind.set(keep_r)
            keep_c = np.repeat(2 * keep_c, 2)
            c_rows = arrays.address(keep_c)
        out, stats = np.empty(count), Stats()
        check(lib.sl_selected_entries(self._selected.pointer, arrays.address(out), r_rows, c_rows,
                                      count, ctypes.byref(stats)), stats, self._factor._kind.width)
        if self._factor._kind is arrays.COMPLEX:
            return out.view(np.complex128)
        return self._nulls.pairs(out, keep_r, keep_c) if pseudo and self._nulls else out

    @property
    def stats(self):
        """Supernodes, columns, entries and bytes, by their C names."""
        return as_dict(lib.sl_selected_view(self._selected.pointer).info)


Loaded = namedtuple("Loaded", "factor selected regions")


def save_set(path, factor, *, selected=None, regions=()):
    """Writes a factor with a Selected and Regions of its present numbers to a file.

    load_set reads all of it; Factor.load, and every other program, the factor alone. StateError:
    one of them is not of these numbers.
    """
    regions = list(regions)
    pointers = (ctypes.c_void_p * max(len(regions), 1))(*(R._region.pointer for R in regions))
    stored = SavedSet(factor._symbolic.pointer, factor._pointer,
                      selected._selected.pointer if selected is not None else None, pointers,
                      len(regions))
    check(lib.sl_save(encoded(path), None, None, ctypes.byref(stored), None), path=path)


def load_set(path, *, map=False, checks="checked", triangle=None, threads=None, is_complex=False,
             definite=False, max_bytes=None):
    """(factor, selected, regions) of a file; selected is None if it has none, regions is a list.

    The arguments are those of Factor.load. Plans in the regions solve with the factor at once.
    With map=True all of them are immutable, and processes share one copy in memory.
    """
    check_triangle(triangle)
    check_bytes(path, max_bytes)
    flags = load_flags(checks, map)
    loaded, options = SavedSet(), new_options()
    set_threads(options, threads)

    def load():
        check(lib.sl_load(ctypes.byref(loaded), encoded(path), None, 0, flags,
                          ctypes.byref(options)), path=path)
        return Factor._taken(loaded, triangle, threads, is_complex, definite)

    factor = mapped(path, load, dict(checks=checks, triangle=triangle, threads=threads,
                                     is_complex=is_complex, definite=definite)) if map else load()
    selected, regions = None, []
    if loaded.selected:
        selected = Selected.__new__(Selected)
        selected._own(factor, loaded.selected)
    for k in range(loaded.n_regions):
        region = Region.__new__(Region)
        region._own(factor, loaded.regions[k])
        regions.append(region)
        loaded.regions[k] = None
    loaded.symbolic = loaded.factor = loaded.selected = None  # they have other owners now
    lib.sl_saved_set_free(ctypes.byref(loaded))
    return Loaded(factor, selected, regions)
