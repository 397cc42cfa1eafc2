"""The names of sksparse.cholmod: results against dense algebra, and what gives a signal."""
import subprocess
import sys
import warnings

import numpy as np
import pytest
import scipy.sparse as sp

from sparse_local.sksparse import cholmod
from systems import grid, right_hand_sides

ORDERS = tuple(cholmod._ordering_methods)


def complex_grid(side=4):
    A = sp.tril(grid(side), format="coo")
    turned = np.where(A.row > A.col, A.data * np.exp(1j * (A.row + 2.0 * A.col)), A.data)
    low = sp.csc_matrix((turned, (A.row, A.col)), shape=A.shape)
    return (low + sp.tril(low, -1).conj().T).tocsc()


NO_ORDER = sp.csc_matrix([[0.0, 1.0], [1.0, 0.0]])  # regular, with pivots of 0 in each order
CASES = [grid(5), complex_grid(5)]


@pytest.mark.parametrize("A", CASES, ids=["real", "complex"])
@pytest.mark.parametrize("ordering", ORDERS)
@pytest.mark.parametrize("beta", [0, 2.5])
def test_factors_and_solves(A, ordering, beta):
    f = cholmod.cholesky(A, beta, ordering_method=ordering)
    P, D = f.P(), f.D()
    dense = A.toarray() + beta * np.eye(25)
    permuted = dense[np.ix_(P, P)]
    if ordering == "natural":
        assert np.array_equal(P, np.arange(25))
    L, diagonal = f.L_D()
    assert np.allclose((L @ diagonal @ L.conj().T).toarray(), permuted)
    assert sp.triu(L, 1).nnz == 0 and np.allclose(L.diagonal(), 1) and D.shape == (25,)
    assert np.allclose((f.L() @ f.L().conj().T).toarray(), permuted)
    assert np.allclose(f.LD().toarray(), L.toarray() - np.eye(25) + np.diag(D))
    L, Q = L.toarray(), f.L().toarray()
    for b in (right_hand_sides(25), right_hand_sides(25, 3), np.arange(25)):
        for x, matrix in ((f(b), dense), (f.solve_A(b), dense), (f.solve_LDLt(b), permuted),
                          (f.solve_LD(b), L @ np.diag(D)), (f.solve_L(b), L),
                          (f.solve_DLt(b), np.diag(D) @ L.conj().T), (f.solve_Lt(b), L.conj().T),
                          (f.solve_D(b), np.diag(D)), (f.solve_L(b, False), Q),
                          (f.solve_Lt(b, False), Q.conj().T)):
            assert x.shape == b.shape and np.allclose(matrix @ x, b)
        assert np.array_equal(f.apply_P(b), b[P]) and np.allclose(f.apply_Pt(f.apply_P(b)), b)
    sign, log = np.linalg.slogdet(dense)
    assert f.logdet() == pytest.approx(log) and f.slogdet() == pytest.approx((1.0, log))
    assert f.det() == pytest.approx(np.exp(log))


def test_sparse_right_hand_sides_give_sparse_solutions():
    A = grid(5)
    f = cholmod.cholesky(A)
    B = sp.random(25, 70, 0.1, format="csr", random_state=0)
    X = f(B)
    assert sp.issparse(X) and np.allclose(A @ X.toarray(), B.toarray())
    assert f(sp.csc_matrix((25, 0))).shape == (25, 0)
    assert np.allclose(f.inv().toarray(), np.linalg.inv(A.toarray()))
    assert sp.issparse(f.solve_L(B)) and sp.issparse(f.apply_P(B))


@pytest.mark.parametrize("subtract", [False, True])
def test_updates(subtract):
    A, sign = grid(5), -1 if subtract else 1
    inside = 0.1 * sp.csc_matrix(([1.0, -1.0, 2.0], ([7, 8, 3], [0, 0, 1])), shape=(25, 2))
    beyond = 0.1 * sp.csc_matrix(([1.0, 1.0], ([0, 24], [0, 0])), shape=(25, 1))
    complex_one = sp.csc_matrix(([0.1j], ([4], [0])), shape=(25, 1))
    b = np.ones(25)
    for matrix, C in ((A, inside), (A, beyond), (complex_grid(5), complex_one)):
        for ordering in ("default", "natural"):
            f = cholmod.cholesky(matrix, ordering_method=ordering)
            kept = f.copy()
            f.update_inplace(C, subtract=subtract)
            wanted = (matrix + sign * (C @ C.conj().T)).toarray()
            assert np.allclose(wanted @ f(b), b) and np.allclose(matrix @ kept(b), b)
            f.update_inplace(C, subtract=not subtract)
            assert np.allclose(matrix @ f(b), b)
            L, P = f.L(), f.P()
            assert np.allclose((L @ L.conj().T).toarray(), matrix.toarray()[np.ix_(P, P)])
    with pytest.raises(cholmod.CholmodNotPositiveDefiniteError):
        cholmod.cholesky(A).update_inplace(10 * inside, subtract=True)
    with pytest.raises(cholmod.CholmodError):
        cholmod.cholesky(A).update_inplace(inside[:-1])


