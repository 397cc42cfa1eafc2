"""The null space of a singular matrix, and what makes the pseudo-inverse of entries."""
import ctypes

import numpy as np

from . import _arrays as arrays
from ._library import PseudoInverse, check


class NullSpace:
    """Orthonormal null vectors Q of each component of a factor's matrix, and K:
    (A^+)_ij = G_ij - sum over c of Q_ic K_jc + K_ic Q_jc, for entries G of the factor."""

    def __init__(self, factor):
        self.component = np.empty(factor.n, dtype=np.int32)
        found = PseudoInverse()
        call = factor._lib.sl_factor_pseudo_inverse
        check(call(factor._pointer, ctypes.byref(found), None))
        self.Q = np.empty((factor.n, max(found.columns, 1)), order="F")
        self.K = np.empty_like(self.Q)
        for name in ("component", "Q", "K"):
            setattr(found, name, arrays.address(getattr(self, name)))
        check(call(factor._pointer, ctypes.byref(found), factor._work()))
        self.log_det = found.log_det

    def pairs(self, out, rows, columns):
        """Corrects the entries of pairs of rows in place."""
        Q, K = self.Q, self.K
        joined = self.component[rows] == self.component[columns]
        out -= joined * ((Q[rows] * K[columns]).sum(axis=1) + (K[rows] * Q[columns]).sum(axis=1))
        return out

    def block(self, out, rows, columns):
        """Corrects a block of entries in place."""
        Q, K = self.Q, self.K
        joined = self.component[rows][:, None] == self.component[columns][None, :]
        out -= joined * (Q[rows] @ K[columns].T + K[rows] @ Q[columns].T)
        return out

    def project(self, X):
        """Subtracts from columns their part in the null space."""
        X = np.array(X)
        for q in self.Q.T:
            products = q[:, None] * X.reshape(len(q), -1)
            sums = np.zeros_like(products)
            np.add.at(sums, self.component, products)
            X -= (q[:, None] * sums[self.component]).reshape(X.shape)
        return X
