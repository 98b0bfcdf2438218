"""checks/test_results.py, reporting/verification_summary.py and reporting/shards.py, on results made here."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS / "reporting"))
from verification_summary import verification_markdown, verification_table  # noqa: E402


def gtest_case(suite, name, inside="", result="completed", **properties):
    noted = "".join(f'<property name="{key}" value="{value}"/>' for key, value in properties.items())
    return f'<testcase classname="{suite}" name="{name}" result="{result}"><properties>{noted}</properties>{inside}</testcase>'


SHARDS = [[gtest_case("Properties", "A", cases=40, comparisons=400), gtest_case("Properties", "B"),
           gtest_case("Lattices/EveryTriangle", "E", cases=9)],
          [gtest_case("CoverageProperties", "C", "<failure/>", cases=2),
           gtest_case("CoverageProperties", "D", "<skipped/>", "skipped"), gtest_case("ConformanceDepth", "F", cases=5),
           gtest_case("Table/InvalidInput", "G/0"), gtest_case("Table/InvalidInput", "G/1"),
           gtest_case("VerifyRandom", "H", cases=1000)]]
CTEST = ["run"] * 3 + ["fail", "disabled"] + ["notrun"] * 2


def totals(tests, failed=0, skipped=0, **counted):
    return {"tests": tests, "failed": failed, "skipped": skipped, **counted}


TOTALS = {"all": totals(9, 1, 1),
          "families": {"properties": totals(4, 1, 1, cases=42, comparisons=400),
                       "lattices": totals(1, cases=9, comparisons=0), "conformance": totals(1, cases=5, comparisons=0),
                       "invalid_input": totals(2, cases=0, comparisons=0)},
          "sanitized": [{"name": "thread", **totals(7, 1, 3)}]}
GOOD = {"tests": {"all": totals(500), "families": {"lattices": totals(5, cases=2_000_000, comparisons=0)},
                  "sanitized": [{"name": "address", **totals(499, 0, 2)}]},
        "prove": {"claims": 9, "proven": 9, "premises_hold": 9, "refuted": 9},
        "mutate": {"mutations": 25, "caught": 25},
        "fuzz": {"cpu_hours": 4.0, "targets": [{"what": "any bytes", "executions": 12_345, "lines_reached": 90, "lines": 100, "crashes": []}]}}


class CollectTest(unittest.TestCase):
    def test_adds_up_shards_and_sanitizers(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for i, shard in enumerate(SHARDS):
                (folder / f"tests-{i}.xml").write_text(f"<testsuites>{''.join(shard)}</testsuites>")
            cases = "".join(f'<testcase status="{status}"><skipped message="SKIP_RETURN_CODE=77"/></testcase>'
                            for status in CTEST)
            (folder / "thread.xml").write_text(f"<testsuite>{cases}</testsuite>")
            (folder / "address.xml").write_text("")  # not run yet
            run = subprocess.run([sys.executable, SCRIPTS / "checks/test_results.py", folder, "--json"], stdout=subprocess.PIPE,
                                 check=True)
            self.assertEqual(json.loads(run.stdout), TOTALS)

    def test_says_what_is_no_result(self):
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "thread.xml").write_text("<a/>")
            run = subprocess.run([sys.executable, SCRIPTS / "checks/test_results.py", name, "--json"], stderr=subprocess.PIPE, text=True,
                                 check=False)
            self.assertEqual(run.returncode, 2)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)


class VerificationTest(unittest.TestCase):
    def table(self, **results):
        with tempfile.TemporaryDirectory() as name:
            for key, data in results.items():
                (Path(name) / f"{key}.json").write_text(json.dumps(data))
            return verification_table(Path(name))[1], verification_markdown(Path(name))

    def test_each_result_has_its_line(self):
        lines, text = self.table(**GOOD)
        self.assertEqual([line[1:] for line in lines], [
            ["500 tests", "no failure"],
            ["5 tests, 2M triangles", "no failure"],
            ["499 tests, 2 of them skipped", "no failure"],
            ["9 claims, each with a deliberately false variant", "all proven; all premises satisfiable; all false variants refuted"],
            ["25 mutants, one at a time", "all caught"],
            ["12.3k executions", "no crash"]])
        self.assertNotIn("**", text)

    def test_what_was_not_run_is_left_out(self):
        self.assertEqual(len(self.table(mutate=GOOD["mutate"])[0]), 1)
        self.assertEqual(self.table(), ([], "None of this was run for these results."))

    def test_what_ran_on_another_machine_names_it(self):
        shard = {"cases": 6000, "pixels": 2 * 10**9, "differences": 0, "simd_targets": ["scalar", "sse4"]}
        with tempfile.TemporaryDirectory() as name:
            here, there = Path(name, "results/here"), Path(name, "results/there")
            wrong = {**shard, "differences": 1, "commit": "abc"}
            for folder, found in ((here, {"random": shard}), (there, {"random": wrong, "mutate": GOOD["mutate"]})):
                folder.mkdir(parents=True)
                for key, data in found.items():
                    (folder / f"{key}.json").write_text(json.dumps(data))
            self.assertEqual([line[1:] for line in verification_table(here)[1]], [
                ["25 mutants, one at a time (`there`)", "all caught"],
                ["6k pictures in scalar code and SSE4, 2G pixels compared", "no difference"],
                ["6k pictures in scalar code and SSE4, 2G pixels compared (`there`, commit abc)", "**1 difference**"]])

    def test_what_failed_is_bold(self):
        bad = {"tests": TOTALS, "prove": {"claims": 9, "proven": 8, "premises_hold": 6, "refuted": 7},
               "mutate": {"mutations": 25, "caught": 24},
               "fuzz": {"targets": [{**GOOD["fuzz"]["targets"][0], "crashes": ["a", "b"]}]}}
        self.assertEqual([line[2] for line in self.table(**bad)[0]], [
            "**1 failure**", "**1 failure**", "no failure", "no failure", "no failure", "**1 failure**",
            "**8 of 9 proven**; **6 of 9 premises satisfiable**; **7 of 9 false variants refuted**",
            "**24 of 25 caught**",
            "**2 crashes**"])


class ShardsTest(unittest.TestCase):
    def added(self, *lines):
        with tempfile.TemporaryDirectory() as name:
            paths = [Path(name, f"{i}.json") for i in range(len(lines))]
            for path, line in zip(paths, lines):
                path.write_text(json.dumps(line))
            return subprocess.run([sys.executable, SCRIPTS / "reporting/shards.py", *paths], capture_output=True, text=True, check=False)

    def line(self, shard, targets=("scalar", "sse4"), **others):
        counts = dict.fromkeys(("cases", "frames", "triangles", "pixels", "oracle_frames", "frontend_lists"), 2)
        return {"seed": 7, "shard": shard, "commit": "abc", "cpu_model": "X", "simd_targets": targets, "backends": ["naive"],
                "seconds": 1.5, "differences": 1, "findings": [shard], **counts, **others}

    def test_shards_add_up(self):
        result = self.added(self.line("0/3"), self.line("2/3", targets=("scalar", "avx2")))
        total = json.loads(result.stdout)
        self.assertEqual(total, {**self.line(["0/3", "2/3"]), "cpu_model": ["X", "X"], "simd_targets": ["scalar", "sse4", "avx2"], "seconds": 3.0,
                                 "differences": 2, "findings": ["0/3", "2/3"],
                                 **dict.fromkeys(("cases", "frames", "triangles", "pixels", "oracle_frames", "frontend_lists"), 4)})

    def test_shards_that_share_pictures_or_come_from_other_programs_are_refused(self):
        first = self.line("0/3")
        for other in (self.line("0/3"), self.line("1/4"), self.line("1/3", seed=8), self.line("1/3", commit="def"), {"cases": 1}):
            result = self.added(first, other)
            self.assertEqual((result.returncode, result.stdout, len(result.stderr.splitlines())), (2, "", 1), result.stderr)


if __name__ == "__main__":
    unittest.main()
