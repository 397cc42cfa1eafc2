"""LaPy.py: each function of LaPy that solves by sksparse

LaPy.py features | size
"""
import sys
import time

import numpy as np
from lapy import Solver, TetMesh, TriaMesh, diffgeo, heat
from lapy.conformal import spherical_conformal_map
from report import report, report_time


def grid(rows, columns, closed):
    """Two triangles in each square; rows and columns close in a torus."""
    stride = columns + (not closed)
    r, c = np.mgrid[:rows, :columns].reshape(2, -1)
    r1, c1 = (r + 1) % (rows + (not closed)), (c + 1) % stride
    a, b, d, e = r * stride + c, r * stride + c1, r1 * stride + c, r1 * stride + c1
    return np.concatenate([np.stack([a, b, e], 1), np.stack([a, e, d], 1)])


def torus(n):
    u, v = np.mgrid[:2 * n, :n].reshape(2, -1) * (np.pi / n)
    v = 2 * v
    tube = 0.4 + 0.05 * np.sin(3 * u) * np.cos(v)
    away = 1 + tube * np.cos(v)
    points = np.stack([away * np.cos(u), away * np.sin(u), tube * np.sin(v)], 1)
    return TriaMesh(points, grid(2 * n, n, True))


def sheet(n):
    y, x = np.mgrid[:n + 1, :n + 1].reshape(2, -1) / n
    points = np.stack([x, y, 0.1 * np.sin(7 * x + 1) * np.cos(5 * y)], 1)
    return TriaMesh(points, grid(n, n, False))


def ball(n):
    """An octahedron whose edges are halved n times, on an ellipsoid."""
    v = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    t = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    mesh = TriaMesh(v, t)
    mesh.refine_(n)
    points = mesh.v / np.linalg.norm(mesh.v, axis=1)[:, None]
    return TriaMesh(points * [1, 1.2, 0.8], mesh.t)


def cube(n):
    """Six tetrahedra in each cell."""
    points = np.stack(np.mgrid[:n + 1, :n + 1, :n + 1].reshape(3, -1), 1) / n
    step = np.array([(n + 1) ** 2, n + 1, 1])
    first = np.stack(np.mgrid[:n, :n, :n].reshape(3, -1), 1) @ step
    tets = []
    for way in [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]:
        corners = np.cumsum([0, *step[list(way)]])
        tets.append(first[:, None] + corners)
    mesh = TetMesh(points, np.concatenate(tets))
    mesh.orient_()
    return mesh


def features():
    for name, mesh in [("open", sheet(20)), ("closed", torus(14)), ("tets", cube(8))]:
        u = heat.diffusion(mesh, [3, 70], m=1.0, use_cholmod=True)
        report("diffusion_" + name, u)
        report("geodesics_" + name, diffgeo.compute_geodesic_f(mesh, u, use_cholmod=True))
        fem = Solver(mesh, lump=True, use_cholmod=True)
        report("eigenvalues_" + name, fem.eigs(k=8)[0])
        held = (np.array([0, 5, 9]), np.array([1.0, -1.0, 2.0]))
        report("dirichlet_" + name, fem.poisson(1.0, dtup=held))
    flow = diffgeo.tria_mean_curvature_flow(ball(3), max_iter=5, use_cholmod=True)
    report("curvature_flow", flow.v)
    report("conformal", spherical_conformal_map(ball(3), use_cholmod=True))
    several = heat.diffusion(sheet(20), [[3], [70], [5, 9]], use_cholmod=True)
    report("diffusion_several", several)


def size():
    mesh = torus(142)
    begin = time.process_time()
    u = heat.diffusion(mesh, [0], m=1.0, use_cholmod=True)
    distance = diffgeo.compute_geodesic_f(mesh, u, use_cholmod=True)
    report_time(time.process_time() - begin)
    report("size", distance)


{"features": features, "size": size}[sys.argv[1]]()
