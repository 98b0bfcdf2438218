"""answers.py, and the modules whose figures it needs: each figure, its condition, and whether it is settled; and what scenes need:
from data made here."""
import json
import re
import sys
import unittest
from dataclasses import replace

from support import ROOT, SCRIPTS, FolderTest

sys.path.insert(0, str(SCRIPTS / "reporting"))
from accuracy_rows import Accuracy, Cost, Cracks, Measured, Method, Pooled, Scene, parse_accuracy, read_accuracy  # noqa: E402
from answers import answers  # noqa: E402
from bench_rows import Bench, Row, parse_name  # noqa: E402
from bench_tables import engine_table, peer_tables, scene_table, speed_table, tails_table, tile_stores_table  # noqa: E402
from factors import gains, superlinear  # noqa: E402
from facts_tables import edges_table, pipelines_table, pooled_text, read_needs, tutorials_table  # noqa: E402
from frontier import EXACT, INSIDE_TESTS, PRICED, cracks_of, frontier_figures, points_of, price_table, simd_gain, speed_ups, wrong_of  # noqa: E402
from instructions import instructions_table, read_counts  # noqa: E402
from program import BadInput  # noqa: E402
from python_tables import python_brief, python_tables, read_python  # noqa: E402
from tables import markdown  # noqa: E402

NOISE = (0.99, 1.0, 1.01, 0.995, 1.005)


def bench(times_ms, **context):
    """From {row's name: milliseconds, or the repetitions' milliseconds}."""
    rows = {name: parse_name(name) for name in times_ms}
    for name, row in rows.items():
        ms = times_ms[name]
        row.times_ms = list(ms) if isinstance(ms, tuple) else [ms * noise for noise in NOISE]
        row.counters = {"covered_px": 20.0, "triangles": 4.0, "overdraw": 2.0}
    return Bench({"backends": "scanline naive tiled", "simd_target": "avx512", **context}, rows)


def scene(name, scanline, naive, tiled):
    return {f"{backend}+frontend/{name}/threads:2": ms
            for backend, ms in (("scanline", scanline), ("naive", naive), ("tiled", tiled))}


def measured(name, exact, rate):
    return Measured(Method(name, "src/raster" if name == "tiled" else "a book", "", exact), rate, None, rate, seen=(rate, 0))


def accuracy(*methods, cube=None):
    return Accuracy({"coverage": [m.method for m in methods]}, (Scene("mesh_on_grid", "coverage", "", 1000, methods),), cube)


def turning(*counts):
    """From (name, gaps, double hits, wrong samples)."""
    return {"frames": 3600, "methods": [(measured(name, False, 0).method, dict(zip(("total_gaps", "total_double_hits", "total_wrong"), of)))
                                        for name, *of in counts]}


