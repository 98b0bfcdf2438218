"""The tables of results where the committed ones don't show a case; scripts_test.py has the READMEs."""
import json
import unittest

from support import FolderTest
from bench_rows import Bench, parse_name
from bench_tables import peer_lines, speed_table
from facts_tables import pipelines_table
from python_tables import python_lines

NOISE = (0.99, 1.0, 1.01, 0.995, 1.005)


def bench(times_ms, **context):
    """From {row's name: milliseconds}."""
    rows = {name: parse_name(name) for name in times_ms}
    for name, row in rows.items():
        row.times_ms = [times_ms[name] * noise for noise in NOISE]
        row.counters = {"triangles": 4.0, "overdraw": 2.0}
    return Bench({"backends": "scanline naive tiled", "simd_target": "avx512", **context}, rows)


class TablesTest(unittest.TestCase):
    def test_a_gpu_has_one_row_a_scene(self):
        told = bench({"tiled+frontend/a/threads:2": 2.0, "tiled+frontend/a/threads:1": 4.0, "gpu+frontend/a/threads:1": 1.0}, peers="gpu")
        self.assertIn("4.0× slower in 1 of 1 scene on 1 thread; 2.0× slower in 1 of 1 scene on 2 threads", peer_lines(told))
        self.assertEqual(speed_table(told)[1][0][-1], "1.00")

    def test_of_several_pipelines_the_fastest_is_told(self):
        levels = {"near plane": "nothing", "facing test": "no test", "subpixel bits": "6 bits"}
        minima = [{**levels, "visibility": visibility} for visibility in ("painter_mean", "depth buffer", "submission_order")]
        timed = {f"needs/cube/pipeline:{which}/threads:1": ms for which, ms in (("exact", 4.0), (1, 4.0), (2, 2.0), (3, 3.0))}
        for rows, *told in ((timed, "depth buffer", "2.0×"), ({}, "`submission_order`", "–")):
            [line] = pipelines_table({"cube": ({"minima": minima}, {})}, bench(rows))[1]
            self.assertEqual([line[3], line[-1]], told)


class PythonTest(FolderTest):
    def test_each_peer_has_a_line(self):
        def times(ms):
            jobs = {job: [factor * ms * noise for noise in NOISE * 2] for job, factor in (("draw", 1.0), ("redraw", 0.5), ("load", 9.0))}
            return {"2": jobs}

        data = {"commit": "abc", "versions": {"vtk": "VTK 9", "moderngl": "ModernGL 5"}, "pictures": [
            {"mesh": "hill", "covered": 5000, "peers": {"vtk": {"differ": 0, "holes": 2}, "moderngl": {"differ": 1234, "holes": 0}},
             "ms": {"edgewise": times(2.0), "vtk": times(8.0), "moderngl": times(1.0)}}]}
        path = self.file("results/mine/python.json", json.dumps(data))
        vtk, moderngl, _, source = python_lines(path.parent).splitlines()
        self.assertEqual(vtk, "- Against VTK 9, a draw into new arrays is 4.0× faster in 1 of 1 scene; "
                              "a draw into reused arrays is 4.0× faster in 1 of 1 scene; load and draw is 4.0× faster in 1 of 1 scene. "
                              "Of 5k pixels 0 show another triangle, 2 of them a hole.")
        self.assertTrue(moderngl.startswith("- Against ModernGL 5, a draw into new arrays is 2.0× slower in 1 of 1 scene; "))
        self.assertEqual(source, "On 2 threads; `mine`, commit abc. A scene is a mesh at one size.")


if __name__ == "__main__":
    unittest.main()
