"""The names of sksparse 0.5: results against dense algebra, and what gives a signal."""
import subprocess
import sys
import warnings

import numpy as np
import pytest
import scipy.sparse as sp

from sparse_local.sksparse05 import amd, cholmod
from systems import grid, right_hand_sides
from test_sksparse import NO_ORDER, closed_laplacian, complex_grid

CASES = [grid(5), complex_grid(5)]
ORDERS = tuple(cholmod._orders)


def dense(matrix):
    return matrix.toarray() if sp.issparse(matrix) else matrix


@pytest.mark.parametrize("A", CASES, ids=["real", "complex"])
@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("lower", [False, True])
def test_matrices(A, order, lower):
    whole, n = A.toarray(), A.shape[0]
    for beta in (0.0, 2.5):
        got = cholmod.cholesky(A, beta, lower=lower, order=order)
        R, p = (got, np.arange(n)) if order is None else got
        permuted = (whole + beta * np.eye(n))[np.ix_(p, p)]
        L = dense(R) if lower else dense(R).conj().T
        assert np.allclose(L @ L.conj().T, permuted) and np.allclose(L, np.tril(L))
        got = cholmod.ldl(A, beta, lower=lower, order=order)
        R, D, p = got if order is not None else got + (np.arange(n),)
        permuted = (whole + beta * np.eye(n))[np.ix_(p, p)]
        L = dense(R) if lower else dense(R).conj().T
        assert np.allclose(L @ D.toarray() @ L.conj().T, permuted) and np.allclose(L.diagonal(), 1)


@pytest.mark.parametrize("A", CASES, ids=["real", "complex"])
@pytest.mark.parametrize("make", [cholmod.cho_factor, cholmod.ldl_factor])
@pytest.mark.parametrize("order", [None, "default"])
def test_factors(A, make, order):
    whole, n = A.toarray(), A.shape[0]
    f = make(A, order=order)
    for b in (right_hand_sides(n), right_hand_sides(n, 3), sp.csc_array(right_hand_sides(n, 2))):
        x = f.solve(b)
        assert sp.issparse(x) == sp.issparse(b) and np.allclose(whole @ dense(x), dense(b))
    p = f.get_perm()
    assert np.array_equal(p, f.perm) and f.N == n and f.is_ll == (make is cholmod.cho_factor)
    assert f.is_lower == (make is cholmod.ldl_factor) and f.order == (order or "natural")
    L = f.get_factor("LL", lower=True).toarray()
    assert np.allclose(L @ L.conj().T, whole[np.ix_(p, p)])
    assert np.allclose(f.get_factor("LL", lower=False).toarray(), L.conj().T)
    unit, D = f.get_factor("LDL", lower=True)
    assert np.allclose((unit @ D @ unit.conj().T).toarray(), whole[np.ix_(p, p)])
    assert np.array_equal(f.colcount >= (abs(L) > 0).sum(0), np.ones(n, bool))
    assert f.nnz == f.colcount.sum() and f.dtype == A.dtype and f.itype == np.int32
    assert np.allclose(f.factor.toarray(), L if f.is_ll else
                       unit.toarray() - np.eye(n) + D.toarray())
    log = np.linalg.slogdet(whole)[1]
    assert np.allclose((f.logdet(), f.slogdet()[1], np.log(f.det())), log)
    assert np.allclose(f.inv().toarray(), np.linalg.inv(whole)) and 0 < f.rcond < 1
    g = f.copy()
    assert f.factorize(2 * A) is f and np.allclose(2 * whole @ f.solve(np.ones(n)), 1)
    assert np.allclose(whole @ g.solve(np.ones(n)), 1) and g.is_ll == f.is_ll
    assert "CholeskyFactor" in repr(f)


def test_analysis_comes_first():
    A = grid(5)
    f = cholmod.CholeskyFactor(A, order="amd")
    assert sorted(f.perm) == list(range(25)) and f.nnz > A.nnz / 2
    for call in (lambda: f.solve(np.ones(25)), f.logdet, f.get_factor, lambda: f.rowdel(3)):
        with pytest.raises(cholmod.CholmodError):
            call()
    assert np.allclose(A @ f.factorize(A).solve(np.ones(25)), 1) and f.is_ll
    f.factorize(A, ldl=True, beta=1.0)
    assert not f.is_ll and np.allclose(A @ f.solve(np.ones(25)) + f.solve(np.ones(25)), 1)


