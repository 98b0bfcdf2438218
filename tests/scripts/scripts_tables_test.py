"""The tables of results: each figure, its condition, and whether it is settled; and what scenes need: from data made here."""
import json
import re
import sys
import unittest
from dataclasses import replace

from support import ROOT, SCRIPTS, FolderTest

sys.path.insert(0, str(SCRIPTS / "reporting"))
from accuracy_rows import Accuracy, Measured, Method, Pooled, Scene, parse_accuracy, read_accuracy  # noqa: E402
from bench_rows import Bench, parse_name  # noqa: E402
from bench_tables import engine_table, peer_lines, speed_table  # noqa: E402
from choice import choice_table, parse_choices  # noqa: E402
from facts_tables import depth_table, edges_table, method_times, pipelines_table, read_needs, tutorials_table  # noqa: E402
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
        data = {"methods": [{"family": "facing", "name": name, "source": "", "promise": "", "exact": True} for name in ("m", "naive", "untimed")],
                "scenes": [{"name": "s", "family": "facing", "covered": 500, "triangles": 20, "kind": "meshes",
                            "methods": [{"name": name, "source": score, "snapped": score} for name in ("m", "naive", "untimed")]}]}
        rows = {"lab/s/family:facing/method:m/simd:scalar/threads:1": 4.0, "lab/s/family:facing/method:m/simd:scalar/threads:2": 3.0,
                "lab/s/family:facing/method:m/simd:avx512/threads:1": 2.0, "lab/s/family:facing/method:m/simd:avx512/threads:2": 1.0,
                "lab/s/family:facing/method:naive/simd:scalar/threads:1": 4.0, "lab/t/family:facing/method:naive/simd:scalar/threads:2": 1.0,
                "lab/s/family:facing/method:untimed/simd:scalar/threads:1": 1.0}
        timed = bench(rows)
        for name, row in timed.rows.items():
            row.counters["triangles"] = 20.0 if "untimed" not in name else 19.0  # a smaller scene of the same name
        self.assertEqual(timed.scenes, [])
        both, naive, untimed = parse_accuracy(data, timed).scenes[0].measured
        self.assertEqual([form and form.median_ms for form in (both.scalar, both.simd, naive.scalar, naive.simd, untimed.scalar)], [4.0, 2.0, 4.0, None, None])

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


class ChoiceTest(unittest.TestCase):
    """choice.py: each method's wrong pixels in a picture, and that picture's time."""

    @staticmethod
    def panel(name, **methods):
        """From (wrong pixels, least, most, holes) of each method, in 4 frames."""
        return {"name": name, "summary": name, "frames": 4, "methods": [
            {"name": method, **dict(zip(("wrong_pixels", "least", "most", "holes"), counts))} for method, counts in methods.items()]}

    @staticmethod
    def timed(**times_ms):
        return bench({f"choice/{name}/threads:1": ms for name, ms in times_ms.items()})

    def test_a_point_has_a_methods_wrong_pixels_a_frame_and_its_time_in_the_same_run(self):
        [panel] = parse_choices([self.panel("a", tiled_8=(6, 0, 3, 0), float_lt=(8, 1, 4, 2), llvmpipe=(4, 1, 1, 0))])
        timed = self.timed(**{"a/method:float_lt": 2.0, "a/method:tiled_8": 1.0, "b/method:llvmpipe": 9.0})
        self.assertEqual([(point.method, *point.wrong, point.row.median_ms) for point in panel.points(timed)],
                         [("float_lt", 2.0, 1, 4, 2, 2.0), ("tiled_8", 1.5, 0, 3, 0, 1.0)])

    def test_the_table_has_a_line_for_each_method_and_holes_are_bold(self):
        panels = parse_choices([self.panel("a", tiled_8=(6, 0, 3, 0), float_lt=(8, 1, 4, 2)), self.panel("b", tiled_8=(0, 0, 0, 0))])
        timed = self.timed(**{"a/method:float_lt": 20.0, "a/method:tiled_8": 1.0, "b/method:tiled_8": 0.5})
        self.assertEqual(choice_table(Accuracy({}, (), None, choices=panels), timed),
                         (["method", "`a`", "`b`"], [["strict <", "**2 px**, 20.0 ms", "–"], ["tiled, 8 bits", "1.5 px, 1.00 ms", "0 px, 0.500 ms"]]))

    def test_methods_have_a_table_of_their_times(self):
        rows = bench({"x": 4.0, "y": 2.0}).rows
        timed = replace(measured("tiled", 0), forms={("scalar", 1): rows["x"], ("avx2", 1): rows["y"]})
        self.assertEqual(method_times(accuracy(timed)), (["method", "`mesh_on_grid`"], [["`tiled`", "4.00 / 2.00"]]))
        self.assertEqual(method_times(accuracy(measured("tiled", 0)))[1], [])


def question(name, *answers, needed):
    """Answers before the needed one are not enough; None: none is."""
    at = answers.index(needed) if needed else len(answers)
    return {"question": name, "answer": needed, "proven": False, "error": "wrong pixel", "answers": [
        {"answer": a, "enough": i >= at, **({} if i >= at else {"witness": {"wrong_px": 1 + i, "frame": 7}})}
        for i, a in enumerate(answers)]}


def curve(stage, *levels, enough):
    return {"stage": stage, "levels": [{"level": level, "enough": level in enough, "mean_px": 0.5, "worst_px": 0 if level in enough else 1 + i}
                                       for i, level in enumerate(levels)]}


