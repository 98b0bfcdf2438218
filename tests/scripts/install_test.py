#!/usr/bin/env python3
"""Installs the build and uses the copy as others would: tests/consumer, by CMake and by pkg-config. Programs in C, C++, and
Python, where python_test.py has installed the module, draw the same picture.
usage: install_test.py BUILD

Where the source is built along with the consumer (add_subdirectory, FetchContent), and for a shared library, the whole
library is compiled anew; that is done under EDGEWISE_FULL, otherwise such builds are only configured.
With EDGEWISE_FULL, a missing compiler is an error, too.
"""
import os
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import support
from support import ROOT

CONSUMER, HEADERS = ROOT / "tests/consumer", ROOT / "src/edgewise"
BUILD = Path(sys.argv.pop(1))
PYTHON = BUILD / "python/venv/bin/python"
FULL = "EDGEWISE_FULL" in os.environ
# All that lets a compiler round otherwise. -march=native implies -mfma where the processor has it.
FAST = "-O3 -march=native -ffast-math -ffp-contract=fast".split()
STRICT = "-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Werror".split()
LABORATORY_PACKAGES = ("GTest", "benchmark", "CLI11", "fmt", "nlohmann_json", "SDL2", "OpenGL")
MESH = "v 0 0 0\nv 1 0 0.3\nv 1 1.1 0\nv 0 1 0.7\nf 1 2 3 4\nf 1 4 2\n"


