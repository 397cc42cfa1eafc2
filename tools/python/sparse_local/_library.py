"""The shared library by ctypes: its structs and functions, and statuses as exceptions.

ctypes releases the global interpreter lock during every call.
"""
import ctypes
import ctypes.util
import os
import sys

from ._errors import BY_STATUS, Error, PivotError

_INT, _OFF, _REAL, _SIZE, _PTR = (ctypes.c_int32, ctypes.c_int64, ctypes.c_double,
                                  ctypes.c_size_t, ctypes.c_void_p)
_ENUM = ctypes.c_int


class Csc(ctypes.Structure):
    """sl_csc"""
    _fields_ = [("n_rows", _INT), ("n_cols", _INT), ("p", _PTR), ("i", _PTR), ("x", _PTR)]


class Csc64(ctypes.Structure):
    """sl_csc64"""
    _fields_ = [("n_rows", _OFF), ("n_cols", _OFF), ("p", _PTR), ("i", _PTR), ("x", _PTR)]


class Options(ctypes.Structure):
    """sl_options"""
    _fields_ = [
        ("size", _SIZE), ("allocate", _PTR), ("release", _PTR), ("allocator_context", _PTR),
        ("thread_count", _INT), ("thread_run", _PTR), ("thread_context", _PTR),
        ("ordering", _ENUM), ("relaxation", _ENUM), ("triangle", _ENUM), ("perm", _PTR),
        ("metis_options", _PTR), ("reserved_pointer", _PTR), ("reserved_int", _INT),
        ("block_size", _INT), ("purpose", _ENUM), ("isa", _ENUM), ("method", _ENUM),
        ("null_pivots", _ENUM),
        ("null_tolerance", _REAL), ("mass", _PTR), ("consistency_tolerance", _REAL),
        ("regularization", _REAL), ("signs", _PTR), ("region", _PTR), ("region_bytes", _SIZE),
        ("null_vector", _PTR), ("growth_limit", _REAL), ("error_limit", _REAL),
        ("null_vector_count", _SIZE), ("storage", _ENUM), ("reserved", _PTR * 2)]


def _struct(name, fields):
    return type(name, (ctypes.Structure,), {"_fields_": fields})


_Error = _struct("_Error", [("row", _INT), ("column", _INT), ("line", _OFF), ("value", _REAL),
    ("what", ctypes.c_char_p)])
_Symbolic = _struct("_Symbolic", [
    ("n", _INT), ("triangle", _ENUM), ("nnz_a", _OFF), ("nnz_l", _OFF), ("nnz_panels", _OFF),
    ("flops", _REAL), ("supernodes", _INT), ("supernodes_fundamental", _INT),
    ("tree_height", _INT), ("components", _INT), ("pairs", _INT), ("delayed", _INT),
    ("seconds_order", _REAL),
    ("seconds_analyze", _REAL), ("seconds_tree", _REAL), ("seconds_structure", _REAL),
    ("bytes", _SIZE)])
_FactorInfo = _struct("_FactorInfo", [
    ("isa", _ENUM), ("method", _ENUM), ("positive", _INT), ("negative", _INT), ("null", _INT),
    ("regularized", _INT), ("weak", _INT), ("regular", _INT), ("pivot_min", _REAL),
    ("pivot_max", _REAL), ("entry_max", _REAL), ("growth", _REAL), ("seconds_setup", _REAL),
    ("seconds", _REAL), ("bytes", _SIZE)])
_PlanInfo = _struct("_PlanInfo", [
    ("b_supernodes", _INT), ("b_columns", _INT), ("b_entries", _OFF), ("x_supernodes", _INT),
    ("x_columns", _INT), ("x_entries", _OFF), ("in_region", ctypes.c_int),
    ("region_entries", _OFF), ("bytes", _SIZE)])
_InverseInfo = _struct("_InverseInfo", [
    ("method", _ENUM), ("supernodes", _INT), ("columns", _INT), ("entries", _OFF)])
_SelectedInfo = _struct("_SelectedInfo", [
    ("supernodes", _INT), ("columns", _INT), ("entries", _OFF), ("seconds", _REAL),
    ("bytes", _SIZE)])
_RegionInfo = _struct("_RegionInfo", [
    ("rows", _INT), ("boundary", _INT), ("subtrees", _INT), ("entries", _OFF),
    ("is_copied", ctypes.c_int), ("seconds", _REAL), ("bytes", _SIZE)])
_ChangeInfo = _struct("_ChangeInfo", [
    ("method", _ENUM), ("reason", _ENUM), ("ranks", _INT), ("padding", _INT), ("entries", _OFF),
    ("updates", _OFF), ("drift", _REAL), ("flops_update", _REAL), ("flops_changed", _REAL),
    ("flops_refactor", _REAL), ("seconds", _REAL)])
_RestrictInfo = _struct("_RestrictInfo", [
    ("kept", _INT), ("computed", _INT), ("entries", _OFF), ("is_anew", ctypes.c_int),
    ("padding", ctypes.c_int), ("seconds", _REAL)])
