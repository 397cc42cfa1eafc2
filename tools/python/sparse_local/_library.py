"""The shared library by ctypes: its structs and functions, and statuses as exceptions.

ctypes releases the global interpreter lock during every call.
"""
import ctypes
import ctypes.util
import os
import sys

from ._errors import BY_STATUS, Error, PivotError, StaleError
from ._names import in_own_names, names_c
from ._structs import (ENUM, INT, OFF, PTR, REAL, SIZE, Csc, Csc64, FixedArrays,
                       FactorArrays, Hermitian, Options, PseudoInverse, RegionArrays,
                       Request, SavedSet, SelectedArrays, Stats, SymbolicArrays)

_OUT = ctypes.POINTER(PTR)
_CSC, _OPT, _STATS = (ctypes.POINTER(Csc), ctypes.POINTER(Options), ctypes.POINTER(Stats))
_SET = ctypes.POINTER(SavedSet)
# name: arguments; all of these return a status
_CALLS = {
    "csc_check": [_CSC, _STATS],
    "csc_triangle": [_CSC, ctypes.POINTER(ENUM), _OPT, _STATS],
    "csc_multiply": [_CSC, ENUM, PTR, SIZE, PTR, SIZE, INT],
    "matrix_from_triplets": [_OUT, INT, INT, OFF, PTR, PTR, PTR, _OPT, _STATS],
    "matrix_from_hermitian": [_OUT, ctypes.POINTER(Hermitian), _OPT, _STATS],
    "matrix_read": [_OUT, ctypes.c_char_p, _OPT, _STATS],
    "matrix_sum": [_OUT, PTR, _CSC, INT, _OPT, _STATS],
    "matrix_from_csc64": [_OUT, ctypes.POINTER(Csc64), _OPT, _STATS],
    "symbolic_create": [_OUT, _CSC, _OPT, _STATS],
    "symbolic_create_pivoted": [_OUT, _CSC, _OPT, _STATS],
    "symbolic_scatter": [PTR, PTR, _CSC, _STATS],
    "symbolic_edit": [_OUT, PTR, _CSC, _CSC, PTR, _OPT, _STATS],
    "factor_edit": [_OUT, PTR, PTR, _CSC, PTR, _OPT, _STATS],
    "factor_submatrix": [_OUT, _OUT, PTR, _CSC, PTR, INT, _OPT, _STATS],
    "factor_change_entries": [PTR, _CSC, PTR, PTR, PTR, INT, PTR, _STATS],
    "factor_rank_update": [PTR, _CSC, PTR, PTR, _STATS],
    "factor_lower": [_OUT, PTR, _OPT],
    "factor_create_sums": [_OUT, INT, PTR, PTR, ctypes.POINTER(PTR), INT, _OPT,
                           ctypes.POINTER(INT), _STATS],
    "factor_refactor_sums": [ctypes.POINTER(PTR), INT, PTR, ctypes.POINTER(PTR), INT, _OPT,
                             ctypes.POINTER(INT), _STATS],
    "batch_solve": [PTR, ctypes.POINTER(Request), INT, _OPT, PTR, ctypes.POINTER(INT)],
    "fixed_create": [_OUT, _CSC, PTR, INT, _OPT, _STATS],
    "fixed_refactor": [PTR, _CSC, _STATS],
    "fixed_solve": [PTR, PTR, SIZE, PTR, SIZE, PTR, SIZE, INT, PTR],
    "constraints_create": [_OUT, PTR, _OPT],
    "constraints_add": [PTR, PTR, PTR, INT, _STATS],
    "constraints_release": [PTR, PTR, INT, _STATS],
    "constraints_refactor": [PTR, _STATS],
    "constraints_solve": [PTR, PTR, PTR, SIZE, PTR, SIZE, PTR, SIZE, INT, PTR],
    "factor_defects": [PTR, PTR, SIZE, PTR, SIZE, INT, PTR],
    "factor_create": [_OUT, PTR, _CSC, _OPT, _STATS],
    "factor_refactor": [PTR, _CSC, _STATS],
    "factor_solve_part": [PTR, PTR, ctypes.c_uint, PTR, SIZE, PTR, SIZE, INT, PTR],
    "factor_multiply_part": [PTR, ctypes.c_uint, PTR, SIZE, PTR, SIZE, INT, PTR],
    "factor_solve": [PTR, PTR, SIZE, PTR, SIZE, INT, PTR],
    "factor_refine": [PTR, _CSC, PTR, SIZE, PTR, SIZE, INT, INT, PTR, _STATS],
    "factor_pivot_rows": [PTR, ENUM, PTR, PTR, INT, ctypes.POINTER(INT)],
    "factor_logdet": [PTR, ctypes.POINTER(REAL), ctypes.POINTER(REAL)],
    "complex_logdet": [PTR, ctypes.POINTER(REAL), ctypes.POINTER(REAL)],
    "factor_pseudo_inverse": [PTR, ctypes.POINTER(PseudoInverse), PTR],
    "factor_rcond": [PTR, _CSC, ctypes.POINTER(REAL), PTR],
    "factor_certify": [PTR, _CSC, ENUM, PTR, _STATS],
    "work_create": [_OUT, _OPT],
    "plan_create": [_OUT, PTR, PTR, INT, PTR, INT, _OPT, _STATS],
    "plan_solve": [PTR, PTR, PTR, SIZE, PTR, SIZE, INT, PTR],
    "plan_solve_bounded": [PTR, PTR, PTR, SIZE, PTR, PTR, SIZE, INT, PTR, PTR, _STATS],
    "plan_solve_regularized": [PTR, PTR, PTR, SIZE, PTR, SIZE, INT, INT, PTR, _STATS],
    "plan_columns": [PTR, ENUM, PTR, INT, ctypes.POINTER(INT)],
    "local_solve": [PTR, PTR, INT, PTR, INT, PTR, SIZE, PTR, SIZE, INT, PTR, _STATS],
    "inverse_diagonal": [PTR, PTR, PTR, INT, PTR, _STATS],
    "inverse_pairs": [PTR, PTR, PTR, PTR, INT, PTR, _STATS],
    "inverse_block": [PTR, PTR, SIZE, PTR, INT, PTR, INT, PTR, _STATS],
    "region_create": [_OUT, PTR, PTR, INT, PTR, _OPT, _STATS],
    "region_refactor": [PTR, PTR, PTR, PTR],
    "selected_create": [_OUT, PTR, PTR, INT, _OPT, _STATS],
    "selected_refactor": [PTR, PTR, PTR],
    "selected_entries": [PTR, PTR, PTR, PTR, INT, _STATS],
    "save": [ctypes.c_char_p, PTR, ctypes.POINTER(SIZE), _SET, _OPT],
    "load": [_SET, ctypes.c_char_p, PTR, SIZE, ctypes.c_uint, _OPT],
}
_FREES = ("matrix_free", "symbolic_free", "factor_free", "work_free", "plan_free", "region_free",
          "selected_free", "constraints_free", "fixed_free", "saved_set_free")


