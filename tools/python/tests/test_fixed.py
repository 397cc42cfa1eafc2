"""Rows fixed at given values, against dense algebra."""
import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from systems import grid, right_hand_sides

ROWS = [0, 19, 380, 399, 210]


def exact(A, rows, values, b):
    free = np.setdiff1d(np.arange(A.shape[0]), rows)
    dense = A.toarray()
    x = np.zeros((A.shape[0],) + values.shape[1:], dtype=np.result_type(dense, values, b))
    x[rows] = values
    x[free] = np.linalg.solve(dense[np.ix_(free, free)],
                              b[free] - dense[np.ix_(free, rows)] @ values)
    return x


@pytest.mark.parametrize("count", [None, 1, 3])
@pytest.mark.parametrize("form", ["csc", "csr", "lower", "upper"])
def test_rows_are_fixed(count, form):
    A = grid(20, 0.0)  # singular
    stored = {"csc": A, "csr": A.tocsr(), "lower": sp.tril(A, format="csc"),
              "upper": sp.triu(A, format="csr")}[form]
    D = sl.FixedRows(stored, ROWS)
    assert len(D) == 5 and D.n == 400
    assert np.array_equal(D.free_rows, np.setdiff1d(np.arange(400), ROWS))
    assert "5 of them" in repr(D)
    values, b = right_hand_sides(5, count), right_hand_sides(400, count)
    for g, c in ((values, b), (np.asfortranarray(values), b), (values, np.asfortranarray(b))):
        assert np.allclose(D.solve(c, g), exact(A, ROWS, g, c))
    assert np.allclose(D.solve(None, values), exact(A, ROWS, values, 0 * b))
    assert np.allclose(D.solve(b, values + 1j), exact(A, ROWS, values + 1j, b))
    assert np.allclose(D.solve(2j * b, values), exact(A, ROWS, values, 2j * b))
    D.refactor(3.0 * stored)
    assert np.allclose(D.solve(b, values), exact(3 * A, ROWS, values, b))


def test_none_and_all():
    A, b = grid(6), np.ones(36)
    assert np.allclose(A @ sl.FixedRows(A, []).solve(b, np.zeros(0)), b)
    D = sl.FixedRows(A, np.arange(36)[::-1])
    assert np.array_equal(D.solve(None, np.arange(36.0)), np.arange(36.0)[::-1])
    assert D.free_rows.size == 0


def test_complex_matrices():
    low = sp.tril(grid(6), format="coo")
    turned = np.where(low.row > low.col, low.data * np.exp(1j * low.row), low.data)
    low = sp.csc_matrix((turned, (low.row, low.col)), shape=low.shape)
    H = (low + sp.tril(low, -1).conj().T).tocsc()
    D, b = sl.FixedRows(H, [3, 30], threads=2), right_hand_sides(36, 2) * (1 + 2j)
    values = np.array([[1j, 2.0], [0.5, 1.0]])
    assert np.allclose(D.solve(b, values), exact(H, [3, 30], values, b))
    assert D.free_rows.size == 34


def test_a_chosen_triangle_stays_chosen():
    A = grid(6)
    B = A.tolil()
    B[3, 2] -= 0.5
    b, values = np.ones(36), np.array([1.0, 2.0])
    half = sp.tril(B)
    whole = (half + sp.tril(B, -1).T).tocsc()
    for first, second in (("tocsc", "tocsr"), ("tocsr", "tocsc")):
        D = sl.FixedRows(getattr(A, first)(), [0, 35], triangle="lower")
        D.refactor(getattr(B, second)())
        assert np.allclose(D.solve(b, values), exact(whole, [0, 35], values, b))


def test_what_is_wrong_gives_a_signal():
    L = grid(6, 0.0)
    A = sp.block_diag([L, L], format="csc")
    with pytest.raises(sl.PivotError) as caught:
        sl.FixedRows(A, [3])  # the second component has no fixed row
    assert 36 <= caught.value.row < 72
    for rows in ([72], [-1], [3, 3], None, [[1, 2]]):
        with pytest.raises(sl.ArgumentError):
            sl.FixedRows(A, rows)
    with pytest.raises(sl.PivotError):
        sl.FixedRows(-grid(6), [1], definite=True)
    with pytest.raises(TypeError):
        sl.FixedRows(A, [1], pivoted=True)
    damaged = L.tolil()
    damaged[3, 2] *= 2
    with pytest.raises(sl.PatternError):
        sl.FixedRows(damaged.tocsc(), [1])
    D, b = sl.FixedRows(L, [1, 2]), np.ones(36)
    x = D.solve(b, [1.0, 2.0])
    for call in (lambda: D.solve(None, [np.nan, 1.0]),
                 lambda: D.solve(np.full(36, np.inf), [1.0, 2.0]),
                 lambda: sl.FixedRows(L * np.nan, [1])):
        with pytest.raises(sl.NotFiniteError):
            call()
    for call in (lambda: D.solve(None, [1.0]), lambda: D.solve(b[:-1], [1.0, 2.0]),
                 lambda: D.solve(b, [[1.0], [2.0]]), lambda: D.solve(None, 1.0)):
        with pytest.raises(sl.ArgumentError):
            call()
    for other in (grid(7), damaged.tocsc(), sp.tril(L, format="csc")):
        with pytest.raises(sl.PatternError):
            D.refactor(other)
    assert np.array_equal(D.solve(b, [1.0, 2.0]), x)
    with pytest.raises(sl.PivotError):
        D.refactor(0 * L)
    with pytest.raises(sl.StateError):
        D.solve(None, [1.0, 2.0])
    D.refactor(L)
    assert np.allclose(D.solve(b, [1.0, 2.0]), x)
    D.close()
    for call in (lambda: D.solve(None, [1.0, 2.0]), lambda: D.refactor(L), lambda: D.free_rows):
        with pytest.raises(sl.StateError, match="closed"):
            call()
