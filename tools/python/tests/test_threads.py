"""Threads of Python that the library runs on: bits, forks, interrupts, threads of the caller."""
import multiprocessing
import os
import subprocess
import sys
import threading

import numpy as np
import pytest

import sparse_local as sl
from systems import grid, right_hand_sides

SIDE = 170  # of a grid whose factorization is divided


@pytest.mark.parametrize("threads", [2, 3])
def test_threads_give_the_same_bits(threads):
    A = grid(SIDE)
    one, many = sl.Factor(A), sl.Factor(A, threads=threads)
    assert one.stats["factor"]["threads"] == 1 and many.stats["factor"]["threads"] == threads
    B = right_hand_sides(A.shape[0], 40)
    assert np.array_equal(one.solve(B), many.solve(B))
    assert np.array_equal(one.solve(B[:, 0]), many.solve(B[:, 0]))
    assert np.array_equal(one.diagonal(), many.diagonal())
    assert np.array_equal(one.refactor(2 * A).solve(B), many.refactor(2 * A).solve(B))
    again = sl.Factor.from_bytes(many.to_bytes(), threads=threads)
    assert np.array_equal(again.refactor(2 * A).solve(B), many.solve(B))
    for wrong in (0, -1, 1.5, True, "2"):
        with pytest.raises(sl.ArgumentError):
            sl.Factor(grid(3), threads=wrong)


def test_threads_that_factor_and_solve_with_objects_of_their_own():
    A, b, wrong = grid(SIDE), right_hand_sides(SIDE ** 2), []
    x = sl.Factor(A).solve(b)

    def work(k):
        for _ in range(5):
            F = sl.Factor((k + 1) * A, threads=2)
            if not np.allclose(F.solve(b) * (k + 1), x):
                wrong.append(k)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def solve_in_child(queue):
    queue.put(float(sl.Factor(grid(SIDE), threads=2).solve(np.ones(SIDE ** 2)).sum()))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_forked_process_has_a_pool_of_its_own():
    wanted = float(sl.Factor(grid(SIDE), threads=2).solve(np.ones(SIDE ** 2)).sum())
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=solve_in_child, args=(queue,))
    child.start()
    assert queue.get(timeout=60) == wanted
    child.join()


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_an_interrupt_waits_for_the_end_of_a_loop():
    """Interrupts at many times: each is raised, and no factor is damaged."""
    code = """
import os, signal, sys, threading, time
sys.path.insert(0, %r)
import numpy as np, sparse_local as sl
from systems import grid
A, b, inside = grid(170), np.ones(28900), []
F = sl.Factor(A, threads=2)
x, raised, stop = F.solve(b), 0, time.time() + 3

def handler(number, frame):
    if inside:
        inside.clear()
        raise KeyboardInterrupt

def interrupt():
    while time.time() < stop:
        time.sleep(0.003)
        os.kill(os.getpid(), signal.SIGINT)

signal.signal(signal.SIGINT, handler)
thread = threading.Thread(target=interrupt)
thread.start()
while thread.is_alive():
    try:
        inside.append(1)
        F.refactor(A)
        inside.clear()
        y = F.solve(b)
        assert np.array_equal(y, x)
    except KeyboardInterrupt:
        raised += 1
thread.join()
F.refactor(A)
assert np.array_equal(F.solve(b), x)
print("raised" if raised > 3 else "not raised")
""" % os.path.dirname(os.path.abspath(__file__))
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                         timeout=120)
    assert out.stdout == "raised\n", out.stderr
    assert "ignored" not in out.stderr, out.stderr
