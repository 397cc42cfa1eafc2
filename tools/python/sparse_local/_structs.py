"""The structs of sparse_local.h, member by member; tests/test_structs.py compares them.

The calls named _view return one by value: restype is the struct (_library.py), and ctypes knows how
the platform returns it. tools/packaging/sparse_local.c says how a language without structs calls
them. Pointers in a view are those of the object and end with it: copy arrays, or keep the object.
"""
import ctypes

INT, OFF, REAL, SIZE, PTR = (ctypes.c_int32, ctypes.c_int64, ctypes.c_double,
                              ctypes.c_size_t, ctypes.c_void_p)
ENUM = ctypes.c_int


class Csc(ctypes.Structure):
    """sl_csc"""
    _fields_ = [("n_rows", INT), ("n_cols", INT), ("p", PTR), ("i", PTR), ("x", PTR)]


class Csc64(ctypes.Structure):
    """sl_csc64"""
    _fields_ = [("n_rows", OFF), ("n_cols", OFF), ("p", PTR), ("i", PTR), ("x", PTR)]


class Options(ctypes.Structure):
    """sl_options"""
    _fields_ = [
        ("size", SIZE), ("allocate", PTR), ("release", PTR), ("allocator_context", PTR),
        ("thread_count", INT), ("thread_run", PTR), ("thread_context", PTR),
        ("ordering", ENUM), ("relaxation", ENUM), ("triangle", ENUM), ("perm", PTR),
        ("block_size", INT), ("purpose", ENUM), ("isa", ENUM), ("method", ENUM),
        ("storage", ENUM), ("pivots", ENUM), ("null_tolerance", REAL), ("null_vector", PTR),
        ("null_vector_count", INT), ("mass", PTR), ("consistency_tolerance", REAL),
        ("regularization", REAL), ("signs", PTR), ("growth_limit", REAL), ("error_limit", REAL),
        ("region", PTR), ("region_bytes", SIZE),
        ("reserved", OFF * 16)]


def _struct(name, fields):
    return type(name, (ctypes.Structure,), {"_fields_": fields})


_Error = _struct("_Error", [("row", INT), ("column", INT), ("line", OFF), ("value", REAL),
    ("what", ctypes.c_char_p)])
_Symbolic = _struct("_Symbolic", [
    ("n", INT), ("triangle", ENUM), ("nnz_a", OFF), ("nnz_l", OFF), ("nnz_panels", OFF),
    ("flops", REAL), ("supernodes", INT), ("supernodes_fundamental", INT),
    ("tree_height", INT), ("components", INT), ("pairs", INT), ("delayed", INT),
    ("seconds_order", REAL),
    ("seconds_analyze", REAL), ("seconds_tree", REAL), ("seconds_structure", REAL),
    ("bytes", SIZE)])
_FactorInfo = _struct("_FactorInfo", [
    ("positive", INT), ("negative", INT), ("null", INT), ("regularized", INT),
    ("weak", INT), ("regular", INT), ("isa", ENUM), ("method", ENUM), ("storage", ENUM),
    ("threads", INT), ("pivot_min", REAL), ("pivot_max", REAL), ("entry_max", REAL),
    ("growth", REAL), ("null_bound", REAL), ("seconds_setup", REAL),
    ("seconds", REAL), ("bytes", SIZE)])
_PlanInfo = _struct("_PlanInfo", [
    ("b_supernodes", INT), ("b_columns", INT), ("b_entries", OFF), ("x_supernodes", INT),
    ("x_columns", INT), ("x_entries", OFF), ("in_region", ctypes.c_int),
    ("region_entries", OFF), ("bytes", SIZE)])
_InverseInfo = _struct("_InverseInfo", [
    ("method", ENUM), ("supernodes", INT), ("columns", INT), ("entries", OFF)])
_SelectedInfo = _struct("_SelectedInfo", [
    ("supernodes", INT), ("columns", INT), ("entries", OFF), ("seconds", REAL),
    ("bytes", SIZE)])
_RegionInfo = _struct("_RegionInfo", [
    ("rows", INT), ("boundary", INT), ("subtrees", INT), ("entries", OFF),
    ("is_copied", ctypes.c_int), ("seconds", REAL), ("bytes", SIZE)])
_ChangeInfo = _struct("_ChangeInfo", [
    ("method", ENUM), ("reason", ENUM), ("ranks", INT), ("entries", OFF),
    ("updates", OFF), ("drift", REAL), ("flops_update", REAL), ("flops_changed", REAL),
    ("flops_refactor", REAL), ("seconds", REAL)])
_SubmatrixInfo = _struct("_SubmatrixInfo", [
    ("kept", INT), ("computed", INT), ("entries", OFF), ("is_anew", ctypes.c_int),
    ("seconds", REAL)])
