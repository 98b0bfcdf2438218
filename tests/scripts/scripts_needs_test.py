"""needs.py: what scenes need, and what the tutorials' engines lack, from data made here."""
import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts/reporting"))
from bench_rows import BadInput  # noqa: E402
from needs import needs_table, read_needs, tutorials_table  # noqa: E402


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
        self.assertEqual(tutorials_table({})[1], [])

    def test_what_is_not_a_result_is_refused(self):
        for text in ('[{"scene": "cube"}]', '[3]', '{"scene": 1}'):
            (self.folder / "needs.json").write_text(text)
            with self.assertRaises(BadInput):
                read_needs(self.folder)

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
