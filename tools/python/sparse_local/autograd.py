"""Solves and determinants for torch.autograd: double precision, on the processor.

    system = autograd.System(A)               # the pattern, analyzed once
    x = system.solve(values, b)               # values: a tensor of the size of A.data
    y = system.local(values, [3], b[:1], [7, 8])
    l = system.logdet(values)

All are differentiable by values and b; solves any number of times. A second derivative of logdet,
and of local_solve, raises NotImplementedError. Gradients by values are those of
sparse_local.gradients: where A stores both triangles, each value of a pair gets half of the
derivative of the pair. Tensors of float32 are computed in float64; results are float64.
"""
import numpy as np
import torch

from ._analysis import Analysis
from ._errors import ArgumentError
from ._options import split
from ._saved_set import Selected
from .gradients import Stored, _check_kind


class _Values:
    """A matrix with the pattern of another and values of its own."""

    def __init__(self, A, data):
        self.format, self.shape = getattr(A, "format", "csc"), A.shape
        self.indptr, self.indices, self.data = A.indptr, A.indices, data


class System:
    """Systems with the pattern of A, for values that torch differentiates.

    A        n x n, sparse; its values are not read, unless pivoted=True.
    options  of Factor, without triangle and mass.

    Each result keeps the factor of its values for its gradient, also when values change later. The
    last factor is used again for equal values. Errors of factorizations and solves are raised as
    those of Factor; values that are not symmetric, where A stores both triangles, raise
    PatternError.
    Cost     a factorization for new values, a full solve for each solve and each gradient of one,
             a selected inverse for the gradient of logdet.
    Threads  one thread at a time.
    """

    def __init__(self, A, **options):
        analysis, self._numbers = split(options)
        self._stored = Stored(A, analysis.get("triangle"))
        self._pattern = A if getattr(A, "format", "csc") in ("csc", "csr") else A.tocsc()
        self.analysis = Analysis(_Values(self._pattern, self._pattern.data), **analysis)
        self.n = self.analysis.n
        self._i, self._j = (torch.from_numpy(s.astype(np.int64))
                            for s in (self._stored.rows, self._stored.columns))
        self._weights = torch.from_numpy(self._stored.weights)
        self._last = None, None  # values and their factor

    def factor(self, values):
        """The Factor of these values, which no gradient flows through."""
        data = _array(values)
        if data.shape != self._stored.weights.shape:
            raise ArgumentError("%d values are needed, the shape is %s" %
                                (self._stored.weights.size, tuple(data.shape)))
        last, factor = self._last
        if last is None or not np.array_equal(last, data):
            factor = self.analysis.factor(_Values(self._pattern, data), **self._numbers)
            _check_kind(factor)
            self._last = data.copy(), factor
        return factor

    def solve(self, values, b):
        """x with A x = b, a tensor of the shape of b: (n,) or (n, count)."""
        values, b = _double(values), _double(b)
        return _Solve.apply(self, self.factor(values), values, b)

    def local(self, values, bset, b, xset):
        """x on the rows xset for a b that is not 0 on the rows bset only.

        Where values need no gradient, both directions are local solves; where they do, the gradient
        by all values takes x and lambda in all rows (gradients.LocalGradient: by chosen entries).
        """
        values, b = _double(values), _double(b)
        factor = self.factor(values)
        bset, xset = (np.asarray(s, dtype=np.int64) for s in (bset, xset))
        if not (torch.is_grad_enabled() and values.requires_grad):
            return _Local.apply(factor, bset, xset, b)
        if bset.size and not 0 <= bset.min() <= bset.max() < self.n:
            raise ArgumentError("a row out of range")
        whole = torch.zeros((self.n,) + tuple(b.shape[1:]), dtype=torch.float64)
        whole = whole.index_add(0, torch.from_numpy(bset), b)
        return _Solve.apply(self, factor, values, whole)[torch.from_numpy(xset)]

    def logdet(self, values):
        """log |det A|, a scalar tensor."""
        values = _double(values)
        return _LogDet.apply(self, self.factor(values), values)

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
        stored = ctx.system._stored
        entries = Selected(ctx.factor).entries(stored.rows, stored.columns)
        gradient = torch.from_numpy(2.0 * stored.weights * entries)
        return None, None, g * _Once.apply("System.logdet", gradient, values)


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
