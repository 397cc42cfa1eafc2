"""Stand-ins: modules of this package under the names of others."""
import importlib
import sys

from ._errors import ArgumentError

_MODULES = {("sksparse", "0.4"): ("sksparse", ("sksparse", "sksparse.cholmod")),
            ("sksparse", "0.5"): ("sksparse05", ("sksparse", "sksparse.cholmod", "sksparse.amd")),
            ("qdldl", "0.1"): ("qdldl", ("qdldl",))}


def stand_in(name, version=None):
    """Lets programs find a module of this package under the name 'sksparse' or 'qdldl'.

    After stand_in("sksparse"), `from sksparse.cholmod import cholesky` is
    sparse_local.sksparse.cholmod, with the names of scikit-sparse 0.4. stand_in("sksparse", "0.5")
    offers those of 0.5, where cholesky returns a matrix and its order. Needs SciPy.
    ArgumentError: no such name or version; RuntimeError: another module of that name is imported
    already. It holds for this process.
    """
    versions = {v: found for (n, v), found in _MODULES.items() if n == name}
    chosen = min(versions, default="") if version is None else ".".join(version.split(".")[:2])
    if chosen not in versions:
        known = ", ".join("%s %s" % known for known in _MODULES)
        raise ArgumentError("one of %s, not %s" % (known, " ".join(filter(None, (name, version)))))
    package, modules = versions[chosen]
    for module in modules:
        ours = importlib.import_module("sparse_local." + package + module[len(name):])
        if sys.modules.get(module, ours) is not ours:
            raise RuntimeError("%s is imported already" % module)
        sys.modules[module] = ours
