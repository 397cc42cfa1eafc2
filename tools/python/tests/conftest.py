"""Fixtures: the matrix of a grid, and its factor."""
import pytest

import sparse_local as sl
from systems import grid


@pytest.fixture
def A():
    return grid(20)


@pytest.fixture
def F(A):
    return sl.Factor(A)
