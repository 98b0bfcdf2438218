"""claims.py: README's claims hold on the committed results, and a claim that does not hold is found."""
import unittest

import support  # noqa: F401 finds claims
import claims


class ClaimsTest(unittest.TestCase):
    def test_hold_on_every_machine(self):
        self.assertEqual(claims.check(), 0)

    def test_faults_are_found(self):
        says, bounds = "A second core makes frames `1.9×` faster.", {"median(x)": [1.85, 1.95]}
        page = claims.plain("A second core makes\nframes [1.9×](results) faster.")
        good, bad = {"median(x)": 1.9}, {"median(x)": 1.96}
        for says, found, *fault in ((says, {"a": good, "b": good}), (says, {"a": good, "b": bad}, "b: median(x) is 1.96, not in [1.85, 1.95]"),
                                    (says, {"a": good}, "can be evaluated on a, not on a, b"),
                                    ("A second core doubles the speed.", {"a": good, "b": good}, "is not in README.md")):
            self.assertEqual(list(claims.faults({"says": says, "bounds": bounds, "of": ["a", "b"]}, found, page)), fault)

    def test_a_sentence_without_a_claim_is_found(self):
        section = "- **SIMD.** On a Zen 3, it is [2×](results) faster. Then it is 3× slower.\n- No figure. Use 1/256 px."
        self.assertEqual(claims.unclaimed(section, [{"says": "On a Zen 3, it is 2× faster."}]), ["Then it is 3× slower."])


if __name__ == "__main__":
    unittest.main()
