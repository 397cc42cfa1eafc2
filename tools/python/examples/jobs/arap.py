"""arap.py: a surface that bends as rigidly as possible: one factor, a solve in each step."""
import numpy as np
import scipy.sparse as sp

import sparse_local as sl
from mesh import boundary, laplacian, surface

points, triangles = surface()
L, M = laplacian(points, triangles)
edges = sp.triu(-L, 1).tocoo()
i, j, w = edges.row, edges.col, edges.data
rest = points[i] - points[j]

held = np.append(boundary(), 820)  # the border stays, the middle is pulled up
target = points[held].copy()
target[-1] += [0.0, 0.0, 0.5]

F = sl.Factor(L, null_pivots="skip")  # singular until rows are pinned
pins = F.constraints(held)
bent = points.copy()
energies = []
for step in range(12):
    # the rotation of each vertex that fits its edges best
    now = bent[i] - bent[j]
    S = np.zeros((F.n, 3, 3))
    outer = w[:, None, None] * rest[:, :, None] * now[:, None, :]
    np.add.at(S, i, outer)
    np.add.at(S, j, outer)
    U, _, V = np.linalg.svd(S)
    U[:, :, 2] *= np.sign(np.linalg.det(U @ V))[:, None]
    turn = np.swapaxes(U @ V, 1, 2)
    # the positions that fit these rotations best
    b = np.zeros((F.n, 3))
    mean = 0.5 * w[:, None] * np.einsum("eij,ej->ei", turn[i] + turn[j], rest)
    np.add.at(b, i, mean)
    np.add.at(b, j, -mean)
    bent = pins.solve(b, target)
    strain = [bent[i] - bent[j] - np.einsum("eij,ej->ei", turn[k], rest) for k in (i, j)]
    energies.append((w * (np.square(strain)).sum(axis=(0, 2))).sum())

assert np.allclose(bent[held], target) and (np.diff(energies) < 1e-12).all()
print("energy %.4f after one step, %.4f after %d" % (energies[0], energies[-1], len(energies)))