class AnswersTest(unittest.TestCase):
    def test_the_table_of_backends_has_every_number_of_threads(self):
        found = bench({f"{backend}/s/threads:{n}": ms / n for backend, ms in (("scanline", 16.0), ("naive", 64.0), ("tiled", 8.0)) for n in (1, 2, 4, 16)})
        (line,) = scene_table(found)[1]
        self.assertEqual([cell for cell in line if " / " in cell],
                         ["16.0 / 8.00 / 4.00 / 1.00", "64.0 / 32.0 / 16.0 / 4.00", "8.00 / 4.00 / 2.00 / 0.500"])
        self.assertEqual(line[-1], "tiled, 2.0×")

    def test_the_engine_is_compared_with_its_exact_numbers(self):
        self.assertEqual(engine_table(bench({})), (["numbers"], []))
        timed = bench({"tiled/large/threads:1": 9.0, "tiled/large/engine:exact/threads:1": 10.0, "tiled/large/engine:float/threads:1": 8.0,
                       "tiled/large/engine:int64/threads:1": 10.01, "tiled/large/engine:of_old_results/threads:1": 1.0,
                       "tiled/small/engine:float/threads:1": 1.0})  # without the base: left out
        timed.rows["tiled/large/engine:float/threads:1"].counters["wrong_px"] = 1234.0
        header, lines = engine_table(timed)
        self.assertEqual(header, ["numbers", "`large`"])
        self.assertEqual(lines, [["exact, the base", "10.0 ms"],
                                 ["`tiled` itself", "**1.11×** (1.09 to 1.13)"],
                                 ["64-bit integers", "1.00× (0.98 to 1.01)"],
                                 ["floats", "**1.25×** (1.23 to 1.27); 1,230 px"]])

    def test_tile_stores_are_compared_back_to_back_and_after_pauses(self):
        times = {f"tiled+frontend/cube{keys}/threads:2": ms for keys, ms in
                 (("", 1.0), ("/stores:streaming", 2.0), ("/pause:2ms", 3.0), ("/pause:2ms/stores:streaming", 3.0))}
        header, lines = tile_stores_table(bench(times))
        self.assertEqual(header, ["scene", "threads", "back to back: rule, ms", "streaming, ms", "after 2 ms: rule, ms", "streaming, ms"])
        self.assertEqual(lines, [["cube", "2", "1.00", "2.00 (2.0× slower)", "3.00", "3.00 (not settled)"]])
        del times["tiled+frontend/cube/pause:2ms/stores:streaming/threads:2"]
        self.assertEqual(tile_stores_table(bench(times))[1], [["cube", "2", "1.00", "2.00 (2.0× slower)", "3.00", "–"]])
        self.assertEqual(tile_stores_table(bench({}))[1], [])

    def test_tails_are_those_of_rows_whose_frames_were_kept(self):
        names = [f"{backend}+frontend/{scene}/threads:2" for scene in ("cube", "knot") for backend in ("tiled", "scanline")]
        timed = bench(dict.fromkeys(names, 2.0), backends="scanline tiled")
        for name in names[:3]:
            timed.rows[name].counters = {"p99_ms": 3.14159, "first_ms": 12.0}
        del timed.rows["tiled+frontend/knot/threads:2"].counters["p99_ms"]
        header, lines = tails_table(timed)
        self.assertEqual(header[1:3], ["scanline, median / p99, ms", "scanline, first, ms"])
        self.assertEqual(lines, [["cube", "2.00 / 3.14", "12", "2.00 / 3.14", "12"], ["knot", "–", "–", "2.00 / –", "12"]])
        self.assertEqual(tails_table(bench({}))[1], [])

    def test_methods_have_the_times_of_their_rows(self):
        score = {"errors_per_million": 0.0}
        data = {"methods": [{"family": "coverage", "name": name, "source": "", "promise": "", "exact": True} for name in ("m", "naive", "untimed")],
                "scenes": [{"name": "s", "family": "coverage", "summary": "", "covered": 500, "triangles": 20, "crossings": 9,
                            "methods": [{"name": name, "source": score, "snapped": score} for name in ("m", "naive", "untimed")]}]}
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

    def test_parallel_or_scanline_is_answered_by_the_factors(self):
        rows = {f"cell/{name}/traversal:{traversal}/fill:{fill}/simd:{simd}{extra}/threads:2": ms * slower * gain
                for name, of in (("a", 1), ("b", 3), ("c", 2)) for traversal, ms in (("bands", 4), ("tiles", of))
                for fill, slower in (("spans", 1), ("edges", 2 if traversal == "tiles" else 0.5)) for simd in ("scalar", "avx512")
                for extra, gain in (("", 1), *((("/with:hiz", 0.1),) if (traversal, simd) == ("tiles", "avx512") else ()))}
        self.assertEqual(answers(bench(rows), None)[0],
                         ["Parallel or scanline?",
                          "speed-up with AVX-512: tiles over bands 2.0× with spans (3/0/0), 0.50× with edges (0/2/1); edges over spans 2.0× in bands (3/0/0), "
                          "0.50× in tiles (0/3/0). In scalar code: tiles over bands 2.0× with spans (3/0/0), 0.50× with edges (0/2/1); edges over spans "
                          "2.0× in bands (3/0/0), 0.50× in tiles (0/3/0)",
                          "medians of scenes (won/lost/open) of [cells](#speed) without HiZ and masks, as implemented here (scalar tiles with edges: the "
                          "vector kernel with one lane); the size of triangles decides, too: [chart](#speed); whole frames, 2 threads"])

    def test_gains_beyond_the_number_of_threads_are_counted_beside_those_of_chance(self):
        rows = {f"cell/{scene}/traversal:bands/fill:spans/simd:scalar/threads:{n}": ms for scene, times in (("a", (9.0, 4.0)), ("b", (9.0, 5.0)))
                for n, ms in zip((1, 2), times)}
        self.assertEqual(superlinear(gains(bench(rows))), " Pairs that gain more by threads than there are threads: in scalar code 1 of 2, "
                                                            "1 of them with the whole 95 % interval (by chance at most 0.05).")
        self.assertEqual(superlinear(gains(bench({name: ms for name, ms in rows.items() if "/b/" in name}))), "")

    @staticmethod
    def boxed(name, scalar, simd, others):
        """Cells, of which the first in either code tests boxes; HiZ is faster still."""
        return {**({f"cell/{name}/traversal:bands/fill:edges/simd:scalar/threads:2": scalar} if scalar else {}),
                **{f"cell/{name}/{keys}/threads:2": ms for keys, ms in (
                    ("traversal:bands/fill:edges/simd:avx512", simd), ("traversal:tiles/fill:edges/simd:avx512", others),
                    ("traversal:tiles/fill:edges/simd:avx512/with:hiz", 0.1), ("traversal:bands/fill:spans/simd:scalar", 2.0))}}

    def box_answer(self, *scenes):
        rows = {name: ms for scene in scenes for name, ms in self.boxed(*scene).items()}
        return next(line[1:] for line in answers(bench(rows), None) if line[0] == "Or test the whole bounding box?")

    def test_box_tests_are_compared_with_cells_of_the_same_code(self):
        self.assertEqual(self.box_answer(("a", 8.0, 3.0, 1.0), ("b", 4.0, 1.0, 2.0)), [
            "in scalar code 2.0× to 4.0× slower in 2 of 2 scenes; with AVX-512 2.0× faster in 1, 3.0× slower in 1 of 2 scenes",
            "bands with edges against the fastest other cell; [cells](#speed) without HiZ and masks; whole frames, 2 threads"])

    def test_a_faster_median_alone_wins_nothing(self):
        close = ("a", (2.0, 1.0, 3.0, 2.1, 2.2), (1.9, 1.1, 3.1, 2.0, 1.8), (2.0, 1.0, 3.0, 2.1, 2.2))
        self.assertEqual(self.box_answer(close, ("b", 8.0, 2.0, 1.0))[0],
                         "in scalar code 4.0× slower in 1, not settled in 1 of 2 scenes; with AVX-512 2.0× slower in 1, not settled in 1 of 2 scenes")

    def test_a_scene_that_is_too_slow_is_left_out(self):
        answer, condition = self.box_answer(("a", 8.0, 2.0, 1.0), ("b", None, 2.0, 1.0))
        self.assertEqual(answer, "in scalar code 4.0× slower in 1 of 1 scene; with AVX-512 2.0× slower in 2 of 2 scenes")
        self.assertTrue(condition.endswith("; left out, too slow to repeat: b"))

    def test_gaps_have_their_counts(self):
        told = answers(bench({}), accuracy(measured("tiled", True, 873), measured("float_lt", False, 216),
                                           cube=turning(("tiled", 0, 0, 5000), ("float_lt", 3, 0, 3), ("float_le", 1, 9, 10), ("fixed_8", 7, 7, 9))))
        self.assertEqual(told, [
            ["Gaps / double hits / wrong samples when the cube turns?", "`float_lt` 3 / 0 / 3, `float_le` 1 / 9 / 10, ours 0 / 0 / 5,000",
             "3,600 frames of the tutorials' cube, all added; wrong against the exact projection of its vertices, of which methods get floats, and ours snap these to 1/256 px; "
             "`float_le` takes samples on an edge as inside, `float_lt` does not"],
            ["Wrong pixels / of these holes where edges meet pixel centres?", "`mesh_on_grid`: `float_lt` 216 / 0, ours 873 / 0",
             "two meshes that cover the picture; a quarter of the vertices of `mesh_on_grid` lie on centres, all on the 1/256 px grid, those of `mesh` "
             "anywhere; a hole shows another surface; [more scenes](results/README.md#accuracy)"]])
        told = answers(bench({}), accuracy(measured("tiled", True, 9), measured("float_lt", False, 0)))
        self.assertEqual(told[0][1], "`mesh_on_grid`: ours 9 / 0, 0 by `float_lt`")

    def test_a_scene_that_has_over_half_of_the_errors_is_named(self):
        ours, plain = measured("tiled", True, 800), measured("float_lt", False, 6000)
        scenes = (Scene("mesh_on_grid", "coverage", "", 1000, (measured("tiled", True, 0), plain)),
                  Scene("grid4", "coverage", "", 3000, (ours, measured("float_lt", False, 2))))
        told = Accuracy({"coverage": [ours.method, plain.method]}, scenes, None)
        self.assertEqual([pooled_text(wrong_of(told, m.method)) for m in (ours, plain)], ["200,000; 0 without grid4", "1,500,000; 667 without mesh_on_grid"])

    def test_rates_are_pooled_over_large_scenes_within_a_methods_range(self):
        limited = Method("y", "a book", "", False, 181)

        def scene_of(name, trials, side_px, *rates):
            methods = (Method("x", "a book", "", False), limited)
            return Scene(name, "coverage", "", trials, tuple(Measured(method, rate, None, rate) for method, rate in
                                                             zip(methods, rates)), largest_side_px=side_px)

        scenes = (scene_of("large", 30000, 500.0, 10.0, 9e6), scene_of("medium", 10000, 100.0, 50.0, 4.0),
                  scene_of("tiny", 100, 1.0, 1e6, 1e6))
        told = Accuracy({"coverage": [m.method for m in scenes[0].measured]}, scenes, None)
        self.assertEqual([told.rate("coverage", method) for method in told.methods["coverage"]], [Pooled(20.0, "medium", 10.0), Pooled(4.0)])

    def test_peers_are_compared_with_one_backend_at_both_widths(self):
        rows = {**scene("a", 2.0, 8.0, 1.0), **scene("b", 1.0, 5.0, 4.0), "ext+frontend/a/threads:2": 8.0, "ext+frontend/b/threads:2": 30.0,
                "tiled+frontend/m/threads:2": 3.0, "ext+frontend/m/threads:2": 1.5}
        told = bench(rows, peers="ext", ext="Ext 1, 256 bits")
        self.assertEqual(answers(told, None), [["Against ext?", "`tiled` 7.5× to 8.0× faster in 2, 2.0× slower in 1 of 3 scenes on 2 threads",
                                                "ext is Ext 1, 256 bits; whole frames, ours with AVX-512, and clusters out of view skipped; of two draws of a frame over 0.3 s the faster counts, and only a ratio over 2 is settled"]])
        narrow = bench({**rows, "tiled+frontend/a/target:avx2/threads:2": 2.0, "tiled+frontend/a/target:avx2/threads:1": 3.0, "m/threads:2": 1.0,
                        "ext+frontend/a/threads:1": 9.0}, peers="ext", ext="Ext 1, 256 bits")
        self.assertEqual(answers(narrow, None)[0][1:],
                         ["`tiled` 3.0× faster in 1 of 1 scene on 1 thread; 4.0× faster in 1 of 1 scene on 2 threads",
                          "ext is Ext 1, 256 bits; whole frames, ours with AVX2, and clusters out of view skipped; of two draws of a frame over 0.3 s the faster counts, and only a ratio over 2 is settled"])
        table = peer_tables(narrow, markdown)
        self.assertIn("| speed-up with AVX-512, 512 bits | speed-up with AVX2, 256 bits |", table)
        self.assertIn("| – / 8.0× | 3.0× / 4.0× |", table)

    def test_a_gpu_has_one_row_a_scene_and_its_own_clock(self):
        told = bench({**scene("a", 3.0, 8.0, 2.0), "tiled+frontend/a/threads:1": 4.0, "gpu+frontend/a/threads:1": 1.0,
                      "gpu+frontend/a/clock:device/threads:1": 0.5}, peers="gpu", gpu="a GPU")
        self.assertIn("| a | 1.00 | 0.500 | 4.00 / 2.00 | 4.0× slower / 2.0× slower |", peer_tables(told, markdown))
        self.assertIn("2.0× slower in 1 of 1 scene on 2 threads", answers(told, None)[-1][1])
        self.assertEqual(speed_table(told)[1][0][-1], "1.00")

    def test_the_methods_that_answers_name_are_measured(self):
        named = re.search("<!-- results: (.*) -->", (ROOT / "README.md").read_text())[1]
        names = {m.method.name for scene in read_accuracy(ROOT / named, None).of("coverage") for m in (*scene.measured, *scene.apart)}
        self.assertEqual({*PRICED, *INSIDE_TESTS} - names, set())

    def test_what_was_not_measured_is_not_answered(self):
        self.assertEqual(answers(bench({}), Accuracy({}, (), None)), [])


