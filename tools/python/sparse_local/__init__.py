"""Factors a sparse symmetric matrix once and then solves locally.

    import sparse_local
    F = sparse_local.Factor(A)            # A: scipy.sparse, one triangle or both
    x = F.solve(b)                        # the full solution
    x = F.local([17], [1.0], [4, 2])      # b only in row 17, x wanted only in rows 4 and 2
    P = F.plan([17], [4, 2])              # the same, prepared
    x = P.solve([1.0])
    d = F.diagonal([4, 2])                # diagonal entries of the inverse

The modules linalg, mesh, gradients, autograd, qdldl, sksparse and sksparse05 are imported at their
first use: sparse_local.mesh.laplacian(points, triangles). sparse_local.h has the method and the
contracts of all calls.
"""
import importlib

from ._analysis import Analysis, analyze
from ._fixed import FixedRows
from ._errors import (ArgumentError, Error, InaccurateError, InconsistentError, IoError,
                      MalformedError, MismatchError, NotFiniteError, OrderingError,
                      OtherPatternError, OutOfMemoryError, PatternError, PivotError, ReadOnlyError,
                      StaleError, StateError, TooLargeError, UnsupportedError)
from ._factor import Factor, cholesky
from ._library import library_path, version
from ._matrix import CscArrays, from_triplets
from ._constraints import Constraints
from ._plan import Plan, Region
from ._read import read_matrix
from ._saved_set import Selected, load_set, save_set
from ._several import Sum, solve_batch
from ._stand_in import stand_in

__version__ = version()
__all__ = ["Factor", "cholesky", "Analysis", "analyze", "Plan", "Region", "Constraints",
           "FixedRows", "Selected", "Sum", "solve_batch", "stand_in", "save_set",
           "load_set", "read_matrix", "from_triplets", "CscArrays", "Error", "ArgumentError",
           "OutOfMemoryError",
           "PatternError", "MalformedError", "OtherPatternError", "PivotError", "NotFiniteError",
           "TooLargeError", "UnsupportedError", "IoError", "OrderingError", "InconsistentError",
           "InaccurateError", "StateError", "MismatchError", "StaleError", "ReadOnlyError",
           "library_path", "version"]
_MODULES = ("linalg", "mesh", "gradients", "autograd", "qdldl", "sksparse", "sksparse05")


def __getattr__(name):
    """Modules that need SciPy or torch, and are imported when they are first used."""
    if name not in _MODULES:
        raise AttributeError("module %r has no attribute %r" % (__name__, name))
    return importlib.import_module("." + name, __name__)
