"""scripts/compare with git revisions, in a small repository with a cmake that makes fake benchmarks."""
import json
import re
import signal
import unittest

from support import CopyTest

# "Builds" the sources' benchmark by copying it.
CMAKE = """#!/bin/bash
if [[ $1 == --build ]]; then
  [[ -f $2/compiled ]] || { echo 'a.cpp:1: error: no'; echo 'stopped'; exit 1; }
  { cat "$2/compiled"; echo "# $(cat "$2/padding.cpp")"; } >"$2/edgewise_bench"
  chmod +x "$2/edgewise_bench"
else
  [[ $* == *EXE_LINKER_FLAGS=*$4/padding.cpp* && -f $4/padding.cpp ]] || exit 1
  cp "$2/edgewise_bench" "$4/compiled" || rm -f "$4/compiled"
fi
"""
# Times are those of a commit, times noise that drifts. $STARTS gets a line for each start: its side, and its padding.
BENCH = """#!/usr/bin/env python3
import json, os, random, re, sys, time
from pathlib import Path
flags = dict(arg.partition("=")[::2] for arg in sys.argv[1:])
rows = {name: row for name, row in json.loads(%r).items() if re.search(flags["--benchmark_filter"], name)}
if not rows:
    print("Failed to match any benchmarks", file=sys.stderr)
    sys.exit(2)
starts = Path(os.environ["STARTS"])
with starts.open("a") as file:
    print(Path(sys.argv[0]).name[0], Path(sys.argv[0]).read_text().splitlines()[-1], len(os.environ["EDGEWISE_PADDING"]), sep=";", file=file)
if "INTERRUPTS" in os.environ:
    os.kill(os.getppid(), int(os.environ["INTERRUPTS"]))
    time.sleep(60)
start = len(starts.read_text().splitlines())
generator = random.Random(start)
entries = [{"name": name, "real_time": row["ms"] * (1 + start / 100) * generator.uniform(0.995, 1.005), "time_unit": "ms",
            "triangles": row["triangles"], "error_occurred": row["wrong_at"] == start, "error_message": "other pixels"}
           for name, row in rows.items() for _ in range(3)]
Path(flags["--benchmark_out"]).write_text(json.dumps({"benchmarks": entries}))
"""


def row(ms, triangles=2.0, wrong_at=0):
    return {"ms": ms, "triangles": triangles, "wrong_at": wrong_at}


class CompareTest(CopyTest):
    def setUp(self):
        super().setUp()
        self.environment["STARTS"] = f"{self.folder}/starts"
        self.tool("cmake", CMAKE)
        self.file(".gitignore", "/build/\n/starts\n/tools/\n")
        self.git("init", "-q")
        self.commit(a=row(1.0), b=row(2.0), c=row(3.0))

    def change(self, **rows):
        """The benchmark of the working tree has these rows of `tiled`."""
        named = {f"tiled/{name}/threads:1": row for name, row in rows.items()}
        self.file("edgewise_bench", BENCH % json.dumps(named)).chmod(0o755)

    def commit(self, **rows):
        self.change(**rows)
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "rows")

    def compare(self, *arguments, **environment):
        result = self.script("compare", *arguments, **environment)
        self.assertEqual([*(self.folder / "build/compare").glob("rounds-*")], [], "something is left")
        return result

    def test_two_per_cent_are_found_in_the_working_tree(self):
        self.change(a=row(1.02), b=row(1.9), c=row(3.0))
        result = self.compare("HEAD", "--filter", "tiled", "--rounds", 20)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("20 rounds, before and after by turns; 3 rows: 1 slower, 1 faster, 1 no significant difference", result.stdout)
        groups = r"(?s)\nSlower\n  (tiled/a/.*)\n\nFaster\n  tiled/b/.*\n\nNo significant difference\n  tiled/c/"
        ratio, low, high = map(float, re.findall(r"\b\d\.\d{3}\b", re.search(groups, result.stdout)[1])[2:])
        self.assertTrue(1.01 < low < ratio < high < 1.03)
        self.assertRegex(result.stdout, r"\nGeometric means of the ratios: tiled 0\.9[89]\d, all 0\.9[89]\d\n$")
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 100)
        sides, *layouts = zip(*(line.split(";") for line in (self.folder / "starts").read_text().splitlines()))
        self.assertEqual("".join(sides), "abba" * 10)
        for random_sizes in (layouts[0], layouts[-1]):
            self.assertGreater(len(set(random_sizes)), 30, "both sides of each round are laid out anew")

    def test_rows_that_cannot_be_compared_are_listed(self):
        self.commit(a=row(1.0, 3.0), b=row(2.0, wrong_at=3), d=row(1.0))
        result = self.compare("HEAD~", "HEAD", "--filter", "tiled", "--rounds", 9)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("0 rows: 0 slower", result.stdout)
        self.assertTrue(result.stdout.endswith("""
Not compared
  error, other pixels: tiled/b/threads:1
  only after: tiled/d/threads:1
  only before: tiled/c/threads:1
  other triangles, pixels or size: tiled/a/threads:1
"""), result.stdout)

    def test_bad_input_is_told(self):
        self.fails(self.compare("HEAD", "--filter", "nothing"), "compare: edgewise_bench ended with 2: Failed to match any benchmarks")
        self.fails(self.compare("HEAD", "--filter", "tiled", "--rounds", 9), "compare: 9 rounds settle nothing; 10 are the fewest for 3 rows")
        self.commit(other=row(1.0))
        self.fails(self.compare("HEAD~", "HEAD", "--filter", "."), "compare: no row of both revisions matches '.'")
        (self.folder / "edgewise_bench").unlink()
        self.assertEqual(self.compare("HEAD").stderr, "a.cpp:1: error: no\ncompare: the build of the working tree ended with 1: stopped\n")

    def test_an_interruption_leaves_no_result(self):
        for end in (signal.SIGINT, signal.SIGTERM):
            result = self.compare("HEAD", "--filter", "tiled", INTERRUPTS=str(int(end)))
            self.assertEqual((result.returncode, result.stderr), (130, ""))
            self.assertNotIn("slower", result.stdout)


if __name__ == "__main__":
    unittest.main()
