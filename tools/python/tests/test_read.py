"""Files of strangers: limits that are compared before anything is allocated."""
import resource
import subprocess
import sys

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp

import sparse_local as sl
from systems import grid

HOSTILE = b"%%MatrixMarket matrix coordinate real general\n2000000000 2000000000 1\n1 1 1.0\n"
BANNER = b"%%MatrixMarket matrix coordinate real general\n"


def written(path, data):
    path.write_bytes(data)
    return str(path)


def test_reads_what_scipy_writes(tmp_path):
    A = grid(6)
    path = str(tmp_path / "a.mtx")
    scipy.io.mmwrite(path, sp.tril(A), symmetry="symmetric", precision=17)
    B = sl.read_matrix(path)
    assert abs(B - sp.tril(A)).max() < 1e-15 and B.shape == A.shape
    b = np.arange(36.0)
    assert np.allclose(A @ sl.Factor(B).solve(b), b)
    R = sp.random(5, 9, 0.4, "csc", random_state=1)
    scipy.io.mmwrite(path, R, precision=17)
    assert abs(sl.read_matrix(path) - R).max() < 1e-15
    scipy.io.mmwrite(path, R, field="pattern")
    assert (sl.read_matrix(path) != (R != 0).astype(float)).nnz == 0
    text = BANNER + b"% a comment\n" + b"%" + 200000 * b"x" + b"\n\n 2 2 2 \n1 1 1e0\n2 2 4D0\n"
    assert sl.read_matrix(written(tmp_path / "c.mtx", text)).diagonal().tolist() == [1.0, 4.0]


def test_claims_are_refused_before_memory_is_allocated(tmp_path):
    """In a process of its own, whose peak memory shows what was allocated."""
    assert len(HOSTILE) == 78
    path = written(tmp_path / "h.mtx", HOSTILE)
    saved = bytearray(sl.Factor(grid(6)).to_bytes())
    names = [path]
    for k, cut in enumerate((78, len(saved))):
        names.append(written(tmp_path / ("%d.slf" % k), bytes(saved[:cut])))
    claims = bytearray(saved[:78])
    claims[24:32] = (78).to_bytes(8, "little")  # the size of the file, as its header says it
    names.append(written(tmp_path / "claims.slf", bytes(claims)))
    first = next(place for place in range(0, len(saved), 8)  # where the sizes of the analysis begin
                 if int.from_bytes(saved[place:place + 8], "little") == 36)
    for place in range(first, first + 64, 8):
        huge = bytearray(saved)
        huge[place:place + 8] = (2 * 10**9).to_bytes(8, "little")
        names.append(written(tmp_path / ("n%d.slf" % place), bytes(huge)))
    program = """
import resource, sys
import sparse_local as sl
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for name in sys.argv[1:]:
    for call in (sl.read_matrix, sl.Factor.load, lambda path: sl.load_set(path, map=True)):
        try:
            call(name)
        except sl.Error as error:
            print(type(error).__name__)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
"""
    def limited():
        resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

    said = subprocess.run([sys.executable, "-c", program] + names, text=True, preexec_fn=limited,
                          capture_output=True, check=True).stdout.split()
    assert said[0] == "TooLargeError" and "OutOfMemoryError" not in said
    assert len(said) == 3 * len(names) - 2 + 1  # all but the whole file, mapped or not
    assert int(said[-1]) < 20000  # kB


def test_limits(tmp_path):
    path = written(tmp_path / "a.mtx", BANNER + b"30 20 3\n1 1 1\n2 2 2\n30 20 3\n")
    assert sl.read_matrix(path, max_rows=30, max_entries=3, max_bytes=1000).nnz == 3
    for limits, text in ((dict(max_rows=29), "30 rows"), (dict(max_entries=2), "3 entries"),
                         (dict(max_bytes=50), "bytes, of which 50")):
        with pytest.raises(sl.TooLargeError, match=text):
            sl.read_matrix(path, **limits)
    for limits in (dict(max_rows=-1), dict(max_entries=1.5), dict(max_bytes=True)):
        with pytest.raises(sl.ArgumentError):
            sl.read_matrix(path, **limits)
    for most in ("a", float("inf"), float("nan"), [5]):
        for name in ("max_rows", "max_entries", "max_bytes"):
            with pytest.raises(sl.ArgumentError):
                sl.read_matrix(path, **{name: most})
    F = sl.Factor(grid(6))
    saved = str(tmp_path / "f.slf")
    sl.save_set(saved, F)
    for load in (sl.Factor.load, sl.load_set):
        for is_mapped in (False, True):
            load(saved, map=is_mapped, max_bytes=10**6)
            with pytest.raises(sl.TooLargeError, match="bytes, of which 100 are allowed"):
                load(saved, map=is_mapped, max_bytes=100)


@pytest.mark.parametrize("before, between", [
    (b"", b" % a comment after a blank\n"), (b"", b"\t\r%\n \n"), (b"\xef\xbb\xbf", b""),
    (b"", b" " * 65534), (b"", b" " * 65536), (b"", b"%" + b"x" * 65536 + b"\n"),
    (b"", b"%" + b"\n" * 200)],
                         ids=["blank", "tab", "mark", "almost a piece", "a piece", "long", "empty"])
def test_limits_find_the_sizes_where_the_library_does(tmp_path, before, between):
    path = written(tmp_path / "a.mtx", before + BANNER + between + b"1000 1000 2\n1 1 1\n2 2 2\n")
    assert sl.read_matrix(path).shape == (1000, 1000)
    assert sl.read_matrix(path, max_rows=1000, max_entries=2).nnz == 2
    for limit in (dict(max_rows=999), dict(max_entries=1)):
        with pytest.raises(sl.TooLargeError):
            sl.read_matrix(path, **limit)


@pytest.mark.parametrize("sizes, kind", [
    (b"5 5 1000000000\n1 1 1\n", sl.TooLargeError),
    (b"1 1 99999999999999999999\n", sl.TooLargeError),
    (b"2000000 1 1\n1 1 1\n", sl.TooLargeError), (b"1 -1 1\n", sl.IoError),
    (b"1 x 1\n", sl.IoError), (b"1 1\n", sl.IoError), (b"", sl.IoError),
    (b"1 1 2\n1 1 1\n", sl.IoError),
    (b"1 1 1\n2 1 1\n", sl.IoError), (b"1 1 0\n1 1 1\n", sl.IoError)])
def test_malformed_files(tmp_path, sizes, kind):
    with pytest.raises(kind):
        sl.read_matrix(written(tmp_path / "a.mtx", BANNER + sizes))


def test_what_is_no_file(tmp_path):
    for path in (str(tmp_path), str(tmp_path / "none"), "/dev/zero"):
        with pytest.raises(sl.IoError, match="ordinary file"):
            sl.read_matrix(path)
    with pytest.raises(sl.UnsupportedError, match="complex"):
        sl.read_matrix(written(tmp_path / "a.mtx", BANNER.replace(b"real", b"complex")))
