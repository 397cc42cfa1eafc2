"""The programs of README.md run as they are written, and its names exist."""
import os
import re

import numpy as np
import pytest

import sparse_local
from systems import grid, right_hand_sides

README = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "README.md")
with open(README) as file:
    TEXT = file.read()
BLOCKS = re.findall(r"```python\n(.*?)```", TEXT, re.S)


@pytest.mark.parametrize("k", range(len(BLOCKS)))
def test_programs(k, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    A = grid(20)
    names = {"sparse_local": sparse_local, "F": sparse_local.Factor(A), "A": A, "A2": 2 * A,
             "A3": 3 * A, "A4": 3 * A, "b": right_hand_sides(400)}
    if "torch" in BLOCKS[k]:
        torch = pytest.importorskip("torch", reason="torch is not installed")
        names.update(b=torch.tensor(names["b"]), wanted=torch.zeros(400, dtype=torch.float64))
    exec(BLOCKS[k], names)
    if "values" in names:
        assert np.isfinite(names["values"].grad.numpy()).all()


def test_names():
    """Every call of a factor, of its objects and of the package that README names."""
    of = {"F": sparse_local.Factor, "P": sparse_local.Constraints, "S": sparse_local.Sum,
          "Factor": sparse_local.Factor, "plan": sparse_local.Plan}
    found = re.findall(r"\b(F|P|S|Factor|plan)\.([a-z]\w+)", TEXT)
    assert len(found) > 30
    for owner, name in found:
        assert hasattr(of[owner], name) or hasattr(sparse_local.Plan, name), (owner, name)
    for name in re.findall(r"`(\w+)\(", TEXT):
        assert hasattr(sparse_local, name) or name == "splu", name
