"""The scripts' command lines, and the shell scripts' steps, builds and verdicts, with programs made up here in place of cmake,
ctest and apt-get."""
import os
import re
import shutil
import sys
import unittest

from support import RESULTS, CopyTest

LONG = "x" * 200
TOOLS = {
    "sudo": 'exec "$@"',
    "dpkg-query": '[[ ${*: -1} == "$MISSING" ]] || echo -n installed',
    "apt-get": """echo "apt-get $*" >>"$CALLS"
echo "$APT_SAYS" >&2
[[ $1 == update ]]""",
    # Prints what Ninja and Make print, and makes the programs that scripts start.
    "cmake": f"""echo "cmake $*" >>"$CALLS"
[[ $1 == --build ]] || exit 0
echo '[1/20] Building CXX object {LONG}.o'
echo '[ 50%] Building CXX object {LONG}.o'
echo 'a.cpp:1: warning: {LONG}'
echo 'ninja: no work to do.'
mkdir -p "$2"
for name in edgewise edgewise_{{first,bench,library_tests,thread_tests}}; do cp "$PROGRAM" "$2/$name"; done
exit ${{CMAKE_STATUS:-0}}""",
    "ctest": """echo "ctest $*" >>"$CALLS"
while (($#)); do
  [[ $1 != --output-junit ]] || cp "$CTEST_XML" "$2"
  shift
done
exit ${CTEST_STATUS:-0}""",
    "qemu-aarch64": """echo "qemu-aarch64 $*" >>"$CALLS"
if [[ $* == *--dump* ]]; then echo "0 0: there"; else echo "${QEMU_STATUS:+cube/3: drawn by naive}"; fi
exit ${QEMU_STATUS:-0}""",
}
CTEST_CASES = """<testsuite name="(empty)" tests="4" failures="0" disabled="0" skipped="2">
<testcase name="A.Ok" status="run"><system-out/></testcase>
<testcase name="Proofs.A" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
<system-out>[ RUN      ] Proofs.A
/x/a.cpp:3: Skipped
z3 is not installed
</system-out></testcase>
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
for option, _, value in (argument.partition("=") for argument in sys.argv):
    if option == "--benchmark_out":
        shutil.copy(results / "bench.json", value)
    if option == "--gtest_output":
        Path(value.removeprefix("xml:")).write_text({GTEST_CASES!r})
one = '{{"scene": "cube", "subpixel_bits": 8, "pixels": 9, "unstable": 1}}'
print({{"list": '{{"scenes": [{{"name": "cube"}}]}}', "demo": '[{{"name": "turn"}}]', "portable": one,
       "machine": "mine" if "--name" in options else (results / "machine.json").read_text()}}.get(command, "{{}}"))
"""


