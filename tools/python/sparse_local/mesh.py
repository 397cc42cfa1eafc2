"""Matrices of a triangle mesh: the cotangent Laplacian, the areas of its vertices, its boundary.

points is an array of n x 3 or n x 2 numbers, triangles one of m x 3 vertices. Needs SciPy.
"""
import numpy as np

from ._errors import ArgumentError

_FLATNESS = 1.5e-8  # the square root of epsilon, as in sparse_local_mesh.h

__all__ = ["laplacian", "boundary"]


def _checked(points, triangles):
    points = np.asarray(points, dtype=float)
    triangles = np.asarray(triangles)
    if points.ndim != 2 or points.shape[1] not in (2, 3) or not np.isfinite(points).all():
        raise ArgumentError("points: finite numbers of shape (n, 3) or (n, 2)")
    if triangles.ndim != 2 or triangles.shape[1] != 3 or triangles.dtype.kind not in "iu":
        raise ArgumentError("triangles: vertices of shape (m, 3)")
    wrong = np.flatnonzero(((triangles < 0) | (triangles >= len(points))).any(axis=1))
    if len(wrong) > 0:
        raise ArgumentError("triangle %d has a vertex that there is not" % wrong[0])
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return points, triangles


def laplacian(points, triangles):
    """(L, mass): the positive semidefinite cotangent Laplacian, n x n, and n areas.

    Each vertex has a third of the area of its triangles. A flat triangle, twice whose area is below
    1.5e-8 times its longest edge squared, adds its area alone. A vertex without triangles has an
    empty row and no area: a factor needs a value for it, for example by null_pivots="skip".
    """
    import scipy.sparse as sp
    points, triangles = _checked(points, triangles)
    n = len(points)
    p = points[triangles]
    twice = np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)
    longest = ((p - np.roll(p, 1, axis=1)) ** 2).sum(axis=2).max(axis=1)
    rows, columns, weights = [], [], []
    for k in range(3):
        i, j, o = (k + 1) % 3, (k + 2) % 3, k
        dots = ((p[:, i] - p[:, o]) * (p[:, j] - p[:, o])).sum(axis=1)
        half = np.divide(dots, 2 * twice, out=np.zeros(len(p)), where=twice > _FLATNESS * longest)
        rows.append(triangles[:, i])
        columns.append(triangles[:, j])
        weights.append(half)
    edges = sp.coo_matrix((np.concatenate(weights), (np.concatenate(rows),
                                                     np.concatenate(columns))), shape=(n, n))
    edges = (edges + edges.T).tocsc()
    L = (sp.diags(np.asarray(edges.sum(axis=1)).ravel()) - edges).tocsc()
    L.sort_indices()
    return L, np.bincount(triangles.ravel(), np.repeat(twice / 6, 3), minlength=n)


def boundary(triangles):
    """The edges (from, to) that one triangle has, in its direction: an array of shape (k, 2)."""
    triangles = np.asarray(triangles)
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    n = int(triangles.max()) + 1 if len(triangles) > 0 else 0
    keys = edges.min(axis=1).astype(np.int64) * n + edges.max(axis=1)
    _, first, count = np.unique(keys, return_index=True, return_counts=True)
    return edges[np.sort(first[count == 1])]