def entry(scene, minima=(), **more):
    """Clipping at the near plane, a facing test by the eye, and a depth buffer are enough."""
    return {"scene": scene, "frames": 3, "minima": list(minima), **more,
            "curves": [curve("near plane", "nothing", "drop whole triangles", "clip", enough=("clip",)),
                       curve("facing test", "no test", "normal_z", "normal_dot_eye", "snapped_area", enough=("normal_dot_eye", "snapped_area")),
                       curve("visibility", "submission_order", "painter_mean", "depth buffer", enough=("painter_mean", "depth buffer")),
                       curve("depth buffer", "16 bits", "24 bits", "contract31", "float_z", "reversed_z", enough=("24 bits", "contract31"))],
            "edges": [question("subpixel bits: no crack, no fold", "0 bits", "1 bit", needed="1 bit"),
                      question("subpixel bits, no worse than 8 bits", "8 bits", needed="8 bits"),
                      question("edge values at 8 subpixel bits", "32-bit integers", needed="32-bit integers")]}


PIPELINE = {**dict.fromkeys(("near plane", "far plane", "guard band"), "nothing"), "facing test": "no test",
            "visibility": "painter_mean", "subpixel bits": "6 bits"}


def compared_packages(**peers):
    """One picture; of each peer: its speed-down on both numbers of threads, and how many ids differ."""
    def times(ms):
        return {str(threads): {job: [factor * ms * noise for noise in NOISE * 2] for job, factor in (("draw", 1 / threads), ("redraw", 0.5), ("load", 9))}
                for threads in (1, 2)}

    return {"commit": "abc", "versions": {"edgewise": "Edgewise", **{peer: f"{peer} 1" for peer in peers}}, "pictures": [
        {"mesh": "hill", "triangles": 2000, "size": [640, 480], "covered": 5000,
         "peers": {peer: {"differ": differ, "holes": 2, "distance_p99": 1.23e-7} for peer, (_, differ) in peers.items()},
         "ms": {"edgewise": times(2.0), **{peer: times(2.0 * slower) for peer, (slower, _) in peers.items()}}}]}


class PythonTest(FolderTest):
    def read(self, data, machine="mine"):
        self.file(f"results/{machine}/python.json", json.dumps(data))
        return read_python(self.folder / "results/mine")

    def test_each_peer_has_a_line(self):
        lines = python_lines(self.read(compared_packages(vtk=(4.0, 0), moderngl=(0.5, 1234)))).splitlines()
        self.assertEqual(lines[0], "- Against vtk 1, a draw into new arrays is 4.0× faster in 1 of 1 scene; "
                                   "a draw into reused arrays is 4.0× faster in 1 of 1 scene; "
                                   "load and draw is 4.0× faster in 1 of 1 scene. Of 5k pixels 0 show another triangle, 2 of them a hole.")
        self.assertTrue(lines[1].startswith("- Against moderngl 1, a draw into new arrays is 2.0× slower in 1 of 1 scene; "))
        self.assertEqual(lines[-1], "On 2 threads; `mine`, commit abc. A scene is a mesh at one size.")

    def test_an_older_file_reuses_no_arrays(self):
        data = json.dumps(compared_packages(vtk=(4.0, 0), moderngl=(0.5, 1234))).replace("redraw", "unknown")
        self.assertNotIn("reused", python_lines(self.read(json.loads(data))))

    def test_nothing_is_said_of_nothing_and_what_is_no_result_is_refused(self):
        self.assertEqual(python_lines(read_python(self.folder / "results/mine")), "No other Python package was measured here; `scripts/run --full --peers` does.")
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
        header, lines = pipelines_table(self.read(entry("cube", [PIPELINE, depth, {**PIPELINE, "facing test": "normal_z"}]), entry("grid", [stream]),
                                                  entry("cubes", closest={"levels": PIPELINE, "worst_px": 1234})), timed)
        self.assertEqual(lines, [["cube (3 frames)", "clip at the near plane", "no test", "depth buffer", "6 bits", "1", "2.0×"],
                                 ["cube (3 frames)", "nothing", "no test or `normal_z`", "`painter_mean`", "–", "6", "1.00× (not settled)"],
                                 ["grid (3 frames)", "–", "–", "`submission_order`", "–", "0", "–"],
                                 ["cubes (3 frames)", "nothing", "no test", "`painter_mean`", "–", "6", "not right: 1,234 wrong px in a frame"]])
        self.assertEqual(len(header), 7)

    def test_edges_have_a_line_per_question(self):
        self.assertEqual(dict(edges_table(self.read(entry("cube", [PIPELINE]), entry("sphere", [PIPELINE])))[1]), {
            title: f"{said}: cube (3 frames), sphere (3 frames)" for title, said in
            {"no crack or fold": "1 bit", "no worse than 8 bits": "8 bits", "edge values": "32-bit integers"}.items()})

    def test_scenes_of_the_same_depth_formats_share_a_line(self):
        self.assertEqual(depth_table(self.read(entry("cube", [PIPELINE], near_z=0.1, far_z=100), *(entry(name, [PIPELINE]) for name in ("grid", "quads"))))[1], [
            ["cube (3 frames)", "0.1", "100", "1 wrong px", "enough", "4 wrong px", "5 wrong px", "enough"],
            ["grid (3 frames), quads (3 frames)", "–", "–", "1 wrong px", "enough", "4 wrong px", "5 wrong px", "enough"]])

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
