"""raster.py: pair resistances and a map of currents of a large raster, in a limited memory

    python3 raster.py FOLDER [--size 300 | --raster CELLS.npy] [--points 60] [--memory 20]
                             [--engines dask mpi] [--kill]

The raster has the conductance of each cell. Wanted are the resistances between all pairs of some
focal cells, FOLDER/resistances.npy, and the current through each cell if it enters at one focal
cell and leaves at all others, FOLDER/current.npy and current.png.

The steps are processes: the order and the structure of L (analysis.slf), the factor (factor.slf),
the pairs by each engine of workers.py, and the map. --memory limits each of them but those of the
pairs, which only read the factor. L may be larger: it is in files without a name in FOLDER, whose
pages are written out. A step leaves its result in one piece or not at all, so that the same command
continues with the first one that is missing, and pairs with the first answers that are missing.

With --kill the process of the factor is killed when a third of L is in memory, and a worker of each
engine when it has answered twice: this program then repeats what was lost.

Resistances are compared with solves for all cells, and these with the matrix: FOLDER/raster.csv has
the times and sizes, FOLDER/checks.json what was found.
"""
import argparse
import contextlib
import ctypes
import datetime
import glob
import json
import math
import os
import platform
import resource
import signal
import subprocess
import sys
import threading
import time

import numpy as np

import sparse_local
import workers

GIB = 1 << 30
PAGE = resource.getpagesize()
POLL = 0.02  # seconds
LIBRARIES = 1 << 28  # bytes that OpenBLAS reserves, does not use, and waits for forever
MAP_CELLS = 640  # of a row of the map, at most
MS_SYNC, MADV_PAGEOUT = 4, 21  # of Linux


# ---- the raster and its matrix ----

def landscape(size):
    """A raster for trials: hills of all sizes, where conductance falls with height."""
    rng, height = np.random.default_rng(4), np.zeros((size, size))
    for level in range(2, 9):
        coarse = rng.normal(size=(2 ** level + 1,) * 2)
        fine, knots = np.linspace(0, 2 ** level, size), np.arange(2 ** level + 1)
        rows = np.stack([np.interp(fine, knots, column) for column in coarse.T])
        height += 0.62 ** level * np.stack([np.interp(fine, knots, row) for row in rows.T])
    return np.exp(-3.0 * height / height.std())


def raster_of(options):
    if not options.raster:
        return landscape(options.size)
    cells = np.load(options.raster)
    if cells.ndim != 2 or cells.shape[0] != cells.shape[1] or not (cells > 0.0).all():
        sys.exit("raster.py: %s is not a square of positive conductances" % options.raster)
    return cells


def flows(cells, x):
    """The currents from each cell to the next one of its row, and to the one below it."""
    right, below = workers.links(cells)
    return right[:, :-1] * -np.diff(x, axis=1), below[:-1] * -np.diff(x, axis=0)


def times_matrix(cells, x):
    """A x, by the links of the cells instead of the matrix that was factored."""
    flow, down = flows(cells, x)
    y = np.zeros(x.shape)
    y[0, 0] = cells[0, 0] * x[0, 0]
    y[:, :-1] += flow
    y[:, 1:] -= flow
    y[:-1] += down
    y[1:] -= down
    return y


def current(cells, x):
    """The current through each cell: half of what its links carry."""
    flow, down = (np.abs(part) for part in flows(cells, x))
    through = np.zeros(x.shape)
    through[:, :-1] += flow
    through[:, 1:] += flow
    through[:-1] += down
    through[1:] += down
    return 0.5 * through


