"""findings.py and accuracy_findings.py: each sentence's figures, condition, and whether it is settled, from data made here."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/reporting"))
from accuracy_findings import origin_sentence, ours_fail_sentence, pooled_clause, rates_together, speed_sentence  # noqa: E402
from accuracy_rows import Accuracy, Cost, Curve, Measured, Method, Scene, Sweep, parse_measured  # noqa: E402
from bench_rows import Bench, parse_name  # noqa: E402
from engine import engine_table  # noqa: E402
from findings import crack_finding, exactness_finding, findings, peer_finding, speed_finding  # noqa: E402
from frontier import cracks_of, simd_outcome, speed_ups  # noqa: E402
from peers import peer_tables  # noqa: E402
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
    return Accuracy({"simd_best": "avx512"}, False, registry, scenes, cube)


def turning(*counts):
    """From (name, gaps, double hits)."""
    return {"frames": 3600, "methods": [
        (measured(name, False, 0, 1.0).method, {"total_gaps": gaps, "total_double_hits": doubles}) for name, gaps, doubles in counts]}


class FindingsTest(unittest.TestCase):
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
        text = speed_finding(bench({**scene("a", 2.0, 8.0, 1.0), **scene("b", 3.0, 4.0, 2.0), **scene("c", 1.0, 5.0, 4.0)}))
        self.assertIn("In whole frames on 2 threads, with AVX-512 in all backends, `tiled` wins 2 of 3 scenes against `scanline`, "
                      "1.5× to 2.0× faster; it loses 1, 4.0× slower.", text)
        self.assertIn("`naive`, which tests every pixel of the bounding box, is 2.0× to 8.0× slower than the faster of the two on 3 "
                      "of 3 scenes.", text)

    def test_a_faster_median_alone_wins_nothing(self):
        close = {**scene("a", (2.0, 1.0, 3.0, 2.1, 2.2), 8.0, (1.9, 1.1, 3.1, 2.0, 1.8)), **scene("b", 2.0, 8.0, 1.0)}
        self.assertIn("wins 1 of 2 scenes against `scanline`, 2.0× faster; 1 is too close to call.", speed_finding(bench(close)))
        self.assertIn("wins all 1 scenes", speed_finding(bench(scene("b", 2.0, 8.0, 1.0))))

    def test_a_scene_that_only_one_of_the_two_drew_does_not_count(self):
        self.assertEqual(speed_finding(bench({"tiled/a/threads:2": 1.0})), "")

    def test_a_scene_that_is_too_slow_for_naive_counts_for_the_others(self):
        rows = {**scene("a", 2.0, 8.0, 1.0), **scene("b", 4.0, 8.0, 2.0)}
        del rows["naive+frontend/b/threads:2"]
        text = speed_finding(bench(rows))
        self.assertIn("wins all 2 scenes against `scanline`", text)
        self.assertTrue(text.endswith("on 1 of 1 scenes."))
        rows.update({f"{backend}/b/threads:2": ms for backend, ms in (("scanline", 3.5), ("naive", 70.0), ("tiled", 1.75))})
        self.assertTrue(speed_finding(bench(rows)).endswith(" On `b`, where whole frames of `naive` are too slow to repeat, its "
                                                            "draw alone is 40× slower than the faster of the two."))

    def test_the_turning_cube_and_the_centred_scene_are_named(self):
        text = crack_finding(accuracy(measured("tiled", True, 0, 3.0), measured("float_lt", False, 5710, 2.0),
                                      cube=turning(("tiled", 0, 0), ("float_lt", 3, 0), ("float_le", 1, 9))))
        self.assertIn("In 3,600 frames of the tutorials' cube `float_lt` leaves 3 gaps, `float_le` leaves 1 gap and draws 9 pixels "
                      "twice; `tiled` do neither.", text)
        self.assertIn("Where edges run through pixel centres (`mesh_on_grid`), those tests get 5,710 (`float_lt`) pixels wrong per "
                      "10⁶ edge crossings, ours 0.", text)
        ours_err = crack_finding(accuracy(cube=turning(("tiled", 1, 1), ("float_lt", 0, 0))))
        self.assertIn("`float_lt` errs nowhere; ours err at 2 pixels.", ours_err)

    def test_that_a_float_test_errs_less_before_snapping_is_said_only_if_so(self):
        right = accuracy(measured("tiled", True, 873, 3.0), measured("float_lt", False, 216, 2.0))
        self.assertIn("`float_lt` errs less than ours: 216 wrong pixels per 10⁶ edge crossings against 873 (1 scene pooled, ",
                      exactness_finding(right))
        wrong = accuracy(measured("tiled", True, 216, 3.0), measured("float_lt", False, 873, 2.0))
        self.assertNotIn("errs less", exactness_finding(wrong))

    def test_rates_are_pooled_over_large_scenes_within_a_methods_range(self):
        limited = Method("y", "a book", "", False, 181)

        def scene_of(name, trials, side_px, *rates):
            methods = (Method("x", "a book", "", False), limited)
            return Scene(name, "coverage", "", trials, tuple(Measured(method, rate, None, rate, {}) for method, rate in
                                                             zip(methods, rates)), largest_side_px=side_px)

        scenes = (scene_of("large", 30000, 500.0, 10.0, 9e6), scene_of("medium", 10000, 100.0, 50.0, 4.0),
                  scene_of("tiny", 100, 1.0, 1e6, 1e6))
        told = Accuracy({}, False, {"coverage": [m.method for m in scenes[0].measured]}, scenes, None)
        self.assertEqual(rates_together(told, "coverage"), {"x": 20.0, "y": 4.0})
        self.assertEqual(pooled_clause(told, "coverage"), "2 scenes pooled, 40k edge crossings, 75 % of them in `large`")

    def test_simd_and_scalar_code_are_told_apart_and_noise_is_named(self):
        slower = accuracy(measured("tiled", True, 0, 2.1, 0.3), measured("float_lt", False, 9, 2.0, 0.3))
        self.assertIn("`tiled` with AVX-512 is 1.05× slower than `float_lt` in scalar code (not settled)",
                      speed_sentence(slower.scenes[0], slower.machine))

    def test_peers_are_compared_with_one_backend_at_both_widths(self):
        rows = {**scene("a", 2.0, 8.0, 1.0), **scene("b", 1.0, 5.0, 4.0), "ext+frontend/a/threads:2": 8.0, "ext+frontend/b/threads:2": 30.0,
                "tiled+frontend/m/threads:2": 3.0, "ext+frontend/m/threads:2": 1.5}
        text = peer_finding(bench(rows, peers="ext", ext="Ext 1, 256 bits"))
        self.assertIn("**Against ext** (Ext 1, 256 bits): on 2 threads, `tiled` with AVX-512, 512 bits, wins 2 of 3 scenes, in whole "
                      "frames, 7.5× to 8.0× faster; it loses 1, 2.0× slower.", text)
        self.assertNotIn("AVX2", text)
        narrow = bench({**rows, "tiled+frontend/a/target:avx2/threads:2": 2.0, "m/threads:2": 1.0}, peers="ext", ext="Ext 1, 256 bits")
        self.assertIn("With AVX2, 256 bits, it wins all 1 scenes, in whole frames, 4.0× faster.", peer_finding(narrow))
        table = peer_tables(narrow, markdown)
        self.assertIn("| speed-up with AVX-512, 512 bits | speed-up with AVX2, 256 bits |", table)
        self.assertIn("| – / 8.0× | – / 4.0× |", table)
        self.assertEqual(peer_finding(bench(scene("a", 2.0, 8.0, 1.0))), "")

    def test_what_was_not_measured_is_not_found(self):
        self.assertEqual(findings(bench({}), Accuracy({}, False, {}, (), None)), [])


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
        return Accuracy({"simd_best": "avx512"}, False, {"coverage": [m.method for m in made[0].measured]}, made, None)

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
        won, lost, close = simd_outcome(found, "tiled", "x")
        self.assertEqual((won, lost, close), ({"a": 4.0}, {"b": 0.5}, {"c": 1.0}))


class OursFailTest(unittest.TestCase):
    """ours_fail_sentence(): what rounding costs by itself, and what comes on top."""

    def sweep(self, name, ours, by_snapping, fails=None):
        curve = Curve("tiled", True, tuple(enumerate(ours)), (1,) * len(ours), fails)
        return Sweep(name, "coverage", "a summary", {"unit": ""}, {"name": "misjudged faces, %"}, (curve,), tuple(by_snapping))

    def test_only_equal_curves_count_as_rounding(self):
        told = accuracy(measured("tiled", True, 0, 1.0))
        text = ours_fail_sentence([self.sweep("edge", (0.0, 50.94), (0.0, 50.94)), self.sweep("none", (0.0, 0.0), (0.0, 0.0)),
                                   self.sweep("deep", (0.0, 7.0), (0.0, 0.0), 1.0)], told)
        self.assertIn("In 2 of 3 sweeps ours err exactly as much as rounding to 1/256 px does by itself: up to 50.9 % in `edge` "
                      "(misjudged faces); 0 in the others.", text)
        self.assertIn("They err more in `deep` (a summary): `tiled` from 1, up to 7 % misjudged faces.", text)
        self.assertEqual(ours_fail_sentence([], told), "")

    def test_a_matrix_of_floats_fails_far_from_the_origin(self):
        def origin(ours, worst):
            curves = tuple(Curve(name, False, ((1, 0.0), (128, 6e5), (256, 0.0), (1024, worst)), (1,) * 4, fails)
                           for name, fails in (("near_guard", ours), ("matrix_float", 128)))
            return [Sweep("origin", "clipping", "", {"unit": ""}, {"name": ""}, curves, (0,) * 4)]
        said = "(`matrix_float`) draws wrong pixels first at a distance of 128"
        self.assertIn(f"{said}; ours (`near_guard`) at no distance up to ", origin_sentence(origin(None, 9.0)))
        self.assertRegex(origin_sentence(origin(128, 9e5)),
                         r"128, and most pixels wrong from 1\.02k on; ours .* first at a distance of 128\.")
        self.assertEqual(origin_sentence([]), "")


if __name__ == "__main__":
    unittest.main()