class ShellTest(CopyTest):
    def setUp(self):
        super().setUp()
        self.calls = self.folder / "calls"
        for name, body in TOOLS.items():
            self.tool(name, f"#!/bin/bash\n{body}\n")
        self.tool("program", PROGRAM)
        self.environment |= {"CALLS": str(self.calls), "CTEST_XML": f"{self.folder}/ctest.xml", "PROGRAM": f"{self.folder}/tools/program"}

    def library(self, commands, **environment):
        """lib.sh, then these."""
        return self.with_tools("bash", "-c", f"set -euo pipefail; . {self.folder}/scripts/lib.sh; {commands}", **environment)

    def test_a_wrong_command_line_is_told_in_one_line_before_anything_runs(self):
        python_scripts = ("fuzz", "prove", "mutate", "compare", "readme", "summary", "publish", "plot", "python_peers")
        for words, script, *arguments in (("unknown argument '--wrong'; --help lists all", "test", "--no-install", "--wrong"),
                                          ("unknown argument '--quick'; --help lists all", "run", "--quick"),
                                          *(("; --help lists all", script, "--wrong") for script in python_scripts),
                                          ("-R needs a value", "test", "-R", "--no-install"),
                                          ("no options of ctest", "test", "--full", "-R", "a"),
                                          ("--no-install must stand before --bare", "test", "--bare", "--no-install"),
                                          ("'eight'", "fuzz", "eight"), ("not a file", "run", "--mesh", self.folder),
                                          ("no such file, and no revision", "compare", "a")):
            result = self.script(script, *arguments)
            self.fails(result, words)
            self.assertEqual((result.stdout, self.calls.exists(), (self.folder / "build").exists()), ("", False, False), "something ran")

    def test_missing_packages_are_named_before_anything_runs(self):
        for missing, *command in (("ninja-build", "test", "-R", "x", "--no-install"), ("chromium-driver", "test", "--full", "--no-install"),
                                  ("libegl-dev", "run", "--peers", "--no-install")):
            result = self.script(*command, MISSING=missing)
            self.assertEqual((result.returncode, self.calls.exists()), (2, False), "something ran")
            self.assertIn(f"Missing packages: {missing}\n", result.stderr)

    def test_a_page_that_would_be_another_fails_its_check(self):
        self.file("src/web/page.html", "<@PROGRAM@>\n")
        self.file("build/page/edgewise_page", "program")
        committed = self.file("results/page.html", "<another>\n")
        result = self.script("page", "--check")
        self.assertEqual((result.returncode, committed.read_text()), (1, "<another>\n"))
        self.assertIn("of other versions of these packages:\ninstalled", result.stdout)
        shutil.copy(self.folder / "build/page/page.html", committed)
        self.assertEqual(self.script("page", "--check").returncode, 0)
        self.assertRegex(committed.read_text(), "^<H4sI[^>]+>\n$")

    def test_swiftshader_is_unpacked_or_left_out(self):
        package, folder = self.folder / "package", self.folder / "build/swiftshader"
        self.file("package/DEBIAN/control", "Package: chromium-common\nVersion: 7\nArchitecture: all\nMaintainer: me\nDescription: x\n")
        for name in ("libvk_swiftshader.so", "vk_swiftshader_icd.json", "chromium"):
            self.file(f"package/usr/lib/chromium/{name}", name)
        for apt_get, told in (("echo E: no server >&2; exit 100", "Left out: swiftshader: chromium-common could not be unpacked: E: no server\n"),
                              (f"dpkg-deb -b {package} chromium-common_7.deb >/dev/null", ""), ("exit 1", "")):
            self.tool("apt-get", f"#!/bin/bash\n{apt_get}\n")
            result = self.library("unpack_swiftshader")
            self.assertEqual((result.returncode, result.stderr), (0, told))
            self.assertEqual(list((self.folder / "build").iterdir()), [] if told else [folder])
        self.assertEqual((folder / "package").read_text(), "chromium-common 7")
        for copy in ("1", "2"):
            self.assertEqual({file.name for file in (folder / copy).iterdir()}, {"libvk_swiftshader.so", "vk_swiftshader_icd.json"})

    def test_without_a_network_the_first_line_says_so(self):
        for said, first in (("W: Failed to fetch http://deb.debian.org/InRelease  Temporary failure resolving 'deb.debian.org'", "No network: "),
                            ("E: dpkg was interrupted", "apt-get failed.")):
            result = self.script("test", MISSING="ninja-build", APT_SAYS=said)
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, f"^{first}.*\n.*apt-get install --no-install-recommends ninja-build\napt-get said:\n{said}\n$")

    def test_a_build_prints_warnings_and_its_last_line(self):
        self.assertRegex(self.library("build all").stdout, rf"^a.cpp:1: warning: {LONG}\nBuilt in \d s\n$")
        result = self.library("build all", CMAKE_STATUS="1")
        self.assertEqual((result.returncode, result.stdout), (2, f"a.cpp:1: warning: {LONG}\n"))
        self.assertIn("the build failed; see above", result.stderr)

    def test_every_platform_is_tested_and_says_what_was_found(self):
        platforms = '''. scripts/platforms.sh; status=0
            on_fine() { noted echo one; noted printf 'two\\nthree\\n'; }
            on_wrong() { noted echo one; noted bash -c 'echo wrong; exit 3'; noted echo never; }
            on_missing() { false; }
            everywhere wrong missing fine; exit $status'''
        result = self.library("cd $root;" + platforms)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual((self.folder / "build/platforms/platforms.tsv").read_text(), "".join(f"{line}\n" for line in (
            "fine\tpassed\tone", "fine\tpassed\tthree", "missing\tfailed\tnothing found", "wrong\tfailed\tone", "wrong\tfailed\twrong")))
        self.assertRegex(result.stdout, r"wrong: failed, \d s after the start of this step; see build/platforms/wrong.log\n")

    def test_a_run_draws_and_verifies_before_it_builds_the_rest_and_a_full_one_can_be_published(self):
        self.file("scripts/plot", """import sys
from pathlib import Path
folder = Path(sys.argv[sys.argv.index("--out") + 1])
folder.mkdir()
(folder / "choice.svg").write_text(" ".join(sys.argv))
""")
        self.file("scripts/reporting/corner_picture.py", "")  # reads pictures

        def outside_build():
            return {path: path.stat().st_mtime_ns for path in self.folder.rglob("*")
                    if path.is_file() and path != self.calls and self.folder / "build" not in path.parents}

        before = outside_build()
        for where, *arguments in (("first-results",), ("results", "--full")):
            result = self.script("run", "--no-install", *arguments)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertEqual(outside_build(), before)
            self.assertIn(f"\nChart:    build/{where}/mine/charts/choice.svg\nPictures: build/{where}/facts/pictures\n", result.stdout)
            drawn = (self.folder / f"build/{where}/mine/charts/choice.svg").read_text()
            self.assertEqual("--main" in drawn, "--full" not in arguments)
            self.assertLess(max(map(len, result.stdout.split("\n\n", 1)[1].splitlines())), 81)
        calls = [line for line in self.calls.read_text().splitlines() if "-S" not in line]
        order = [next(i for i, call in enumerate(calls) if re.search(what, call)) for what in
                 ("cmake .* edgewise_first$", "first render", "first verify", "cmake .* edgewise_bench$", "accuracy choice", "bench --quick")]
        self.assertEqual(order, sorted(order))
        facts = {path.stem for path in (self.folder / "build/results/facts").glob("*.json")}
        self.assertLessEqual({"accuracy", "demos", "needs", "portable", "stability"}, facts)

    def run_tests(self, *arguments, xml=CTEST_CASES % "", **environment):
        self.file("ctest.xml", xml)
        result = self.script("test", *arguments, **environment)
        return result, result.stdout.splitlines()

    def test_the_verdict_counts_all_runs_and_tells_why_tests_are_skipped(self):
        result, lines = self.run_tests()
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        runs = 3 + 2 * len(os.sched_getaffinity(0))  # three of ctest and, of two programs, one shard per core
        self.assertEqual(lines[-3:], [f"Skipped {runs}, z3 is not installed: L.Proofs, Proofs.A", "Skipped 3, tmux not installed: viewer_smoke",
                                      f"{runs} passed, 0 failed, {runs + 3} skipped"])
        self.assertRegex(self.calls.read_text(), r"\nqemu-aarch64 .*/edgewise_hashes .*/tests/hashes.json --frames 200\n")

    def test_a_wrong_hash_on_another_processor_fails(self):
        self.file("build/edgewise_hashes", '#!/bin/bash\nshift\necho "0 0: here, $*"\n').chmod(0o755)
        result, lines = self.run_tests(QEMU_STATUS="1")
        self.assertEqual(result.returncode, 1)
        self.assertIn("\n< 0 0: here, --dump cube/3\n---\n> 0 0: there\n", result.stdout)
        self.assertEqual(lines[-2], "Failed: the run ended without results; see above (aarch64)")

    def test_selected_tests_run_once_and_failures_are_named(self):
        good, bad = (CTEST_CASES % more for more in ("", FAILED_CASES))
        for xml, status, *last in ((good, 0, "1 passed, 0 failed, 2 skipped"), (good, 3, "1 passed, 1 failed, 2 skipped"),
                                   (bad, 8, "Failed: B.Wrong (tests)", "Failed: gone (tests)", "1 passed, 2 failed, 2 skipped"),
                                   ("", 8, "Failed: the run ended without results; see above (tests)", "0 passed, 1 failed, 0 skipped")):
            result, lines = self.run_tests("-R", "A", "-j4", xml=xml, CTEST_STATUS=str(status))
            self.assertEqual((result.returncode, lines[-len(last):]), (status, last))
        self.assertEqual(self.calls.read_text().count(" -R A -j4"), 4)


if __name__ == "__main__":
    unittest.main()
