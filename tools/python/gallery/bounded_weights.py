"""bounded_weights.py: bounded biharmonic weights [Jacobson et al. 2011] by held rows."""
from time import process_time

import numpy as np
import scipy.sparse as sp
import sparse_local

from scene import ARMS, creature, draw, laplacian

points, triangles = creature()
L, M = laplacian(points, triangles)
Q = (L @ sp.diags(1 / M.diagonal()) @ L).tocsc()
Q = ((Q + Q.T) / 2).tocsc()
at, near = L.nonzero()
handles = (points @ ARMS.T).argmax(axis=0)
F = sparse_local.Factor(Q, null_pivots="skip")
spent = np.zeros(2)


def weights(handle):
    """(w, steps, held rows, difference to new factors); w is 1 at handle, 0 at the others."""
    # w minimizes w' Q w under 0 <= w <= 1.
    held, values, difference = list(handles), list((handles == handle).astype(float)), 0
    C = F.constraints(held, A=Q)
    for step in range(1, 100):
        began = process_time()
        w = C.solve(None, np.array(values))
        spent[0] += process_time() - began
        began = process_time()
        again = sparse_local.FixedRows(Q, held, definite=True).solve(None, np.array(values))
        spent[1] += process_time() - began
        difference, force = max(difference, np.abs(w - again).max()), Q @ w
        # Rows outside the bounds are held at them where they are farther out than their neighbors:
        # the others follow. Held rows that are pulled inwards are released.
        out, peak = np.maximum(-w, w - 1), np.zeros(len(w))
        out[held] = 0
        np.maximum.at(peak, at, out[near])
        new = np.flatnonzero((out > 1e-9) & (out >= peak))
        pull = force[held] * np.where(np.array(values) == 0, 1, -1) / np.abs(force).max()
        gone = [k for k in range(len(handles), len(held)) if pull[k] < -1e-9]
        if not len(new) and not gone:
            return w, step, len(held), difference
        held = [row for k, row in enumerate(held) if k not in gone] + list(new)
        values = [v for k, v in enumerate(values) if k not in gone] + list((w[new] > 0.5) * 1.0)
        began = process_time()
        C.release(gone).add(new)
        spent[0] += process_time() - began
    raise RuntimeError("the active set has not settled")


pictures = []
for handle in handles:
    w, steps, count, difference = weights(handle)
    print("handle %d: %d steps, %d held rows; weights from %.1e to 1%+.1e; new factors: %.1e"
          % (handle, steps, count, w.min(), w.max() - 1, difference))
    assert difference < 1e-7 and w.min() > -1e-8 and w.max() < 1 + 1e-8 and w[handle] == 1
    pictures.append((points, triangles, w))
print("%.3f of the time of new factors" % (spent[0] / spent[1]))
assert spent[0] < 0.25 * spent[1]
draw([pictures[0], pictures[3], pictures[4]], "bounded_weights.png")
