"""Orders, elimination trees and separators: the functions of sksparse.cholmod without numbers."""
import ctypes

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from .._analysis import Analysis
from .._library import lib
from ..sksparse._errors import translated

_KINDS = ("sym", "row", "col", "lo")


def matrix_of(A):
    """A matrix of SciPy in compressed columns, from anything that it takes."""
    return A.tocsc() if sparse.issparse(A) else sparse.csc_matrix(np.atleast_2d(A))


def _graph(A, kind, kinds=_KINDS, is_one_triangle=True):
    """The lower triangle of the pattern that is asked about, with its diagonal; its values make it
    an M-matrix, so that no entry of its factor cancels."""
    A = matrix_of(A)
    if kind is not None and kind not in kinds:
        raise ValueError("kind is one of %s, not %r" % (", ".join(kinds), kind))
    ones = sparse.csc_matrix((np.ones(A.data.size), A.indices, A.indptr), shape=A.shape)
    if kind == "row":
        ones = ones @ ones.T
    elif kind == "col":
        ones = ones.T @ ones
    elif A.shape[0] != A.shape[1]:
        raise ValueError("a square matrix is needed, not %d x %d" % A.shape)
    elif not is_one_triangle:
        ones = ones + ones.T
    elif kind != "lo":
        ones = ones.T
    low = sparse.tril(ones, -1, format="csc")
    low.data[:] = -1.0
    degrees = np.diff(low.indptr) + np.bincount(low.indices, minlength=low.shape[0])
    return (low + sparse.diags(degrees + 1.0)).tocsc()


def _array(pointer, count):
    if not count:
        return np.zeros(0, dtype=np.int32)
    return np.ctypeslib.as_array(ctypes.cast(pointer, ctypes.POINTER(ctypes.c_int32)),
                                 (count,)).copy()


def _analyzed(graph, ordering):
    with translated():
        analysis = Analysis(graph, ordering=ordering)
    return analysis, lib.sl_symbolic_view(analysis._symbolic.pointer)


def order_of(A, kind, ordering, is_one_triangle=True):
    """The order of the graph of A as n row numbers."""
    return _analyzed(_graph(A, kind, _KINDS[:3], is_one_triangle), ordering)[0].perm


def tree_of(analysis):
    """(parent, counts) in the numbering of the rows: the elimination tree, -1 at its roots, and the
    entries of the columns of L, diagonal included."""
    view, perm = lib.sl_symbolic_view(analysis._symbolic.pointer), analysis.perm
    above, counts = _array(view.parent, perm.size), _array(view.counts, perm.size)
    parent, of_row = np.empty_like(perm), np.empty_like(perm)
    parent[perm] = np.where(above < 0, -1, perm[above])
    of_row[perm] = counts
    return parent, of_row


def _postorder(parent):
    """Rows with each subtree in one piece, children before their parent, in ascending order."""
    children, roots = [[] for _ in parent], []
    for row, above in enumerate(parent.tolist()):
        (roots if above < 0 else children[above]).append(row)
    order, stack = [], roots  # parents first and the last child first, and then reversed
    while stack:
        order.append(stack.pop())
        stack.extend(children[order[-1]])
    return np.array(order[::-1], dtype=np.int32)


def etree(A, *, kind=None, return_post=False):
    """The elimination tree of A in its own order: the parent of each row, -1 at a root; with
    return_post also a postorder. kind: 'sym' reads the upper triangle, 'lo' the lower one, 'row'
    and 'col' are A A' and A' A."""
    analysis = _analyzed(_graph(A, kind), "natural")[0]
    parent = tree_of(analysis)[0]
    return (parent, _postorder(parent)) if return_post else parent


def symbfact(A, *, kind=None, lower=False, return_factor=False):
    """(count, h, parent, post): entries of the columns of L, height of the elimination tree, the
    tree and a postorder; with return_factor also the pattern of L, or of L' unless lower."""
    graph = _graph(A, kind)
    analysis = _analyzed(graph, "natural")[0]
    parent, count = tree_of(analysis)
    depth = np.zeros(parent.size, dtype=np.int64)
    post = _postorder(parent)
    for row in post[::-1]:  # parents come after their children
        depth[row] = 1 + (depth[parent[row]] if parent[row] >= 0 else 0)
    out = count, int(depth.max(initial=0)), parent, post
    if not return_factor:
        return out
    with translated():
        L = analysis.factor(graph).lower()
    back = np.argsort(analysis.perm)
    L = L[back][:, back].astype(bool)
    L.sort_indices()
    return out + (sparse.csc_array(L if lower else L.T),)


