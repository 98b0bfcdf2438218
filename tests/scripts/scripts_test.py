"""The scripts that read results, on a tiny result made here."""
import importlib.util
import json
import re
import sys
import unittest
from itertools import product

import support
from support import ROOT, SCRIPTS, FolderTest

sys.path.insert(0, str(SCRIPTS / "reporting"))
from accuracy_rows import read_stability  # noqa: E402
from program import BadInput  # noqa: E402

MACHINE = {"cpu_model": "Test CPU", "cores": 2, "simd_best": "avx2", "memory_gib": 4, "os": "Test OS",
           "compiler": "GCC 1", "build_type": "Release", "commit": "abc", "caches": {"L2": "1024K", "L3": "32768K"}}
VERIFY = {"backends": ["slow", "tiled"],
          "scenes": [{"configurations": 8, "differing_pixels": 0, "oracle": {"configurations": 2, "differing_pixels": 0}}]}
FAMILIES = ("coverage", "visibility", "facing", "clipping")
COUNTERS = {"triangles": 12.0, "covered_px": 1e6, "overdraw": 0.5, "width": 1920.0, "height": 1080.0}


def entries(name, times_ms, **counters):
    return [{"name": name, "run_name": name, "run_type": "iteration", "real_time": t, "time_unit": "ms",
             **COUNTERS, **counters} for t in times_ms]


def methods():
    """Rows of the laboratory's methods on the scene `knot` of accuracy(): 2 and 1.5 ns per item, `ours` on two threads as well."""
    rows = []
    for family in FAMILIES:
        for method, ns, most_threads in (("ours", 2.0, 2), ("float_le", 1.5, 1)):
            for threads in range(1, most_threads + 1):
                rows += entries(f"lab/knot/family:{family}/method:{method}/simd:scalar/threads:{threads}",
                                [ns / threads * factor * (15e-6 if family == "facing" else 1e-3) for factor in (0.99, 1, 1.01, 1, 1)],
                                triangles=15.0)
    for method, ms in (("tiled_8", 1.0), ("float_lt", 3.0)):
        rows += entries(f"choice/knot/method:{method}/threads:1", [ms * factor for factor in (0.99, 1, 1.01, 1, 1)])
    return rows


def cells():
    """Two scenes; on the first, bands are faster, on the second tiles. Masks were not timed with spans."""
    rows = []
    for scene, bands, tiles, seen in (("cube", 1.0, 2.0, {}), ("large", 3.0, 2.0, {"overdraw": 9.0, "triangles": 1e5})):
        for (traversal, ms), (fill, slower), (simd, scalar), threads in product((("bands", bands), ("tiles", tiles)), (("spans", 1), ("edges", 1.5)),
                                                                                (("avx2", 1), ("scalar", 4)), (1, 2)):
            extras = {"": 1, **({"/with:hiz": 0.5} if (traversal, simd) == ("tiles", "avx2") else {})}
            for extra, factor in {**extras, **({"/with:hiz+masks": 0.6} if len(extras) > 1 and fill == "edges" else {})}.items():
                rows += entries(f"cell/{scene}/traversal:{traversal}/fill:{fill}/simd:{simd}{extra}/threads:{threads}",
                                [ms * slower * scalar * factor / threads * noise for noise in (0.99, 1, 1.01, 1, 1)], **seen)
    return rows


def bench(slow=(10.0, 10.2, 10.1, 10.05, 10.15), tiled=(2.0, 2.1, 2.2, 2.05, 2.15)):
    rows = entries("frontend/cube/threads:1", [0.5])
    for backend, times in (("slow", slow), ("tiled", tiled)):
        for threads in (1, 2):
            rows += entries(f"{backend}/cube/threads:{threads}", [t / threads for t in times])
            for area, factor in ((1, 0.1 if backend == "slow" else 1), (100, 1), (10000, 1)):
                rows += entries(f"{backend}/area:{area}/threads:{threads}", [t * factor for t in times])
        for threads in (1, 2):
            rows += entries(f"{backend}+frontend/cube/threads:{threads}", [t / threads for t in times], peak_bytes=20e6)
        if backend == "tiled":
            rows += entries("naive/cube/threads:1", [9 * t for t in times])
    return {"context": {"backends": "slow tiled", "machine": "test", "rounds": "5", "simd_target": "avx2", "suite": "full"}, "benchmarks": rows + cells() + methods()}


