"""Constraints, changes of entries, submatrices and edited meshes, against dense algebra."""
import pickle

import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from systems import grid, right_hand_sides


def held(A, rows, b, values):
    """The dense solution with x = values in rows."""
    free = np.setdiff1d(np.arange(A.shape[0]), rows)
    dense, x = A.toarray(), np.zeros(b.shape)
    x[rows] = values
    right = b[free] - dense[np.ix_(free, rows)] @ values
    x[free] = np.linalg.solve(dense[np.ix_(free, free)], right)
    return x


@pytest.mark.parametrize("count", [None, 3])
@pytest.mark.parametrize("renewed", [False, True])
def test_constraints_hold_rows(A, F, count, renewed):
    rows = [5, 0, 399]
    b, values = right_hand_sides(400, count), right_hand_sides(3, count)
    P = F.constraints(rows)
    if renewed:
        assert P.refactor() is P
    assert len(P) == 3 and P.stats["count"] == 3
    assert np.allclose(P.solve(b, values), held(A, rows, b, values), atol=1e-12)
    assert np.allclose(P.solve(None, values), held(A, rows, 0 * b, values), atol=1e-12)
    plan = F.plan([7], [6, 8])
    few = np.zeros(b.shape)
    few[7] = 1.0
    x = P.solve(few[[7]], values, plan=plan)
    assert np.allclose(x, held(A, rows, few, values)[[6, 8]], atol=1e-12)
    P.release([1])
    assert np.allclose(P.solve(b, values[[0, 2]]), held(A, [5, 399], b, values[[0, 2]]))
    P.add([17])
    new = right_hand_sides(3, count)
    assert np.allclose(P.solve(b, new), held(A, [5, 399, 17], b, new), atol=1e-12)


