"""The tables of results: each figure, its condition, and whether it is settled; and what scenes need: from data made here."""
import json
import re
import sys
import unittest
from dataclasses import replace

from support import ROOT, SCRIPTS, FolderTest

sys.path.insert(0, str(SCRIPTS / "reporting"))
from accuracy_rows import Accuracy, Cost, Cracks, Measured, Method, Pooled, Scene, parse_accuracy, read_accuracy  # noqa: E402
from bench_rows import Bench, Row, parse_name  # noqa: E402
from bench_tables import engine_table, peer_lines, speed_table  # noqa: E402
from facts_tables import edges_table, pipelines_table, pooled_text, read_needs, tutorials_table  # noqa: E402
from frontier import cracks_of, frontier_figures, points_of, speed_ups, wrong_of  # noqa: E402
from instructions import instructions_sentence, read_counts  # noqa: E402
from program import BadInput  # noqa: E402
from python_tables import python_lines, read_python  # noqa: E402

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


def measured(name, rate):
    return Measured(Method(name, "src/raster" if name == "tiled" else "a book"), rate, seen=(rate, 0))


def accuracy(*methods, cube=None):
    return Accuracy({"coverage": [m.method for m in methods]}, (Scene("mesh_on_grid", "coverage", 1000, methods),), cube)


