"""Entries of the inverse, the determinant, and L and D as matrices."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError, UnsupportedError
from ._library import Handle, Stats, check, lib
from ._matrix import csc_arrays, from_arrays


class Entries:
    """What Factor inherits: numbers of the inverse and of the factors.

    Of a complex matrix with skipped null pivots, entries are those of the matrix without the null
    rows. Factors with 2x2 pivots refuse entries of the inverse with UnsupportedError.
    """

    def diagonal(self, rows=None, *, pseudo=True):
        """Diagonal entries of the inverse: (A^-1)[r, r] for r in rows; None: all. For a singular A
        those of A^+, the variances of samples.

        Cost: a forward sweep each, or selected inversion, whichever is cheaper.
        """
        keep, address, count = arrays.rows(rows)
        if self._kind is arrays.COMPLEX:
            keep = 2 * (np.arange(self.n, dtype=np.int32) if rows is None else keep)
            address, count = arrays.address(keep), keep.size
        out = np.empty(self.n if rows is None else count)
        stats = Stats()
        check(self._lib.sl_inverse_diagonal(
            self._pointer, arrays.address(out), address, count, self._work(), ctypes.byref(stats)),
            stats, self._kind.width)
        nulls = self._null_space(pseudo)
        chosen = slice(None) if rows is None else keep
        return out if nulls is None else nulls.pairs(out, chosen, chosen)

    def block(self, rows, columns, *, pseudo=True):
        """The dense block (A^-1)[rows, columns] of the inverse; of A^+ for a singular A."""
        keep_r, r_rows, n_rows = self._kind.set(rows)
        keep_c, c_rows, n_columns = (keep_r, r_rows, n_rows) if columns is rows else arrays.rows(
            columns)
        if r_rows is None or c_rows is None:
            raise ArgumentError("a block needs two sets of rows")
        if self._kind is arrays.COMPLEX:  # the real columns of the complex ones
            keep_c = 2 * arrays.rows(columns)[0]
            c_rows, n_columns = arrays.address(keep_c), keep_c.size
        out = np.empty((n_rows, n_columns), order="F")
        stats = Stats()
        check(self._lib.sl_inverse_block(self._pointer, arrays.address(out), max(n_rows, 1),
                                         r_rows, n_rows, c_rows, n_columns, self._work(),
                                         ctypes.byref(stats)), stats, self._kind.width)
        if self._kind is arrays.COMPLEX:
            return out.T.view(np.complex128).T
        nulls = self._null_space(pseudo)
        return out if nulls is None else nulls.block(out, keep_r, keep_c)

    def pairs(self, rows, columns, *, pseudo=True):
        """(A^-1)[r, c] for the pairs of rows and columns, as many; of A^+ for a singular A.

        Cost: forward sweeps, of which up to 8 nearby rows share one, or selected inversion.
        """
        keep_r, r_rows, count = arrays.rows(rows)
        keep_c, c_rows, n_columns = arrays.rows(columns)
        if r_rows is None or c_rows is None or count != n_columns:
            raise ArgumentError("pairs need as many rows as columns")
        if self._kind is arrays.COMPLEX:
            keep_r, r_rows, count = self._kind.set(keep_r)
            keep_c = np.repeat(2 * keep_c, 2)
            c_rows = arrays.address(keep_c)
        out, stats = np.empty(count), Stats()
        check(self._lib.sl_inverse_pairs(
            self._pointer, arrays.address(out), r_rows, c_rows, count, self._work(),
            ctypes.byref(stats)), stats, self._kind.width)
        if self._kind is arrays.COMPLEX:
            return out.view(np.complex128)
        nulls = self._null_space(pseudo)
        return out if nulls is None else nulls.pairs(out, keep_r, keep_c)

    def bilinear(self, cset, c, bset, b):
        """c' A^-1 b, for real vectors that are 0 outside the rows cset and bset; None: all rows.

        Cost: a local solve.
        """
        if self._kind is arrays.COMPLEX:
            raise UnsupportedError("bilinear forms of a complex matrix; use local")
        keep, _, count = arrays.rows(cset)
        values = arrays.vector(c, self.n if cset is None else count, "c")
        arrays.check_finite(values, "c", keep)
        return float(values @ self.local(bset, b, cset))

    def logdet(self, *, pseudo=True):
        """(sign, log |det A|), as numpy.linalg.slogdet; for a singular A of the pseudo-determinant,
        the product of the eigenvalues that are not 0."""
        log, sign = ctypes.c_double(), ctypes.c_double()
        call = lib.sl_complex_logdet if self._kind is arrays.COMPLEX else lib.sl_factor_logdet
        check(call(self._pointer, ctypes.byref(log), ctypes.byref(sign)))
        nulls = self._null_space(pseudo)
        return sign.value, log.value + (0.0 if nulls is None else nulls.log_det)

    def lower(self):
        """L, unit lower triangular, as a sparse matrix (n, n) in compressed columns; a copy.

        A[perm][:, perm] = L D L', with the conjugate transpose of complex matrices. Without the
        entries that are exactly 0; its own type without SciPy: see from_triplets.
        """
        pointer = ctypes.c_void_p()
        check(lib.sl_factor_lower(ctypes.byref(pointer), self._pointer, None))
        matrix = Handle("matrix", pointer.value)
        p, i, x = csc_arrays(lib.sl_matrix_view(matrix.pointer))
        n = self.n
        if self._kind is arrays.REAL:
            return from_arrays((n, n), p, i, x)
        # the first column of each 2x2 block has the real and the imaginary part
        column = np.repeat(np.arange(2 * n), np.diff(p))
        first = column % 2 == 0
        rows, columns = i[first], column[first] // 2
        keys = columns.astype(np.int64) * n + rows // 2
        places, at = np.unique(keys, return_inverse=True)
        values = np.zeros(places.size, dtype=complex)
        np.add.at(values, at, np.where(rows % 2 == 0, x[first], 1j * x[first]))
        ends = np.searchsorted(places, n * np.arange(n + 1, dtype=np.int64))
        return from_arrays((n, n), ends.astype(np.int32), (places % max(n, 1)).astype(np.int32),
                           values)

    def pivots(self):
        """D as (d, e): n numbers of its diagonal, 0 for skipped null pivots, and n - 1 beside it,
        which are not 0 at the first column of a 2x2 pivot. Both in the order of perm; copies."""
        self._pointer  # refuses a failed factor
        check(lib.sl_factor_logdet(self._pointer, ctypes.byref(ctypes.c_double()),
                                   ctypes.byref(ctypes.c_double())))
        d, width = self._pivots()[::self._kind.width].copy(), self._kind.width
        d[d == np.finfo(float).max] = 0.0
        view = lib.sl_factor_view(self._factor.pointer)
        e = np.zeros(max(self.n - 1, 0))
        if view.E and width == 1:
            e[:] = np.ctypeslib.as_array(ctypes.cast(view.E, ctypes.POINTER(ctypes.c_double)),
                                         (self.n,))[:-1]
        return d, e

    def factors(self):
        """(L, D, perm): sparse matrices and the order, with A[perm][:, perm] = L D L'."""
        d, e = self.pivots()
        n = self.n
        k = np.arange(n, dtype=np.int32)
        first = np.flatnonzero(e).astype(np.int32)
        rows = np.concatenate([k, first + 1, first])
        columns = np.concatenate([k, first, first + 1])
        order = np.lexsort((rows, columns))
        p = np.searchsorted(columns[order], np.arange(n + 1)).astype(np.int32)
        values = np.concatenate([d, e[first], e[first]])[order]
        return self.lower(), from_arrays((n, n), p, rows[order], values), self.perm
