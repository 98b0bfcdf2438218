"""What scripts/ says about growth, more cores, the second thread, small draws and memory, from results made up here."""
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

import scripts_test


class ReadmeTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.write("results", scripts_test.bench())

    def write(self, name, benchmark):
        folder = self.folder / name
        folder.mkdir()
        timed, model = scripts_test.timed_and_model(benchmark)
        for file, data in (("bench", timed), ("model", model), ("machine", scripts_test.MACHINE)):
            (folder / f"{file}.json").write_text(json.dumps(data))

    def test_growth_more_cores_and_memory_fill_the_readme(self):
        readme = self.folder / "README.md"
        names = ("growth", "scaling", "second_thread", "tile_stores", "small_draws", "memory")
        readme.write_text("<!-- results: results -->\n"
                          + "".join(f"<!-- generated:{name} -->\n<!-- /generated -->\n" for name in names))
        result = scripts_test.run("readme", "--file", readme)
        self.assertEqual(result.returncode, 0, result.stderr)
        text = readme.read_text()
        self.assertIn("| cube | tiled | 2.0× | 2.0× | 3.0× | the longest task of build in bins.cpp: 50% of the path |", text)
        self.assertIn("charged 2 µs", text)
        self.assertIn("charts/second-thread.svg)\n\nSpeed-up by a second thread of the whole frames of `tiled` that take more than 2 ms on one, "
                      "above 1.9×: `knot` 1.92×; below 1.9×: `cube` 1.82× (largest loss: serial code, 5 %).\n", text)
        self.assertIn("| cube | 2 | ", text)
        self.assertIn("| after 2 ms: rule, ms | streaming, ms |\n|---|--:|", text)
        self.assertIn("| 256 × 256 | `slow` | 20.2 | 20.2 | 10.1 |\n", text)
        self.assertIn("The first frame takes 9.6 bytes per pixel plus 0 per triangle, at most 60% of what", text)

    def test_models_are_no_timed_rows(self):
        self.write("apart", scripts_test.bench())
        compared = scripts_test.run("compare", "--all", self.folder / "results", self.folder / "apart").stdout
        self.assertNotIn("cores:", compared)
        (self.folder / "apart" / "model.json").write_text('{"scheduled": [{"name": "x"}], "costs": []}')
        broken = scripts_test.run("compare", self.folder / "results", self.folder / "apart")
        self.assertEqual((broken.returncode, len(broken.stderr.splitlines())), (2, 1), broken.stderr)
        self.assertIn("model.json: not what 'edgewise_bench --model_out' writes", broken.stderr)
        uneven = {**scripts_test.rounds("tiled+frontend/cube/threads:2"), "two_ms": [2.2] * 8}
        (self.folder / "apart" / "model.json").write_text(json.dumps({"scheduled": [], "costs": [], "second_thread": [uneven]}))
        broken = scripts_test.run("compare", self.folder / "results", self.folder / "apart")
        self.assertEqual((broken.returncode, len(broken.stderr.splitlines())), (2, 1), broken.stderr)
        self.assertIn("rounds of tiled+frontend/cube", broken.stderr)

    def test_a_speed_up_is_of_one_run(self):
        sys.path.insert(0, str(scripts_test.SCRIPTS / "reporting"))
        from bench_rows import Row
        from scaling import allowed
        one = Row("", "", True, "", {}, [9.0], {"work_ms": 9.0})
        two = Row("", "", True, "", {}, [3.1], {"work_ms": 6.0})  # another run: less work
        self.assertEqual(allowed({1: one, 2: two}), {1: 1.0, 2: 6.0 / 3.1})

    def test_readme_says_so_where_rows_are_missing(self):
        data = scripts_test.bench()
        data["benchmarks"] = scripts_test.entries("tiled/cube/threads:1", [1.0])
        self.write("few", data)
        readme = self.folder / "README.md"
        model = self.folder / "few" / "model.json"
        model.write_text(json.dumps({key: rows for key, rows in json.loads(model.read_text()).items() if key != "second_thread"}))
        names = ("small_draws", "scaling", "second_thread", "tile_stores")
        readme.write_text("<!-- results: few -->\n"
                          + "".join(f"<!-- generated:{name} -->\n<!-- /generated -->\n" for name in names))
        self.assertEqual(scripts_test.run("readme", "--file", readme).returncode, 0)
        self.assertEqual(readme.read_text().count("hold none of the rows"), 4)


class GrowthTest(unittest.TestCase):
    """growth.steps(): where noise leaves open how cost grows, nothing is claimed."""

    def test_kinds(self):
        sys.path.insert(0, str(scripts_test.SCRIPTS / "reporting"))
        from bench_rows import Row
        from growth import QUANTITIES, steps

        def kinds(*repetitions):
            rows = [Row("", "", False, "", {"count": str(10 ** i)}, list(times)) for i, times in enumerate(repetitions)]
            return [step.kind for step in steps(QUANTITIES[0], rows)]

        self.assertEqual(kinds([1.0] * 5, [2.0] * 5, [4.0] * 5, [40.0] * 5), ["less than linear", "less than linear", "linear"])
        self.assertEqual(kinds([1.0] * 5, [20.0] * 5), ["more than linear"])
        self.assertEqual(kinds([1.0, 1.0, 3.0, 1.0, 3.0], [8.0, 20.0, 30.0, 8.0, 30.0]), ["not settled"])
        self.assertEqual(kinds([1.0], [20.0]), ["not settled"], "one draw decides nothing")


class SecondThreadTest(unittest.TestCase):
    """second_thread.Division: the parts of two threads' time, and whether the rounds settle the speed-up."""

    @classmethod
    def setUpClass(cls):
        sys.path.insert(0, str(scripts_test.SCRIPTS / "reporting"))

    @staticmethod
    def division(**changed):
        from second_thread import Division
        return Division("cube", scripts_test.rounds("tiled+frontend/cube/threads:2", **changed))

    def test_losses_and_useful_work_are_the_whole(self):
        found = self.division()
        self.assertAlmostEqual(found.speed_up, 4.0 / 2.2)
        self.assertAlmostEqual(sum(found.losses.values()) + found.speed_up / 2, 1.0)
        for cause, ms in (("slower", 0.07), ("serial", 0.22), ("start", 0.044), ("between", 0.022), ("turn", 0.0), ("end", 0.044)):
            self.assertAlmostEqual(found.losses[cause], ms / 4.4, msg=cause)

    def test_faster_tasks_are_no_loss(self):
        self.assertEqual(self.division(one_ms=4.2).losses["slower"], 0.0)

    def test_only_rounds_that_agree_settle_a_verdict(self):
        self.assertEqual([self.division(two_ms=ms).order for ms in (2.08, 2.2)], [1, -1])
        mixed = self.division()
        mixed.rounds["two_ms"] = [2.08, 2.2] * 4 + [2.1]
        self.assertEqual(mixed.order, 0)
        few = self.division(two_ms=2.08)
        few.rounds = {key: times[:4] for key, times in few.rounds.items()}
        self.assertEqual(few.order, 0, "four rounds settle nothing")

    def test_the_largest_loss_is_named(self):
        from second_thread import second_thread_sentence
        for end_ms, loss in ((None, "serial code"), (0.4, "end of sections")):
            division = self.division(two_ms=2.2, **({"end_ms": end_ms} if end_ms else {}))
            self.assertIn(f"(largest loss: {loss}, ", second_thread_sentence([division]))


if __name__ == "__main__":
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    unittest.main()
