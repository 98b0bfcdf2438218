"""The scripts that read results, on the committed ones and on changed copies of them: the READMEs hold what they must say."""
import importlib.util
import json
import math
import re
import unittest
from itertools import product

import support
from support import RESULTS, ROOT, SCRIPTS, FolderTest, copied_results, google_benchmark, read
from accuracy_rows import FAMILIES, parse_sweep
from bench_rows import Bench, parse_name
from factors import gains
from program import readmes


def run(script, *arguments, **options):
    return support.run(SCRIPTS / script, *arguments, **options)


class ScriptsTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.results = copied_results(self.folder / "results")
        self.facts = self.results.parent / "facts"
        self.bench = read(self.results / "bench.json")

    def write(self, name, bench):
        return self.file(f"{name}/bench.json", json.dumps(bench)).parent

    def page(self, *names):
        """A README with these blocks."""
        return self.file("README.md", "\n".join([f"<!-- results: results/{RESULTS.name} -->", *(
            f"<!-- generated:{name} -->\n<!-- /generated -->" for name in names)]))

    def test_compare_names_what_changed_and_only_that(self):
        rows = self.bench["rows"]
        for name, factor in (("tiled/large/threads:1", 1.5), ("tiled/small/threads:1", 0.5)):
            rows[name]["ms"] = [factor * ms for ms in rows[name]["ms"]]
        result = run("compare", self.results, self.write("after", google_benchmark(self.bench)) / "bench.json")
        self.assertIn(" 1 slower, 1 faster", result.stdout, result.stderr)
        self.assertRegex(result.stdout, r"\nSlower\n +tiled/large/threads:1 .* ms +1\.500 .*\n\nFaster\n +tiled/small/threads:1 .* ms +0\.500 ")

    def test_bad_input_gets_one_line(self):
        self.fails(run("summary", self.folder), "bench.json", "No such file")
        for text, *words in (("{", "broken.json", "not JSON"), ('{"benchmarks": [{"name": "x"}]}', "Google Benchmark"),
                             ('{"rows": {"tiled/cube/threads:1": {"triangles": 1}}}', "scripts/publish", "'ms'")):
            self.fails(run("compare", self.results, self.file("broken.json", text)), *words)
        page = self.page("choice_table", "needs", "demos")
        # The last that is read is broken first, since only the first broken one is told.
        for name, text, *words in (("facts/demos", "", "not JSON"),
                                   ("facts/needs", '[{"scene": "cube"}]', "edgewise needs"),
                                   ("facts/accuracy", '{"methods": []}', "edgewise accuracy", "'scenes'"),
                                   (f"{RESULTS.name}/peers", '{"choices": [{}]}', "edgewise accuracy --peers", "'name'")):
            broken = self.file(self.results.parent / f"{name}.json", text)
            self.fails(run("readme", "--file", page), broken.name, *words)

    def test_the_readmes_are_those_of_the_results(self):
        for path in (*readmes(ROOT / "README.md"), *(ROOT / "results").rglob("*.[jt]s*")):
            self.file(path.relative_to(ROOT), path.read_text())
        copied = readmes(self.folder / "README.md")
        before = [page.read_text() for page in copied]
        check = run("readme", "--check", "--file", copied[0])
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        for page in copied:  # without what is generated
            page.write_text(re.sub(r"(<!-- generated:.*?-->\n).*?(<!-- /generated -->)", r"\1\2", page.read_text(), flags=re.DOTALL))
        self.assertEqual(run("readme", "--check", "--file", copied[0]).returncode, 1)
        self.assertEqual(run("readme", "--file", copied[0]).returncode, 0)
        self.assertEqual([page.read_text() for page in copied], before)

    def test_what_was_not_measured_is_not_told(self):
        for path in (*self.facts.glob("*.json"), *self.results.glob("*.json")):
            if path.name not in ("machine.json", "accuracy.json"):
                path.unlink()
        self.bench["rows"] = {name: row for name, row in self.bench["rows"].items() if name.startswith("naive/")}
        self.write(self.results, self.bench)
        page = self.page("speed", "factors", "engine", "choice_table", "portable", "peers", "python", "verification_brief")
        self.assertEqual(run("readme", "--file", page).returncode, 0)
        text = page.read_text()
        self.assertEqual(text.count("none of the rows"), 5, text)
        for words in ("`scripts/run --peers` does", "`scripts/run --full --peers` does"):
            self.assertIn(words, text)

    def test_a_summary_fits_on_a_screen(self):
        def summary(folder, most=25):
            result = run("summary", folder.name, directory=folder.parent)
            self.assertEqual(result.returncode, 0, result.stderr)
            lines = result.stdout.splitlines()
            self.assertLessEqual(len(lines), most, result.stdout)
            self.assertLessEqual(max(map(len, lines)), 80, result.stdout)
            self.assertLessEqual(result.stdout.count("\n- "), 5, "five sentences")
            return " ".join(result.stdout.split())

        for whole in ROOT.glob("results/*/verify.json"):
            self.assertRegex(summary(whole.parent), "all are the same.*Fastest whole frames on 2 threads: .*tiled on .*large")
        self.assertRegex(summary(self.results), "tiled against llvmpipe, [^s ]+ to")
        self.bench["context"] |= {"suite": "quick", "peers": ""}
        self.bench["rows"] |= {f"tiled/scene{i}": {"ms": [], "error": "wrong " * 99} for i in range(50)}
        self.write(self.results, self.bench)
        self.file(self.results / "charts/choice.svg", "")
        self.file(self.facts / "pictures/cube.png", "")
        for name, before, after in (("verify", '"differing_pixels":0', '"differing_pixels":3'), ("machine", '"usable_cores":2', '"usable_cores":1')):
            text = (self.results / f"{name}.json").read_text()
            self.file(self.results / f"{name}.json", text.replace(before, after, 1))
        text = summary(self.results, 27)
        for words in ("1 usable of 2 cores", "ERROR in 50 benchmark rows", f"3 pixels differ; see {RESULTS.name}/verify-failures/",
                      f"Chart: {RESULTS.name}/charts/choice.svg", "Pictures: facts/pictures", "scripts/run --full", "scripts/run --peers",
                      "8 subpixel bits): edgewise portable finds them"):
            self.assertIn(words, text)

    def test_plot_draws_the_same_bytes_twice(self):
        python = next((python for python in ("python3", "/usr/bin/python3") if support.run(python, "-c", "import matplotlib").returncode == 0), None)
        if not python:
            self.skipTest("no matplotlib")
        again = self.folder / "again"
        for arguments in ((), ("--out", again)):
            result = support.run(python, SCRIPTS / "plot", self.results, *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
        first, again = ({path.name: path.read_text() for path in folder.iterdir()} for folder in (self.results / "charts", again))
        self.assertEqual(first, again)
        self.assertEqual(set(first), {f"{name}.svg" for name in ("area", "choice", "stability-grid", *(f"errors-{family}" for family in FAMILIES))})
        for name, svg in first.items():
            [title] = re.findall(r'<g id="title">\s*<!-- (.*?) -->', svg)  # texts are paths; matplotlib keeps them as comments
            self.assertLessEqual(len(title.split()), 12, name)


class FactorsTest(unittest.TestCase):
    def test_factors_are_told_of_pairs_that_differ_in_nothing_else(self):
        """Each level has a time of its own: a ratio of two cells tells what they differ in."""
        times = {"traversal": {"bands": 2, "tiles": 3}, "fill": {"spans": 5, "edges": 7}, "simd": {"avx2": 11, "scalar": 13},
                 "with": {"": 17, "hiz": 19, "hiz+masks": 23}, "threads": {1: 29, 2: 31}}
        rows = {}
        for scene, overdraw, triangles in (("deep", 4, 1e5), ("flat", 3.9, 999)):
            for levels in product(*times.values()):
                traversal, fill, simd, extra, threads = levels
                name = f"cell/{scene}/traversal:{traversal}/fill:{fill}/simd:{simd}{extra and f'/with:{extra}'}/threads:{threads}"
                rows[name] = parse_name(name)
                rows[name].times_ms = [math.prod(of[level] for of, level in zip(times.values(), levels))] * 9
                rows[name].counters = {"overdraw": overdraw, "covered_px": 1e6, "triangles": triangles}
        for gain in gains(Bench({}, rows)):
            before, after = {"traversal": (2, 3), "fill": (5, 7), "simd": (13, 11), "threads": (29, 31)}.get(
                gain.field, (17, 19) if gain.factor == "HiZ" else (19, 23))
            meant = {"overdraw ≥4": {"deep"}, "triangles ≤10 px": {"deep"}, "elsewhere": {"flat"}}.get(gain.where, {"deep", "flat"})
            self.assertEqual({scene for _, scene in gain.pairs}, meant)
            for ratio, _ in gain.pairs:
                self.assertAlmostEqual(ratio, before / after)
            self.assertEqual(set(gain.orders), {1 if after > before else -1})


@unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "no matplotlib")
class ChartsTest(unittest.TestCase):
    def test_the_grid_says_which_of_ours_hold_and_why_they_fail(self):
        from plot_stability import lines_of, named

        def sweep(name, **fails):
            curves = [{"method": method, "source": source, "points": [[1024.0, 0], [3.0, 0], [2.0 ** -10, 0]], "starts_to_fail": fails.get(method),
                       "trials": [9]} for method, source in (("ours_8", "src/"), ("ours_15", "src/"), ("a", ""), ("b", ""))]
            return parse_sweep({"name": name, "family": "coverage", "x": {"name": "distance", "unit": "px"}, "why": "of 8 bits", "curves": curves})

        self.assertEqual(named(sweep("far_away_on_halves")), ("Coverage, vertices at pixel centres and halves", "far away"))
        sweeps = [sweep("far_away", ours_8=1024.0, a=1024.0), sweep("thin", a=1024.0, b=3.0)]
        self.assertEqual([texts for _, texts, _ in lines_of("Coverage", sweeps)], [
            ["Coverage: ours_15 holds in 2 of 2 sweeps"], ["Hold in all: ours_15."], ["Fail from the start in all: a."],
            ["Why ours fail in far away: of 8 bits."],
            ["", "far away", "thin"], ["", *["px: 1,024 to $2^{-10}$"] * 2], ["ours_8"], ["b"], []])

    def test_dense_labels_stand_apart(self):
        import numpy as np
        from matplotlib.transforms import Bbox
        from plot_labels import place
        points = np.array([*((200.0 + 6 * (i % 3), 150.0 + 5 * (i // 3)) for i in range(9)), (398.0, 1.0)])
        bounds = Bbox.from_extents(0, 0, 400, 300)
        boxes = place(points, [(60.0, 10.0)] * len(points), bounds, [])
        for i, box in enumerate(boxes):
            self.assertEqual((bounds.count_contains(box.corners()), box.count_contains(points), box.count_overlaps(boxes[:i])), (4, 0, 0))


if __name__ == "__main__":
    unittest.main()
