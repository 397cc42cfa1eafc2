"""The names of the package qdldl."""
import numpy as np
import pytest
import scipy.sparse as sp

from sparse_local import qdldl
from systems import grid, right_hand_sides


def kkt():
    """A quasi-definite matrix: D has both signs."""
    B = sp.random(9, 25, 0.3, random_state=0)
    return sp.bmat([[grid(5), B.T], [B, -0.1 * sp.identity(9)]], format="csc")


def test_solves_updates_and_factors():
    A, b = kkt(), right_hand_sides(34)
    F = qdldl.Solver(A)
    assert np.allclose(A @ F.solve(b), b)
    L, D, p = F.factors()
    assert sp.triu(L).nnz == 0 and (D < 0).sum() == 9 and sorted(p) == list(range(34))
    whole = L + sp.identity(34)
    assert np.allclose((whole @ sp.diags(D) @ whole.T).toarray(), A.toarray()[np.ix_(p, p)])
    F.update(2 * A)
    assert np.allclose(2 * A @ F.solve(b), b)
    F.update(sp.triu(A, format="csc"), upper=True)
    assert np.allclose(A @ F.solve(b), b)
    G = qdldl.Solver(sp.triu(A, format="csc"), upper=True)
    assert np.allclose(G.solve(list(b)), F.solve(b))
    assert np.allclose(qdldl.Solver(A.tocsr()).solve(b), F.solve(b))


def test_what_is_wrong_gives_a_signal():
    A, b = kkt(), right_hand_sides(34)
    F = qdldl.Solver(A)
    for wrong in (A[:-1], sp.csc_matrix((3, 3))):
        with pytest.raises(ValueError):
            qdldl.Solver(wrong)
    for wrong in (b[:-1], np.full(34, np.nan)):
        with pytest.raises(ValueError):
            F.solve(wrong)
    damaged = A.tolil()
    damaged[5, 6] += 1.0
    with pytest.raises(ValueError, match="not symmetric"):
        qdldl.Solver(damaged.tocsc())
    with pytest.raises(ValueError):
        F.update(damaged.tocsc())
    with pytest.raises(ValueError):
        F.update(sp.identity(34, format="csc"))  # another pattern
    assert np.allclose(A @ F.solve(b), b)
    with pytest.raises(RuntimeError):
        F.update(0 * A)
    with pytest.raises(RuntimeError):
        F.solve(b)
    with pytest.raises(RuntimeError):
        qdldl.Solver(sp.csc_matrix([[0.0, 1.0], [1.0, 0.0]]))
