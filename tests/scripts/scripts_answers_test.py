"""answers.py, and the modules whose figures it needs: each figure, its condition, and whether it is settled, from data made here."""
import re
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/reporting"))
from accuracy_rows import Accuracy, Cost, Curve, Measured, Method, Scene, Sweep, parse_measured, read_accuracy  # noqa: E402
from answers import answers  # noqa: E402
from bench_rows import Bench, parse_name  # noqa: E402
from engine import engine_table  # noqa: E402
from frontier import ENGINES, INSIDE_TESTS, cracks_of, simd_outcome, speed_ups  # noqa: E402
from peers import peer_tables  # noqa: E402
from stability_curves import groups_of, origin_sentence, summary  # noqa: E402
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


def measured(name, exact, rate, ns, spread=0.0):
    ours = name == "tiled"
    return Measured(Method(name, "src/raster" if ours else "a book", "", exact), rate, None, rate,
                    {1: Cost(ns, ns - spread, ns + spread, 1.0, 11)}, 0)


def accuracy(*methods, cube=None, more=()):
    scenes = (Scene("mesh_on_grid", "coverage", "", 1000, methods), *more)
    registry = {"coverage": [m.method for m in methods]}
    return Accuracy({"simd_best": "avx512"}, registry, scenes, cube)


def turning(*counts):
    """From (name, gaps, double hits)."""
    return {"frames": 3600, "methods": [
        (measured(name, False, 0, 1.0).method, {"total_gaps": gaps, "total_double_hits": doubles}) for name, gaps, doubles in counts]}


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

    def test_charts_show_the_simd_form_where_there_is_one(self):
        def timed(simd, threads, ms):
            return {**({"simd": simd, "rounds_ms": [1.5 * ms, ms, 0.5 * ms]} if simd else {}), "threads": threads,
                    "ns_per_covered_pixel": 10.0 * ms, "mtri_per_s": 1.0, "ms": {"median": ms, "min": ms, "max": ms, "repetitions": 3}}

        def read(source, *speed):
            score = {"errors_per_million": 0.0, "gaps": 0, "double_hits": 0}
            return parse_measured({"float": score, "snapped": score, "speed": list(speed)}, "coverage",
                                  Method("m", source, "", True))

        forms = timed("scalar", 1, 4.0), timed("scalar", 2, 3.0), timed("avx512", 1, 2.0), timed("avx512", 2, 1.0)
        ours, other = read("src/raster", *forms), read("a book", *forms)
        self.assertEqual({threads: cost.ns for threads, cost in ours.costs.items()}, {1: 20.0, 2: 10.0})
        self.assertEqual({threads: cost.ns for threads, cost in other.costs.items()}, {1: 20.0, 2: 10.0})
        self.assertEqual((ours.scalar.ns, ours.simd.ns, ours.simd.rounds), (40.0, 20.0, (30.0, 20.0, 10.0)))

        naive, old = read("src/raster", timed("scalar", 1, 4.0)), read("src/raster", timed(None, 1, 4.0))
        self.assertEqual((naive.costs[1].ns, naive.scalar.ns, naive.simd), (40.0, 40.0, None))
        self.assertEqual((old.costs[1].ns, old.scalar, old.simd, old.costs[1].rounds), (40.0, None, None, ()))

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
        told = answers(bench({}), accuracy(measured("tiled", True, 873, 3.0), measured("float_lt", False, 216, 2.0),
                                           cube=turning(("tiled", 0, 0), ("float_lt", 3, 0), ("float_le", 1, 9), ("fixed_8", 7, 7))))
        self.assertEqual(told, [
            ["What does exactness cost in wrong pixels?", "ours 873, `float_lt` 216 wrong per 10⁶ edge crossings", "against the positions before snapping, 1 scenes pooled"],
            ["Gaps / double hits when the cube turns?", "`float_lt` 3 / 0, `float_le` 1 / 9, ours 0 / 0",
             "3,600 frames of the tutorials' cube; `float_le` takes samples on an edge as inside, `float_lt` does not"],
            ["Where edges meet pixel centres?", "`float_lt` 216, ours 873 wrong pixels per 10⁶ edge crossings",
             "`mesh_on_grid`, whose vertices lie on the 1/256 px grid"]])

    def test_rates_are_pooled_over_large_scenes_within_a_methods_range(self):
        limited = Method("y", "a book", "", False, 181)

        def scene_of(name, trials, side_px, *rates):
            methods = (Method("x", "a book", "", False), limited)
            return Scene(name, "coverage", "", trials, tuple(Measured(method, rate, None, rate, {}) for method, rate in
                                                             zip(methods, rates)), largest_side_px=side_px)

        scenes = (scene_of("large", 30000, 500.0, 10.0, 9e6), scene_of("medium", 10000, 100.0, 50.0, 4.0),
                  scene_of("tiny", 100, 1.0, 1e6, 1e6))
        told = Accuracy({}, {"coverage": [m.method for m in scenes[0].measured]}, scenes, None)
        self.assertEqual(told.rates("coverage"), {"x": 20.0, "y": 4.0})

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
        names = {m.method.name for scene in read_accuracy(results / named).of("coverage") for m in (*scene.measured, *scene.apart)}
        self.assertEqual({*ENGINES, *INSIDE_TESTS} - names, set())

    def test_what_was_not_measured_is_not_answered(self):
        self.assertEqual(answers(bench({}), Accuracy({}, {}, (), None)), [])


