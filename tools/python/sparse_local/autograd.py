"""Solves, determinants and entries of the inverse for torch.autograd: double precision, on the
processor.

    system = autograd.System(A)               # the pattern, analyzed once
    x = system.solve(values, b)               # values: a tensor of the size of A.data
    y = system.local(values, [3], b[:1], [7, 8])
    l = system.logdet(values)
    v = system.diagonal(values)               # variances
    z = system.pairs(values, [3, 4], [5, 5])

values  has the shape (entries,), or (..., entries): a batch of systems. b has the batch of the
values or one of its own, (..., n, count), or none. Both may be sparse tensors, COO or CSR, without
a batch: values with the pattern of A, and b. The gradient of a sparse tensor has its layout.

All are differentiable by values and b; solves any number of times, logdet twice, diagonal, pairs
and local_solve once. The next derivative raises NotImplementedError. Gradients by values are those
of sparse_local.gradients: where A stores both triangles, each value of a pair gets half of the
derivative of the pair. Tensors of float32 are computed in float64; results are float64.
"""
import numpy as np
import torch

from ._analysis import Analysis
from ._errors import ArgumentError, PatternError
from ._matrix import from_triplets
from ._options import split
from .gradients import Stored, _check_kind, _compressed, pairs_gradient

__all__ = ["System", "local_solve"]


class _Values:
    """A matrix with the pattern of another and values of its own."""

    def __init__(self, A, data):
        self.format, self.shape = getattr(A, "format", "csc"), A.shape
        self.indptr, self.indices, self.data = A.indptr, A.indices, data


