"""Threads of Python for the library: options.threads with a pool that all calls share.

Each thread runs C code without the interpreter's lock. Results have the same bits for any number.
"""
import concurrent.futures
import ctypes
import itertools
import os
import threading

from ._errors import ArgumentError

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


def _run(context, count, body, data):
    """An sl_parallel_for: the caller takes indices too, so that a busy pool only takes longer."""
    call, numbers, lock = _BODY(body), itertools.count(), threading.Lock()

    def take():
        while True:
            with lock:
                k = next(numbers)
            if k >= count:
                return
            call(data, k)

    helpers = []
    try:
        for _ in range(count - 1):
            helpers.append(_executor().submit(take))
    except RuntimeError:  # no thread could be started
        pass
    take()
    for helper in helpers:
        if not helper.cancel():
            helper.result()


_CALLBACK = _RUN(_run)
_ADDRESS = ctypes.cast(_CALLBACK, ctypes.c_void_p).value


def set_threads(options, count):
    """Sets options.threads; None or 1: the calling thread only."""
    if count is None:
        return
    if isinstance(count, bool) or int(count) != count or count < 1:
        raise ArgumentError("threads is a number from 1 on, not %r" % (count,))
    options.thread_count = min(int(count), _LIMIT)
    options.thread_run = _ADDRESS if count > 1 else None
