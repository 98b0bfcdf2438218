"""What scripts compute from results, where the committed ones don't show a case; README's claims hold on those."""
import json
import sys
import unittest

from support import SCRIPTS, FolderTest, run
import claims
from bench_rows import Bench, parse_name
from bench_tables import peer_lines, speed_table
from facts_tables import pipelines_table
from platforms import TRIED, platforms_table
from shards import ADDED
from python_tables import against
from verification_summary import verification_table

NOISE = (0.99, 1.0, 1.01, 0.995, 1.005)
SHARDS = ('''<testsuites>
<testcase classname="P" name="A"><properties><property name="cases" value="40"/><property name="comparisons" value="400"/></properties></testcase>
<testcase classname="P" name="B"/></testsuites>''',
          '''<testsuites>
<testcase classname="P" name="C"><properties><property name="cases" value="2"/></properties><failure/></testcase>
<testcase classname="P" name="D" result="skipped"><skipped/></testcase></testsuites>''')
CTEST = ["run"] * 3 + ["fail", "disabled"] + ["notrun"] * 2
TOTALS = {"all": {"tests": 4, "failed": 1, "skipped": 1, "cases": 42, "comparisons": 400},
          "sanitized": [{"name": "thread", "tests": 7, "failed": 1, "skipped": 3}]}


def bench(times_ms, **context):
    """From {row's name: milliseconds}."""
    rows = {name: parse_name(name) for name in times_ms}
    for name, row in rows.items():
        row.times_ms = [times_ms[name] * noise for noise in NOISE]
        row.counters = {"triangles": 4.0, "overdraw": 2.0}
    return Bench({"backends": "scanline naive tiled", "simd_target": "avx512", **context}, rows)


class TablesTest(unittest.TestCase):
    def test_a_gpu_has_one_row_a_scene(self):
        told = bench({"tiled+frontend/a/threads:2": 2.0, "tiled+frontend/a/threads:1": 4.0, "gpu+frontend/a/threads:1": 1.0}, peers="gpu")
        self.assertIn("4.0× slower in 1 of 1 scene on 1 thread; 2.0× slower in 1 of 1 scene on 2 threads", peer_lines(told))
        self.assertEqual(speed_table(told)[1][0][-1], "1.00")

    def test_of_several_pipelines_the_fastest_is_told(self):
        levels = {"near plane": "nothing", "facing test": "no test", "subpixel bits": "6 bits"}
        minima = [{**levels, "visibility": visibility} for visibility in ("painter_mean", "depth buffer", "submission_order")]
        timed = {f"needs/cube/pipeline:{which}/threads:1": ms for which, ms in (("exact", 4.0), (1, 4.0), (2, 2.0), (3, 3.0))}
        for rows, *told in ((timed, "depth buffer", "2.0×"), ({}, "`submission_order`", "–")):
            [line] = pipelines_table({"cube": ({"minima": minima}, {})}, bench(rows))[1]
            self.assertEqual([line[3], line[-1]], told)

    def test_a_python_peer_may_be_faster_and_have_holes(self):
        ms = {name: {"2": {job: [factor * time * noise for noise in NOISE * 2] for job, factor in (("draw", 1.0), ("redraw", 1.0), ("load", 9.0))}}
              for name, time in (("edgewise", 2.0), ("vtk", 1.0))}
        picture = {"mesh": "hill", "covered": 5000, "peers": {"vtk": {"differ": 1234, "holes": 2}}, "ms": ms}
        self.assertEqual(against("vtk", {"versions": {"vtk": "VTK 9"}, "pictures": [picture]}),
                         "- Against VTK 9, a draw into new arrays is 2.0× slower in 1 of 1 scene; a draw into reused arrays is 2.0× slower "
                         "in 1 of 1 scene; load and draw is 2.0× slower in 1 of 1 scene. "
                         "Of 5k pixels 1,234 show another triangle, 2 of them a hole.")