class FrontierTest(unittest.TestCase):
    """frontier.py: cracks and speed of methods."""

    ROUNDS = (0.98, 1.0, 1.01, 0.99, 1.02, 1.0, 1.0, 0.995, 1.005)

    def timed(self, name, ns, cracks=0, most_px=4096):
        def cost(factor):
            return Cost(Row("", "", False, "", {}, [factor * ns * noise for noise in self.ROUNDS]), 10 ** 6, 1)

        return Measured(Method(name, "src/raster" if name == "tiled" else "a book", "", True, most_px), 0, None, 0, Cracks(cracks, 0, 7, 2),
                        {("avx512", 1): cost(1), ("scalar", 1): cost(4)}, (0, 0))

    def accuracy(self, **scenes):
        """From the methods of each scene; every scene has 10⁵ crossings of shared edges and triangles of 200 px."""
        made = tuple(Scene(name, "coverage", "", 10 ** 6, methods, (), 10 ** 5, 200.0) for name, methods in scenes.items())
        return Accuracy({"coverage": [m.method for m in made[0].measured]}, made, None)

    def test_cracks_are_pooled_without_overflow_and_without_the_scene_that_has_most(self):
        found = self.accuracy(a=(self.timed("x", 1.0, 3), self.timed("y", 1.0, 9, 181)), b=(self.timed("x", 1.0, 1),))
        rates = cracks_of(found, found.methods["coverage"][0])
        self.assertEqual((rates.pooled, rates.crossings, rates.t_junctions, rates.folds),
                         (Pooled(20.0, "a", 10.0), 2 * 10 ** 5, 14, 4))
        self.assertIsNone(cracks_of(found, found.methods["coverage"][1]))

    def test_what_no_scene_in_range_shows_is_absent(self):
        limited = self.timed("y", 1.0, 0, 181)
        small = Scene("b", "coverage", "", 10 ** 6, (replace(limited, cracks=Cracks(0, 0, 0)),), (), 10 ** 5, 100.0)
        found = self.accuracy(a=(self.timed("x", 1.0), limited))
        rates = cracks_of(replace(found, scenes=(*found.scenes, small)), limited.method)
        self.assertEqual((rates.t_junctions, rates.folds), (None, None))

    def test_speed_is_the_geometric_mean_of_scenes_and_outcomes_are_by_scene(self):
        found = self.accuracy(a=(self.timed("tiled", 1.0), self.timed("x", 4.0)), b=(self.timed("tiled", 2.0), self.timed("x", 1.0)),
                              c=(self.timed("tiled", 1.0), self.timed("x", 1.0)))
        ups, base, scenes = speed_ups(found)
        self.assertEqual((base.name, scenes), ("x", 3))
        tiled = ups[found.methods["coverage"][0]]
        self.assertAlmostEqual(tiled["scalar"].middle, 2 ** (1 / 3))
        self.assertAlmostEqual(tiled["simd"].middle, 4 * 2 ** (1 / 3))
        self.assertEqual(simd_gain(found, "tiled", "x"), "1.3× (0.50× in b to 4.0× in a; 1/1/1)")

    def test_a_point_of_the_chart_has_a_methods_wrong_pixels_and_its_speed(self):
        found = self.accuracy(a=(self.timed("x", 1.0), replace(self.timed("y", 2.0), seen=(5, 0))))
        self.assertEqual(wrong_of(found, found.methods["coverage"][1]).rate, 5.0)  # pixels: its rate of samples is 0
        points = {method.name: (wrong, up.middle) for method, (wrong, up, _) in points_of(frontier_figures(found)[0], found, "simd").items()}
        self.assertEqual(points, {"x": (0.0, 4.0), "y": (5.0, 2.0)})

    def test_the_price_list_compares_with_the_exact_edges(self):
        loose, finer = (name for name in PRICED if name != EXACT)
        found = self.accuracy(a=(self.timed(loose, 1.0, 3), self.timed(EXACT, 2.0), self.timed(finer, 4.0)))
        self.assertEqual([line[:3] for line in price_table(found)[1]],
                         [[f"`{loose}`", "2.0× (2.0× in a to 2.0× in a; 1/0/0)", "30"], [f"`{EXACT}`", "1×", "0 (<30)"],
                          [f"`{finer}`", "0.50× (0.50× in a to 0.50× in a; 0/1/0)", "0 (<30)"]])
        self.assertEqual(answers(bench({}), found)[0][:2], ["What does exactness cost?",
                         f"speed-up by `{loose}` 2.0× (2.0× in a to 2.0× in a; 1/0/0); by `{finer}` 0.50× (0.50× in a to 0.50× in a; 0/1/0). "
                         f"Wrong pixels per 10⁶ crossings: `{loose}` 0, `{EXACT}` 0, `{finer}` 0"])
        self.assertEqual(price_table(self.accuracy(a=(self.timed(EXACT, 2.0),))), ([], []))