def cached(name):
    return re.search(rf"^{name}:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE).group(1)


def run(*command, directory=None, **environment):
    """What a command printed; its failure fails the test."""
    done = support.run(*command, directory=directory, **environment)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def configure(source, build, *options):
    run("cmake", "-S", source, "-B", build, "-G", cached("CMAKE_GENERATOR"), f"-DCMAKE_CXX_COMPILER={cached('CMAKE_CXX_COMPILER')}", *options)


def compiled(build):
    run("cmake", "--build", build, "--parallel", len(os.sched_getaffinity(0)))


def pkg_config(prefix):
    """The environment for it and for programs that are built with it."""
    package = next(prefix.rglob("edgewise.pc"))
    return {"PKG_CONFIG_PATH": str(package.parent), "LD_LIBRARY_PATH": str(package.parents[1])}


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="edgewise-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run("cmake", "--install", BUILD, "--prefix", cls.folder / "first")
        cls.prefix = (cls.folder / "first").rename(cls.folder / "moved")  # an installed copy may be moved as a whole

    def refusal(self, *command, **options):
        """What a command says that must fail."""
        done = support.run(*command, **options)
        self.assertNotEqual(done.returncode, 0, command)
        return done.stderr

    def check_exports(self, library, whole=False):
        """Checks that a library exports no more of ours than the public headers declare; `whole`: all of C's, and nothing else."""
        headers = re.sub(r"(?s:/\*.*?\*/)|//.*", "", "".join(path.read_text() for path in HEADERS.glob("*.h")))
        exported = re.findall(r"^\S* ?\w (.*)$", run("nm", "-DC", "--defined-only", library), re.MULTILINE)
        ours = [name for name in exported if "edgewise" in re.sub(r"[(<].*", "", name)]
        for name in ours:
            for word in re.findall(r"\w+", re.search(r"edgewise[\w:~]*", name).group()):
                self.assertRegex(headers, rf"\b{word}\b", name)
        if whole:
            self.assertEqual(ours, exported)
            functions = set(re.findall(r"\bedgewise_\w+(?=\()", (HEADERS / "edgewise.h").read_text()))
            self.assertEqual({name for name in exported if name.startswith("edgewise_")}, functions)

    def use(self, folder, **environment):
        """Runs the consumer's programs, which were built in `folder`."""
        square = run(folder / "square", **environment)
        self.assertEqual(run(folder / "square_c", **environment), square)
        if PYTHON.exists():
            self.assertEqual(run(PYTHON, CONSUMER / "square.py", **environment), square)
        self.assertRegex(run(folder / "seen", **environment), r"^111556 px\n\d+ px\ndistance 3\.000\nthe box is hidden\n$")
        self.assertIn("mesh.obj", self.refusal(folder / "picture", directory=folder, **environment))
        (folder / "mesh.obj").write_text(MESH)
        run(folder / "picture", directory=folder, **environment)
        self.assertTrue((folder / "mesh.png").read_bytes().startswith(b"\x89PNG"))

    def built(self, name, *options):
        """The prefix of the library alone, compiled anew and installed."""
        build, prefix = self.folder / name, self.folder / f"{name}-prefix"
        configure(ROOT, build, "-DEDGEWISE_LABORATORY=OFF", *options)
        compiled(build)
        run("cmake", "--install", build, "--prefix", prefix)
        return prefix

    def use_both(self, prefix, name, *options):
        """Builds the consumer with an installed copy, by CMake and by pkg-config."""
        build = self.folder / f"{name}-package"
        configure(CONSUMER, build, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *options)
        compiled(build)
        self.use(build)
        self.check_exports(build / "libplugin.so")
        commands = (build / "compile_commands.json").read_text()
        self.assertIn(" -std=", commands)
        self.assertLessEqual(set(re.findall(r" (-[fWDm]\S*)", commands)), {"-DNDEBUG", "-fPIC", "-Dplugin_EXPORTS"}, "a flag leaks")

        build, environment = self.folder / f"{name}-pkg-config", pkg_config(prefix)
        build.mkdir()
        self.assertEqual(run("pkg-config", "--modversion", "edgewise", **environment), cached("CMAKE_PROJECT_VERSION") + "\n")
        for program, package in (("picture", "edgewise-files"), ("square", "edgewise"), ("seen", "edgewise")):
            flags = run("pkg-config", "--cflags", "--libs", package, **environment).split()
            self.assertFalse([flag for flag in flags if not re.match("-[ILl]", flag)], "a flag leaks")
            run(cached("CMAKE_CXX_COMPILER"), "-std=c++20", CONSUMER / f"{program}.cpp", "-o", build / program, *flags)
        run("cc", "-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fvisibility=hidden", CONSUMER / "square.c",
            "-o", build / "square_c", *flags)
        self.use(build, **environment)

    def test_cmake_and_pkg_config(self):
        self.use_both(self.prefix, "installed")

    def test_hashes_do_not_depend_on_the_users_flags(self):
        mesh = self.folder / "mesh.obj"
        mesh.write_text(MESH)
        scenes, frames = ("cube", "cubes", "sphere", "torus-knot", mesh), 4
        said = run(next(self.prefix.rglob("bin/edgewise")), "hash", *scenes, "--size", "320x160", "--frames", frames, "--fps", 32)
        environment = pkg_config(self.prefix)
        flags = run("pkg-config", "--cflags", "--libs", "edgewise-files", **environment).split()
        for compiler in ("g++", "clang++-14"):
            with self.subTest(compiler):
                if shutil.which(compiler) is None and not FULL:
                    self.skipTest(f"{compiler} is missing")
                program = self.folder / f"hashes-{compiler}"
                run(compiler, "-std=c++20", *FAST, CONSUMER / "hashes.cpp", "-o", program, *flags)
                self.assertEqual(run(program, *scenes, **environment).split(), [line.split()[0] for line in said.splitlines()])
                print(len(scenes) * frames, f"frames drawn by a program of {compiler}: no hash differs")

    def test_the_library_calls_no_inline_function_of_glm(self):
        # The linker would make it call the user's copy of that function, which may round otherwise.
        for library in self.prefix.rglob("libedgewise*.a"):
            self.assertNotRegex(run("nm", "--defined-only", library), r" [VW] _ZNK?3glm")

    def test_the_licence_and_public_headers_are_installed_and_no_others(self):
        self.assertTrue((self.prefix / "share/doc/edgewise/LICENSE").read_text().startswith("MIT License"))
        self.assertEqual({path.name for path in self.prefix.rglob("*.h")}, {path.name for path in HEADERS.glob("*.h")})

    def test_each_header_stands_alone_pleases_strict_compilers_and_says_in_one_line_that_it_needs_cxx20(self):
        user = self.folder / "user.cpp"
        for path in self.prefix.rglob("*.h"):
            for included in re.findall(r'^#include "(\S*)"', path.read_text(), re.MULTILINE):
                self.assertTrue((path.parent.parent / included).is_file(), f"{path.name} includes {included}")
            compile_it = [cached("CMAKE_CXX_COMPILER"), "-fsyntax-only", "-I", path.parent.parent, user]
            user.write_text(f"#include <edgewise/{path.name}>\n")
            if FULL:
                run(*compile_it, "-std=c++20", *STRICT)
            if path.name == "edgewise.h":
                continue  # for C
            user.write_text(f"#include <edgewise/{path.name}>\nedgewise::Undeclared undeclared;\n")
            errors = re.findall(r".*error:.*", self.refusal(*compile_it, "-std=c++17"))
            self.assertEqual(len(errors), 1, errors)
            self.assertIn("C++20", errors[0])

    def test_an_older_compiler_is_refused_in_one_sentence(self):
        compiler = self.folder / "older"
        compiler.write_text(f"#!/bin/sh\nexec {cached('CMAKE_CXX_COMPILER')} \"$@\" -w -U__GNUC__ -D__GNUC__=11 "
                            "-U__clang_major__ -D__clang_major__=13\n")
        compiler.chmod(0o755)
        said = self.refusal("cmake", "-S", ROOT, "-B", self.folder / "older-build", f"-DCMAKE_CXX_COMPILER={compiler}")
        self.assertEqual(said.count("CMake Error"), 1, said)
        self.assertRegex(" ".join(said.split()), r"Edgewise needs g\+\+ 12 or clang\+\+ 14, or newer; this is \w+ 1[13]\.")

    def test_programs_run_without_source_and_build(self):
        away = self.folder / "away"
        away.mkdir()
        program = next(self.prefix.rglob("bin/edgewise"))
        run(program, "render", "cube", "--size", "64x64", "-o", "cube.png", directory=away)
        self.assertTrue((away / "cube.png").is_file())
        self.assertIn('"commit": "unknown"', run(program, "machine", directory=away))
        self.assertIn("/area:", run(next(self.prefix.rglob("bin/edgewise_bench")), "--benchmark_list_tests", directory=away))

    def test_the_source_as_a_part_of_the_consumers_build_brings_nothing_but_the_library(self):
        for way, shared in (("subdirectory", "OFF"), ("fetch", "ON")):
            build = self.folder / way
            configure(CONSUMER, build, f"-DEDGEWISE_FROM={way}", f"-DEDGEWISE_SOURCE={ROOT}", f"-DBUILD_SHARED_LIBS={shared}",
                      *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{package}=ON" for package in LABORATORY_PACKAGES))
            listed = run("cmake", "--build", build, "--target", "help")
            ours = set(re.findall(r"^(?:\.\.\. )?((?:edgewise_|fuzz_)[\w-]+)", listed, re.MULTILINE))
            self.assertLessEqual(ours, {"edgewise_files", "edgewise_files_inside", "edgewise_image", "edgewise_inside"})
            self.assertRegex((build / "CMakeCache.txt").read_text(), r"(?m)^CMAKE_BUILD_TYPE:\w+=$")  # the consumer's choice
            if FULL:
                compiled(build)
                self.use(build)
                self.check_exports(build / "libplugin.so")

    @unittest.skipUnless(FULL, "compiles the library anew")
    def test_a_shared_library(self):
        prefix = self.built("shared", "-DBUILD_SHARED_LIBS=ON", "-DCMAKE_CXX_FLAGS=-fvisibility=hidden")
        for name in ("edgewise", "edgewise_files"):
            library = next(prefix.rglob(f"lib{name}.so"))
            self.assertIn(f"Library soname: [lib{name}.so.0.3]", run("readelf", "-d", library))
            self.check_exports(library, whole=name == "edgewise")
        self.use_both(prefix, "shared")

    @unittest.skipUnless(FULL, "compiles the library anew")
    def test_a_library_without_onetbb(self):
        prefix = self.built("serial", "-DEDGEWISE_THREADS=OFF", "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON")
        self.assertNotIn("tbb", next(prefix.rglob("edgewise.pc")).read_text())
        self.use_both(prefix, "serial", "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON")


if __name__ == "__main__":
    unittest.main()
