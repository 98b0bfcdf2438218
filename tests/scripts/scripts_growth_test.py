"""What scripts/ says about growth, tile stores, small draws and memory, from results made up here."""
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

    def test_growth_and_memory_fill_the_readme(self):
        readme = self.folder / "README.md"
        names = ("growth", "tile_stores", "small_draws", "memory")
        readme.write_text("<!-- results: results -->\n"
                          + "".join(f"<!-- generated:{name} -->\n<!-- /generated -->\n" for name in names))
        result = scripts_test.run("readme", "--file", readme)
        self.assertEqual(result.returncode, 0, result.stderr)
        text = readme.read_text()
        self.assertIn("| cube | 2 | ", text)
        self.assertIn("| after 2 ms: rule, ms | streaming, ms |\n|---|--:|", text)
        self.assertIn("| 256 × 256 | `slow` | 20.2 | 20.2 | 1.00× (not settled) |\n", text)
        self.assertIn("The first frame takes 9.6 bytes per pixel plus 0 per triangle, at most 60% of what", text)

    def test_a_broken_cost_model_is_bad_input(self):
        self.write("apart", scripts_test.bench())
        (self.folder / "apart" / "model.json").write_text('{"costs": [{"name": "x"}]}')
        broken = scripts_test.run("compare", self.folder / "results", self.folder / "apart")
        self.assertEqual((broken.returncode, len(broken.stderr.splitlines())), (2, 1), broken.stderr)
        self.assertIn("model.json: not what 'edgewise_bench --model_out' writes", broken.stderr)

    def test_readme_says_so_where_rows_are_missing(self):
        data = scripts_test.bench()
        data["benchmarks"] = scripts_test.entries("tiled/cube/threads:1", [1.0])
        self.write("few", data)
        readme = self.folder / "README.md"
        names = ("small_draws", "tile_stores")
        readme.write_text("<!-- results: few -->\n"
                          + "".join(f"<!-- generated:{name} -->\n<!-- /generated -->\n" for name in names))
        self.assertEqual(scripts_test.run("readme", "--file", readme).returncode, 0)
        self.assertEqual(readme.read_text().count("hold none of the rows"), 2)


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


if __name__ == "__main__":
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    unittest.main()