def test_products():
    A = sp.random(20, 40, 0.2, format="csc", random_state=3)
    f, b = cholmod.cholesky_AAt(A, beta=0.5), np.ones(20)
    dense = (A @ A.T).toarray() + 0.5 * np.eye(20)
    assert np.allclose(dense @ f(b), b)
    g = cholmod.analyze_AAt(A)
    g.cholesky_AAt_inplace(2 * A, beta=1)
    assert np.allclose((4 * (A @ A.T).toarray() + np.eye(20)) @ g(b), b)
    assert np.allclose(g.cholesky_AAt(A, 0.5)(b), f(b))
    fewer = sp.csc_matrix(A.multiply(np.arange(40) % 2))
    assert np.allclose(((fewer @ fewer.T).toarray() + np.eye(20)) @ g.cholesky_AAt(fewer, 1)(b), b)


def test_an_analysis_has_no_numbers():
    A, b = grid(5), np.ones(25)
    f = cholmod.analyze(A)
    assert sorted(f.P()) == list(range(25))
    for call in (f, f.solve_A, f.solve_LDLt, f.solve_L, f.apply_P, f.apply_Pt):
        with pytest.raises(cholmod.CholmodError):
            call(b)
    for call in (f.L, f.D, f.LD, f.L_D, f.logdet, f.inv, f.copy().L,
                 lambda: f.update_inplace(sp.csc_matrix((25, 1)))):
        with pytest.raises(cholmod.CholmodError):
            call()
    g = f.cholesky(3 * A)
    f.cholesky_inplace(A, beta=0)
    assert np.allclose(g(b) * 3, f(b))


def test_what_is_wrong_gives_a_signal():
    A, b = grid(5), np.ones(25)
    f = cholmod.cholesky(A)
    with pytest.raises(cholmod.CholmodInvalidError):
        cholmod.cholesky(sp.triu(A, format="csc"))  # only its diagonal would be read
    assert np.allclose(cholmod.cholesky(sp.tril(A, format="csc"))(b), f(b))
    damaged = A.tolil()
    damaged[3, 4] = -7.0
    with pytest.warns(cholmod.CholmodWarning, match="lower triangle"):
        assert np.allclose(cholmod.cholesky(damaged.tocsc())(b), f(b))
    with pytest.warns(cholmod.CholmodTypeConversionWarning):
        cholmod.cholesky(A.tocsr())
    with pytest.warns(cholmod.CholmodWarning, match="negative pivots"):
        g = cholmod.cholesky(-A)
    assert np.allclose(-A @ g(b), b)
    for call in (g.L, g.logdet, lambda: g.solve_L(b, False),
                 lambda: cholmod.cholesky(-A, mode="supernodal")):
        with pytest.raises(cholmod.CholmodNotPositiveDefiniteError) as caught:
            call()
        assert 0 <= caught.value.column < 25
    with pytest.raises(cholmod.CholmodNotPositiveDefiniteError) as caught:
        cholmod.cholesky(NO_ORDER)
    assert caught.value.column in (0, 1)
    text = str(caught.value)
    assert "not positive definite" in text and "options" not in text and "sl_" not in text
    assert "pivoted" not in text
    with pytest.raises(cholmod.CholmodError):
        f.cholesky_inplace(grid(6))
    more = A.tolil()
    more[20, 0] = more[0, 20] = 0.1
    with pytest.raises(cholmod.CholmodInvalidError, match="row 20, column 0"):
        f.cholesky_inplace(more.tocsc())
    bad = A.copy()
    bad.data[3] = np.nan
    with pytest.raises(cholmod.CholmodInvalidError):
        f.cholesky_inplace(bad)
    for wrong in (b[:-1], np.ones((1, 25)), 1j * b, np.full(25, np.nan), sp.identity(24)):
        with pytest.raises(cholmod.CholmodError):
            cholmod.cholesky(A)(wrong)
    for call in (lambda: cholmod.Factor(None), lambda: cholmod.cholesky(A, mode="fast"),
                 lambda: cholmod.cholesky(A, ordering_method="best of all"),
                 lambda: cholmod.cholesky(A[:-1]), lambda: cholmod.cholesky(np.eye(3)),
                 lambda: f.cholesky_inplace(A.astype(complex))):
        with pytest.raises(cholmod.CholmodError):
            call()