def question(name, *answers, needed):
    """Answers before the needed one are not enough; None: none is."""
    at = answers.index(needed) if needed else len(answers)
    return {"question": name, "answer": needed, "proven": False, "error": "wrong pixel", "answers": [
        {"answer": a, "enough": i >= at, **({} if i >= at else {"witness": {"wrong_px": 1 + i, "frame": 7}})}
        for i, a in enumerate(answers)]}


def curve(stage, *levels, enough):
    return {"stage": stage, "levels": [{"level": level, "enough": level in enough, "mean_px": 0.5, "worst_px": 0 if level in enough else 1 + i}
                                       for i, level in enumerate(levels)]}


def entry(scene, minima=(), **closest):
    """Clipping at the near plane, a facing test by the eye, and a depth buffer are enough."""
    return {"scene": scene, "frames": 3, "minima": list(minima), **closest,
            "curves": [curve("near plane", "nothing", "drop whole triangles", "clip", enough=("clip",)),
                       curve("facing test", "no test", "normal_z", "normal_dot_eye", "snapped_area", enough=("normal_dot_eye", "snapped_area")),
                       curve("visibility", "submission_order", "painter_mean", "depth buffer", enough=("painter_mean", "depth buffer")),
                       curve("depth buffer", "16 bits", "24 bits", "contract31", "float_z", "reversed_z", enough=("24 bits", "contract31"))],
            "edges": [question("subpixel bits: no crack, no fold", "0 bits", "1 bit", needed="1 bit"),
                      question("subpixel bits, no worse than 8 bits", "8 bits", needed="8 bits"),
                      question("edge values at 8 subpixel bits", "32-bit integers", needed="32-bit integers")]}


