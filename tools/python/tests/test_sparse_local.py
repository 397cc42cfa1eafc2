"""The package against scipy.sparse.linalg.splu, with malformed input, and from several threads."""
import ctypes
import gc
import os
import pickle
import re
import subprocess
import sys
import threading
import time
import weakref

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import splu

import sparse_local as sl
from sparse_local import _library


def grid(side, shift=0.1):
    """The Laplacian of a grid of side x side vertices, plus shift; both triangles, CSC."""
    path = sp.diags([np.full(side - 1, -1.0)] * 2, [-1, 1], shape=(side, side))
    edges = sp.kron(sp.identity(side), path) + sp.kron(path, sp.identity(side))
    degree = -np.asarray(edges.sum(axis=1)).ravel()
    return (edges + sp.diags(degree + shift)).tocsc()


def right_hand_sides(n, count=None):
    return np.random.default_rng(1).standard_normal(n if count is None else (n, count))


@pytest.fixture
def A():
    return grid(20)


@pytest.fixture
def F(A):
    return sl.Factor(A)


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
    with pytest.raises(TypeError):
        F.solve(1j * b)
    with pytest.raises(TypeError):
        F.solve(np.array(["a"] * 400))


def test_arrays_are_used_in_place(A):
    from sparse_local._arrays import Matrix
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
    spaced = sl.Factor(A, coordinates=np.indices((20, 20)).reshape(2, -1).T)
    for F in (natural, given, spaced):
        assert np.allclose(F.solve(b), x, rtol=1e-11)
        assert sorted(F.perm) == list(range(400))
    assert F.stats["factor"]["positive"] == 400 and "400 rows" in repr(F)
    for wrong in ({"ordering": "best"}, {"ordering": "given"}, {"null_pivots": "x"},
                  {"triangle": "both"}, {"perm": [0, 1]}, {"perm": np.zeros(400, dtype=int)},
                  {"coordinates": np.zeros((400, 5))}, {"mass": np.ones(3)}):
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
    F.refactor(2 * A)
    with pytest.raises(sl.StateError):
        plan.solve(b)
    R.update()
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
    Z.update()
    assert np.allclose(Z.diagonal(), inverse.diagonal() / 2)


@pytest.mark.parametrize("mapped", [False, True])
@pytest.mark.parametrize("storage", ["double", "float"])
def test_saved_sets_have_the_same_bits(A, tmp_path, mapped, storage):
    F = sl.Factor(A, storage=storage)
    rows, b = [205, 206, 225, 226], right_hand_sides(4)
    Z, R = sl.Selected(F), F.region(rows)
    path = tmp_path / "set.slf"
    sl.save_set(path, F, Z, [R, F.region([3])])
    G, Y, regions = sl.load_set(path, map=mapped, checks="verified")
    x = F.plan(rows, rows, region=R).solve(b)
    assert np.array_equal(G.plan(rows, rows, region=regions[0]).solve(b), x)
    assert len(regions) == 2 and regions[0].stats["boundary"] == R.stats["boundary"]
    assert np.array_equal(Y.diagonal(), Z.diagonal())
    whole = right_hand_sides(400)
    assert np.array_equal(G.solve(whole), F.solve(whole))
    assert np.array_equal(sl.Factor.load(path).solve(whole), F.solve(whole))
    if mapped:
        for change in (Y.update, regions[0].update, lambda: G.refactor(A)):
            with pytest.raises(sl.StateError):
                change()
    else:
        G.refactor(2 * A)
        Y.update()
        regions[0].update()
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
            sl.save_set(tmp_path / "x.slf", other, selected, regions)
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
    assert F.stats["factor"]["bytes"] < 0.85 * sl.Factor(A).stats["factor"]["bytes"]
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
    with pytest.raises(sl.PivotError):
        sl.Factor(grid(6, -3.0)).solve_part("sqrtD", np.ones(36))


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
    X = sl.Factor(A).sample(200000, np.random.default_rng(3))
    inverse = np.linalg.inv(A.toarray())
    assert np.abs(X @ X.T / 200000 - inverse).max() < 0.02 * inverse.max()
    assert sl.Factor(A).sample().shape == (16,)


# ---- changes, files ----

def test_update(A, F):
    B = A.copy()
    for p in range(B.indptr[5], B.indptr[6]):
        if B.indices[p] == 5:
            B.data[p] += 2
    assert F.update(B, [5]) is F
    b = right_hand_sides(400)
    assert np.allclose(B @ F.solve(b), b)
    assert np.array_equal(F.update(A).solve(b), sl.Factor(A).solve(b))
    with pytest.raises(sl.ArgumentError):
        F.update(A, [400])


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


