"""answers.py, and the modules whose figures it needs: each figure, its condition, and whether it is settled; and what scenes need:
from data made here."""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/reporting"))
from accuracy_rows import Accuracy, Cost, Cracks, Measured, Method, Pooled, Scene, parse_accuracy, read_accuracy  # noqa: E402
from answers import answers  # noqa: E402
from bench_rows import Bench, Row, parse_name  # noqa: E402
from bench_tables import engine_table, peer_tables  # noqa: E402
from facts_tables import needs_table, read_needs, tutorials_table  # noqa: E402
from frontier import ENGINES, INSIDE_TESTS, cracks_of, simd_outcome, speed_ups  # noqa: E402
from program import BadInput  # noqa: E402
from tables import markdown  # noqa: E402

NOISE = (0.99, 1.0, 1.01, 0.995, 1.005)


def bench(times_ms, **context):
    """From {row's name: milliseconds, or the repetitions' milliseconds}."""
    rows = {name: parse_name(name) for name in times_ms}
    for name, row in rows.items():
        ms = times_ms[name]
        row.times_ms = list(ms) if isinstance(ms, tuple) else [ms * noise for noise in NOISE]
    return Bench({"backends": "scanline naive tiled", "simd_target": "avx512", **context}, rows)


def scene(name, scanline, naive, tiled):
    return {f"{backend}+frontend/{name}/threads:2": ms
            for backend, ms in (("scanline", scanline), ("naive", naive), ("tiled", tiled))}


def measured(name, exact, rate):
    return Measured(Method(name, "src/raster" if name == "tiled" else "a book", "", exact), rate, None, rate)


def accuracy(*methods, cube=None):
    return Accuracy({"coverage": [m.method for m in methods]}, (Scene("mesh_on_grid", "coverage", "", 1000, methods),), cube)


def turning(*counts):
    """From (name, gaps, double hits)."""
    return {"frames": 3600, "methods": [
        (measured(name, False, 0).method, {"total_gaps": gaps, "total_double_hits": doubles}) for name, gaps, doubles in counts]}


