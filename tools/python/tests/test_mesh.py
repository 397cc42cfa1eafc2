"""Matrices of meshes, against formulas, and what is refused."""
import numpy as np
import pytest

import sparse_local as sl
from sparse_local import mesh

SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
HALVES = np.array([[0, 1, 2], [0, 2, 3]])


def test_a_square():
    L, mass = mesh.laplacian(SQUARE, HALVES)
    assert np.allclose(L.toarray(), [[1, -.5, 0, -.5], [-.5, 1, -.5, 0], [0, -.5, 1, -.5],
                                     [-.5, 0, -.5, 1]])
    assert np.allclose(mass, [1 / 3, 1 / 6, 1 / 3, 1 / 6])
    assert sorted(map(tuple, mesh.boundary(HALVES))) == [(0, 1), (1, 2), (2, 3), (3, 0)]


def test_the_energy_of_a_linear_function_is_exact():
    rng = np.random.default_rng(0)
    points = np.concatenate([SQUARE, [[0.3, 0.6]]]) + 0.0
    triangles = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    L, mass = mesh.laplacian(points, triangles)
    slope = rng.standard_normal(2)
    f = points @ slope
    assert np.isclose(f @ (L @ f), slope @ slope)
    assert np.isclose(mass.sum(), 1)


def test_integers_of_any_kind_and_three_dimensions():
    points = np.column_stack([SQUARE, np.zeros(4)]).astype(np.float32)
    L, _ = mesh.laplacian(points, HALVES.astype(np.uint16))
    assert np.allclose(L.toarray(), mesh.laplacian(SQUARE, HALVES)[0].toarray())


def test_flat_triangles_and_free_vertices_add_nothing():
    points = np.concatenate([SQUARE, [[2, 2]], [[0.5, 0.5]]])
    L, mass = mesh.laplacian(points, np.concatenate([HALVES, [[0, 5, 2]]]))
    assert np.allclose(L.toarray()[:4, :4], mesh.laplacian(SQUARE, HALVES)[0].toarray())
    assert mass[4] == 0 and not L.toarray()[4].any() and np.isfinite(L.toarray()).all()


def test_rounding_of_a_flat_triangle_adds_no_cotangents():
    third = np.array([[0.1, 0.1], [0.2, 0.2], [0.3, 0.3 + 6e-17]])
    L, mass = mesh.laplacian(third, [[0, 1, 2]])
    assert not L.toarray().any() and mass.sum() < 1e-16
    L, _ = mesh.laplacian([[0, 0], [1, 0], [0.5, 1e-6]], [[0, 1, 2]])  # thin, but not flat
    assert np.linalg.eigvalsh(L.toarray())[0] > -1e-9 * abs(L).max() and abs(L).max() > 1e5


@pytest.mark.parametrize("points, triangles, words", [
    (SQUARE, [[0, 1, 4]], "triangle 0"), (SQUARE, [[0, 1, 2], [0, -1, 2]], "triangle 1"),
    (SQUARE * np.nan, HALVES, "finite"), (SQUARE[:, 0], HALVES, "shape"),
    (SQUARE, HALVES + 0.0, "triangles"), (SQUARE, HALVES[:, :2], "triangles")])
def test_wrong_meshes(points, triangles, words):
    with pytest.raises(sl.ArgumentError, match=words):
        mesh.laplacian(points, triangles)


def test_a_closed_surface_has_no_boundary():
    faces = np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])
    assert len(mesh.boundary(faces)) == 0 and len(mesh.boundary(faces[:0])) == 0
