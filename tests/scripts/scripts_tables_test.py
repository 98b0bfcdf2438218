"""The tables of results where the committed ones don't show a case; scripts_test.py has the READMEs."""
import json
import unittest

from support import FolderTest
from bench_rows import Bench, parse_name
from bench_tables import peer_lines, speed_table
from facts_tables import pipelines_table
from program import BadInput
from python_tables import python_lines, read_python

NOISE = (0.99, 1.0, 1.01, 0.995, 1.005)


def bench(times_ms, **context):
    """From {row's name: milliseconds}."""
    rows = {name: parse_name(name) for name in times_ms}
    for name, row in rows.items():
        row.times_ms = [times_ms[name] * noise for noise in NOISE]
        row.counters = {"covered_px": 20.0, "triangles": 4.0, "overdraw": 2.0}
    return Bench({"backends": "scanline naive tiled", "simd_target": "avx512", **context}, rows)


class TablesTest(unittest.TestCase):
    def test_a_gpu_has_one_row_a_scene(self):
        told = bench({"tiled+frontend/a/threads:2": 2.0, "tiled+frontend/a/threads:1": 4.0, "gpu+frontend/a/threads:1": 1.0}, peers="gpu", gpu="a GPU")
        self.assertIn("4.0× slower in 1 of 1 scene on 1 thread; 2.0× slower in 1 of 1 scene on 2 threads", peer_lines(told))
        self.assertEqual(speed_table(told)[1][0][-1], "1.00")

    def test_of_several_pipelines_the_fastest_is_told(self):
        levels = {"near plane": "nothing", "facing test": "no test", "subpixel bits": "6 bits"}
        minima = [{**levels, "visibility": visibility} for visibility in ("painter_mean", "depth buffer", "submission_order")]
        needs = {"cube": ({"minima": minima}, {})}
        timed = {"needs/cube/pipeline:exact/threads:1": 4.0, "needs/cube/pipeline:1/threads:1": 4.0, "needs/cube/pipeline:2/threads:1": 2.0,
                 "needs/cube/pipeline:3/threads:1": 3.0}
        for rows, *told in ((timed, "depth buffer", "2.0×"), ({}, "`submission_order`", "–")):
            [line] = pipelines_table(needs, bench(rows))[1]
            self.assertEqual([line[3], line[-1]], told)


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

    def test_nothing_is_said_of_nothing_and_what_is_no_result_is_refused(self):
        self.assertEqual(python_lines(read_python(self.folder / "results/mine")), "No other Python package was measured here; `scripts/run --full --peers` does.")
        for data in ([], {"versions": {}, "pictures": [{}]}, compared_packages(vtk=(1.0, 0)), compared_packages(vtk=(1.0, 0), moderngl=(1.0, -1))):
            with self.assertRaises(BadInput):
                self.read(data)


if __name__ == "__main__":
    unittest.main()
