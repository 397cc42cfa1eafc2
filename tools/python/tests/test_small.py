"""Small systems: what the paths of most calls take in place, and what they leave to the others."""
import pickle
import time

import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from sparse_local import _arrays
from systems import grid


def test_addresses_are_those_of_numpy():
    arrays = [np.arange(5), np.arange(6.0)[2:], np.ones((3, 4)).T, np.zeros(3, np.int32),
              np.frombuffer(bytes(16)), np.ma.ones(3).data, np.zeros((4, 0))[:, :0]]
    for array in arrays:
        if array.size:
            assert _arrays.address(array) == array.ctypes.data
        assert _arrays.address(array)


def test_whatever_comes_gives_the_same_bits():
    A, b = grid(10), np.random.default_rng(0).standard_normal(100)
    F = sl.Factor(A)
    x, P = F.solve(b), F.plan([3, 4], [7])
    y = P.solve(np.array([1.0, 2.0]))
    strange = np.lib.stride_tricks.as_strided(np.repeat(b, 2), (100,), (16,))
    unaligned = np.frombuffer(b"-" + b.tobytes(), dtype=np.uint8)[1:].view(np.float64)
    read_only = b.copy()
    read_only.flags.writeable = False
    for right in (strange, unaligned, read_only, b.astype(">f8"), list(b), b[:, None],
                  pickle.loads(pickle.dumps(b)), b.view(np.recarray)):
        assert np.array_equal(np.ravel(F.solve(right)), x)
    for right in ([1, 2], np.array([[1.0], [2.0]]), np.array([1.0, 2.0, 9.0])[:2]):
        assert np.array_equal(np.ravel(P.solve(right)), y)
    other = pickle.loads(pickle.dumps(A))
    assert np.array_equal(sl.Factor(other).solve(b), x) and not F._kind.width - 1
    for name in ("indptr", "indices"):
        wide = A.copy()
        setattr(wide, name, getattr(A, name).astype(np.int64))
        assert np.array_equal(sl.Factor(wide).solve(b), x)


@pytest.mark.parametrize("bad", [np.nan, np.inf, 1e308])
def test_errors_are_those_of_other_shapes(bad):
    F = sl.Factor(1e-3 * grid(10))
    b = np.ones(100)
    b[7] = bad
    with pytest.raises(sl.NotFiniteError) as one:
        F.solve(b)
    with pytest.raises(sl.NotFiniteError) as other:
        F.solve(b[:, None])
    assert one.value.row == other.value.row == (7 if bad > 1e308 or bad != bad else None)
    P = F.plan([7], [3])
    with pytest.raises(sl.NotFiniteError):
        P.solve(np.array([bad]))
    with pytest.raises(sl.ArgumentError):
        F.solve(np.ones(99))
    F.close()
    for call in (lambda: F.solve(np.ones(100)), lambda: P.solve(np.ones(1))):
        with pytest.raises(sl.StateError):
            call()


def test_a_large_and_a_slight_asymmetry_are_found():
    A = grid(10)
    sl.Factor(A + 1e-12 * sp.random(100, 100, 1, random_state=0).multiply(A != 0))
    for change in (1e-3, np.inf, np.nan):
        B = A.copy()
        B[3, 4] += change
        with pytest.raises((sl.PatternError, sl.NotFiniteError)):
            sl.Factor(B)
        with pytest.raises((sl.PatternError, sl.NotFiniteError)):
            sl.Factor(A).refactor(B)


def test_what_is_no_sparse_matrix_gets_a_sentence():
    for wrong in (grid(3).toarray(), [[1.0]], 3.0, None):
        with pytest.raises(TypeError, match="scipy.sparse.csc_matrix"):
            sl.Factor(wrong)


def seconds(call, count=20):
    def one():
        begin = time.process_time()
        for _ in range(count):
            call()
        return (time.process_time() - begin) / count
    return min(one() for _ in range(100))


def test_python_adds_little_to_small_systems():
    """The package against the same calls of the library, with ready arguments."""
    A, b = grid(10), np.ones(100)
    F = sl.Factor(A)
    from sparse_local._library import lib
    x, work = np.empty(100), F._work()
    ready = (F._pointer, x.ctypes.data, 100, b.ctypes.data, 100, 1, work)
    bare = seconds(lambda: lib.sl_factor_solve(*ready))
    assert seconds(lambda: F.solve(b)) < 5 * bare
    assert seconds(lambda: sl.Factor(A).solve(b)) < 80 * bare
