"""scikit-fem.py: each kind of system that scikit-fem gives to its direct solver

scikit-fem.py features | size
"""
import sys
import time

import numpy as np
from report import report, report_time
from skfem import (Basis, BilinearForm, ElementTetP1, ElementTriMorley, ElementTriP1, ElementTriP2,
                   ElementVector, LinearForm, MeshTet, MeshTri, bmat, condense, enforce, mpc,
                   penalize, solve)
from skfem.helpers import ddot, dd, div, dot, grad
from skfem.models.elasticity import lame_parameters, linear_elasticity
from skfem.models.poisson import laplace, mass, unit_load


@BilinearForm
def convection(u, v, w):
    return dot(grad(u), grad(v)) + 20 * grad(u)[0] * v


@BilinearForm
def pressure(u, v, w):
    return -div(u) * v


@BilinearForm
def bending(u, v, w):
    return ddot(dd(u), dd(v))


@LinearForm
def swirl(v, w):
    return v[0] * w.x[1] - v[1] * w.x[0] ** 2


def features():
    mesh = MeshTri().refined(4)
    basis = Basis(mesh, ElementTriP2())
    A, M, b = laplace.assemble(basis), mass.assemble(basis), unit_load.assemble(basis)
    border = basis.get_dofs()
    report("condense", solve(*condense(A, b, D=border)))
    report("enforce", solve(*enforce(A, b, D=border)))
    report("penalize", solve(*penalize(A, b, D=border, epsilon=1e-6)))
    given = np.sin(3 * basis.doflocs[0])
    report("given_values", solve(*condense(A, b, x=given, D=border)))
    report("time_step", solve(M + 0.01 * A, M @ given))
    report("nonsymmetric", solve(*condense(convection.assemble(basis), b, D=border)))
    report("helmholtz_indefinite", solve(*condense(A - 200 * M, b, D=border)))
    wave = solve(*condense(A - (200 + 5j) * M, b.astype(complex), D=border))
    report("helmholtz_complex", [wave.real, wave.imag])
    left, right = (basis.get_dofs(lambda x: x[0] == side).flatten() for side in (0, 1))
    report("periodic", solve(*mpc(A + M, b, S=left, M=right)))

    plate = Basis(mesh, ElementTriMorley())
    report("plate", solve(*condense(bending.assemble(plate), unit_load.assemble(plate),
                                    D=plate.get_dofs())))

    flow = Basis(mesh, ElementVector(ElementTriP2()))
    heads = flow.with_element(ElementTriP1())
    B = pressure.assemble(flow, heads)
    K = BilinearForm(lambda u, v, w: ddot(grad(u), grad(v))).assemble(flow)
    C = 1e-6 * mass.assemble(heads)
    report("stokes", solve(*condense(bmat([[K, B.T], [B, -C]], "csc"),
                                     np.concatenate([swirl.assemble(flow), np.zeros(B.shape[0])]),
                                     D=flow.get_dofs().flatten())))

    solid = Basis(MeshTet().refined(3), ElementVector(ElementTetP1()))
    load = LinearForm(lambda v, w: -v[2]).assemble(solid)
    stiffness = linear_elasticity(*lame_parameters(1e3, 0.3)).assemble(solid)
    report("elasticity", solve(*condense(stiffness, load, D=solid.get_dofs(lambda x: x[0] == 0))))


def size():
    basis = Basis(MeshTri().refined(8), ElementTriP1())
    A, b = laplace.assemble(basis), unit_load.assemble(basis)
    system = condense(A, b, D=basis.get_dofs())
    begin = time.process_time()
    x = solve(*system)
    report_time(time.process_time() - begin)
    report("size", x)


{"features": features, "size": size}[sys.argv[1]]()
