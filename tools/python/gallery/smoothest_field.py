"""smoothest_field.py: the smoothest field of crosses [Knoppel et al. 2013], a Hermitian system."""
import numpy as np
import scipy.sparse as sp
import sparse_local

from scene import creature, draw, laplacian

points, triangles = creature()
L, M = laplacian(points, triangles)
n, fold = len(points), 4

# A tangent plane with two axes at each vertex; an edge has an angle in the planes of both ends.
normal = np.zeros((n, 3))
a, b, c = (points[triangles[:, k]] for k in range(3))
for k in range(3):
    np.add.at(normal, triangles[:, k], np.cross(b - a, c - a))
normal /= np.linalg.norm(normal, axis=1)[:, None]
axis = np.cross(normal, np.eye(3)[np.abs(normal).argmin(axis=1)])
axis /= np.linalg.norm(axis, axis=1)[:, None]
other = np.cross(normal, axis)


def turns(i, j):
    """exp(i (angle of the edge at j - angle at i)): what carries a tangent vector from i to j."""
    edge = points[j] - points[i]
    at_i, at_j = ((edge * axis[k]).sum(1) + 1j * (edge * other[k]).sum(1) for k in (i, j))
    return at_j / at_i / np.abs(at_j / at_i)


# L(i,j) exp(i fold (angle)): its lowest eigenvector is the field, by inverse iteration.
E = L.tocoo()
off = E.row != E.col
i, j = E.row[off], E.col[off]
carried = sp.coo_matrix((E.data[off] * turns(j, i) ** fold, (i, j)), shape=(n, n))
A = (carried + sp.diags(L.diagonal())).tocsc()
A = ((A + A.getH()) / 2).tocsc()
F = sparse_local.Factor(A)
field = np.ones(n, complex)
for _ in range(200):
    field = F.solve(M @ field)
    field /= np.sqrt((field.conj() @ (M @ field)).real)
energy = (field.conj() @ (A @ field)).real
residual = np.abs(A @ field - energy * (M @ field)).max() / np.abs(A).max()

# The index of a face: what the field turns along its edges, less what carrying itself turns.
turned, carrying = 0, 1
for k in range(3):
    i, j = triangles[:, k], triangles[:, (k + 1) % 3]
    turned = turned + np.angle(field[j] / (field[i] * turns(i, j) ** fold))
    carrying = carrying * turns(i, j)
index = np.rint((turned + fold * np.angle(carrying)) / (2 * np.pi)).astype(int)
print("energy %.3f, residual %.1e; %d singular faces, indices sum up to %d / %d"
      % (energy, residual, np.count_nonzero(index), index.sum(), fold))
assert residual < 1e-6 and abs(index.sum()) == 2 * fold
draw([(points, triangles, np.abs(field))], "smoothest_field.png")
