"""claims.py: README's claims hold on the committed results, and a claim that does not hold is found."""
import unittest

from support import ROOT
import claims


class ClaimsTest(unittest.TestCase):
    def test_hold_on_every_machine(self):
        self.assertEqual(claims.check(), 0)

    def test_faults_are_found(self):
        says, bounds = "A second core makes frames `1.9×` faster.", {"median(scaling('tiled', 2))": [1.85, 1.95]}
        page = claims.plain("A second core makes\nframes [1.9×](results) faster.")

        def found(claim, values):
            return list(claims.faults({"says": says, "bounds": bounds, "of": ["a", "b"]} | claim, values, page))

        good, bad = ({expression: value for expression in bounds} for value in (1.9, 1.96))
        self.assertEqual(found({}, {"a": good, "b": good}), [])
        self.assertIn("b: median", *found({}, {"a": good, "b": bad}))
        self.assertIn("timed on a, not on a, b", *found({}, {"a": good}))
        self.assertIn("not on one that it names", *found({"of": []}, {"a": good}))
        self.assertIn("not in README", *found({"says": "A second core doubles the speed."}, {"a": good, "b": good}))

    def test_a_sentence_without_a_claim_is_found(self):
        section = "- **SIMD.** On a Zen 3, it is [2×](results) faster. Then it is 3× slower.\n- No figure. Use 1/256 px."
        self.assertEqual(claims.unclaimed(section, [{"says": "On a Zen 3, it is 2× faster."}]), ["Then it is 3× slower."])

    def test_a_folder_without_rows_does_not_count(self):
        claim = {"of": [], "bounds": {"max(ratios('swiftshader', 'tiled', 2))": [0, 99]}}
        self.assertEqual(list(claims.evaluated(claim, ROOT / "results")),
                         ["amd-epyc-family-26-model-2-2-cores"])


if __name__ == "__main__":
    unittest.main()
