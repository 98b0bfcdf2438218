"""scripts/prove and scripts/checks/proofs.py, on claims made here."""
import shutil
import sys
import unittest

from support import SCRIPTS, FolderTest, read, run

DEFINITIONS = "(define-const kFineBits Int 15) ; = kFineBits of src/edgewise/contract.h\n"
INTRODUCTION = "; Numbers.\n(declare-const v Int)\n"
EVEN = ";; claim even: Twice a number\n;;   is even.\n"
CLAIM = f"{EVEN}(assert (not (= (mod (* 2 v) 2) 0)))\n"
WEAKENED = ";; weakened even: So is thrice.\n(assert (not (= (mod (* 3 v) 2) 0)))\n"
HARD = """(declare-const x Int) (declare-const y Int) (declare-const z Int)
(assert (and (> x 2) (> y 2) (> z 2) (= (+ (* x x x x x) (* y y y y y)) (* z z z z z))))
"""


class ProveTest(FolderTest):
    def prove(self, claims, *arguments, definitions=DEFINITIONS, **environment):
        self.file("contract.smt2", definitions)
        self.file("numbers.smt2", INTRODUCTION + claims)
        return run(SCRIPTS / "prove", "--folder", self.folder, *arguments, **environment)

    @unittest.skipUnless(shutil.which("z3"), "z3 is not installed")
    def test_a_claim_is_proven_where_its_premises_can_hold_and_its_weakened_form_is_refuted(self):
        counted = ("claims", "proven", "premises_hold", "refuted", "constants_compared")
        impossible = CLAIM.replace("(assert", "(assert (and (< v 0) (> v 0)))\n(assert", 1)
        for claims, said, *counts in ((CLAIM + WEAKENED, "proven", 1, 1, 1, 1, 1),
                                      (CLAIM.replace("(* 2 v)", "(* 5 v)") + WEAKENED, "FALSE", 1, 0, 1, 1, 1),
                                      (EVEN + HARD + WEAKENED, "UNDECIDED", 1, 0, 1, 1, 1),
                                      (impossible + WEAKENED, "EMPTY", 1, 1, 0, 1, 1),
                                      (CLAIM + WEAKENED.replace("(* 3 v)", "(* 4 v)"), "HOLDS", 1, 1, 1, 0, 1)):
            result = self.prove(claims, "--time-limit", 1, "--json", self.folder / "out.json")
            self.assertEqual(result.returncode, 0 if counts == [1] * 5 else 1, result.stdout + result.stderr)
            self.assertIn(said, result.stdout)
            written = read(self.folder / "out.json")
            self.assertEqual([written[key] for key in counted], counts)

    @unittest.skipUnless(shutil.which("z3"), "z3 is not installed")
    def test_a_mistake_in_a_file_is_told(self):
        for claims, told in ((EVEN + WEAKENED, "numbers.smt2: claim even asserts nothing"),
                             (CLAIM.replace("mod", "mood") + WEAKENED, "numbers.smt2: claim even: the solver says (error"),
                             (CLAIM, "claim even has no deliberately false variant"),
                             (WEAKENED, "even has a false variant, but no claim"),
                             (CLAIM + CLAIM + WEAKENED, "even occurs twice as claim")):
            self.fails(self.prove(claims), f"prove: {told}")

    def test_a_constant_that_drifts_from_its_source_is_refused(self):
        for old, new, told in (("Int 15", "Int 14", "kFineBits is 14 in the proofs, but kFineBits of src/edgewise/contract.h is 15"),
                               ("contract.h", "gone.h", "kFineBits is said to be kFineBits of src/edgewise/gone.h, which is not there")):
            self.fails(self.prove(CLAIM + WEAKENED, definitions=DEFINITIONS.replace(old, new)), f"prove: {told}\n")

    def test_without_a_solver_it_says_so(self):
        self.tool("python3", f'#!/bin/sh\nexec {sys.executable} "$@"\n')
        result = self.prove(CLAIM + WEAKENED, PATH=f"{self.folder}/tools")
        self.assertEqual(result.returncode, 77)
        self.assertIn("z3 is not installed", result.stderr)


if __name__ == "__main__":
    unittest.main()
