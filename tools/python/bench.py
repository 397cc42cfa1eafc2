"""bench.py: times sparse_local against scipy.sparse.linalg.splu (make bench-python)

Questions: factor, refactor, solve with 1 and 8 right-hand sides, and a solve that is asked for one
row of x for one row of b; and what the names of scikit-sparse add to Factor, where at most 1.1 of
its time is allowed. Each time is the median of several; answers are compared before.
"""
import statistics
import sys
import time

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

import sparse_local
from sparse_local.sksparse import cholmod
from sparse_local.sksparse05 import cholmod as cholmod05


def grid(side):
    path = sp.diags([np.full(side - 1, -1.0)] * 2, [-1, 1], shape=(side, side))
    edges = sp.kron(sp.identity(side), path) + sp.kron(path, sp.identity(side))
    return (edges + sp.diags(0.1 - np.asarray(edges.sum(axis=1)).ravel())).tocsc()


def median(call, repetitions=5):
    """Median of the process's CPU seconds, one of which is a warm-up."""
    times = []
    for _ in range(repetitions + 1):
        begin = time.process_time()
        call()
        times.append(time.process_time() - begin)
    return statistics.median(times[1:])


def main():
    print("| n | | sparse_local | splu | ratio |\n|---|---|---|---|---|")
    for side in [int(text) for text in sys.argv[1:]] or [100, 316]:
        A = grid(side)
        n = side * side
        b, B = np.ones(n), np.random.default_rng(0).standard_normal((n, 8))
        # symmetric mode is the best setting of SuperLU here
        options = {"permc_spec": "MMD_AT_PLUS_A", "diag_pivot_thresh": 0.0,
                   "options": {"SymmetricMode": True}}
        F, LU = sparse_local.Factor(A), splu(A, **options)
        assert np.allclose(F.solve(B), LU.solve(B), rtol=1e-9, atol=1e-9)
        plan, row = F.plan([n // 2], [n // 3]), np.ones(1)
        unit = np.zeros(n)
        unit[n // 2] = 1
        rows = [
            ("factor", lambda: sparse_local.Factor(A), lambda: splu(A, **options)),
            ("refactor", lambda: F.refactor(A), lambda: splu(A, **options)),
            ("solve, 1 right-hand side", lambda: F.solve(b), lambda: LU.solve(b)),
            ("solve, 8 right-hand sides", lambda: F.solve(B), lambda: LU.solve(B)),
            ("one row of x for one row of b, on a plan",
             lambda: [plan.solve(row) for _ in range(100)], lambda: LU.solve(unit)),
            ("diagonal of the inverse", lambda: F.diagonal(), None)]
        for name, ours, theirs in rows:
            mine = median(ours) / (100 if "plan" in name else 1)
            other = median(theirs) if theirs else None
            print("| %d | %s | %.3g ms | %s | %s |" % (
                n, name, 1e3 * mine, "%.3g ms" % (1e3 * other) if theirs else "-",
                "%.3g" % (other / mine) if theirs else "-"))
        stand_ins(n, A, b)


def stand_ins(n, A, b):
    """The time of each stand-in by that of Factor, in turns: the median of the ratios."""
    F, old, new = sparse_local.Factor(A), cholmod.cholesky(A), cholmod05.cho_factor(
        A, order="default")
    calls = [
        ("factor and solve", lambda: sparse_local.Factor(A).solve(b),
         (lambda: cholmod.cholesky(A)(b),
          lambda: cholmod05.cho_factor(A, order="default").solve(b))),
        ("refactor and solve", lambda: F.refactor(A).solve(b),
         (lambda: (old.cholesky_inplace(A), old(b))[1], lambda: new.factorize(A).solve(b))),
        ("solve", lambda: F.solve(b), (lambda: old(b), lambda: new.solve(b)))]
    for name, ours, theirs in calls:
        for version, call in zip(("0.4", "0.5"), theirs):
            assert np.allclose(call(), ours(), rtol=1e-9, atol=1e-9)
            pairs = [(median(ours, 1), median(call, 1)) for _ in range(15)]
            mine, other = (statistics.median(times) for times in zip(*pairs))
            print("| %d | %s, names of scikit-sparse %s | %.3g ms | %.3g ms | %.3g |" % (
                n, name, version, 1e3 * mine, 1e3 * other, other / mine))


main()
