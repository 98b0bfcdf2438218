"""scripts/compare with git revisions, in a small repository with a cmake that makes fake benchmarks."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from support import SCRIPTS, FolderTest

# "Builds" the sources' benchmark by copying it.
CMAKE = """#!/bin/bash
if [[ $1 == --build ]]; then
  [[ -f $2/compiled ]] || { echo 'a.cpp:1: error: no'; exit 1; }
  { cat "$2/compiled"; echo "# $(cat "$2/padding.cpp")"; } >"$2/edgewise_bench"
  chmod +x "$2/edgewise_bench"
else
  [[ $* == *EXE_LINKER_FLAGS=*$4/padding.o* && -f $4/padding.o ]] || exit 1
  touch "$4/CMakeCache.txt" && rm -f "$4/compiled"
  if [[ -f $2/rows.json ]]; then cp "$2/edgewise_bench" "$4/compiled"; fi
fi
"""
# Times are those of rows.json, times noise that drifts. The file of a round's number is shared by both sides.
BENCH = """#!/usr/bin/env python3
import json, os, random, re, sys
from pathlib import Path
flags = dict(arg.partition("=")[::2] for arg in sys.argv[1:])
rows = {name: row for name, row in json.loads(%r).items() if re.search(flags["--benchmark_filter"], name)}
if not rows:
    print("Failed to match any benchmarks", file=sys.stderr)
    sys.exit(2)
if "--benchmark_list_tests" in flags:
    sys.exit(print(*rows, sep="\\n"))
calls = Path(os.environ["CALLS"])
with calls.open("a") as file:
    file.write(Path.cwd().name)
with Path(os.environ["CALLS"] + "-layouts").open("a") as file:
    print(Path(sys.argv[0]).read_text().splitlines()[-1], len(os.environ["EDGEWISE_PADDING"]), file=file)
if os.environ.get("HANGS"):
    import time
    time.sleep(60)
start = calls.stat().st_size
generator = random.Random(start)
entries = []
for name, row in rows.items():
    for _ in range(row.get("repetitions", 3)):
        time = row["ms"] * (1 + start / 100) * generator.uniform(0.995, 1.005)
        entry = {"name": name, "run_name": name, "run_type": "iteration", "real_time": time, "time_unit": "ms", "triangles": row["triangles"]}
        entries.append({**entry, **({"error_occurred": True, "error_message": "other pixels"}
                                  if row.get("wrong") or row.get("wrong_once") and start == 1 else {})})
