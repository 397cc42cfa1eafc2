"""heat.py: heat from one vertex, everywhere and at one other vertex."""
import numpy as np

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
F = sl.cholesky(M + 1e-3 * L)  # M - 1e-3 L would be refused, with its row

b = np.zeros(F.n)
b[820] = 1.0
u = F.solve(b)  # everywhere

plan = F.plan([820], [100, 1500])  # the same heat, in two vertices
near, far = plan.solve([1.0])
assert (near, far) == (u[100], u[1500])
print("of heat 1 in vertex 820, %.2g is at vertex 100 and %.2g at vertex 1500" % (near, far))
