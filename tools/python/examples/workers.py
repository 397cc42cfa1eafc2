"""workers.py: effective resistances of a raster, by workers that share one factor

    python3 workers.py FOLDER [--size 100] [--points 400 | --pairs 5000] [--workers 2]
    python3 workers.py FOLDER --engine dask [--scheduler ADDRESS]
    mpiexec -n 3 python3 -m mpi4py.futures workers.py FOLDER --engine mpi

The raster has size x size cells with random conductances. Wanted are the resistances between all
pairs of some focal cells, or between random pairs of cells: FOLDER/resistances.npy.

The factor is a file in FOLDER that every worker maps. A task is a call such as F.pairs(rows,
columns): less than 1 kB and the rows. Answers are kept in FOLDER as they come. If a worker dies,
Dask repeats what it had begun (a cluster of your own needs --memory-limit 0, since Dask counts
pages of the file as memory of each worker). With other engines the program ends, and the same
command computes what is missing. Workers on other machines need to see FOLDER under the same path.
Under MPI one rank hands out the tasks.
"""
import argparse
import concurrent.futures
import contextlib
import glob
import hashlib
import multiprocessing
import os
import pickle
import sys
import time

import numpy as np

import sparse_local

ROWS = 128  # focal cells of a task
PAIRS = 500  # random pairs of a task


def conductances(size):
    """The raster. Put your own here."""
    return np.random.default_rng(1).lognormal(0.0, 1.0, (size, size))


def links(cells):
    """The conductances between each cell and the next one of its row, and the one below it."""
    right, below = np.zeros(cells.shape), np.zeros(cells.shape)
    right[:, :-1] = 0.5 * (cells[:, :-1] + cells[:, 1:])
    below[:-1] = 0.5 * (cells[:-1] + cells[1:])
    return right, below


def network(cells):
    """The Laplacian of the network that joins each cell with its four neighbors: its lower triangle
    in compressed columns.

    Cell 0 is joined with the ground, so that the matrix is regular. That changes no resistance: all
    the current that goes in at one cell comes out at the other.
    """
    rows, columns = cells.shape
    entries = np.empty((rows, columns, 3))  # of the column of a cell: its own, right, below
    entries[..., 1], entries[..., 2] = links(-cells)
    entries[..., 0] = -entries[..., 1] - entries[..., 2]
    entries[:, 1:, 0] -= entries[:, :-1, 1]
    entries[1:, :, 0] -= entries[:-1, :, 2]
    entries[0, 0, 0] += cells[0, 0]
    is_there = np.ones(entries.shape, dtype=bool)
    is_there[:, -1, 1] = is_there[-1, :, 2] = False
    entries = entries[is_there]
    cell = np.arange(cells.size, dtype=np.int32).reshape(rows, columns, 1)
    neighbors = (cell + np.array([0, 1, columns], dtype=np.int32))[is_there]
    begins = np.zeros(cells.size + 1, dtype=np.int32)
    np.cumsum(is_there.sum(axis=2, dtype=np.int32), dtype=np.int32, out=begins[1:])
    return sparse_local.CscArrays((cells.size, cells.size), begins, neighbors, entries)


def mapped_factor(folder, size):
    """The factor of the raster, from the file in the folder; that is written first if need be."""
    path = os.path.join(folder, "factor.slf")
    if not os.path.exists(path):
        sparse_local.Factor(network(conductances(size))).save(path)
    F = sparse_local.Factor.load(path, map=True)
    if F.n != size * size:
        sys.exit("workers.py: %s has %d rows, the raster %d cells" % (path, F.n, size * size))
    return F


def elimination_order(F, cells):
    """The places of cells in the order of elimination: neighbors there share much of their work."""
    place = np.empty(F.n, dtype=np.int32)
    place[F.perm] = np.arange(F.n, dtype=np.int32)
    return np.argsort(place[cells], kind="stable")


# ---- the tasks: calls and their arguments ----