# ---- the structs of the header ----

HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "csrc")


@pytest.mark.skipif(not os.path.exists(HEADER), reason="no header beside the package")
@pytest.mark.parametrize("name", ["Options", "Stats", "Csc", "Csc64", "SavedSet", "SymbolicArrays"])
def test_structs_are_those_of_the_header(tmp_path, name):
    """Every member of the C struct, in order, at the same offset, and nothing after the last."""
    struct = {"Options": "sl_options", "Stats": "sl_stats", "Csc": "sl_csc", "Csc64": "sl_csc64",
              "SavedSet": "sl_saved_set", "SymbolicArrays": "sl_symbolic_arrays"}[name]
    ours = dict(leaves(getattr(_library, name)))
    with open(os.path.join(HEADER, "sparse_local.h")) as file:
        theirs = c_members(file.read(), struct)
    paths = ["size_of_all"] + theirs
    lines = ["%s" % ("sizeof(%s)" % struct if path == "size_of_all" else
                     "offsetof(%s, %s)" % (struct, path)) for path in paths]
    source = tmp_path / "offsets.c"
    source.write_text('#include <stddef.h>\n#include <stdio.h>\n#include "sparse_local.h"\n'
                      "int main(void) {\n%s    return 0;\n}\n" %
                      "".join('    printf("%%zu\\n", %s);\n' % line for line in lines))
    subprocess.check_call(["cc", "-I", HEADER, "-o", str(tmp_path / "offsets"), str(source)])
    numbers = subprocess.check_output([str(tmp_path / "offsets")], text=True).split()
    assert int(numbers[0]) == ctypes.sizeof(getattr(_library, name))
    assert [int(text) for text in numbers[1:]] == list(ours.values())


def leaves(struct, prefix="", start=0):
    """The members of a ctypes struct that are not structs, with their offsets."""
    for name, kind in struct._fields_:
        offset = start + getattr(struct, name).offset
        if issubclass(kind, ctypes.Structure):
            yield from leaves(kind, prefix + name + ".", offset)
        else:
            yield prefix + name, offset


