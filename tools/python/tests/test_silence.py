"""No silent success: what is wrong with a matrix, a right-hand side or an object is an exception.

Each of these once answered with success in some other package.
"""
import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from systems import grid, right_hand_sides


# ---- matrices ----

@pytest.mark.parametrize("wrong", ["negative diagonal", "M - t L", "indefinite", "singular"])
def test_a_matrix_that_is_not_positive_definite(wrong):
    A = {"negative diagonal": -grid(6), "M - t L": sp.identity(36, format="csc") - 0.3 * grid(6, 0),
         "indefinite": grid(6, -2.9), "singular": grid(6, 0.0)}[wrong]
    with pytest.raises(sl.PivotError) as caught:
        sl.cholesky(A)
    assert 0 <= caught.value.row < 36 and isinstance(caught.value, ArithmeticError)
    if wrong != "singular":
        F = sl.Factor(A)  # L D L' of any sign: the inertia says so
        assert F.inertia[1] > 0 and str(F.inertia) in repr(F)
        assert F.inertia[1] == (np.linalg.eigvalsh(A.toarray()) < 0).sum()
        with pytest.raises(sl.PivotError):
            F.sample()


def test_a_refactorization_that_is_not_positive_definite():
    F = sl.cholesky(grid(6))
    plan, b = F.plan([3], [4]), np.ones(36)
    with pytest.raises(sl.PivotError, match="not positive definite"):
        F.refactor(grid(6, -2.9))
    for use in (lambda: F.solve(b), lambda: plan.solve([1.0]), lambda: F.diagonal(), F.logdet,
                F.to_bytes, F.sample, F.lower, lambda: F.constraints([1]), lambda: F.region([1])):
        with pytest.raises(sl.StateError):
            use()
    assert np.allclose(grid(6) @ F.refactor(grid(6)).solve(b), b)


@pytest.mark.parametrize("turn", ["tocsc", "tocsr"])
def test_values_that_are_not_symmetric(turn):
    A = grid(6)
    B = A.tolil()
    B[3, 2] *= 1 + 1e-6
    B = getattr(B, turn)()
    F, b = sl.Factor(getattr(A, turn)()), np.ones(36)
    calls = (lambda: sl.Factor(B), lambda: F.refactor(B),
             lambda: F.change_entries(B, columns=[2]), lambda: F.change_entries(B, was=A),
             lambda: F.refine(B, b, b), lambda: F.rcond(B),
             lambda: F.certify(B), lambda: F.submatrix(B, [1]), lambda: sl.analyze(A).factor(B),
             lambda: sl.Sum([B]))
    for call in calls:
        with pytest.raises(sl.PatternError):
            call()
    assert np.allclose(A @ F.solve(b), b)


def test_one_triangle_is_not_taken_for_the_whole():
    """One triangle is read as a symmetric matrix; the values of the other are not zeros."""
    A, b = grid(6), np.ones(36)
    for B in (sp.tril(A, format="csc"), sp.triu(A, format="csr")):
        assert np.allclose(A @ sl.Factor(B).solve(b), b)
        F = sl.Factor(A)
        with pytest.raises(sl.PatternError):
            F.refactor(B)  # another pattern than the analyzed one
        G = sl.Factor(B)
        with pytest.raises(sl.PatternError):
            G.refactor(A)
    mixed = (sp.tril(A) + sp.csc_matrix(([-1.0], ([0], [20])), shape=A.shape)).tocsc()
    with pytest.raises(sl.PatternError):
        sl.Factor(mixed)  # a lower triangle with an entry above the diagonal


@pytest.mark.parametrize("first, second", [("tocsc", "tocsr"), ("tocsr", "tocsc")])
@pytest.mark.parametrize("triangle", ["lower", "upper"])
def test_a_chosen_triangle_stays_chosen(first, second, triangle):
    """The triangle of the user is read whether a matrix is stored by columns or by rows."""
    A = grid(6)
    B = A.tolil()
    B[3, 2] -= 0.5  # below the diagonal
    half = sp.tril(B) if triangle == "lower" else sp.triu(B)
    wanted = half + half.T - sp.diags(half.diagonal())
    b = np.ones(36)
    F = sl.Factor(getattr(A, first)(), triangle=triangle)
    assert np.allclose(wanted @ F.refactor(getattr(B, second)()).solve(b), b)
    x, error = F.refine(getattr(B, second)(), F.solve(b), b)
    assert error < 1e-14
    G = sl.Factor.from_bytes(F.to_bytes(), triangle=triangle)
    assert np.allclose(wanted @ G.refactor(getattr(B, first)()).solve(b), b)
    assert np.allclose(wanted @ G.refactor(getattr(B, second)()).solve(b), b)