_EditInfo = _struct("_EditInfo", [
    ("changed", INT), ("moved", INT), ("reordered", INT), ("computed", INT),
    ("is_anew", ctypes.c_int), ("is_due", ctypes.c_int), ("growth", REAL), ("seconds", REAL)])
_ReuseInfo = _struct("_ReuseInfo", [
    ("kept", INT), ("computed", INT), ("entries", OFF), ("flops", REAL),
    ("flops_anew", REAL), ("is_anew", ctypes.c_int), ("reason", ENUM), ("seconds", REAL)])
_ConstraintsInfo = _struct("_ConstraintsInfo", [
    ("count", INT), ("seconds", REAL)])
_FixedInfo = _struct("_FixedInfo", [
    ("n_free", INT), ("couplings", OFF), ("seconds", REAL)])
_CertificateInfo = _struct("_CertificateInfo", [
    ("certainty", ENUM), ("solves", INT), ("eta", REAL), ("eigenvalue_min", REAL),
    ("seconds", REAL)])
_RefineInfo = _struct("_RefineInfo", [("steps", INT), ("backward_error", REAL)])


class Stats(ctypes.Structure):
    """sl_stats"""
    _fields_ = [("error", _Error), ("symbolic", _Symbolic), ("factor", _FactorInfo),
                ("plan", _PlanInfo), ("inverse", _InverseInfo), ("selected", _SelectedInfo),
                ("region", _RegionInfo), ("refine", _RefineInfo),
                ("change", _ChangeInfo), ("submatrix", _SubmatrixInfo),
                ("edit", _EditInfo), ("reuse", _ReuseInfo),
                ("constraints", _ConstraintsInfo), ("certificate", _CertificateInfo),
                ("fixed", _FixedInfo), ("reserved", OFF * 40)]


class SavedSet(ctypes.Structure):
    """sl_saved_set"""
    _fields_ = [("symbolic", PTR), ("factor", PTR), ("selected", PTR),
                ("regions", ctypes.POINTER(PTR)), ("n_regions", INT), ("allocate", PTR),
                ("release", PTR), ("allocator_context", PTR), ("wanted", ENUM),
                ("reserved", PTR * 6)]


class SymbolicArrays(ctypes.Structure):
    """sl_symbolic_arrays"""
    _fields_ = [("info", _Symbolic), ("n", INT), ("n_supers", INT)] + [(name, PTR) for name in (
        "perm", "iperm", "parent", "counts", "super_first", "super_of", "super_parent",
        "rows_begin", "rows", "panel_begin", "pairs")] + [("n_nodes", INT)] + [
            (name, PTR) for name in ("node_of", "node_parent", "node_level")] + [
                ("reserved", PTR * 2)]


class PseudoInverse(ctypes.Structure):
    """sl_pseudo_inverse"""
    _fields_ = [("columns", INT), ("component", PTR), ("Q", PTR), ("K", PTR),
                ("log_det", REAL)]


class FactorArrays(ctypes.Structure):
    """sl_factor_arrays"""
    _fields_ = [("info", _FactorInfo), ("symbolic", PTR), ("L", PTR), ("D", PTR), ("E", PTR),
                ("L_float", PTR), ("reserved", PTR * 2)]


class SelectedArrays(ctypes.Structure):
    """sl_selected_arrays"""
    _fields_ = [("info", _SelectedInfo), ("symbolic", PTR), ("count", INT), ("supers", PTR),
                ("begin", PTR), ("Z", PTR), ("reserved", PTR * 2)]


class RegionArrays(ctypes.Structure):
    """sl_region_arrays"""
    _fields_ = [("info", _RegionInfo), ("symbolic", PTR), ("n_roots", INT), ("roots", PTR),
                ("n_boundary", INT), ("boundary", PTR), ("reserved", PTR * 2)]


class FixedArrays(ctypes.Structure):
    """sl_fixed_arrays"""
    _fields_ = [("n_free", INT), ("n_fixed", INT), ("free_rows", PTR), ("fixed_rows", PTR),
                ("symbolic", PTR), ("factor", PTR), ("matrix", Csc), ("reserved", PTR * 2)]


class Hermitian(ctypes.Structure):
    """sl_hermitian"""
    _fields_ = [("n", INT), ("p", PTR), ("i", PTR), ("x", PTR), ("im", PTR)]


class Request(ctypes.Structure):
    """sl_request"""
    _fields_ = [("plan", PTR), ("X", PTR), ("ldx", SIZE), ("B", PTR), ("ldb", SIZE),
                ("nrhs", INT), ("factor", PTR)]
