"""Types of sparse_local.mesh."""
from typing import Any

from numpy.typing import ArrayLike, NDArray

def laplacian(points: ArrayLike, triangles: ArrayLike) -> tuple[Any, NDArray[Any]]: ...
def boundary(triangles: ArrayLike) -> NDArray[Any]: ...

__all__ = ["laplacian", "boundary"]
