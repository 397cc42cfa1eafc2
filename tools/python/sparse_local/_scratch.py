"""options.allocator for objects that are larger than the memory: large blocks in files of a folder.

A block of at least LARGE bytes is a mapped file, whose pages the system writes out where memory is
short. It has no name on most systems, and vanishes with the block or the process. Its space is
reserved, so that a full disk is an allocation that fails. A forked child has pages of its own where
it writes; what the parent writes later may show in the others.
"""
import ctypes
import mmap
import os
import sys
import tempfile

from ._errors import ArgumentError

LARGE = 16 << 20

_ALLOCATE = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t)
_RELEASE = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)
_malloc, _free = ctypes.pythonapi.PyMem_RawMalloc, ctypes.pythonapi.PyMem_RawFree
_malloc.restype, _malloc.argtypes = ctypes.c_void_p, [ctypes.c_size_t]
_free.restype, _free.argtypes = None, [ctypes.c_void_p]

_folders = []  # the context of an allocator is a place in it, from 1 on
_blocks = {}  # by address, the large blocks: what keeps their mapping, the file, and bytes


def _mapped(folder, size):
    """The address of a new block in a file."""
    file = tempfile.TemporaryFile(dir=folder)
    if hasattr(os, "posix_fallocate"):
        os.posix_fallocate(file.fileno(), 0, size)
    else:
        file.truncate(size)
    block = ctypes.c_char.from_buffer(mmap.mmap(file.fileno(), size))
    address = ctypes.addressof(block)
    _blocks[address] = block, file, size
    return address


def _copy_on_write():
    """In a child: what it writes, as by refactor, must not become numbers of the parent."""
    flags = mmap.MAP_PRIVATE | 0x10  # MAP_FIXED
    if sys.platform == "linux":  # as a block may exceed the memory
        flags |= getattr(mmap, "MAP_NORESERVE", 0x4000)
    for address, (block, file, size) in _blocks.items():
        access = mmap.PROT_READ | mmap.PROT_WRITE
        if _mmap(address, size, access, flags, file.fileno(), 0) != address:
            os.abort()


if hasattr(os, "register_at_fork"):
    _mmap = ctypes.CDLL(None).mmap
    _mmap.restype = ctypes.c_void_p
    _mmap.argtypes = [ctypes.c_void_p, ctypes.c_size_t] + 3 * [ctypes.c_int] + [ctypes.c_long]
    os.register_at_fork(after_in_child=_copy_on_write)


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
