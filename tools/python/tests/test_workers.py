"""examples/workers.py: equal answers by all engines, workers that are killed, files of others."""
import glob
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import scipy.sparse

import sparse_local as sl

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples")
sys.path.insert(0, FOLDER)
import raster  # noqa: E402
import workers  # noqa: E402

PROGRAM = os.path.join(FOLDER, "workers.py")
PAIRS = ["--size", "200", "--pairs", "40000"]
MPI = ["-m", "mpi4py.futures"]
needs_maps = pytest.mark.skipif(not os.path.exists("/proc/self/smaps"),
                                reason="this system does not say what processes map")


@pytest.fixture(scope="module")
def mpi():
    """The command of two workers and the rank that hands out."""
    pytest.importorskip("mpi4py", reason="apt-get install python3-mpi4py")
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                      OMPI_MCA_rmaps_base_oversubscribe="1")
    for name in ("mpiexec.openmpi", "mpiexec"):
        try:
            subprocess.run([name, "--version"], capture_output=True, check=True)
            return [name, "-n", "3"]
        except OSError:
            pass
    pytest.skip("no mpiexec: apt-get install openmpi-bin")


def start(engine, folder, *arguments, mpi=()):
    """The program, as it begins."""
    if engine == "dask":
        pytest.importorskip("distributed", reason="apt-get install python3-distributed")
    command = [*mpi, sys.executable, "-B", *(MPI if mpi else []), PROGRAM, str(folder),
               "--engine", engine, *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def finish(program):
    """(status, output, errors)"""
    out, errors = program.communicate(timeout=300)
    return program.returncode, out, errors


def run(engine, folder, *arguments, mpi=()):
    status, out, errors = finish(start(engine, folder, *arguments, mpi=mpi))
    assert status == 0, errors[-2000:]
    return out, np.load(folder / "resistances.npy")


def answers(folder):
    return glob.glob(str(folder / "answers-*" / "*.npy"))


def kill_a_worker(program, folder):
    """Kills the last of the workers that began, in the middle of the job; how many answers there
    were."""
    end = time.time() + 120
    while time.time() < end and program.poll() is None:
        found = raster.mapping(program.pid, str(folder / "factor.slf"))
        if len(answers(folder)) >= 5 and len(found) >= 2:
            os.kill(found[-1], signal.SIGKILL)
            return len(answers(folder))
        time.sleep(0.01)
    pytest.fail("no worker to kill: %s" % (finish(program),))


def test_resistances(tmp_path):
    """Against those of the pseudo-inverse of the Laplacian, without the ground."""
    cells = workers.conductances(12)
    A = workers.network(cells)
    A = scipy.sparse.csc_matrix((A.data, A.indices, A.indptr), A.shape).toarray()
    A = A + np.tril(A, -1).T
    A[0, 0] -= cells.flat[0]
    assert abs(A.sum(axis=1)).max() < 1e-12
    inverse = np.linalg.pinv(A)
    d = np.diag(inverse)
    wanted = d[:, None] + d - 2 * inverse
    F = workers.mapped_factor(str(tmp_path), 12)
    out, R = run("serial", tmp_path, "--size", "12", "--points", "140")
    job = workers.AllPairs(F, 140)
    assert len(job.tasks) == 2 and "%d pairs" % (140 * 139 // 2) in out
    assert np.allclose(R, wanted[np.ix_(job.points, job.points)], rtol=1e-9, atol=1e-12)
    R = run("serial", tmp_path, "--size", "12", "--pairs", "1100")[1]
    job = workers.RandomPairs(F, 1100)
    assert len(job.tasks) == 4
    assert np.allclose(R, wanted[job.rows, job.columns], rtol=1e-9, atol=1e-12)
    for none in (["--points", "0"], ["--points", "1"], ["--pairs", "0"]):
        assert run("serial", tmp_path, "--size", "12", *none)[1].size <= 1


@pytest.fixture(scope="module")
def serial(tmp_path_factory):
    return run("serial", tmp_path_factory.mktemp("serial"), *PAIRS)[1]


@needs_maps
def test_a_killed_worker_of_dask(tmp_path, serial):
    program = start("dask", tmp_path, *PAIRS)
    assert kill_a_worker(program, tmp_path) < 81
    status, out, errors = finish(program)
    assert status == 0, errors[-2000:]
    assert np.array_equal(np.load(tmp_path / "resistances.npy"), serial)


@needs_maps
@pytest.mark.parametrize("engine", ["processes", "mpi"])
def test_a_killed_worker_of_others(engine, tmp_path, serial, request):
    mpi = request.getfixturevalue("mpi") if engine == "mpi" else ()
    program = start(engine, tmp_path, *PAIRS, mpi=mpi)
    assert kill_a_worker(program, tmp_path) < 81
    status, out, errors = finish(program)
    assert status != 0 and not os.path.exists(tmp_path / "resistances.npy")
    if engine == "processes":
        assert errors == "workers.py: a worker died; the same command computes what is missing\n"
    there = len(answers(tmp_path))
    assert there >= 5
    out, R = run(engine, tmp_path, *PAIRS, mpi=mpi)
    assert "%d of them are missing" % (81 - there) in out
    assert np.array_equal(R, serial)


@needs_maps
def test_one_copy_in_memory(tmp_path):
    """What three processes have of the file is in memory once."""
    out = run("processes", tmp_path, *PAIRS)[0]
    words = out.replace(":", "").split()
    shares, processes = (float(words[words.index(w) + k]) for w, k in (("once", 1), ("for", 1)))
    size = os.path.getsize(tmp_path / "factor.slf") / 1e6
    assert processes == 3 and 0 < shares <= 1.01 * size


def test_other_files_are_refused(tmp_path):
    small = ["--size", "20", "--points", "10"]
    first = run("serial", tmp_path, *small)[1]
    status, out, errors = finish(start("serial", tmp_path, "--size", "21"))
    assert status == 1 and "has 400 rows, the raster 441 cells" in errors
    # another factor of that size: nothing is taken from the answers of the first one
    sl.Factor(workers.network(2.0 * workers.conductances(20))).save(tmp_path / "factor.slf")
    out, second = run("serial", tmp_path, *small)
    assert "1 of them are missing" in out
    assert np.allclose(second * 2, first, rtol=1e-9)
    (tmp_path / "factor.slf").write_bytes(b"short")
    status, out, errors = finish(start("serial", tmp_path, *small))
    assert status == 1 and "not a saved factor" in errors
