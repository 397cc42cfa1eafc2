"""Stand-ins: modules of this package under the names of others."""
import importlib
import sys

_MODULES = {"sksparse": ("sksparse", "sksparse.cholmod"), "qdldl": ("qdldl",)}


def stand_in(*names):
    """Lets programs find modules of this package under the names 'sksparse' and 'qdldl'.

    After stand_in("sksparse"), `from sksparse.cholmod import cholesky` is
    sparse_local.sksparse.cholmod. Needs SciPy. RuntimeError: the module of that name is imported
    already. It holds for this process.
    """
    for name in names:
        if name not in _MODULES:
            raise ValueError("one of %s, not %r" % (", ".join(_MODULES), name))
        for module in _MODULES[name]:
            ours = importlib.import_module("sparse_local." + module)
            if sys.modules.get(module, ours) is not ours:
                raise RuntimeError("%s is imported already" % module)
            sys.modules[module] = ours
