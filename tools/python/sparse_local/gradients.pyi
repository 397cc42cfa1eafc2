"""Types of sparse_local.gradients."""
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sparse_local import Factor, Selected

__all__ = ["solve_gradient", "logdet_gradient", "pairs_gradient", "LocalGradient", "Stored"]

class Stored:
    rows: NDArray[np.integer[Any]]
    columns: NDArray[np.integer[Any]]
    weights: NDArray[np.float64]
    def __init__(self, A: Any, triangle: str | None = ...) -> None: ...
    def has(self, rows: NDArray[np.integer[Any]], columns: NDArray[np.integer[Any]]) -> bool: ...
    def products(self, lam: ArrayLike, x: ArrayLike) -> NDArray[np.float64]: ...

def solve_gradient(factor: Factor, A: Any, x: ArrayLike,
                   g: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def logdet_gradient(factor: Factor, A: Any,
                    selected: Selected | None = ...) -> NDArray[np.float64]: ...
def pairs_gradient(factor: Factor, A: Any, rows: Sequence[int] | NDArray[np.integer[Any]],
                   columns: Sequence[int] | NDArray[np.integer[Any]],
                   g: ArrayLike) -> NDArray[np.float64]: ...

def _check_kind(factor: Factor) -> None: ...

class LocalGradient:
    bset: NDArray[np.int32]
    xset: NDArray[np.int32]
    rows: NDArray[np.int32]
    columns: NDArray[np.int32]
    def __init__(self, factor: Factor, bset: Sequence[int], xset: Sequence[int],
                 rows: Sequence[int] = ..., columns: Sequence[int] = ...) -> None: ...
    def solve(self, b: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def gradient(self, kept: NDArray[np.float64],
                 g: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
