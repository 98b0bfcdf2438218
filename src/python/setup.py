"""pip install ./src/python: CMake builds the extensions from the sources around this folder, in a temporary one. In an archive
(sdist) they lie beside this file: CMakeLists.txt and src/, as in the tree.

Environment: EDGEWISE_BUILD names a folder to build in, which is kept, so that the next build is short. CMAKE_ARGS: more
arguments of CMake. CMAKE_BUILD_PARALLEL_LEVEL is the number of jobs; by default, as many as usable cores."""
import atexit
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
ROOT = HERE if (HERE / "src").is_dir() else HERE.parents[1]


class CMake(build_ext):
    def build_extension(self, ext):
        build = Path(self.build_temp).resolve()
        module = Path(self.get_ext_fullpath(ext.name)).resolve()
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(len(os.sched_getaffinity(0))))
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DEDGEWISE_PYTHON=ON",
                        "-DEDGEWISE_LABORATORY=OFF", "-DEDGEWISE_INSTALL=OFF", f"-DPython_EXECUTABLE={sys.executable}",
                        f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", f"-DEDGEWISE_PYTHON_FOLDER={module.parent}",
                        *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "edgewise_python", "--parallel", jobs], check=True)


class Archive(sdist):
    def make_release_tree(self, base_dir, files):
        shutil.copytree(ROOT / "src", Path(base_dir) / "src", ignore=shutil.ignore_patterns("__pycache__", "*.so", "*.egg-info", base_dir))
        for file in (ROOT / "CMakeLists.txt", HERE / "pyproject.toml", HERE / "setup.py"):
            shutil.copy2(file, base_dir)
        self.distribution.metadata.write_pkg_info(base_dir)


version = re.search(r"project\(edgewise VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
folder = os.path.abspath(os.environ["EDGEWISE_BUILD"]) if os.environ.get("EDGEWISE_BUILD") else None
if folder is None:  # nothing is written into the source tree
    folder = tempfile.mkdtemp(prefix="edgewise-")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
os.makedirs(folder, exist_ok=True)
setup(version=version, license="MIT", packages=["edgewise"], package_data={"edgewise": ["py.typed", "*.pyi"]},
      package_dir={"edgewise": os.path.relpath(ROOT / "src" / "python" / "edgewise", HERE)},
      ext_modules=[Extension("edgewise._native", [])],  # and edgewise._lab, if its packages are there
      cmdclass={"build_ext": CMake, "sdist": Archive},
      options={"build": {"build_base": folder}, "egg_info": {"egg_base": folder}})
