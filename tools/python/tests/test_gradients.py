"""Derivatives by NumPy against differences, and by torch against gradcheck."""
import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from sparse_local import gradients
from systems import grid, right_hand_sides

STEP = 1e-6


def differences(function, values):
    """The gradient of a function of an array, by central differences."""
    out = np.zeros_like(values)
    for k in np.ndindex(values.shape):
        for sign in (1, -1):
            moved = values.copy()
            moved[k] += sign * STEP
            out[k] += sign * function(moved) / (2 * STEP)
    return out


def with_values(A, data):
    B = A.copy()
    B.data = data
    return B


@pytest.mark.parametrize("turn", ["tocsc", "tocsr"])
@pytest.mark.parametrize("half", [sp.tril, sp.triu])
@pytest.mark.parametrize("count", [None, 3])
def test_full_solves_and_determinants(turn, half, count):
    A = getattr(half(grid(4)), turn)()
    b, g = right_hand_sides(16, count), np.cos(right_hand_sides(16, count))
    F = sl.Factor(A)
    x = F.solve(b)
    by_b, by_a = gradients.solve_gradient(F, A, x, g)
    wanted = differences(lambda b: (g * F.solve(b)).sum(), b)
    assert np.allclose(by_b, wanted, rtol=1e-7, atol=1e-7)
    wanted = differences(lambda d: (g * sl.Factor(with_values(A, d)).solve(b)).sum(), A.data)
    assert np.allclose(by_a, wanted, rtol=1e-7, atol=1e-7)
    wanted = differences(lambda d: sl.Factor(with_values(A, d)).logdet()[1], A.data)
    assert np.allclose(gradients.logdet_gradient(F, A), wanted, rtol=1e-7, atol=1e-7)


def test_both_triangles_share_the_derivative(A, F):
    x, g = F.solve(right_hand_sides(400)), np.cos(np.arange(400.0))
    by_a = with_values(A, gradients.solve_gradient(F, A, x, g)[1])
    half = sp.tril(A, format="csc")
    by_half = with_values(half, gradients.solve_gradient(F, half, x, g)[1])
    assert abs(by_a - by_a.T).max() < 1e-14
    assert abs(sp.tril(by_a) + sp.triu(by_a, 1).T - by_half).max() < 1e-14
    assert np.allclose(gradients.logdet_gradient(F, A), np.linalg.inv(A.toarray())[A.nonzero()])


@pytest.mark.parametrize("count", [None, 2])
def test_local_solves(count):
    A = sp.tril(grid(5), format="csc")
    F = sl.Factor(A)
    rows, columns, bset, xset = [7, 8, 9], [6, 8, 9], [3, 20], [11, 3, 12]
    Q = gradients.LocalGradient(F, bset, xset, rows, columns)
    b, g = right_hand_sides(2, count), np.cos(right_hand_sides(3, count))
    x, kept = Q.solve(b)
    assert np.array_equal(x, F.local(bset, b, xset))
    by_b, by_a = Q.gradient(kept, g)
    assert np.allclose(by_b, differences(lambda b: (g * F.local(bset, b, xset)).sum(), b))

    def moved(values):
        B = A.tolil()
        for i, j, v in zip(rows, columns, values):
            B[i, j] = v
        return (g * sl.Factor(B.tocsc()).local(bset, b, xset)).sum()

    values = np.array([A[i, j] for i, j in zip(rows, columns)])
    assert np.allclose(by_a, differences(moved, values), rtol=1e-7, atol=1e-8)
    for wrong in ({"rows": [1], "columns": []}, {"rows": [400], "columns": [1]}):
        with pytest.raises(sl.ArgumentError):
            gradients.LocalGradient(F, bset, xset, **wrong)
    with pytest.raises(sl.ArgumentError):
        Q.gradient(kept, g[:2])


@pytest.mark.parametrize("turn", ["tocsc", "tocsr", "tocoo"])
@pytest.mark.parametrize("part", [sp.tril, sp.triu, lambda A: A])
def test_entries_of_the_inverse(turn, part, monkeypatch):
    """By solves and by the factor of twice the size, against dense algebra and differences."""
    A = getattr(part(grid(4)), turn)()
    full = grid(4).toarray()
    F, inverse = sl.Factor(A), np.linalg.inv(full)
    stored = gradients.Stored(A)
    near = grid(4).tocoo()
    cases = [(np.arange(16), np.arange(16)), ([3, 9, 3], [3, 12, 3]), (np.arange(16), [5] * 16),
             ([7] * 16, np.arange(16)), (near.row, near.col), ([], []), ([1, 2], [2, 1])]
    for rows, columns in cases:
        g = np.cos(np.arange(len(rows)) + 1.0) * 1e3
        G = np.zeros((16, 16))
        np.add.at(G, (np.asarray(rows, int), np.asarray(columns, int)), g)
        G = 0.5 * (G + G.T)
        wanted = -2.0 * (inverse @ G @ inverse)[stored.rows, stored.columns] * stored.weights
        for solved in (128, 0):
            monkeypatch.setattr(gradients, "_SOLVED", solved)
            got = gradients.pairs_gradient(F, A, rows, columns, g)
            assert np.allclose(got, wanted, rtol=1e-12, atol=1e-13 * abs(wanted).max(initial=1))
    monkeypatch.setattr(gradients, "_SOLVED", 0)
    if part is sp.tril and turn == "tocsc":
        g = np.sin(np.arange(16.0))
        wanted = differences(lambda d: g @ sl.Factor(with_values(A, d)).diagonal(), A.data)
        got = gradients.pairs_gradient(F, A, range(16), range(16), g)
        assert np.allclose(got, wanted, rtol=1e-7, atol=1e-7)


