"""The types of the package: a program that mypy accepts, one that it refuses, and the stubs against
the modules."""
import ast
import inspect
import os
import shutil
import subprocess

import pytest

import sparse_local
from sparse_local import _options, gradients, linalg, mesh, qdldl

PROGRAM = """
import numpy as np
import scipy.sparse as sp
import sparse_local as sl
from sparse_local import gradients, linalg

A = sp.identity(3, format="csc")
F = sl.Factor(A, null_pivots="skip", mass=np.ones(3), threads=2)
x = F.solve(np.ones(3)) + F.local([1], [1.0], [2, 0])[0]
P: sl.Plan = F.plan(None, np.arange(3), region=F.region(range(3)))
with sl.Factor.load("a.slf", map=True) as G:
    sign, log = G.logdet()
    y = P.on(G).solve([1.0])[0] + log
d = sl.load_set("a.slf").factor.diagonal()[0]
B = sl.from_triplets(1, [0], [0], [1.0])
g, v = gradients.solve_gradient(F, A, x, x)
lu = linalg.splu(A)
L, mass = sl.mesh.laplacian(np.zeros((3, 2)), [[0, 1, 2]])
"""
WRONG = ["sl.Factor(A, null_pivot='skip')", "sl.Factor(A, ordering='best')",
         "sl.Factor(np.eye(3))", "F.solve()", "F.plan([1.5], [2])", "F.solves(x)",
         "F.inertia = 3", "'a' + F.logdet()[1]", "sl.factor(A)"]


def mypy(tmp_path, *arguments):
    # The modules are checked from their source, without those of NumPy and SciPy.
    program = shutil.which("mypy") or pytest.skip("mypy is not installed: apt-get install mypy")
    found = os.path.dirname(os.path.dirname(os.path.abspath(sparse_local.__file__)))
    env = dict(os.environ, MYPYPATH=found, PYTHONPATH=found)
    return subprocess.run([program, "--ignore-missing-imports", "--cache-dir",
                           str(tmp_path / "cache"), *arguments], capture_output=True, text=True,
                          env=env, cwd=tmp_path)


def test_programs(tmp_path):
    (tmp_path / "right.py").write_text(PROGRAM)
    lines = PROGRAM.count("\n")
    (tmp_path / "wrong.py").write_text(PROGRAM + "".join(line + "\n" for line in WRONG))
    out = mypy(tmp_path, "right.py", "wrong.py")
    numbers = {int(line.split(":")[1]) for line in out.stdout.splitlines()
               if line.startswith("wrong.py") and ": error:" in line}
    assert "right.py" not in out.stdout, out.stdout
    assert numbers == set(range(lines + 1, lines + 1 + len(WRONG))), out.stdout


def parameters(function):
    """{name: (has it a default, is it given by name alone)} of a function in a stub, without self,
    in their order."""
    a = function.args
    plain = a.posonlyargs + a.args
    found = {arg.arg: (k >= len(plain) - len(a.defaults), False) for k, arg in enumerate(plain)}
    found.update((arg.arg, (default is not None, True)) for arg, default in zip(a.kwonlyargs,
                                                                                a.kw_defaults))
    return {name: value for name, value in found.items() if name not in ("self", "cls")}


def compare(stub, function, place):
    """A function of a stub and that of the module: the same parameters, or its options."""
    real = inspect.signature(function).parameters
    kinds = {p.kind for p in real.values()}
    wanted = {name: (p.default is not p.empty, p.kind is p.KEYWORD_ONLY) for name, p in real.items()
              if p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL) and name not in ("self", "cls")}
    got = parameters(stub)
    if inspect.Parameter.VAR_KEYWORD in kinds and not stub.args.kwarg:
        assert got.keys() - wanted.keys() <= set(_options.ANALYSIS + _options.NUMBERS), place
        got = {name: value for name, value in got.items() if name in wanted}
    assert list(got.items()) == list(wanted.items()), place


def test_arguments_have_the_order_of_c():
    """What promise.md freezes: one order in all languages, and options by their names."""
    wanted = {sparse_local.Constraints.solve: "self B values", sparse_local.FixedRows.solve:
              "self B values", sparse_local.Factor.local: "self bset B xset",
              sparse_local.from_triplets: "n rows columns values", sparse_local.Factor.refine:
              "self A X B", sparse_local.Plan: "factor bset xset", sparse_local.Factor.plan:
              "self bset xset", sparse_local.save_set: "path factor"}
    for call, names in wanted.items():
        positional = [name for name, p in inspect.signature(call).parameters.items()
                      if p.kind is not p.KEYWORD_ONLY]
        assert " ".join(positional) == names, call


@pytest.mark.parametrize("module", [sparse_local, linalg, gradients, mesh, qdldl])
def test_public_names_are_listed(module):
    own = {name for name, value in vars(module).items() if not name.startswith("_") and
           getattr(value, "__module__", None) == module.__name__ or
           module is sparse_local and not name.startswith("_") and not inspect.ismodule(value)}
    assert own <= set(module.__all__) and all(hasattr(module, name) for name in module.__all__)


@pytest.mark.parametrize("module", [sparse_local, linalg, gradients, mesh])
def test_stubs_are_those_of_the_modules(module):
    """Every public name, method and parameter, in both directions."""
    path = module.__file__ + "i"
    with open(path) as file:
        stub = ast.parse(file.read())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
    public = set(module.__all__)
    assert public <= classes.keys() | functions.keys()
    for name, node in functions.items():
        compare(node, getattr(module, name), name)
    for name, node in classes.items():
        if name.startswith("_") or name == "CscArrays":
            continue
        kind, methods = getattr(module, name), {}
        for member in node.body:
            if isinstance(member, ast.FunctionDef):
                methods[member.name] = member
                real = inspect.getattr_static(kind, member.name)
                if not isinstance(real, property):
                    compare(member, getattr(kind, member.name), name + "." + member.name)
        if not issubclass(kind, Exception):
            assert {m for m in dir(kind) if not m.startswith("_")} <= methods.keys(), name


def test_a_wheel_has_the_types():
    folder = os.path.dirname(os.path.abspath(sparse_local.__file__))
    for name in ("py.typed", "__init__.pyi", "linalg.pyi", "gradients.pyi", "mesh.pyi"):
        assert os.path.exists(os.path.join(folder, name))
