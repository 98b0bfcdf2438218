"""pip install ./src/python: CMake builds the extension from the sources around it, in a temporary folder.

Environment: EDGEWISE_BUILD names a folder to build in, which is kept, so that the next build is short.
CMAKE_BUILD_PARALLEL_LEVEL is the number of jobs; by default, as many as usable cores."""
import atexit
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


def build_folder():
    if "EDGEWISE_BUILD" in os.environ:
        folder = Path(os.environ["EDGEWISE_BUILD"]).resolve()
        folder.mkdir(parents=True, exist_ok=True)
    else:
        folder = Path(tempfile.mkdtemp(prefix="edgewise-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return str(folder)


class CMake(build_ext):
    def build_extension(self, ext):
        build = Path(self.build_temp).resolve()
        module = Path(self.get_ext_fullpath(ext.name)).resolve()
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(len(os.sched_getaffinity(0))))
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DEDGEWISE_PYTHON=ON",
                        "-DEDGEWISE_LABORATORY=OFF", "-DEDGEWISE_INSTALL=OFF", f"-DPython_EXECUTABLE={sys.executable}",
                        f"-Dpybind11_DIR={pybind11.get_cmake_dir()}", f"-DEDGEWISE_PYTHON_FOLDER={module.parent}"], check=True)
        subprocess.run(["cmake", "--build", str(build), "--target", "edgewise_python", "--parallel", jobs], check=True)


licence = (ROOT / "README.md").read_text(encoding="utf-8").split("\n## Licence\n\n")[-1]
version = re.search(r"project\(edgewise VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
folder = build_folder()  # nothing is written into the source tree
setup(version=version, license=licence, packages=["edgewise"], package_data={"edgewise": ["py.typed"]},
      ext_modules=[Extension("edgewise._native", [])], cmdclass={"build_ext": CMake},
      options={"build": {"build_base": folder}, "egg_info": {"egg_base": folder}})