_EditInfo = _struct("_EditInfo", [
    ("changed", _INT), ("moved", _INT), ("reordered", _INT), ("computed", _INT),
    ("is_anew", ctypes.c_int), ("is_due", ctypes.c_int), ("growth", _REAL), ("seconds", _REAL)])
_ReuseInfo = _struct("_ReuseInfo", [
    ("kept", _INT), ("computed", _INT), ("entries", _OFF), ("flops", _REAL),
    ("flops_anew", _REAL), ("is_anew", ctypes.c_int), ("reason", _ENUM), ("seconds", _REAL)])
_PinsInfo = _struct("_PinsInfo", [
    ("method", _ENUM), ("reason", _ENUM), ("count", _INT), ("eliminated", _INT),
    ("seconds_capacitance", _REAL), ("seconds_elimination", _REAL), ("seconds", _REAL)])
_CertificateInfo = _struct("_CertificateInfo", [
    ("certainty", _ENUM), ("solves", _INT), ("eta", _REAL), ("eigenvalue_min", _REAL),
    ("seconds", _REAL)])
_RefineInfo = _struct("_RefineInfo", [("steps", _INT), ("backward_error", _REAL)])


class Stats(ctypes.Structure):
    """sl_stats"""
    _fields_ = [("error", _Error), ("symbolic", _Symbolic), ("factor", _FactorInfo),
                ("plan", _PlanInfo), ("inverse", _InverseInfo), ("selected", _SelectedInfo),
                ("region", _RegionInfo), ("refine", _RefineInfo),
                ("change", _ChangeInfo), ("restriction", _RestrictInfo),
                ("edit", _EditInfo), ("storage", _OFF), ("reuse", _ReuseInfo),
                ("pins", _PinsInfo), ("certificate", _CertificateInfo), ("null_bound", _REAL),
                ("reserved", _OFF * 19)]


class SavedSet(ctypes.Structure):
    """sl_saved_set"""
    _fields_ = [("symbolic", _PTR), ("factor", _PTR), ("selected", _PTR),
                ("regions", ctypes.POINTER(_PTR)), ("n_regions", _INT), ("allocate", _PTR),
                ("release", _PTR), ("allocator_context", _PTR), ("wanted", _ENUM)]


class SymbolicArrays(ctypes.Structure):
    """sl_symbolic_arrays"""
    _fields_ = [("n", _INT), ("n_supers", _INT)] + [(name, _PTR) for name in (
        "perm", "iperm", "parent", "counts", "super_first", "super_of", "super_parent",
        "rows_begin", "rows", "panel_begin", "pairs")] + [("n_nodes", _INT)] + [
            (name, _PTR) for name in ("node_of", "node_parent", "node_level")]


class PseudoInverse(ctypes.Structure):
    """sl_pseudo_inverse"""
    _fields_ = [("columns", _INT), ("component", _PTR), ("Q", _PTR), ("K", _PTR),
                ("log_det", _REAL)]


_OUT = ctypes.POINTER(_PTR)
_CSC, _OPT, _STATS = (ctypes.POINTER(Csc), ctypes.POINTER(Options), ctypes.POINTER(Stats))
_SET = ctypes.POINTER(SavedSet)
# name: arguments; all of these return a status
_CALLS = {
    "csc_check": [_CSC, _STATS],
    "csc_triangle": [_CSC, ctypes.POINTER(_ENUM), _OPT, _STATS],
    "csc_multiply": [_CSC, _ENUM, _PTR, _SIZE, _PTR, _SIZE, _INT],
    "matrix_from_csc64": [_OUT, ctypes.POINTER(Csc64), _OPT, _STATS],
    "symbolic_create": [_OUT, _CSC, _OPT, _STATS],
    "symbolic_create_pivoted": [_OUT, _CSC, _OPT, _STATS],
    "factor_defects": [_PTR, _PTR, _SIZE, _PTR, _SIZE, _INT, _PTR],
    "factor_create": [_OUT, _PTR, _CSC, _OPT, _STATS],
    "factor_refactor": [_PTR, _CSC, _STATS],
    "factor_refactor_changed": [_PTR, _CSC, _PTR, _INT, _STATS],
    "factor_solve_part": [_PTR, ctypes.c_uint, _PTR, _SIZE, _PTR, _SIZE, _INT, _PTR],
    "factor_multiply_part": [_PTR, ctypes.c_uint, _PTR, _SIZE, _PTR, _SIZE, _INT, _PTR],
    "factor_solve": [_PTR, _PTR, _SIZE, _PTR, _SIZE, _INT, _PTR],
    "factor_refine": [_PTR, _CSC, _PTR, _SIZE, _PTR, _SIZE, _INT, _INT, _PTR, _STATS],
    "factor_logdet": [_PTR, ctypes.POINTER(_REAL), ctypes.POINTER(_REAL)],
    "factor_pseudo_inverse": [_PTR, ctypes.POINTER(PseudoInverse), _PTR],
    "factor_rcond": [_PTR, _CSC, ctypes.POINTER(_REAL), _PTR],
    "factor_certify": [_PTR, _CSC, _ENUM, _PTR, _STATS],
    "work_create": [_OUT, _OPT],
    "plan_create": [_OUT, _PTR, _PTR, _INT, _PTR, _INT, _OPT, _STATS],
    "plan_solve": [_PTR, _PTR, _PTR, _SIZE, _PTR, _SIZE, _INT, _PTR],
    "plan_solve_bounded": [_PTR, _PTR, _PTR, _SIZE, _PTR, _PTR, _SIZE, _INT, _PTR, _PTR, _STATS],
    "plan_solve_part": [_PTR, _PTR, ctypes.c_uint, _PTR, _SIZE, _PTR, _SIZE, _INT, _PTR],
    "plan_columns": [_PTR, _ENUM, _PTR, _INT, ctypes.POINTER(_INT)],
    "local_solve": [_PTR, _PTR, _INT, _PTR, _INT, _PTR, _SIZE, _PTR, _SIZE, _INT, _PTR, _STATS],
    "inverse_diagonal": [_PTR, _PTR, _PTR, _INT, _PTR, _STATS],
    "inverse_block": [_PTR, _PTR, _SIZE, _PTR, _INT, _PTR, _INT, _PTR, _STATS],
    "region_create": [_OUT, _PTR, _PTR, _INT, _PTR, _OPT, _STATS],
    "region_refactor": [_PTR, _PTR, _PTR, _PTR],
    "selected_create": [_OUT, _PTR, _PTR, _INT, _OPT, _STATS],
    "selected_refactor": [_PTR, _PTR, _PTR],
    "selected_entries": [_PTR, _PTR, _PTR, _PTR, _INT, _STATS],
    "save_bytes": [ctypes.POINTER(_SIZE), _SET],
    "save_memory": [_PTR, _SIZE, _SET],
    "save_file": [ctypes.c_char_p, _SET, _OPT],
    "load_memory": [_SET, _PTR, _SIZE, _ENUM, _OPT],
    "load_file": [_SET, ctypes.c_char_p, _ENUM, _OPT],
    "map_file": [_SET, ctypes.c_char_p, _ENUM, _OPT],
}
_FREES = ("matrix_free", "symbolic_free", "factor_free", "work_free", "plan_free", "region_free",
          "selected_free", "saved_set_free")