@pytest.mark.parametrize("kind", ["row", "col"])
def test_products(kind):
    B = sp.random(20, 30, 0.3, format="csc", random_state=1)
    M = B @ B.T if kind == "row" else B.T @ B
    f = cholmod.cho_factor(B, 0.5, sym_kind=kind, order="amd")
    assert np.allclose((M + 0.5 * sp.identity(M.shape[0])) @ f.solve(np.ones(M.shape[0])), 1)


def test_one_triangle_is_read():
    A = grid(5)
    for lower, half, other in ((True, sp.tril, sp.triu), (False, sp.triu, sp.tril)):
        f = cholmod.cho_factor(half(A, format="csc"), lower=lower)
        assert np.allclose(A @ f.solve(np.ones(25)), 1)
        with pytest.raises(cholmod.CholmodInvalidInputError, match="stores only"):
            cholmod.cho_factor(other(A, format="csc"), lower=lower)
        damaged = (half(A) + 3 * other(A, 1 if lower else -1)).tocsc()
        with pytest.warns(cholmod.CholmodWarning, match="triangle is read"):
            f = cholmod.cho_factor(damaged, lower=lower)
        assert np.allclose(A @ f.solve(np.ones(25)), 1)


@pytest.mark.parametrize("A", CASES, ids=["real", "complex"])
@pytest.mark.parametrize("order", [None, "amd"])
@pytest.mark.parametrize("make", [cholmod.cho_factor, cholmod.ldl_factor])
def test_changes(A, order, make):
    b, n = np.ones(25), 25
    f, whole = make(A, order=order), A.toarray()
    for C in (0.1 * sp.csc_array(([1.0, -1.0], ([7, 8], [0, 0])), shape=(n, 1)),
              0.1 * sp.csc_array(([1.0, 1.0], ([0, 24], [0, 0])), shape=(n, 1))):
        CC = (C @ C.conj().T).toarray()
        assert np.allclose((whole + CC) @ f.update(C).solve(b), b)
        assert np.allclose(whole @ f.downdate(C).solve(b), b)
    f, p = make(A, order=order), make(A, order=order).get_perm()
    place = np.argsort(p)  # rows are numbered in the order of the factor
    for k in (12, 0, 24):
        without = whole.copy()
        without[k], without[:, k] = 0, 0
        without[k, k] = 1
        assert np.allclose(without @ f.rowdel(place[k]).solve(b), b)
        f.rowadd(place[k], sp.csc_array(A[p][:, [k]]))
        assert np.allclose(whole @ f.solve(b), b)
    more = whole.copy()
    more[0, 24] = more[24, 0] = 0.05  # an entry that was not analyzed
    assert np.allclose(more @ f.rowadd(place[24], sp.csc_array(more[p][:, [24]])).solve(b), b)
    assert np.array_equal(f.get_perm(), p)
    f.rowadd(place[24], sp.csc_array(A[p][:, [24]]))
    fill = f.nnz
    f.resymbol(A[p][:, p]) if order else f.resymbol(A, is_permuted=False)
    assert f.nnz <= fill and np.allclose(whole @ f.solve(b), b)
    with pytest.raises(cholmod.CholmodInvalidInputError):
        f.resymbol(sp.identity(n, format="csc"))
    assert np.allclose(whole @ f.solve(b), b)


