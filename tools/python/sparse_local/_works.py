"""Workspaces of solves: one for each thread of the caller, which grows and is used again."""
import ctypes
import threading

from ._library import Handle, check, lib, new_options
from ._threads import set_threads


class Works:
    """The workspaces of one object. threads: what full solves with them run on."""

    def __init__(self, threads=None):
        self._threads = threads
        self._local = threading.local()

    def pointer(self):
        """The workspace of this thread."""
        work = getattr(self._local, "work", None)
        if work is None:
            options, pointer = new_options(), ctypes.c_void_p()
            set_threads(options, self._threads)
            check(lib.sl_work_create(ctypes.byref(pointer), ctypes.byref(options)))
            work = self._local.work = Handle("work", pointer.value)
        return work.pointer
