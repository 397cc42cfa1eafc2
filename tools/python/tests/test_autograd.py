"""torch.autograd: gradcheck in double for full and local solves and determinants."""
import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from sparse_local import gradients
from systems import grid

torch = pytest.importorskip("torch", reason="torch is not installed: apt-get install python3-torch")
from sparse_local import autograd  # noqa: E402


def tensor(array):
    return torch.tensor(np.asarray(array, dtype=float), requires_grad=True)


def vectors(*shape):
    return tensor(np.random.default_rng(3).standard_normal(shape))


@pytest.mark.parametrize("turn", ["tocsc", "tocsr", "tocoo"])
@pytest.mark.parametrize("half", [sp.tril, sp.triu])
@pytest.mark.parametrize("shape", [(16,), (16, 3)])
def test_solves(turn, half, shape):
    A = getattr(half(grid(4)), turn)()
    system = autograd.System(A)
    values, b = tensor((A if turn != "tocoo" else A.tocsc()).data), vectors(*shape)
    assert torch.autograd.gradcheck(system.solve, (values, b))
    assert torch.autograd.gradgradcheck(system.solve, (values, b))
    assert torch.autograd.gradcheck(system.logdet, (values,))


@pytest.mark.parametrize("needs_values", [False, True])
@pytest.mark.parametrize("shape", [(2,), (2, 3)])
def test_local_solves(needs_values, shape):
    A = sp.tril(grid(4), format="csc")
    system, b = autograd.System(A), vectors(*shape)
    values = tensor(A.data) if needs_values else torch.tensor(A.data)

    def local(values, b):
        return system.local(values, [3, 9], b, [10, 3, 0])

    assert torch.autograd.gradcheck(local, (values, b))
    assert torch.autograd.gradgradcheck(local, (values, b))
    dense = sl.Factor(A)
    assert np.allclose(local(values, b).detach(), dense.local([3, 9], b.detach().numpy(),
                                                              [10, 3, 0]))


def test_chosen_entries():
    """Local derivatives by two entries, through the factor that follows them."""
    A = sp.tril(grid(4), format="csc")
    rows, columns = [6, 9], [5, 9]
    of_column = np.repeat(range(16), np.diff(A.indptr))
    places = [int(np.flatnonzero((A.indices == i) & (of_column == j))[0])
              for i, j in zip(rows, columns)]

    def local(entries, b):
        data = A.data.copy()
        data[places] = entries.detach().numpy()
        F = sl.Factor(sp.csc_matrix((data, A.indices, A.indptr), shape=A.shape))
        query = gradients.LocalGradient(F, [3, 9], [10, 3], rows, columns)
        return autograd.local_solve(query, entries, b)

    assert torch.autograd.gradcheck(local, (tensor(A.data[places]), vectors(2)))


def test_weights_of_edges_in_both_triangles():
    """0.3 I + L(w) from the weights of edges, each of which is in four of the values."""
    A = grid(4)
    A.sort_indices()
    rows, columns = A.indices, np.repeat(range(16), np.diff(A.indptr))
    edges = [(i, j) for i, j in zip(rows, columns) if i < j]
    turn = torch.zeros((A.nnz, len(edges)), dtype=torch.float64)
    for k, (r, c) in enumerate(zip(rows, columns)):
        for e, (i, j) in enumerate(edges):
            turn[k, e] = float(r == c and r in (i, j)) - float({r, c} == {i, j})
    shift = torch.from_numpy(np.where(rows == columns, 0.3, 0.0))
    system = autograd.System(A)

    def answer(weights, b):
        values = shift + turn @ weights
        return system.solve(values, b), system.logdet(values)

    assert torch.autograd.gradcheck(answer, (tensor(np.linspace(1, 2, len(edges))), vectors(16)))


def test_a_gradient_belongs_to_the_values_of_its_solve():
    A = sp.tril(grid(4), format="csc")
    system, b = autograd.System(A), vectors(16)
    values = tensor(A.data)
    first = system.solve(values, b)
    second = system.solve(2 * values.detach(), b)  # another factor in between
    first.sum().backward()
    wanted = gradients.solve_gradient(sl.Factor(A), A, first.detach().numpy(), np.ones(16))[1]
    assert np.allclose(values.grad, wanted) and np.allclose(second.detach() * 2, first.detach())
    assert system.factor(values) is system.factor(values.clone())
    third = system.solve(values, b)
    with torch.no_grad():
        values *= 2.0
    with pytest.raises(RuntimeError):
        third.sum().backward()  # torch notices the change in place
    assert np.allclose(system.solve(values, b).detach() * 2, first.detach())


