"""What sentences of the library call by its names in C, in the names of this package."""
import re

NAMES = {
    # options of Factor
    "options.pivots = SL_PIVOTS_SKIP_NULL": "null_pivots='skip'",
    "options.pivots = SL_PIVOTS_NONZERO": "null_pivots='refuse' without definite=True",
    "SL_PIVOTS_SKIP_NULL": "null_pivots='skip'",
    "SL_PIVOTS_POSITIVE": "definite=True",
    "options.pivots": "null_pivots",
    ", or see options.pivots and sl_symbolic_create_pivoted": ", or pass null_pivots='skip'",
    "of sl_symbolic_create_pivoted": "with pivoted=True",
    "sl_symbolic_create_pivoted": "pivoted=True",
    "columns are given, options.null_vector_count": "null_vector has columns",
    "options.null_vector_count is below 0 or above 32": "null_vector has more than 32 columns",
    "SL_STORAGE_COMPLEX": "storage='complex'",
    "options.storage needs SL_WITH_COMPLEX": "storage='complex' is not compiled in",
    "options.storage needs SL_WITH_FLOAT": "storage='float' is not compiled in",
    "options.ordering needs SL_METIS": "ordering='metis' is not compiled in",
    "METIS_NodeND": "METIS",
    "options.threads.count": "threads",
    "threads.count is above 1: compile with SL_PTHREADS or OpenMP, or set threads.run":
        "threads is above 1, and none are compiled in",
    ": compiled with SL_NO_SINGULAR": ": not compiled in",
    # calls and what they return
    "sl_constraints_refactor": "Constraints.refactor",
    "sl_region_refactor": "Region.refactor",
    "sl_selected_refactor": "Selected.refactor",
    "sl_fixed_refactor": "FixedRows.refactor",
    "sl_factor_pivot_rows": "Factor.pivot_rows",
    "sl_factor_certify": "Factor.certify",
    "sl_factor_submatrix": "Factor.submatrix",
    "sl_load copies without SL_LOAD_MAPPED": "Factor.load copies without map=True",
    "SL_LOAD_MAPPED": "map=True",
    "certainty is neither SL_ESTIMATED nor SL_GUARANTEED":
        "certainty is neither 'estimated' nor 'guaranteed'",
    "SL_GUARANTEED": "certainty='guaranteed'",
    "SL_PART_SQRT_D": "'sqrtD'",
    "part is neither SL_PART_L nor SL_PART_LT": "part is neither 'L' nor 'LT'",
    "stats.factor.weak": "stats['factor']['weak'] of the factor",
    "size_t counts": "the system addresses",
    "Z does not have this entry": "Selected does not have this entry",
}
_ARRAYS = {  # of a matrix
    "A.p": "A.indptr", "A.i": "A.indices", "A.x": "A.data", "V.x": "V.data", "H.x": "A.data",
    "a diagonal entry of H": "a diagonal entry of A", "H has more": "A has more",
}
NAMES.update(_ARRAYS)
NAMES.update(("options." + name, name) for name in (
    "block_size", "consistency_tolerance", "error_limit", "growth_limit", "mass", "null_tolerance",
    "null_vector", "ordering", "perm", "purpose", "region", "regularization", "signs", "storage",
    "triangle"))



def _any_of(names):
    return re.compile("|".join(r"(?<![\w.])%s(?!\w)" % re.escape(name) if name[0].isalpha() else
                               re.escape(name) + r"(?!\w)"
                               for name in sorted(names, key=len, reverse=True)))


_WORDS, _OF_ARRAYS = _any_of(NAMES), _any_of(_ARRAYS)
# what is left of C in a sentence on what no call of this package passes
_OF_C = re.compile(r"\b(?:sl|SL|sli|SLI)_\w|\b(?:options|stats\.\w+|set|threads)\.\w|\bNULL\b|"
                   r"\b[A-Z]\.(?:p|i|x|im|columns)\b|\bld[bgrxyz]\b|\bn_(?:rows|cols|columns)\b|"
                   r"\bof (?:options|set) is not\b|\blog_abs_det\b|\bbackward_error\b")


def names_c(text):
    """Whether a sentence has names of C other than arrays of a matrix, as advice on options has."""
    text = _OF_ARRAYS.sub("", text)
    return _WORDS.search(text) is not None or _OF_C.search(text) is not None


def in_own_names(text, status):
    """A sentence in the names of this package; what only C has gives way to the text of the status,
    with the place."""
    text = _WORDS.sub(lambda found: NAMES[found.group()], text)
    if not _OF_C.search(text):
        return text
    place = re.search(r" \((?:row|column|line|value|errno) [^()]*\)$", text)
    return status + (place.group() if place else "")