def reduced(picture):
    """Means of squares of cells, so that a row has at most MAP_CELLS of them."""
    side = -(-max(picture.shape) // MAP_CELLS)
    rows, columns = (length // side for length in picture.shape)
    squares = picture[:rows * side, :columns * side].reshape(rows, side, columns, side)
    return squares.mean(axis=(1, 3))


# ---- a limit on the memory ----

class MemoryLimit:
    """Keeps this process below a number of bytes.

    Memory without a file behind it is limited by the system, which refuses more. Pages of the files
    in the folder count, too: when there are too many, they are written and given back.
    """

    def __init__(self, folder, most):
        self._folder, self._most, self._end = os.path.realpath(folder) + os.sep, most, None
        if most and hasattr(resource, "RLIMIT_DATA"):
            most += LIBRARIES
            resource.setrlimit(resource.RLIMIT_DATA, (most, most))

    def __enter__(self):
        if self._most and os.path.exists("/proc/self/maps"):
            self._end = threading.Event()
            self._thread = threading.Thread(target=self._watch, daemon=True)
            self._thread.start()
        return self

    def __exit__(self, *reason):
        if self._end is not None:
            self._end.set()
            self._thread.join()

    def _watch(self):
        c, pause = ctypes.CDLL(None), POLL
        while not self._end.wait(pause):
            pause = POLL
            if self._is_near():
                for begin, size in self._files():
                    block = ctypes.c_void_p(begin), ctypes.c_size_t(size)
                    c.msync(*block, MS_SYNC)
                    c.madvise(*block, MADV_PAGEOUT)
                if self._is_near():  # files are not what takes it
                    pause = 50 * POLL

    def _is_near(self):
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * PAGE > 0.85 * self._most

    def _files(self):
        """(begin, bytes) of the mapped files of the folder."""
        with open("/proc/self/maps") as file:
            for line in file.read().split("\n"):
                if self._folder in line:
                    begin, end = (int(at, 16) for at in line.split()[0].split("-"))
                    yield begin, end - begin


# ---- the steps: each a process, which returns what goes into its record ----

def path_of(options, name):
    return os.path.join(options.folder, name)


def analyze(options):
    """analysis.slf"""
    A = workers.network(raster_of(options))
    S = sparse_local.Analysis(A, scratch=options.folder, threads=options.threads)
    S.save(path_of(options, "analysis.slf"))
    found = S.stats
    return {"cells": A.shape[0], "entries": found["nnz_l"], "panels": found["nnz_panels"],
            "operations": found["flops"], "order_s": found["seconds_order"],
            "bytes": os.path.getsize(path_of(options, "analysis.slf"))}


def factor(options):
    """factor.slf"""
    S = sparse_local.Analysis.load(path_of(options, "analysis.slf"), map=True)
    A = workers.network(raster_of(options))
    begin = time.perf_counter()
    F = S.factor(A, scratch=options.folder, definite=True, threads=options.threads)
    factored = time.perf_counter()
    del A
    F.save(path_of(options, "factor.slf"))
    return {"factor_s": factored - begin, "save_s": time.perf_counter() - factored,
            "isa": F.stats["factor"]["isa"],
            "bytes": os.path.getsize(path_of(options, "factor.slf"))}


def draw_map(options):
    """current.npy and current.png; checks.json"""
    F = sparse_local.Factor.load(path_of(options, "factor.slf"), map=True)
    cells = raster_of(options)
    job = workers.AllPairs(F, options.points)
    R = np.load(path_of(options, "resistances.npy"))
    last = job.points.size - 1
    B = np.zeros((3, F.n))  # two pairs, and from the first cell to all others
    pairs = [(0, last), (last // 2, last // 2 + 1)]
    for b, (i, j) in zip(B, pairs):
        b[job.points[[i, j]]] = 1.0, -1.0
    B[2, job.points] = -1.0 / last
    B[2, job.points[0]] = 1.0
    X = F.solve(B.T).T
    checks = []
    for k, (b, x) in enumerate(zip(B, X)):
        residual = b - times_matrix(cells, x.reshape(cells.shape)).ravel()
        found = {"residual": float(np.abs(residual).max())}
        if k < len(pairs):
            i, j = pairs[k]
            by_solve = float(b @ x)
            # R = b' A^-1 b differs from b' x by (A^-1 b)' residual
            found.update(cells=[int(c) for c in job.points[[i, j]]], R=float(R[i, j]),
                         by_solve=by_solve, difference=abs(R[i, j] - by_solve) / by_solve,
                         bound=float(np.abs(x).max() * np.abs(residual).sum()) / by_solve)
        checks.append(found)
    through = current(cells, X[2].reshape(cells.shape))
    through.flat[job.points] += 0.5 * np.abs(B[2, job.points])
    np.save(path_of(options, "current.npy"), through)
    draw(path_of(options, "current.png"), reduced(cells), reduced(through))
    with open(path_of(options, "checks.json"), "w") as file:
        json.dump(checks, file, indent=1)
    if not all(c.get("difference", 0.0) <= 1e-8 and c["residual"] <= 1e-8 for c in checks):
        sys.exit("raster.py: resistances differ from those of solves: checks.json")
    return {"bytes": os.path.getsize(path_of(options, "current.npy"))}


def draw(path, cells, through):
    """The conductances and the currents, if matplotlib is there."""
    try:
        import matplotlib
        from PIL import Image  # which matplotlib needs
    except ImportError:
        print("no matplotlib: no picture")
        return
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 2, figsize=(8.0, 4.25), dpi=100)
    low, high = np.percentile(through, [5.0, 99.9])
    for axis, values, title, limits, colors in (
            (axes[0], cells, "conductance", np.percentile(cells, [1.0, 99.0]), "YlGn"),
            (axes[1], through, "current", (low, high), "magma")):
        axis.imshow(np.log(np.maximum(values, 1e-300)), cmap=colors, vmin=np.log(limits[0]),
                    vmax=np.log(limits[1]))
        axis.set_title(title, fontsize=11)
        axis.set_axis_off()
    figure.subplots_adjust(0.005, 0.005, 0.995, 0.93, 0.02)
    figure.savefig(path)
    with Image.open(path) as image:
        image.convert("RGB").quantize(160).save(path, optimize=True)


# ---- the pairs, by workers.py ----

def mapping(above, path):
    """The processes below one that map a file."""
    parents, found = {}, []
    for name in glob.glob("/proc/[0-9]*"):
        with contextlib.suppress(OSError):
            pid = int(os.path.basename(name))
            with open(name + "/stat") as file:
                parents[pid] = int(file.read().rpartition(")")[2].split()[1])
            with open(name + "/maps") as file:
                if path in file.read():
                    found.append(pid)

    def is_below(pid):
        while pid in parents and pid != above:
            pid = parents[pid]
        return pid == above

    return sorted(pid for pid in found if is_below(pid) and pid != above)


def answers(folder):
    return glob.glob(os.path.join(folder, "answers-*", "*.npy"))


def command_of(engine, folder, options):
    program = [sys.executable, "-B", os.path.join(os.path.dirname(os.path.abspath(__file__)),
                                                  "workers.py")]
    if engine == "mpi":
        program[2:2] = ["-m", "mpi4py.futures"]
        program[:0] = options.mpiexec.split()
    with open(record_path(options, "analysis")) as file:
        size = math.isqrt(json.load(file)["cells"])
    return program + [folder, "--size", str(size), "--points", str(options.points), "--engine",
                      engine, "--workers", str(options.workers)]


def answer(engine, options):
    """resistances.npy, which are the same by all engines."""
    folder = path_of(options, engine)
    os.makedirs(folder, exist_ok=True)
    factor_path = os.path.join(folder, "factor.slf")
    if not os.path.exists(factor_path):
        os.link(path_of(options, "factor.slf"), factor_path)
    command, record = command_of(engine, folder, options), {"share": 0}
    kill = options.kill
    while True:
        program = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        while kill and program.poll() is None:
            found = mapping(program.pid, factor_path)
            if len(answers(folder)) >= 2 and len(found) >= 2:
                os.kill(found[-1], signal.SIGKILL)
                record["answers_when_killed"], kill = len(answers(folder)), False
            time.sleep(POLL)
        out = program.communicate()[0]
        print(out, end="")
        if program.returncode == 0:
            break
        if "answers_when_killed" not in record or "repeated" in record:
            sys.exit("raster.py: %s failed" % " ".join(command))
        record["repeated"] = True  # MPI ends with a rank
    R = np.load(os.path.join(folder, "resistances.npy"))
    path = path_of(options, "resistances.npy")
    if os.path.exists(path) and not np.array_equal(np.load(path), R):
        sys.exit("raster.py: the answers of %s differ from %s" % (engine, path))
    os.replace(os.path.join(folder, "resistances.npy"), path)
    words = out.split("in memory once: ")[1].split()
    record.update(pairs=R.shape[0] * (R.shape[0] - 1) // 2, share=float(words[0]) * 1e6,
                  processes=int(words[3]), bytes=os.path.getsize(path))
    return record


STEPS = {"analysis": analyze, "factor": factor, "dask": lambda o: answer("dask", o),
         "mpi": lambda o: answer("mpi", o), "processes": lambda o: answer("processes", o),
         "map": draw_map}


# ---- one after the other ----

def record_path(options, step):
    return path_of(options, step + ".json")


def write_json(path, content):
    """A file that is complete whenever this program is killed."""
    with open(path + ".part", "w") as file:
        json.dump(content, file, indent=1)
    os.replace(path + ".part", path)


def run_step(options):
    """What the process of a step does."""
    limit = 0 if options.step in ("dask", "mpi", "processes") else options.memory * GIB
    with MemoryLimit(options.folder, int(limit)):
        record = STEPS[options.step](options)
    write_json(record_path(options, options.step), record)


def shared_bytes(pid):
    """What a process has of files in memory."""
    with contextlib.suppress(OSError):
        with open("/proc/%d/statm" % pid) as file:
            return int(file.read().split()[2]) * PAGE
    return 0


def peak_bytes(usage):
    return usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def do(step, options, kill_at=0):
    """Runs a step as a process: (its record with the time, whether it was killed).

    kill_at: bytes of files in its memory with which it is killed; 0: it is not.
    """
    begin, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    program = subprocess.Popen([sys.executable, "-B", os.path.abspath(__file__), "--step", step] +
                               sys.argv[1:])
    pid = is_killed = seconds = 0
    while pid == 0:
        if kill_at and shared_bytes(program.pid) >= kill_at:
            program.kill()
            is_killed, kill_at = 1, 0
            seconds = time.perf_counter() - begin  # before its files are given back
        time.sleep(POLL)
        pid, status, usage = os.wait4(program.pid, os.WNOHANG if kill_at else 0)
    program.returncode = status
    seconds = seconds or time.perf_counter() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = {"seconds": seconds, "peak": peak_bytes(usage), "processor_s":
             after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime}
    if not os.path.exists(record_path(options, step)):
        if is_killed:
            print("%s: killed after %.1f s" % (step, seconds), flush=True)
            return dict(spent, bytes=0), True
        sys.exit(1)
    with open(record_path(options, step)) as file:
        return dict(json.load(file), **spent), False


def machine(options, records):
    """The lines `key: value` about the run that a file of figures begins with."""
    name = platform.processor() or platform.machine()
    with contextlib.suppress(OSError, StopIteration):
        with open("/proc/cpuinfo") as file:
            name = next(line for line in file if line.startswith("model name")).split(":")[1]
    isa = ("", "plain C", "avx2", "avx512", "neon")[records["factor"]["isa"]]
    facts = {"date": datetime.date.today().isoformat(), "commit": os.environ.get("COMMIT", "-"),
             "machine": name.strip(), "instruction set": isa,
             "compiler": os.environ.get("COMPILER", "-"), "load": "%.2f" % os.getloadavg()[1],
             "cells": records["analysis"]["cells"], "memory limit": "%g GiB" % options.memory}
    return "".join("%s: %s\n" % item for item in facts.items())


def table(records):
    """The rows of raster.csv."""
    lines = ["step,seconds,processor_s,peak,bytes,pairs"]
    for step, record in records.items():
        if step == "job":
            continue
        lines.append("%s,%.4g,%.4g,%d,%d,%d" % (
            step, record["seconds"], record["processor_s"],
            record.get("share") or record["peak"], record["bytes"], record.get("pairs", 0)))
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description="pair resistances and currents of a large raster")
    parser.add_argument("folder", help="of all files; the disk needs twice the bytes of L")
    parser.add_argument("--size", type=int, default=300, help="rows and columns of a trial raster")
    parser.add_argument("--raster", help="conductances, a square file of numpy.save")
    parser.add_argument("--points", type=int, default=60, help="focal cells")
    parser.add_argument("--memory", type=float, default=20.0, help="GiB a process; 0: no limit")
    parser.add_argument("--engines", nargs="*", choices=["dask", "mpi", "processes"],
                        default=["processes"], help="who finds the pairs, one after the other")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--threads", type=int, help="of the analysis and the factorization")
    parser.add_argument("--mpiexec", default="mpiexec -n 3", help="the command before python3")
    parser.add_argument("--kill", action="store_true", help="kill one process of each step")
    parser.add_argument("--step", choices=list(STEPS), help=argparse.SUPPRESS)
    options = parser.parse_args()
    options.folder = os.path.abspath(options.folder)
    os.makedirs(options.folder, exist_ok=True)
    if options.step:
        run_step(options)
        return
    steps_path = path_of(options, "steps.json")
    job = {"size": options.size, "raster": options.raster, "points": options.points}
    records = {}
    if os.path.exists(steps_path):
        with open(steps_path) as file:
            records = json.load(file)
    if records.setdefault("job", job) != job:
        sys.exit("raster.py: %s has the steps of another job: %s" %
                 (options.folder, records["job"]))
    for step in ["analysis", "factor", *options.engines, "map"]:
        if step in records and os.path.exists(record_path(options, step)):
            print("%s: is there" % step, flush=True)
            continue
        kill_at = 0
        if step == "factor" and options.kill and "killed factor" not in records:
            kill_at = 8 * records["analysis"]["panels"] // 3
        record, is_killed = do(step, options, kill_at)
        if is_killed:
            records["killed factor"] = record
            record, _ = do(step, options)
        records[step] = record
        write_json(steps_path, records)
        print("%s: %.4g s" % (step, records[step]["seconds"]), flush=True)
    for name, text in (("raster.machine.txt", machine(options, records)),
                       ("raster.csv", table(records))):
        with open(path_of(options, name), "w") as file:
            file.write(text)
    print(table(records), end="")


if __name__ == "__main__":
    main()
