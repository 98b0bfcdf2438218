"""checks/test_results.py, and of reporting/ verification_summary.py, shards.py and platforms.py, on results made here."""
import json
import sys
import unittest

from support import SCRIPTS, FolderTest, run
from platforms import TRIED, platforms_table
from verification_summary import verification_table


def gtest_case(suite, name, inside="", result="completed", **properties):
    noted = "".join(f'<property name="{key}" value="{value}"/>' for key, value in properties.items())
    return f'<testcase classname="{suite}" name="{name}" result="{result}"><properties>{noted}</properties>{inside}</testcase>'


SHARDS = [[gtest_case("Properties", "A", cases=40, comparisons=400), gtest_case("Properties", "B")],
          [gtest_case("Properties", "C", "<failure/>", cases=2), gtest_case("Properties", "D", "<skipped/>", "skipped")]]
CTEST = ["run"] * 3 + ["fail", "disabled"] + ["notrun"] * 2


def totals(tests, failed=0, skipped=0, **counted):
    return {"tests": tests, "failed": failed, "skipped": skipped, **counted}


TOTALS = {"all": totals(4, 1, 1, cases=42, comparisons=400), "sanitized": [{"name": "thread", **totals(7, 1, 3)}]}
GOOD = {"tests": {"all": totals(500, cases=2_000_000, comparisons=0), "sanitized": [{"name": "address", **totals(499)}]},
        "prove": {"claims": 9, "proven": 9, "premises_hold": 9, "refuted": 9},
        "mutate": {"mutations": 25, "caught": 25},
        "fuzz": {"cpu_hours": 4.0, "targets": [{"what": "any bytes", "executions": 12_345, "lines_reached": 90, "lines": 100, "crashes": []}]}}


class CollectTest(FolderTest):
    def collected(self):
        return run(sys.executable, SCRIPTS / "checks/test_results.py", self.folder, "--json")

    def test_adds_up_shards_and_sanitizers(self):
        for i, shard in enumerate(SHARDS):
            self.file(f"tests-{i}.xml", f"<testsuites>{''.join(shard)}</testsuites>")
        cases = "".join(f'<testcase status="{status}"><skipped message="SKIP_RETURN_CODE=77"/></testcase>' for status in CTEST)
        self.file("thread.xml", f"<testsuite>{cases}</testsuite>")
        self.file("address.xml", "")  # not run yet
        self.assertEqual(json.loads(self.collected().stdout), TOTALS)

    def test_says_what_is_no_result(self):
        self.file("thread.xml", "<a/>")
        result = self.collected()
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)


class VerificationTest(FolderTest):
    def test_what_failed_is_bold(self):
        def found(**results):
            for key, data in results.items():
                self.file(f"{key}.json", json.dumps(data))
            return [line[2] for line in verification_table(self.folder)[1]]

        self.assertEqual(found(verify={"scenes": [{"configurations": 300, "differing_pixels": 0}]}, **GOOD), [
            "no pixel differs", "no failure", "no failure", "all proven; all premises satisfiable; all false variants refuted", "all caught", "no crash"])
        scene = {"configurations": 1200, "differing_pixels": 4, "oracle": {"configurations": 30, "written_outside": 3}}
        self.assertEqual(found(verify={"scenes": [scene]}, tests=TOTALS, prove={"claims": 9, "proven": 8, "premises_hold": 6, "refuted": 7},
                               mutate={"mutations": 25, "caught": 24},
                               fuzz={"cpu_hours": 1.0, "targets": [{**GOOD["fuzz"]["targets"][0], "crashes": ["a", "b"]}]}), [
            "**7 pixels differ**", "**1 failure**", "**1 failure**",
            "**8 of 9 proven**; **6 of 9 premises satisfiable**; **7 of 9 false variants refuted**", "**24 of 25 caught**", "**2 crashes**"])


class PlatformsTest(FolderTest):
    def test_findings_have_their_columns_and_a_failure_is_told(self):
        findings = {name: ("passed", ["2000 frames of 3 groups, drawn by 2 combinations: no hash differs", *["300 frames drawn: no hash differs"] * 2])
                    for name in TRIED}
        findings["s390x"] = ("failed", ["20 frames of 3 groups: 1 hash differs", "[  PASSED  ] 1312 tests.", "9 bytes of facts are those of x86-64"])
        lines = self.file("lines", "".join(f"{name}\t{result}\t{text}\n" for name, (result, texts) in findings.items() for text in texts))
        result = run(sys.executable, SCRIPTS / "reporting/platforms.py", lines)
        table = platforms_table(self.file("platforms.json", result.stdout))[1]
        self.assertEqual([line[0] for line in table], ["x86-64", "consumer", "aarch64", "s390x: **failed**", "riscv64", "wasm32"])
        self.assertEqual([line[2:] for line in table], [["2,000 + 2 × 300", "–", "–"]] * 3 +
                         [["–", "1,312", "the same as on x86-64"]] + [["2,000 + 2 × 300", "–", "–"]] * 2)


class ShardsTest(FolderTest):
    def added(self, *lines):
        paths = [self.file(f"{i}.json", json.dumps(line)) for i, line in enumerate(lines)]
        return run(sys.executable, SCRIPTS / "reporting/shards.py", *paths)

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