@pytest.mark.parametrize("count", [None, 2])
def test_many_held_rows_become_a_factor_of_the_others(count):
    A = grid(40, 0.0)  # singular
    F = sl.Factor(A, null_pivots="skip")
    rows = list(np.random.default_rng(3).permutation(1600)[:900])
    b = right_hand_sides(1600, count)
    P, plain = F.constraints(rows[:100], A=A), F.constraints(rows[:100])
    for step, kinds in ((rows[100:700], 1), (rows[700:], 1), (None, 1), (None, 0), ([1], 0)):
        if step is None:  # the first half is released
            gone = np.arange(len(P) // 3 if len(P) > 700 else len(P) - 150)
            P.release(gone)
            plain.release(gone)
            rows = rows[len(gone):]
        else:
            step = [row for row in step if step != [1] or row not in rows]
            P.add(step)
            plain.add(step)
            rows += [row for row in step if row not in rows]
        values = right_hand_sides(len(P), count)
        assert len(P) == len(plain) and P._is_many == bool(kinds)
        x = P.solve(b, values)
        assert np.allclose(x, plain.solve(b, values), atol=1e-9)
        assert P._is_many == (P._fixed is not None)
        assert np.array_equal(P.solve(b, values), x)
    with pytest.raises(sl.PivotError):
        P.add([rows[-1]])
    P.add([row for row in range(1600) if row not in rows][:500])
    with pytest.raises(sl.PivotError):
        P.add([rows[0]])
    with pytest.raises(sl.ArgumentError):
        P.add([1600])
    with pytest.raises(sl.ArgumentError):
        P.add([0, 1], [1.0, 1.0])
    with pytest.raises(sl.ArgumentError):
        P.solve(None, np.zeros(len(P)), plan=F.plan([7], [6]))
    F.refactor(2 * A)
    with pytest.raises(sl.ArgumentError):
        P.refactor()
    values = right_hand_sides(len(P))
    x = P.refactor(2 * A).solve(b[:, 0] if count else b, values)
    free = np.setdiff1d(np.arange(1600), P._rows)
    assert np.allclose((2 * A @ x - (b[:, 0] if count else b))[free], 0, atol=1e-9)


def test_many_held_rows_follow_the_factor():
    A = grid(30, 0.5)
    F = sl.Factor(A)
    rows = np.random.default_rng(5).permutation(900)[:500]
    P = F.constraints(rows, A=A)
    for wrong in (A[:400, :400], A[:, :400], "A"):
        with pytest.raises(sl.ArgumentError):
            F.constraints(rows, A=wrong)
        with pytest.raises(sl.ArgumentError):
            P.refactor(wrong)
    values, count = right_hand_sides(500), P.stats["count"]
    assert np.array_equal(P.solve(None, values)[rows], values)
    F.refactor(2 * A)  # P has not been told
    for call in (lambda: P.solve(None, values), lambda: P.release(range(400))):
        with pytest.raises(sl.StateError):
            call()
    assert len(P) == 500 and P.refactor(2 * A).stats["count"] == count
    assert np.allclose(P.solve(None, values), held(2 * A, rows, np.zeros(900), values), atol=1e-12)
    P.release(range(400))
    assert len(P) == 100
    assert np.allclose(P.solve(None, values[400:]),
                       held(2 * A, rows[400:], np.zeros(900), values[400:]), atol=1e-12)


def test_many_held_rows_of_one_component_of_two():
    A = sp.block_diag([grid(30, 0.0), grid(4, 0.0)]).tocsc()
    F = sl.Factor(A, null_pivots="skip")
    b = right_hand_sides(916)
    b[900:] -= b[900:].mean()
    for count in (390, 450):
        x = F.constraints(range(count), A=A).solve(b, np.ones(count))
        assert np.allclose((A @ x - b)[count:], 0, atol=1e-9)
        with pytest.raises(sl.InconsistentError):
            F.constraints(range(count), A=A).solve(b + 1, np.ones(count))


def test_many_held_rows_join_those_before_the_matrix():
    A = grid(30, 0.5)
    P = sl.Factor(A).constraints([0, 1]).refactor(A).add(np.arange(10, 450))
    rows, values = np.r_[0, 1, 10:450], right_hand_sides(442)
    assert len(P) == 442 and P._is_many
    assert np.allclose(P.solve(None, values), held(A, rows, np.zeros(900), values), atol=1e-12)


def test_many_held_rows_read_the_triangle_of_the_factor():
    A, rows, values = grid(30, 0.5), np.arange(450), right_hand_sides(450)
    one = sp.csc_matrix(sp.tril(A) + 3 * sp.triu(A, 1))
    P = sl.Factor(one, triangle="lower").constraints(rows, A=one)
    assert np.allclose(P.solve(None, values), held(A, rows, np.zeros(900), values), atol=1e-12)


def test_many_held_rows_stay_where_pins_are_refused():
    scale = sp.diags(1.0 / (1 + np.arange(900) % 3))
    A = (scale @ grid(30, 0.0) @ scale).tocsc()  # its null vector is not told
    P = sl.Factor(A, null_pivots="skip").constraints(range(450), A=A)
    values = right_hand_sides(450)
    x = P.solve(None, values)
    with pytest.raises(sl.UnsupportedError):
        P.release(range(300))
    assert len(P) == 450 and np.array_equal(P.solve(None, values), x)


def test_equalities_and_singular_systems():
    A = grid(8, 0.0)
    F = sl.Factor(A, null_pivots="skip")
    P = F.constraints().add([0, 1, 2], [1.0, 1.0, -1.0]).add([60])
    x = P.solve(None, [2.0, 1.0])
    assert x[0] + x[1] - x[2] == pytest.approx(2) and x[60] == pytest.approx(1)
    r = A @ x
    assert np.allclose(np.delete(r, [0, 1, 2, 60]), 0, atol=1e-12) and r[0] == pytest.approx(-r[2])


def test_constraints_refuse_what_is_wrong(A, F):
    P = F.constraints([3, 4])
    with pytest.raises(sl.PivotError):
        P.add([3])
    for rows in ([400], [-1], [[1]]):
        with pytest.raises(sl.ArgumentError):
            P.add(rows)
    for numbers in ([2], [-1]):
        with pytest.raises(sl.ArgumentError):
            P.release(numbers)
    b = np.zeros(400)
    for values in ([1.0], [1.0, 2.0, 3.0], [[1.0], [2.0]], 1.0):
        with pytest.raises(sl.ArgumentError):
            P.solve(b, values)
    with pytest.raises(sl.NotFiniteError):
        P.solve(b, [np.nan, 1.0])
    with pytest.raises(sl.ArgumentError):
        P.solve(b[:-1], [1.0, 2.0])
    with pytest.raises(TypeError):
        P.solve(b, [1j, 2.0])
    assert len(P) == 2
    F.refactor(2 * A)
    with pytest.raises(sl.StateError):
        P.solve(b, [1.0, 2.0])
    P.refactor()
    assert P.solve(b, [1.0, 2.0])[3] == pytest.approx(1)
    with pytest.raises(sl.UnsupportedError):
        sl.Factor(grid(6, -2.9)).constraints([1])


def stiffer(A, i, j, w):
    """A with an edge between i and j that is heavier by w."""
    B = A.tolil()
    B[i, j] -= w
    B[j, i] -= w
    B[i, i] += w
    B[j, j] += w
    return B.tocsc()


@pytest.mark.parametrize("turn", ["tocsc", "tocsr", "lower", "upper"])
def test_changes_follow_entries(A, turn):
    def form(B):
        return {"lower": sp.tril, "upper": sp.triu}[turn](B, format="csc") if len(turn) == 5 and \
            turn in ("lower", "upper") else getattr(B, turn)()
    B, b = stiffer(A, 17, 18, 2.5), right_hand_sides(400)
    F = sl.Factor(form(A))
    assert F.change_entries(form(B), was=form(A)) is F
    assert F.changed["method"] in ("update", "reach", "refactor")
    assert F.changed["reason"] == "cheapest"
    wanted = np.linalg.solve(B.toarray(), b)
    assert np.allclose(F.solve(b), wanted)
    assert F.change_entries(form(B), was=form(B)).changed["method"] == "none"
    G = sl.Factor(form(A))
    entries = dict(rows=[17, 17, 18], columns=[18, 17, 18], deltas=[-2.5, 2.5, 2.5])
    G.change_entries(form(B), **entries)
    assert np.allclose(G.solve(b), wanted)
    assert np.allclose(sl.Factor(form(A)).change_entries(**entries).solve(b), wanted)
    V = sp.csc_matrix(([1.0, -1.0], ([17, 18], [0, 0])), shape=(400, 1))
    H = sl.Factor(form(A)).rank_update(V, [2.5])
    assert np.allclose(H.solve(b), wanted) and H.changed["ranks"] == 1
    assert H.changed["method"] == "update"
    assert np.allclose(H.rank_update(V, [-2.5]).solve(b), np.linalg.solve(A.toarray(), b))


def test_sums_of_scipy_may_be_out_of_order(A):
    v = sp.csc_matrix(([1.0, -1.0], ([18, 17], [0, 0])), shape=(400, 1))
    B, b = A + 2.5 * (v @ v.T), right_hand_sides(400)
    assert not B.has_sorted_indices
    kept = B.indices.copy()
    for F in (sl.Factor(A), sl.Factor(B), sl.Sum([A]).factor([1.0])):
        assert F.n == 400
    F = sl.Factor(A)
    F.change_entries(B, was=A)
    assert np.allclose(B @ F.solve(b), b) and np.allclose(B @ F.refactor(B).solve(b), b)
    assert np.allclose(A @ sl.Factor(B).refactor(A).solve(b), b)
    assert np.allclose(B @ pickle.loads(pickle.dumps(F)).refactor(B).solve(b), b)
    assert np.array_equal(B.indices, kept)


def test_refused_changes_leave_the_factor(A, F):
    b = right_hand_sides(400)
    x = F.solve(b)
    far = sp.csc_matrix(([1.0, -1.0], ([0, 399], [0, 0])), shape=(400, 1))
    with pytest.raises(sl.PatternError):
        F.rank_update(far)
    unit = sp.csc_matrix(([1.0], ([5], [0])), shape=(400, 1))
    with pytest.raises(sl.PivotError):
        F.rank_update(unit, [-100.0])
    with pytest.raises(sl.NotFiniteError):
        F.rank_update(unit, [np.nan])
    with pytest.raises(sl.NotFiniteError):
        F.change_entries(None, [5], [5], [np.inf])
    for wrong in (([5], [400], [1.0]), ([5], [-1], [1.0]), ([5, 6], [5], [1.0, 1.0]),
                  ([5], [5], [1.0, 2.0])):
        with pytest.raises(sl.ArgumentError):
            F.change_entries(None, *wrong)
    with pytest.raises(sl.ArgumentError):
        F.rank_update(unit, [1.0, 2.0])
    with pytest.raises(sl.ArgumentError):
        F.change_entries(A)
    with pytest.raises(sl.ArgumentError):
        F.change_entries(A, was=grid(19))
    for wrong in (dict(was=A), dict(A=A, was=A, columns=[5])):
        with pytest.raises(sl.ArgumentError, match="was needs"):
            F.change_entries(**wrong)
    assert np.array_equal(F.solve(b), x)


def test_a_submatrix_has_the_factor_of_its_rows(A, F):
    rows = np.random.default_rng(0).permutation(400)[:150]
    G, b = F.submatrix(A, rows), right_hand_sides(150)
    assert G.n == 150
    assert np.allclose(G.solve(b), np.linalg.solve(A.toarray()[np.ix_(rows, rows)], b))
    with pytest.raises(sl.StateError):
        G.save("none")
    with pytest.raises((sl.StateError, sl.PatternError)):
        G.refactor(A[rows][:, rows])
    for wrong in ([1, 1], [400], None):
        with pytest.raises(sl.ArgumentError):
            F.submatrix(A, wrong)


def test_edits_follow_a_mesh():
    A = grid(20)
    gone = 45
    new_of = np.arange(400)
    new_of[gone], new_of[gone + 1:] = -1, np.arange(gone, 399)
    kept = np.delete(np.arange(400), gone)
    B = stiffer(sp.block_diag([A[kept][:, kept], [[1.0]]], format="csc"), 10, 399, 1.0)  # a new row
    F = sl.Factor(A)
    G, b = F.edit(A, B, new_of), right_hand_sides(400)
    assert np.allclose(G.solve(b), np.linalg.solve(B.toarray(), b))
    assert "changed" in G.analysis.edited and "kept" in G.reused
    assert G.reused["reason"] == "cheapest"
    again = sl.Factor.from_bytes(G.to_bytes())
    assert np.array_equal(again.solve(b), G.solve(b))
    for wrong in (new_of[:-1], np.where(new_of == 7, 8, new_of),
                  np.where(new_of == 7, 400, new_of)):
        with pytest.raises(sl.ArgumentError):
            F.edit(A, B, wrong)
    with pytest.raises(sl.PatternError):
        F.edit(grid(19), B, new_of)
    with pytest.raises(sl.PatternError):
        bad = B.tolil()
        bad[3, 2] += 1
        F.edit(A, bad.tocsc(), new_of)
