"""Stand-ins: modules of this package under the names of others."""
import importlib
import sys

_MODULES = {("sksparse", "0.4"): ("sksparse", ("sksparse", "sksparse.cholmod")),
            ("sksparse", "0.5"): ("sksparse05", ("sksparse", "sksparse.cholmod", "sksparse.amd")),
            ("qdldl", "0.1"): ("qdldl", ("qdldl",))}


def stand_in(*names):
    """Lets programs find modules of this package under the names 'sksparse' and 'qdldl'.

    After stand_in("sksparse"), `from sksparse.cholmod import cholesky` is
    sparse_local.sksparse.cholmod, with the names of scikit-sparse 0.4. A version may follow a name:
    stand_in("sksparse", "0.5") offers those of 0.5, where cholesky returns a matrix and its order.
    Needs SciPy.
    RuntimeError: another module of that name is imported already. It holds for this process.
    """
    for name, version in _with_versions(names):
        package, modules = _MODULES[name, version]
        for module in modules:
            ours = importlib.import_module("sparse_local." + package + module[len(name):])
            if sys.modules.get(module, ours) is not ours:
                raise RuntimeError("%s is imported already" % module)
            sys.modules[module] = ours


def _with_versions(names):
    """Pairs of a name and its version, the oldest one if none follows the name."""
    pairs = []
    for name in names:
        if name[:1].isdigit() and pairs:
            pairs[-1] = pairs[-1][0], ".".join(name.split(".")[:2])
        else:
            pairs.append((name, min((v for n, v in _MODULES if n == name), default="")))
    for pair in pairs:
        if pair not in _MODULES:
            known = ", ".join("%s %s" % known for known in _MODULES)
            raise ValueError("one of %s, not %r" % (known, " ".join(pair)))
    return pairs