def test_the_order_is_one_of_little_fill_unless_none():
    A = grid(30)
    (R, p), (unit, D, q) = cholmod.cholesky(A), cholmod.ldl(A)
    natural, f = cholmod.cholesky(A, order=None), cholmod.CholeskyFactor(A)
    assert np.allclose((R.T @ R).toarray(), A[p][:, p].toarray()) and R.nnz < 0.7 * natural.nnz
    assert np.allclose((unit @ D @ unit.T).toarray(), A[q][:, q].toarray())
    assert np.allclose((natural.T @ natural).toarray(), A.toarray())
    fills = [g.nnz for g in (f, cholmod.cho_factor(A), cholmod.ldl_factor(A))]
    assert max(fills) < 0.7 * natural.nnz and f.order == "default"
    assert len(cholmod.ldl(A, order=None)) == 2
    x = cholmod.cho_solve(A, np.ones(900), 0.5)
    assert np.allclose(A @ x + 0.5 * x, 1)
    half = cholmod.cho_solve(sp.tril(A, format="csc"), np.ones((900, 2)), lower=True, order="amd")
    assert np.allclose(A @ half, 1)


@pytest.mark.parametrize("A", CASES, ids=["real", "complex"])
@pytest.mark.parametrize("order", [None, "default"])
@pytest.mark.parametrize("make", [cholmod.cho_factor, cholmod.ldl_factor])
@pytest.mark.parametrize("lower", [False, True])
def test_parts_and_their_systems(A, order, make, lower):
    f = make(A, order=order, lower=lower)
    for kind in (None, "LL", "LDL", "LDL"):
        assert f.change_factor(kind) is f and f.is_ll == (kind == "LL" or kind is None and
                                                          make is cholmod.ldl_factor)
        L, R, D = f.L, f.R, f.D.toarray()
        assert np.allclose(L.toarray(), np.tril(L.toarray())) and f.sym_kind == "sym"
        assert np.allclose(R.toarray(), L.toarray().conj().T)
        assert np.allclose(L @ D @ R, A[f.perm][:, f.perm].toarray())
        assert (D == np.eye(25)).all() if f.is_ll else np.allclose(L.diagonal(), 1)
        products = {"LDLt": L @ D @ R, "LD": L @ D, "DLt": D @ R, "L": L, "Lt": R, "D": D,
                    "A": A}
        for system, M in products.items():
            for b in (right_hand_sides(25), right_hand_sides(25, 3),
                      sp.csc_array(right_hand_sides(25, 2))):
                x = f.solve(b, system=system)
                assert sp.issparse(x) == sp.issparse(b) and np.allclose(M @ dense(x), dense(b))
            assert isinstance(x, sp.csc_array)  # whose * is not that of csc_matrix
            assert not np.shares_memory(x.data, b.data)
    with pytest.raises(ValueError, match="system"):
        f.solve(np.ones(25), system="P")
    with pytest.raises(ValueError, match="read-only"):
        f.factor.data[0] = 1.0
    with pytest.raises(cholmod.CholmodNotPositiveDefiniteError):
        cholmod.ldl_factor(-A).change_factor("LL")
    with pytest.raises(cholmod.CholmodError):
        cholmod.CholeskyFactor(A).change_factor()


@pytest.mark.parametrize("dtype", [np.float32, np.complex64, np.float64, np.complex128, np.int64])
def test_results_have_the_type_of_the_matrix(dtype):
    A = (10 * grid(5) + 5 * sp.identity(25)).astype(np.int64).astype(dtype).tocsc()
    of = np.dtype(dtype if dtype != np.int64 else np.float64)
    f = cholmod.cho_factor(A)
    b = np.ones(25, dtype=np.float16)
    L, D = f.get_factor("LDL")
    for part in (f, f.copy(), f.solve(b), f.solve(sp.csc_matrix(b[:, None])), f.factor, f.L, f.R,
                 f.D, L, D, f.get_factor(), f.inv(), f.det(), f.slogdet()[0],
                 f.solve(b, system="L"), f.solve(b, system="D"), cholmod.cholesky(A)[0]):
        assert part.dtype == of
    assert np.allclose(A @ f.solve(b), 1, rtol=1e-5)
    with pytest.raises(TypeError, match="does not hold"):
        f.solve(np.ones(25, np.complex64 if of.kind == "f" else np.longdouble))
    if of.itemsize == 4:
        with pytest.raises(TypeError):
            f.solve(np.ones(25))


