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
    ours = torch.autograd.functional.hessian(system.logdet, v)
    right = torch.autograd.functional.hessian(lambda values: torch.logdet(dense_of(A, values)), v)
    assert torch.allclose(ours, right, rtol=1e-9, atol=1e-12)
    assert torch.autograd.gradgradcheck(system.logdet, (v,))
    third = torch.autograd.functional.hessian(system.logdet, v, create_graph=True)
    with pytest.raises(NotImplementedError, match="of the gradient of System.logdet"):
        third.sum().backward()
    for name, loss in (("diagonal", lambda values: system.diagonal(values)),
                       ("pairs", lambda values: system.pairs(values, [1, 2], [3, 2])),
                       ("inverse", lambda values: system.inverse(values))):
        first, = torch.autograd.grad(loss(v).square().sum(), v, create_graph=True)
        assert first.requires_grad  # what is not differentiated again is not a constant
        with pytest.raises(NotImplementedError, match="second derivatives of System.%s" % name):
            first.sum().backward()
        with pytest.raises(NotImplementedError, match="System.%s" % name):
            torch.autograd.functional.hessian(lambda values: loss(values).sum(), v)
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


def inverse_of(A, values):
    return torch.linalg.inv(dense_of(A, values))


@pytest.mark.parametrize("turn", ["tocsc", "tocsr"])
def test_entries_of_the_inverse(turn):
    A = getattr(sp.tril(grid(3)), turn)()
    system, v = autograd.System(A), tensor(A.data)
    i, j = (s.astype(int) for s in (A.tocoo().row, A.tocoo().col))
    for ours, right in ((system.diagonal, lambda Z: Z.diagonal()),
                        (lambda v: system.diagonal(v, [4, 4]), lambda Z: Z[[4, 4], [4, 4]]),
                        (lambda v: system.pairs(v, [8, 1], [0, 2]), lambda Z: Z[[8, 1], [0, 2]]),
                        (system.inverse, lambda Z: Z[i, j])):
        assert torch.allclose(ours(v), right(inverse_of(A, v)), rtol=1e-12)
        assert torch.autograd.gradcheck(ours, (v,))
    B = grid(3)
    both, w = autograd.System(B), tensor(B.data)
    got, = torch.autograd.grad(both.diagonal(w).square().sum(), w)
    half, = torch.autograd.grad(system.diagonal(v).square().sum(), v)
    got, half = (sp.coo_matrix((g, (M.tocoo().row, M.tocoo().col))).toarray()
                 for g, M in ((got, B), (half, A)))
    assert np.allclose(np.tril(got) + np.triu(got, 1).T, half)


def test_a_gaussian_likelihood_with_marginals():
    """Poisson counts with a random field: log-likelihood by its mode's curvature, and the penalty
    of marginal variances, against dense torch; more rows than are solved at once."""
    A = sp.tril(grid(17), format="csc")
    n = A.shape[0]
    system, counts = autograd.System(A), torch.from_numpy(np.random.default_rng(4).poisson(2.0, n))
    on_diagonal = torch.from_numpy((A.indices == np.repeat(range(n), np.diff(A.indptr))) * 1.0)

    def loss(parameters, solve, logdet, diagonal):
        values = torch.exp(parameters[0]) * (torch.tensor(A.data) +
                                             torch.exp(parameters[1]) * on_diagonal)
        mean, variance = solve(values, counts - 2.0), diagonal(values)
        expected = torch.exp(0.1 * mean + 0.5 * variance)
        return (counts * mean - expected).sum() + 0.5 * logdet(values) + variance.log().sum()

    parameters = tensor([0.3, -1.0])
    ours = loss(parameters, system.solve, system.logdet, system.diagonal)
    right = loss(parameters, lambda v, b: torch.linalg.solve(dense_of(A, v), b.double()),
                 lambda v: torch.logdet(dense_of(A, v)), lambda v: inverse_of(A, v).diagonal())
    assert torch.allclose(ours, right, rtol=1e-12)
    ours, right = (torch.autograd.grad(f, parameters)[0] for f in (ours, right))
    assert torch.allclose(ours, right, rtol=1e-9)


