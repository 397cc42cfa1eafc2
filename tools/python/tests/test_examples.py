"""Every program of examples/jobs runs, and so does the tour, where matplotlib is installed."""
import glob
import os
import subprocess
import sys

import pytest

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples")
JOBS = sorted(os.path.basename(path) for path in glob.glob(os.path.join(FOLDER, "jobs", "*.py")))


def run(path, *arguments):
    return subprocess.run([sys.executable, "-W", "error", "-B", path, *arguments],
                          capture_output=True, text=True)


def test_there_are_ten_jobs():
    assert len(JOBS) == 11 and "mesh.py" in JOBS


@pytest.mark.parametrize("name", [name for name in JOBS if name != "mesh.py"])
def test_jobs(name):
    out = run(os.path.join(FOLDER, "jobs", name))
    assert out.returncode == 0 and out.stdout and not out.stderr, out.stderr


def test_the_tour(tmp_path):
    pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    out = subprocess.run([sys.executable, "-B", os.path.join(FOLDER, "heat.py"),
                          str(tmp_path / "heat.png")], capture_output=True, text=True)
    assert out.returncode == 0 and (tmp_path / "heat.png").stat().st_size > 10000, out.stderr
