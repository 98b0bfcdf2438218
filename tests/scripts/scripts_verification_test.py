"""checks/test_results.py, and of reporting/ verification_summary.py, shards.py and platforms.py, on results made here."""
import json
import sys
import unittest

from support import SCRIPTS, FolderTest, run
from platforms import TRIED, platforms_table
from shards import ADDED
from verification_summary import verification_table

SHARDS = ('''<testsuites>
<testcase classname="P" name="A"><properties><property name="cases" value="40"/><property name="comparisons" value="400"/></properties></testcase>
<testcase classname="P" name="B"/></testsuites>''',
          '''<testsuites>
<testcase classname="P" name="C"><properties><property name="cases" value="2"/></properties><failure/></testcase>
<testcase classname="P" name="D" result="skipped"><skipped/></testcase></testsuites>''')
CTEST = ["run"] * 3 + ["fail", "disabled"] + ["notrun"] * 2
TOTALS = {"all": {"tests": 4, "failed": 1, "skipped": 1, "cases": 42, "comparisons": 400},
          "sanitized": [{"name": "thread", "tests": 7, "failed": 1, "skipped": 3}]}


class VerificationTest(FolderTest):
    def collected(self):
        return run(sys.executable, SCRIPTS / "checks/test_results.py", self.folder, "--json")

    def test_shards_and_sanitizers_of_tests_add_up(self):
        for i, shard in enumerate(SHARDS):
            self.file(f"tests-{i}.xml", shard)
        cases = "".join(f'<testcase status="{status}"><skipped message="SKIP_RETURN_CODE=77"/></testcase>' for status in CTEST)
        self.file("thread.xml", f"<testsuite>{cases}</testsuite>")
        self.file("address.xml", "")  # not run yet
        self.assertEqual(json.loads(self.collected().stdout), TOTALS)
        self.file("thread.xml", "<a/>")
        result = self.collected()
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)

    def test_what_failed_is_bold(self):
        scene = {"configurations": 1200, "differing_pixels": 4, "oracle": {"configurations": 30, "written_outside": 3}}
        for name, data in {"verify": {"scenes": [scene]}, "tests": TOTALS, "mutate": {"mutations": 25, "caught": 24},
                           "prove": {"claims": 9, "proven": 8, "premises_hold": 6, "refuted": 7},
                           "fuzz": {"cpu_hours": 1.0, "targets": [{"executions": 12_345, "crashes": ["a", "b"]}]},
                           "random": {**dict.fromkeys(ADDED, 2), "simd_targets": ["sse4"], "shard": "0/1", "cpu_model": "X"}}.items():
            self.file(f"{name}.json", json.dumps(data))
        self.assertEqual([found for _, _, found in verification_table(self.folder)[1]], [
            "**7 pixels differ**", "**1 failure**; 1 skipped", "**1 failure**",
            "**8 of 9 proven**; **6 of 9 premises satisfiable**; **7 of 9 false variants refuted**", "**24 of 25 caught**", "**2 crashes**",
            "**2 differences**"])


class PlatformsTest(FolderTest):
    def test_findings_have_their_columns_and_a_failure_is_told(self):
        findings = {name: ("passed", ["2000 frames of 3 groups: no hash differs", "300 frames drawn: no hash differs"]) for name in TRIED}
        findings["s390x"] = ("failed", ["20 frames: 1 hash differs", "[  PASSED  ] 1312 tests.", "9 bytes of facts are those of x86-64"])
        lines = "".join(f"{name}\t{result}\t{text}\n" for name, (result, texts) in findings.items() for text in texts)
        table = platforms_table(self.file("platforms.tsv", lines))[1]
        self.assertEqual([line[0] for line in table], ["x86-64", "consumer", "aarch64", "s390x: **failed**", "riscv64", "wasm32"])
        expected = [["2,300", "–", "–"]] * 6
        expected[3] = ["–", "1,312", "the same as on x86-64"]
        self.assertEqual([line[2:] for line in table], expected)


class ShardsTest(FolderTest):
    def added(self, *lines):
        paths = [self.file(f"{i}.json", json.dumps(line)) for i, line in enumerate(lines)]
        return run(sys.executable, SCRIPTS / "reporting/shards.py", *paths)

    def test_only_other_shards_of_the_same_run_add_up(self):
        counts = dict.fromkeys(("cases", "frames", "triangles", "pixels", "oracle_frames", "frontend_lists", "differences", "seconds"), 2)
        first = {"seed": 7, "shard": "0/3", "commit": "abc", "cpu_model": "X", "simd_targets": ["scalar", "sse4"], "findings": ["a"], **counts}
        result = self.added(first, {**first, "shard": "2/3", "simd_targets": ["scalar", "avx2"], "findings": ["b"]})
        self.assertEqual(json.loads(result.stdout), {
            "seed": 7, "shard": ["0/3", "2/3"], "commit": "abc", "cpu_model": ["X", "X"], "simd_targets": ["scalar", "sse4", "avx2"],
            "findings": ["a", "b"], **dict.fromkeys(counts, 4)})
        for others in ({}, {"shard": "1/4"}, {"shard": "1/3", "seed": 8}, {"shard": "1/3", "commit": "def"}, {"shard": None}):
            result = self.added(first, {**first, **others})
            self.assertEqual((result.returncode, result.stdout, len(result.stderr.splitlines())), (2, "", 1), result.stderr)


if __name__ == "__main__":
    unittest.main()