@pytest.mark.parametrize("batch", [(3,), (2, 2), (1,)])
@pytest.mark.parametrize("shape", [(9,), (9, 2)])
def test_batches(batch, shape):
    A = sp.tril(grid(3), format="csc")
    system = autograd.System(A)
    scale = 1.0 + torch.rand(batch + (1,), dtype=torch.float64)
    values = (scale * torch.tensor(A.data)).requires_grad_(True)
    b = vectors(*batch, *shape)
    for values, b in ((values, b), (values, b[(0,) * len(batch)].detach().requires_grad_(True))):
        x = system.solve(values, b)
        assert x.shape == batch + shape
        for k in np.ndindex(batch):
            alone = system.solve(values[k], b[k] if b.dim() > len(shape) else b)
            assert torch.equal(x[k], alone)
        assert torch.autograd.gradcheck(system.solve, (values, b))
    assert torch.autograd.gradgradcheck(system.solve, (values, b))
    assert torch.autograd.gradcheck(lambda v, b: system.local(v, range(9), b, [3, 1]), (values, b))
    assert torch.autograd.gradcheck(system.logdet, (values,))
    assert torch.autograd.gradcheck(lambda v: system.diagonal(v, [1, 2, 3]), (values,))
    assert system.logdet(values).shape == batch and system.inverse(values).shape == values.shape
    factors = [pair[1] for pair in system._last]
    system.solve(values, b)  # equal values: no new factorization
    assert len(factors) == np.prod(batch)
    assert all(a is pair[1] for a, pair in zip(factors, system._last))


def test_batches_of_b():
    A = sp.tril(grid(3), format="csc")
    system, values, b = autograd.System(A), tensor(A.data), vectors(2, 3, 9, 2)
    x = system.solve(values, b)
    right = torch.linalg.solve(dense_of(A, values), b)
    assert x.shape == b.shape and torch.allclose(x, right, rtol=1e-12)
    assert torch.autograd.gradcheck(system.solve, (values, b))
    y = system.local(values.detach(), [4, 2], b[:, :, :2], [0, 1, 2])
    whole = torch.zeros_like(b).index_add(2, torch.tensor([4, 2]), b[:, :, :2])
    assert torch.allclose(y, torch.linalg.solve(dense_of(A, values), whole)[:, :, :3])


def sparse_like(A, layout):
    """What makes a sparse tensor with the pattern of A, by rows, of values."""
    if layout == torch.sparse_csr:
        return lambda v: torch.sparse_csr_tensor(A.indptr, A.indices, v, A.shape)
    places = np.stack([A.tocoo().row, A.tocoo().col])
    return lambda v: torch.sparse_coo_tensor(places, v, A.shape).coalesce()


def values_of(tensor):
    """The values of a sparse tensor, differentiable in either layout."""
    return autograd._Stored.apply(tensor)


@pytest.mark.filterwarnings("ignore:Sparse CSR")
@pytest.mark.parametrize("layout", [torch.sparse_coo, torch.sparse_csr])
@pytest.mark.parametrize("part", [sp.tril, sp.triu, lambda A: A])
def test_sparse_tensors(layout, part):
    """The gradients and inverses have the layout, and the values that a vector has."""
    A = part(grid(3)).tocsr()
    A.sort_indices()
    make, b, vector = sparse_like(A, layout), vectors(9, 2), tensor(A.data)
    dense = autograd.System(A)
    for pattern in (A, A.tocsc(), make(torch.tensor(A.data))):
        system, sparse = autograd.System(pattern), make(torch.tensor(A.data)).requires_grad_(True)
        for call, *more in (("solve", b), ("logdet",), ("diagonal",), ("inverse",)):
            found = getattr(system, call)(sparse, *more)
            right = getattr(dense, call)(vector, *more)
            if call == "inverse":
                assert found.layout == layout and found.shape == A.shape
                found = values_of(found)
            assert torch.allclose(found, right, rtol=1e-12)
            g, = torch.autograd.grad(found.square().sum(), sparse)
            h, = torch.autograd.grad(right.square().sum(), vector)
            assert g.layout == layout and g.shape == A.shape
            assert torch.allclose(g.values(), h, rtol=1e-9, atol=1e-12)
        system.solve(sparse, b).sum().backward()
        assert sparse.grad.layout == layout
    weights = torch.linspace(1, 2, A.nnz, dtype=torch.float64)
    g, = torch.autograd.grad(dense.solve(vector, b).square().sum(), vector, create_graph=True)
    g, = torch.autograd.grad((weights * g).sum(), vector)
    h, = torch.autograd.grad(system.solve(sparse, b).square().sum(), sparse, create_graph=True)
    h, = torch.autograd.grad((weights * values_of(h)).sum(), sparse)
    assert torch.allclose(h.values(), g, rtol=1e-9, atol=1e-12)