def test_a_pattern_that_changed():
    """The same number of entries, at other places; fewer; more; other sizes."""
    A, b = grid(6), np.ones(36)
    F = sl.Factor(A)
    plan = F.plan([3], [4])
    p = np.random.default_rng(0).permutation(36)
    moved = A[p][:, p].tocsc()
    assert moved.nnz == A.nnz
    fewer = A.copy().tolil()
    fewer[0, 1] = fewer[1, 0] = 0.0
    more = A.copy().tolil()
    more[0, 20] = more[20, 0] = 1e-3
    for B in (moved, fewer.tocsc(), more.tocsc(), grid(7), grid(5), sp.identity(36, format="csc")):
        for call in (F.refactor, lambda B: F.change_entries(B, columns=[1]), F.rcond, F.certify,
                     sl.analyze(A).factor, lambda B: F.refine(B, b, b)):
            with pytest.raises(sl.PatternError):
                call(B)
    assert np.allclose(A @ F.solve(b), b)
    assert np.array_equal(plan.solve([1.0]), F.local([3], [1.0], [4]))


def test_columns_that_were_not_named():
    """change_entries trusts its sets; a refinement of 0 steps tells."""
    A, b = grid(40), np.ones(1600)
    first, last = sl.Factor(A).perm[[0, -1]]
    B = A.tolil()
    B[first, first] += 1.0
    B[last, last] += 1.0
    B, named = B.tocsc(), [last]
    for change in (lambda F: F.change_entries(B, columns=named),
                   lambda F: F.change_entries(None, named, named, [1.0]),
                   lambda F: F.change_entries(B, rows=named, columns=named, deltas=[1.0])):
        F = sl.Factor(A)
        change(F)
        assert F.refine(B, F.solve(b), b, steps=0)[1] > 1e-3
    F = sl.Factor(A).change_entries(B, columns=[first, last])
    assert F.refine(B, F.solve(b), b, steps=0)[1] < 1e-14


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("form", ["both", "lower"])
def test_values_that_are_not_finite(value, form):
    A = grid(6) if form == "both" else sp.tril(grid(6), format="csc")
    for at in (0, 7, A.nnz - 1):
        B = A.copy()
        B.data[at] = value
        for call in (lambda: sl.Factor(B), lambda: sl.cholesky(B), lambda: sl.Factor(A).refactor(B),
                     lambda: sl.Factor(A).change_entries(B, columns=np.arange(36)),
                     lambda: sl.Factor(B, null_pivots="skip")):
            with pytest.raises(sl.NotFiniteError):
                call()


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, complex(0, np.nan)])
def test_right_hand_sides_that_are_not_finite(value):
    A = grid(6)
    F = sl.Factor(A)
    plan = F.plan([3, 9], [4])
    b = np.ones(36, dtype=type(value))
    b[5] = value
    wide = np.ones((36, 3), dtype=type(value))
    wide[7, 2] = value
    few = np.array([1.0, value])
    with pytest.raises(sl.NotFiniteError) as caught:
        F.solve(b)
    assert caught.value.row == 5
    for B in (wide, np.asfortranarray(wide), wide[:, ::-1]):
        with pytest.raises(sl.NotFiniteError) as caught:
            F.solve(B)
        assert caught.value.row == 7
    for call in (lambda: F.local([3, 9], few, [4]), lambda: plan.solve(few)):
        with pytest.raises(sl.NotFiniteError) as caught:
            call()
        assert caught.value.row == 9
    sparse = sp.csc_matrix(([value], ([8], [0])), shape=(36, 1))
    for call in (lambda: F.solve(sparse), lambda: F.solve_part("P L", b), lambda: F.refine(A, b, b),
                 lambda: F.constraints([1]).solve(b, [0.0]), lambda: sl.solve_batch([(F, b)])):
        with pytest.raises((sl.NotFiniteError, TypeError)):
            call()
    assert np.isfinite(F.solve(np.full(36, 1e300))).all()  # squares overflow, the numbers do not


