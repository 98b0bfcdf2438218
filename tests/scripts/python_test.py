#!/usr/bin/env python3
"""Installs the Python package by pip, as others would, from an archive of its sources (sdist), and runs its tests: first
without the laboratory, then with it into a virtual environment.
usage: python_test.py BUILD

The environment, the sources and what CMake built stay in BUILD/python for the next run; install_test.py uses the
environment, too. Exits with 77, which ctest counts as skipped, if a package is missing."""
import os
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "python"
BUILD = Path(sys.argv[1]).resolve()
FOLDER = BUILD / "python"
NEEDED = """
import os, sysconfig
import distributed, ensurepip, mypy, numpy, pybind11, pytest, setuptools, wheel
open(os.path.join(sysconfig.get_path("include"), "Python.h"))"""


def interpreter():
    """The first one that has all that is needed: the python3 on the PATH may be one that Debian's packages don't reach."""
    for python in ("python3", "/usr/bin/python3"):
        tried = subprocess.run([python, "-c", NEEDED], capture_output=True, text=True, check=False)
        if tried.returncode == 0:
            return python
    print(tried.stderr)
    sys.exit(77)


WITHOUT_LAB = """
import edgewise, numpy, pytest
stream = edgewise.Stream(numpy.array([[[0, 0, 0], [9, 0, 0], [0, 9, 0]]]), (8, 8))
assert (stream.draw(ids=True).payload == 0).any()
for use in (lambda: __import__("edgewise.lab"), lambda: edgewise.Scene().needs([], (8, 8)), stream.portable):
    with pytest.raises(ImportError, match="libgmp-dev, libfmt-dev"):
        use()
"""

python = interpreter()
environment = {**os.environ, "EDGEWISE_BUILD": str(FOLDER / "wheel"), "EDGEWISE_PROGRAM": str(BUILD / "edgewise"),
               "PYTHONDONTWRITEBYTECODE": "1"}
venv = FOLDER / "venv"
before = set(SOURCE.rglob("*"))
subprocess.run([python, "-m", "venv", "--system-site-packages", venv], check=True)


def run(*command, cwd=None, stdout=None, **variables):
    subprocess.run([venv / "bin" / "python", *command], check=True, cwd=cwd, stdout=stdout, env={**environment, **variables})


pip_install = "-m pip install --quiet --no-build-isolation --no-index".split()
archives, without_lab = FOLDER / "archives", FOLDER / "without_lab"
for folder in (archives, without_lab):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
run("-c", f"from setuptools import build_meta; build_meta.build_sdist({str(archives)!r})", cwd=SOURCE, stdout=subprocess.DEVNULL)
if written := set(SOURCE.rglob("*")) - before:
    sys.exit(f"the archive's making wrote into the source tree: {', '.join(map(str, written))}")
(archive,) = archives.iterdir()
with tarfile.open(archive) as packed:
    packed.extractall(archives)
# CMake's cache in EDGEWISE_BUILD holds the path, which therefore names no version.
unpacked = (archives / archive.name.removesuffix(".tar.gz")).rename(archives / "unpacked")
if "MIT" not in (unpacked / "PKG-INFO").read_text():
    sys.exit("the archive does not name its licence")
run(*pip_install, "--no-deps", "--target", without_lab, unpacked, CMAKE_ARGS="-DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON")
run("-c", WITHOUT_LAB, cwd=without_lab)
run(*pip_install, unpacked, CMAKE_ARGS="-DCMAKE_DISABLE_FIND_PACKAGE_fmt=OFF")
run("-m", "pytest", "-q", "-p", "no:cacheprovider", ROOT / "tests" / "python", cwd=FOLDER)
