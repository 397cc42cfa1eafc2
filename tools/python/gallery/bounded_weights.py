"""bounded_weights.py: bounded biharmonic weights [Jacobson et al. 2011] by held rows."""
import numpy as np
import scipy.sparse as sp
import sparse_local

from scene import ARMS, creature, draw, laplacian

points, triangles = creature()
L, M = laplacian(points, triangles)
Q = (L @ sp.diags(1 / M.diagonal()) @ L).tocsc()
Q = ((Q + Q.T) / 2).tocsc()
handles = (points @ ARMS.T).argmax(axis=0)
F = sparse_local.Factor(Q, null_pivots="skip")


def weights(handle):
    """(w, steps, held rows, difference to a new factor); w is 1 at handle, 0 at the others."""
    # w minimizes w' Q w under 0 <= w <= 1.
    held, values = list(handles), list((handles == handle).astype(float))
    C = F.constraints(held)
    for step in range(1, 100):
        w = C.solve(None, np.array(values))
        force = Q @ w
        # Rows outside the bounds are held at them; held rows that are pulled inwards are released.
        inside = np.ones(len(w), bool)
        inside[held] = False
        new = np.flatnonzero(inside & ((w < -1e-9) | (w > 1 + 1e-9)))
        pull = force[held] * np.where(np.array(values) == 0, 1, -1) / np.abs(force).max()
        gone = [k for k in range(len(handles), len(held)) if pull[k] < -1e-9]
        if not len(new) and not gone:
            again = sparse_local.FixedRows(Q, held, definite=True).solve(np.array(values))
            return w, step, len(held), np.abs(w - again).max()
        C.release(gone)
        held = [row for k, row in enumerate(held) if k not in gone] + list(new)
        values = [v for k, v in enumerate(values) if k not in gone] + list((w[new] > 0.5) * 1.0)
        C.add(new)
    raise RuntimeError("the active set has not settled")


pictures = []
for handle in handles:
    w, steps, count, difference = weights(handle)
    print("handle %d: %d steps, %d held rows; weights from %.1e to 1%+.1e; a new factor: %.1e"
          % (handle, steps, count, w.min(), w.max() - 1, difference))
    assert difference < 1e-7 and w.min() > -1e-8 and w.max() < 1 + 1e-8 and w[handle] == 1
    pictures.append((points, triangles, w))
draw([pictures[0], pictures[3], pictures[4]], "bounded_weights.png")
