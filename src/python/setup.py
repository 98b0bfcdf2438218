"""pip install ./src/python: CMake builds the extension from the sources around it."""
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


class CMake(build_ext):
    def build_extension(self, ext):
        target = Path(self.get_ext_fullpath(ext.name)).resolve()
        build = Path(self.build_temp).resolve()
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DEDGEWISE_PYTHON=ON",
                        "-DEDGEWISE_LABORATORY=OFF", "-DEDGEWISE_INSTALL=OFF", f"-DPython_EXECUTABLE={sys.executable}",
                        f"-DEDGEWISE_PYTHON_FOLDER={target.parent}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "edgewise_python", "--parallel", str(os.cpu_count())], check=True)


version = re.search(r"project\(edgewise VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
setup(version=version, packages=["edgewise"], package_data={"edgewise": ["py.typed"]},
      ext_modules=[Extension("edgewise._native", [])], cmdclass={"build_ext": CMake})