def test_a_failed_factor_refuses_solves():
    A, b = grid(5), np.ones(25)
    f = cholmod.cholesky(A)
    bad = A.copy()
    bad.data[:] = 0.0
    bad[0, 1] = bad[1, 0] = 1.0
    with pytest.raises(cholmod.CholmodNotPositiveDefiniteError):
        f.cholesky_inplace(bad)
    with pytest.raises(cholmod.CholmodError):
        f(b)
    f.cholesky_inplace(A)
    assert np.allclose(A @ f(b), b)


def closed_laplacian(n, seed):
    """A ring with random weights, as the Laplacian of a closed mesh: its last pivot is a rounding
    error of either sign."""
    rng, i = np.random.default_rng(seed), np.arange(n)
    w, j = rng.random(n) + 0.5, (i + 1) % n
    return sp.csc_matrix((np.r_[w, w, -w, -w], (np.r_[i, j, i, j], np.r_[i, j, j, i])),
                         shape=(n, n))


@pytest.mark.parametrize("seed", range(8))
def test_closed_meshes_are_solved_up_to_constants(seed):
    parts = [closed_laplacian(50 + 100 * seed, seed), 1e3 * closed_laplacian(40, seed), grid(3)]
    A = sp.block_diag(parts, format="csc")
    ends = np.cumsum([0] + [len(P.indptr) - 1 for P in parts])
    b = np.random.default_rng(seed).random((A.shape[0], 3))
    for k in (0, 1):
        b[ends[k]:ends[k + 1]] -= b[ends[k]:ends[k + 1]].mean(axis=0)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        f = cholmod.cholesky(A)
        x = f(b)
    assert abs(A @ x - b).max() < 1e-10 * abs(A).max() * abs(x).max()
    assert (f.D() == 0).sum() == 2 and (abs(x) < 1e-300).all(axis=1).sum() == 2
    assert f.logdet() == -np.inf and np.allclose(f.copy()(b), x)
    assert np.allclose((f.L() @ f.L().T).toarray(), A.toarray()[np.ix_(f.P(), f.P())], atol=1e-9)
    b[0] += 1.0  # no x solves this
    with pytest.warns(cholmod.CholmodWarning, match="no solution"):
        y = f(b)
    wrong = abs(A @ y - b).max(axis=1) > 1e-8
    assert wrong.sum() == 1  # the residual is in the null row of that component
    with pytest.warns(cholmod.CholmodWarning, match="no solution"):
        f(sp.csc_matrix(b))
    f.cholesky_inplace(A, beta=1.0)  # regular again
    assert np.allclose(A @ f(b) + f(b), b) and (f.D() > 0).all()
    f.cholesky_inplace(A)
    assert (f.D() == 0).sum() == 2


def test_programs_find_it_under_its_own_name():
    code = """
import sparse_local
sparse_local.stand_in("sksparse")
sparse_local.stand_in("qdldl")
from sksparse.cholmod import cholesky, CholmodError
import sksparse.cholmod, qdldl, numpy as np, scipy.sparse as sp
A = sp.csc_matrix([[4.0, 1.0], [1.0, 3.0]])
assert np.allclose(A @ cholesky(A)(np.ones(2)), 1)
assert np.allclose(A @ qdldl.Solver(A).solve([1, 1]), 1)
try:
    sparse_local.stand_in("numpy")
except ValueError:
    print("done")
"""
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert out.stdout == "done\n", out.stderr
    code = "import sys, sparse_local; sys.modules['qdldl'] = sys; sparse_local.stand_in('qdldl')"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "imported already" in out.stderr


def test_no_warning_without_a_cause():
    with warnings.catch_warnings():
        warnings.simplefilter("error", cholmod.CholmodWarning)
        for A in CASES:
            cholmod.cholesky(A).copy()
