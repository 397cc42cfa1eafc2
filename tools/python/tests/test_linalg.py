"""spsolve, factorized, splu and operators for eigsh, against SciPy."""
import tracemalloc
import warnings

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse import linalg as scipys

import sparse_local as sl
from sparse_local import linalg
from systems import grid, right_hand_sides
from test_sksparse import NO_ORDER, complex_grid


def unsymmetric():
    A = grid(6).tolil()
    A[3, 4] = -0.7
    return A.tocsc()


def saddle():
    """[K B'; B 0]: zeros on the diagonal."""
    K, B = grid(6), sp.random(5, 36, 0.3, random_state=0)
    return sp.bmat([[K, B.T], [B, None]], format="csc")


CASES = {"grid": grid(6), "rows": grid(6).tocsr(), "coo": grid(6).tocoo(), "array":
         sp.csc_array(grid(6)), "float": grid(6).astype(np.float32), "int":
         (10 * grid(6)).astype(int), "unsymmetric": unsymmetric(), "triangular":
         sp.tril(grid(6)).tocsc(), "complex": complex_grid(6), "complex symmetric":
         (grid(6) + 1j * sp.identity(36)).tocsc(), "saddle": saddle(), "no order": NO_ORDER}


@pytest.mark.parametrize("name", CASES)
def test_any_matrix(name):
    A = CASES[name]
    n = A.shape[0]
    is_ours = name not in ("unsymmetric", "triangular", "complex symmetric")
    lu = linalg.splu(A)
    assert isinstance(lu, linalg.SymmetricLU) == is_ours and lu.shape == A.shape and lu.nnz > 0
    solve = linalg.factorized(A)
    tolerance = 1e-4 if name == "float" else 1e-9
    for b in (right_hand_sides(n), right_hand_sides(n, 3), np.ones((n, 1)),
              sp.random(n, 70, 0.2, format="csr", random_state=2), sp.csc_matrix(np.ones((n, 1)))):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", scipys.SparseEfficiencyWarning if hasattr(
                scipys, "SparseEfficiencyWarning") else sp.SparseEfficiencyWarning)
            x, y = linalg.spsolve(A, b), scipys.spsolve(A.tocsc(), b)
        assert x.shape == y.shape and sp.issparse(x) == sp.issparse(y)
        if not sp.issparse(b):
            assert x.dtype == y.dtype
            whole = A.toarray()
            for got in (x, solve(b).reshape(x.shape), lu.solve(b).reshape(x.shape)):
                assert np.allclose(whole @ got.reshape(b.shape), b, atol=tolerance)
            assert np.allclose(whole.T @ lu.solve(b, "T"), b, atol=tolerance)
            assert np.allclose(whole.conj().T @ lu.solve(b, "H"), b, atol=tolerance)
        assert abs(x - y).max() < tolerance * max(1, abs(y).max())


@pytest.mark.parametrize("kind", [sp.csc_matrix, sp.csc_array, sp.csr_matrix, sp.csr_array,
                                  sp.coo_matrix, sp.lil_array])
@pytest.mark.filterwarnings("ignore::scipy.sparse.SparseEfficiencyWarning")
def test_a_sparse_answer_has_the_class_that_scipy_gives_it(kind):
    for A in (kind(grid(6)), kind(unsymmetric())):
        for B in (sp.random(36, 5, 0.2, "csc"), sp.csr_array(sp.random(36, 5, 0.2))):
            assert type(linalg.spsolve(A, B)) is type(scipys.spsolve(A, B))


def test_splu_takes_sparse_right_hand_sides_and_rows():
    for A in (grid(6), complex_grid(6)):
        lu, B = linalg.splu(A), sp.random(36, 70, 0.1, format="coo", random_state=4)
        X = np.linalg.solve(A.toarray(), B.toarray())
        assert np.allclose(lu.solve(B), X) and np.allclose(linalg.factorized(A)(B), X)
        assert np.allclose(lu.solve(B, rows=[5, 0]), X[[5, 0]])
        assert np.allclose(lu.solve(B.toarray()[:, 0], rows=[7]), X[[7], 0])
        assert np.allclose(A.T @ lu.solve(B, "T"), B.toarray())


def test_slight_asymmetry_is_not_ignored():
    A = grid(6)
    rounded = A.copy()
    rounded[3, 4] *= 1 + 1e-15
    assert isinstance(linalg.splu(rounded), linalg.SymmetricLU)
    rounded[3, 4] *= 1 + 1e-11
    assert not isinstance(linalg.splu(rounded), linalg.SymmetricLU)


