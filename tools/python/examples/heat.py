"""heat.py: a tour of the package in six pictures; python heat.py [heat.png]

The cells are marked by #%%, so that editors run them one by one as in a notebook. Needs SciPy and
matplotlib.
"""
# %% A bumpy square: n vertices, and the Laplacian of its grid
import sys

import numpy as np
import scipy.sparse as sp
import matplotlib
matplotlib.use("Agg" if __name__ == "__main__" else matplotlib.get_backend())
import matplotlib.pyplot as plt  # noqa: E402

import sparse_local  # noqa: E402

SIDE = 120
n = SIDE * SIDE
path = sp.diags([np.full(SIDE - 1, -1.0)] * 2, [-1, 1], shape=(SIDE, SIDE))
edges = (sp.kron(sp.identity(SIDE), path) + sp.kron(path, sp.identity(SIDE))).tocoo()
y, x = np.divmod(np.arange(n), SIDE)
wall = (np.abs(x - SIDE // 2) < 3) & (np.abs(y - SIDE // 2) > 12)
edges.data = np.where(wall[edges.row] | wall[edges.col], -0.05, -1.0)
L = (edges + sp.diags(-np.asarray(edges.sum(axis=1)).ravel())).tocsc()
figure, axes = plt.subplots(2, 3, figsize=(12, 8))


def show(place, values, title):
    """One picture of n numbers."""
    ax = axes.flat[place]
    ax.imshow(np.asarray(values).reshape(SIDE, SIDE), cmap="viridis")
    ax.set_title(title, fontsize=10)
    ax.axis("off")


# %% Heat from one vertex: factor once, solve fully
source = SIDE // 4 + SIDE * (SIDE // 3)
F = sparse_local.Factor(L + 1e-3 * sp.identity(n, format="csc"))
b = np.zeros(n)
b[source] = 1
u = F.solve(b)
show(0, np.log10(u), "heat from one vertex (log)")

# %% The same in a window only, by a plan: the columns of L that the two sweeps visit
window = np.flatnonzero((x > 70) & (x < 95) & (y > 20) & (y < 45))
plan = F.plan([source], window)
part = np.full(n, np.nan)
part[window] = np.log10(plan.solve([1.0]))
show(1, part, "a window of it: exact, %d of %d columns" % (plan.stats["x_columns"], n))
visited = np.zeros(n)
visited[F.perm[plan.columns("LT")]] = 1
visited[F.perm[plan.columns("L")]] += 2
show(2, visited, "vertices that the sweeps visit")

# %% Uncertainty: the diagonal of the inverse, and samples with that covariance
show(3, np.log10(F.diagonal()), "variance of each vertex (log)")
show(4, F.sample(rng=np.random.default_rng(1)), "a sample of covariance $A^{-1}$")

# %% A singular Laplacian: the zero-mean solution
mass = np.full(n, 1.0 / n)
b[-source] = -1
P = sparse_local.Factor(L, null_pivots="skip", mass=mass)
show(5, P.solve(b), "a source and a sink: zero mean")
assert abs(mass @ P.solve(b)) < 1e-12
assert np.allclose(10 ** part[window], u[window], rtol=1e-10)

# %% The picture
figure.tight_layout()
out = sys.argv[1] if len(sys.argv) > 1 else "heat.png"
figure.savefig(out, dpi=80)
print("wrote", out)