# ---- objects ----

def test_use_after_a_failed_factorization():
    A, b = grid(6), np.ones(36)
    bad = A.copy()
    bad.data[:] = 0.0
    F = sl.Factor(A)
    plan, R, Z, P = F.plan([3], [4]), F.region([3, 4]), sl.Selected(F), F.constraints([3])
    inside = F.plan([3], [4], region=R)
    with pytest.raises(sl.PivotError):
        F.refactor(bad)
    uses = (lambda: F.solve(b), lambda: F.local([3], [1.0], [4]), lambda: plan.solve([1.0]),
            lambda: inside.solve([1.0]), R.refactor, Z.refactor, lambda: P.solve(b, [1.0]),
            P.refactor, F.diagonal, lambda: F.block([1], [2]), lambda: F.pairs([1], [2]), F.logdet,
            F.sample, F.lower, F.factors, F.to_bytes, lambda: F.refine(A, b, b), lambda: F.rcond(A),
            lambda: F.certify(A), lambda: F.solve_part("L", b),
            lambda: F.change_entries(A, columns=[1]),
            lambda: F.submatrix(A, [1]), lambda: F.change_entries(None, [1], [1], [1.0]),
            lambda: F.region([1]), lambda: sl.Selected(F), lambda: F.constraints([1]),
            lambda: F.edit(A, A, np.arange(36)), lambda: sl.solve_batch([(F, b)]),
            lambda: F.bilinear([1], [1.0], [1], [1.0]))
    for use in uses:
        with pytest.raises(sl.StateError):
            use()
    assert np.allclose(A @ F.refactor(A).solve(b), b)
    assert np.array_equal(plan.solve([1.0]), F.local([3], [1.0], [4]))


def test_a_closed_object():
    A, b = grid(6), np.ones(36)
    F = sl.Factor(A)
    plan, R, Z, P = F.plan([3], [4]), F.region([3, 4]), sl.Selected(F), F.constraints([3])
    d = Z.diagonal()
    F.close()
    F.close()
    uses = (lambda: F.solve(b), lambda: plan.solve([1.0]), R.refactor, Z.refactor, F.diagonal,
            F.logdet, lambda: P.solve(b, [1.0]), lambda: P.add([1]), lambda: P.release([0]),
            P.refactor, lambda: F.refactor(A), lambda: F.save("never"),
            lambda: F.plan([1], [2]).solve([1.0]), lambda: F.stats, lambda: F.inertia,
            lambda: repr(F),
            lambda: F.change_entries(A, columns=[1]), lambda: F.change_entries(A, was=A),
            lambda: F.constraints([1]),
            lambda: sl.solve_batch([(plan, [1.0])]))
    for use in uses:
        with pytest.raises(sl.StateError, match="closed"):
            use()
    assert np.array_equal(Z.diagonal(), d)  # its own numbers
    with sl.Factor(A) as G:
        assert np.allclose(A @ G.solve(b), b)
    with pytest.raises(sl.StateError):
        G.solve(b)


def test_objects_of_other_matrices():
    F, G = sl.Factor(grid(6)), sl.Factor(grid(7))
    R = G.region([3, 4])
    for call in (lambda: F.plan([3], [4], region=R), lambda: G.plan([3], [4]).on(F)):
        with pytest.raises(sl.StateError):
            call()


# ---- arguments ----

