"""pairs.py: effective resistances of pairs of vertices, from entries of the inverse."""
import numpy as np

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
F = sl.Factor(L, null_pivots="skip")  # entries are those of the pseudo-inverse

i, j = np.array([0, 820, 5]), np.array([1599, 821, 1500])
resistance = F.pairs(i, i) + F.pairs(j, j) - 2 * F.pairs(i, j)

for a, c, r in zip(i, j, resistance):  # a current of 1 from a to c: the difference of potentials
    x = F.local([a, c], [1.0, -1.0], [a, c])
    assert np.isclose(x[0] - x[1], r)
    print("from %d to %d: %.4f" % (a, c, r))
