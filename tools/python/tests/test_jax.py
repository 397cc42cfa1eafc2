"""examples/jax_solve.py: what its callbacks compute, by differences, and JAX where it is."""
import os
import sys

import numpy as np
import pytest
import scipy.sparse as sp

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples"))
import jax_solve  # noqa: E402
from systems import grid  # noqa: E402
from test_gradients import differences  # noqa: E402

ROWS, COLUMNS = np.array([1, 4, 8]), np.array([1, 7, 0])


@pytest.fixture(params=[sp.tril, sp.triu])
def A(request):
    return request.param(grid(3), format="csc")


def test_callbacks(A):
    """The formulas of the derivatives, with the methods that JAX calls."""
    system, values = jax_solve.System(A), A.data
    b, g = np.cos(np.arange(9.0)), np.sin(np.arange(9.0) + 1.0)
    x, lam = system.solve(values, b), system.solve(values, g)
    assert np.allclose(grid(3) @ x, b)
    assert np.allclose(system.products(lam, x),
                       differences(lambda v: g @ system.solve(v, b), values), atol=1e-7)
    assert np.allclose(lam, differences(lambda b: g @ system.solve(values, b), b), atol=1e-7)
    two = system.products(np.stack([lam, x], 1), np.stack([x, b], 1))
    assert np.allclose(two, system.products(lam, x) + system.products(x, b))
    got = 2.0 * system.stored.weights * system.pairs(values, system.stored.rows,
                                                     system.stored.columns)
    assert np.allclose(got, differences(system.logdet, values), atol=1e-7)
    got = system.pairs_gradient(values, ROWS, COLUMNS, g[:3])
    wanted = differences(lambda v: g[:3] @ system.pairs(v, ROWS, COLUMNS), values)
    assert np.allclose(got, wanted, atol=1e-7)
    factor = system.factor(values)
    assert system.factor(values.copy()) is factor and system.factor(2 * values) is not factor


def test_jax(A, capsys):
    jax = pytest.importorskip("jax", reason="jax is not installed")
    from jax.test_util import check_grads
    solve, logdet, pairs = jax_solve.functions(jax_solve.System(A))
    b = np.cos(np.arange(9.0))
    check_grads(solve, (A.data, b), order=2, modes=["rev"])
    check_grads(logdet, (A.data,), order=2, modes=["rev"])
    check_grads(lambda values: pairs(values, ROWS, COLUMNS), (A.data,), order=1, modes=["rev"])
    assert np.allclose(grid(3) @ jax.jit(solve)(A.data, b), b)
    jax_solve.main()
    words = capsys.readouterr().out.split()
    assert np.isclose(float(words[6].rstrip(",")), float(words[-1]), rtol=1e-5)
