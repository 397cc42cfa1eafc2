"""jax_solve.py: solves, log-determinants and entries of the inverse inside of JAX; needs jax

    system = System(A)                        # the pattern, analyzed once
    solve, logdet, pairs = functions(system)
    jax.grad(lambda values: solve(values, b).sum() + logdet(values))(values)

System computes with NumPy. functions hands its methods to JAX by pure_callback, and says by
custom_vjp what their derivatives are. These consist of the same functions, so that solve has
derivatives of any order, logdet has two and pairs has one.
"""
import numpy as np

from sparse_local import Analysis
from sparse_local.gradients import Stored, pairs_gradient


class System:
    """The NumPy side: functions of the values of a sparse symmetric A, in the order of A.data."""

    def __init__(self, A):
        self.A, self.stored = A.tocsc(), Stored(A.tocsc())
        self.analysis = Analysis(self.A)
        self.last = None, None  # values and their factor

    def matrix(self, values):
        A = self.A.copy()
        A.data = np.array(values, dtype=float)
        return A

    def factor(self, values):
        last, factor = self.last
        values = np.asarray(values)
        if last is None or not np.array_equal(last, values):
            factor = self.analysis.factor(self.matrix(values))
            self.last = values.copy(), factor
        return factor

    def solve(self, values, b):
        return self.factor(values).solve(np.asarray(b))

    def logdet(self, values):
        return np.asarray(self.factor(values).logdet()[1])

    def pairs(self, values, rows, columns):
        return self.factor(values).pairs(np.asarray(rows), np.asarray(columns))

    def pairs_gradient(self, values, rows, columns, g):
        return pairs_gradient(self.factor(values), self.matrix(values), np.asarray(rows),
                              np.asarray(columns), np.asarray(g))

    def products(self, lam, x):
        """The gradient by the values of x = A^-1 b; lam = A^-1 g. For arrays of NumPy and JAX."""
        i, j = self.stored.rows, self.stored.columns
        sums = lam[i] * x[j] + lam[j] * x[i]
        return -self.stored.weights * (sums if sums.ndim == 1 else sums.sum(axis=1))


def functions(system):
    """(solve, logdet, pairs) of JAX: solve(values, b), logdet(values), pairs(values, rows,
    columns)."""
    import jax
    jax.config.update("jax_enable_x64", True)
    count = system.A.nnz
    i, j = system.stored.rows, system.stored.columns

    def called(function, shape, *arguments):
        return jax.pure_callback(function, jax.ShapeDtypeStruct(shape, np.float64), *arguments)

    @jax.custom_vjp
    def solve(values, b):
        return called(system.solve, b.shape, values, b)

    def solve_backward(kept, g):
        values, x = kept
        lam = solve(values, g)
        return system.products(lam, x), lam

    def solve_forward(values, b):
        x = solve(values, b)
        return x, (values, x)

    @jax.custom_vjp
    def pairs(values, rows, columns):
        return called(system.pairs, rows.shape, values, rows, columns)

    def pairs_backward(kept, g):
        return called(system.pairs_gradient, (count,), *kept, g), None, None

    @jax.custom_vjp
    def logdet(values):
        return called(system.logdet, (), values)

    def logdet_backward(values, g):
        return (2.0 * g * system.stored.weights * pairs(values, i, j),)

    solve.defvjp(solve_forward, solve_backward)
    pairs.defvjp(lambda *arguments: (pairs(*arguments), arguments), pairs_backward)
    logdet.defvjp(lambda values: (logdet(values), values), logdet_backward)
    return solve, logdet, pairs


def main():
    import jax
    from scipy.sparse import diags
    n = 100
    A = diags([np.full(n, 2.1), np.full(n - 1, -1.0)], [0, -1], format="csc")
    solve, logdet, pairs = functions(System(A))
    rows = np.arange(n)

    def loss(values):
        """That of a Gaussian field with precision A, and of its variances."""
        x = solve(values, np.ones(n))
        return (x * x).sum() - logdet(values) + pairs(values, rows, rows).sum()

    value, gradient = jax.jit(jax.value_and_grad(loss))(A.data)
    step = 1e-6 * np.cos(np.arange(A.nnz))
    difference = (loss(A.data + step) - loss(A.data - step)) / 2.0
    print("loss %.6f, derivative along a line %.6e, by differences %.6e" %
          (value, gradient @ step, difference))


if __name__ == "__main__":
    main()