def library_path():
    """The shared library in use: SPARSE_LOCAL_LIBRARY, that of the package, or the system's."""
    chosen = os.environ.get("SPARSE_LOCAL_LIBRARY")
    if chosen:
        return chosen
    name = {"win32": "sparse_local.dll", "darwin": "libsparse_local.dylib"}.get(
        sys.platform, "libsparse_local.so")
    inside = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
    if os.path.exists(inside):
        return inside
    return ctypes.util.find_library("sparse_local") or inside


def _load():
    lib = ctypes.CDLL(library_path())
    for name, arguments in _CALLS.items():
        call = getattr(lib, "sl_" + name)
        call.argtypes = arguments
        call.restype = ctypes.c_int
    for name in _FREES:
        call = getattr(lib, "sl_" + name)
        call.argtypes = [PTR]
        call.restype = None
    lib.sl_status_string.argtypes = [ctypes.c_int]
    lib.sl_status_string.restype = ctypes.c_char_p
    lib.sl_error_text.argtypes = [ctypes.c_char_p, SIZE, ctypes.c_int, PTR]
    lib.sl_error_text.restype = SIZE
    lib.sl_stats_size.restype = SIZE
    lib.sl_options_init.argtypes = [_OPT, SIZE]
    lib.sl_options_init.restype = None
    lib.sl_matrix_view.argtypes = [PTR]
    lib.sl_matrix_view.restype = Csc
    lib.sl_symbolic_view.argtypes = [PTR]
    lib.sl_symbolic_view.restype = SymbolicArrays
    lib.sl_fixed_view.argtypes = [PTR]
    lib.sl_fixed_view.restype = FixedArrays
    lib.sl_factor_view.argtypes = [PTR]
    lib.sl_factor_view.restype = FactorArrays
    lib.sl_selected_view.argtypes = [PTR]
    lib.sl_selected_view.restype = SelectedArrays
    lib.sl_region_view.argtypes = [PTR]
    lib.sl_region_view.restype = RegionArrays
    lib.sl_plan_stats.argtypes = [PTR, _STATS]
    lib.sl_plan_stats.restype = None
    if lib.sl_version() // 10000 != 1:
        raise ImportError("libsparse_local has version %d; this package is for 1.x" %
                          lib.sl_version())
    if lib.sl_stats_size() != ctypes.sizeof(Stats):
        raise ImportError("libsparse_local has another sl_stats than this package")
    return lib