PIPELINE = {**dict.fromkeys(("near plane", "far plane", "guard band"), "nothing"), "facing test": "no test",
            "visibility": "painter_mean", "subpixel bits": "6 bits"}


class InstructionsTest(FolderTest):
    def table(self, counts):
        return instructions_table(self.file("instructions.json", json.dumps(counts)))[1]

    def test_the_second_count_of_a_frame_counts_and_a_frame_is_the_sum_of_its_parts(self):
        counts = read_counts(["9000 cube scalar frontend", "4000 cube scalar frontend", "1000 cube neon frontend", "3000000 cube scalar tiled",
                              "2000000 cube neon tiled", "9000 cube scalar scanline", "10000 cube neon scanline"])
        self.assertEqual(self.table(counts), [["cube", "1k, 4.0×", "10k, 0.90×", "2M, 1.5×", "11k, 1.2×", "2M, 1.5×"]])

    def test_what_is_not_a_count_is_refused(self):
        with self.assertRaises(BadInput):
            self.table({"cube": {"frontend": {"scalar": 1}}})


def compared_packages(**peers):
    """One picture; of each peer: its speed-down on both numbers of threads, and how many ids differ."""
    def times(ms):
        return {str(threads): {"draw": [ms / threads * noise for noise in NOISE * 2], "load": [9 * ms * noise for noise in NOISE * 2]} for threads in (1, 2)}

    return {"commit": "abc", "versions": {"edgewise": "Edgewise", **{peer: f"{peer} 1" for peer in peers}}, "pictures": [
        {"mesh": "hill", "triangles": 2000, "size": [640, 480], "covered": 5000,
         "peers": {peer: {"differ": differ, "holes": 2, "farthest_px": 0.00212, "ours_hold": 1, "theirs_hold": 3, "distance_p99": 1.23e-7}
                   for peer, (_, differ) in peers.items()},
         "ms": {"edgewise": times(2.0), **{peer: times(2.0 * slower) for peer, (slower, _) in peers.items()}}}]}