class System:
    """Systems with the pattern of A, for values that torch differentiates.

    A        n x n, sparse, also a sparse tensor; its values are not read, unless pivoted=True.
    options  of Factor, without triangle and mass.

    Each result keeps the factor of its values for its gradient, also when values change later. The
    last factors are used again for equal values. Errors of factorizations and solves are raised as
    those of Factor; values that are not symmetric, where A stores both triangles, raise
    PatternError.
    Cost     a factorization for new values, a full solve for each solve and each gradient of one,
             a selected inverse for the gradient of logdet; for those of diagonal and pairs see
             gradients.pairs_gradient. A batch of b alone is one solve with many columns.
    Threads  one thread at a time.
    """

    def __init__(self, A, **options):
        if isinstance(A, torch.Tensor):
            i, j = (s.numpy() for s in _indices(A))
            A = from_triplets(A.shape[0], i, j, _stored_values(A).detach().numpy())
        analysis, self._numbers = split(options)
        self._stored = Stored(A, analysis.get("triangle"))
        self._pattern = _compressed(A)
        self.analysis = Analysis(_Values(self._pattern, self._pattern.data), **analysis)
        self.n = self.analysis.n
        i, j = (s.astype(np.int64) for s in (self._stored.rows, self._stored.columns))
        self._i, self._j = torch.from_numpy(i), torch.from_numpy(j)
        self._weights = torch.from_numpy(self._stored.weights)
        order = np.argsort(i * self.n + j)  # by rows, as in sparse tensors
        self._by_rows = torch.from_numpy(order)
        self._of_rows = torch.from_numpy(np.argsort(order))
        self._last = []  # values and their factors

    def factor(self, values):
        """The Factor of these values, which no gradient flows through."""
        return self._factor(self._read(values))

    def _factor(self, values, place=0, count=1):
        """The same for one system of a batch."""
        data = _array(values)
        if data.shape != self._stored.weights.shape:
            raise ArgumentError("%d values are needed, the shape is %s" %
                                (self._stored.weights.size, tuple(data.shape)))
        last, factor = self._last[place] if place < len(self._last) else (None, None)
        if last is None or not np.array_equal(last, data):
            factor = self.analysis.factor(_Values(self._pattern, data), **self._numbers)
            _check_kind(factor)
            self._last[place:] = [(data.copy(), factor)] + self._last[place + 1:count]
        return factor

    def solve(self, values, b):
        """x with A x = b, a tensor of the shape of b: (n,), (n, count), or with a batch. Where that
        leaves open what b (k, n) is, it is a vector for each of k systems, as in torch.linalg."""
        return self._over(values, b, self.n, lambda factor, values, b:
                          _Solve.apply(self, factor, values, b))

    def local(self, values, bset, b, xset):
        """x on the rows xset for a b that is not 0 on the rows bset only.

        Where values need no gradient, both directions are local solves; where they do, the gradient
        by all values takes x and lambda in all rows (gradients.LocalGradient: by chosen entries).
        """
        bset, xset = (np.asarray(s, dtype=np.int64) for s in (bset, xset))

        def solved(factor, values, b):
            if not (torch.is_grad_enabled() and values.requires_grad):
                return _Local.apply(factor, bset, xset, b)
            if bset.size and not 0 <= bset.min() <= bset.max() < self.n:
                raise ArgumentError("a row out of range")
            whole = torch.zeros((self.n,) + tuple(b.shape[1:]), dtype=torch.float64)
            whole = whole.index_add(0, torch.from_numpy(bset), b)
            return _Solve.apply(self, factor, values, whole)[torch.from_numpy(xset)]

        return self._over(values, b, bset.size, solved)

    def logdet(self, values):
        """log |det A|, a scalar tensor, or one for each system of a batch."""
        return self._each(values, lambda factor, values: _LogDet.apply(self, factor, values))

    def pairs(self, values, rows, columns):
        """(A^-1)[r, c] for the pairs of rows and columns, as many."""
        rows, columns = (np.asarray(s, dtype=np.int64) for s in (rows, columns))
        return self._each(values, lambda factor, values: _Entries.apply(
            self, factor, "System.pairs", rows, columns, values))

    def diagonal(self, values, rows=None):
        """(A^-1)[r, r] for r in rows, such as marginal variances; None: all."""
        rows = np.arange(self.n) if rows is None else np.asarray(rows, dtype=np.int64)
        return self._each(values, lambda factor, values: _Entries.apply(
            self, factor, "System.diagonal", rows, rows, values))

    def inverse(self, values):
        """The entries of A^-1 where A has stored ones, as values are: a vector, or a sparse
        tensor."""
        found = self._each(values, lambda factor, values: _Entries.apply(
            self, factor, "System.inverse", self._stored.rows, self._stored.columns, values))
        if values.layout == torch.strided:
            return found
        return _Sparse.apply(values.detach(), found[self._by_rows])

    def _read(self, values):
        """values in the order of A.data, as double."""
        if not isinstance(values, torch.Tensor) or values.layout == torch.strided:
            return _double(values)
        i, j = _indices(values)
        if tuple(values.shape) != (self.n, self.n) or not (
                torch.equal(i, self._i[self._by_rows]) and
                torch.equal(j, self._j[self._by_rows])):
            raise PatternError("a sparse tensor with another pattern than A")
        return _stored_values(values)[self._of_rows]

    def _each(self, values, function, *others):
        """function(factor, values, *others) of each system of a batch."""
        values = self._read(values)
        if values.dim() < 2:
            return function(self._factor(values), values)
        batch = values.reshape(-1, values.shape[-1])
        if not len(batch):
            raise ArgumentError("a batch without systems")
        found = [function(self._factor(batch[k], k, len(batch)), batch[k],
                          *(other[k] for other in others)) for k in range(len(batch))]
        return torch.stack(found).reshape(values.shape[:-1] + found[0].shape)

    def _over(self, values, b, rows, function):
        """function(factor, values, b) of each system, and of each b: (rows,) or (rows, count)."""
        values, b = self._read(values), _dense(b)
        batch = values.shape[:-1]
        is_vector = b.dim() == 1 or (len(batch) > 0 and b.shape == batch + (rows,))
        if b.shape[-1 if is_vector else -2:][:1] != (rows,):
            raise ArgumentError("b needs %d rows, the shape is %s" % (rows, tuple(b.shape)))
        if not batch:
            if b.dim() < 3:
                return function(self._factor(values), values, b)
            columns = b.movedim(-2, 0)  # one solve with the columns of all
            x = function(self._factor(values), values, columns.reshape(rows, -1))
            return x.reshape(x.shape[:1] + columns.shape[1:]).movedim(0, -2)
        own = b.shape[:-1] if is_vector else b.shape[:-2]
        if own not in (batch, ()):
            raise ArgumentError("values and b with batches of the shapes %s and %s" %
                                (tuple(batch), tuple(own)))
        rights = (b if own else b.expand(batch + b.shape)).reshape((-1,) + b.shape[len(own):])
        return self._each(values, function, rights)

    def _products(self, lam, x):
        """The gradient by the values, from lambda and x: in terms that torch can differentiate."""
        sums = lam[self._i] * x[self._j] + lam[self._j] * x[self._i]
        return -self._weights * (sums if sums.dim() == 1 else sums.sum(1))