class FrontierTest(unittest.TestCase):
    """frontier.py: cracks and speed of methods that take turns in each round."""

    ROUNDS = (0.98, 1.0, 1.01, 0.99, 1.02, 1.0, 1.0, 0.995, 1.005)

    def timed(self, name, ns, cracks=0, most_px=4096):
        method = Method(name, "src/raster" if name == "tiled" else "a book", "", True, most_px)
        costs = {("avx512", 1): Cost(ns, ns, ns, 1.0, 9, tuple(ns * noise for noise in self.ROUNDS)),
                 ("scalar", 1): Cost(4 * ns, ns, ns, 1.0, 9, tuple(4 * ns * noise for noise in self.ROUNDS))}
        return Measured(method, 0, None, 0, {}, 0, cracks, costs)

    def accuracy(self, **scenes):
        """From the methods of each scene; every scene has 10⁵ crossings of shared edges and triangles of 200 px."""
        made = tuple(Scene(name, "coverage", "", 10 ** 6, methods, (), 10 ** 5, 200.0) for name, methods in scenes.items())
        return Accuracy({"simd_best": "avx512"}, {"coverage": [m.method for m in made[0].measured]}, made, None)

    def test_cracks_are_pooled_without_t_junctions_and_overflow(self):
        found = self.accuracy(a=(self.timed("x", 1.0, 3), self.timed("y", 1.0, 9, 181)), b=(self.timed("x", 1.0, 1),),
                              t_junction=(self.timed("x", 1.0, 99),))
        pooled = cracks_of(found, found.methods["coverage"][0])
        self.assertEqual((pooled.rate, pooled.worst, pooled.worst_scene, pooled.crossings), (20.0, 30.0, "a", 2 * 10 ** 5))
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


class SweepTest(unittest.TestCase):
    """What is said of sweeps holds for their curves."""

    @staticmethod
    def sweep(**fails):
        """From {method: where it starts to fail}."""
        curves = tuple(Curve(name, False, ((1, 0.0), (128, 6.0), (1024, 9.0)), (1,) * 3, at) for name, at in fails.items())
        return Sweep("origin", "clipping", "", {"unit": ""}, {"name": ""}, curves, (0,) * 3)

    def test_a_matrix_of_floats_fails_far_from_the_origin(self):
        held = self.sweep(near_guard=None, matrix_relative=None, matrix_float=128)
        self.assertEqual(origin_sentence([held]), "Far from the origin, one float 4×4 matrix (`matrix_float`) fails from a distance of 128; "
                         "ours and camera-relative matrices hold up to 1.02k.")
        for other in (self.sweep(near_guard=128, matrix_relative=None, matrix_float=128), self.sweep(matrix_float=128),
                      self.sweep(near_guard=None, matrix_relative=None, matrix_float=None)):
            self.assertEqual(origin_sentence([other]), "")
        self.assertEqual(origin_sentence([]), "")

    def test_a_title_names_the_first_method_that_breaks(self):
        ours = {("clipping", "near_guard"): Method("near_guard", "frontend/clip.h", "", True)}

        def said(**fails):
            sweep = self.sweep(**fails)
            return summary(groups_of(sweep, ours))

        self.assertEqual(said(near_guard=None, a=1024, b=128, c=1), "ours hold; b breaks at 128")
        self.assertEqual(said(near_guard=128, a=1, b=1, c=None), "ours break at 128; 2 others fail at once")


if __name__ == "__main__":
    unittest.main()