class PythonTest(FolderTest):
    def read(self, data, machine="mine"):
        self.file(f"results/{machine}/python.json", json.dumps(data))
        return read_python(self.folder / "results/mine")

    def test_a_picture_has_a_line_per_call_and_a_line_per_peer(self):
        lines = python_tables(self.read(compared_packages(vtk=(4.0, 0), moderngl=(0.5, 1234)))).splitlines()
        self.assertEqual(lines[0], "vtk 1 and moderngl 1, on 1 / 2 threads (`mine`, commit abc):")
        self.assertEqual([line for line in lines if "| hill" in line],
                         ["| hill, 640 × 480 | 2,000 | draw | 2.00 / 1.00 | 8.00 / 4.00 | 4.0× / 4.0× | 1.00 / 0.500 | 2.0× slower / 2.0× slower |",
                          "| hill, 640 × 480 | 2,000 | load and draw | 18.0 / 18.0 | 72.0 / 72.0 | 4.0× / 4.0× | 9.00 / 9.00 | 2.0× slower / 2.0× slower |",
                          "| hill, 640 × 480 | 2,000 | VTK | 5,000 | 0 | 2 | – | 1 / 3 | 1.2e-07 |",
                          "| hill, 640 × 480 | 2,000 | ModernGL | 5,000 | 1,234 | 2 | 0.0021 | 1 / 3 | 1.2e-07 |"])

    def test_in_brief_only_draws_on_two_threads_count(self):
        found = self.read(compared_packages(vtk=(4.0, 0), moderngl=(0.5, 0)), "other")
        self.assertEqual(python_brief(found), "Ids and depths by `draw` on 2 threads: against VTK 4.0× faster in 1 of 1 scene; against ModernGL 2.0× slower in 1 of 1 "
                         "scene (a scene is a mesh at one size; both on llvmpipe; `other`, commit abc; [more](results/README.md#python-packages)).")

    def test_nothing_is_said_of_nothing_and_what_is_no_result_is_refused(self):
        for told in (python_tables, python_brief):
            self.assertEqual(told(read_python(self.folder / "results/mine")), "No other Python package was measured here; `scripts/run --peers` does.")
        for data in ([], {"versions": {}, "pictures": [{}]}, compared_packages(vtk=(1.0, 0)), compared_packages(vtk=(1.0, 0), moderngl=(1.0, -1))):
            with self.assertRaises(BadInput):
                self.read(data)


