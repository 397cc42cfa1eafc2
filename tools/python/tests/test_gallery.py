"""Every program of gallery checks its own result, says it in words and draws its picture."""
import glob
import os
import struct
import subprocess
import sys
import zlib

import pytest

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "gallery")
PROGRAMS = sorted(os.path.basename(path)[:-3] for path in glob.glob(os.path.join(FOLDER, "*.py"))
                  if os.path.basename(path) != "scene.py")


def colors(png):
    """The number of different bytes in the picture's filtered rows; its shape is checked."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", png[16:24])
    length = struct.unpack(">I", png[33:37])[0]
    rows = zlib.decompress(png[41:41 + length])
    assert len(rows) == height * (3 * width + 1)
    return len(set(rows))


def test_programs_are_short():
    assert PROGRAMS
    for name in PROGRAMS:
        with open(os.path.join(FOLDER, name + ".py")) as file:
            assert len(file.readlines()) <= 60, name


@pytest.mark.parametrize("name", PROGRAMS)
def test_gallery(name, tmp_path):
    out = subprocess.run([sys.executable, "-W", "error", "-B", os.path.join(FOLDER, name + ".py"),
                          str(tmp_path)], capture_output=True, text=True)
    assert out.returncode == 0 and out.stdout and not out.stderr, out.stderr
    assert colors((tmp_path / (name + ".png")).read_bytes()) > 50