def test_pivots_that_are_far_apart_are_a_warning():
    A = sp.diags([1.0, 1e-15, 2.0, 1.0], format="csc")
    f = cholmod.CholeskyFactor(A)
    assert f.rcond == -1 and not f.is_numeric
    f.factorize(A)
    assert f.is_numeric and np.isclose(f.rcond, 0.5e-15, atol=0)
    with pytest.warns(cholmod.CholmodWarning, match="nearly singular"):
        f.solve(np.ones(4))
    f.factorize(sp.identity(4, format="csc"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert f.rcond == 1 and np.allclose(f.solve(np.ones(4)), 1)
    C = sp.csc_matrix(([3.0], ([1], [0])), shape=(4, 1))
    assert np.isclose(f.update(C).rcond, 0.1) and np.isclose(f.downdate(C).rcond, 1)


def test_singular_matrices():
    A = closed_laplacian(60, 1)
    b = np.random.default_rng(0).standard_normal(60)
    b -= b.mean()
    for make in (cholmod.cho_factor, cholmod.ldl_factor):
        f = make(A)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            x = f.solve(b)
        assert np.allclose(A @ x, b) and f.logdet() == -np.inf and f.rcond == 0
        with pytest.warns(cholmod.CholmodWarning, match="no solution"):
            f.solve(b + 1)


def test_what_is_wrong_gives_a_signal():
    A, b = grid(5), np.ones(25)
    for make in (cholmod.cho_factor, cholmod.cholesky):
        with pytest.raises(cholmod.CholmodNotPositiveDefiniteError):
            make(-A)
    f = cholmod.ldl_factor(-A)
    assert np.allclose(-A @ f.solve(b), b)
    with pytest.raises(cholmod.CholmodNotPositiveDefiniteError):
        f.get_factor("LL")
    with pytest.raises(cholmod.CholmodNotPositiveDefiniteError) as caught:
        cholmod.ldl(NO_ORDER)
    assert "options" not in str(caught.value) and "sl_" not in str(caught.value)
    for call in (lambda: cholmod.cho_factor(A, order="fast"),
                 lambda: cholmod.cho_factor(A, sym_kind="both"),
                 lambda: cholmod.cho_factor(A, supernodal_mode=3),
                 lambda: cholmod.cho_factor(A[:-1]), lambda: f.factorize(A, ldl=1),
                 lambda: f.factorize(A, lower="yes"), lambda: f.solve(b[:-1]),
                 lambda: f.solve([1.0] * 25), lambda: f.update(b), lambda: f.rowadd(3, b),
                 lambda: f.get_factor("QR"), lambda: cholmod.etree(A, kind="all"),
                 lambda: cholmod.etree(A[:-1]), lambda: f.resymbol(grid(4))):
        with pytest.raises(ValueError):
            call()
    for k in (25, -1):
        with pytest.raises(IndexError):
            f.rowdel(k)
    bad = A.copy()
    bad.data[3] = np.nan
    with pytest.raises(cholmod.CholmodInvalidInputError):
        f.factorize(bad)
    assert cholmod.cho_factor(A.toarray()).solve(b).shape == (25,)  # anything that SciPy takes
    turned = sp.csc_matrix(np.array([[4, 1j], [-1j, 3 + 1e-3j]]))
    with pytest.raises(cholmod.CholmodInvalidInputError, match="diagonal.* imaginary part.*row 1"):
        cholmod.cho_factor(turned)


def is_postorder(parent, post):
    place = np.argsort(post)
    size = np.ones(parent.size, dtype=int)
    for row in post:
        if parent[row] >= 0:
            size[parent[row]] += size[row]
    rows = np.flatnonzero(parent >= 0)
    return sorted(post) == list(range(parent.size)) and all(
        place[parent[r]] - size[parent[r]] < place[r] < place[parent[r]] for r in rows)


@pytest.mark.parametrize("kind", [None, "sym", "lo", "row", "col"])
def test_trees_and_patterns(kind):
    A = sp.random(30, 30, 0.08, format="csc", random_state=4)
    M = {"row": A @ A.T, "col": A.T @ A, "lo": sp.tril(A), None: sp.triu(A)}.get(kind, sp.triu(A))
    M = (M + M.T).toarray() != 0
    L = np.linalg.cholesky(np.where(M, -1.0, 0) * (1 - np.eye(30)) + 40 * np.eye(30)) != 0
    below = [np.flatnonzero(L[k + 1:, k]) for k in range(30)]
    parent = np.array([k + 1 + rows[0] if rows.size else -1 for k, rows in enumerate(below)])
    assert np.array_equal(cholmod.etree(A, kind=kind), parent)
    tree, post = cholmod.etree(A, kind=kind, return_post=True)
    assert np.array_equal(tree, parent) and is_postorder(parent, post)
    count, h, tree, post, pattern = cholmod.symbfact(A, kind=kind, lower=True, return_factor=True)
    assert np.array_equal(count, L.sum(0)) and np.array_equal(tree, parent)
    assert np.array_equal(pattern.toarray(), L) and len(cholmod.symbfact(A, kind=kind)) == 4
    assert np.array_equal(cholmod.symbfact(A, kind=kind, return_factor=True)[4].toarray(), L.T)
    depth = [0] * 30
    for k in range(29, -1, -1):
        depth[k] = 1 + (depth[parent[k]] if parent[k] >= 0 else 0)
    assert h == max(depth)


@pytest.mark.parametrize("A", [grid(40), grid(3), sp.block_diag([grid(30)] * 2, format="csc"),
                               sp.identity(7, format="csc"), sp.csc_matrix((0, 0))])
def test_orders_and_separators(A):
    n = A.shape[0]
    for p in (cholmod.metis(A), cholmod.nesdis(A), amd.amd(A), amd.amd(sp.triu(A))):
        assert sorted(p) == list(range(n))
    side = cholmod.bisect(A)
    C = A.tocoo()
    assert side.shape == (n,) and not ((side[C.row] == 0) & (side[C.col] == 1)).any()
    if n > 100:
        sizes = np.bincount(side, minlength=3)
        assert min(sizes[:2]) > 0.3 * n and sizes[2] < 0.1 * n
    p, tree = cholmod.nesdis(A, return_separator=True)
    assert sorted(p) == list(range(n)) and len(tree.cmember) == n
    for pruned in (tree, tree.prune(nd_small=50), tree.prune(nd_small=10 ** 6)):
        parents = pruned.cp
        assert all(up == -1 or up > c for c, up in enumerate(parents))
        above = np.zeros((len(parents),) * 2, dtype=bool)
        for c in range(len(parents) - 1, -1, -1):
            above[c, c] = True
            if parents[c] >= 0:
                above[c] |= above[parents[c]]
        i, j = pruned.cmember[C.row], pruned.cmember[C.col]
        assert (above[i, j] | above[j, i]).all()  # an edge joins a part and one above it
    assert len(tree.prune(nd_small=10 ** 6).cp) <= max(2, n and (n < 10) * n)
    assert len(cholmod.nesdis(A, return_separator=True, nd_small=60)[1].cp) <= len(tree.cp)


def test_versions_are_chosen_by_name():
    code = """
import sparse_local
sparse_local.stand_in("qdldl")
sparse_local.stand_in("sksparse", "0.5.0")
from sksparse.cholmod import cho_factor, cholesky
from sksparse.amd import amd
import scipy.sparse as sp, numpy as np
A = sp.csc_matrix([[4.0, 1.0], [1.0, 3.0]])
R, p = cholesky(A)
assert np.allclose((R.T @ R).toarray(), A[p][:, p].toarray()) and len(amd(A)) == 2
for wrong in (("sksparse", "0.6"), ("0.5",), ("qdldl", "0.5"), ("qdldl", "sksparse")):
    try:
        sparse_local.stand_in(*wrong)
    except ValueError as error:
        assert "sksparse 0.5" in str(error)
    else:
        raise SystemExit("accepted %r" % (wrong,))
try:
    sparse_local.stand_in("sksparse")
except RuntimeError:
    print("done")
"""
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert out.stdout == "done\n", out.stderr
