"""options.allocator for objects that are larger than the memory: large blocks in files of a folder.

A block of at least LARGE bytes is a mapped file, whose pages the system writes out where memory is
short. It has no name on most systems, and vanishes with the block or the process. Its space is
reserved, so that a full disk is an allocation that fails.
"""
import ctypes
import mmap
import os
import tempfile

from ._errors import ArgumentError

LARGE = 16 << 20

_ALLOCATE = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t)
_RELEASE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)
_malloc, _free = ctypes.pythonapi.PyMem_RawMalloc, ctypes.pythonapi.PyMem_RawFree
_malloc.restype, _malloc.argtypes = ctypes.c_void_p, [ctypes.c_size_t]
_free.restype, _free.argtypes = None, [ctypes.c_void_p]

_folders = []  # the context of an allocator is a place in it, from 1 on
_blocks = {}  # by address, the large blocks: what keeps their mapping


def _mapped(folder, size):
    """The address of a new block in a file."""
    with tempfile.TemporaryFile(dir=folder) as file:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(file.fileno(), 0, size)
        else:
            file.truncate(size)
        block = ctypes.c_char.from_buffer(mmap.mmap(file.fileno(), size))
    address = ctypes.addressof(block)
    _blocks[address] = block
    return address


def _allocate(context, size):
    if size < LARGE:
        return _malloc(size)
    try:
        return _mapped(_folders[context - 1], size)
    except (OSError, ValueError, MemoryError):
        return None


def _release(context, address):
    if _blocks.pop(address, None) is None:
        _free(address)


_callbacks = _ALLOCATE(_allocate), _RELEASE(_release)
_addresses = [ctypes.cast(callback, ctypes.c_void_p).value for callback in _callbacks]


def set_scratch(options, folder):
    """Sets options.allocator; None: memory as usual."""
    if folder is None:
        return
    folder = os.path.abspath(os.fsdecode(folder))
    if not os.access(folder, os.W_OK) or not os.path.isdir(folder):
        raise ArgumentError("scratch is a folder that can be written, not %r" % folder)
    if folder not in _folders:
        _folders.append(folder)
    options.allocate, options.release = _addresses
    options.allocator_context = _folders.index(folder) + 1