WRONG = {"wrong_pixels": 10, "least": 1, "most": 4, "holes": 0}


def accuracy():
    """Two methods a family, the second inexact, on a scene that bench() times and on one that it does not."""
    def judged(wrong, crossings):
        score = {"errors_per_million": 1e6 * wrong / crossings}
        return score if wrong else {**score, "bound_per_million": 3e6 / crossings}

    def measured(family, method, wrong):
        score = judged(wrong, 1000)
        cracks = {"cracks": {"gaps": wrong, "double_hits": 0, "t_junctions": 0}} if family == "coverage" else {}
        return {"name": method, **cracks, **({"score": score} if family == "clipping" else
                                            {"source": {**score, "wrong_pixels": wrong, "wrong_surface_pixels": 0, "slits": 3}, "snapped": score})}

    return {"quick": False,
            "methods": [{"family": family, "name": name, "source": source, "promise": "as told", "exact": exact}
                        for family in FAMILIES
                        for name, source, exact in (("ours", "src/raster", True), ("float_le", "a book", False))],
            "scenes": [{"name": scene, "family": family, "covered": 1000, "crossings": 1000, "triangles": 15, "kind": "meshes",
                        "methods": [measured(family, "ours", 0), measured(family, "float_le", 5)]}
                       for family in FAMILIES for scene in ("knot", "small")],
            "turning_cube": {"frames": 9, "methods": [{"name": name, **{key: {"total": most} for key in ("gaps", "double_hits", "extra", "missing")}}
                                                      for name, most in (("ours", 0), ("float_le", 8))]},
            "motions": [{"name": "knot", "changes": 100, "methods": [{"name": "ours", "superfluous": 1}]}],
            "choices": [{"name": "knot", "summary": "a mesh", "frames": 4, "float_projection": WRONG,
                         "methods": [{"name": name, **WRONG} for name in ("tiled_8", "float_lt")]}]}


def stability():
    curves = [{"method": name, "source": source, "points": [[1, 0], [0.1, wrong]], "trials": [50_000, 1e5], "starts_to_fail": 0.1 if wrong else None}
              for name, source, wrong in (("ours", "src/raster", 0), ("float_le", "a book", 7))]
    return {"quick": False, "sweeps": [
        {"name": "nearer", "family": "visibility", "summary": "ever nearer", "x": {"name": "gap", "unit": "px", "log": True},
         "y": {"name": "wrong", "log": True, "tolerance": 1.0}, "why": "", "curves": curves}]}


def bench_with_peer():
    """In whole frames, `tiled` is 8 times faster than `ext` on one scene, and 4 times on the other."""
    data = bench()
    data["context"].update(peers="ext", ext="Ext 1.2")
    for threads in (1, 2):
        for backend, ms in (("slow", 12.0), ("tiled", 3.0)):
            data["benchmarks"] += entries(f"{backend}+frontend/knot/threads:{threads}", [ms / threads] * 5)
            data["benchmarks"] += entries(f"{backend}/knot/threads:{threads}", [ms / 2 / threads] * 5)
        data["benchmarks"] += entries(f"ext+frontend/cube/threads:{threads}", [16.8 / threads] * 5, depth_ties=7.0)
        data["benchmarks"] += entries(f"ext+frontend/knot/threads:{threads}", [12.0 / threads] * 5, depth_ties=0.0)
    return data


