"""mesh.py: a bumpy square of triangles, its cotangent Laplacian and the areas of its vertices."""
import numpy as np
import scipy.sparse as sp

from sparse_local import mesh


def surface(side=40):
    """(points, triangles): side * side vertices over a unit square."""
    y, x = np.stack(np.divmod(np.arange(side * side), side)) / (side - 1.0)
    points = np.stack([x, y, 0.15 * np.sin(6 * x) * np.cos(5 * y)], axis=1)
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + side], axis=1)
    upper = np.stack([corner + 1, corner + side + 1, corner + side], axis=1)
    return points, np.concatenate([lower, upper])


def laplacian(points, triangles):
    """(L, M): the positive semidefinite cotangent Laplacian, and the areas as a diagonal matrix."""
    L, mass = mesh.laplacian(points, triangles)
    return L, sp.diags(mass, format="csc")


def boundary(side=40):
    """The vertices of the border, in one round."""
    k = np.arange(side - 1)
    return np.concatenate([k, (k + 1) * side - 1, side * side - 1 - k, (side - 1 - k) * side])
