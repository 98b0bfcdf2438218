"""The scripts that read results, on the committed ones and on changed copies of them: the READMEs hold what they must say."""
import importlib.util
import json
import re
import shutil
import unittest
from itertools import product

import support
from support import RESULTS, ROOT, SCRIPTS, FolderTest, copied_results, google_benchmark, read
from accuracy_rows import parse_accuracy, read_stability, with_peers
from bench_rows import Bench, describe_machine, parse_name
from factors import gains
from program import BadInput, readmes


def run(script, *arguments):
    return support.run(SCRIPTS / script, *arguments)


def plotted(test, *arguments):
    """Runs scripts/plot by an interpreter that has matplotlib."""
    for python in ("python3", "/usr/bin/python3"):
        if support.run(python, "-c", "import matplotlib").returncode == 0:
            result = support.run(python, SCRIPTS / "plot", *arguments)
            return test.assertEqual(result.returncode, 0, result.stderr)
    return test.skipTest("no matplotlib")


class ScriptsTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.results = copied_results(self.folder / "results")
        self.facts = self.results.parent / "facts"
        self.bench = read(self.results / "bench.json")

    def write(self, name, bench):
        return self.file(f"{name}/bench.json", json.dumps(bench)).parent

    def fails(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_compare_names_what_changed_and_only_that(self):
        rows = self.bench["rows"] = {name: row for name, row in self.bench["rows"].items() if name.startswith(("tiled/", "naive/"))}
        before = self.write("before", self.bench)
        rows["tiled/large/threads:1"]["ms"] = [1.5 * ms for ms in rows["tiled/large/threads:1"]["ms"]]
        rows["tiled/small/threads:1"]["ms"] = [0.5 * ms for ms in rows["tiled/small/threads:1"]["ms"]]
        rows["naive/large/threads:1"]["triangles"] += 1
        result = run("compare", before, self.write("after", google_benchmark(self.bench)) / "bench.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        slower, faster = result.stdout.split("\nSlower\n")[1].split("\nFaster\n")
        self.assertRegex(slower, r"^ +tiled/large/threads:1 .* ms +1\.500 .*\n$")
        self.assertRegex(faster, r"^ +tiled/small/threads:1 .* ms +0\.500 ")
        self.assertIn(" 1 slower, 1 faster", result.stdout)
        self.assertIn("naive/large/threads:1", result.stdout.split("other triangles")[1])

    def test_bad_input_gets_one_line(self):
        broken = self.file("broken.json", "{")
        self.fails(run("compare", self.results, self.folder / "none"), "none", "No such file")
        self.fails(run("summary", self.folder), "bench.json")
        for text, *words in (("{", "broken.json", "not JSON"), ('{"benchmarks": [{"name": "x"}]}', "Google Benchmark"),
                             ('{"rows": {"tiled/cube/threads:1": {"triangles": 1}}}', "scripts/publish", "'ms'")):
            broken.write_text(text)
            self.fails(run("compare", self.results, broken), *words)
        page = self.file("README.md", f"<!-- results: results/{RESULTS.name} -->\n"
                         + "".join(f"<!-- generated:{name} -->\n<!-- /generated -->\n" for name in ("choice_table", "needs", "portable", "demos", "python", "platforms")))
        for name, text, *words in (("facts/accuracy", '{"methods": []}', "edgewise accuracy", "'scenes'"), ("facts/portable", '[{"scene": "cube"}]', "edgewise portable"),
                                   ("facts/needs", '[{"scene": "cube"}]', "edgewise needs"), ("facts/demos", "", "not JSON"),
                                   (f"{RESULTS.name}/peers", '{"choices": [{}]}', "edgewise accuracy --peers", "'name'"),
                                   (f"{RESULTS.name}/python", "[]", "scripts/python_peers"), ("platforms", "{}", "scripts/test --everywhere")):
            path = self.results.parent / f"{name}.json"
            before = path.read_text() if path.exists() else None
            path.write_text(text)
            self.fails(run("readme", "--file", page), path.name, *words)
            path.unlink() if before is None else path.write_text(before)
        (self.facts / "stability.json").write_text('{"sweeps": [3]}')
        with self.assertRaisesRegex(BadInput, "stability.json: not what 'edgewise stability' writes"):
            read_stability(self.results)

    def test_the_readmes_are_those_of_the_results(self):
        pages = readmes(ROOT / "README.md")
        copied = [self.folder / page.relative_to(ROOT) for page in pages]
        for page, copy in zip(pages, copied):
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(page, copy)
        for path in (ROOT / "results").glob("*/*.json"):
            self.file(self.folder / path.relative_to(ROOT), path.read_text())
        shutil.copy(ROOT / "results/platforms.json", self.results.parent)
        before, first = [page.read_text() for page in copied], self.folder / "README.md"
        check = run("readme", "--check", "--file", first)
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        for page in copied:  # without what is generated
            page.write_text(re.sub(r"(<!-- generated:.*?-->\n).*?(<!-- /generated -->)", r"\1\2", page.read_text(), flags=re.DOTALL))
        self.assertEqual(run("readme", "--check", "--file", first).returncode, 1)
        self.assertEqual(run("readme", "--file", first).returncode, 0)
        self.assertEqual([page.read_text() for page in copied], before)

    def test_what_was_not_measured_is_not_told(self):
        for path in (*self.facts.iterdir(), *self.results.glob("*.json")):
            if path.name not in ("machine.json", "bench.json", "accuracy.json"):
                path.unlink() if path.is_file() else shutil.rmtree(path)
        self.bench["rows"] = {name: row for name, row in self.bench["rows"].items() if name.startswith("naive/")}
        self.write(f"results/{RESULTS.name}", self.bench)
        names = ("speed", "factors", "engine", "choice_table", "portable", "peers", "python", "verification_brief")
        page = self.file("README.md", f"<!-- results: results/{RESULTS.name} -->\n"
                         + "".join(f"<!-- generated:{name} -->\n<!-- /generated -->\n" for name in names))
        self.assertEqual(run("readme", "--file", page).returncode, 0)
        text = page.read_text()
        self.assertEqual(text.count("none of the rows"), 4, text)
        for words in ("`scripts/run --peers` does", "`scripts/run --full --peers` does", "None of this was run"):
            self.assertIn(words, text)

    def test_a_summary_fits_on_a_screen(self):
        def summary(folder, most=25):
            result = support.run(SCRIPTS / "summary", folder.name, directory=folder.parent)
            self.assertEqual(result.returncode, 0, result.stderr)
            lines = result.stdout.splitlines()
            self.assertLessEqual(len(lines), most, result.stdout)
            self.assertLessEqual(max(map(len, lines)), 80, result.stdout)
            self.assertLessEqual(result.stdout.count("\n- "), 5, "five sentences")
            return " ".join(result.stdout.split())

        for whole in ROOT.glob("results/*/verify.json"):
            self.assertRegex(summary(whole.parent), "all are the same.*Fastest whole frames on 2 threads: .*tiled on .*large.*against llvmpipe, [^s ]+ to")
        self.bench["context"] |= {"suite": "quick", "peers": ""}
        for i in range(50):
            self.bench["rows"][f"tiled/scene{i}"] = {"ms": [], "error": "wrong " * 99}
        self.write(f"results/{RESULTS.name}", self.bench)
        for name in (f"{RESULTS.name}/charts/choice.svg", "facts/pictures/cube.png"):
            self.file(f"results/{name}", "")
        verify = self.results / "verify.json"
        verify.write_text(verify.read_text().replace('"differing_pixels":0', '"differing_pixels":3', 1))
        text = summary(self.results, 27)
        for words in ("ERROR in 50 benchmark rows", f"3 pixels differ; see {RESULTS.name}/verify-failures/", f"Chart: {RESULTS.name}/charts/choice.svg",
                      "Pictures: facts/pictures", "scripts/run --full", "scripts/run --peers", "8 subpixel bits): edgewise portable finds them"):
            self.assertIn(words, text)

    def test_plot_draws_the_same_bytes_twice(self):
        [timed] = [path.parents[1] for path in ROOT.glob("results/*/charts/choice.svg")]
        for name, row in read(timed / "bench.json")["rows"].items():
            self.bench["rows"][name] = row
        self.write(f"results/{RESULTS.name}", self.bench)
        plotted(self, self.results)
        plotted(self, self.results, "--out", self.folder / "again")
        drawn = sorted(path.name for path in (self.results / "charts").iterdir())
        self.assertEqual(drawn, sorted(f"{name}.svg" for name in ("area", "choice", "stability-grid", *(f"errors-{family}" for family in (
            "coverage", "visibility", "facing", "clipping", "projection")))))
        for name in drawn:
            self.assertEqual((self.results / "charts" / name).read_bytes(), (self.folder / "again" / name).read_bytes())
            # Texts are paths; matplotlib keeps them as comments.
            [title] = re.findall(r'<g id="title">\s*<!-- (.*?) -->', (self.results / "charts" / name).read_text())
            self.assertLessEqual(len(title.split()), 12, title)


class RowsTest(unittest.TestCase):
    def test_the_usable_cores_of_a_restricted_process_are_named(self):
        machine = {"cpu_model": "X", "cores": 2, "simd_best": "avx2"}
        self.assertTrue(describe_machine(machine).startswith("X, 2 cores, avx2"))
        self.assertEqual(describe_machine({**machine, "usable_cores": 2}), describe_machine(machine))
        self.assertTrue(describe_machine({**machine, "usable_cores": 1}).startswith("X, 1 usable of 2 cores, avx2"))

    def test_peers_join_the_choices_of_the_facts(self):
        wrong = {"wrong_pixels": 10, "least": 1, "most": 4, "holes": 0}
        choice = {"name": "knot", "summary": "", "frames": 4, "methods": [{"name": "tiled_8", **wrong}]}
        peers = {"choices": [{**choice, "methods": [{"name": "llvmpipe", **wrong}]}, {"name": "elsewhere", "methods": []}]}
        [found] = parse_accuracy(with_peers({"methods": [], "scenes": [], "choices": [choice]}, peers)).choices
        self.assertEqual({method: wrong.mean for method, wrong in found.wrong.items()}, {"tiled_8": 2.5, "llvmpipe": 2.5})

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
                ms = 1.0
                for of, level in zip(times.values(), levels):
                    ms *= of[level]
                rows[name].times_ms, rows[name].counters = [ms] * 9, {"overdraw": overdraw, "covered_px": 1e6, "triangles": triangles}
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
    """What the charts compute."""

    def test_the_grid_says_in_how_many_sweeps_ours_hold_and_why_they_fail(self):
        from accuracy_rows import Curve, Method, Sweep
        from plot_stability import finding, told
        methods = [Method(name, source) for name, source in (("ours_8", "src/"), ("ours_15", "src/"), ("a", ""), ("b", ""))]

        def sweep(name, **fails):
            return Sweep(name, "coverage", {}, tuple(Curve(m, ((1.0, 0), (2.0, 0), (3.0, 0)), fails.get(m.name), 10 ** 5) for m in methods), "of 8 bits")

        found = [sweep("far_away", ours_8=1.0, a=1.0), sweep("thin", a=1.0, b=3.0)]
        self.assertEqual(finding("All", found), "All: ours_8 holds in 1/2 sweeps, ours_15 in 2/2")
        lines, rows = told(found)
        self.assertEqual(lines, ["Hold in all: ours_15.", "Fail from the start in all: a.", "Why ours fail in far away: of 8 bits."])
        self.assertEqual([method.name for method in rows], ["ours_8", "b"])

    def test_charts_round_no_place_of_a_sweep(self):
        from plot_stability import tidy
        self.assertEqual([tidy(x) for x in (2.0 ** -10, 1e-3, 2e-5, 0.5, 0.3, 182, 1024, 2897, 50000, 0)],
                         ["2⁻¹⁰", "0.001", "2·10⁻⁵", "0.5", "0.3", "182", "1,024", "2,897", "50k", "0"])

    def test_dense_labels_stand_apart(self):
        from matplotlib.transforms import Bbox
        from plot_labels import area_shared, place
        points = [(200.0 + 6 * (i % 3), 150.0 + 5 * (i // 3)) for i in range(9)] + [(398.0, 1.0)]
        bounds = Bbox.from_extents(0, 0, 400, 300)
        boxes = place(points, [(60.0, 10.0)] * len(points), bounds, [])
        for i, box in enumerate(boxes):
            self.assertAlmostEqual(area_shared(box, bounds), 600.0)
            self.assertEqual(box.count_contains(points), 0)
            self.assertEqual([area_shared(box, other) for other in boxes[:i]], [0.0] * i)


if __name__ == "__main__":
    unittest.main()
