"""kkt.py: the smallest energy under linear equalities: an indefinite system with zeros on the
diagonal."""
import numpy as np
import scipy.sparse as sp

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
n = L.shape[0]
Q = (L + 1e-2 * M).tocsc()
C = sp.csr_matrix(([1.0, -1.0, 1.0, 1.0], ([0, 0, 1, 1], [3, 1500, 820, 821])), shape=(2, n))
d = np.array([0.0, 2.0])  # x[3] = x[1500], and x[820] + x[821] = 2

K = sp.bmat([[Q, C.T], [C, None]], format="csc")
b = np.concatenate([np.zeros(n), d])
F = sl.Factor(K, pivoted=True)  # 2x2 pivots, chosen by the values
x, error = F.refine(K, F.solve(b), b)
positive, negative, null = F.inertia
assert (positive, negative, null) == (n, 2, 0)  # so x is a minimum
assert np.allclose(C @ x[:n], d)
print("x[820] = %.4f, x[821] = %.4f, multipliers %s, backward error %.0e" % (
    x[820], x[821], np.round(x[n:], 4), error))