def local_solve(query, entries, b):
    """x on the x-set of a gradients.LocalGradient, differentiable by b and by its chosen entries of
    A: nothing takes time proportional to n. Second derivatives raise NotImplementedError.

    entries  a tensor of the values of these entries in the factored matrix: only the gradient flows
             through it.
    """
    if entries.shape != (query.rows.size,):
        raise ArgumentError("%d entries are needed, the shape is %s" %
                            (query.rows.size, tuple(entries.shape)))
    return _Query.apply(query, _double(entries), _double(b))


def _double(tensor):
    if not isinstance(tensor, torch.Tensor):
        raise TypeError("a tensor is needed, not %s" % type(tensor).__name__)
    if tensor.is_complex() or not (tensor.is_floating_point() or tensor.dtype == torch.int64):
        raise TypeError("a tensor of real numbers is needed, not %s" % tensor.dtype)
    if tensor.device.type != "cpu" or tensor.layout != torch.strided:
        raise TypeError("a dense tensor on the processor is needed")
    return tensor.to(torch.float64)


def _array(tensor):
    return tensor.detach().numpy()


# ---- sparse tensors ----

def _indices(tensor):
    """Rows and columns of the entries of a sparse tensor, by rows."""
    if tensor.layout == torch.sparse_coo and tensor.is_coalesced() and tensor.dim() == 2:
        return tensor.detach().indices().unbind()
    if tensor.layout == torch.sparse_csr and tensor.dim() == 2:
        ends = tensor.detach().crow_indices().to(torch.int64)
        rows = torch.repeat_interleave(torch.arange(tensor.shape[0]), ends.diff())
        return rows, tensor.detach().col_indices().to(torch.int64)
    raise TypeError("a sparse matrix is needed as CSR, or as COO that is coalesced, not %s" %
                    tensor.layout)


def _stored_values(tensor):
    """The values of a sparse tensor, differentiable."""
    return _double(_Stored.apply(tensor))


def _dense(b):
    """A right-hand side, which may be a sparse matrix."""
    if not isinstance(b, torch.Tensor) or b.layout == torch.strided:
        return _double(b)
    return torch.zeros(b.shape, dtype=torch.float64).index_put(_indices(b), _stored_values(b))


class _Stored(torch.autograd.Function):
    """The values of a sparse tensor; torch 1.13 differentiates those of COO only."""

    @staticmethod
    def forward(ctx, tensor):
        ctx.tensor = tensor.detach()
        return ctx.tensor.values().clone()

    @staticmethod
    def backward(ctx, g):
        return _Sparse.apply(ctx.tensor, g)


class _Sparse(torch.autograd.Function):
    """A sparse tensor with the pattern of another one, and its values."""

    @staticmethod
    def forward(ctx, tensor, values):
        ctx.places = _indices(tensor)
        if tensor.layout == torch.sparse_csr:
            return torch.sparse_csr_tensor(tensor.crow_indices(), tensor.col_indices(), values,
                                           tensor.shape)
        return torch.sparse_coo_tensor(tensor.indices(), values, tensor.shape)._coalesced_(True)

    @staticmethod
    def backward(ctx, g):
        i, j = ctx.places
        if g.layout == torch.strided:
            return None, g[i, j]
        g = g.coalesce() if g.layout == torch.sparse_coo else g
        keys, wanted = (r * g.shape[1] + c for r, c in (_indices(g), (i, j)))
        if not len(keys):
            return None, torch.zeros(len(wanted), dtype=g.dtype)
        place = torch.searchsorted(keys, wanted).clamp(max=len(keys) - 1)
        return None, _Stored.apply(g)[place] * (keys[place] == wanted)


