"""Exceptions: one class for each status of the library, with the row of the error."""


class Error(Exception):
    """A failed call. row and column are those of the matrix (of its transpose for CSR), or None."""

    def __init__(self, text, row=None, column=None, value=0.0, advice=None):
        self.row = row
        self.column = column
        self.value = value
        if row is not None:
            text += ", row %d" % row
        if column is not None:
            text += ", column %d" % column
        super().__init__(text if advice is None else "%s; %s" % (text, advice))
        self.cause = text  # without advice on options, for doors that do not take them


class ArgumentError(Error, ValueError):
    """An argument of a wrong size, or an index out of range."""


class PatternError(Error, ValueError):
    """A malformed matrix, one that is not symmetric, or not the analyzed pattern."""


class PivotError(Error, ArithmeticError):
    """A null pivot: the matrix is singular or needs pivoting."""


class NotFiniteError(Error, ArithmeticError):
    """A NaN or an infinity in the values or in a result."""


class InconsistentError(Error, ArithmeticError):
    """A singular system whose right-hand side has no solution."""


class InaccurateError(Error, ArithmeticError):
    """Pivot growth, or the backward error after refinement, is above its limit."""


class StateError(Error, RuntimeError):
    """A failed factor, numbers that are out of date, a mapped object that would have to change, or
    objects that do not belong together."""


class TooLargeError(Error, OverflowError):
    """A count that does not fit its type."""


class UnsupportedError(Error, NotImplementedError):
    """Not compiled in, or not available on this processor."""


class OutOfMemoryError(Error, MemoryError):
    """The allocator failed."""


# in the order of sl_status, from 1 on
BY_STATUS = (ArgumentError, OutOfMemoryError, PatternError, PivotError, NotFiniteError,
             TooLargeError, UnsupportedError, Error, Error, StateError, InconsistentError,
             InaccurateError, PatternError, StateError, StateError)
