"""edges.py: weights of edges change one after the other, and the factor follows."""
import numpy as np
import scipy.sparse as sp

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
A = (L + 0.1 * M).tocsc()
F = sl.Factor(A)
plan = F.plan([820], [100])  # valid after every change
edges = sp.triu(-L, 1).tocoo()
rng = np.random.default_rng(0)
methods = []
for step in range(20):
    e = rng.integers(edges.nnz)
    i, j, w = edges.row[e], edges.col[e], 0.5 * edges.data[e]  # half as much again
    v = sp.csc_matrix(([1.0, -1.0], ([i, j], [0, 0])), shape=(F.n, 1))
    B = A + w * (v @ v.T)
    F.change_entries(B, was=A)  # finds the four entries, and the cheapest way
    methods.append(F.changed["method"])
    A = B
    plan.solve([1.0])
assert np.allclose(plan.solve([1.0]), sl.Factor(A).local([820], [1.0], [100]))

F.rank_update(v, [-w])  # without the matrix: the last change is taken back
print("20 changes: %s" % ", ".join("%d by %s" % (methods.count(m), m) for m in set(methods)))
