"""The structs of the package against those that a C compiler sees."""
import ctypes
import os
import platform
import re
import subprocess

import pytest
import scipy.sparse

import sparse_local as sl
from sparse_local import _structs
from sparse_local._library import lib


# members of a struct in the struct of C, which is no struct here
RENAMED = {"thread_count": "count", "thread_run": "run", "thread_context": "context",
           "allocator_context": "context"}
HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "csrc")


@pytest.mark.skipif(not os.path.exists(HEADER), reason="no header beside the package")
@pytest.mark.parametrize("name", ["Options", "Stats", "Csc", "Csc64", "SavedSet", "SymbolicArrays",
                                  "PseudoInverse", "FactorArrays", "Hermitian", "Request",
                                  "FixedArrays", "SelectedArrays", "RegionArrays"])
def test_structs_are_those_of_the_header(tmp_path, name):
    """Every member of the C struct, in order, at the same offset, and nothing after the last."""
    struct = {"Options": "sl_options", "Stats": "sl_stats", "Csc": "sl_csc", "Csc64": "sl_csc64",
              "SavedSet": "sl_saved_set", "SymbolicArrays": "sl_symbolic_arrays",
              "PseudoInverse": "sl_pseudo_inverse", "FactorArrays": "sl_factor_arrays",
              "Hermitian": "sl_hermitian", "Request": "sl_request",
              "FixedArrays": "sl_fixed_arrays", "SelectedArrays": "sl_selected_arrays",
              "RegionArrays": "sl_region_arrays"}[name]
    ours = dict(leaves(getattr(_structs, name)))
    with open(os.path.join(HEADER, "sparse_local.h")) as file:
        theirs = c_members(file.read(), struct)
    paths = ["size_of_all"] + theirs
    lines = ["%s" % ("sizeof(%s)" % struct if path == "size_of_all" else
                     "offsetof(%s, %s)" % (struct, path)) for path in paths]
    source = tmp_path / "offsets.c"
    source.write_text('#include <stddef.h>\n#include <stdio.h>\n#include "sparse_local.h"\n'
                      "int main(void) {\n%s    return 0;\n}\n" %
                      "".join('    printf("%%zu\\n", %s);\n' % line for line in lines))
    subprocess.check_call(["cc", "-DSL_WITH_ALL", "-I", HEADER, "-o", str(tmp_path / "offsets"),
                           str(source)])
    numbers = subprocess.check_output([str(tmp_path / "offsets")], text=True).split()
    assert int(numbers[0]) == ctypes.sizeof(getattr(_structs, name))
    assert [int(text) for text in numbers[1:]] == list(ours.values())
    assert [path.split(".")[-1] for path in theirs] == [
        RENAMED.get(path.split(".")[-1], path.split(".")[-1]) for path in ours]


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="the ABI of x86-64")
def test_views_are_returned_through_a_first_argument():
    """As tools/packaging/sparse_local.c tells bindings that cannot declare structs."""
    F = sl.Factor(scipy.sparse.diags([2.0, 3.0, 4.0], format="csc"))
    views = {"symbolic": F._symbolic.pointer, "factor": F._pointer}
    for kind, pointer in views.items():
        struct = getattr(_structs, kind.capitalize() + "Arrays")
        call = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)(
            ctypes.cast(getattr(lib, "sl_%s_view" % kind), ctypes.c_void_p).value)
        result = struct()
        assert call(ctypes.addressof(result), pointer) == ctypes.addressof(result)
        assert bytes(result) == bytes(getattr(lib, "sl_%s_view" % kind)(pointer))
        assert ctypes.sizeof(struct) > 16


def leaves(struct, prefix="", start=0):
    """The members of a ctypes struct that are not structs, with their offsets."""
    for name, kind in struct._fields_:
        offset = start + getattr(struct, name).offset
        if issubclass(kind, ctypes.Structure):
            yield from leaves(kind, prefix + name + ".", offset)
        else:
            yield prefix + name, offset


def c_members(text, struct):
    """The members of a C struct as paths, in order; members of type sl_... info are opened."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
    body = re.search(r"typedef struct %s \{(.*?)\} %s;" % (struct, struct), text, re.S).group(1)
    paths = []
    for line in body.split(";"):
        if "(*" in line:
            paths.append(re.search(r"\(\*(\w+)\)", line).group(1))
            continue
        match = re.match(r"\s*(?:const |unsigned )*(\w+)(.*)", line, re.S)
        if not match:
            continue
        for declared in match.group(2).replace("const ", "").split(","):
            name = re.search(r"\w+", declared)
            if not name:
                continue
            name = name.group(0)
            inner = "typedef struct %s {" % match.group(1)
            if inner in text and "*" not in declared:
                paths += [name + "." + path for path in c_members(text, match.group(1))]
            else:
                paths.append(name)
    return paths