class AnswersTest(unittest.TestCase):
    def test_the_engine_is_compared_with_its_exact_numbers(self):
        self.assertEqual(engine_table(bench({})), (["numbers"], []))
        timed = bench({"tiled/large/threads:1": 9.0, "tiled/large/engine:exact/threads:1": 10.0, "tiled/large/engine:float/threads:1": 8.0,
                       "tiled/large/engine:int64/threads:1": 10.01, "tiled/large/engine:of_old_results/threads:1": 1.0,
                       "tiled/small/engine:float/threads:1": 1.0})  # without the base: left out
        timed.rows["tiled/large/engine:float/threads:1"].counters["wrong_px"] = 1234.0
        header, lines = engine_table(timed)
        self.assertEqual(header, ["numbers", "`large`"])
        self.assertEqual(lines, [["exact, the base", "10.0 ms"],
                                 ["`tiled` with coverage masks", "**1.11×** (1.09 to 1.13)"],
                                 ["64-bit integers", "1.00× (0.98 to 1.01)"],
                                 ["floats", "**1.25×** (1.23 to 1.27); 1,230 px"]])

    def test_methods_have_the_times_of_their_rows(self):
        score = {"errors_per_million": 0.0}
        data = {"methods": [{"family": "coverage", "name": name, "source": "", "promise": "", "exact": True} for name in ("m", "naive", "untimed")],
                "scenes": [{"name": "s", "family": "coverage", "summary": "", "covered": 500, "triangles": 20, "crossings": 9,
                            "methods": [{"name": name, "float": score, "snapped": score} for name in ("m", "naive", "untimed")]}]}
        rows = {"lab/s/family:coverage/method:m/simd:scalar/threads:1": 4.0, "lab/s/family:coverage/method:m/simd:scalar/threads:2": 3.0,
                "lab/s/family:coverage/method:m/simd:avx512/threads:1": 2.0, "lab/s/family:coverage/method:m/simd:avx512/threads:2": 1.0,
                "lab/s/family:coverage/method:naive/simd:scalar/threads:1": 4.0, "lab/t/family:coverage/method:naive/simd:scalar/threads:2": 1.0,
                "lab/s/family:coverage/method:untimed/simd:scalar/threads:1": 1.0}
        timed = bench(rows)
        for name, row in timed.rows.items():
            row.counters["triangles"] = 20.0 if "untimed" not in name else 19.0  # a smaller scene of the same name
        self.assertEqual(timed.scenes, [])
        both, naive, untimed = parse_accuracy(data, timed).scenes[0].measured
        self.assertEqual({threads: cost.ns for threads, cost in both.costs.items()}, {1: 4000.0, 2: 2000.0}, "the SIMD form")
        self.assertEqual((both.scalar.ns, both.simd.ns, both.simd.interval, both.simd.mtri), (8000.0, 4000.0, (3960.0, 4040.0), 0.01))
        self.assertEqual((naive.costs[1].ns, naive.scalar.ns, naive.simd), (8000.0, 8000.0, None))
        self.assertEqual((untimed.costs, untimed.scalar), ({}, None))

    def test_who_wins_how_often_and_by_how_much(self):
        of_speed = answers(bench({**scene("a", 2.0, 8.0, 1.0), **scene("b", 3.0, 4.0, 2.0), **scene("c", 1.0, 5.0, 4.0)}), None)
        self.assertEqual(of_speed, [
            ["Parallel or scanline?", "`tiled` 1.5× to 2.0× faster in 2, 4.0× slower in 1 of 3 scenes",
             "against `scanline`; whole frames, 2 threads, AVX-512"],
            ["Or test the whole bounding box?", "`naive` 2.0× to 8.0× slower in 3 of 3 scenes",
             "against the faster of the two; whole frames, 2 threads, AVX-512, but `naive` in scalar code"]])

    def test_a_faster_median_alone_wins_nothing(self):
        close = {**scene("a", (2.0, 1.0, 3.0, 2.1, 2.2), 8.0, (1.9, 1.1, 3.1, 2.0, 1.8)), **scene("b", 2.0, 8.0, 1.0)}
        self.assertEqual(answers(bench(close), None)[0][1], "`tiled` 2.0× faster in 1, not settled in 1 of 2 scenes")

    def test_a_scene_that_is_too_slow_for_naive_counts_for_the_others(self):
        rows = {**scene("a", 2.0, 8.0, 1.0), **scene("b", 4.0, 8.0, 2.0), "tiled/c/threads:2": 1.0}
        del rows["naive+frontend/b/threads:2"]
        self.assertEqual([line[1] for line in answers(bench(rows), None)],
                         ["`tiled` 2.0× faster in 2 of 2 scenes", "`naive` 8.0× slower in 1 of 1 scene"])

    def test_exactness_and_gaps_have_their_counts(self):
        told = answers(bench({}), accuracy(measured("tiled", True, 873), measured("float_lt", False, 216),
                                           cube=turning(("tiled", 0, 0), ("float_lt", 3, 0), ("float_le", 1, 9), ("fixed_8", 7, 7))))
        self.assertEqual(told, [
            ["What does exactness cost in wrong pixels?", "ours 873, `float_lt` 216 wrong per 10⁶ edge crossings", "against the positions before snapping, 1 scenes pooled"],
            ["Gaps / double hits when the cube turns?", "`float_lt` 3 / 0, `float_le` 1 / 9, ours 0 / 0",
             "3,600 frames of the tutorials' cube; `float_le` takes samples on an edge as inside, `float_lt` does not"],
            ["Where edges meet pixel centres?", "`float_lt` 216, ours 873 wrong pixels per 10⁶ edge crossings",
             "`mesh_on_grid`, whose vertices lie on the 1/256 px grid"]])

    def test_a_scene_that_has_over_half_of_the_errors_is_named(self):
        ours, plain = measured("tiled", True, 800), measured("float_lt", False, 6000)
        scenes = (Scene("mesh_on_grid", "coverage", "", 1000, (measured("tiled", True, 0), plain)),
                  Scene("grid4", "coverage", "", 3000, (ours, measured("float_lt", False, 2))))
        told = answers(bench({}), Accuracy({"coverage": [ours.method, plain.method]}, scenes, None))
        self.assertEqual(told[0][1], "ours 600, `float_lt` 1,500 wrong per 10⁶ edge crossings; without `mesh_on_grid`, which has over "
                                     "half of `float_lt`'s, 800 and 2")

    def test_rates_are_pooled_over_large_scenes_within_a_methods_range(self):
        limited = Method("y", "a book", "", False, 181)

        def scene_of(name, trials, side_px, *rates):
            methods = (Method("x", "a book", "", False), limited)
            return Scene(name, "coverage", "", trials, tuple(Measured(method, rate, None, rate) for method, rate in
                                                             zip(methods, rates)), largest_side_px=side_px)

        scenes = (scene_of("large", 30000, 500.0, 10.0, 9e6), scene_of("medium", 10000, 100.0, 50.0, 4.0),
                  scene_of("tiny", 100, 1.0, 1e6, 1e6))
        told = Accuracy({"coverage": [m.method for m in scenes[0].measured]}, scenes, None)
        self.assertEqual(told.rates("coverage"), {"x": Pooled(20.0, "medium", 10.0), "y": Pooled(4.0)})
        self.assertEqual(told.rates("coverage", without="medium"), {"x": Pooled(10.0)})

    def test_peers_are_compared_with_one_backend_at_both_widths(self):
        rows = {**scene("a", 2.0, 8.0, 1.0), **scene("b", 1.0, 5.0, 4.0), "ext+frontend/a/threads:2": 8.0, "ext+frontend/b/threads:2": 30.0,
                "tiled+frontend/m/threads:2": 3.0, "ext+frontend/m/threads:2": 1.5}
        told = bench(rows, peers="ext", ext="Ext 1, 256 bits")
        self.assertEqual(answers(told, None)[2:], [["Against ext, ours with AVX-512?", "`tiled` 7.5× to 8.0× faster in 2, 2.0× slower in 1 of 3 scenes",
                                                    "ext is Ext 1, 256 bits; whole frames, 2 threads"]])
        narrow = bench({**rows, "tiled+frontend/a/target:avx2/threads:2": 2.0, "m/threads:2": 1.0}, peers="ext", ext="Ext 1, 256 bits")
        self.assertEqual(answers(narrow, None)[3][:2], ["Against ext, ours with AVX2?", "`tiled` 4.0× faster in 1 of 1 scene"])
        table = peer_tables(narrow, markdown)
        self.assertIn("| speed-up with AVX-512, 512 bits | speed-up with AVX2, 256 bits |", table)
        self.assertIn("| – / 8.0× | – / 4.0× |", table)

    def test_the_methods_that_answers_name_are_measured(self):
        results = Path(__file__).resolve().parents[2] / "results"
        named = re.search("<!-- results: results/(.*) -->", (results.parent / "README.md").read_text())[1]
        names = {m.method.name for scene in read_accuracy(results / named, None).of("coverage") for m in (*scene.measured, *scene.apart)}
        self.assertEqual({*ENGINES, *INSIDE_TESTS} - names, set())

    def test_what_was_not_measured_is_not_answered(self):
        self.assertEqual(answers(bench({}), Accuracy({}, (), None)), [])