@pytest.mark.parametrize("kind", ["csc", "csr"])
def test_rounding_errors_of_a_hermitian_diagonal_are_ignored(kind):
    turn = sp.diags(np.exp(0.3j * np.arange(25)))
    A = (turn @ (grid(5) + 0.7 * sp.identity(25)) @ turn.conj()).asformat(kind)
    before = A.copy()
    assert 0 < abs(A.diagonal().imag).max() < 1e-14
    lu, b = linalg.splu(A), right_hand_sides(25) * (1 + 2j)
    assert isinstance(lu, linalg.SymmetricLU) and np.allclose(A @ lu.solve(b), b)
    assert np.array_equal(A.data, before.data)
    A[3, 3] += 1e-6j
    assert not isinstance(linalg.splu(A.tocsc()), linalg.SymmetricLU)
    assert np.allclose(A @ linalg.spsolve(A, b), b)


def test_what_is_refused_is_refused_as_by_scipy():
    with pytest.raises(TypeError, match="numpy.linalg.solve"):
        linalg.spsolve(np.eye(3), np.ones(3))
    for call in (linalg.splu, linalg.factorized, linalg.shift_invert,
                 lambda A: linalg.shift_invert(sp.identity(3), 1, A)):
        with pytest.raises(TypeError, match="numpy.linalg.solve"):
            call(np.eye(3))
    with pytest.raises(RuntimeError, match="singular"):
        linalg.splu(sp.csc_matrix((3, 3)))
    with pytest.warns(scipys.MatrixRankWarning):
        assert np.isnan(linalg.spsolve(sp.csc_matrix(np.ones((2, 2))), np.ones(2))).any()
    with pytest.raises(ValueError):
        linalg.splu(grid(3)).solve(np.ones(9), trans="X")
    with pytest.raises(ValueError):
        linalg.splu(grid(3)).solve(np.ones(8))
    with pytest.raises(ValueError):
        linalg.splu(grid(3)[:-1])


def test_eigenvalues():
    A, n = grid(12, 0.0), 144
    M = sp.diags(np.linspace(1, 2, n)).tocsc()
    for sigma in (-0.01, 0.3):
        for mass in (None, M):
            w = scipys.eigsh(A, 5, M=mass, sigma=sigma, which="LM",
                             OPinv=linalg.shift_invert(A, sigma, mass))[0]
            right = scipys.eigsh(A, 5, M=mass, sigma=sigma, which="LM")[0]
            assert np.allclose(np.sort(w), np.sort(right), atol=1e-10)
    F = sl.Factor(grid(5))
    inverse = linalg.operator(F)
    b = right_hand_sides(25, 3)
    assert np.array_equal(inverse @ b, F.solve(b)) and np.array_equal(inverse.T @ b, F.solve(b))
    H = complex_grid(4)
    inverse = linalg.operator(sl.Factor(H))
    assert inverse.dtype == complex and np.allclose(H @ (inverse @ np.ones(16)), 1)
    with pytest.raises(sl.PivotError):
        linalg.shift_invert(A, 0)
    assert linalg.shift_invert(A, 0, null_pivots="skip", mass=np.ones(n)).shape == A.shape


@pytest.mark.parametrize("A", [grid(9), complex_grid(9)], ids=["real", "complex"])
@pytest.mark.parametrize("count", [1, 64, 200])
def test_sparse_right_hand_sides_in_chosen_rows(A, count):
    F, n = sl.Factor(A), 81
    B = sp.random(n, count, 0.05, format="csr", random_state=3)
    X = F.solve(B.toarray())
    for right in (B, B.tocsc(), sp.coo_matrix(B), 1j * B):
        scale = 1j if right.dtype.kind == "c" else 1
        assert np.allclose(F.solve(right), scale * X)
        for rows in ([5, 3, 3, 80], np.arange(9), []):
            got = F.solve(right, rows=rows)
            assert got.shape == (len(rows), count) and np.allclose(got, scale * X[list(rows)])
    assert np.allclose(F.solve(B.toarray(), rows=[7, 2]), X[[7, 2]])
    assert np.allclose(F.solve(B.toarray()[:, 0], rows=[7]), X[[7], 0])
    with pytest.raises(sl.ArgumentError):
        F.solve(B, rows=[n])
    with pytest.raises(sl.ArgumentError):
        F.solve(B[:-1], rows=[0])


def test_sparse_right_hand_sides_take_the_memory_of_the_answer():
    A = grid(60)
    F, count = sl.Factor(A), 4000
    B = sp.csc_matrix((np.ones(count), (np.arange(count) % 3600, np.arange(count))),
                      shape=(3600, count))
    F.solve(B, rows=[1, 2])
    tracemalloc.start()
    F.solve(B, rows=[1, 2, 3])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10 * 3 * count * 8 < 3600 * count * 8 / 10