lib = _load()


def version():
    """The version of the library, as 1.0.0."""
    number = lib.sl_version()
    return "%d.%d.%d" % (number // 10000, number // 100 % 100, number % 100)


def as_dict(struct):
    """The members of a struct of counts, by their C names."""
    return {name: getattr(struct, name) for name, *_ in struct._fields_}


def new_options():
    return Options.from_buffer_copy(_defaults)


_defaults = Options()
lib.sl_options_init(_defaults, ctypes.sizeof(Options))


def check(status, stats=None, width=1, path=None):
    """Raises the exception of a status that is not SL_OK.

    width: rows of the library for each row of the user; path: the file of the call.
    """
    if status == 0:
        return
    kind = BY_STATUS[status - 1] if status <= len(BY_STATUS) else Error
    row = column = None
    value = 0.0
    if stats is not None:
        row = stats.error.row // width if stats.error.row >= 0 else None
        column = stats.error.column // width if stats.error.column >= 0 else None
        value = stats.error.value
        stats = type(stats).from_buffer_copy(stats)
        stats.error.row, stats.error.column = (-1 if k is None else k for k in (row, column))
    buffer = ctypes.create_string_buffer(1000)
    lib.sl_error_text(buffer, len(buffer), status, None if stats is None else ctypes.byref(stats))
    said, plain = buffer.value.decode(), lib.sl_status_string(status).decode()
    text, bound = in_own_names(said, plain), ""
    if stats is not None and kind is PivotError and stats.factor.null_bound > 0:
        bound = ", pivot %.3g, null up to %.3g" % (value, stats.factor.null_bound)
    text += bound
    if path is not None:
        text += ", %s" % os.fsdecode(path)
    error = kind(text)  # which has the place already
    error.row, error.column, error.value = row, column, value
    if names_c(said):
        error.cause = str(kind(plain + bound, row, column))
    raise error


_frees = {name[:-5]: getattr(lib, "sl_" + name) for name in _FREES}


class Handle:
    """Owner of one object of the library. pointer is its address; StateError once it is closed."""

    def __init__(self, name, pointer, *borrowed):
        self._name = name
        self._free = _frees[name]
        self._pointer = pointer
        self._borrowed = borrowed  # these live as long as the object

    @property
    def pointer(self):
        if self._pointer is None:
            raise StaleError("this %s is closed" % self._name)
        return self._pointer

    def close(self):
        """Releases the object; every later use raises StateError."""
        pointer, self._pointer = getattr(self, "_pointer", None), None
        if pointer:
            self._free(pointer)

    __del__ = close