def test_variances_of_many_rows(A, F):
    """More columns than are solved at once, both ways."""
    g = np.cos(np.arange(400.0))
    twins = gradients.pairs_gradient(F, A, range(400), range(400), g)
    few = [gradients.pairs_gradient(F, A, rows, rows, g[rows])
           for rows in np.split(np.arange(400), 4)]
    assert np.allclose(twins, sum(few), rtol=1e-12, atol=1e-13)
    for size in (1e300, 1e-300):  # neither overflows nor underflows on its way
        got = gradients.pairs_gradient(F, A, range(400), range(400), size * g)
        assert np.allclose(got / size, twins, rtol=1e-12, atol=1e-13)
    for wrong in (np.nan, np.inf):
        with pytest.raises(sl.NotFiniteError, match="in g, row 7"):
            gradients.pairs_gradient(F, A, range(400), range(400),
                                     np.where(np.arange(400) == 7, wrong, g))
    H = A - 5.0 * sp.identity(400)  # indefinite
    indefinite = sl.Factor(H)
    assert min(indefinite.inertia[:2]) > 20
    inverse = np.linalg.inv(H.toarray())
    wanted = -((inverse * g) @ inverse)[gradients.Stored(H).rows, gradients.Stored(H).columns]
    got = gradients.pairs_gradient(indefinite, H, range(400), range(400), g)
    assert np.allclose(got, wanted, rtol=1e-8, atol=1e-8 * abs(wanted).max())


def test_entries_of_a_regularized_inverse(monkeypatch):
    """Those of A + E: by solves, since a factor of twice the size would have another E."""
    monkeypatch.setattr(gradients, "_SOLVED", 0)
    A = grid(4, 0.0)  # singular
    F = sl.Factor(A, regularization=1e-3)
    rows, shifts = F.pivot_rows("regularized")
    assert rows.size == 1
    E = np.zeros(16)
    E[rows] = shifts
    inverse, g = np.linalg.inv(A.toarray() + np.diag(E)), np.cos(np.arange(16.0))
    stored = gradients.Stored(A)
    wanted = -2.0 * stored.weights * ((inverse * g) @ inverse)[stored.rows, stored.columns]
    got = gradients.pairs_gradient(F, A, range(16), range(16), g)
    assert np.allclose(got, wanted, rtol=1e-11, atol=1e-12 * abs(wanted).max())


def test_entries_that_are_refused():
    A = grid(4)
    F = sl.Factor(A)
    for rows, columns, g in (([1], [1, 2], [1.0]), ([16], [1], [1.0]), ([-1], [1], [1.0]),
                             (None, None, np.ones(16)), ([1], [1], [1.0, 2.0])):
        with pytest.raises(sl.ArgumentError):
            gradients.pairs_gradient(F, A, rows, columns, g)
    L = grid(4, 0.0)
    with pytest.raises(sl.UnsupportedError, match="pseudo-inverse"):
        gradients.pairs_gradient(sl.Factor(L, null_pivots="skip"), L, [1], [1], [1.0])
    with pytest.raises(sl.NotFiniteError):
        gradients.pairs_gradient(F, A, [1], [1], [np.nan])


def test_what_has_no_such_derivative_is_refused():
    L = grid(4, 0.0)
    weighted = sl.Factor(L, null_pivots="skip", mass=np.ones(16))
    with pytest.raises(sl.UnsupportedError):
        gradients.solve_gradient(weighted, L, np.ones(16), np.ones(16))
    H = grid(4).astype(complex)
    with pytest.raises(sl.UnsupportedError):
        gradients.logdet_gradient(sl.Factor(H), H)
    skipped = sl.Factor(L, null_pivots="skip")
    with pytest.raises(sl.InconsistentError):  # g is not in balance
        gradients.solve_gradient(skipped, L, np.ones(16), np.ones(16))
    F = sl.Factor(grid(4), triangle="lower")
    with pytest.raises(sl.ArgumentError):
        gradients.logdet_gradient(F, grid(4))
    with pytest.raises(sl.ArgumentError):
        gradients.solve_gradient(sl.Factor(grid(4)), grid(4), np.ones(16), np.ones((16, 1)))
    with pytest.raises(sl.NotFiniteError):
        gradients.solve_gradient(sl.Factor(grid(4)), grid(4), np.ones(16), np.full(16, np.nan))