def metis(A, *, kind=None):
    """A nested dissection order: that of this library, which has its own partitioner."""
    return order_of(A, kind, "nd")


def nesdis(A, *, kind=None, return_separator=False, nd_small=None, nd_components=None,
           nd_oksep=None, nd_camd=None):
    """A nested dissection order, and with return_separator its SeparatorTree, pruned by nd_small
    and nd_oksep if they are given. nd_components and nd_camd have no meaning here."""
    analysis, view = _analyzed(_graph(A, kind, _KINDS[:3]), "nd")
    p = analysis.perm
    if not return_separator:
        return p
    member = np.zeros_like(p)
    parents = np.full(1, -1, dtype=np.int32)
    if view.n_nodes > 0:
        parents = _array(view.node_parent, view.n_nodes)
        member[p] = _array(view.node_of, p.size)
    tree = SeparatorTree(parents, member)
    is_pruned = nd_small is not None or nd_oksep is not None
    return p, tree.prune(nd_small=nd_small, nd_oksep=nd_oksep) if is_pruned else tree


class SeparatorTree:
    """cp[c]: the parent of component c of a nested dissection, -1 at a root; cmember[i]: the
    component of row i. Components come before their parents."""

    def __init__(self, cp, cmember):
        self.cp, self.cmember = cp, cmember

    def __repr__(self):
        return "SeparatorTree(components=%d, nodes=%d)" % (len(self.cp), len(self.cmember))

    def prune(self, *, nd_oksep=None, nd_small=None):
        """A tree without the separators of fewer than nd_small rows in all below them (200), and
        without those that have nd_oksep (1.0) of these rows or more."""
        oksep, small = 1.0 if nd_oksep is None else nd_oksep, 200 if nd_small is None else nd_small
        own = np.bincount(self.cmember, minlength=len(self.cp))
        below = own.copy()
        for c, parent in enumerate(self.cp):
            if parent >= 0:
                below[parent] += below[c]
        kept_in = np.empty(len(self.cp), dtype=np.int64)
        is_whole = np.zeros(len(self.cp), dtype=bool)  # it and all below it are one component
        for c in range(len(self.cp) - 1, -1, -1):
            parent = self.cp[c]
            is_inside = parent >= 0 and is_whole[parent]
            kept_in[c] = kept_in[parent] if is_inside else c
            is_whole[c] = is_inside or below[c] < small or own[c] >= oksep * below[c]
        kept = np.unique(kept_in)
        number = np.full(len(self.cp) + 1, -1, dtype=np.int32)
        number[kept] = np.arange(kept.size)
        return SeparatorTree(number[self.cp[kept]], number[kept_in[self.cmember]])


def bisect(A, *, kind=None):
    """0, 1 or 2 for each row: the two sides of the graph, and the separator between them."""
    graph = _graph(A, kind, _KINDS[:3])
    n = graph.shape[0]
    analysis, view = _analyzed(graph, "nd")
    side = np.zeros(n, dtype=np.int32)
    if view.n_nodes < 3:
        return _bisected_by_levels(graph, side)
    parents, member = _array(view.node_parent, view.n_nodes), np.empty(n, dtype=np.int32)
    member[analysis.perm] = _array(view.node_of, n)
    roots = np.flatnonzero(parents < 0)
    top = np.arange(len(parents))  # the part that a node belongs to
    for c in range(len(parents) - 1, -1, -1):
        is_top = parents[c] < 0 or (roots.size == 1 and parents[c] == roots[0])
        top[c] = c if is_top else top[parents[c]]
    part = top[member]
    if roots.size == 1:
        side[part == roots[0]] = 2
    sizes, filled = np.bincount(part[side != 2], minlength=len(parents)), [0, 0]
    for c in np.argsort(-sizes):
        if sizes[c]:
            lighter = int(filled[1] < filled[0])
            filled[lighter] += sizes[c]
            side[(part == c) & (side != 2)] = lighter
    return side


def _bisected_by_levels(graph, side):
    """Of a small graph: half of the rows in the order of a search from one of them."""
    n, whole = side.size, graph + graph.T
    order, seen = [], np.zeros(n, dtype=bool)
    for first in range(n):
        if not seen[first]:
            order.append(csgraph.breadth_first_order(whole, first, False, False))
            seen[order[-1]] = True
    if n:
        side[np.concatenate(order)[n // 2:]] = 1
    cross = whole.tocoo()
    side[cross.row[(side[cross.row] == 0) & (side[cross.col] == 1)]] = 2
    return side