Path(flags["--benchmark_out"]).write_text(json.dumps({"context": {}, "benchmarks": entries}))
"""


def row(ms, triangles=2.0, **more):
    return {"ms": ms, "triangles": triangles, **more}


class CompareTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.root, self.calls = self.folder / "root", self.folder / "calls"
        self.environment["CALLS"] = str(self.calls)
        shutil.copytree(SCRIPTS, self.root / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        self.tool("cmake", CMAKE)
        self.tool("c++", '#!/bin/bash\ntouch "${@: -1}"\n')
        self.file("root/.gitignore", "/build/\n*.pyc\n")
        self.git("init", "-q")
        self.first = self.commit({"tiled/a/threads:1": row(1.0), "tiled/b/threads:1": row(2.0), "tiled/c/threads:1": row(3.0, repetitions=1)})

    def git(self, *arguments):
        return subprocess.run(["git", "-C", self.root, "-c", "user.name=t", "-c", "user.email=t@t", *arguments], check=True,
                              capture_output=True, text=True).stdout.strip()

    def change(self, rows):
        self.file("root/edgewise_bench", BENCH % json.dumps(rows)).chmod(0o755)
        self.file("root/rows.json", json.dumps(rows))

    def commit(self, rows):
        self.change(rows)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "rows")
        return self.git("rev-parse", "HEAD")

    def compare(self, *arguments, **environment):
        return self.with_tools(self.root / "scripts/compare", *arguments, **environment)

    def fails(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stderr.splitlines()[-1])
        self.nothing_left()

    def nothing_left(self):
        self.assertEqual([path.name for path in (self.root / "build/compare").glob("*-*") if path.name != "working-tree"], [])

    def test_two_per_cent_are_found_in_the_working_tree(self):
        self.change({"tiled/a/threads:1": row(1.02), "tiled/b/threads:1": row(1.9), "tiled/c/threads:1": row(3.0)})
        out = self.folder / "out.json"
        result = self.compare("HEAD", "--filter", "tiled", "--rounds", 20, "--json", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("20 rounds, before and after by turns; 3 rows: 1 slower, 1 faster, 1 no significant difference", result.stdout)
        slower, rest = result.stdout.split("\nSlower\n")[1].split("\nFaster\n")
        faster, same = rest.split("\nNo significant difference\n")
        for text, name in ((slower, "tiled/a/"), (faster, "tiled/b/"), (same, "tiled/c/")):
            self.assertIn(name, text.splitlines()[0])
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 100)
        self.assertEqual(self.calls.read_text(), "abba" * 10)
        code, environment = (set(column) for column in zip(*(line.split(";") for line in Path(f"{self.calls}-layouts").read_text().splitlines())))
        self.assertGreater(min(len(code), len(environment)), 30, "both sides of each round are laid out anew")
        told = json.loads(out.read_text())
        a = told["rows"][0]
        self.assertEqual((a["name"], a["verdict"], len(a["before_ms"]), told["rounds"]), ("tiled/a/threads:1", "slower", 20, 20))
        self.assertTrue(1.01 < a["low"] < a["ratio"] < a["high"] < 1.03)
        self.nothing_left()

    def test_a_revision_is_compared_with_itself(self):
        result = self.compare(self.first[:9], "HEAD", "--rounds", 9)
        self.assertEqual(result.returncode, 2, "the default rows are not there")
        result = self.compare(self.first[:9], "HEAD", "--rounds", 9, "--filter", "tiled/[ab]")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("2 rows: 0 slower, 0 faster, 2 no significant difference", result.stdout)
        self.assertEqual(result.stdout.count("Building "), 1)

    def test_rows_that_cannot_be_compared_are_listed(self):
        self.commit({"tiled/a/threads:1": row(1.0, 3.0), "tiled/b/threads:1": row(2.0, wrong=True), "tiled/d/threads:1": row(1.0)})
        result = self.compare(self.first, "HEAD", "--filter", "tiled", "--rounds", 9)
        self.assertEqual(result.returncode, 0, result.stderr)
        for words in ("0 rows: 0 slower", "other triangles, pixels or size\n  tiled/a/threads:1", "error\n  tiled/b/threads:1: other pixels",
                      "Only before\n  tiled/c/threads:1", "Only after\n  tiled/d/threads:1"):
            self.assertIn(words, result.stdout)

    def test_a_row_that_fails_in_some_rounds_is_an_error(self):
        self.commit({"tiled/a/threads:1": row(1.0, wrong_once=True), "tiled/b/threads:1": row(2.0)})
        self.fails(self.compare("HEAD", "HEAD", "--filter", "tiled/[ab]", "--rounds", 9), "different pixels from time to time")

    def test_a_time_limit_ends_the_rounds(self):
        start = time.monotonic()
        result = self.compare("HEAD", "--filter", "tiled/a", "--minutes", 0.2)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(time.monotonic() - start, 40)
        self.assertGreaterEqual(len(self.calls.read_text()), 16)
        self.fails(self.compare("HEAD", "--filter", "tiled", "--minutes", 0.0001), "10 are the fewest that settle so many rows", "--minutes")

    def test_bad_input_is_told(self):
        self.fails(self.compare("nosuch"), "nosuch: no such file, and no revision")
        self.fails(self.compare("HEAD", "--option=x"), "unknown argument")
        self.fails(self.compare("HEAD", "--filter", "nothing", "--rounds", 8), "no row of both revisions matches 'nothing'")
        self.fails(self.compare("HEAD", "--filter", "tiled", "--rounds", 9), "9 rounds settle nothing; 10 are the fewest for 3 rows")
        self.fails(self.compare("HEAD", "--json", self.folder / "no/out.json"), "no such folder")
        self.git("rm", "-q", "rows.json")
        self.git("commit", "-q", "-m", "broken")
        broken = self.compare("HEAD", self.first, "--filter", "tiled")
        self.assertIn("a.cpp:1: error: no\n", broken.stderr)
        self.fails(broken, "the build of", "broken failed; see above")

    def test_an_interruption_leaves_no_result(self):
        out = self.folder / "out.json"
        for end in (signal.SIGINT, signal.SIGTERM):
            self.calls.unlink(missing_ok=True)
            command = [self.root / "scripts/compare", "HEAD", "--filter", "tiled", "--rounds", "10", "--json", out]
            with subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
                                  env={**os.environ, **self.environment, "HANGS": "1"}) as process:
                limit = time.monotonic() + 30
                while not self.calls.exists() and time.monotonic() < limit:
                    time.sleep(0.05)
                process.send_signal(end)
                _, errors = process.communicate(timeout=20)
            self.assertEqual((process.returncode, errors), (130, "compare: interrupted: no result\n"))
            self.assertFalse(out.exists())
            self.nothing_left()


if __name__ == "__main__":
    unittest.main()
