"""The package against scipy.sparse.linalg.splu: every call on factors, plans and files."""
import gc
import pickle

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

import sparse_local as sl
from systems import grid, right_hand_sides


# ---- full solves ----

@pytest.mark.parametrize("form", ["csc", "csr", "coo", "lower", "upper", "csr-lower"])
def test_forms_of_a_matrix(A, form):
    B = {"csc": A, "csr": A.tocsr(), "coo": A.tocoo(), "lower": sp.tril(A, format="csc"),
         "upper": sp.triu(A, format="csc"), "csr-lower": sp.tril(A, format="csr")}[form]
    b = right_hand_sides(400)
    assert np.allclose(sl.Factor(B).solve(b), splu(A).solve(b), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("turn", ["tocsc", "tocsr"])
def test_one_triangle_of_two(A, turn):
    damaged = A.tolil()
    damaged[0, 399] = 7.0
    damaged[3, 2] = 50.0
    b = right_hand_sides(400)
    upper = sp.triu(damaged)
    wanted = splu((upper + upper.T - sp.diags(upper.diagonal())).tocsc()).solve(b)
    assert np.allclose(sl.Factor(getattr(damaged, turn)(), triangle="upper").solve(b), wanted)


@pytest.mark.parametrize("count", [1, 2, 8, 13])
@pytest.mark.parametrize("order", ["C", "F", "strided"])
def test_layouts_of_right_hand_sides(A, F, count, order):
    B = right_hand_sides(400, count)
    if order == "strided":
        wide = np.zeros((800, 3 * count))
        wide[::2, ::3] = B
        given = wide[::2, ::3]
    else:
        given = np.array(B, order=order)
    X = F.solve(given)
    assert X.shape == B.shape
    assert np.allclose(X, splu(A).solve(B), rtol=1e-12, atol=1e-12)
    assert np.array_equal(np.asarray(given), B)


def test_numbers_of_other_types(F):
    b = np.arange(400)
    assert np.array_equal(F.solve(b), F.solve(b.astype(float)))
    assert np.array_equal(F.solve(list(b)), F.solve(b))
    assert np.allclose(F.solve(b + 2j * b), F.solve(b) * (1 + 2j))
    with pytest.raises(TypeError):
        F.solve(np.array(["a"] * 400))


def test_arrays_are_used_in_place(A):
    from sparse_local._matrix import Matrix
    for B in (A, A.tocsr()):
        matrix = Matrix(B)
        assert np.shares_memory(matrix.x, B.data)
        assert np.shares_memory(matrix.i, B.indices)
        assert np.shares_memory(matrix.p, B.indptr)


def test_long_indices_and_unsorted_rows(A):
    b = right_hand_sides(400)
    wanted = sl.Factor(A).solve(b)
    long = A.copy()
    long.indices, long.indptr = long.indices.astype(np.int64), long.indptr.astype(np.int64)
    assert np.array_equal(sl.Factor(long).solve(b), wanted)
    turned = A.copy()
    for j in range(400):
        part = slice(A.indptr[j], A.indptr[j + 1])
        turned.indices[part] = A.indices[part][::-1]
        turned.data[part] = A.data[part][::-1]
    assert np.allclose(sl.Factor(turned).solve(b), wanted, rtol=1e-13)


def test_refactor(A, F):
    b = right_hand_sides(400)
    x = F.solve(b)
    assert np.allclose(F.refactor(2 * A).solve(b), x / 2, rtol=1e-13)
    with pytest.raises(sl.PatternError):
        F.refactor(grid(19))
    assert np.allclose(F.solve(b), x / 2, rtol=1e-13)
    damaged = A.copy()
    damaged.data[A.indptr[7]:A.indptr[8]] = np.nan
    damaged = sp.tril(damaged, format="csc") + sp.tril(damaged, -1, format="csc").T
    with pytest.raises(sl.NotFiniteError):
        sl.Factor(damaged, triangle="lower")


def test_options(A):
    b = right_hand_sides(400)
    x = sl.Factor(A).solve(b)
    natural = sl.Factor(A, ordering="natural")
    given = sl.Factor(A, perm=np.random.default_rng(0).permutation(400))
    for F in (natural, given):
        assert np.allclose(F.solve(b), x, rtol=1e-11)
        assert sorted(F.perm) == list(range(400))
    assert F.stats["factor"]["positive"] == 400 and "400 rows" in repr(F)
    for wrong in ({"ordering": "best"}, {"ordering": "given"}, {"null_pivots": "x"},
                  {"triangle": "both"}, {"perm": [0, 1]}, {"perm": np.zeros(400, dtype=int)},
                  {"mass": np.ones(3)}):
        with pytest.raises(sl.ArgumentError):
            sl.Factor(A, **wrong)


# ---- local solves, the inverse ----

def test_local_solves_have_the_bits_of_full_ones(A, F):
    b = np.zeros(400)
    b[[17, 300]] = [2.0, -1.0]
    full = F.solve(b)
    assert np.array_equal(F.local([17, 300], [2.0, -1.0], [5, 399, 5]), full[[5, 399, 5]])
    assert np.array_equal(F.local(np.array([17, 300]), [2.0, -1.0], None), full)
    assert np.array_equal(F.local(None, b, [5]), full[[5]])
    plan = F.plan([17, 300], [5, 399])
    assert np.array_equal(plan.solve([2.0, -1.0]), full[[5, 399]])
    assert plan.stats["x_columns"] > 0 and (plan.nb, plan.nx) == (2, 2)
    B = right_hand_sides(2, 5)
    assert np.array_equal(plan.solve(B), F.local([17, 300], B, [5, 399]))
    assert np.array_equal(plan.solve(np.asfortranarray(B)), plan.solve(B))
    assert F.local([], [], [3]).tolist() == [0.0] and F.local([3], [1.0], []).size == 0


def test_regions(A, F):
    rows = [205, 206, 225, 226]
    R = F.region(rows)
    plan = F.plan(rows, rows, region=R)
    b = right_hand_sides(4)
    assert plan.stats["in_region"] == 1 and R.stats["rows"] >= 4
    assert np.allclose(plan.solve(b), F.local(rows, b, rows), rtol=1e-12)
    for most in (-1, 0.5):
        with pytest.raises(sl.ArgumentError):
            F.region(rows, max_bytes=most)
    assert R.stats["boundary"] > 0 and F.region(rows, max_bytes=0).stats["boundary"] == 0
    assert F.region(rows, max_bytes=10 ** 9).stats["boundary"] == R.stats["boundary"]
    F.refactor(2 * A)
    with pytest.raises(sl.StateError):
        plan.solve(b)
    R.refactor()
    assert np.allclose(plan.solve(b), F.local(rows, b, rows), rtol=1e-12)


def test_a_selected_inverse_has_entries_of_the_inverse(A, F):
    inverse = np.linalg.inv(A.toarray())
    Z = sl.Selected(F)
    i, j = A.nonzero()
    assert np.allclose(Z.diagonal(), inverse.diagonal()) and Z.stats["columns"] == 400
    assert np.allclose(Z.entries(i, j), inverse[i, j])
    few = sl.Selected(F, [7])
    assert few.stats["columns"] < 400 and np.allclose(few.diagonal([7]), inverse[7, 7])
    absent = set(range(400)) - {int(r) for r in F.perm[-200:]}
    with pytest.raises(sl.PatternError):
        few.diagonal(sorted(absent))
    with pytest.raises(sl.ArgumentError):
        Z.entries([1, 2], [1])
    with pytest.raises(sl.ArgumentError):
        Z.diagonal([400])
    F.refactor(2 * A)
    assert np.allclose(Z.diagonal(), inverse.diagonal())  # of the old numbers
    Z.refactor()
    assert np.allclose(Z.diagonal(), inverse.diagonal() / 2)


@pytest.mark.parametrize("mapped", [False, True])
@pytest.mark.parametrize("storage", ["double", "float"])
def test_saved_sets_have_the_same_bits(A, tmp_path, mapped, storage):
    F = sl.Factor(A, storage=storage)
    rows, b = [205, 206, 225, 226], right_hand_sides(4)
    Z, R = sl.Selected(F), F.region(rows)
    path = tmp_path / "set.slf"
    sl.save_set(path, F, selected=Z, regions=[R, F.region([3])])
    G, Y, regions = sl.load_set(path, map=mapped, checks="verified")
    x = F.plan(rows, rows, region=R).solve(b)
    assert np.array_equal(G.plan(rows, rows, region=regions[0]).solve(b), x)
    assert len(regions) == 2 and regions[0].stats["boundary"] == R.stats["boundary"]
    assert np.array_equal(Y.diagonal(), Z.diagonal())
    whole = right_hand_sides(400)
    assert np.array_equal(G.solve(whole), F.solve(whole))
    assert np.array_equal(sl.Factor.load(path).solve(whole), F.solve(whole))
    if mapped:
        for change in (Y.refactor, regions[0].refactor, lambda: G.refactor(A)):
            with pytest.raises(sl.StateError):
                change()
    else:
        G.refactor(2 * A)
        Y.refactor()
        regions[0].refactor()
        assert np.allclose(Y.diagonal(), Z.diagonal() / 2)
        assert np.allclose(G.plan(rows, rows, region=regions[0]).solve(b), x / 2)
    del G
    gc.collect()
    assert Y.diagonal([5]).shape == (1,)  # it keeps what it borrows


def test_sets_are_of_one_factor(A, F, tmp_path):
    Z, R = sl.Selected(F), F.region([3])
    other = sl.Factor(2 * A)
    for selected, regions in ((Z, ()), (None, [R])):
        with pytest.raises(sl.StateError):
            sl.save_set(tmp_path / "x.slf", other, selected=selected, regions=regions)
    assert not (tmp_path / "x.slf").exists()
    F.save(tmp_path / "f.slf")
    G, selected, regions = sl.load_set(tmp_path / "f.slf")
    assert selected is None and regions == [] and G.n == 400
    with pytest.raises(sl.ArgumentError):
        sl.load_set(tmp_path / "f.slf", triangle="left")
    with pytest.raises(sl.Error):
        sl.load_set(tmp_path / "none.slf")


def test_l_in_float(A):
    b = right_hand_sides(400)
    exact = splu(A).solve(b)
    F = sl.Factor(A, storage="float")
    x = F.solve(b)
    error = np.abs(x - exact).max() / np.abs(exact).max()
    assert 1e-10 < error < 1e-5
    assert F.stats["factor"]["bytes"] < 0.9 * sl.Factor(A).stats["factor"]["bytes"]
    x, backward = F.refine(A, x, b, steps=3)
    assert backward < 1e-14 and np.allclose(x, exact, rtol=1e-12, atol=1e-13)
    with pytest.raises(sl.ArgumentError):
        sl.Factor(A, storage="half")


def test_inverse_and_determinant(A, F):
    inverse = np.linalg.inv(A.toarray())
    assert np.allclose(F.diagonal(), inverse.diagonal())
    assert np.allclose(F.diagonal([7, 3]), inverse.diagonal()[[7, 3]])
    assert np.allclose(F.block([1, 2], [300, 4, 5]), inverse[np.ix_([1, 2], [300, 4, 5])])
    sign, log = F.logdet()
    assert np.allclose((sign, log), np.linalg.slogdet(A.toarray()))
    exact = 1 / (np.linalg.norm(inverse, 1) * np.linalg.norm(A.toarray(), 1))
    assert exact * 0.999 <= F.rcond(A) <= 3 * exact
    b = right_hand_sides(400, 3)
    X, error = F.refine(A, 0.9 * F.solve(b), b)
    assert error < 1e-14 and np.allclose(A @ X, b)


@pytest.mark.parametrize("certainty", ["estimated", "guaranteed"])
def test_bounds_hold(A, F, certainty):
    rows = [5, 17, 399]
    plan = F.plan(rows, None)
    B = right_hand_sides(3, 4)
    with pytest.raises(sl.StateError):
        plan.solve_bounded(B)
    eta = F.certify(A, certainty=certainty)
    assert 0 < eta < 1e-6
    full = np.zeros((400, 4))
    full[rows] = B
    exact = F.solve(full)
    residual = np.longdouble(full) - A.astype(np.longdouble).toarray() @ np.longdouble(exact)
    exact = np.longdouble(exact) + F.solve(np.float64(residual))
    for b, wanted in ((B, exact), (B[:, 0], exact[:, 0])):
        for _ in range(2):  # the second call has the scales
            x, bounds = plan.solve_bounded(b)
            assert np.array_equal(x, plan.solve(b)) and bounds.shape == x.shape
            assert np.all(np.abs(x - wanted) <= bounds)
    with pytest.raises(sl.ArgumentError):
        F.certify(A, certainty="perhaps")
    with pytest.raises(sl.InaccurateError if certainty == "estimated" else sl.StateError):
        F.certify(2 * A, certainty=certainty)


def test_regularized_pivots_are_refined():
    K = sp.block_diag([grid(6), [[0.0, 2.0], [2.0, 0.0]]], format="csc")
    b = right_hand_sides(38, 3)
    F = sl.Factor(K, regularization=1e-6, signs=np.r_[np.ones(37, dtype=int), -1])
    rows, shifts = F.pivot_rows("regularized")
    assert 0 < rows.size == F.stats["factor"]["regularized"] == shifts.size
    plan = F.plan(None, None)
    wanted = np.linalg.solve(K.toarray(), b)
    for right, x in ((b, wanted), (np.asfortranarray(b), wanted), (b[:, 0], wanted[:, 0])):
        refined, error = plan.solve_regularized(right)
        assert refined.shape == x.shape and np.allclose(refined, x) and error < 1e-8
    rows, shifts = sl.Factor(grid(5, 0.0), null_pivots="skip").pivot_rows()
    assert rows.size == 1 and shifts[0] == 0.0
    assert F.pivot_rows()[0].size == 0
    with pytest.raises(sl.ArgumentError):
        F.pivot_rows("weak")


# ---- half solves ----

def test_parts_make_up_the_solve(A, F):
    b = right_hand_sides(400, 3)
    half = F.solve_part("P L", b)
    assert np.array_equal(F.solve_part(["D", "LT", "PT"], half), F.solve(b))
    assert np.array_equal(F.solve_part("P", b), b[F.perm])
    assert np.allclose(F.multiply_part("P L D LT PT", b), A @ b)
    with pytest.raises(sl.ArgumentError):
        F.solve_part("P U", b)
    with pytest.raises(sl.ArgumentError):
        F.solve_part("D sqrtD", b)
    indefinite = sl.Factor(grid(6, -2.9))
    with pytest.raises(sl.PivotError):
        indefinite.solve_part("sqrtD", np.ones(36))


def test_local_halves(A, F):
    plan = F.plan([3, 70], [9, 300, 1])
    b = np.zeros(400)
    b[[3, 70]] = [1, -2]
    columns = plan.columns("L")
    assert np.array_equal(plan.solve_part("P L", [1.0, -2.0]), F.solve_part("P L", b)[columns])
    z, columns = right_hand_sides(400), plan.columns("LT")
    assert columns.size < 400
    assert np.array_equal(plan.solve_part("sqrtD LT PT", z[columns]),
                          F.solve_part("sqrtD LT PT", z)[[9, 300, 1]])
    with pytest.raises(sl.ArgumentError):
        plan.solve_part("L", [1.0])


def test_samples_have_the_covariance_of_the_inverse():
    A = grid(4)
    X = sl.Factor(A).sample(200000, rng=np.random.default_rng(3))
    inverse = np.linalg.inv(A.toarray())
    assert np.abs(X @ X.T / 200000 - inverse).max() < 0.02 * inverse.max()
    assert sl.Factor(A).sample().shape == (16,)


# ---- changes, files ----

def test_changes_of_columns(A, F):
    B = A.copy()
    for p in range(B.indptr[5], B.indptr[6]):
        if B.indices[p] == 5:
            B.data[p] += 2
    assert F.change_entries(B, columns=[5]) is F
    assert F.changed["method"] == "reach"
    b = right_hand_sides(400)
    assert np.allclose(B @ F.solve(b), b)
    assert np.array_equal(F.refactor(A).solve(b), sl.Factor(A).solve(b))
    with pytest.raises(sl.ArgumentError):
        F.change_entries(A, columns=[400])
    with pytest.raises(sl.ArgumentError):
        F.change_entries(columns=[5])


@pytest.mark.parametrize("is_mapped", [False, True])
def test_files(A, F, tmp_path, is_mapped):
    path, b = tmp_path / "grid.slf", right_hand_sides(400)
    F.save(path)
    G = sl.Factor.load(path, map=is_mapped, checks="verified")
    assert np.array_equal(G.solve(b), F.solve(b)) and G.n == 400
    assert np.array_equal(G.plan([3], [5]).solve([1.0]), F.plan([3], [5]).solve([1.0]))
    if is_mapped:
        with pytest.raises(sl.StateError):
            G.refactor(A)
    else:
        assert np.array_equal(G.refactor(2 * A).solve(b), F.refactor(2 * A).solve(b))
    with pytest.raises(sl.Error):
        sl.Factor.load(tmp_path / "none")
    (tmp_path / "damaged").write_bytes(path.read_bytes()[:500])
    with pytest.raises(sl.Error):
        sl.Factor.load(tmp_path / "damaged", map=is_mapped)
    with pytest.raises(sl.ArgumentError):
        F.save("a\0b")
    with pytest.raises(sl.ArgumentError):
        sl.Factor.load(path, checks="no")


def test_pickle(F):
    G = pickle.loads(pickle.dumps(F))
    b = right_hand_sides(400)
    assert np.array_equal(G.solve(b), F.solve(b))
    assert sl.Factor.from_bytes(F.to_bytes()).n == 400
    with pytest.raises(sl.Error):
        sl.Factor.from_bytes(b"")


@pytest.mark.parametrize("turn", ["tocsc", "tocsr"])
def test_indices_of_64_bits(A, turn):
    B = getattr(A, turn)()
    B.indptr, B.indices = B.indptr.astype(np.int64), B.indices.astype(np.int64)
    b = right_hand_sides(400)
    F = sl.Factor(B)
    assert np.array_equal(F.solve(b), sl.Factor(getattr(A, turn)()).solve(b))
    assert np.allclose(F.refactor(3 * B).solve(b), splu(3 * A).solve(b))
    B.indices[4] = 2**40
    with pytest.raises(sl.PatternError):
        sl.Factor(B)
    B = getattr(A, turn)()
    B.indptr, B.indices = B.indptr.astype(np.int64), B.indices.astype(np.int64)
    B.indptr[3] = B.indptr[4] + 1
    with pytest.raises(sl.PatternError):
        sl.Factor(B)
