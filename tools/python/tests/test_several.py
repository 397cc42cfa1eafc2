"""Analyses, sums of matrices, batches, threads, pairs and bilinear forms."""
import gc

import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from systems import grid, right_hand_sides


def test_an_analysis_serves_many_factors(A):
    S = sl.analyze(A, purpose="one factor", threads=2)
    assert sorted(S.perm) == list(range(400)) and S.stats["nnz_l"] > 400 and "400 rows" in repr(S)
    F, G = S.factor(A), S.factor(3 * A, definite=True)
    b = right_hand_sides(400)
    plan = F.plan([3], [5])
    assert np.allclose(G.solve(b), F.solve(b) / 3)
    assert np.array_equal(plan.on(G).solve([1.0]), G.local([3], [1.0], [5]))
    with pytest.raises(sl.StateError):
        plan.on(sl.Factor(A))
    with pytest.raises(sl.PatternError):
        S.factor(grid(19))
    with pytest.raises(TypeError):
        S.factor(A, ordering="nd")
    with pytest.raises(TypeError):
        sl.analyze(A, mass=np.ones(400))
    with pytest.raises(TypeError):
        sl.Factor(A, orderings="nd")
    with pytest.raises(sl.ArgumentError):
        sl.analyze(A, purpose="speed")
    pattern = A.copy()
    pattern.data[:] = np.nan  # values are not read
    assert np.array_equal(sl.analyze(pattern).factor(A).solve(b), sl.Factor(A).solve(b))


@pytest.mark.parametrize("threads", [None, 2])
def test_sums_are_factors_of_sums(A, threads):
    M = sp.diags(np.linspace(1, 2, 400), format="csc")
    L = grid(20, 0.0)
    S = sl.Sum([M, L], threads=threads)
    times = [0.1, 1.0, 10.0, 0.5, 2.0]
    factors = S.factor([[1, t] for t in times])
    b = right_hand_sides(400)
    for t, F in zip(times, factors):
        assert np.allclose((M + t * L) @ F.solve(b), b)
        matrix = S.matrix([1, t])
        assert np.allclose((matrix + sp.tril(matrix, -1).T).toarray(), (M + t * L).toarray())
    plan = factors[0].plan([3], [5, 7])
    xs = sl.solve_batch([(plan.on(F), [1.0]) for F in factors] + [(factors[2], b)], threads=threads)
    assert all(np.array_equal(x, F.local([3], [1.0], [5, 7])) for x, F in zip(xs, factors))
    assert np.array_equal(xs[-1], factors[2].solve(b))
    one = S.factor([1, 3.0])
    S.refactor([one, factors[0]], [[1, 0.1], [1, 3.0]])
    assert np.allclose((M + 0.1 * L) @ one.solve(b), b)
    S.refactor(one, [1, 0.2])
    assert np.allclose((M + 0.2 * L) @ one.solve(b), b)
    one.refactor(S.matrix([1, 0.7]))
    assert np.allclose((M + 0.7 * L) @ one.solve(b), b)
    del S
    gc.collect()
    assert np.isfinite(one.solve(b)).all()


def test_sums_name_what_failed():
    L, I = grid(6, 0.0), sp.identity(36, format="csc")
    S = sl.Sum([I, L])
    with pytest.raises(sl.PivotError) as caught:
        S.factor([[1, 1], [0, 1], [1, 2]])
    assert caught.value.failed == 1
    with pytest.raises(sl.PivotError) as caught:
        sl.Sum([I, L], definite=True).factor([[1, 1], [1, -0.3]])
    assert caught.value.failed == 1
    for wrong in ([1], [[1, 2, 3]], 1.0):
        with pytest.raises(sl.ArgumentError):
            S.factor(wrong)
    with pytest.raises(sl.NotFiniteError):
        S.factor([1, np.nan])
    with pytest.raises(sl.ArgumentError):
        sl.Sum([L, grid(5)])
    with pytest.raises(TypeError):
        sl.Sum([L], triangle="lower")
    with pytest.raises(sl.PatternError):
        sl.Sum([L + sp.csc_matrix(([1.0], ([1], [0])), shape=(36, 36))])
    F, G = S.factor([[1, 1], [1, 2]])
    with pytest.raises(sl.PivotError) as caught:
        S.refactor([F, G], [[1, 1], [0, 1]])
    assert caught.value.failed == 1 and F.solve(np.ones(36)).shape == (36,)
    with pytest.raises(sl.ArgumentError) as caught:
        F.solve(np.ones(35))
    assert caught.value.failed is None
    with pytest.raises(sl.StateError):
        G.solve(np.ones(36))
    with pytest.raises(sl.StateError) as caught:
        sl.solve_batch([(F, np.ones(36)), (G, np.ones(36))])
    with pytest.raises(sl.ArgumentError):
        S.refactor([F], [[1, 1], [1, 2]])
    with pytest.raises(sl.ArgumentError):
        S.refactor([sl.Factor(L + I)], [[1, 1]])


