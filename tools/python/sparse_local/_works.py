"""Workspaces of solves: one for each thread of the caller, which grows and is used again."""
import ctypes
import threading
from threading import get_ident

from ._library import Handle, check, lib, new_options
from ._threads import set_threads

_lock = threading.Lock()


class Works:
    """The workspaces of one object. threads: what full solves with them run on.

    The first thread has its own in attributes, which is quicker than threading.local; a later
    thread with the number of one that has ended takes over what that one had.
    """

    def __init__(self, threads=None):
        self._threads = threads
        self._first = self._first_thread = self._others = None

    def pointer(self):
        """The workspace of this thread."""
        if self._first_thread == get_ident():
            return self._first._pointer
        return self._of_others()

    def _of_others(self):
        with _lock:
            if self._first_thread is None:
                self._first, self._first_thread = self._create(), get_ident()
                return self._first._pointer
            if self._others is None:
                self._others = threading.local()
        if not hasattr(self._others, "work"):
            self._others.work = self._create()
        return self._others.work._pointer

    def _create(self):
        options, pointer = new_options(), ctypes.c_void_p()
        set_threads(options, self._threads)
        check(lib.sl_work_create(pointer, options))
        return Handle("work", pointer.value)