class AllPairs:
    """All pairs of focal cells: the upper part of a block of the inverse, in strips."""

    def __init__(self, F, count):
        points = np.random.default_rng(2).choice(F.n, min(count, F.n), replace=False)
        self.points = points[elimination_order(F, points)]
        self.count = self.points.size * (self.points.size - 1) // 2
        self.tasks = [(F.block, self.points[k:k + ROWS], self.points[k:])
                      for k in range(0, self.points.size, ROWS)]

    def resistances(self, strips):
        """(rows, columns, R): R[i, j] is that between rows[i] and columns[j]."""
        inverse = np.empty((self.points.size, self.points.size))
        for k, strip in zip(range(0, self.points.size, ROWS), strips):
            inverse[k:k + ROWS, k:] = strip
            inverse[k:, k:k + ROWS] = strip.T
        d = np.diag(inverse)
        return self.points[:, None], self.points, d[:, None] + d - 2.0 * inverse


class RandomPairs:
    """Random pairs of cells: entries of the inverse, and those of its diagonal that they need."""

    def __init__(self, F, count):
        pairs = np.random.default_rng(3).integers(0, F.n, (2, count))
        self.rows, self.columns = pairs[:, elimination_order(F, pairs[0])]
        self.count = count
        self.cells, place = np.unique([self.rows, self.columns], return_inverse=True)
        self.ends = place.reshape(2, count)
        self.tasks = [(F.diagonal, self.cells)]
        self.tasks += [(F.pairs, self.rows[k:k + PAIRS], self.columns[k:k + PAIRS])
                       for k in range(0, count, PAIRS)]

    def resistances(self, answers):
        """(rows, columns, R): R[k] is that between rows[k] and columns[k]."""
        d = answers[0][self.ends]
        return self.rows, self.columns, d[0] + d[1] - 2.0 * np.concatenate(answers[1:] + [[]])


# ---- the engines: an executor each, or the client of Dask ----

@contextlib.contextmanager
def executor(engine, workers, scheduler):
    """What has submit; None: this process does all."""
    if engine == "processes":
        spawn = multiprocessing.get_context("spawn")
        with concurrent.futures.ProcessPoolExecutor(workers, spawn) as pool:
            yield pool
    elif engine == "mpi":
        from mpi4py.futures import MPIPoolExecutor
        with MPIPoolExecutor() as pool:
            yield pool
    elif engine == "dask":
        from distributed import Client
        # without a limit, since pages of a mapped file count as memory of the worker
        cluster = dict(address=scheduler) if scheduler else dict(
            n_workers=workers, threads_per_worker=1, dashboard_address=None, memory_limit=0)
        with Client(**cluster) as client:
            yield client
    else:
        yield None


def answers_of(pool, tasks):
    """(k, answer) of the tasks {k: (call, arguments)}, in any order."""
    if pool is None:
        for k, (call, *arguments) in tasks.items():
            yield k, call(*arguments)
        return
    if not isinstance(pool, concurrent.futures.Executor):
        yield from answers_of_dask(pool, tasks)
        return
    waiting = {pool.submit(*task): k for k, task in tasks.items()}
    for future in concurrent.futures.as_completed(list(waiting)):
        try:
            yield waiting.pop(future), future.result()
        except concurrent.futures.BrokenExecutor:
            sys.exit("workers.py: a worker died; the same command computes what is missing")


def answers_of_dask(client, tasks):
    """The same. The client's executor fails if a worker dies while its answer is fetched; this
    asks again."""
    from distributed import as_completed
    waiting = {client.submit(*task, pure=False): k for k, task in tasks.items()}
    for future, answer in as_completed(list(waiting), with_results=True):
        yield waiting.pop(future), answer


# ---- answers on the disk ----

