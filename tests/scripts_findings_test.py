"""findings.py: the sentences of README's first screen, from figures made here."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scripts"))
from accuracy_rows import Accuracy, Cost, Measured, Method, Scene  # noqa: E402
from bench_rows import Bench, parse_name  # noqa: E402
from findings import accuracy_finding, findings, peer_finding, speed_finding  # noqa: E402


def bench(times_ms, **context):
    """From {row's name: milliseconds}."""
    rows = {name: parse_name(name) for name in times_ms}
    for name, row in rows.items():
        row.times_ms = [times_ms[name]]
    return Bench({"backends": "scanline naive tiled", **context}, rows)


def scene(name, scanline, naive, tiled):
    return {f"{backend}/{name}/threads:2": ms
            for backend, ms in (("scanline", scanline), ("naive", naive), ("tiled", tiled))}


def measured(name, exact, rate, ns):
    return Measured(Method(name, "src/raster" if exact else "a book", "", exact), rate, None, rate,
                    {1: Cost(ns, ns, ns, 1.0)}, 0)


def accuracy(*methods):
    return Accuracy({}, False, {}, (Scene("mesh_on_grid", "coverage", "", 1000, methods),), None)


class FindingsTest(unittest.TestCase):
    def test_who_wins_how_often_and_by_how_much_at_most(self):
        text = speed_finding(bench({**scene("a", 2.0, 8.0, 1.0), **scene("b", 3.0, 4.0, 2.0), **scene("c", 1.0, 5.0, 4.0)}))
        self.assertIn("faster on 2 of 3 scenes, by 2.00× at most (`a`)", text)
        self.assertIn("`scanline` on the others, by 4.00× at most (`c`)", text)
        self.assertIn("takes 2.00× to 8.00× as long", text)

    def test_who_always_wins_leaves_no_others(self):
        self.assertNotIn("others", speed_finding(bench(scene("a", 2.0, 8.0, 1.0))))
        self.assertNotIn("by", speed_finding(bench(scene("a", 1.0, 8.0, 2.0))).split(";")[0])

    def test_scenes_that_not_all_drew_do_not_count(self):
        self.assertEqual(speed_finding(bench({"tiled/a/threads:2": 1.0})), "")

    def test_errors_of_the_tutorials_tests_beside_ours(self):
        text = accuracy_finding(accuracy(measured("tiled", True, 0, 3.0), measured("float_lt", False, 5710, 2.0)))
        self.assertIn("get 5,710 (`float_lt`) pixels wrong; `tiled` 0.", text)
        self.assertIn("takes 1.50 times as long as the fastest of the others, `float_lt`", text)

    def test_peers_ratios_are_told_from_least_to_most(self):
        rows = {**scene("a", 2.0, 8.0, 1.0), **scene("b", 1.0, 5.0, 4.0), "ext/a/threads:2": 8.0, "ext/b/threads:2": 30.0}
        self.assertIn("takes 8.00× to 30.0× as long on 2 threads (19.0× in the median of 2 scenes)",
                      peer_finding(bench(rows, peers="ext")))
        self.assertEqual(peer_finding(bench(scene("a", 2.0, 8.0, 1.0))), "")

    def test_what_was_not_measured_is_not_found(self):
        self.assertEqual(findings(bench({}), Accuracy({}, False, {}, (), None)), [])


if __name__ == "__main__":
    unittest.main()
