"""lscm.py: a surface with a hole is laid out conformally [Levy et al. 2002], with 2 and 6 pins."""
import numpy as np
import scipy.sparse as sp
import sparse_local
from sparse_local.mesh import boundary

from scene import draw, laplacian, ring

points, triangles = ring()
n = len(points)
L, M = laplacian(points, triangles)

# Dirichlet energy less area. The area is a sum over the boundary edges, those with one face.
edges = boundary(triangles)
E = sp.coo_matrix((np.ones(len(edges)), edges.T), shape=(n, n))
A = ((E - E.T) / 2).tocsc()
K = sp.bmat([[L, -A], [A, L]], format="csc")

pictures = [(points, triangles, points[:, 2])]
corners = [points[:, 0].argmin(), points[:, 0].argmax(), points[:, 1].argmin(),
           points[:, 1].argmax(), 0, 45]
for pins in corners[:2], corners:
    rows = np.r_[pins, np.add(pins, n)]
    layout = sparse_local.FixedRows(K, rows).solve(None, points[pins, :2].T.ravel())
    free = np.setdiff1d(np.arange(2 * n), rows)
    residual = np.abs((K @ layout)[free]).max()
    u, v = layout.reshape(2, n)[:, triangles]
    area = (u[:, 1] - u[:, 0]) * (v[:, 2] - v[:, 0]) - (u[:, 2] - u[:, 0]) * (v[:, 1] - v[:, 0])
    print("%d pins: residual %.1e, %d of %d faces turned over"
          % (len(pins), residual, (area <= 0).sum(), len(area)))
    assert residual < 1e-10 and (len(pins) > 2 or (area > 0).all())
    pictures.append((layout.reshape(2, n).T, triangles, points[:, 2]))
draw(pictures, "lscm.png")
