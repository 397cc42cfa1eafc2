"""The name of sksparse.amd: approximate minimum degree orders."""
from ._orders import order_of

__all__ = ["amd"]


def amd(A):
    """p with little fill in the factor of A[p][:, p]; of A + A' where A is not symmetric."""
    return order_of(A, None, "mindeg", is_one_triangle=False)