# ---- functions ----

class _Solve(torch.autograd.Function):
    @staticmethod
    def forward(ctx, system, factor, values, b):
        x = torch.from_numpy(np.ascontiguousarray(factor.solve(_array(b))))
        ctx.system, ctx.factor = system, factor
        ctx.save_for_backward(values, x)
        return x

    @staticmethod
    def backward(ctx, g):
        values, x = ctx.saved_tensors
        lam = _Solve.apply(ctx.system, ctx.factor, values, g)
        by_values = ctx.system._products(lam, x) if ctx.needs_input_grad[2] else None
        return None, None, by_values, lam


class _Local(torch.autograd.Function):
    @staticmethod
    def forward(ctx, factor, bset, xset, b):
        ctx.factor, ctx.sets = factor, (bset, xset)
        return torch.from_numpy(np.ascontiguousarray(factor.local(bset, _array(b), xset)))

    @staticmethod
    def backward(ctx, g):
        bset, xset = ctx.sets
        return None, None, None, _Local.apply(ctx.factor, xset, bset, g)


class _LogDet(torch.autograd.Function):
    @staticmethod
    def forward(ctx, system, factor, values):
        ctx.system, ctx.factor = system, factor
        ctx.save_for_backward(values)
        return torch.tensor(factor.logdet()[1], dtype=torch.float64)

    @staticmethod
    def backward(ctx, g):
        values, = ctx.saved_tensors  # an error of torch if values changed in place
        system = ctx.system
        entries = _Entries.apply(system, ctx.factor, "the gradient of System.logdet",
                                 system._stored.rows, system._stored.columns, values)
        return None, None, g * 2.0 * system._weights * entries


class _Entries(torch.autograd.Function):
    @staticmethod
    def forward(ctx, system, factor, name, rows, columns, values):
        ctx.system, ctx.factor, ctx.name, ctx.places = system, factor, name, (rows, columns)
        ctx.save_for_backward(values)
        return torch.from_numpy(factor.pairs(rows, columns))

    @staticmethod
    def backward(ctx, g):
        values, = ctx.saved_tensors
        A = _Values(ctx.system._pattern, _array(values))
        gradient = pairs_gradient(ctx.factor, A, *ctx.places, _array(g))
        return (*[None] * 5, _Once.apply(ctx.name, torch.from_numpy(gradient), values, g))


class _Once(torch.autograd.Function):
    """A gradient that depends on inputs in a way that is not differentiated again: its own gradient
    is an error, where torch would take it for a constant and its derivative for 0."""

    @staticmethod
    def forward(ctx, name, *tensors):
        ctx.name = name
        return tensors[0].clone()

    @staticmethod
    def backward(ctx, g):
        raise NotImplementedError("sparse_local.autograd: no second derivatives of %s; gradients "
                                  "of gradients, Hessians and Laplace approximations need them" %
                                  ctx.name)


class _Query(torch.autograd.Function):
    @staticmethod
    def forward(ctx, query, entries, b):
        x, kept = query.solve(_array(b))
        ctx.query, ctx.kept = query, kept
        ctx.save_for_backward(entries, b)
        return torch.from_numpy(np.ascontiguousarray(x))

    @staticmethod
    def backward(ctx, g):
        entries, b = ctx.saved_tensors
        by_b, by_entries = ctx.query.gradient(ctx.kept, _array(g))
        return (None, _Once.apply("local_solve", torch.from_numpy(by_entries), entries, b, g),
                _Once.apply("local_solve", torch.from_numpy(np.ascontiguousarray(by_b)), entries,
                            b, g))
