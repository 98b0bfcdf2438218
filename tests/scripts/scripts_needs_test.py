"""needs.py: what scenes need, and what the tutorials' engines lack, from data made here."""
import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/reporting"))
from bench_rows import BadInput  # noqa: E402
from needs import cube_sentence, needs_table, read_needs, speed_up, tutorials_table  # noqa: E402


def question(name, *answers, cheapest):
    """Answers before the cheapest are not enough."""
    at = answers.index(cheapest)
    return {"question": name, "answer": cheapest, "proven": False, "error": "wrong pixel", "answers": [
        {"answer": a, "enough": i >= at, **({} if i >= at else {"witness": {"wrong_px": 1 + i, "frame": 7}})}
        for i, a in enumerate(answers)]}


def entry(scene, near="nothing", facing="normal_z", visibility="submission_order", median=2.0):
    return {"scene": scene, "frames": 3, "smallest": {"pipeline": "4 subpixel bits", "wrong_px": 1, "full_wrong_px": 1234,
                         "speedup": {"median": median, "low": median - 0.1, "high": median + 0.1, "settled": abs(median - 1) > 0.2}},
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


class Needs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def read(self, *entries):
        (self.folder / "needs.json").write_text(json.dumps(entries))
        return read_needs(self.folder)

    def test_nothing_is_said_of_nothing(self):
        self.assertEqual(read_needs(self.folder), {})
        self.assertEqual(cube_sentence({}), "")

    def test_what_is_not_a_result_is_refused(self):
        for text in ('[{"scene": "cube"}]', '[3]', '{"scene": 1}'):
            (self.folder / "needs.json").write_text(text)
            with self.assertRaises(BadInput):
                read_needs(self.folder)

    def test_each_scene_has_its_cheapest_answers(self):
        stream = {**entry("grid"), "questions": [question("visibility", "submission_order", cheapest="submission_order")]}
        header, lines = needs_table(self.read(entry("cube"), entry("terrain", near="clip", visibility="depth buffer"), stream))
        self.assertEqual([len(line) for line in lines], [len(header)] * 3)
        self.assertEqual(lines[0], ["cube, 3", "nothing", "`normal_z`", "`submission_order`", "2 bits", "1 bit", "8 bits",
                                    "32-bit integers", "2.00× faster (1.90 to 2.10)"])
        self.assertEqual(lines[1][1:4], ["near plane: clip", "`normal_z`", "depth buffer"])
        self.assertEqual(lines[2][1:5], ["–", "–", "`submission_order`", "–"])

    def test_a_speed_up_is_settled_or_not(self):
        self.assertEqual(speed_up(entry("a", median=0.5)), "2.00× slower (1.67 to 2.50)")
        self.assertEqual(speed_up(entry("a", median=1.05)), "no significant difference (0.95 to 1.15)")

    def test_tutorials_have_more_than_needed_or_less(self):
        _, lines = tutorials_table(self.read(entry("cube"), entry("cubes", near="clip", facing="normal_dot_eye",
                                                                 visibility="depth buffer")))
        said = {(engine, stage): verdicts for engine, stage, _, *verdicts in lines}
        self.assertEqual(said["p5.js engine", "near plane"], ["more than needed: nothing", "enough"])
        self.assertEqual(said["p5.js engine", "visibility"],
                         ["more than needed: `submission_order`", "**not enough**: 2 wrong pixels in frame 7"])
        self.assertEqual(said["Outlaw Triad trainer", "facing test"], ["enough", "**not enough**: 1 wrong pixel in frame 7"])
        self.assertEqual(said["Outlaw Triad trainer", "near plane"], ["enough", "**not enough**: 1 wrong pixel in frame 7"])

    def test_the_tutorials_cube_in_a_sentence(self):
        self.assertEqual(cube_sentence(self.read(entry("cube"))),
                         "Stage by stage, 3 frames of the tutorials' cube need no clipping, `normal_z` to cull, `submission_order`, and 1 bit "
                         "of subpixel precision against cracks. On one thread, plain code with 4 subpixel bits is 2.00× faster (1.90 to "
                         "2.10) than with 64-bit edges and 30-bit depth.")

    def test_an_answer_that_no_longer_exists_is_refused(self):
        found = self.read(entry("cube"))
        found["cube"][1]["visibility"]["answers"].clear()
        with self.assertRaises(BadInput):
            tutorials_table(found)


if __name__ == "__main__":
    unittest.main()