def portable():
    """Each bit fewer doubles the pixels that may differ."""
    return [{"scene": scene, "subpixel_bits": bits, "pixels": 100_000, "unstable": unstable << 8 - bits,
             "reasons": {"edge": unstable << 8 - bits, "tie": 0, "clip": 0, "depth": 0}}
            for bits in range(4, 9) for scene, unstable in (("cube", 10), ("knot", 1234))]


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
        self.results, self.facts = self.write("results", bench()), self.folder / "facts"

    def write(self, name, benchmark):
        """The folder of such results, which replace others."""
        for file, data in (("bench", benchmark), ("machine", MACHINE), ("verify", VERIFY)):
            self.file(f"{name}/{file}.json", json.dumps(data))
        return self.folder / name

    def add_facts(self, laboratory=None):
        for name, data in (("accuracy", laboratory or accuracy()), ("stability", stability()), ("portable", portable())):
            self.file(f"facts/{name}.json", json.dumps(data))

    def filled(self, *names, results="results"):
        """The README with these blocks, after scripts/readme."""
        readme = self.folder / "README.md"
        readme.write_text(f"<!-- results: {results} -->\n"
                          + "".join(f"<!-- generated:{name} -->\n<!-- /generated -->\n" for name in names))
        result = run("readme", "--file", readme)
        self.assertEqual(result.returncode, 0, result.stderr)
        return readme.read_text()

    def fails(self, result, *words):
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def test_compare_names_what_changed_and_only_that(self):
        after = self.write("after", bench(tiled=(3.0, 3.1, 3.2, 3.05, 3.15), slow=(10.1, 9.9, 10.3, 10.2, 10.0)))
        result = run("compare", self.results, after / "bench.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        slower = result.stdout.split("\nSlower\n")[1]
        self.assertIn("tiled/cube/threads:1 ", slower)
        self.assertRegex(slower, r"2\.100 → +3\.100 ms +1\.476 ")
        self.assertNotIn("slow/", slower)
        self.assertIn(" 0 faster", result.stdout)
        self.assertRegex(result.stdout, r"\nGeometric means of the ratios: [^\n]+, tiled 1\.476, all 1\.\d+\n$")

    def test_compare_sets_other_work_apart(self):
        data = bench()
        for row in data["benchmarks"]:
            if row["name"] == "tiled/cube/threads:1":
                row["triangles"] = 13.0
                row["real_time"] *= 2
        result = run("compare", self.results, self.write("other", data))
        self.assertIn("0 slower", result.stdout)
        self.assertIn("tiled/cube/threads:1", result.stdout.split("other triangles")[1])

    def test_bad_input_gets_one_line(self):
        broken = self.file("broken.json", "{")
        self.fails(run("compare", self.results, self.folder / "none"), "none", "No such file")
        self.fails(run("compare", self.results, broken), "broken.json", "not JSON")
        broken.write_text('{"benchmarks": [{"name": "x"}]}')
        self.fails(run("compare", self.results, broken), "Google Benchmark")
        broken.write_text('{"rows": {"tiled/cube/threads:1": {"triangles": 1}}}')
        self.fails(run("compare", self.results, broken), "scripts/publish", "'ms'")
        self.fails(run("summary", self.folder), "bench.json")

    def test_readme_shows_the_tutorials(self):
        demo = {"name": "turn", "tutorial": "A trainer", "summary": "it turns"}
        file = self.file("facts/demos.json", json.dumps([demo]))
        self.assertIn("**A trainer**, `edgewise demo turn --view`: it turns\n\n![it turns](facts/pictures/demo-turn.png)\n", self.filled("demos"))
        file.unlink()
        self.fails(run("readme", "--file", self.folder / "README.md"), "demos.json", "No such file")

    def test_readme_is_filled_then_up_to_date_then_stale(self):
        readme = self.folder / "README.md"
        readme.write_text("Hand-written.\n<!-- results: results -->\n<!-- generated:speed -->\n<!-- /generated -->\n"
                          "<!-- generated:memory -->\nold\n<!-- /generated -->\n")
        self.assertEqual(run("readme", "--check", "--file", readme).returncode, 1)
        self.assertEqual(run("readme", "--file", readme).returncode, 0)
        text = readme.read_text()
        self.assertIn("| cube | 12 | 0.50 | 5.05 | **1.05** |", text)
        self.assertIn("Hand-written.", text)
        self.assertIn("The first frame takes", text)
        self.assertNotIn("old", text)
        self.assertEqual(run("readme", "--check", "--file", readme).returncode, 0)
        readme.write_text(text.replace("5.05", "5.00"))
        self.assertEqual(run("readme", "--check", "--file", readme).returncode, 1)

    def test_each_machine_has_a_line_with_its_peers(self):
        self.write("results/mine", bench_with_peer())
        self.write("results/other", bench())
        (self.results / "empty").mkdir()
        text = self.filled("machines", results="results/mine")
        self.assertIn("- [`mine`](results/mine): Test CPU, 2 cores, avx2, 4 GiB; Test OS; GCC 1, Release; commit abc. Against ext, `tiled` is 4.0× to 8.0× "
                      "faster in 2 of 2 scenes.\n", text)
        self.assertIn("- [`other`](results/other): Test CPU, 2 cores, avx2, 4 GiB; Test OS; GCC 1, Release; commit abc.\n", text)
        self.assertNotIn("empty", text)

    def test_peers_get_ratios_where_they_were_timed(self):
        text = self.filled("peers")
        self.assertIn("scripts/run --peers", text)
        self.assertNotIn("ext", text)
        self.write("results", bench_with_peer())
        text = self.filled("peers")
        self.assertIn("- Against ext (Ext 1.2), whole frames by `tiled` are, with AVX2, 256 bits, 4.0× to 8.0× faster in 2 of 2 scenes on 1 thread; 4.0× to 8.0× faster in 2 "
                      "of 2 scenes on 2 threads. Pictures differ in at most 7 pixels, all depth ties within tolerance.", text)
        self.assertIn("with AVX2, 256 bits, 4.0×", run("summary", "--tables", self.results).stdout)
        coarse = bench_with_peer()
        for entry in coarse["benchmarks"]:
            if "depth_ties" in entry:
                entry["wrong_px"] = 9 * entry.pop("depth_ties")
        self.write("results", coarse)
        self.assertIn("Pictures differ in at most 63 pixels, all not portable.", self.filled("peers"))

    def test_laboratory_fills_the_readme(self):
        self.add_facts()
        self.assertIn("| `float_le` | 10 | 0 | 6 | – | – | – |", self.filled("seen"))

    def test_a_summary_fits_on_a_screen(self):
        def summary(folder):
            result = support.run(SCRIPTS / "summary", folder.name, directory=folder.parent)
            self.assertEqual(result.returncode, 0, result.stderr)
            lines = result.stdout.splitlines()
            self.assertLessEqual(len(lines), 25, result.stdout)
            self.assertLessEqual(max(map(len, lines)), 80, result.stdout)
            self.assertLessEqual(result.stdout.count("\n- "), 5, "five sentences")
            return " ".join(result.stdout.split())

        self.add_facts()
        text = summary(self.results)
        for words in ("8 frames of 1 scenes, and 2 small ones with an oracle, all are the same.", "Fastest whole frames on 2 threads: tiled on cube.",
                      "Speed-ups of the median frame: AVX2 4.0×, depending on the method, and a second thread 2.0×.",
                      "In 9 frames of a turning cube, float_le draws 8 pixels twice.",
                      "may differ in up to 1.2 % of a picture's pixels (knot, 8 subpixel bits)", "scripts/run --peers"):
            self.assertIn(words, text)
        self.assertNotIn("scripts/run --full", text)
        data = bench_with_peer()
        data["context"]["suite"] = "quick"
        for i in range(50):
            data["benchmarks"].append({"name": f"tiled/scene{i}", "error_occurred": True, "error_message": "wrong " * 99})
        crowded = self.write("crowded", data)
        for name in ("crowded/charts/choice.svg", "facts/pictures/cube.png"):
            self.file(name, "")
        wrong = json.loads(json.dumps(VERIFY).replace('"differing_pixels": 0', '"differing_pixels": 3'))
        (crowded / "verify.json").write_text(json.dumps(wrong))
        text = summary(crowded)
        for words in ("ERROR in 50 benchmark rows", "6 pixels differ; see crowded/verify-failures/", "tiled on cube and knot.",
                      "tiled against ext, 4.0× to 8.0× faster in 2 of 2 scenes.", "Chart: crowded/charts/choice.svg", "Pictures: facts/pictures", "scripts/run --full"):
            self.assertIn(words, text)
        for whole in ROOT.glob("results/*/verify.json"):
            self.assertRegex(summary(whole.parent), r"against llvmpipe, \S+ to")

    def test_malformed_laboratory_gets_one_line(self):
        data = accuracy()
        del data["scenes"][0]["methods"][1]["source"]
        self.add_facts(data)
        self.fails(run("summary", self.results), "accuracy.json", "edgewise accuracy", "'source'")
        self.add_facts()
        (self.results / "peers.json").write_text('{"choices": [{}]}')
        self.fails(run("summary", self.results), "peers.json", "edgewise accuracy --peers", "'name'")
        (self.results / "peers.json").unlink()
        readme = self.folder / "README.md"
        (self.facts / "portable.json").write_text('[{"scene": "cube"}]')
        readme.write_text("<!-- results: results -->\n<!-- generated:portable -->\n<!-- /generated -->\n")
        self.fails(run("readme", "--file", readme), "portable.json", "edgewise portable")
        (self.facts / "stability.json").write_text('{"sweeps": [3]}')
        with self.assertRaisesRegex(BadInput, "stability.json: not what 'edgewise stability' writes"):
            read_stability(self.results)

    def test_readme_tells_which_pixels_are_portable(self):
        self.assertIn("none of the rows", self.filled("portable"))
        self.add_facts()
        self.assertIn("| knot | 1.2 | 4.9 | 20 |\n", self.filled("portable"))

    def test_factors_are_told_of_pairs_that_differ_in_nothing_else(self):
        text = self.filled("factors")
        for line in ("| factor | AVX2 | settled faster / slower | scalar |\n",
                     "| tiles over bands, with edges | 1.00× (0.50 to 1.5) | 1 / 1 of 2 | 1.00× (0.50 to 1.5) |",
                     "| edges over spans, in tiles | 0.67× (0.67 to 0.67) | 0 / 2 of 2 | 0.67× (", "| edges over spans, in bands | 0.67× (",
                     "| SIMD over scalar, spans in bands | 4.0× (4.0 to 4.0) | 2 / 0 of 2 | – |",
                     *(f"| HiZ, {where} | 2.0× (2.0 to 2.0) | 2 / 0 of 2 | – |" for where in ("overdraw ≥4", "elsewhere")),
                     *(f"| masks, with HiZ, {where} | 0.83× (0.83 to 0.83) | 0 / 1 of 1 |" for where in ("triangles ≤10 px", "elsewhere")),
                     "| 2 threads over 1, no HiZ or masks | 2.0× (2.0 to 2.0) | 8 / 0 of 8 | 2.0× (", "](results/charts/factors.svg)"):
            self.assertIn(line, text)
        self.write("old", {**bench(), "benchmarks": entries("tiled/cube/threads:1", [1.0])})
        self.assertIn("<!-- generated:factors -->\n<!-- /generated -->", self.filled("factors", results="old"))

    def test_memory_fills_the_readme(self):
        text = self.filled("memory")
        self.assertIn("The first frame takes 9.6 bytes per pixel plus 0 per triangle, at most 60% of what", text)
        self.write("few", {**bench(), "benchmarks": entries("tiled/cube/threads:1", [1.0])})
        self.assertIn("Memory was not measured", self.filled("memory", results="few"))

    def test_plot_draws_the_same_bytes_twice(self):
        self.add_facts()
        plotted(self, self.results)
        plotted(self, self.results, "--out", self.folder / "again")
        drawn = sorted(p.name for p in (self.results / "charts").iterdir())
        charts = ["area", "choice", "factors", "stability-grid", *(f"errors-{family}" for family in FAMILIES)]
        self.assertEqual(drawn, sorted(f"{c}.svg" for c in charts))
        for name in drawn:
            self.assertEqual((self.results / "charts" / name).read_bytes(), (self.folder / "again" / name).read_bytes())
        # Texts are paths; matplotlib keeps them as comments.
        for chart in (*(self.results / "charts").iterdir(), *ROOT.glob("results/*/charts/*.svg")):
            [title] = re.findall(r'<g id="title">\s*<!-- (.*?) -->', chart.read_text())
            self.assertLessEqual(len(title.split()), 12, title)


class MachineTest(unittest.TestCase):
    """bench_rows.describe_machine(): the cores, and those that the program could use."""

    def test_names_the_usable_cores_of_a_restricted_process(self):
        from bench_rows import describe_machine
        self.assertTrue(describe_machine(MACHINE).startswith("Test CPU, 2 cores, avx2"))
        self.assertEqual(describe_machine({**MACHINE, "usable_cores": 2}), describe_machine(MACHINE))
        self.assertTrue(describe_machine({**MACHINE, "usable_cores": 1}).startswith("Test CPU, 1 usable of 2 cores, avx2"))


class PeersTest(unittest.TestCase):
    def test_peers_join_the_choices_of_the_facts(self):
        from accuracy_rows import parse_accuracy, with_peers

        peers = {"choices": [{**accuracy()["choices"][0], "methods": [{"name": "llvmpipe", **WRONG}]}, {"name": "elsewhere", "methods": []}]}
        [found] = parse_accuracy(with_peers(accuracy(), peers)).choices
        self.assertEqual({method: wrong.mean for method, wrong in found.wrong.items()}, {"tiled_8": 2.5, "float_lt": 2.5, "llvmpipe": 2.5})


@unittest.skipIf(importlib.util.find_spec("matplotlib") is None, "no matplotlib")
class ChartsTest(unittest.TestCase):
    """What the charts compute."""

    @staticmethod
    def row(*times_ms, **keys):
        from bench_rows import Row
        return Row("", "", False, "", keys, list(times_ms))

    def test_the_chart_of_factors_tells_where_bands_and_tiles_win(self):
        from factors import Duel
        from plot_factors import title

        def duel(overdraw, bands, tiles):
            return Duel("s", 9.0, overdraw, *({"spans": self.row(*[ms * noise for noise in (0.99, 1, 1.01, 1, 1)])} for ms in (bands, tiles)), None)

        bands, tiles, even = (1.0, 2.0), (2.0, 1.0), (1.0, 1.0)
        self.assertEqual([duel(1, *side).order for side in (bands, tiles, even)], [-1, 1, 0])
        self.assertEqual([duel(1, *side).winner for side in (bands, tiles)], [("bands", "spans"), ("tiles", "spans")])
        found = [duel(*one) for one in ((0.9, *bands), (0.5, *even), (1.0, *tiles), (5.0, *bands))]
        self.assertEqual(title(found, "C"), "C: bands won/lost/open by overdraw: <1 1/0/1, 1–4 0/1/0, ≥4 1/0/0")
        self.assertEqual(title(found[:1], "C"), "C: bands won/lost/open by overdraw: <1 1/0/0")

    def test_tiles_that_win_by_hiz_and_masks_alone_are_told_apart(self):
        from bench_rows import Bench, parse_name
        from factors import duels

        def duel(shipped_ms, simd):
            times = {"tiled+frontend/s/threads:2": shipped_ms, **{f"cell/s/traversal:{keys}/simd:{code}/threads:2": ms for code in ("avx2", "scalar")
                                                                   for keys, ms in (("bands/fill:edges", 2), ("tiles/fill:spans", 3))}}
            rows = {name: parse_name(name) for name in times}
            for name, row in rows.items():
                row.times_ms, row.counters = [float(times[name])] * 5, {"covered_px": 20.0, "triangles": 4.0, "overdraw": 2.0}
            [found] = duels(Bench({}, rows), simd)
            return found

        self.assertEqual([(found.winner, found.order, found.triangle_px, found.only_shipped) for found in (duel(1, True), duel(4, True), duel(1, False))],
                         [(("bands", "edges"), -1, 5.0, only) for only in (True, False, False)])

    def test_a_chart_of_errors_begins_with_the_pooled_rates(self):
        from accuracy_rows import parse_accuracy
        from plot_accuracy import chart_rows
        self.assertEqual([row[:2] for row in chart_rows(parse_accuracy(accuracy()), "facing")],
                         [(label, {"ours": "0", "float_le": "5k"}) for label in ("pooled", "knot", "small")])

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
        from plot_labels import Box, place
        points = [(200.0 + 6 * (i % 3), 150.0 + 5 * (i // 3)) for i in range(9)] + [(398.0, 1.0)]
        bounds = Box(0, 0, 400, 300)
        boxes = [box for box, _ in place(points, [(60.0, 10.0)] * len(points), bounds, [])]
        for i, box in enumerate(boxes):
            self.assertAlmostEqual(box.overlap(bounds), 600.0)
            self.assertFalse([p for p in points if box.holds(*p)])
            self.assertEqual([box.overlap(other) for other in boxes[:i]], [0.0] * i)


if __name__ == "__main__":
    unittest.main()