def test_wrong_types_and_shapes():
    A = grid(6)
    F, b = sl.Factor(A), np.ones(36)
    for wrong in (np.ones(36, dtype=bool), np.array(["1"] * 36), np.array([None] * 36), None, {}):
        with pytest.raises((TypeError, sl.ArgumentError)):
            F.solve(wrong)
    for wrong in (np.ones(35), np.ones((1, 36)), np.ones((36, 1, 1)), 1.0, [], sp.identity(35)):
        with pytest.raises(sl.ArgumentError):
            F.solve(wrong)
    wide = np.zeros((72, 8))
    wide[::2, ::4] = right_hand_sides(36, 2)
    for B in (wide[::2, ::4], wide[::2, ::4].astype(np.float32).astype(float)[::-1][::-1],
              np.asfortranarray(wide[::2, ::4])):
        assert np.allclose(A @ F.solve(B), B)
    assert np.allclose(F.solve(b.astype(">f8")), F.solve(b))  # bytes in the other order
    assert np.allclose(F.solve(b.astype(np.float32)), F.solve(b))
    swapped = sp.csc_matrix((A.data.astype(">f8"), A.indices.astype(">i4"), A.indptr.astype(">i4")),
                            shape=A.shape)
    assert np.array_equal(sl.Factor(swapped).solve(b), F.solve(b))
    unaligned = np.frombuffer(b"x" + b.tobytes(), dtype=np.uint8)[1:].view(np.float64)
    assert not unaligned.flags.aligned and np.array_equal(F.solve(unaligned), F.solve(b))


def test_indices_that_overflow():
    A = grid(6)
    F = sl.Factor(A)
    for row in (2**31, 2**32 + 3, -2**31 - 1, 2**63 - 1, np.uint64(2**64 - 1)):
        for call in (lambda: F.local([row], [1.0], [3]), lambda: F.plan([1], [row]),
                     lambda: F.diagonal([row]), lambda: F.constraints([row]),
                     lambda: F.pairs([row], [1]),
                     lambda: sl.from_triplets(3, [row], [0], [1.0])):
            with pytest.raises((sl.TooLargeError, sl.ArgumentError)):
                call()
    for name, at, value in (("indices", 5, 2**32), ("indices", 5, -1), ("indptr", 3, 2**32),
                            ("indptr", 36, 2**33)):
        B = A.copy()
        B.indices, B.indptr = B.indices.astype(np.int64), B.indptr.astype(np.int64)
        getattr(B, name)[at] = value
        with pytest.raises(sl.PatternError):
            sl.Factor(B)
        with pytest.raises(sl.PatternError):
            F.refactor(B)

    class Huge:
        shape, indptr, indices, data = (2**31, 2**31), np.zeros(1), np.zeros(0), np.zeros(0)

    with pytest.raises(sl.TooLargeError):
        sl.Factor(Huge())
    for shape in ((35, 36), (36, 35), (37, 37)):
        Huge.shape, Huge.indptr, Huge.indices, Huge.data = shape, A.indptr, A.indices, A.data
        with pytest.raises((sl.PatternError, sl.ArgumentError)):
            sl.Factor(Huge())


def test_an_order_that_is_no_permutation():
    A, order = grid(6), np.arange(36)
    twice, negative, beyond = order.copy(), order.copy(), order.copy()
    twice[3], negative[3], beyond[3] = 4, -1, 36
    for wrong in (twice, negative, beyond, order[:-1], np.append(order, 36), order + 1, []):
        with pytest.raises((sl.ArgumentError, TypeError)):
            sl.Factor(A, perm=wrong)
        with pytest.raises((sl.ArgumentError, TypeError)):
            sl.analyze(A, perm=wrong)
    for wrong in (order.astype(float), order > 3):
        with pytest.raises(TypeError):
            sl.Factor(A, perm=wrong)
    with pytest.raises(sl.TooLargeError):
        sl.Factor(A, perm=order + 2**32)
    for name in ("nd", "mindeg", "natural"):
        perm = sl.Factor(A, ordering=name).perm
        assert np.array_equal(np.sort(perm), order)


def test_options_that_are_not_numbers():
    A = grid(6)
    for wrong in ({"null_tolerance": np.nan}, {"regularization": -1.0}, {"growth_limit": np.nan},
                  {"null_pivots": "skip", "mass": np.full(36, np.nan)},
                  {"null_pivots": "skip", "null_vector": np.full(36, np.inf)},
                  {"regularization": 1e-8, "signs": np.full(36, 3)}, {"block_size": 5},
                  {"ordering": 1}, {"purpose": 1}, {"storage": "half"}):
        with pytest.raises((sl.Error, TypeError)):
            sl.Factor(A, **wrong)