class TablesTest(unittest.TestCase):
    def test_the_engine_is_compared_with_its_exact_numbers(self):
        self.assertEqual(engine_table(bench({})), (["numbers"], []))
        timed = bench({"tiled/large/threads:1": 9.0, "tiled/large/engine:exact/threads:1": 10.0, "tiled/large/engine:float/threads:1": 8.0,
                       "tiled/large/engine:int64/threads:1": 10.01, "tiled/large/engine:of_old_results/threads:1": 1.0,
                       "tiled/small/engine:float/threads:1": 1.0})  # without the base: left out
        timed.rows["tiled/large/engine:float/threads:1"].counters["wrong_px"] = 1234.0
        header, lines = engine_table(timed)
        self.assertEqual(header, ["numbers", "`large`"])
        self.assertEqual(lines, [["exact, the base", "10.0 ms"],
                                 ["`tiled` itself", "**1.1×**"],
                                 ["64-bit integers", "1.00×"],
                                 ["floats", "**1.2×**; 1,230 px"]])

    def test_methods_have_the_times_of_their_rows(self):
        score = {"errors_per_million": 0.0}
        data = {"methods": [{"family": "coverage", "name": name, "source": "", "promise": "", "exact": True} for name in ("m", "naive", "untimed")],
                "scenes": [{"name": "s", "family": "coverage", "covered": 500, "triangles": 20, "crossings": 9,
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
        self.assertEqual((both.scalar.ns, both.simd.ns, naive.scalar.ns, naive.simd, untimed.scalar), (8000.0, 4000.0, 8000.0, None, None))

    def test_a_scene_that_has_over_half_of_the_errors_is_named(self):
        ours, plain = measured("tiled", 800), measured("float_lt", 6000)
        scenes = (Scene("mesh_on_grid", "coverage", 1000, (measured("tiled", 0), plain)),
                  Scene("grid4", "coverage", 3000, (ours, measured("float_lt", 2))))
        told = Accuracy({"coverage": [ours.method, plain.method]}, scenes, None)
        self.assertEqual([pooled_text(wrong_of(told, m.method)) for m in (ours, plain)], ["200,000; 0 without grid4", "1,500,000; 667 without mesh_on_grid"])

    def test_rates_are_pooled_over_large_scenes_within_a_methods_range(self):
        limited = Method("y", "a book", 181)

        def scene_of(name, trials, side_px, *rates):
            methods = (Method("x", "a book"), limited)
            return Scene(name, "coverage", trials, tuple(Measured(method, rate) for method, rate in
                                                             zip(methods, rates)), largest_side_px=side_px)

        scenes = (scene_of("large", 30000, 500.0, 10.0, 9e6), scene_of("medium", 10000, 100.0, 50.0, 4.0),
                  scene_of("tiny", 100, 1.0, 1e6, 1e6))
        told = Accuracy({"coverage": [m.method for m in scenes[0].measured]}, scenes, None)
        self.assertEqual([told.rate("coverage", method) for method in told.methods["coverage"]], [Pooled(20.0, "medium", 10.0), Pooled(4.0)])

    def test_peers_are_compared_with_one_backend_at_both_widths(self):
        rows = {**scene("a", 2.0, 8.0, 1.0), **scene("b", 1.0, 5.0, 4.0), "ext+frontend/a/threads:2": 8.0, "ext+frontend/b/threads:2": 30.0,
                "tiled+frontend/m/threads:2": 3.0, "ext+frontend/m/threads:2": 1.5}
        told = bench(rows, peers="ext", ext="Ext 1, 256 bits")
        narrow = bench({**rows, "tiled+frontend/a/target:avx2/threads:2": 2.0, "tiled+frontend/a/target:avx2/threads:1": 3.0, "m/threads:2": 1.0,
                        "ext+frontend/a/threads:1": 9.0}, peers="ext", ext="Ext 1, 256 bits")
        self.assertIn("with AVX-512, 512 bits, 7.5× to 8.0× faster in 2, 2.0× slower in 1 of 3 scenes on 2 threads; with AVX2, 256 bits, 3.0× faster in "
                      "1 of 1 scene on 1 thread; 4.0× faster", peer_lines(narrow))

    def test_a_gpu_has_one_row_a_scene(self):
        told = bench({**scene("a", 3.0, 8.0, 2.0), "tiled+frontend/a/threads:1": 4.0, "gpu+frontend/a/threads:1": 1.0}, peers="gpu", gpu="a GPU")
        self.assertIn("4.0× slower in 1 of 1 scene on 1 thread; 2.0× slower in 1 of 1 scene on 2 threads", peer_lines(told))
        self.assertEqual(speed_table(told)[1][0][-1], "1.00")


class FrontierTest(unittest.TestCase):
    """frontier.py: cracks and speed of methods."""

    ROUNDS = (0.98, 1.0, 1.01, 0.99, 1.02, 1.0, 1.0, 0.995, 1.005)

    def timed(self, name, ns, cracks=0, most_px=4096):
        def cost(factor):
            return Cost(Row("", "", False, "", {}, [factor * ns * noise for noise in self.ROUNDS]), 10 ** 6)

        return Measured(Method(name, "src/raster" if name == "tiled" else "a book", most_px), 0, Cracks(cracks, 0, 7),
                        {("avx512", 1): cost(1), ("scalar", 1): cost(4)}, (0, 0))

    def accuracy(self, **scenes):
        """From the methods of each scene; every scene has 10⁵ crossings of shared edges and triangles of 200 px."""
        made = tuple(Scene(name, "coverage", 10 ** 6, methods, (), 10 ** 5, 200.0) for name, methods in scenes.items())
        return Accuracy({"coverage": [m.method for m in made[0].measured]}, made, None)

    def test_cracks_are_pooled_without_overflow_and_without_the_scene_that_has_most(self):
        found = self.accuracy(a=(self.timed("x", 1.0, 3), self.timed("y", 1.0, 9, 181)), b=(self.timed("x", 1.0, 1),))
        rates = cracks_of(found, found.methods["coverage"][0])
        self.assertEqual((rates.pooled, rates.crossings), (Pooled(20.0, "a", 10.0), 2 * 10 ** 5))
        self.assertIsNone(cracks_of(found, found.methods["coverage"][1]))

    def test_speed_is_the_geometric_mean_of_scenes_and_outcomes_are_by_scene(self):
        found = self.accuracy(a=(self.timed("tiled", 1.0), self.timed("x", 4.0)), b=(self.timed("tiled", 2.0), self.timed("x", 1.0)),
                              c=(self.timed("tiled", 1.0), self.timed("x", 1.0)))
        ups, base, scenes = speed_ups(found)
        self.assertEqual((base.name, scenes), ("x", 3))
        tiled = ups[found.methods["coverage"][0]]
        self.assertAlmostEqual(tiled["scalar"].middle, 2 ** (1 / 3))
        self.assertAlmostEqual(tiled["simd"].middle, 4 * 2 ** (1 / 3))

    def test_a_point_of_the_chart_has_a_methods_wrong_pixels_and_its_speed(self):
        found = self.accuracy(a=(self.timed("x", 1.0), replace(self.timed("y", 2.0), seen=(5, 0))))
        self.assertEqual(wrong_of(found, found.methods["coverage"][1]).rate, 5.0)  # pixels: its rate of samples is 0
        points = {method.name: (wrong, up.middle) for method, (wrong, up, _) in points_of(frontier_figures(found)[0], found, "simd").items()}
        self.assertEqual(points, {"x": (0.0, 4.0), "y": (5.0, 2.0)})


def question(name, *answers, needed):
    """Answers before the needed one are not enough; None: none is."""
    at = answers.index(needed) if needed else len(answers)
    return {"question": name, "answer": needed, "proven": False, "error": "wrong pixel", "answers": [
        {"answer": a, "enough": i >= at, **({} if i >= at else {"witness": {"wrong_px": 1 + i, "frame": 7}})}
        for i, a in enumerate(answers)]}


def entry(scene, near="nothing", facing="normal_z", visibility="submission_order", others=()):
    planes = [question("near plane", "nothing", "drop whole triangles", "clip", needed=near),
              question("far plane", "nothing", "clip", needed="nothing"), question("guard band", "nothing", "clip", needed="nothing")]
    rest = [question("visibility", "submission_order", "painter_mean", "depth buffer", needed=visibility),
            question("subpixel bits", "7 bits", "8 bits", needed="8 bits")]
    tests = "normal_z", "normal_dot_eye", "snapped_area"
    return {"scene": scene, "frames": 3,
            # As a whole, it needs a facing test that is right where the order of submission decides.
            "pipeline": {"stages": [*planes, question("facing test", *tests, needed="normal_dot_eye"), *rest],
                         "orders": 6, "others": list(others)},
            "alone": [*planes, question("facing test", *tests, needed=facing), *rest,
                      question("float depth buffer", "float_z", "reversed_z", needed="float_z")],
            "edges": [question("subpixel bits: no crack, no fold", "0 bits", "1 bit", needed="1 bit"),
                      question("subpixel bits, no worse than 8 bits", "8 bits", needed="8 bits"),
                      question("float edges without a crack", "float_lt", "float_le", "double_top_left", needed="double_top_left"),
                      question("edge values at 8 subpixel bits", "32-bit integers", needed="32-bit integers")]}


class InstructionsTest(FolderTest):
    def told(self, counts):
        return instructions_sentence(self.file("instructions.json", json.dumps(counts)))

    def test_the_second_count_of_a_frame_counts(self):
        counts = read_counts(["9000 cube scalar frontend", "4000 cube scalar frontend", "1000 cube neon frontend", "3000000 cube scalar tiled",
                              "2000000 cube neon tiled", "9000 cube scalar scanline", "10000 cube neon scanline"])
        self.assertEqual(self.told(counts), "Instructions of scalar code over those of NEON code: 4.0× in the front end, 0.90× in `scanline`, 1.5× in `tiled`.")

    def test_what_is_not_a_count_is_refused(self):
        with self.assertRaises(BadInput):
            self.told({"cube": {"frontend": {"scalar": 1}}})


def compared_packages(**peers):
    """One picture; of each peer: its speed-down on both numbers of threads, and how many ids differ."""
    def times(ms):
        return {str(threads): {job: [factor * ms * noise for noise in NOISE * 2] for job, factor in (("draw", 1 / threads), ("redraw", 0.5), ("load", 9))}
                for threads in (1, 2)}

    return {"commit": "abc", "versions": {"edgewise": "Edgewise", **{peer: f"{peer} 1" for peer in peers}}, "pictures": [
        {"mesh": "hill", "triangles": 2000, "size": [640, 480], "covered": 5000,
         "peers": {peer: {"differ": differ, "holes": 2, "farthest_px": 0.00212, "ours_hold": 1, "theirs_hold": 3, "distance_p99": 1.23e-7}
                   for peer, (_, differ) in peers.items()},
         "ms": {"edgewise": times(2.0), **{peer: times(2.0 * slower) for peer, (slower, _) in peers.items()}}}]}


class PythonTest(FolderTest):
    def read(self, data, machine="mine"):
        self.file(f"results/{machine}/python.json", json.dumps(data))
        return read_python(self.folder / "results/mine")

    def test_each_peer_has_a_line(self):
        lines = python_lines(self.read(compared_packages(vtk=(4.0, 0), moderngl=(0.5, 1234)))).splitlines()
        self.assertEqual(lines[0], "- Against vtk 1, a draw is 4.0× faster in 1 of 1 scene; a draw into the last arrays is 4.0× faster in 1 of 1 scene; "
                                   "load and draw is 4.0× faster in 1 of 1 scene. Of 5k pixels 0 show another triangle, 2 of them a hole.")
        self.assertTrue(lines[1].startswith("- Against moderngl 1, a draw is 2.0× slower in 1 of 1 scene; "))
        self.assertEqual(lines[-1], "On 2 threads; `mine`, commit abc. A scene is a mesh at one size.")

    def test_nothing_is_said_of_nothing_and_what_is_no_result_is_refused(self):
        self.assertEqual(python_lines(read_python(self.folder / "results/mine")), "No other Python package was measured here; `scripts/run --peers` does.")
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

    def test_a_line_is_a_pipeline_that_was_drawn_as_a_whole(self):
        other = {**dict.fromkeys(("near plane", "far plane", "guard band"), "nothing"), "facing test": "normal_z", "visibility": "depth buffer", "depth buffer": "6 bits",
                 "subpixel bits": "8 bits"}
        stream = {**entry("grid"), "pipeline": {"stages": [question("visibility", "submission_order", needed="submission_order")],
                                                "orders": 1, "others": []}}
        timed = bench({"needs/cube/pipeline:least/threads:1": 2.0, "needs/cube/pipeline:exact/threads:1": 4.0,
                       "needs/terrain/pipeline:least/threads:1": 4.02, "needs/terrain/pipeline:exact/threads:1": 4.0})
        wrong = {**entry("cubes"), "pipeline": {"stages": [question("pipeline", "the exact one", needed=None)], "orders": 0, "others": []}}
        header, lines = pipelines_table(self.read(entry("cube", others=[other]), entry("terrain", near="clip"), stream, wrong), timed)
        self.assertEqual([len(line) for line in lines], [len(header)] * 4)
        self.assertEqual(lines, [["cube (3 frames)", "nothing", "`normal_dot_eye`", "`submission_order`", "–", "8", "2.0×",
                                  "`normal_z`, depth buffer of 6 bits"],
                                 ["terrain (3 frames)", "clip at the near plane", "`normal_dot_eye`", "`submission_order`", "–", "8",
                                  "1.00× slower (not settled)", "–"],
                                 ["grid (3 frames)", "–", "–", "`submission_order`", "–", "–", "–", "–"],
                                 ["cubes (3 frames)", "–", "–", "–", "–", "–", "–", "none is enough: the exact one draws 1 wrong px in frame 7"]])

    def test_edges_have_a_line_per_question(self):
        self.assertEqual(dict(edges_table(self.read(entry("cube"), entry("sphere")))[1]), {
            title: f"{said}: cube (3 frames), sphere (3 frames)" for title, said in
            {"no crack or fold": "1 bit", "no worse than 8 bits": "8 bits", "float depth": "`float_z`", "edge values": "32-bit integers"}.items()})

    def test_tutorials_have_more_than_needed_or_less(self):
        _, lines = tutorials_table(self.read(entry("cube"), entry("cubes", near="clip", facing="normal_dot_eye",
                                                                 visibility="depth buffer")))
        said = {(engine, stage): verdicts for engine, stage, _, *verdicts in lines}
        self.assertEqual(said["p5.js engine", "near plane"], ["more than needed: nothing", "enough"])
        self.assertEqual(said["p5.js engine", "visibility"],
                         ["more than needed: `submission_order`", "**not enough**: 2 wrong pixels in frame 7"])
        self.assertEqual(said["Outlaw Triad trainer", "facing test"], ["enough", "**not enough**: 1 wrong pixel in frame 7"])
        self.assertEqual(said["Outlaw Triad trainer", "near plane"], ["enough", "**not enough**: 1 wrong pixel in frame 7"])

    def test_stages_of_a_wrong_exact_pipeline_are_compared_with_it(self):
        wrong = {**entry("cubes"), "alone": [question("near plane", "nothing", "clip", needed=None)]}
        said = {engine: verdict for engine, stage, _, verdict in tutorials_table(self.read(wrong))[1] if stage == "near plane"}
        self.assertEqual(said, {"Outlaw Triad trainer": "**not enough**: 1 wrong pixel in frame 7",
                                "p5.js engine": "as wrong as the exact one: 2 wrong pixels in frame 7"})

    def test_an_answer_before_the_needed_one_may_be_enough(self):
        found = self.read(entry("cube"))
        found["cube"][1]["facing test"]["answers"][0] = {"answer": "normal_z", "enough": True}
        said = {(engine, stage): verdict for engine, stage, _, verdict in tutorials_table(found)[1]}
        self.assertEqual(said["Outlaw Triad trainer", "facing test"], "enough")

    def test_an_answer_that_no_longer_exists_is_refused(self):
        found = self.read(entry("cube"))
        found["cube"][1]["visibility"]["answers"].clear()
        with self.assertRaises(BadInput):
            tutorials_table(found)


if __name__ == "__main__":
    unittest.main()
