"""Threads of Python for the library: options.threads with a pool that all calls share.

Each thread runs C code without the interpreter's lock. Results have the same bits for any number.
"""
import _thread
import concurrent.futures
import ctypes
import os
import threading

from ._errors import ArgumentError
from ._library import lib

_BODY = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int32)
_RUN = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int32, ctypes.c_void_p, ctypes.c_void_p)
_LIMIT = 64
_lock = threading.Lock()
_pool = None


def _executor():
    global _pool
    with _lock:
        if _pool is None:
            _pool = concurrent.futures.ThreadPoolExecutor(_LIMIT, "sparse_local")
        return _pool


def _forget():
    """In a forked process, which has none of the threads."""
    global _pool, _lock
    _pool, _lock = None, threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)


def _is_main():
    return threading.get_ident() == threading.main_thread().ident


class _Loop:
    """One loop of the library: body(data, k) for each k < count."""

    def __init__(self, body, data, count):
        self._call, self._data, self._count = _BODY(body), data, count
        self._lock, self._end = threading.Lock(), threading.Event()
        self._next = self._done = self._helpers = 0

    def take(self):
        """Runs bodies until none is left."""
        while True:
            with self._lock:
                k = self._next
                self._next += 1
            if k >= self._count:
                return
            self._call(self._data, k)
            with self._lock:
                self._done += 1
                if self._done == self._count:
                    self._end.set()

    def finish(self):
        """Runs what is left and returns when all bodies are done; may be called again.

        The main thread leaves all bodies to helpers, for only there Python raises
        KeyboardInterrupt, which must not lose a body.
        """
        takes_part = not _is_main()
        try:
            while self._helpers < self._count - takes_part:
                self._helpers += 1
                _executor().submit(self.take)
        except RuntimeError:  # no thread could be started
            takes_part = True
        if takes_part:
            self.take()
        self._end.wait()


def _run(context, count, body, data):
    """An sl_parallel_for. An interrupt in the main thread waits until the loop has ended."""
    loop, is_interrupted = None, False
    while count > 0:
        try:
            loop = loop or _Loop(body, data, count)
            loop.finish()
            break
        except KeyboardInterrupt:
            is_interrupted = True
    if is_interrupted:
        _thread.interrupt_main()


class _OffMain:
    """The calls of the library, made from another thread than the main one.

    An interrupt that comes while the library runs is raised where Python code begins next, in the
    main thread. That must not be _run, whose loop would be lost: it is where the caller waits.
    There are only locks of the interpreter: an interrupt within a Condition, as futures and events
    have, can leave it locked.
    """

    def __getattr__(self, name):
        call = getattr(lib, name)

        def run(*arguments):
            if not _is_main():
                return call(*arguments)
            made, claim, end = [], _thread.allocate_lock(), _thread.allocate_lock()

            def work():
                if claim.acquire(False):  # an interrupt may have had it started twice
                    try:
                        made.append((call(*arguments), None))
                    except BaseException as error:
                        made.append((None, error))
                    end.release()

            end.acquire()
            is_started = is_interrupted = False
            while not made:
                try:
                    if not is_started:
                        _thread.start_new_thread(work, ())
                        is_started = True
                    end.acquire()
                except KeyboardInterrupt:
                    is_interrupted = True
                except RuntimeError:  # no thread could be started
                    return call(*arguments)
            if is_interrupted:
                raise KeyboardInterrupt
            value, error = made[0]
            if error is not None:
                raise error
            return value

        setattr(self, name, run)
        return run


_off_main = _OffMain()


def calls(threads):
    """The calls of the library for options with so many threads."""
    return lib if threads is None or threads == 1 else _off_main


_CALLBACK = _RUN(_run)
_ADDRESS = ctypes.cast(_CALLBACK, ctypes.c_void_p).value


def set_threads(options, count):
    """Sets options.threads; None or 1: the calling thread only."""
    if count is None:
        return
    if isinstance(count, (bool, str)) or int(count) != count or count < 1:
        raise ArgumentError("threads is a number from 1 on, not %r" % (count,))
    options.thread_count = min(int(count), _LIMIT)
    options.thread_run = _ADDRESS if count > 1 else None
