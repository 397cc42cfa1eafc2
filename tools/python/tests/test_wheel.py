"""The installed wheel: the compiled library is inside, and NumPy is all that it needs."""
import glob
import os
import subprocess
import sys

import pytest

import sparse_local as sl

PACKAGE = os.path.dirname(os.path.abspath(sl.__file__))
INFO = glob.glob(os.path.join(os.path.dirname(PACKAGE), "sparse_local-*.dist-info"))

# every other module that is imported raises ImportError, as where it is not installed
ALONE = """
import sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("scipy", "torch", "sksparse", "qdldl", "matplotlib"):
            raise ImportError("not installed: " + name)

sys.meta_path.insert(0, Absent())
import numpy as np
import sparse_local as sl
n = 30
k = np.arange(n)
values = np.r_[np.full(n, 2.5), np.full(n - 1, -1.0)]
A = sl.from_triplets(np.r_[k, k[1:]], np.r_[k, k[:-1]], values, n)
assert type(A) is sl.CscArrays and A.shape == (n, n)
dense = np.zeros((n, n))
for j in range(n):
    for p in range(A.indptr[j], A.indptr[j + 1]):
        dense[A.indices[p], j] = dense[j, A.indices[p]] = A.data[p]
F, b = sl.Factor(A), np.cos(k)
x = F.solve(b)
assert np.allclose(dense @ x, b) and np.array_equal(F.local(k, b, [3]), x[[3]])
assert np.allclose(F.diagonal(), np.linalg.inv(dense).diagonal())
assert np.allclose(F.constraints([3]).solve(None, [1.0])[3], 1)
L, D, perm = F.factors()
assert L.shape == D.shape == (n, n)
from sparse_local import gradients
by_b, by_a = gradients.solve_gradient(F, A, x, np.ones(n))
assert by_a.shape == A.data.shape
assert np.allclose(sl.Sum([A]).factor([2.0]).solve(b) * 2, x)
F.refactor(A)
assert sl.Factor.from_bytes(F.to_bytes()).n == n
assert not any(name.startswith("scipy") for name in sys.modules)
print("done")
"""


def test_numpy_is_enough():
    out = subprocess.run([sys.executable, "-c", ALONE], capture_output=True, text=True)
    assert out.stdout == "done\n", out.stderr


def metadata(name):
    with open(os.path.join(INFO[0], name)) as file:
        return file.read()


@pytest.mark.skipif(not INFO, reason="the package is not installed from a wheel")
def test_the_wheel_is_of_this_platform_and_of_any_python():
    lines = metadata("WHEEL").splitlines()
    assert "Root-Is-Purelib: false" in lines
    tags = [line.split(": ")[1] for line in lines if line.startswith("Tag")]
    assert len(tags) == 1 and tags[0].startswith("py3-none-") and not tags[0].endswith("-any")
    needed = [line for line in metadata("METADATA").splitlines()
              if line.startswith("Requires-Dist") and "extra ==" not in line]
    assert needed == ["Requires-Dist: numpy"]


@pytest.mark.skipif(not INFO or "SPARSE_LOCAL_LIBRARY" in os.environ,
                    reason="not installed from a wheel, or another library is chosen")
def test_the_library_is_inside():
    assert os.path.dirname(sl.library_path()) == PACKAGE
    name = "sparse_local/" + os.path.basename(sl.library_path())
    assert any(line.startswith(name + ",sha256=") for line in metadata("RECORD").splitlines())
    assert "sparse_local/sksparse/cholmod.py" in metadata("RECORD")
