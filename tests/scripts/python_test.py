#!/usr/bin/env python3
"""Installs the Python module by pip into a virtual environment, as others would, and runs its tests.
usage: python_test.py BUILD

The environment and what CMake built stay in BUILD/python for the next run; install_test.py uses the environment, too.
Exits with 77, which ctest counts as skipped, if a package is missing."""
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "src" / "python"
BUILD = Path(sys.argv[1]).resolve()
FOLDER = BUILD / "python"
PACKAGE_OF = {"numpy": "python3-numpy", "pybind11": "python3-pybind11", "pytest": "python3-pytest",
              "setuptools": "python3-setuptools", "wheel": "python3-wheel", "ensurepip": "python3-venv"}
FIND_MISSING = f"""
import importlib.util, os, sysconfig
missing = [package for module, package in {PACKAGE_OF}.items() if importlib.util.find_spec(module) is None]
if not os.path.exists(os.path.join(sysconfig.get_path("include"), "Python.h")): missing.append("python3-dev")
print(*missing)"""
SKIPPED = 77


def interpreter():
    """The first one that has all packages: the python3 on the PATH may be one that Debian's packages don't reach."""
    for python in ("python3", "/usr/bin/python3"):
        missing = subprocess.run([python, "-c", FIND_MISSING], capture_output=True, text=True, check=True).stdout.split()
        if not missing:
            return python
    print("missing packages:", *missing)
    sys.exit(SKIPPED)


def files():
    return {path for path in SOURCE.rglob("*") if path.is_file()}


python = interpreter()
environment = {**os.environ, "EDGEWISE_BUILD": str(FOLDER / "build"), "EDGEWISE_PROGRAM": str(BUILD / "edgewise"),
               "PYTHONDONTWRITEBYTECODE": "1"}
venv = FOLDER / "venv"
before = files()
subprocess.run([python, "-m", "venv", "--system-site-packages", venv], check=True)
subprocess.run([venv / "bin" / "pip", "install", "--quiet", "--no-build-isolation", "--no-index", SOURCE], check=True,
               env=environment)
if written := files() - before:
    sys.exit(f"pip wrote into the source tree: {', '.join(map(str, written))}")
sys.exit(subprocess.run([venv / "bin" / "python", "-m", "pytest", "-q", "-p", "no:cacheprovider", ROOT / "tests" / "python"],
                        cwd=FOLDER, env=environment, check=False).returncode)
