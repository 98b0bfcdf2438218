"""The shell scripts' command lines, steps, builds and verdicts, with programs made up here in place of cmake, ctest and
apt-get."""
import json
import os
import re
import shutil
import sys
import unittest

from support import RESULTS, SCRIPTS, FolderTest

APT_OFFLINE = """#!/bin/bash
echo "W: Failed to fetch http://deb.debian.org/debian/dists/bookworm/InRelease  Temporary failure resolving 'deb.debian.org'" >&2
[[ $1 == update ]] || exit 100
"""
APT_BROKEN = "#!/bin/bash\necho 'E: dpkg was interrupted' >&2\n[[ $1 == update ]] || exit 100\n"
DPKG_QUERY = "#!/bin/bash\n[[ ${*: -1} != ninja-build ]] && echo -n installed\nexit 0\n"
ALL_INSTALLED = "#!/bin/bash\necho -n installed\n"
SUDO = '#!/bin/bash\nexec "$@"\n'
LONG = "x" * 200
# Prints what Ninja and Make print, and makes the programs that the sanitized steps run.
CMAKE = f"""#!/bin/bash
[[ $1 == --build ]] || exit 0
echo '[1/20] Building CXX object {LONG}.o'
echo '[ 50%] Building CXX object {LONG}.o'
echo 'a.cpp:1: warning: {LONG}'
echo 'ninja: no work to do.'
mkdir -p "$2"
printf '#!/bin/bash\\nfor a; do [[ $a != --gtest_output=xml:* ]] || cp "$GTEST_XML" "${{a#*xml:}}"; done\\n' |
  tee "$2/edgewise_library_tests" >"$2/edgewise_thread_tests"
chmod +x "$2"/edgewise_*_tests
exit "${{CMAKE_STATUS:-0}}"
"""
CTEST = """#!/bin/bash
echo "ctest $*" >>"$CALLS"
while (($#)); do
  if [[ $1 == --output-junit && -n $CTEST_XML ]]; then cp "$CTEST_XML" "$2"; fi
  shift
done
exit "${CTEST_STATUS:-0}"
"""
QEMU = """#!/bin/bash
echo "qemu-aarch64 $*" >>"$CALLS"
if [[ $* == *--dump* ]]; then echo "0 0: there"; else echo "${QEMU_STATUS:+cube/3: drawn by naive}"; fi
exit "${QEMU_STATUS:-0}"
"""
SKIPPED_OUTPUT = "[ RUN      ] Proofs.A\n/x/a.cpp:3: Skipped\nz3 is not installed\n\n[  SKIPPED ] Proofs.A (0 ms)\n"
CTEST_CASES = f"""<testsuite name="(empty)" tests="4" failures="0" disabled="0" skipped="2">
<testcase name="A.Ok" status="run"><system-out/></testcase>
<testcase name="Proofs.A" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
<system-out>{SKIPPED_OUTPUT}</system-out></testcase>
<testcase name="viewer_smoke" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/>
<system-out>skipped: tmux not installed
</system-out></testcase>%s
</testsuite>"""
FAILED_CASES = """
<testcase name="B.Wrong" status="fail"><failure message=""/><system-out/></testcase>
<testcase name="gone" status="notrun"><skipped message="Unable to find executable"/><system-out/></testcase>"""
GTEST_CASES = """<testsuites tests="2"><testsuite name="L">
<testcase name="Ok" status="run" result="completed" classname="L"/>
<testcase name="Proofs" status="run" result="skipped" classname="L">
<skipped message="x"><![CDATA[/x/a.cpp:3
z3 is not installed]]></skipped></testcase></testsuite></testsuites>"""


# Stands for all programs: writes the files that its options name, with what the committed results hold.
PROGRAM = f"""#!{sys.executable}
import os, shutil, sys
from pathlib import Path
name, command, *options = Path(sys.argv[0]).name, *sys.argv[1:], ""
results, facts = Path("{RESULTS}"), Path("{RESULTS.parent}/facts")
with open(os.environ["CALLS"], "a") as calls:
    print(name, command, *options[:1], file=calls)
written = {{"verify": results / "verify.json", "accuracy": facts / "accuracy.json"}}
for option, value in zip(options, options[1:]):
    if option in ("--json", "-o") and value.startswith("build") and not Path(value).is_dir():
        shutil.copy(written.get(command, facts / "stability.json"), value)
    if option == "--pictures":
        Path(value).mkdir()
for option in sys.argv:
    if option.startswith("--benchmark_out="):
        shutil.copy(results / "bench.json", option.partition("=")[2])
one = '{{"scene": "cube", "subpixel_bits": 8, "pixels": 9, "unstable": 1}}'
print({{"list": '{{"scenes": [{{"name": "cube"}}]}}', "demo": '[{{"name": "turn"}}]', "portable": one,
       "machine": "mine" if "--name" in options else (results / "machine.json").read_text()}}.get(command, "{{}}"))
"""


class ShellTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.root, self.calls = self.folder / "root", self.folder / "calls"
        shutil.copytree(SCRIPTS, self.root / "scripts")
        self.tool("sudo", SUDO)
        self.tool("cmake", CMAKE)
        self.tool("ctest", CTEST)
        self.tool("dpkg-query", ALL_INSTALLED)
        self.tool("qemu-aarch64", QEMU)
        self.tool("apt-get", '#!/bin/bash\necho "apt-get $*" >>"$CALLS"\nexit 9\n')
        self.environment |= {"CALLS": str(self.calls), "CTEST_XML": "", "GTEST_XML": str(self.file("gtest.xml", GTEST_CASES))}

    def run_script(self, name, *arguments, **environment):
        return self.with_tools(self.root / "scripts" / name, *arguments, **environment)

    def library(self, commands, **environment):
        """lib.sh, then these."""
        return self.with_tools("bash", "-c", f"set -euo pipefail; . {self.root}/scripts/lib.sh; {commands}", **environment)

    def assert_usage_error(self, result, words):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertIn(words, result.stderr)
        self.assertFalse(self.calls.exists(), "something ran")
        self.assertFalse((self.root / "build").exists())

    def test_unknown_options_fail_before_anything_runs(self):
        self.tool("dpkg-query", DPKG_QUERY)
        for script in ("test", "run"):
            self.assert_usage_error(self.run_script(script, "--no-install", "--wrong"), "'--wrong'; --help lists all")
        for script, near in (("fuzz", "--keep"), ("prove", "--list"), ("mutate", "--list"), ("compare", "--least"), ("readme", "--check"),
                             ("summary", "--tables"), ("publish", "--check"), ("plot", "--out"), ("python_peers", "--mesh")):
            wrong = near[:-1] + "_"
            self.assert_usage_error(self.run_script(script, wrong), f"'{wrong}'; did you mean {near}?")
        for script in ("test", "run"):
            self.assert_usage_error(self.run_script(script, "--quick", "--no-install"), "unknown argument '--quick'; --help")
        self.assert_usage_error(self.run_script("test", "-R", "--no-install"), "-R needs a value")
        self.assert_usage_error(self.run_script("test", "--full", "-R", "a"), "no options of ctest")
        self.assert_usage_error(self.run_script("test", "--everywhere", "-R", "a"), "no options of ctest")
        self.assert_usage_error(self.run_script("test", "--bare", "--no-install"), "--no-install must stand before --bare")
        self.assert_usage_error(self.run_script("fuzz", "eight"), "'eight'")
        self.assert_usage_error(self.run_script("run", "--mesh", str(self.folder)), "not a file")
        self.assert_usage_error(self.run_script("compare", "a"), "no such file, and no revision")

    def test_missing_packages_are_named_before_anything_runs(self):
        for missing, run_it in (("ninja-build", lambda: self.run_script("test", "-R", "x", "--no-install")),
                                ("ninja-build", lambda: self.run_script("test", "--no-install", "-R", "x")),
                                ("chromium-driver", lambda: self.run_script("test", "--full", "--no-install")),
                                ("libegl-dev", lambda: self.library("set_up list; set_up list peers"))):
            self.tool("dpkg-query", DPKG_QUERY.replace("ninja-build", missing))
            result = run_it()
            self.assertEqual(result.returncode, 2)
            self.assertIn(f"Missing packages: {missing}\n", result.stderr)
            self.assertFalse(self.calls.exists(), "something ran")
        self.assertEqual(self.library("set_up list").returncode, 0)

    def test_a_page_that_would_be_another_fails_its_check(self):
        self.file("root/src/web/page.html", "<@PROGRAM@>\n")
        program, page = self.file("root/build/page/edgewise_page", "1"), self.root / "build/page/page.html"
        self.assertEqual(self.run_script("page").returncode, 0)
        self.assertRegex(page.read_text(), "^<H4sI[^>]+>\n$")
        committed = self.file("root/results/page.html", page.read_text())
        self.assertEqual(self.run_script("page", "--check").returncode, 0)
        program.write_text("2")
        result = self.run_script("page", "--check")
        self.assertEqual(result.returncode, 1)
        self.assertNotEqual(committed.read_text(), page.read_text())
        self.assertIn("of other versions of these packages:\ninstalled", result.stdout)

    def test_swiftshader_is_unpacked_or_left_out(self):
        package, names = self.folder / "package", {"libvk_swiftshader.so", "vk_swiftshader_icd.json"}
        self.file("package/DEBIAN/control", "Package: chromium-common\nVersion: 7\nArchitecture: all\nMaintainer: me\nDescription: x\n")
        for name in (*names, "chromium"):
            self.file(f"package/usr/lib/chromium/{name}", name)

        def unpacked(body):
            self.tool("apt-get", f"#!/bin/bash\n{body}\n")
            return self.library("unpack_swiftshader; echo on")

        failed = unpacked("echo E: no server >&2; exit 100")
        self.assertEqual((failed.returncode, failed.stdout.splitlines()[-1]), (0, "on"))
        self.assertEqual(failed.stderr, "Left out: swiftshader: chromium-common could not be unpacked: E: no server\n")
        self.assertEqual(list((self.root / "build").iterdir()), [])
        self.assertEqual(unpacked(f"dpkg-deb -b {package} chromium-common_7.deb >/dev/null").stderr, "")
        folder = self.root / "build/swiftshader"
        self.assertEqual((folder / "package").read_text(), "chromium-common 7")
        for copy in (folder / "1", folder / "2"):
            self.assertEqual({file.name for file in copy.iterdir()}, names)
        self.assertEqual(unpacked("exit 1").stdout, "on\n")

    def test_without_a_network_the_first_line_says_so(self):
        self.tool("dpkg-query", DPKG_QUERY)
        for apt, first in ((APT_OFFLINE, "No network: apt-get could not reach a package server."),
                           (APT_BROKEN, "apt-get failed.")):
            self.tool("apt-get", apt)
            result = self.run_script("test")
            lines = result.stderr.splitlines()
            self.assertEqual(result.returncode, 2)
            self.assertTrue(lines[0].startswith(first), result.stderr)
            self.assertRegex(lines[1], r"apt-get install --no-install-recommends ninja-build$")
            self.assertEqual(lines[2], "apt-get said:")

    def test_a_build_prints_warnings_and_its_last_line(self):
        for environment in ({}, {"TERM": "dumb"}):
            result = self.library("build all", **environment)
            self.assertRegex(result.stdout, rf"^a.cpp:1: warning: {LONG}\nBuilt in \d s\n$")
        result = self.library("build all", CMAKE_STATUS="1")
        self.assertEqual(result.returncode, 2)
        self.assertIn("warning", result.stdout)
        self.assertNotIn("Built", result.stdout)
        self.assertIn("the build failed; see above", result.stderr)

    def test_every_platform_is_tested_and_says_what_was_found(self):
        platforms = '''. scripts/platforms.sh; status=0
            on_fine() { noted echo one; noted printf 'two\\nthree\\n'; }
            on_wrong() { noted echo one; noted bash -c 'echo wrong; exit 3'; noted echo never; }
            on_missing() { false; }
            everywhere wrong missing fine; exit $status'''
        result = self.library("cd $root;" + platforms)
        self.assertEqual(result.returncode, 1, result.stderr)
        found = {"wrong": ("failed", ["one", "wrong"]), "missing": ("failed", ["nothing found"]), "fine": ("passed", ["one", "three"])}
        written = json.loads((self.root / "build/platforms/platforms.json").read_text())
        self.assertEqual({name: (one["result"], one["found"]) for name, one in written.items()}, found)
        self.assertRegex(result.stdout, r"wrong: failed, \d s after the start of this step; see build/platforms/wrong.log\n")

    def test_a_run_draws_and_verifies_before_it_builds_the_rest_and_a_full_one_can_be_published(self):
        program = self.file("program", PROGRAM)
        self.tool("cmake", f"""#!/bin/bash
echo "cmake $*" >>"$CALLS"
[[ $1 == --build ]] || exit 0
mkdir -p "$2"
for program in edgewise edgewise_first edgewise_bench; do cp {program} "$2/$program"; chmod +x "$2/$program"; done
""")
        self.file("root/scripts/plot", """import sys
from pathlib import Path
folder = Path(sys.argv[sys.argv.index("--out") + 1])
folder.mkdir()
(folder / "choice.svg").write_text(" ".join(sys.argv))
""")
        self.file("root/scripts/reporting/corner_picture.py", "")  # reads pictures
        self.file("root/results/facts/accuracy.json", "{}")

        def outside_build():
            return {path: path.stat().st_mtime_ns for path in self.root.rglob("*") if path.is_file() and path.relative_to(self.root).parts[0] != "build"}

        def ran(where, *arguments):
            before = outside_build()
            result = self.run_script("run", "--no-install", *arguments)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertEqual(outside_build(), before)
            self.assertIn(f"\nChart:    build/{where}/mine/charts/choice.svg\nPictures: build/{where}/facts/pictures\n", result.stdout)
            drawn = (self.root / f"build/{where}/mine/charts/choice.svg").read_text()
            self.assertEqual("--main" in drawn, "--full" not in arguments)
            return result.stdout

        told = ran("first-results")
        calls = [line for line in self.calls.read_text().splitlines() if "-S" not in line]
        order = [next(i for i, call in enumerate(calls) if re.search(what, call)) for what in
                 ("cmake .* edgewise_first$", "first render", "first verify", "cmake .* edgewise_bench$", "accuracy choice", "bench --quick")]
        self.assertEqual(order, sorted(order))
        self.assertLess(max(map(len, told.split("\n\n", 1)[1].splitlines())), 81)
        ran("results", "--full")
        facts = {path.stem for path in (self.root / "build/results/facts").glob("*.json")}
        self.assertLessEqual({"accuracy", "demos", "needs", "portable", "stability"}, facts)

    def run_tests(self, **environment):
        result = self.run_script("test", CTEST_XML=str(self.file("ctest.xml", CTEST_CASES % "")), **environment)
        return result, result.stdout.splitlines()

    def test_the_verdict_counts_all_runs_and_tells_why_tests_are_skipped(self):
        shards = len(os.sched_getaffinity(0))
        result, lines = self.run_tests()
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        # Of three runs of ctest and, of two programs, one shard per core.
        self.assertEqual(lines[-1], f"{3 + 2 * shards} passed, 0 failed, {6 + 2 * shards} skipped")
        self.assertEqual(lines[-3:-1], [f"Skipped {3 + 2 * shards}, z3 is not installed: L.Proofs, Proofs.A",
                                        "Skipped 3, tmux not installed: viewer_smoke"])
        self.assertRegex(self.calls.read_text(), r"\nqemu-aarch64 .*/edgewise_hashes .*/tests/hashes.json --frames 200\n")

    def test_a_wrong_hash_on_another_processor_fails(self):
        self.file("root/build/edgewise_hashes", '#!/bin/bash\nshift\necho "0 0: here, $*"\n').chmod(0o755)
        result, lines = self.run_tests(QEMU_STATUS="1")
        self.assertEqual(result.returncode, 1)
        self.assertIn("\n< 0 0: here, --dump cube/3\n---\n> 0 0: there\n", result.stdout)
        self.assertEqual(lines[-2], "Failed: the run ended without results; see above (aarch64)")

    def test_selected_tests_run_once_and_failures_are_named(self):
        nothing = "Failed: the run ended without results; see above (tests)"
        for cases, status, last in (("", 0, ["1 passed, 0 failed, 2 skipped"]), ("", 3, ["1 passed, 1 failed, 2 skipped"]),
                                    (FAILED_CASES, 8, ["Failed: B.Wrong (tests)", "Failed: gone (tests)", "1 passed, 2 failed, 2 skipped"]),
                                    (None, 8, [nothing, "0 passed, 1 failed, 0 skipped"])):
            result = self.run_script("test", "-R", "A", "-j4", CTEST_STATUS=str(status),
                                     CTEST_XML="" if cases is None else str(self.file("ctest.xml", CTEST_CASES % cases)))
            lines = result.stdout.splitlines()
            self.assertEqual((result.returncode, lines[-len(last):]), (status, last))
            self.assertIn("Testing -R A", result.stdout)
        self.assertEqual(self.calls.read_text().count(" -R A -j4"), 4)


if __name__ == "__main__":
    unittest.main()
