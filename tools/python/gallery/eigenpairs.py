"""eigenpairs.py: the lowest 60 eigenpairs of L x = lambda M x, by SciPy's eigsh over one factor."""
import numpy as np
from scipy.sparse.linalg import eigsh
from sparse_local.linalg import shift_invert

from scene import creature, draw, laplacian

points, triangles = creature()
L, M = laplacian(points, triangles)

# L is singular: a small negative shift makes it definite, and moves no eigenvector.
shift = -1e-3
values, vectors = eigsh(L, 60, M, sigma=shift, OPinv=shift_invert(L, shift, M, definite=True))

residual = np.abs(L @ vectors - (M @ vectors) * values).max() / np.abs(L).max()
gram = np.abs(vectors.T @ (M @ vectors) - np.eye(60)).max()
print("lambda_1 = %.1e, lambda_60 = %.2f; largest residual %.1e, orthonormal to %.1e"
      % (values[0], values[-1], residual, gram))
assert residual < 1e-9 and gram < 1e-9 and abs(values[0]) < 1e-9 < values[1]
draw([(points, triangles, vectors[:, k]) for k in (4, 20, 59)], "eigenpairs.png")