def test_an_optimization_finds_conductances():
    """Weights of edges from answers: gradient descent by torch on exact gradients."""
    A = sp.tril(grid(4), format="csc")
    system, b = autograd.System(A), torch.eye(16, dtype=torch.float64)[:, :4]
    wanted = system.solve(torch.tensor(A.data), b)
    diagonal = torch.from_numpy(A.indices == np.repeat(range(16), np.diff(A.indptr)))
    values = tensor(A.data + np.where(diagonal, 0.5, 0.0))
    optimizer = torch.optim.LBFGS([values], max_iter=60, line_search_fn="strong_wolfe")
    losses = []

    def closure():
        optimizer.zero_grad()
        loss = ((system.solve(values, b) - wanted) ** 2).sum()
        loss.backward()
        losses.append(float(loss.detach()))
        return loss

    optimizer.step(closure)
    assert losses[-1] < 1e-3 * losses[0]


def dense_of(A, values):
    """The dense symmetric matrix of the values of a lower triangle."""
    rows, columns = (torch.from_numpy(s.astype(np.int64)) for s in (A.tocoo().row, A.tocoo().col))
    L = torch.zeros(A.shape, dtype=torch.float64).index_put((rows, columns), values)
    return L + torch.tril(L, -1).T


def test_second_derivatives_are_right_or_refused():
    A = sp.tril(grid(3), format="csc")
    system, b = autograd.System(A), torch.ones(9, dtype=torch.float64)
    v = tensor(A.data)

    def solved(values):
        return (b * system.solve(values, b)).sum()

    ours = torch.autograd.functional.hessian(solved, v)
    right = torch.autograd.functional.hessian(
        lambda values: (b * torch.linalg.solve(dense_of(A, values), b)).sum(), v)
    assert torch.allclose(ours, right, rtol=1e-9, atol=1e-12)
    for loss in (system.logdet, lambda values: system.logdet(values) + solved(values)):
        first, = torch.autograd.grad(loss(v), v, create_graph=True)
        assert first.requires_grad  # what is not differentiated again is not a constant
        with pytest.raises(NotImplementedError, match="second derivatives of System.logdet"):
            first.sum().backward()
        with pytest.raises(NotImplementedError, match="logdet"):
            torch.autograd.functional.hessian(loss, v)
    with pytest.raises(NotImplementedError):
        torch.autograd.gradgradcheck(system.logdet, (v,))
    query = gradients.LocalGradient(sl.Factor(A), [1], [2], [3], [3])
    for wanted in (0, 1):
        inputs = (tensor([A[3, 3]]), tensor([1.0]))
        first = torch.autograd.grad(autograd.local_solve(query, *inputs).square().sum(), inputs,
                                    create_graph=True)[wanted]
        with pytest.raises(NotImplementedError, match="second derivatives of local_solve"):
            first.sum().backward()
    local = torch.autograd.functional.hessian(
        lambda values: system.local(values, [3], b[:1], [1]).square().sum(), v)
    e, f = (torch.eye(9, dtype=torch.float64)[k] for k in (1, 3))
    right = torch.autograd.functional.hessian(
        lambda values: (e * torch.linalg.solve(dense_of(A, values), f)).sum().square(), v)
    assert torch.allclose(local, right, rtol=1e-9, atol=1e-12)


def test_refusals():
    A = sp.tril(grid(4), format="csc")
    system, values, b = autograd.System(A), tensor(A.data), vectors(16)
    assert system.solve(values.float(), b.float()).dtype == torch.float64
    for wrong in (values.detach().numpy(), values + 0j, values.to_sparse(), values > 0):
        with pytest.raises(TypeError):
            system.solve(wrong, b)
    with pytest.raises(sl.ArgumentError):
        system.solve(values[:-1], b)
    with pytest.raises(sl.ArgumentError):
        system.solve(values, b[:-1])
    with pytest.raises(sl.NotFiniteError):
        system.solve(values * float("nan"), b)
    with pytest.raises(sl.PivotError):
        system.solve(values * 0, b)
    with pytest.raises(sl.ArgumentError):
        system.local(values, [16], b[:1], [0])
    both = autograd.System(grid(4))
    with pytest.raises(sl.PatternError):
        both.solve(torch.rand(grid(4).nnz, dtype=torch.float64), b)
    with pytest.raises(sl.UnsupportedError):
        autograd.System(A, null_pivots="skip", mass=np.ones(16)).logdet(values)
    query = gradients.LocalGradient(sl.Factor(A), [1], [2], [3], [3])
    with pytest.raises(sl.ArgumentError):
        autograd.local_solve(query, values, b[:1])
