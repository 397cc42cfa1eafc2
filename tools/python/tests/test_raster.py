"""examples/raster.py: known answers, a limit on the memory, and every step killed once."""
import json
import os
import subprocess
import sys

import numpy as np
import pytest

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples")
sys.path.insert(0, FOLDER)
import raster  # noqa: E402

pytestmark = pytest.mark.skipif(not os.path.exists("/proc/self/smaps"), reason="of Linux")


def run(folder, *arguments):
    command = [sys.executable, "-B", os.path.join(FOLDER, "raster.py"), str(folder), *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=300)


def results(folder, *arguments):
    """(resistances, currents, records of the steps)"""
    ended = run(folder, *arguments)
    assert ended.returncode == 0, ended.stderr[-2000:]
    records = json.loads((folder / "steps.json").read_text())
    return np.load(folder / "resistances.npy"), np.load(folder / "current.npy"), records


def known(cells, points):
    """Resistances and currents by the pseudo-inverse of a Laplacian, link by link."""
    rows, columns = cells.shape
    L, links = np.zeros((cells.size, cells.size)), []
    for i in range(rows):
        for j in range(columns):
            for k, m in ((i, j + 1), (i + 1, j)):
                if k < rows and m < columns:
                    links.append((i * columns + j, k * columns + m,
                                  (cells[i, j] + cells[k, m]) / 2))
    for a, b, g in links:
        L[[a, b], [a, b]] += g
        L[[a, b], [b, a]] -= g
    inverse = np.linalg.pinv(L)
    d = np.diag(inverse)[points]
    b = np.zeros(cells.size)
    b[points] = -1.0 / (points.size - 1)
    b[points[0]] = 1.0
    x, through = inverse @ b, 0.5 * np.abs(b)
    for a, c, g in links:
        through[[a, c]] += 0.5 * abs(g * (x[a] - x[c]))
    return d[:, None] + d - 2.0 * inverse[np.ix_(points, points)], through.reshape(cells.shape)


def test_known_answers(tmp_path):
    cells = np.random.default_rng(7).lognormal(0.0, 1.0, (14, 14))
    np.save(tmp_path / "cells.npy", cells)
    arguments = ["--raster", str(tmp_path / "cells.npy"), "--points", "25"]
    R, through, records = results(tmp_path, *arguments)
    F = raster.sparse_local.Factor.load(str(tmp_path / "factor.slf"), map=True)
    wanted = known(cells, raster.workers.AllPairs(F, 25).points)
    assert np.allclose(R, wanted[0], rtol=1e-9, atol=1e-12)
    assert np.allclose(through, wanted[1], rtol=1e-9)
    assert records["processes"]["pairs"] == 300
    table = (tmp_path / "raster.csv").read_text().split("\n")
    steps = [line.split(",")[0] for line in table[1:-1]]
    assert steps == ["analysis", "factor", "processes", "map"]
    # what is there stays; another job and wrong answers are refused
    assert run(tmp_path, *arguments).stdout.count(": is there\n") == 4
    refused = run(tmp_path, *arguments[:-1], "26")
    assert refused.returncode == 1 and "the steps of another job" in refused.stderr
    R[0, -1] *= 1.0 + 1e-7
    np.save(tmp_path / "resistances.npy", R)
    (tmp_path / "map.json").unlink()
    refused = run(tmp_path, *arguments)
    assert refused.returncode == 1 and "resistances differ from those of solves" in refused.stderr
    np.save(tmp_path / "flat.npy", cells[1:])
    (tmp_path / "other").mkdir()
    refused = run(tmp_path / "other", "--raster", str(tmp_path / "flat.npy"))
    assert refused.returncode == 1 and "not a square of positive conductances" in refused.stderr


LIMITED = """
import mmap, os, sys, time
sys.path.insert(0, sys.argv[2])
import raster

def peak():  # of this program; ru_maxrss begins with that of the one before exec
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) * 1024

chunk = 4 << 20
with open(os.path.join(sys.argv[1], "file"), "w+b") as file:
    file.truncate(100 * chunk)
    block = mmap.mmap(file.fileno(), 100 * chunk)
    before = peak()
    most = before + 50 * chunk
    with raster.MemoryLimit(sys.argv[1], most):
        for k in range(100):
            block[k * chunk:(k + 1) * chunk] = bytes([k]) * chunk
            time.sleep(0.06)
    assert before + 30 * chunk < peak() < most, (before, most, peak())
    assert all(block[k * chunk] == block[(k + 1) * chunk - 1] == k for k in range(100))
    try:
        bytearray(most + raster.LIBRARIES)
    except MemoryError:
        print("refused")
"""


def test_records_are_complete(tmp_path):
    folder = tmp_path / "folder"
    folder.mkdir()
    np.save(tmp_path / "cells.npy", np.ones((6, 6)))
    arguments = ["--raster", str(tmp_path / "cells.npy"), "--points", "5"]
    results(folder, *arguments)
    before = (folder / "steps.json").read_text()
    with pytest.raises(TypeError):  # json.dump has written a part by then
        raster.write_json(str(folder / "steps.json"), [1, object()])
    assert (folder / "steps.json").read_text() == before
    os.link(folder / "steps.json", tmp_path / "old")  # no step writes into the file that is there
    (folder / "map.json").unlink()
    results(folder, *arguments)
    assert (tmp_path / "old").read_text() == before


def test_the_limit(tmp_path):
    """Pages of a file leave the memory and keep what they have; other memory is refused."""
    out = subprocess.run([sys.executable, "-B", "-c", LIMITED, str(tmp_path), FOLDER],
                         capture_output=True, text=True)
    assert out.stdout == "refused\n", out.stderr


def test_killed_and_in_little_memory(tmp_path):
    """The same bits as without a limit, and undisturbed."""
    size = ["--size", "1000", "--points", "1200"]
    R, through, records = results(tmp_path / "plain", *size, "--memory", "0")
    # less than the process of the factor takes, and the map
    assert min(records[step]["peak"] for step in ("factor", "map")) > 0.55 * (1 << 30)
    killed = results(tmp_path / "killed", *size, "--memory", "0.45", "--kill")
    assert np.array_equal(R, killed[0]) and np.array_equal(through, killed[1])
    assert killed[2]["killed factor"]["bytes"] == 0
    assert 2 <= killed[2]["processes"]["answers_when_killed"] < 10
    assert killed[2]["processes"]["repeated"]
    with open(tmp_path / "killed" / "checks.json") as file:
        assert all(check.get("difference", 0.0) < 1e-10 for check in json.load(file))
