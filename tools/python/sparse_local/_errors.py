"""Exceptions: one class for each status of the library, with the row of the error.

A class is named as its status in C, status says: SL_ERR_NOT_FINITE is NotFiniteError. Only what the
allocator refuses is not, as MemoryError is Python's own.
"""


class Error(Exception):
    """A failed call. row and column are those of the matrix (of its transpose for CSR), or None.

    status  the name of the library for it, such as 'PIVOT'; '' where the class is of several.
    failed  the number of the factor or request, where a call has many; None elsewhere.
    """
    status, failed = "", None

    def __init__(self, text, row=None, column=None, value=0.0, advice=None):
        self.row = row
        self.column = column
        self.value = value
        if row is not None:
            text += ", row %d" % row
        if column is not None:
            text += ", column %d" % column
        super().__init__(text if advice is None else "%s; %s" % (text, advice))
        self.cause = text  # without advice on options, for adapters that do not take them


class PatternError(Error, ValueError):
    """MalformedError or OtherPatternError."""


class StateError(Error, RuntimeError):
    """MismatchError, StaleError or ReadOnlyError."""


class ArgumentError(Error, ValueError):
    """An argument of a wrong size, or an index out of range."""
    status = "ARGUMENT"


class OutOfMemoryError(Error, MemoryError):
    """The allocator failed."""
    status = "MEMORY"


class MalformedError(PatternError):
    """A malformed matrix, or one that is not symmetric."""
    status = "MALFORMED"


class PivotError(Error, ArithmeticError):
    """A null pivot: the matrix is singular or needs pivoting."""
    status = "PIVOT"


class NotFiniteError(Error, ArithmeticError):
    """A NaN or an infinity in the values or in a result."""
    status = "NOT_FINITE"


class TooLargeError(Error, OverflowError):
    """A count that does not fit its type."""
    status = "TOO_LARGE"


class UnsupportedError(Error, NotImplementedError):
    """Not compiled in, not available on this processor, or no file of this library."""
    status = "UNSUPPORTED"


class IoError(Error):
    """A file that cannot be opened, read, parsed or written."""
    status = "IO"


class OrderingError(Error):
    """METIS failed."""
    status = "ORDERING"


class MismatchError(StateError):
    """Objects that do not belong together, such as a plan and a factor of different analyses."""
    status = "MISMATCH"


class InconsistentError(Error, ArithmeticError):
    """A singular system whose right-hand side has no solution."""
    status = "INCONSISTENT"


class InaccurateError(Error, ArithmeticError):
    """Pivot growth, or the backward error after refinement, is above its limit."""
    status = "INACCURATE"


class OtherPatternError(PatternError):
    """A matrix whose pattern is not the analyzed one."""
    status = "OTHER_PATTERN"


class StaleError(StateError):
    """A closed object, a failed factor, or what was made of older numbers: update it."""
    status = "STALE"


class ReadOnlyError(StateError):
    """A mapped object that would have to change, or a factor of Factor.submatrix."""
    status = "READ_ONLY"


# in the order of sl_status, from 1 on
BY_STATUS = (ArgumentError, OutOfMemoryError, MalformedError, PivotError, NotFiniteError,
             TooLargeError, UnsupportedError, IoError, OrderingError, MismatchError,
             InconsistentError, InaccurateError, OtherPatternError, StaleError, ReadOnlyError)
