"""pins.py: handles of a membrane that are grabbed, moved and released; the factor stays."""
import numpy as np

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
F = sl.Factor(L, null_pivots="skip")

pins = F.constraints([0, 39, 820])  # two corners and the middle
x = pins.solve(None, [0.0, 0.0, 1.0])
y = pins.solve(None, [0.0, 0.0, 2.0])  # moved: the solution is twice as high
assert np.allclose(y, 2 * x) and np.allclose(x[[0, 39, 820]], [0, 0, 1])

pins.add([1560])  # another corner is grabbed
z = pins.solve(None, [0.0, 0.0, 1.0, 0.5])
window = F.plan([], [860, 861])  # only these two vertices are asked for
assert np.allclose(pins.solve(np.zeros(0), [0.0, 0.0, 1.0, 0.5], plan=window), z[[860, 861]])

pins.release([2])  # and the middle let go
flat = pins.solve(None, [0.0, 0.0, 0.5])
print("vertex 860: %.3f held at 1, %.3f with another corner, %.3f released" % (x[860], z[860],
                                                                              flat[860]))