class FrontierTest(unittest.TestCase):
    """frontier.py: cracks and speed of methods."""

    ROUNDS = (0.98, 1.0, 1.01, 0.99, 1.02, 1.0, 1.0, 0.995, 1.005)

    def timed(self, name, ns, cracks=0, most_px=4096):
        def cost(factor):
            return Cost(Row("", "", False, "", {}, [factor * ns * noise for noise in self.ROUNDS]), 10 ** 6, 1)

        return Measured(Method(name, "src/raster" if name == "tiled" else "a book", "", True, most_px), 0, None, 0, Cracks(cracks, 0, 7, 2),
                        {("avx512", 1): cost(1), ("scalar", 1): cost(4)})

    def accuracy(self, **scenes):
        """From the methods of each scene; every scene has 10⁵ crossings of shared edges and triangles of 200 px."""
        made = tuple(Scene(name, "coverage", "", 10 ** 6, methods, (), 10 ** 5, 200.0) for name, methods in scenes.items())
        return Accuracy({"coverage": [m.method for m in made[0].measured]}, made, None)

    def test_cracks_are_pooled_without_overflow_and_without_the_scene_that_has_most(self):
        found = self.accuracy(a=(self.timed("x", 1.0, 3), self.timed("y", 1.0, 9, 181)), b=(self.timed("x", 1.0, 1),))
        rates = cracks_of(found, found.methods["coverage"][0])
        self.assertEqual((rates.pooled, rates.worst, rates.worst_scene, rates.crossings, rates.t_junctions, rates.folds),
                         (Pooled(20.0, "a", 10.0), 30.0, "a", 2 * 10 ** 5, 14, 4))
        self.assertIsNone(cracks_of(found, found.methods["coverage"][1]))

    def test_speed_is_the_geometric_mean_of_scenes_and_outcomes_are_by_scene(self):
        found = self.accuracy(a=(self.timed("tiled", 1.0), self.timed("x", 4.0)), b=(self.timed("tiled", 2.0), self.timed("x", 1.0)),
                              c=(self.timed("tiled", 1.0), self.timed("x", 1.0)))
        ups, base, scenes = speed_ups(found)
        self.assertEqual((base.name, scenes), ("x", 3))
        tiled = ups[found.methods["coverage"][0]]
        self.assertAlmostEqual(tiled["scalar"].middle, 2 ** (1 / 3))
        self.assertAlmostEqual(tiled["simd"].middle, 4 * 2 ** (1 / 3))
        self.assertEqual(simd_outcome(found, "tiled", "x"), {-1: [4.0], 1: [0.5], 0: [1.0]})


