"""Matrices and right-hand sides of the tests."""
import numpy as np
import scipy.sparse as sp


def grid(side, shift=0.1):
    """The Laplacian of a grid of side x side vertices, plus shift; both triangles, CSC."""
    path = sp.diags([np.full(side - 1, -1.0)] * 2, [-1, 1], shape=(side, side))
    edges = sp.kron(sp.identity(side), path) + sp.kron(path, sp.identity(side))
    degree = -np.asarray(edges.sum(axis=1)).ravel()
    return (edges + sp.diags(degree + shift)).tocsc()


def right_hand_sides(n, count=None):
    return np.random.default_rng(1).standard_normal(n if count is None else (n, count))
