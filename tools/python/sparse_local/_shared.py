"""Factors that processes share: a mapped file is pickled as its path and what it contained."""
import os
import threading
import weakref
from collections import OrderedDict

from ._errors import IoError, StaleError, UnsupportedError

_HEADER = 64  # bytes of a saved file; its size and the checksum of all are in 24..40
_KEPT = 16  # files that a process keeps open for factors that come again
# what is open, by what it was opened with
_open: "weakref.WeakValueDictionary" = weakref.WeakValueDictionary()
_kept: OrderedDict = OrderedDict()  # the last of those that came from other processes
_lock = threading.RLock()


def identity(path):
    """What a saved file contains, as a short text: its size and the checksum of its checksums."""
    try:
        with open(path, "rb") as file:
            header = file.read(_HEADER)
    except OSError as error:
        raise IoError("the file of a mapped factor cannot be read: %s, %s" %
                    (error.strerror, os.fsdecode(path))) from error
    if len(header) < _HEADER:
        raise UnsupportedError("not a saved factor: %s" % os.fsdecode(path))
    return header[24:40].hex()


class Source:
    """Where a mapped factor comes from: its path, its identity, and the arguments of load."""

    def __init__(self, path, known, arguments):
        self.path, self.identity, self.arguments = path, known, arguments

    def key(self):
        return (self.path, self.identity) + tuple(sorted(self.arguments.items()))

    def remember(self, factor):
        """Lets pickles of the factor find it in this process."""
        factor._source = self
        with _lock:
            _open[self.key()] = factor

    def __reduce__(self):
        return Source, (self.path, self.identity, self.arguments)


def opened(load, source):
    """The factor of a source: the one that this process has open, or that of the file, which has to
    be what it was. StateError: it is another one; Error: it cannot be read."""
    with _lock:
        factor = _open.get(source.key())
        if factor is None or factor._factor._pointer is None:
            found = identity(source.path)
            if found != source.identity:
                raise StaleError("the file of a mapped factor has changed since it was mapped: %s" %
                                 os.fsdecode(source.path))
            factor = load(source.path, map=True, **source.arguments)
        _kept[source.key()] = factor
        _kept.move_to_end(source.key())
        while len(_kept) > _KEPT:
            _kept.popitem(last=False)
        return factor


def forget_closed():
    """Lets go of the factors that were closed."""
    with _lock:
        for key in [key for key, factor in _kept.items() if factor._factor._pointer is None]:
            del _kept[key]
