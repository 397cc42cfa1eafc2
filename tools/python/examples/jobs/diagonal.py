"""diagonal.py: a field with precision matrix A: its variances, and samples of it."""
import numpy as np

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
F = sl.cholesky(L + 4.0 * M)

variance = F.diagonal()  # all of the inverse's diagonal, by selected inversion
assert np.allclose(F.diagonal([0, 820]), variance[[0, 820]])  # some, by forward sweeps

samples = F.sample(4000, rng=np.random.default_rng(0))
assert np.allclose(samples.var(axis=1), variance, rtol=0.15)
sign, log = F.logdet()
print("standard deviation %.3f in a corner, %.3f in the middle; log det %.1f" % (
    variance[0] ** 0.5, variance[820] ** 0.5, log))