def library_path():
    """The shared library in use: SPARSE_LOCAL_LIBRARY, that of the package, or the system's."""
    chosen = os.environ.get("SPARSE_LOCAL_LIBRARY")
    if chosen:
        return chosen
    name = "libsparse_local.dylib" if sys.platform == "darwin" else "libsparse_local.so"
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
        call.argtypes = [_PTR]
        call.restype = None
    lib.sl_status_string.argtypes = [ctypes.c_int]
    lib.sl_status_string.restype = ctypes.c_char_p
    lib.sl_stats_size.restype = _SIZE
    lib.sl_options_init.argtypes = [_OPT, _SIZE]
    lib.sl_options_init.restype = None
    lib.sl_matrix_view.argtypes = [_PTR]
    lib.sl_matrix_view.restype = Csc
    lib.sl_symbolic_view.argtypes = [_PTR]
    lib.sl_symbolic_view.restype = SymbolicArrays
    for name in ("symbolic_stats", "factor_stats", "plan_stats", "region_stats",
                 "selected_stats"):
        call = getattr(lib, "sl_" + name)
        call.argtypes = [_PTR, _STATS]
        call.restype = None
    if lib.sl_version() // 100 != 1:
        raise ImportError("libsparse_local has version %d; this package is for 0.1" %
                          lib.sl_version())
    if lib.sl_stats_size() != ctypes.sizeof(Stats):
        raise ImportError("libsparse_local has another sl_stats than this package")
    return lib


lib = _load()


def version():
    """The version of the library, as 0.1.0."""
    number = lib.sl_version()
    return "%d.%d.%d" % (number // 10000, number // 100 % 100, number % 100)


def as_dict(struct):
    """The members of a struct of counts, by their C names."""
    return {name: getattr(struct, name) for name, *_ in struct._fields_}


def new_options():
    options = Options()
    lib.sl_options_init(options, ctypes.sizeof(Options))
    return options


def check(status, stats=None):
    """Raises the exception of a status that is not SL_OK."""
    if status == 0:
        return
    text = lib.sl_status_string(status).decode()
    kind = BY_STATUS[status - 1] if status <= len(BY_STATUS) else Error
    row = column = None
    value = 0.0
    if stats is not None:
        row = stats.error.row if stats.error.row >= 0 else None
        column = stats.error.column if stats.error.column >= 0 else None
        value = stats.error.value
        if stats.error.what:
            text += ": " + stats.error.what.decode()
        if kind is PivotError and stats.null_bound > 0:
            text += ", pivot %.3g, null up to %.3g" % (value, stats.null_bound)
    raise kind(text, row, column, value)


class Handle:
    """Owner of one object of the library."""

    def __init__(self, name, pointer, *borrowed):
        self._free = getattr(lib, "sl_%s_free" % name)
        self.pointer = pointer
        self._borrowed = borrowed  # these live as long as the object

    def __del__(self):
        pointer, self.pointer = getattr(self, "pointer", None), None
        if pointer:
            self._free(pointer)
