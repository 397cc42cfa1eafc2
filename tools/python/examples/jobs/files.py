"""files.py: a factor is saved once, and processes map it: nothing is computed or read again."""
import os
import subprocess
import sys
import tempfile

import numpy as np

import sparse_local as sl
from mesh import laplacian, surface

L, M = laplacian(*surface())
F = sl.Factor(M + 1e-3 * L)

with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "heat.slf")
    F.save(path)
    program = """
import sys, sparse_local as sl
F = sl.Factor.load(sys.argv[1], map=True)
print(repr(F.local([820], [1.0], [100])[0]))
"""
    out = subprocess.run([sys.executable, "-c", program, path], capture_output=True, text=True,
                         check=True).stdout
    assert float(out) == F.local([820], [1.0], [100])[0]  # the same bits
    print("%d kB; another process says %s" % (os.path.getsize(path) // 1000, out.strip()))

    Z, region = sl.Selected(F), F.region(np.arange(200))
    sl.save_set(path, F, selected=Z, regions=[region])  # with entries of the inverse and a region
    G, Y, regions = sl.load_set(path, map=True)
    assert np.array_equal(Y.diagonal(), Z.diagonal())
    for mapped in (G, Y, regions):
        del mapped
    del G, Y, regions