def test_pairs_and_bilinear_forms(A, F):
    inverse = np.linalg.inv(A.toarray())
    i, j = [5, 7, 399, 5], [5, 0, 17, 8]
    assert np.allclose(F.pairs(i, j), inverse[i, j])
    b, c = right_hand_sides(2), right_hand_sides(3)
    wanted = c @ inverse[np.ix_([1, 2, 3], [9, 8])] @ b
    assert F.bilinear([1, 2, 3], c, [9, 8], b) == pytest.approx(wanted)
    x = right_hand_sides(400)
    assert F.bilinear(None, x, None, x) == pytest.approx(x @ inverse @ x)
    with pytest.raises(sl.ArgumentError):
        F.pairs([1, 2], [1])
    with pytest.raises(sl.ArgumentError):
        F.pairs([400], [1])
    with pytest.raises(sl.NotFiniteError):
        F.bilinear([1], [np.nan], [1], [1.0])
    singular = grid(6, 0.0)
    G = sl.Factor(singular, null_pivots="skip")
    pinv = np.linalg.pinv(singular.toarray(), hermitian=True)
    assert np.allclose(G.pairs([3, 4], [4, 30]), pinv[[3, 4], [4, 30]], atol=1e-12)


def test_l_and_d_are_matrices(A, F):
    L, D, perm = F.factors()
    assert sp.issparse(L) and np.allclose((L @ D @ L.T).toarray(), A.toarray()[np.ix_(perm, perm)])
    assert np.array_equal(L.diagonal(), np.ones(400)) and (sp.triu(L, 1).nnz == 0)
    K = sp.bmat([[grid(3), np.ones((9, 1))], [np.ones((1, 9)), None]], format="csc")
    G = sl.Factor(K, pivoted=True)
    L, D, perm = G.factors()
    assert np.allclose((L @ D @ L.T).toarray(), K.toarray()[np.ix_(perm, perm)])
    zero = sl.Factor(sp.csc_matrix(np.array([[0, 1.0], [1.0, 0]])), pivoted=True)
    d, e = zero.pivots()
    assert np.count_nonzero(e) == 1
    F.close()
    for call in (F.lower, F.factors, F.pivots):
        with pytest.raises(sl.StateError):
            call()


def test_sparse_right_hand_sides(A, F):
    B = sp.random(400, 5, 0.01, format="csc", random_state=1)
    assert np.allclose(F.solve(B), F.solve(B.toarray()), atol=1e-14)
    assert np.allclose(F(B.tocoo()), F.solve(B.toarray()), atol=1e-14)
    with pytest.raises(sl.ArgumentError):
        F.solve(B[:399])


def test_matrices_from_triplets():
    T = sl.from_triplets(2, [0, 1, 1, 1], [0, 0, 1, 1], [2.0, -1.0, 1.0, 1.0])
    assert np.allclose(sl.Factor(T).solve([1.0, 0.0]), [2 / 3, 1 / 3])
    for wrong in (([2], [0], [1.0]), ([0, 1], [0], [1.0]), ([0], [0], [1.0, 2.0])):
        with pytest.raises(sl.ArgumentError):
            sl.from_triplets(2, *wrong)
