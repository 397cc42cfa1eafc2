"""Factors in files, in memory that processes share, and in pickles."""
import ctypes
import os
import sys
import pickle

import numpy as np

from . import _arrays as arrays
from . import _shared
from ._analysis import Analysis
from ._errors import ArgumentError, TooLargeError
from ._library import SavedSet, check, lib, new_options
from ._matrix import check_triangle
from ._options import choice
from ._threads import set_threads

_SAVED_FACTOR = 1  # SL_SAVED_FACTOR: without what else the file has
CHECKS = {"checked": 0, "trusted": 1, "verified": 2}
MAPPED = 4


class Files:
    """What Factor inherits: saving and loading."""

    def save(self, path):
        """Writes the analysis and the factor to a file, which load reads. An existing file is
        replaced when the new one is complete. Error: the path cannot be written."""
        check(lib.sl_save(encoded(path), None, None, self._set(), None), path=path)

    @classmethod
    def load(cls, path, *, map=False, checks="checked", triangle=None, threads=None,
             is_complex=False, definite=False, max_bytes=None):
        """A factor from a file that save has written; its solves have the same bits.

        map         True: maps the file, which processes then share; refactor raises StateError.
        checks      'checked': any bytes are safe; 'verified': checksums too; 'trusted': none.
        triangle, threads, definite  as for Factor, for later refactors.
        is_complex  True: a factor of a complex matrix.
        max_bytes   of the file: TooLargeError before anything is read; None: any size. Whatever the
                    file claims, memory is allocated for what is in it.
        """
        check_bytes(path, max_bytes)
        flags = load_flags(checks, map)
        if not map:
            return cls._loaded((encoded(path), None, 0, flags), triangle, threads, is_complex,
                               definite, path)
        return mapped(path, lambda: cls._loaded((encoded(path), None, 0, flags), triangle, threads,
                                                is_complex, definite, path),
                      dict(checks=checks, triangle=triangle, threads=threads,
                           is_complex=is_complex, definite=definite))

    def to_bytes(self):
        """The analysis and the factor as bytes, as save writes them."""
        return self._saved().tobytes()

    def _saved(self):
        """The same as an array of bytes."""
        size = ctypes.c_size_t()
        check(lib.sl_save(None, None, ctypes.byref(size), self._set(), None))
        memory = np.empty(size.value, dtype=np.uint8)
        check(lib.sl_save(None, arrays.address(memory), ctypes.byref(size), self._set(), None))
        return memory

    def _set(self):
        return ctypes.byref(SavedSet(self._symbolic.pointer, self._pointer))

    @classmethod
    def from_bytes(cls, data, *, checks="checked", triangle=None, threads=None, is_complex=False,
                   definite=False):
        """A factor from the bytes of to_bytes, as a copy."""
        memory = np.frombuffer(data, dtype=np.uint8)
        flags = choice(CHECKS, checks, "checks")
        return cls._loaded((None, arrays.address(memory), memory.size, flags), triangle, threads,
                           is_complex, definite)

    def __reduce_ex__(self, protocol):
        """A mapped factor is its path and identity; others are their bytes, from protocol 5 on in a
        buffer that need not be copied."""
        self._pointer  # refuses a closed factor
        if self._source is not None:
            return _of_source, (self._source,)
        saved = self._saved()
        return _unpickle, (pickle.PickleBuffer(saved) if protocol >= 5 else saved.tobytes(),
                           self.analysis._triangle, self._threads, self._kind is arrays.COMPLEX,
                           self._definite, self.analysis._is_ordered)

    @classmethod
    def _loaded(cls, source, triangle, threads, is_complex, definite, path=None):
        check_triangle(triangle)
        loaded, options = SavedSet(wanted=_SAVED_FACTOR), new_options()
        set_threads(options, threads)
        check(lib.sl_load(ctypes.byref(loaded), *source, ctypes.byref(options)), path=path)
        return cls._taken(loaded, triangle, threads, is_complex, definite)

    @classmethod
    def _taken(cls, loaded, triangle, threads=None, is_complex=False, definite=False):
        """The owner of an analysis and a factor that were loaded."""
        if not loaded.factor:
            lib.sl_saved_set_free(ctypes.byref(loaded))
            raise ArgumentError("the file has no factor")
        kind = arrays.COMPLEX if is_complex else arrays.REAL
        analysis = Analysis._of(loaded.symbolic, triangle, kind, is_ordered=False)
        self = cls._of(analysis, loaded.factor, threads, definite)
        self._check_definite()
        return self


def load_flags(checks, map):
    """The flags of sl_load."""
    return choice(CHECKS, checks, "checks") | (MAPPED if map else 0)


def encoded(path):
    """A path as the bytes that the library opens: on Windows in the code page of the system."""
    name = os.fsencode(path)
    if sys.platform == "win32":
        try:
            name = os.fsdecode(name).encode("mbcs")
        except UnicodeEncodeError as error:
            raise ArgumentError("a path in the code page of the system is needed") from error
    if b"\0" in name:
        raise ArgumentError("a path without zero bytes is needed")
    return name


def check_limit(most, name):
    """Raises ArgumentError unless it is None or a whole number from 0 on."""
    try:
        is_whole = most is None or not isinstance(most, bool) and int(most) == most and most >= 0
    except (TypeError, ValueError, OverflowError):
        is_whole = False
    if not is_whole:
        raise ArgumentError("%s is a whole number, not %r" % (name, most))


def check_bytes(path, most):
    """Raises TooLargeError for a file with more bytes than these; None: any."""
    check_limit(most, "max_bytes")
    if most is not None and os.path.isfile(path) and os.path.getsize(path) > most:
        raise TooLargeError("%d bytes, of which %d are allowed, %s" %
                            (os.path.getsize(path), most, os.fsdecode(path)))


def mapped(path, load, arguments):
    """What load maps, which pickles as its path and identity."""
    path = os.path.abspath(os.fsdecode(path))
    before = None
    if os.path.isfile(path):  # otherwise the error of load is the better one
        before = _shared.identity(path)
    factor = load()
    if before is not None and _shared.identity(path) == before:
        _shared.Source(path, before, arguments).remember(factor)
    return factor


def _of_source(source):
    from ._factor import Factor
    return _shared.opened(Factor.load, source)


def _unpickle(data, triangle, threads=None, is_complex=False, definite=False, is_ordered=False):
    from ._factor import Factor
    self = Factor.from_bytes(data, triangle=triangle, threads=threads, is_complex=is_complex,
                             definite=definite)
    self.analysis._is_ordered = is_ordered
    return self
