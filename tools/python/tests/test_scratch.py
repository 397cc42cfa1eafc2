"""scratch: large arrays in files of a folder; analyses in files."""
import os
import subprocess
import sys

import numpy as np
import pytest

import sparse_local as sl
from sparse_local import _scratch

from systems import grid

FULL_DISK = """
import resource, sys
import numpy as np
import sparse_local as sl
sys.path.insert(0, sys.argv[2])
from systems import grid
A = grid(420)
resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 24, 1 << 24))
try:
    sl.Factor(A, scratch=sys.argv[1])
except sl.OutOfMemoryError:
    print("refused")
"""


@pytest.mark.parametrize("threads", [None, 2])
def test_the_same_factor(tmp_path, threads):
    A = grid(420)
    S = sl.Analysis(A, scratch=tmp_path, threads=threads)
    with S.factor(A, scratch=str(tmp_path), threads=threads) as F:
        assert len(_scratch._blocks) >= 1 and not os.listdir(tmp_path)
        plain = sl.Factor(A, threads=threads)
        b = np.random.default_rng(1).normal(size=F.n)
        assert np.array_equal(F.solve(b), plain.solve(b))
        F.refactor(2.0 * A)
        assert np.array_equal(F.solve(2.0 * b), plain.solve(b))
        F.save(tmp_path / "scratch.slf")
    plain.refactor(2.0 * A).save(tmp_path / "plain.slf")
    assert (tmp_path / "scratch.slf").read_bytes() == (tmp_path / "plain.slf").read_bytes()
    del S, F
    assert not _scratch._blocks


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_child_does_not_change_its_parent(tmp_path):
    A = grid(420)
    with sl.Factor(A, scratch=tmp_path) as F:
        assert _scratch._blocks
        b = np.random.default_rng(1).normal(size=F.n)
        x = F.solve(b)
        child = os.fork()
        if child == 0:
            is_right = False
            try:
                is_right = np.array_equal(F.refactor(2.0 * A).solve(2.0 * b), x)
                F.close()
            finally:
                os._exit(0 if is_right else 1)
        assert os.waitpid(child, 0)[1] == 0
        assert np.array_equal(F.solve(b), x)


def test_refusals(tmp_path):
    for folder in (tmp_path / "none", __file__):
        with pytest.raises(sl.ArgumentError, match="scratch is a folder"):
            sl.Factor(grid(5), scratch=folder)
    command = [sys.executable, "-B", "-c", FULL_DISK, tmp_path, os.path.dirname(__file__)]
    out = subprocess.run(command, capture_output=True, text=True)
    assert out.stdout == "refused\n", out.stderr


@pytest.mark.parametrize("map", [False, True])
def test_an_analysis_in_a_file(tmp_path, map):
    A, path = grid(30), tmp_path / "analysis.slf"
    S = sl.Analysis(A, triangle="lower", purpose="one factor")
    S.save(path)
    T = sl.Analysis.load(path, map=map, triangle="lower")
    assert np.array_equal(S.perm, T.perm) and T.stats["nnz_l"] == S.stats["nnz_l"]
    b = np.arange(900.0)
    assert np.array_equal(S.factor(A).solve(b), T.factor(A).solve(b))
    with pytest.raises(sl.PatternError):
        T.factor(grid(29))
    for load in (sl.Factor.load, sl.load_set):
        with pytest.raises(sl.ArgumentError, match="the file has no factor"):
            load(path, map=map)
    T.factor(A).save(path)  # while it is mapped
    assert sl.Analysis.load(path, checks="verified", triangle="lower").n == 900
    with pytest.raises(sl.IoError):
        sl.Analysis.load(tmp_path / "none.slf")
    H = grid(6).astype(complex)
    S = sl.Analysis(H)
    S.save(path)
    T = sl.Analysis.load(path, map=map, is_complex=True)
    assert T.n == 36 and np.array_equal(T.factor(H).solve(b[:36]), S.factor(H).solve(b[:36]))
