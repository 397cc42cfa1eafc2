"""slim.py: a layout without flips by SLIM [Rabinovich et al. 2017]: a refactor an iteration."""
import numpy as np
import scipy.sparse as sp
import sparse_local

from scene import draw, ring

points, triangles = ring()
n, faces = len(points), np.arange(len(triangles))

# Gx, Gy: derivatives in the plane of each face, faces x n.
a, b, c = (points[triangles[:, k]] for k in range(3))
length = np.linalg.norm(b - a, axis=1)
along = ((c - a) * (b - a)).sum(1) / length
twice = np.linalg.norm(np.cross(b - a, c - a), axis=1)
height, area = twice / length, twice / 2 / (twice / 2).sum()
x = np.stack([0 * length, length, along], 1)
y = np.stack([0 * length, 0 * length, height], 1)
Gx, Gy = (sp.csr_matrix((((np.roll(z, s, 1) - np.roll(z, -s, 1)) / twice[:, None]).ravel(),
                         (np.repeat(faces, 3), triangles.ravel())), shape=(len(faces), n))
          for z, s in ((y, -1), (x, 1)))


def jacobians(u):
    return np.stack([Gx @ u, Gy @ u], axis=-1)


def energy(u):
    """The symmetric Dirichlet energy, 4 for an isometry; infinite with a face turned over."""
    J = jacobians(u)
    det = np.linalg.det(J)
    return np.inf if det.min() <= 0 else area @ ((J * J).sum((1, 2)) * (1 + 1 / det ** 2))


u, F = points[:, :2] * [1, 0.2], None
values = [energy(u)]
while len(values) < 3 or values[-1] < (1 - 1e-6) * values[-2]:
    U, s, V = np.linalg.svd(jacobians(u))
    s = np.where(np.abs(s - 1) < 1e-6, 1 + 1e-6, s)
    W = (U * np.sqrt((s - s ** -3) / (s - 1))[:, None]) @ U.transpose(0, 2, 1)
    target, root = W @ (U @ V), np.sqrt(area)
    B = sp.vstack([sp.hstack([sp.diags(root * W[:, r, k]) @ G for k in (0, 1)])
                   for r in (0, 1) for G in (Gx, Gy)]).tocsr()
    A = (B.T @ B + 1e-9 * sp.identity(2 * n)).tocsc()
    A = ((A + A.T) / 2).tocsc()
    F = sparse_local.cholesky(A) if F is None else F.refactor(A)
    right = np.concatenate([root * target[:, r, k] for r in (0, 1) for k in (0, 1)])
    step, way = 1.0, F.solve(B.T @ right + 1e-9 * u.T.ravel()).reshape(2, n).T - u
    while energy(u + step * way) > values[-1] and step > 1e-9:
        step *= 0.7
    u = u + step * way
    values.append(energy(u))
s, turned = np.linalg.svd(jacobians(u))[1], (np.linalg.det(jacobians(u)) <= 0).sum()
print("energy %.2f to %.4f in %d iterations, %d faces turned over, worst ratio %.2f"
      % (values[0], values[-1], len(values) - 1, turned, (s[:, 0] / s[:, 1]).max()))
assert turned == 0 and values[-1] < 4.05
draw([(points, triangles, points[:, 2]), (u, triangles, points[:, 2])], "slim.png")
