"""The exceptions of sksparse.cholmod, raised for those of sparse_local."""
import contextlib

from scipy import sparse

from .. import _errors as ours


class CholmodError(Exception):
    """A failed call."""


class CholmodNotPositiveDefiniteError(CholmodError):
    """Not positive definite. column: the row of the pivot in A; factor: the Factor."""

    def __init__(self, message, column=None, factor=None):
        super().__init__(message)
        self.column = column
        self.factor = factor


class CholmodNotInstalledError(CholmodError):
    """An ordering that was not compiled in."""


class CholmodOutOfMemoryError(CholmodError):
    """The allocator failed."""


class CholmodTooLargeError(CholmodError):
    """A count that does not fit its type."""


class CholmodInvalidError(CholmodError):
    """A malformed matrix, another pattern, a NaN, or a factor without numbers."""


class CholmodGpuProblemError(CholmodError):
    """Never raised."""


class CholmodWarning(UserWarning):
    """What CHOLMOD takes without a word, and what costs accuracy."""


class CholmodTypeConversionWarning(CholmodWarning, sparse.SparseEfficiencyWarning):
    """A matrix in another format or type than the one that is used in place."""


_KINDS = ((ours.OutOfMemoryError, CholmodOutOfMemoryError),
          (ours.TooLargeError, CholmodTooLargeError),
          (ours.UnsupportedError, CholmodNotInstalledError),
          (ours.Error, CholmodInvalidError), (TypeError, CholmodInvalidError))


@contextlib.contextmanager
def translated(factor=None):
    """Raises what sksparse would raise."""
    try:
        yield
    except ours.PivotError as error:
        raise CholmodNotPositiveDefiniteError("not positive definite: " + error.cause, error.row,
                                              factor) from error
    except (ours.Error, TypeError) as error:
        kind = next(theirs for mine, theirs in _KINDS if isinstance(error, mine))
        raise kind(getattr(error, "cause", str(error))) from error
