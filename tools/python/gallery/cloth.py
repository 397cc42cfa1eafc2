"""cloth.py: a cloth falls onto a ball; one factor for all steps, and contacts are held rows."""
import numpy as np
import scipy.sparse as sp
import sparse_local

from scene import draw, laplacian, surface

rest, triangles = surface(30)
rest = rest * [1, 1, 0] - [0.5, 0.5, 0]
M = laplacian(rest, triangles)[1]
n, radius, step, stiffness = len(rest), 0.3, 0.02, 20.0

# Springs S along the edges; projective dynamics [Bouaziz et al. 2014] keeps M / step^2 + k S' S.
edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
count = len(edges)
S = sp.csr_matrix((np.tile([1.0, -1.0], count), (np.repeat(np.arange(count), 2), edges.ravel())),
                  shape=(count, n))
length = np.linalg.norm(S @ rest, axis=1)[:, None]
A = (M / step ** 2 + stiffness * (S.T @ S)).tocsc()
F = sparse_local.cholesky(A)
C, held, places = F.constraints(), np.zeros(0, int), np.zeros((0, 3))

x, speed, released = rest + [0.03, 0.02, radius + 0.05], 0 * rest, 0
for _ in range(60):
    start = x
    inertia = M @ (x + step * speed - [0, 0, 9.81 * step ** 2]) / step ** 2
    for _ in range(8):
        spring = S @ x
        spring *= length / np.linalg.norm(spring, axis=1)[:, None]
        b = inertia + stiffness * (S.T @ spring)
        while True:
            x = C.solve(b, places) if len(held) else F.solve(b)
            deep = np.linalg.norm(x, axis=1) < radius * (1 - 1e-9)
            deep[held] = False
            new = np.flatnonzero(deep)
            if not len(new):
                break
            C.add(new)
            held = np.r_[held, new]
            out = x[new] * radius / np.linalg.norm(x[new], axis=1)[:, None]
            places = np.concatenate([places, out])
    # What the ball pulls instead of pushing is released before the next step.
    force = ((A @ x - b)[held] * places).sum(axis=1)
    free = np.setdiff1d(np.arange(n), held)
    residual = np.abs((A @ x - b)[free]).max() / np.abs(b).max()
    assert residual < 1e-10 and np.linalg.norm(x, axis=1).min() > radius * (1 - 1e-8)
    C.release(np.flatnonzero(force < 0))
    released += (force < 0).sum()
    held, places = held[force >= 0], places[force >= 0]
    speed = 0.99 * (x - start) / step

print("%d contacts at the end, %d released before; residual %.1e, lowest point %.2f"
      % (len(held), released, residual, x[:, 2].min()))
assert len(held) > 20 and released and x[:, 2].min() < 0
draw([(x, triangles, x[:, 2])], "cloth.png")
