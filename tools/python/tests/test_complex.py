"""Complex Hermitian matrices: every call against dense algebra."""
import pickle

import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from systems import grid


def connection(side=8, seed=2):
    """A connection Laplacian: each edge of a grid turns by an angle; plus a shift."""
    A = sp.triu(grid(side, 0.3), format="coo")
    angles = np.random.default_rng(seed).uniform(-3, 3, A.nnz)
    upper = sp.csc_matrix((np.where(A.row == A.col, A.data, A.data * np.exp(1j * angles)),
                           (A.row, A.col)), shape=A.shape)
    return (upper + sp.triu(upper, 1).conj().T).tocsc()


def vectors(*shape):
    rng = np.random.default_rng(4)
    return rng.standard_normal(shape) + 1j * rng.standard_normal(shape)


H = connection()
N = H.shape[0]
DENSE = H.toarray()


@pytest.mark.parametrize("form", ["csc", "csr", "lower", "upper", "csr-lower", "long"])
def test_forms(form):
    A = {"csc": H, "csr": H.tocsr(), "lower": sp.tril(H, format="csc"),
         "upper": sp.triu(H, format="csc"), "csr-lower": sp.tril(H, format="csr"),
         "long": H.copy()}[form]
    if form == "long":
        A.indices, A.indptr = A.indices.astype(np.int64), A.indptr.astype(np.int64)
    for b in (vectors(N), vectors(N, 3), np.asfortranarray(vectors(N, 3)), np.ones(N)):
        x = sl.Factor(A).solve(b)
        assert x.shape == b.shape and np.allclose(DENSE @ x, b)


@pytest.mark.parametrize("storage", ["double", "complex"])
def test_calls(storage):
    F = sl.Factor(H, storage=storage)
    inverse = np.linalg.inv(DENSE)
    b = vectors(2, 2)
    assert F.n == N and F.inertia == (N, 0, 0) and sorted(F.perm) == list(range(N))
    assert np.allclose(F.local([3, 9], b, [1, 60]), inverse[np.ix_([1, 60], [3, 9])] @ b)
    plan = F.plan([3, 9], [1, 60])
    assert np.array_equal(plan.solve(b), F.local([3, 9], b, [1, 60]))
    assert np.allclose(F.diagonal(), inverse.diagonal().real)
    assert np.allclose(F.diagonal([5, 3]), inverse.diagonal().real[[5, 3]])
    assert np.allclose(F.block([5, 3], [1, 2, 3]), inverse[np.ix_([5, 3], [1, 2, 3])])
    assert np.allclose(F.pairs([5, 3], [1, 2]), inverse[[5, 3], [1, 2]])
    sign, log = F.logdet()
    assert sign == 1 and log == pytest.approx(np.linalg.slogdet(DENSE)[1])
    L, D, perm = F.factors()
    assert np.allclose((L @ D @ L.conj().T).toarray(), DENSE[np.ix_(perm, perm)])
    x, error = F.refine(H, 0.9 * F.solve(vectors(N, 2)), vectors(N, 2))
    assert error < 1e-14 and np.allclose(DENSE @ x, vectors(N, 2))
    x, error = F.refine(H, 0.9 * F.solve(vectors(N)), vectors(N))
    assert x.shape == (N,) and np.allclose(DENSE @ x, vectors(N))
    half = F.solve_part("P L", vectors(N))
    assert np.allclose(F.solve_part("D LT PT", half), F.solve(vectors(N)))
    B = sp.csc_matrix(([1j], ([3], [0])), shape=(N, 2))
    assert np.allclose(F.solve(B), inverse @ B.toarray())
    F.refactor(2 * H)
    assert np.allclose(F.diagonal(), inverse.diagonal().real / 2)


def test_objects():
    F = sl.Factor(H)
    inverse = np.linalg.inv(DENSE)
    Z = sl.Selected(F)
    i, j = H.nonzero()
    assert np.allclose(Z.diagonal(), inverse.diagonal().real)
    assert np.allclose(Z.entries(i, j), inverse[i, j])
    rows = [27, 28, 35, 36]
    R = F.region(rows)
    b = vectors(4)
    assert np.allclose(F.plan(rows, rows, region=R).solve(b), inverse[np.ix_(rows, rows)] @ b)
    P = F.constraints([3, 9])
    x = P.solve(None, [1j, 2.0])
    assert np.allclose(x[[3, 9]], [1j, 2.0])
    assert np.allclose(np.delete(DENSE @ x, [3, 9]), 0, atol=1e-12)
    G = F.submatrix(H, [9, 3, 5, 4])
    assert np.allclose(G.solve(b), np.linalg.solve(DENSE[np.ix_([9, 3, 5, 4], [9, 3, 5, 4])], b))
    again = pickle.loads(pickle.dumps(F))
    assert np.array_equal(again.solve(vectors(N)), F.solve(vectors(N)))
    X = F.sample(20000, rng=np.random.default_rng(0))
    assert abs(X @ X.conj().T / 20000 - inverse).max() < 0.05 * abs(inverse).max()


def test_refusals():
    F = sl.Factor(H)
    bad = H.copy()
    bad.data[1] += 0.5
    with pytest.raises(sl.PatternError):
        sl.Factor(bad)
    with pytest.raises(sl.PatternError):
        sl.Factor(H + 2j * sp.csc_matrix(([1, 1], ([0, 1], [1, 0])), shape=H.shape))
    diagonal = sp.tril(H, format="csc")
    diagonal.data[0] += 1j
    with pytest.raises(sl.ArgumentError):
        sl.Factor(diagonal)
    for call in (lambda: F.change_entries(H, was=H), lambda: F.rank_update(sp.csc_matrix((N, 1))),
                 lambda: F.bilinear(None, np.ones(N), None, np.ones(N)), lambda: sl.Sum([H]),
                 lambda: F.constraints().add([0, 1], [1.0, 1.0]),
                 lambda: sl.Factor(H, mass=np.ones(N))):
        with pytest.raises(sl.UnsupportedError):
            call()
    with pytest.raises(sl.ArgumentError):
        F.local([N], [1.0], [0])
    with pytest.raises(TypeError):
        sl.Factor(grid(8)).refactor(H)
    with pytest.raises(sl.PivotError) as caught:
        sl.Factor(H - 2 * sp.identity(N), definite=True)
    assert 0 <= caught.value.row < N
    real = sl.Factor(H, null_tolerance=0.0)
    assert np.allclose(real.refactor((H.real + 0 * H).tocsc()).solve(np.ones(N)),
                       np.linalg.solve(DENSE.real, np.ones(N)))