class ClaimsTest(unittest.TestCase):
    def test_hold_on_every_machine(self):
        self.assertEqual(claims.check(), 0)

    def test_faults_are_found(self):
        says, bounds = "A second core makes frames `1.9×` faster.", {"median(x)": [1.85, 1.95]}
        page = claims.plain("A second core makes\nframes [1.9×](results) faster.")
        good, bad = {"median(x)": 1.9}, {"median(x)": 1.96}
        for says, found, *fault in ((says, {"a": good, "b": good}), (says, {"a": good, "b": bad}, "b: median(x) is 1.96, not in [1.85, 1.95]"),
                                    (says, {"a": good}, "can be evaluated on a, not on a, b"),
                                    ("A second core doubles the speed.", {"a": good, "b": good}, "is not in README.md")):
            self.assertEqual(list(claims.faults({"says": says, "bounds": bounds, "of": ["a", "b"]}, found, page)), fault)

    def test_a_sentence_without_a_claim_is_found(self):
        section = "- **SIMD.** On a Zen 3, it is [2×](results) faster. Then it is 3× slower.\n- No figure. Use 1/256 px."
        self.assertEqual(claims.unclaimed(section, [{"says": "On a Zen 3, it is 2× faster."}]), ["Then it is 3× slower."])


class VerificationTest(FolderTest):
    def python(self, script, *arguments):
        return run(sys.executable, SCRIPTS / script, *arguments)

    def test_shards_and_sanitizers_of_tests_add_up(self):
        for i, shard in enumerate(SHARDS):
            self.file(f"tests-{i}.xml", shard)
        cases = "".join(f'<testcase status="{status}"><skipped message="SKIP_RETURN_CODE=77"/></testcase>' for status in CTEST)
        self.file("address.xml", "")  # not run yet
        self.file("thread.xml", f"<testsuite>{cases}</testsuite>")
        command = "checks/test_results.py", self.folder, "--json"
        self.assertEqual(json.loads(self.python(*command).stdout), TOTALS)
        self.file("thread.xml", "<a/>")
        self.fails(self.python(*command), "thread.xml")

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

    def test_findings_of_platforms_have_their_columns_and_a_failure_is_told(self):
        findings = {name: ("passed", ["2000 frames of 3 groups: no hash differs", "300 frames drawn: no hash differs"]) for name in TRIED}
        findings["s390x"] = ("failed", ["20 frames: 1 hash differs", "[  PASSED  ] 1312 tests.", "9 bytes of facts are those of x86-64"])
        lines = "".join(f"{name}\t{result}\t{text}\n" for name, (result, texts) in findings.items() for text in texts)
        table = platforms_table(self.file("platforms.tsv", lines))[1]
        self.assertEqual([line[0] for line in table], ["x86-64", "consumer", "aarch64", "s390x: **failed**", "riscv64", "wasm32"])
        expected = [["2,300", "–", "–"]] * 6
        expected[3] = ["–", "1,312", "the same as on x86-64"]
        self.assertEqual([line[2:] for line in table], expected)

    def test_only_other_shards_of_the_same_run_add_up(self):
        counts = dict.fromkeys(("cases", "frames", "triangles", "pixels", "oracle_frames", "frontend_lists", "differences", "seconds"), 2)
        first = {"seed": 7, "shard": "0/3", "commit": "abc", "cpu_model": "X", "simd_targets": ["scalar", "sse4"], "findings": ["a"], **counts}

        def added(**others):
            shards = [self.file(f"{i}.json", json.dumps(shard)) for i, shard in enumerate((first, {**first, **others}))]
            return self.python("reporting/shards.py", *shards)

        self.assertEqual(json.loads(added(shard="2/3", simd_targets=["scalar", "avx2"], findings=["b"]).stdout), {
            "seed": 7, "shard": ["0/3", "2/3"], "commit": "abc", "cpu_model": ["X", "X"], "simd_targets": ["scalar", "sse4", "avx2"],
            "findings": ["a", "b"], **dict.fromkeys(counts, 4)})
        for others in ({}, {"shard": "1/4"}, {"shard": "1/3", "seed": 8}, {"shard": "1/3", "commit": "def"}, {"shard": None}):
            self.fails(added(**others))


if __name__ == "__main__":
    unittest.main()