def question(name, *answers, cheapest):
    """Answers before the cheapest are not enough."""
    at = answers.index(cheapest)
    return {"question": name, "answer": cheapest, "proven": False, "error": "wrong pixel", "answers": [
        {"answer": a, "enough": i >= at, **({} if i >= at else {"witness": {"wrong_px": 1 + i, "frame": 7}})}
        for i, a in enumerate(answers)]}


def entry(scene, near="nothing", facing="normal_z", visibility="submission_order"):
    return {"scene": scene, "frames": 3,
            "questions": [
                question("near plane", "nothing", "drop whole triangles", "clip", cheapest=near),
                question("far plane", "nothing", "clip", cheapest="nothing"),
                question("guard band", "nothing", "clip", cheapest="nothing"),
                question("facing test", "normal_z", "normal_dot_eye", "snapped_area", cheapest=facing),
                question("visibility", "submission_order", "painter_mean", "depth buffer", cheapest=visibility),
                question("depth buffer", "1 bit", "2 bits", cheapest="2 bits"),
                question("subpixel bits without a crack", "0 bits", "1 bit", cheapest="1 bit"),
                question("subpixel bits, no worse than 8 bits", "8 bits", cheapest="8 bits"),
                question("edge values at 8 subpixel bits", "32-bit integers", cheapest="32-bit integers"),
                question("float edges without a crack", "float_lt", "float_le", cheapest="float_le")]}


class NeedsTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "facts").mkdir()

    def read(self, *entries):
        (self.folder / "facts/needs.json").write_text(json.dumps(entries))
        return read_needs(self.folder / "mine")

    def test_nothing_is_said_of_nothing(self):
        self.assertEqual(read_needs(self.folder), {})
        self.assertEqual(tutorials_table({})[1], [])

    def test_what_is_not_a_result_is_refused(self):
        for text in ('[{"scene": "cube"}]', '[3]', '{"scene": 1}'):
            (self.folder / "facts/needs.json").write_text(text)
            with self.assertRaises(BadInput):
                read_needs(self.folder / "mine")

    def test_each_stage_has_its_cheapest_answers(self):
        stream = {**entry("grid"), "questions": [question("visibility", "submission_order", cheapest="submission_order")]}
        header, lines = needs_table(self.read(entry("cube"), entry("terrain", near="clip", visibility="depth buffer"), stream))
        self.assertIn("all other stages exact", header[1])
        cube = "cube (3 frames)"
        both = f"{cube}, terrain (3 frames)"
        self.assertEqual(dict(lines), {
            "clipping": f"nothing: {cube}; clip at the near plane: terrain (3 frames)", "facing test": f"`normal_z`: {both}",
            "visibility": f"`submission_order`: {cube}, grid (3 frames); depth buffer: terrain (3 frames)", "depth": f"2 bits: {both}",
            "no crack": f"1 bit: {both}", "no worse than 8 bits": f"8 bits: {both}", "edge values": f"32-bit integers: {both}"})

    def test_no_line_holds_answers_of_two_stages(self):
        """Read as a pipeline, `normal_z` and `submission_order` draw the cube wrong, although each alone is enough."""
        for line in needs_table(self.read(entry("cube")))[1]:
            self.assertLess(sum(answer in " ".join(line) for answer in ("normal_z", "submission_order")), 2)

    def test_tutorials_have_more_than_needed_or_less(self):
        _, lines = tutorials_table(self.read(entry("cube"), entry("cubes", near="clip", facing="normal_dot_eye",
                                                                 visibility="depth buffer")))
        said = {(engine, stage): verdicts for engine, stage, _, *verdicts in lines}
        self.assertEqual(said["p5.js engine", "near plane"], ["more than needed: nothing", "enough"])
        self.assertEqual(said["p5.js engine", "visibility"],
                         ["more than needed: `submission_order`", "**not enough**: 2 wrong pixels in frame 7"])
        self.assertEqual(said["Outlaw Triad trainer", "facing test"], ["enough", "**not enough**: 1 wrong pixel in frame 7"])
        self.assertEqual(said["Outlaw Triad trainer", "near plane"], ["enough", "**not enough**: 1 wrong pixel in frame 7"])

    def test_an_answer_that_no_longer_exists_is_refused(self):
        found = self.read(entry("cube"))
        found["cube"][1]["visibility"]["answers"].clear()
        with self.assertRaises(BadInput):
            tutorials_table(found)


if __name__ == "__main__":
    unittest.main()
