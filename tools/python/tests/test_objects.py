"""Life times of objects, several threads, and which library is loaded."""
import gc
import subprocess
import sys
import threading
import time
import weakref

import numpy as np

import sparse_local as sl
from systems import grid, right_hand_sides


def test_objects_keep_what_they_borrow(A):
    plan = sl.Factor(A).plan([1], [2])
    gc.collect()
    assert np.isfinite(plan.solve([1.0]))
    F = sl.Factor(A)
    gone = weakref.ref(F._factor)
    del F
    gc.collect()
    assert gone() is None


def test_threads_share_a_factor(F):
    b = right_hand_sides(400)
    x, plan = F.solve(b), F.plan([3], [390])
    y, wrong = plan.solve([1.0]), []

    def work():
        for _ in range(200):
            if not (np.array_equal(F.solve(b), x) and np.array_equal(plan.solve([1.0]), y)):
                wrong.append(1)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_the_lock_of_the_interpreter_is_released(A):
    """While one thread is in a long call, another one runs Python code."""
    big = sl.Factor(grid(100))
    B = np.ones((10000, 400))
    began, ended = threading.Event(), threading.Event()

    def work():
        began.set()
        big.solve(B)
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    began.wait()
    ticks = 0
    while not ended.is_set():
        ticks += 1
        time.sleep(0.0005)
    thread.join()
    assert ticks > 3


def test_library_can_be_chosen():
    code = "import sparse_local; print(sparse_local.library_path(), sparse_local.version())"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.split() == [sl.library_path(), sl.__version__]
