"""bone_heat.py: skinning weights by heat from the bones [Baran and Popovic 2007], on one factor."""
import numpy as np
import scipy.sparse as sp
import sparse_local

from scene import ARMS, creature, draw, laplacian

points, triangles = creature()
L, M = laplacian(points, triangles)

# The bones: segments from the centre into the arms. A vertex takes heat from its nearest bone.
ends = 1.5 * ARMS / np.linalg.norm(ARMS, axis=1)[:, None]
along = np.clip(points @ ends.T / (ends * ends).sum(1), 0, 1)
distance = np.linalg.norm(points[:, None] - along[:, :, None] * ends, axis=2)
nearest = distance.argmin(axis=1)
heat = M @ sp.diags(0.5 / distance.min(axis=1) ** 2)

# (L + H) w_k = H p_k, with p_k = 1 where bone k is the nearest: one factor, all bones at once.
F = sparse_local.cholesky((L + heat).tocsc())
weights = F.solve(heat @ np.eye(len(ends))[nearest])

sums = np.abs(weights.sum(axis=1) - 1).max()
print("%d bones: weights from %.1e to %.3f, their sums are 1 to %.1e"
      % (len(ends), weights.min(), weights.max(), sums))
assert sums < 1e-10 and weights.min() > -0.01 and weights.max() < 1.01
draw([(points, triangles, weights[:, k]) for k in (0, 3, 4)], "bone_heat.png")
