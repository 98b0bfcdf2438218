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
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CONSUMER = ROOT / "tests" / "consumer"
BUILD = Path(sys.argv.pop(1))
PYTHON = BUILD / "python" / "venv" / "bin" / "python"
FULL = "EDGEWISE_FULL" in os.environ
# All that lets a compiler round otherwise. -march=native implies -mfma where the processor has it.
FAST = "-O3 -march=native -ffast-math -ffp-contract=fast".split()
LABORATORY_PACKAGES = ("GTest", "benchmark", "CLI11", "fmt", "nlohmann_json", "SDL2", "OpenGL")


def cached(name):
    return re.search(rf"^{name}:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE).group(1)


def run(*command, env=None, cwd=None):
    """What a command printed; its failure fails the test."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, cwd=cwd,
                          env={**os.environ, **(env or {})})
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def configure(source, build, *options):
    return run("cmake", "-S", source, "-B", build, "-G", cached("CMAKE_GENERATOR"),
               f"-DCMAKE_CXX_COMPILER={cached('CMAKE_CXX_COMPILER')}", *options)


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="edgewise-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        first = cls.folder / "first"
        run("cmake", "--install", BUILD, "--prefix", first)
        cls.prefix = cls.folder / "moved"  # an installed copy may be moved as a whole
        first.rename(cls.prefix)

    def check_exports(self, library, whole=False):
        """Checks that a library exports no more of ours than the public headers declare; `whole`: all of C's, and nothing else."""
        headers = "".join(path.read_text() for path in (ROOT / "src" / "edgewise").glob("*.h"))
        headers = re.sub(r"(?s:/\*.*?\*/)|//.*", "", headers)
        exported = re.findall(r"^\S* ?\w (.*)$", run("nm", "-DC", "--defined-only", library), re.MULTILINE)
        ours = [name for name in exported if "edgewise" in re.sub(r"[(<].*", "", name)]
        for name in ours:
            for word in re.findall(r"\w+", re.search(r"edgewise[\w:~]*", name).group()):
                self.assertRegex(headers, rf"\b{word}\b", name)
        if whole:
            self.assertEqual(ours, exported)
            functions = set(re.findall(r"\bedgewise_\w+(?=\()", (ROOT / "src/edgewise/edgewise.h").read_text()))
            self.assertEqual({name for name in exported if name.startswith("edgewise_")}, functions)

    def use(self, folder, environment=None):
        """Runs the consumer's programs, which were built in `folder`."""
        square = run(folder / "square", env=environment)
        self.assertEqual(run(folder / "square_c", env=environment), square)
        if PYTHON.exists():
            self.assertEqual(run(PYTHON, CONSUMER / "square.py", env=environment), square)
        self.assertRegex(run(folder / "seen", env=environment), r"^111556 px\n\d+ px\ndistance 3\.000\nthe box is hidden\n$")
        quad = folder / "mesh.obj"
        quad.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        run(folder / "picture", cwd=folder, env=environment)
        self.assertTrue((folder / "mesh.png").read_bytes().startswith(b"\x89PNG"))
        quad.unlink()
        missing = subprocess.run([folder / "picture"], cwd=folder, capture_output=True, text=True, check=False,
                                 env={**os.environ, **(environment or {})})
        self.assertNotEqual(missing.returncode, 0)
        self.assertIn("mesh.obj", missing.stderr)

    def built(self, name, *options):
        """The prefix of the library alone, compiled anew and installed."""
        build, prefix = self.folder / name, self.folder / f"{name}-prefix"
        configure(ROOT, build, "-DEDGEWISE_LABORATORY=OFF", *options)
        run("cmake", "--build", build, "--parallel", len(os.sched_getaffinity(0)))
        run("cmake", "--install", build, "--prefix", prefix)
        return prefix

    def use_package(self, prefix, name, *options):
        build = self.folder / name
        configure(CONSUMER, build, f"-DCMAKE_PREFIX_PATH={prefix}", *options)
        run("cmake", "--build", build)
        self.use(build)
        self.check_exports(build / "libplugin.so")
        rules = build / "build.ninja"
        if not rules.exists():
            rules = build / "CMakeFiles" / "picture.dir" / "flags.make"
        flags = re.findall(r"^ *(?:CXX_)?(?:FLAGS|DEFINES) = (.*)", rules.read_text(), re.MULTILINE)
        self.assertIn("-std=", " ".join(flags))
        for leaked in ("-f", "-W", "-D", "-m"):
            self.assertFalse([flag for line in flags for flag in line.split()
                              if flag.startswith(leaked) and flag not in ("-DNDEBUG", "-fPIC", "-Dplugin_EXPORTS")], "a flag leaks")

    def pkg_config(self, prefix):
        """The environment for it and for programs that are built with it."""
        package = next(prefix.rglob("edgewise.pc"))
        return {"PKG_CONFIG_PATH": str(package.parent), "LD_LIBRARY_PATH": str(package.parents[1])}

    def use_pkg_config(self, prefix, name):
        build = self.folder / name
        build.mkdir()
        environment = self.pkg_config(prefix)
        compiler = cached("CMAKE_CXX_COMPILER")
        version = run("pkg-config", "--modversion", "edgewise", env=environment)
        self.assertEqual(version, cached("CMAKE_PROJECT_VERSION") + "\n")
        for package in prefix.rglob("*.pc"):
            self.assertIn("\nLicense: MIT\n", package.read_text())
        for program, package in (("picture", "edgewise-files"), ("square", "edgewise"), ("seen", "edgewise")):
            flags = run("pkg-config", "--cflags", "--libs", package, env=environment).split()
            self.assertFalse([flag for flag in flags if not re.match("-[ILl]", flag)], "a flag leaks")
            run(compiler, "-std=c++20", CONSUMER / f"{program}.cpp", "-o", build / program, *flags)
        run("cc", "-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fvisibility=hidden", CONSUMER / "square.c",
            "-o", build / "square_c", *flags)
        self.use(build, environment)

    def use_both(self, prefix, name, *options):
        with self.subTest("CMake"):
            self.use_package(prefix, f"{name}-package", *options)
        with self.subTest("pkg-config"):
            self.use_pkg_config(prefix, f"{name}-pkg-config")

    def test_cmake_and_pkg_config(self):
        self.use_both(self.prefix, "installed")

    def test_hashes_do_not_depend_on_the_users_flags(self):
        mesh = self.folder / "mesh.obj"
        mesh.write_text("v 0 0 0\nv 1 0 0.3\nv 1 1.1 0\nv 0 1 0.7\nf 1 2 3 4\nf 1 4 2\n")
        scenes, frames = ("cube", "cubes", "sphere", "torus-knot", mesh), 4
        said = run(next(self.prefix.rglob("bin/edgewise")), "hash", *scenes, "--size", "320x160", "--frames", frames, "--fps", 32)
        environment = self.pkg_config(self.prefix)
        flags = run("pkg-config", "--cflags", "--libs", "edgewise-files", env=environment).split()
        for compiler in ("g++", "clang++-14"):
            with self.subTest(compiler):
                if shutil.which(compiler) is None and not FULL:
                    self.skipTest(f"{compiler} is missing")
                program = self.folder / f"hashes-{compiler}"
                run(compiler, "-std=c++20", *FAST, CONSUMER / "hashes.cpp", "-o", program, *flags)
                self.assertEqual(run(program, *scenes, env=environment).split(), [line.split()[0] for line in said.splitlines()])
                print(len(scenes) * frames, f"frames drawn by a program of {compiler}: no hash differs")

    def test_the_library_calls_no_inline_function_of_glm(self):
        # The linker would make it call the user's copy of that function, which may round otherwise.
        for library in self.prefix.rglob("libedgewise*.a"):
            self.assertNotRegex(run("nm", "--defined-only", library), r" [VW] _ZNK?3glm")

    def test_the_licence_and_public_headers_are_installed_and_no_others(self):
        self.assertTrue((self.prefix / "share/doc/edgewise/LICENSE").read_text().startswith("MIT License"))
        headers = {path.name for path in self.prefix.rglob("*.h")}
        self.assertEqual(headers, {path.name for path in (ROOT / "src" / "edgewise").glob("*.h")})
        for path in self.prefix.rglob("*.h"):
            for included in re.findall(r'^#include "(\S*)"', path.read_text(), re.MULTILINE):
                self.assertTrue((path.parent.parent / included).is_file(), f"{path.name} includes {included}")

    def test_each_header_stands_alone_pleases_strict_compilers_and_says_in_one_line_that_it_needs_cxx20(self):
        strict = ("-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Wsign-conversion", "-Wold-style-cast")
        user = self.folder / "user.cpp"
        for path in self.prefix.rglob("*.h"):
            compile_it = [cached("CMAKE_CXX_COMPILER"), "-fsyntax-only", "-I", path.parent.parent, user]
            user.write_text(f"#include <edgewise/{path.name}>\n")
            if FULL:
                run(*compile_it, "-std=c++20", "-Werror", *strict)
            if path.name == "edgewise.h":
                continue  # for C
            user.write_text(f"#include <edgewise/{path.name}>\nedgewise::Undeclared undeclared;\n")
            done = subprocess.run([*compile_it, "-std=c++17"], capture_output=True, text=True, check=False)
            errors = [line for line in done.stderr.splitlines() if "error:" in line]
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual(len(errors), 1, done.stderr)
            self.assertIn("C++20", errors[0])

    def test_another_version_is_refused(self):
        project = self.folder / "version"
        project.mkdir()
        project.joinpath("CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(version LANGUAGES NONE)\n"
            "find_package(edgewise 99.0 QUIET)\nfind_package(edgewise 0.0 QUIET)\n"
            "if(edgewise_FOUND)\n  message(FATAL_ERROR \"taken\")\nendif()\n")
        run("cmake", "-S", project, "-B", project / "build", f"-DCMAKE_PREFIX_PATH={self.prefix}")

    def test_an_older_compiler_is_refused_in_one_sentence(self):
        compiler = self.folder / "older"
        compiler.write_text(f"#!/bin/sh\nexec {cached('CMAKE_CXX_COMPILER')} \"$@\" -w -U__GNUC__ -D__GNUC__=11 "
                            "-U__clang_major__ -D__clang_major__=13\n")
        compiler.chmod(0o755)
        done = subprocess.run(["cmake", "-S", ROOT, "-B", self.folder / "older-build", f"-DCMAKE_CXX_COMPILER={compiler}"],
                              capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("CMake Error"), 1, done.stderr)
        self.assertRegex(" ".join(done.stderr.split()), r"Edgewise needs g\+\+ 12 or clang\+\+ 14, or newer; this is \w+ 1[13]\.")

    def test_programs_run_without_source_and_build(self):
        away = self.folder / "away"
        away.mkdir()
        program = next(self.prefix.rglob("bin/edgewise"))
        run(program, "render", "cube", "--size", "64x64", "-o", "cube.png", cwd=away)
        self.assertTrue((away / "cube.png").is_file())
        self.assertIn('"commit": "unknown"', run(program, "machine", cwd=away))
        self.assertIn("/area:", run(next(self.prefix.rglob("bin/edgewise_bench")), "--benchmark_list_tests", cwd=away))

    def test_destdir(self):
        run("cmake", "--install", BUILD, "--prefix", "/opt/edgewise", env={"DESTDIR": str(self.folder / "stage")})
        staged = self.folder / "stage" / "opt" / "edgewise"
        self.assertEqual({str(path.relative_to(staged)) for path in staged.rglob("*") if path.is_file()},
                         {str(path.relative_to(self.prefix)) for path in self.prefix.rglob("*") if path.is_file()})

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
                run("cmake", "--build", build, "--parallel", len(os.sched_getaffinity(0)))
                self.use(build)
                self.check_exports(build / "libplugin.so")

    @unittest.skipUnless(FULL, "compiles the library anew")
    def test_a_shared_library(self):
        prefix = self.built("shared", "-DBUILD_SHARED_LIBS=ON", "-DCMAKE_CXX_FLAGS=-fvisibility=hidden")
        for name in ("edgewise", "edgewise_files"):
            self.assertIn(f"Library soname: [lib{name}.so.0.3]",
                          run("readelf", "-d", next(prefix.rglob(f"lib{name}.so"))))
            self.check_exports(next(prefix.rglob(f"lib{name}.so")), whole=name == "edgewise")
        self.use_both(prefix, "shared")

    @unittest.skipUnless(FULL, "compiles the library anew")
    def test_a_library_without_onetbb(self):
        prefix = self.built("serial", "-DEDGEWISE_THREADS=OFF", "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON")
        self.assertNotIn("tbb", next(prefix.rglob("edgewise.pc")).read_text())
        self.use_both(prefix, "serial", "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON")


if __name__ == "__main__":
    unittest.main()
