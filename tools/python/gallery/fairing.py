"""fairing.py: an arm faired, L M^-1 L x = 0 with all else fixed; conformalized flow to a ball."""
import numpy as np
import scipy.sparse as sp
import sparse_local

from scene import ARMS, creature, draw, laplacian

points, triangles = creature()
L, M = laplacian(points, triangles)

# Fairing: rows outside the arm are fixed where they are.
Q = (L @ sp.diags(1 / M.diagonal()) @ L).tocsc()
Q = ((Q + Q.T) / 2).tocsc()
is_free = points @ ARMS[0] > 0.8
fixed = np.flatnonzero(~is_free)
faired = sparse_local.FixedRows(Q, fixed, definite=True).solve(None, points[fixed])
residual = np.abs((Q @ faired)[is_free]).max() / np.abs(Q @ points)[is_free].max()

# Flow [Kazhdan et al. 2012]: L stays, the masses follow the surface, and the factor is refilled.
flowing, step = points.copy(), 0.05
F = sparse_local.cholesky((M + step * L).tocsc())
for _ in range(40):
    mass = laplacian(flowing, triangles)[1]
    flowing = F.refactor((mass + step * L).tocsc()).solve(mass @ flowing)
    mass = laplacian(flowing, triangles)[1].diagonal()
    flowing = (flowing - mass @ flowing / mass.sum()) * np.sqrt(4 * np.pi / mass.sum())
radius = np.linalg.norm(flowing, axis=1)
print("fairing: %d free rows, residual %.1e; flow: radii from %.3f to %.3f"
      % (is_free.sum(), residual, radius.min(), radius.max()))
assert residual < 1e-8 and np.allclose(faired[fixed], points[fixed], rtol=0, atol=0)
assert radius.std() < 0.05 * radius.mean()
height = points[:, 2]
draw([(points, triangles, height), (faired, triangles, height), (flowing, triangles, height)],
     "fairing.png")
