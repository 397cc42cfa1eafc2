"""The installed wheel: the compiled library is inside, NumPy is all that it needs, and its tag is
that of the library. make test-wheels looks at the wheels of a release."""
import codecs
import glob
import os
import re
import shutil
import subprocess
import sys
import zipfile

import pytest

import sparse_local as sl

PACKAGE = os.path.dirname(os.path.abspath(sl.__file__))
INFO = glob.glob(os.path.join(os.path.dirname(PACKAGE), "sparse_local-*.dist-info"))
HERE = os.path.dirname(os.path.abspath(__file__))
SCRIPT = os.path.join(HERE, "..", "wheel_tag.py")
BUILT = glob.glob(os.path.join(HERE, "..", "..", "wheel", "*.whl"))

# every other module that is imported raises ImportError, as where it is not installed
ALONE = """
import sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("scipy", "torch", "sksparse", "qdldl", "matplotlib"):
            raise ImportError("not installed: " + name)

sys.meta_path.insert(0, Absent())
import numpy as np
import sparse_local as sl
n = 30
k = np.arange(n)
values = np.r_[np.full(n, 2.5), np.full(n - 1, -1.0)]
A = sl.from_triplets(n, np.r_[k, k[1:]], np.r_[k, k[:-1]], values)
assert type(A) is sl.CscArrays and A.shape == (n, n)
dense = np.zeros((n, n))
for j in range(n):
    for p in range(A.indptr[j], A.indptr[j + 1]):
        dense[A.indices[p], j] = dense[j, A.indices[p]] = A.data[p]
F, b = sl.Factor(A), np.cos(k)
x = F.solve(b)
assert np.allclose(dense @ x, b) and np.array_equal(F.local(k, b, [3]), x[[3]])
assert np.allclose(F.diagonal(), np.linalg.inv(dense).diagonal())
assert np.allclose(F.constraints([3]).solve(None, [1.0])[3], 1)
L, D, perm = F.factors()
assert L.shape == D.shape == (n, n)
by_b, by_a = sl.gradients.solve_gradient(F, A, x, np.ones(n))
assert by_a.shape == A.data.shape
assert np.allclose(sl.Sum([A]).factor([2.0]).solve(b) * 2, x)
F.refactor(A)
assert sl.Factor.from_bytes(F.to_bytes()).n == n
assert sl.mesh.boundary(np.array([[0, 1, 2]])).shape == (3, 2)
assert not hasattr(sl, "meshes")
assert not any(name.startswith("scipy") for name in sys.modules)
print("done")
"""


def test_numpy_is_enough():
    out = subprocess.run([sys.executable, "-c", ALONE], capture_output=True, text=True)
    assert out.stdout == "done\n", out.stderr


def metadata(name):
    with open(os.path.join(INFO[0], name)) as file:
        return file.read()


@pytest.mark.skipif(not INFO, reason="the package is not installed from a wheel")
def test_the_wheel_is_of_this_platform_and_of_any_python():
    lines = metadata("WHEEL").splitlines()
    assert "Root-Is-Purelib: false" in lines
    tags = [line.split(": ")[1] for line in lines if line.startswith("Tag")]
    assert len(tags) == 1 and tags[0].startswith("py3-none-") and not tags[0].endswith("-any")
    needed = [line for line in metadata("METADATA").splitlines()
              if line.startswith("Requires-Dist") and "extra ==" not in line]
    assert needed == ["Requires-Dist: numpy"]


@pytest.mark.skipif(not INFO or "SPARSE_LOCAL_LIBRARY" in os.environ,
                    reason="not installed from a wheel, or another library is chosen")
def test_the_library_is_inside():
    assert os.path.dirname(sl.library_path()) == PACKAGE
    name = "sparse_local/" + os.path.basename(sl.library_path())
    assert any(line.startswith(name + ",sha256=") for line in metadata("RECORD").splitlines())
    assert "sparse_local/sksparse/cholmod.py" in metadata("RECORD")


# ---- Windows, whose DLL make test-wheels loads ----

def test_paths_on_windows_are_in_its_code_page(monkeypatch):
    from sparse_local import _files
    page = codecs.lookup("cp1252")
    codecs.register(lambda name: page if name == "mbcs" else None)  # Python has it on Windows alone
    assert _files.encoded("fl\u00e4che") == "fl\u00e4che".encode()
    monkeypatch.setattr(_files.sys, "platform", "win32")
    assert _files.encoded("fl\u00e4che") == b"fl\xe4che"
    assert _files.encoded("fl\u00e4che".encode()) == b"fl\xe4che"
    with pytest.raises(sl.ArgumentError, match="code page"):
        _files.encoded("\u9762.slf")


def test_the_dll_has_its_name_there(monkeypatch):
    from sparse_local import _library
    for platform, name in (("win32", "sparse_local.dll"), ("darwin", "libsparse_local.dylib"),
                           ("linux", "libsparse_local.so")):
        monkeypatch.setattr(_library.sys, "platform", platform)
        monkeypatch.setattr(_library.os.path, "exists", lambda path: True)
        monkeypatch.delenv("SPARSE_LOCAL_LIBRARY", raising=False)
        assert _library.library_path() == os.path.join(PACKAGE, name)