def test_a_gradient_of_another_pattern():
    """What flows into a sparse inverse from dense tensors, and from fewer places."""
    A = sp.tril(grid(3), format="csr")
    make, vector = sparse_like(A, torch.sparse_coo), tensor(A.data)
    dense, sparse = autograd.System(A), make(torch.tensor(A.data)).requires_grad_(True)
    entries = dense.inverse(vector)
    weights = torch.linspace(1, 2, 81, dtype=torch.float64).reshape(9, 9)
    places = A.nonzero()
    want, = torch.autograd.grad((weights[places] * entries).sum(), vector, retain_graph=True)
    got, = torch.autograd.grad((weights * dense.inverse(sparse).to_dense()).sum(), sparse)
    assert torch.allclose(got.values(), want, rtol=1e-9)
    few = torch.sparse_coo_tensor([[8, 8], [8, 5]], [2.0, 3.0], (9, 9), dtype=torch.float64)
    at = [int(np.flatnonzero((places[0] == 8) & (places[1] == j))[0]) for j in (8, 5)]
    want, = torch.autograd.grad(2.0 * entries[at[0]] + 3.0 * entries[at[1]], vector)
    got, = torch.autograd.grad(dense.inverse(sparse), sparse, few)
    assert torch.allclose(got.values(), want, rtol=1e-9)


@pytest.mark.filterwarnings("ignore:Sparse CSR")
@pytest.mark.parametrize("layout", ["to_sparse", "to_sparse_csr"])
def test_sparse_right_hand_sides(layout):
    A = sp.tril(grid(3), format="csc")
    system, values = autograd.System(A), tensor(A.data)
    dense = torch.zeros(9, 3, dtype=torch.float64)
    dense[[0, 4, 4, 8], [0, 0, 2, 1]] = torch.tensor([1.0, -2.0, 3.0, 0.5], dtype=torch.float64)
    b = getattr(dense, layout)().requires_grad_(True)
    x = system.solve(values, b)
    assert torch.equal(x, system.solve(values, dense))
    g, by_values = torch.autograd.grad(x.square().sum(), (b, values))
    full = dense.clone().requires_grad_(True)
    h, wanted = torch.autograd.grad(system.solve(values, full).square().sum(), (full, values))
    assert g.layout == b.layout and torch.allclose(by_values, wanted)
    assert torch.allclose(g.to_dense(), h * (dense != 0))


def test_refusals_of_batches_and_sparse_tensors():
    A = sp.tril(grid(3), format="csc")
    system, values = autograd.System(A), torch.tensor(A.data)
    two = torch.stack([values, values])
    for v, b in ((two, vectors(3, 9)), (two, vectors(3, 9, 1)), (values, vectors(2, 8, 1)),
                 (two[:, :-1], vectors(2, 9)), (two[:0], vectors(9)), (values, vectors())):
        with pytest.raises(sl.ArgumentError):
            system.solve(v, b)
    b = vectors(9)
    other = sp.tril(grid(3) + sp.diags([np.ones(3)] * 2, [-6, 6])).tocoo()
    with pytest.raises(sl.PatternError, match="pattern"):
        system.solve(torch.sparse_coo_tensor(np.stack([other.row, other.col]), other.data,
                                             other.shape).coalesce(), b)
    with pytest.raises(TypeError, match="coalesced"):
        C = A.tocoo()
        system.solve(torch.sparse_coo_tensor(np.stack([C.row, C.col]), C.data, C.shape), b)
    for wrong in (dict(rows=[9], columns=[0]), dict(rows=[0, 1], columns=[0])):
        with pytest.raises(sl.ArgumentError):
            system.pairs(values, **wrong)
    L = sp.tril(grid(3, 0.0), format="csc")
    singular, v = autograd.System(L, null_pivots="skip"), tensor(L.data)
    first, = torch.autograd.grad(singular.logdet(v), v, create_graph=True)
    assert torch.isfinite(first).all()
    with pytest.raises(sl.UnsupportedError, match="pseudo-inverse"):
        first.sum().backward()
    with pytest.raises(sl.UnsupportedError, match="pseudo-inverse"):
        singular.diagonal(v).sum().backward()


def test_refusals():
    A = sp.tril(grid(4), format="csc")
    system, values, b = autograd.System(A), tensor(A.data), vectors(16)
    assert system.solve(values.float(), b.float()).dtype == torch.float64
    for wrong in (values.detach().numpy(), values + 0j, values.to_sparse(), values > 0,
                  torch.diag(values).to_sparse_csc()):
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
