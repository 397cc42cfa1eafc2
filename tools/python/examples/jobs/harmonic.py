"""harmonic.py: a flat map of a surface whose border is laid on a circle."""
import numpy as np

import sparse_local as sl
from mesh import boundary, laplacian, surface

points, triangles = surface()
L, M = laplacian(points, triangles)
border = boundary()

angle = np.linspace(0, 2 * np.pi, len(border), endpoint=False)
circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
flat = sl.FixedRows(L, border).solve(None, circle)  # both coordinates at once

inside = np.setdiff1d(np.arange(len(points)), border)
assert np.array_equal(flat[border], circle) and abs((L @ flat)[inside]).max() < 1e-12
a, b, c = (flat[triangles[:, k]].T for k in range(3))
areas = (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]
print("%d triangles, %d of them turned over" % (len(areas), (areas <= 0).sum()))