class Answers:
    """One file an answer, in a folder that belongs to one factor and one list of questions."""

    def __init__(self, folder, F, tasks):
        job = hashlib.sha256(pickle.dumps([F] + [task[1:] for task in tasks], 4)).hexdigest()[:16]
        self.folder, self.count = os.path.join(folder, "answers-" + job), len(tasks)
        os.makedirs(self.folder, exist_ok=True)

    def path(self, k):
        return os.path.join(self.folder, "%07d.npy" % k)

    def missing(self):
        return [k for k in range(self.count) if not os.path.exists(self.path(k))]

    def keep(self, k, answer):
        """The file gets its name when it is complete."""
        with open(self.path(k) + ".part", "wb") as file:
            np.save(file, answer)
        os.replace(self.path(k) + ".part", self.path(k))

    def all(self):
        return [np.load(self.path(k)) for k in range(self.count)]


def sharing(path):
    """What the processes of this machine that map a file have of it in memory: the sum of their
    shares (PSS), the largest amount that one has read (RSS), and how many they are; on Linux."""
    found = []
    for name in glob.glob("/proc/[0-9]*/smaps"):
        with contextlib.suppress(OSError):
            with open(name) as file:
                maps, is_ours = {"Pss:": 0, "Rss:": 0}, False
                for line in file:
                    words = line.split()
                    if "-" in words[0] and not words[0].endswith(":"):
                        is_ours = line.rstrip("\n").endswith(path)
                    elif is_ours and words[0] in maps:
                        maps[words[0]] += int(words[1]) * 1024
            if maps["Rss:"]:
                found.append((maps["Pss:"], maps["Rss:"]))
    return sum(f[0] for f in found), max((f[1] for f in found), default=0), len(found)


def check(F, rows, columns, R):
    """Compares a few resistances with solves."""
    rows, columns = (np.broadcast_to(ends, R.shape).ravel() for ends in (rows, columns))
    for k in np.linspace(0, R.size - 1, 8).astype(int) if R.size else ():
        if rows[k] == columns[k]:
            continue
        ends = [rows[k], columns[k]]
        x = F.local(ends, [1.0, -1.0], ends)
        if not abs(x[0] - x[1] - R.flat[k]) <= 1e-8 * R.flat[k]:
            sys.exit("workers.py: between cells %d and %d: %g, by a solve %g" %
                     (*ends, R.flat[k], x[0] - x[1]))


def main():
    parser = argparse.ArgumentParser(description="effective resistances of a raster by workers "
                                                 "that share one factor")
    parser.add_argument("folder", help="of the factor and the answers")
    parser.add_argument("--size", type=int, default=100, help="rows and columns of the raster")
    parser.add_argument("--points", type=int, default=400, help="focal cells: all of their pairs")
    parser.add_argument("--pairs", type=int, help="random pairs, in place of focal cells")
    parser.add_argument("--engine", choices=["serial", "processes", "dask", "mpi"],
                        default="processes")
    parser.add_argument("--workers", type=int, default=2, help="processes; mpiexec has its own -n")
    parser.add_argument("--scheduler", help="address of a running scheduler of Dask")
    options = parser.parse_args()
    folder = os.path.abspath(options.folder)
    os.makedirs(folder, exist_ok=True)
    F = mapped_factor(folder, options.size)
    job = AllPairs(F, options.points) if options.pairs is None else RandomPairs(F, options.pairs)
    answers = Answers(folder, F, job.tasks)
    missing = answers.missing()
    print("%d pairs in %d tasks, %d of them are missing" %
          (job.count, len(job.tasks), len(missing)), flush=True)
    with executor(options.engine, options.workers, options.scheduler) as pool:
        begin = time.perf_counter()
        for k, answer in answers_of(pool, {k: job.tasks[k] for k in missing}):
            answers.keep(k, answer)
        seconds = time.perf_counter() - begin
        share, largest, processes = sharing(os.path.join(folder, "factor.slf"))
    rows, columns, R = job.resistances(answers.all())
    check(F, rows, columns, R)
    np.save(os.path.join(folder, "resistances.npy"), R)
    print("%s: %.2f s; the factor is in memory once: %.1f MB for %d processes, of which one has "
          "read %.1f MB" % (options.engine, seconds, share / 1e6, processes, largest / 1e6))


if __name__ == "__main__":
    main()