def c_members(text, struct):
    """The members of a C struct as paths, in order; members of type sl_... info are opened."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    body = re.search(r"typedef struct %s \{(.*?)\} %s;" % (struct, struct), text, re.S).group(1)
    paths = []
    for line in body.split(";"):
        if "(*" in line:
            paths.append(re.search(r"\(\*(\w+)\)", line).group(1))
            continue
        match = re.match(r"\s*(?:const |unsigned )*(\w+)(.*)", line, re.S)
        if not match:
            continue
        for declared in match.group(2).replace("const", "").split(","):
            name = re.search(r"\w+", declared)
            if not name:
                continue
            name = name.group(0)
            inner = "typedef struct %s {" % match.group(1)
            if inner in text and "*" not in declared:
                paths += [name + "." + path for path in c_members(text, match.group(1))]
            else:
                paths.append(name)
    return paths


# ---- errors ----

def test_singular_and_indefinite():
    A = grid(6, 0.0)
    with pytest.raises(sl.PivotError) as caught:
        sl.Factor(A)
    assert 0 <= caught.value.row < 36 and "row" in str(caught.value)
    F = sl.Factor(A, null_pivots="skip")
    with pytest.raises(sl.InconsistentError):
        F.solve(np.ones(36))
    b = right_hand_sides(36)
    b -= b.mean()
    assert np.allclose(A @ F.solve(b), b)
    x = sl.Factor(A, null_pivots="skip", mass=np.ones(36)).solve(np.arange(36.0))
    assert abs(x.sum()) < 1e-13 * abs(x).sum()
    indefinite = grid(4).tolil()
    indefinite[6, 6] = -50
    F = sl.Factor(indefinite)
    assert F.stats["factor"]["negative"] == 1 and F.logdet()[0] == -1


def test_several_null_vectors():
    L = grid(5, 0.0)
    A = sp.block_diag([L, 3 * L], format="csc")  # two components with a constant each
    Z = np.zeros((50, 2))
    Z[:25, 0], Z[25:, 1], Z[25:, 0] = 1, 2, 1
    b = A @ np.arange(50.0)
    for vectors in (Z, np.asfortranarray(Z), Z[::-1]):
        F = sl.Factor(A, null_pivots="skip", null_vector=vectors)
        assert F.stats["factor"]["null"] == 2
        assert np.allclose(A @ F.solve(b), b)
    b[3] += 1
    with pytest.raises(sl.InconsistentError):
        F.solve(b)
    m = 1.0 + np.arange(50) % 3
    x = sl.Factor(A, null_pivots="skip", null_vector=Z, mass=m).solve(b)  # each has a mean of 0
    assert np.allclose(Z.T @ (m * x), 0)
    c = b[:25].sum() / m[:25].sum()
    assert np.allclose(A @ x, np.where(np.arange(50) < 25, b - c * m, b))
    for wrong in (np.ones((50, 33)), np.ones((49, 2)), np.ones((50, 2, 2))):
        with pytest.raises(sl.ArgumentError):
            sl.Factor(A, null_pivots="skip", null_vector=wrong)


def test_malformed_matrices(A):
    with pytest.raises(sl.ArgumentError):
        sl.Factor(A[:, :10])
    with pytest.raises(TypeError):
        sl.Factor(np.eye(3))
    with pytest.raises(TypeError):
        sl.Factor(A.astype(complex))
    for damage in ("indices", "indptr", "short"):
        B = A.copy()
        if damage == "indices":
            B.indices[5] = 400
        elif damage == "indptr":
            B.indptr[5] = B.indptr[4] - 1
        else:
            B.data = B.data[:-1]
        with pytest.raises(sl.PatternError):
            sl.Factor(B)
    B = A.copy()
    B.data[3] = np.inf
    with pytest.raises(sl.NotFiniteError) as caught:
        sl.Factor(B)
    assert (caught.value.row, caught.value.column) == (0, 1)


def test_a_matrix_that_is_not_symmetric_is_noticed(A, F):
    B = A.tolil()
    B[3, 2] += 1e-3
    with pytest.raises(sl.PatternError, match="triangles differ"):
        sl.Factor(B.tocsc())
    with pytest.raises(sl.PatternError):
        F.refactor(B.tocsc())
    B[0, 399] = 1
    with pytest.raises(sl.PatternError):
        sl.Factor(B.tocsc())


def test_wrong_right_hand_sides_and_sets(F):
    for shape in ((399,), (401, 2), (2, 400), (400, 1, 1), ()):
        with pytest.raises(sl.ArgumentError):
            F.solve(np.zeros(shape))
    with pytest.raises(sl.ArgumentError):
        F.local([400], [1.0], [0])
    with pytest.raises(sl.ArgumentError):
        F.local([-1], [1.0], [0])
    with pytest.raises(sl.ArgumentError):
        F.local([1, 2], [1.0], [0])
    with pytest.raises(sl.TooLargeError):
        F.local([2**40], [1.0], [0])
    with pytest.raises(TypeError):
        F.local([1.5], [1.0], [0])
    with pytest.raises(TypeError):
        F.local(np.ones(400, dtype=bool), np.ones(400), [0])
    with pytest.raises(sl.ArgumentError):
        F.diagonal([[1, 2]])
    with pytest.raises(sl.ArgumentError):
        F.plan([0], [400])
    assert isinstance(sl.ArgumentError("x"), ValueError)


def test_no_rows():
    F = sl.Factor(sp.csc_matrix((0, 0)))
    assert F.solve(np.zeros(0)).size == 0 and F.diagonal().size == 0
    assert F.solve(np.zeros((0, 3))).shape == (0, 3) and F.perm.size == 0


# ---- life times, threads ----

def test_objects_keep_what_they_borrow(A):
    plan = sl.Factor(A).plan([1], [2])
    gc.collect()
    assert np.isfinite(plan.solve([1.0]))
    F = sl.Factor(A)
    gone = weakref.ref(F._factor)
    del F
    gc.collect()
    assert gone() is None


def test_threads_share_a_factor(F):
    b = right_hand_sides(400)
    x, plan = F.solve(b), F.plan([3], [390])
    y, wrong = plan.solve([1.0]), []

    def work():
        for _ in range(200):
            if not (np.array_equal(F.solve(b), x) and np.array_equal(plan.solve([1.0]), y)):
                wrong.append(1)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_the_lock_of_the_interpreter_is_released(A):
    """While one thread is in a long call, another one runs Python code."""
    big = sl.Factor(grid(100))
    B = np.ones((10000, 400))
    began, ended = threading.Event(), threading.Event()

    def work():
        began.set()
        big.solve(B)
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    began.wait()
    ticks = 0
    while not ended.is_set():
        ticks += 1
        time.sleep(0.0005)
    thread.join()
    assert ticks > 3


def test_library_can_be_chosen():
    code = "import sparse_local; print(sparse_local.library_path(), sparse_local.version())"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.split() == [sl.library_path(), sl.__version__]
