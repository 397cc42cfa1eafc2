"""Singular matrices: entries, samples and determinants are those of the pseudo-inverse."""
import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from systems import grid


def components():
    """Two grids, a row of zeros and a regular row, permuted."""
    A = sp.block_diag([grid(9, 0.0), 3.0 * grid(5, 0.0), sp.csc_matrix((1, 1)), [[2.0]]])
    order = np.random.default_rng(3).permutation(A.shape[0])
    return A.tocsc()[order][:, order]


def springs():
    """Springs in a plane between the vertices of a grid with diagonals, and its rigid motions."""
    side = 5
    points = np.array([(x, y) for x in range(side) for y in range(side)], dtype=float)
    A = np.zeros((2 * side ** 2,) * 2)
    for i, p in enumerate(points):
        for j, q in enumerate(points[:i]):
            if abs(p - q).max() == 1:
                d = np.zeros(len(A))
                d[2 * i:2 * i + 2], d[2 * j:2 * j + 2] = p - q, q - p
                A += np.outer(d, d) / (d @ d)
    x, y = (points - points.mean(0)).T
    zero, one = np.zeros_like(x), np.ones_like(x)
    Z = np.stack([np.stack(pair, 1).ravel() for pair in ((one, zero), (zero, one), (-y, x))], 1)
    return sp.csc_matrix(A), Z


def cases():
    A, Z = springs()
    m = A.shape[0]
    return [(components(), {}), (components(), {"ordering": "natural"}),
            (components(), {"mass": np.ones(components().shape[0])}), (grid(8, 0.0), {}),
            (A, {"null_vector": Z}), (A, {"null_vector": Z, "mass": np.ones(m), "block_size": 2}),
            (grid(8), {})]


@pytest.mark.parametrize("A, options", cases())
def test_entries_are_those_of_pinv(A, options):
    F = sl.Factor(A, null_pivots="skip", **options)
    n = A.shape[0]
    inverse = np.linalg.pinv(A.toarray(), rcond=1e-10, hermitian=True)
    near = dict(rtol=0, atol=1e-11 * abs(inverse).max())
    np.testing.assert_allclose(F.diagonal(), inverse.diagonal(), **near)
    np.testing.assert_allclose(F.diagonal([3, 0, 7]), inverse.diagonal()[[3, 0, 7]], **near)
    np.testing.assert_allclose(F.block(range(n), range(n)), inverse, **near)
    np.testing.assert_allclose(F.block([4, 1], [0, 4, 9]), inverse[[4, 1]][:, [0, 4, 9]], **near)
    Z = sl.Selected(F)
    np.testing.assert_allclose(Z.diagonal(), inverse.diagonal(), **near)
    rows, columns = A.nonzero()
    np.testing.assert_allclose(Z.entries(rows, columns), inverse[rows, columns], **near)
    eigenvalues = np.linalg.eigvalsh(A.toarray())
    assert F.logdet()[1] == pytest.approx(np.log(eigenvalues[eigenvalues > 1e-9]).sum(), abs=1e-9)
    X = F.sample(20000, rng=np.random.default_rng(0))
    assert abs(X @ X.T / 20000 - inverse).max() < 0.05 * abs(inverse).max()
    parts = X - A @ inverse @ X  # in the null space
    assert abs(parts).max() < 1e-10 * abs(X).max()
    assert F.sample(rng=np.random.default_rng(1)).shape == (n,)


def test_the_order_does_not_matter_unless_asked_for():
    A = grid(8, 0.0)
    factors = [sl.Factor(A, null_pivots="skip", ordering=name) for name in ("nd", "natural")]
    d, e = (F.diagonal() for F in factors)
    np.testing.assert_allclose(d, e, rtol=1e-11)
    d, e = (F.diagonal(pseudo=False) for F in factors)
    assert abs(d - e).max() > 0.1 and d.min() == e.min() == 0.0
    assert factors[0].block([0], [0], pseudo=False)[0, 0] == pytest.approx(d[0], rel=1e-12)
    assert sl.Selected(factors[0]).diagonal(pseudo=False)[0] == d[0]
    assert factors[0].logdet(pseudo=False)[1] == pytest.approx(
        factors[0].logdet()[1] - np.log(64), abs=1e-10)


def test_new_numbers_have_a_new_null_space():
    A = grid(8, 0.0)
    F = sl.Factor(A, null_pivots="skip")
    Z = sl.Selected(F)
    d = F.diagonal()
    F.refactor(2.0 * A)
    np.testing.assert_allclose(F.diagonal(), d / 2.0, rtol=1e-11)
    np.testing.assert_allclose(Z.diagonal(), d, rtol=1e-11)
    Z.refactor()
    np.testing.assert_allclose(Z.diagonal(), d / 2.0, rtol=1e-11)
    G = sl.Factor.from_bytes(F.to_bytes())
    np.testing.assert_allclose(G.diagonal(), d / 2.0, rtol=1e-11)