# ---- tags ----

tags = pytest.mark.skipif(not BUILT or not shutil.which("objdump") or sys.platform != "linux",
                          reason="no wheel beside the tests, no objdump, or not Linux")


def wheel_tag(*arguments):
    return subprocess.run([sys.executable, "-B", SCRIPT, *map(str, arguments)],
                          capture_output=True, text=True)


def newest_glibc(library):
    listing = subprocess.run(["objdump", "-T", library], capture_output=True, text=True).stdout
    return max(int(minor) for minor in re.findall(r"GLIBC_2\.(\d+)", listing))


@pytest.fixture
def tagged(tmp_path):
    """The wheel of this machine, copied, with the tag that its library allows."""
    out = wheel_tag(shutil.copy(BUILT[0], tmp_path))
    assert out.returncode == 0, out.stderr
    return out.stdout.strip()


@tags
def test_the_tag_is_that_of_the_symbols(tagged):
    assert os.listdir(os.path.dirname(tagged)) == [os.path.basename(tagged)]
    assert "manylinux_2_%d_" % newest_glibc(sl.library_path()) in tagged
    with zipfile.ZipFile(tagged) as wheel:
        info = [name for name in wheel.namelist() if name.endswith(".dist-info/WHEEL")]
        lines = wheel.read(info[0]).decode().splitlines()
    found = [line.split("-")[-1] for line in lines if line.startswith("Tag: py3-none-")]
    assert ".".join(found) == tagged[:-len(".whl")].split("-")[-1]
    assert wheel_tag("--check", tagged).returncode == 0


@tags
def test_pip_installs_the_tagged_wheel_in_a_fresh_environment(tagged, tmp_path):
    fresh = tmp_path / "fresh"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", fresh],
                   check=True)
    python = str(fresh / "bin" / "python")
    install = [python, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps",
               "--find-links", os.path.dirname(tagged), "--only-binary=:all:", "sparse_local"]
    environment = {name: os.environ[name] for name in os.environ if name != "PYTHONPATH"}
    subprocess.run(install, check=True, env=environment)
    out = subprocess.run([python, "-B", "-c", ALONE + "print(sl.__file__)"], env=environment,
                         capture_output=True, text=True)
    assert out.stdout.startswith("done\n%s/" % fresh), out.stderr


@tags
def test_a_wrong_tag_or_record_is_refused(tagged):
    for wrong in ("linux_x86_64", "manylinux_2_5_x86_64", "musllinux_1_2_x86_64", "win_amd64"):
        name = tagged.rsplit("-", 1)[0] + "-%s.whl" % wrong
        shutil.copy(tagged, name)
        out = wheel_tag("--check", name)
        assert out.returncode == 1 and "the tag %s, and its library allows" % wrong in out.stderr
    out = wheel_tag("--check", BUILT[0])
    assert out.returncode == 1 and "the tag linux_" in out.stderr
    with zipfile.ZipFile(tagged, "a") as wheel:
        wheel.writestr("sparse_local/more.py", "")
    out = wheel_tag("--check", tagged)
    assert out.returncode == 1 and "RECORD does not have sparse_local/more.py" in out.stderr


@tags
@pytest.mark.parametrize("code, flags, reason", [
    ("int sl_a(void) { return 0; }", [], None),
    ("int sl_a(void) { return 0; } int other(void) { return 1; }", [], "it exports other"),
    ("static int a;", [], "it exports nothing"),
    ("int sl_a(void) { return 0; }", ["-Wl,-rpath,/opt/lib"], "RPATH"),
    ("int zlibVersion(void); int sl_a(void) { return zlibVersion(); }",
     ["-Wl,--no-as-needed", "-lgomp"], "it needs libgomp.so.1"),
])
def test_a_library_that_does_not_run_elsewhere_is_refused(tmp_path, code, flags, reason):
    (tmp_path / "a.c").write_text(code)
    library = tmp_path / "libsparse_local.so"
    subprocess.run(["cc", "-shared", "-fPIC", tmp_path / "a.c", "-o", library] + flags, check=True)
    wheel = tmp_path / "a-1-py3-none-linux_x86_64.whl"
    with zipfile.ZipFile(wheel, "w") as file:
        file.write(library, "sparse_local/libsparse_local.so")
        file.writestr("a-1.dist-info/WHEEL", "Wheel-Version: 1.0\nTag: py3-none-linux_x86_64\n")
        file.writestr("a-1.dist-info/RECORD", "")
    out = wheel_tag(wheel)
    assert out.returncode == (reason is not None)
    assert (reason or "") in out.stderr and wheel.exists() == (reason is not None)


@tags
def test_a_wheel_without_one_library_is_refused(tmp_path):
    for names in ([], ["a.so", "b.so"], ["a.so"]):
        with zipfile.ZipFile(tmp_path / "a-1-py3-none-any.whl", "w") as file:
            for name in names:
                file.writestr(name, "no library")
        out = wheel_tag(tmp_path / "a-1-py3-none-any.whl")
        reason = "of an unknown kind" if len(names) == 1 else "it has %d libraries" % len(names)
        assert out.returncode == 1 and reason in out.stderr