class NeedsTest(FolderTest):
    def read(self, *entries):
        self.file("facts/needs.json", json.dumps(entries))
        return read_needs(self.folder / "mine")

    def test_nothing_is_said_of_nothing(self):
        self.assertEqual(read_needs(self.folder / "empty/mine"), {})
        self.assertEqual(tutorials_table({})[1], [])

    def test_what_is_not_a_result_is_refused(self):
        for entry in ({"scene": "cube"}, 3, "scene"):
            with self.assertRaises(BadInput):
                self.read(entry)

    def test_a_line_is_a_pipeline_that_was_drawn_as_a_whole_the_fastest_first(self):
        depth = {**PIPELINE, "near plane": "clip", "visibility": "depth buffer", "depth buffer": "6 bits", "subpixel bits": "1 bit"}
        timed = bench({"needs/cube/pipeline:1/threads:1": 4.0, "needs/cube/pipeline:2/threads:1": 2.0, "needs/cube/pipeline:exact/threads:1": 4.0})
        stream = {"visibility": "submission_order", "subpixel bits": "0 bits"}
        header, lines = pipelines_table(self.read(entry("cube", [PIPELINE, depth]), entry("grid", [stream]),
                                                  entry("cubes", closest={"levels": PIPELINE, "worst_px": 1234})), timed)
        self.assertEqual(lines, [["cube (3 frames)", "clip at the near plane", "no test", "depth buffer", "6 bits", "1", "2.0×"],
                                 ["cube (3 frames)", "nothing", "no test", "`painter_mean`", "–", "6", "1.00× (not settled)"],
                                 ["grid (3 frames)", "–", "–", "`submission_order`", "–", "0", "–"],
                                 ["cubes (3 frames)", "nothing", "no test", "`painter_mean`", "–", "6", "not right: 1,234 wrong px in a frame"]])
        self.assertEqual(len(header), 7)

    def test_edges_have_a_line_per_question(self):
        self.assertEqual(dict(edges_table(self.read(entry("cube", [PIPELINE]), entry("sphere", [PIPELINE])))[1]), {
            title: f"{said}: cube (3 frames), sphere (3 frames)" for title, said in
            {"no crack or fold": "1 bit", "no worse than 8 bits": "8 bits", "edge values": "32-bit integers", "depth formats": "D24, ours"}.items()})

    def test_tutorials_have_more_than_needed_or_less(self):
        _, lines = tutorials_table(self.read(entry("cube", [PIPELINE])))
        said = {(engine, stage): verdict for engine, stage, _, verdict in lines}
        self.assertEqual(said["p5.js engine", "near plane"], "enough")
        self.assertEqual(said["p5.js engine", "visibility"], "enough")
        self.assertEqual(said["REALbasic engine", "facing test"], "enough")
        self.assertEqual(said["Outlaw Triad trainer", "facing test"], "**not enough**: 2 wrong pixels in a frame")
        self.assertEqual(said["Outlaw Triad trainer", "near plane"], "**not enough**: 1 wrong pixel in a frame")

    def test_a_weaker_level_that_is_enough_and_a_wrong_exact_pipeline_are_named(self):
        found = self.read(entry("cube", [PIPELINE]))
        curves = found["cube"][2]
        curves["facing test"]["no test"]["enough"] = True
        for level in curves["near plane"].values():
            level.update(enough=False, worst_px=7)
        said = {(engine, stage): verdict for engine, stage, _, verdict in tutorials_table(found)[1]}
        self.assertEqual(said["REALbasic engine", "facing test"], "more than needed: no test")
        self.assertEqual(said["p5.js engine", "near plane"], "as wrong as the exact one: 7 wrong pixels in a frame")

    def test_a_level_that_no_longer_exists_is_refused(self):
        found = self.read(entry("cube", [PIPELINE]))
        found["cube"][2]["visibility"].clear()
        with self.assertRaises(BadInput):
            tutorials_table(found)


if __name__ == "__main__":
    unittest.main()
