"""Keywords of Factor and Analysis as the options of the library."""
import numpy as np

from . import _arrays as arrays
from ._errors import ArgumentError, UnsupportedError
from ._library import new_options
from ._scratch import set_scratch
from ._threads import set_threads

ORDERINGS = {"nd": 0, "metis": 1, "given": 3, "natural": 4, "mindeg": 5}
_PURPOSES = {"many solves": 0, "one factor": 1}
_NULL_PIVOTS = {"refuse": 0, "skip": 2}
POSITIVE = 1
_STORAGES = {"double": 0, "float": 1, "complex": 2}

ANALYSIS = ("triangle", "ordering", "perm", "block_size", "purpose", "threads", "pivoted",
            "scratch")
NUMBERS = ("null_pivots", "null_tolerance", "mass", "null_vector", "consistency_tolerance",
           "regularization", "signs", "growth_limit", "error_limit", "storage", "definite",
           "threads", "scratch")


def choice(names, name, what):
    """The number of a name; ArgumentError names the choices."""
    if not isinstance(name, str) or name not in names:
        raise ArgumentError("%s is one of %s, not %r" % (what, ", ".join(names), name))
    return names[name]


class Chosen:
    """The options of a call, and the arrays that they point to, which live as long as this."""

    def __init__(self, n, is_complex=False):
        self.options = new_options()
        self._n = n
        self._is_complex = is_complex
        self._kept = []

    def analysis(self, ordering=None, perm=None, block_size=0, purpose="many solves",
                 threads=None, scratch=None):
        """Sets what the analysis reads."""
        options = self.options
        if ordering is None:
            ordering = "nd" if perm is None else "given"
        options.ordering = choice(ORDERINGS, ordering, "ordering")
        options.purpose = choice(_PURPOSES, purpose, "purpose")
        if (ordering == "given") != (perm is not None):
            raise ArgumentError("ordering 'given' needs perm, and perm no other ordering")
        options.block_size = block_size
        if self._is_complex:
            options.block_size = 2 * max(block_size, 1)
            if perm is not None:
                perm = arrays.COMPLEX.set(arrays.option_array(perm, self._n, np.int32, "perm"))[0]
        self._array("perm", perm, np.int32)
        set_threads(options, threads)
        set_scratch(options, scratch)
        return self

    def numbers(self, null_pivots="refuse", null_tolerance=0.0, mass=None, null_vector=None,
                consistency_tolerance=0.0, regularization=0.0, signs=None, growth_limit=0.0,
                error_limit=0.0, storage="double", threads=None, scratch=None):
        """Sets what the factorization reads."""
        options = self.options
        options.pivots = choice(_NULL_PIVOTS, null_pivots, "null_pivots")
        options.storage = choice(_STORAGES, storage, "storage")
        options.null_tolerance = null_tolerance
        options.consistency_tolerance = consistency_tolerance
        options.regularization = regularization
        options.growth_limit = growth_limit
        options.error_limit = error_limit
        count = 1
        if np.ndim(null_vector) == 2:
            count = options.null_vector_count = np.shape(null_vector)[1]
            null_vector = np.ravel(null_vector, order="F")
        if self._is_complex and (mass is not None or null_vector is not None):
            raise UnsupportedError("mass and null_vector of a complex matrix")
        self._array("mass", mass, np.float64)
        self._array("null_vector", null_vector, np.float64, count)
        if signs is not None and self._is_complex:
            signs = np.repeat(arrays.option_array(signs, self._n, np.int32, "signs"), 2)
        self._array("signs", signs, np.int32)
        set_threads(options, threads)
        set_scratch(options, scratch)
        return self

    def _array(self, name, values, dtype, columns=1):
        if values is not None:
            rows = self._n * (2 if self._is_complex else 1)
            self._kept.append(arrays.option_array(values, rows * columns, dtype, name))
            setattr(self.options, name, arrays.address(self._kept[-1]))


def default_options():
    """The options of a call without any; only read."""
    return _defaults


_defaults = new_options()


def split(keywords):
    """Keywords as those of the analysis and those of the numbers; TypeError: an unknown one."""
    if not keywords:
        return keywords, keywords
    for name in keywords:
        if name not in ANALYSIS and name not in NUMBERS:
            import difflib
            near = difflib.get_close_matches(name, ANALYSIS + NUMBERS, 1)
            raise TypeError("unknown option %r" % name +
                            ("; did you mean %r?" % near[0] if near else ""))
    return ({k: v for k, v in keywords.items() if k in ANALYSIS},
            {k: v for k, v in keywords.items() if k in NUMBERS})
