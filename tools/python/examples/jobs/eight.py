"""eight.py: heat kernel signatures for eight times: eight factors at once, over one analysis."""
import numpy as np

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
times = np.geomspace(1e-4, 1e-1, 8)

steps = sl.Sum([M, L], definite=True, threads=2)
factors = steps.factor([[1.0, t] for t in times])  # M + t L for each t
signature = np.stack([F.diagonal() for F in factors], axis=1)  # (vertices, times)

plan = factors[0].plan([820], [100, 101])  # one plan, on each of the factors
heat = sl.solve_batch([(plan.on(F), [1.0]) for F in factors], threads=2)
for t, F, u in zip(times, factors, heat):
    assert np.array_equal(u, F.local([820], [1.0], [100, 101]))
    assert np.allclose((M + t * L) @ F.solve(M.diagonal()), M.diagonal())  # heat 1 stays 1
print("signature of vertex 820: %s" % np.round(signature[820], 1))
