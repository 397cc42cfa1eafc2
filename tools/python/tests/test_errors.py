"""Exceptions: singular, indefinite, malformed and empty input."""
import os
import re

import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from systems import grid, right_hand_sides


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


def test_chosen_pivots():
    A = sp.csc_matrix(np.array([[0, 1, 2.0], [1, 0, 3], [2, 3, 0]]))
    with pytest.raises(sl.PivotError, match="pivoted=True"):
        sl.Factor(A)
    F = sl.Factor(A, pivoted=True)
    b = np.array([1.0, 2, 3])
    assert np.allclose(A @ F.solve(b), b)
    assert F.stats["symbolic"]["pairs"] == 1
    with pytest.raises(sl.UnsupportedError):
        sl.Factor(A, pivoted=True, null_pivots="skip")


def test_small_pivots_name_their_size():
    A = sp.csc_matrix(np.array([[1, 1], [1, 1 - 1e-9]]))
    with pytest.raises(sl.PivotError, match="wrong sign.*pivot -1e-09, null up to") as caught:
        sl.Factor(A, null_pivots="skip")
    assert caught.value.value == pytest.approx(-1e-9, rel=1e-6)
    assert sl.Factor(A, null_pivots="skip", null_tolerance=1e-8).stats["factor"]["null"] == 1
    B = abs(A)
    B[1, 1] = 1 + 1e-9
    assert sl.Factor(B).logdet()[0] == 1
    with pytest.raises(sl.PivotError, match="null_tolerance.*pivot 1e-09, null up to 2e-06"):
        sl.Factor(B, null_tolerance=1e-6)


def test_an_unknown_option_names_the_nearest():
    with pytest.raises(TypeError, match="unknown option 'order'; did you mean 'ordering'[?]"):
        sl.Factor(grid(6), order="nd")
    with pytest.raises(TypeError, match="unknown option 'xyz'$"):
        sl.Factor(grid(6), xyz=1)


def test_inconsistent_systems_name_their_size():
    F = sl.Factor(grid(6, 0.0), null_pivots="skip")
    message = r"1 of sum \|b\|, consistency_tolerance is 1e-06"
    with pytest.raises(sl.InconsistentError, match=message) as caught:
        F.solve(np.ones((36, 2)))
    assert caught.value.value == pytest.approx(1)
    with pytest.raises(sl.InconsistentError, match=message):
        F.local([3, 4], [1.0, 2], [0])
    with pytest.raises(sl.InconsistentError, match=message):
        F.plan([3], [0]).solve([1.0])
    with pytest.raises(sl.InconsistentError, match=message):
        F.plan(None, [0]).solve(np.ones(36))
    F = sl.Factor(grid(6, 0.0), null_pivots="skip", consistency_tolerance=-1)
    assert F.solve(np.ones(36)).shape == (36,)


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
        sl.Factor(A.astype(bool))
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


def test_texts_name_the_reason(tmp_path):
    """The sentence of sl_error_text, with the file: what is missing, what is wrong with it."""
    with pytest.raises(sl.Error, match="no such file.*none.slf"):
        sl.Factor.load(str(tmp_path / "none.slf"))
    junk = tmp_path / "junk.slf"
    junk.write_bytes(b"hello")
    with pytest.raises(sl.UnsupportedError, match="not a saved factor.*junk.slf"):
        sl.Factor.load(str(junk))
    F = sl.Factor(grid(6))
    with pytest.raises(sl.PatternError, match="another size than the analyzed matrix"):
        F.refactor(grid(5))


def test_exceptions_are_named_as_the_statuses_of_the_header():
    from sparse_local import _errors
    header = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "csrc",
                          "sparse_local.h")
    if not os.path.exists(header):
        pytest.skip("no header beside the package")
    with open(header) as file:
        enum = re.search(r"typedef enum sl_status \{(.*?)\} sl_status;", file.read(), re.DOTALL)
    names = re.findall(r"\bSL_ERR_(\w+)(?=,|\n)", re.sub(r"/\*.*?\*/", "", enum.group(1),
                                                        flags=re.DOTALL))
    assert len(names) == 15 and names[-1] == "READ_ONLY"
    assert [kind.status for kind in _errors.BY_STATUS] == names
    for kind, name in zip(_errors.BY_STATUS, names):
        camel = name.title().replace("_", "") + "Error"
        assert kind.__name__ == {"MemoryError": "OutOfMemoryError"}.get(camel, camel)
        assert getattr(sl, kind.__name__) is kind and kind.__name__ in sl.__all__
    assert issubclass(sl.MalformedError, sl.PatternError)
    assert issubclass(sl.OtherPatternError, sl.PatternError)
    for kind in (sl.MismatchError, sl.StaleError, sl.ReadOnlyError):
        assert issubclass(kind, sl.StateError)


def test_each_status_is_its_own_class(A, F, tmp_path):
    with pytest.raises(sl.OtherPatternError):
        F.refactor(grid(5))
    bad = A.copy()
    bad.indices[5] = 400
    with pytest.raises(sl.MalformedError):
        sl.Factor(bad)
    with pytest.raises(sl.MismatchError):
        sl.Factor(A).plan([0], [1]).on(F)
    with pytest.raises(sl.IoError):
        sl.Factor.load(str(tmp_path / "none.slf"))
    F.save(str(tmp_path / "f.slf"))
    mapped = sl.Factor.load(str(tmp_path / "f.slf"), map=True)
    with pytest.raises(sl.ReadOnlyError):
        mapped.refactor(A)
    mapped.close()
    with pytest.raises(sl.StaleError) as caught:
        mapped.solve(np.ones(400))
    assert caught.value.status == "STALE"
