"""Factors, plans and regions in other processes: pickles, joblib, multiprocessing, Dask."""
import multiprocessing
import os
import pickle
import subprocess
import sys

import numpy as np
import pytest

import sparse_local as sl
from sparse_local import _shared
from systems import grid
from test_sksparse import complex_grid


@pytest.fixture
def path(tmp_path):
    name = tmp_path / "grid.slf"
    sl.Factor(grid(30)).save(name)
    return name


def test_a_mapped_factor_is_its_path(path):
    F = sl.Factor.load(path, map=True)
    for protocol in range(2, 6):
        text = pickle.dumps(F, protocol)
        assert len(text) < 1000 and pickle.loads(text) is F  # open already
    for query in (F.solve, F.diagonal, F.plan([1], [2]).solve,
                  F.plan([1], [2], region=F.region([1, 2]))):
        assert len(pickle.dumps(query)) < 1000
    # a process that has not opened it opens it once
    key = F._source.key()
    x, text = F.solve(np.ones(900)), pickle.dumps(F)
    del F, query
    _shared._kept.clear()
    assert key not in _shared._open
    G = pickle.loads(text)
    assert np.array_equal(G.solve(np.ones(900)), x) and pickle.loads(text) is G
    del G
    assert key in _shared._open  # kept for those that come again
    G = pickle.loads(text)
    G.close()
    assert key not in _shared._kept
    assert np.array_equal(pickle.loads(text).solve(np.ones(900)), x)
    with pytest.raises(sl.StateError):
        pickle.dumps(G)


def test_another_file_is_refused(path):
    F = sl.Factor.load(path, map=True)
    text = pickle.dumps(F)
    sl.Factor(grid(30, 0.2)).save(path)  # the old file stays mapped
    assert pickle.loads(text) is F
    new = sl.Factor.load(path, map=True)
    assert pickle.dumps(new) != text and pickle.loads(pickle.dumps(new)) is new
    del F
    _shared._kept.clear()
    with pytest.raises(sl.StateError, match="has changed"):
        pickle.loads(text)
    os.remove(path)
    with pytest.raises(sl.Error, match="No such file"):
        pickle.loads(text)
    path.write_bytes(b"short")
    with pytest.raises(sl.Error, match="not a saved factor"):
        pickle.loads(text)


def test_a_process_keeps_some_files_only(tmp_path):
    texts = []
    for k in range(_shared._KEPT + 3):
        name = tmp_path / ("%d.slf" % k)
        sl.Factor(grid(3, 0.1 + k)).save(name)
        texts.append(pickle.dumps(sl.Factor.load(name, map=True)))
    for text in texts:
        pickle.loads(text)
    assert len(_shared._kept) == _shared._KEPT
    _shared._kept.clear()


@pytest.mark.parametrize("A", [grid(6), complex_grid(6)], ids=["real", "complex"])
def test_plans_and_regions(A, tmp_path):
    F = sl.Factor(A)
    R = F.region([0, 1, 6, 7])
    plans = [F.plan([3, 1], [5]), F.plan(None, [5]), F.plan([1], None),
             F.plan([0], [7], region=R)]
    for P in plans:
        Q = pickle.loads(pickle.dumps(P))
        b = np.arange(1.0, P.nb + 1)
        assert np.array_equal(Q.solve(b), P.solve(b)) and (Q.nb, Q.nx) == (P.nb, P.nx)
    assert pickle.loads(pickle.dumps(R)).stats["rows"] == R.stats["rows"]
    name = tmp_path / "set.slf"
    sl.save_set(name, F, regions=[R])
    loaded = sl.load_set(name, map=True, is_complex=np.iscomplexobj(A))
    assert pickle.loads(pickle.dumps(loaded.factor)) is loaded.factor
    with pytest.raises(TypeError, match="Region"):
        pickle.dumps(loaded.regions[0])


@pytest.mark.parametrize("A", [grid(6), complex_grid(6)], ids=["real", "complex"])
def test_buffers(A):
    F, buffers = sl.Factor(A), []
    b = np.ones(36)
    text = pickle.dumps(F, 5, buffer_callback=buffers.append)
    assert len(text) < 500 and len(buffers) == 1
    assert np.array_equal(pickle.loads(text, buffers=buffers).solve(b), F.solve(b))
    for protocol in range(2, 6):
        G = pickle.loads(pickle.dumps(F, protocol))
        assert np.array_equal(G.solve(b), F.solve(b))
        assert np.array_equal(G.refactor(A).solve(b), F.solve(b))


def test_multiprocessing(path):
    F = sl.Factor.load(path, map=True)
    P = F.plan([5], [7, 800])
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        assert np.array_equal(pool.map(P.solve, [[1.0], [2.0]])[1], 2 * P.solve([1.0]))
        assert np.array_equal(np.ravel(pool.map(F.diagonal, [[3], [4]])), F.diagonal([3, 4]))


def test_joblib(path):
    joblib = pytest.importorskip("joblib", reason="apt-get install python3-joblib")
    for F in (sl.Factor.load(path, map=True), sl.Factor(grid(30))):
        P = F.plan([5], [7])
        out = joblib.Parallel(n_jobs=2)(joblib.delayed(P.solve)([1.0 * k]) for k in range(4))
        assert np.array_equal(np.ravel(out), [P.solve([1.0 * k])[0] for k in range(4)])


def test_dask(path):
    """In a process of its own, since Dask starts threads and servers."""
    pytest.importorskip("distributed", reason="apt-get install python3-distributed")
    code = """
import os, sys, numpy as np, sparse_local as sl
from distributed import Client
from systems import grid
if __name__ == "__main__":
    F = sl.Factor.load(sys.argv[1], map=True)
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        rows = [[k] for k in range(8)]
        got = client.gather(client.map(F.diagonal, rows, pure=False))
        assert np.array_equal(np.ravel(got), F.diagonal(range(8)))
        P = F.plan([5], [7])
        got = client.gather(client.map(P.solve, [[1.0], [3.0]], pure=False))
        assert np.array_equal(got, [P.solve([1.0]), P.solve([3.0])])
        new = sys.argv[1] + ".new"
        F.save(new)
        G = sl.Factor.load(new, map=True)  # which no worker has opened
        sl.Factor.load(sys.argv[1]).refactor(2.0 * grid(30)).save(new)
        error = client.submit(G.diagonal, [0], pure=False, retries=0).exception()
        assert isinstance(error, sl.StateError) and "has changed" in str(error), error
        os.remove(new)
        error = client.submit(G.diagonal, [1], pure=False, retries=0).exception()
        assert isinstance(error, sl.Error) and "No such file" in str(error), error
    print("done")
"""
    script = path.parent / "script.py"
    script.write_text(code)
    here = os.path.dirname(os.path.abspath(__file__))
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(sys.path + [here]))
    out = subprocess.run([sys.executable, "-W", "ignore", str(script), str(path)], text=True,
                         capture_output=True, timeout=120, env=environment)
    assert out.stdout == "done\n", out.stderr[-2000:]
