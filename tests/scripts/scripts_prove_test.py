"""scripts/prove and scripts/checks/proofs.py, on claims made here."""
import json
import shutil
import sys
import unittest

from support import ROOT, SCRIPTS, FolderTest, run
from program import BadInput
from proofs import check_constants, constant_of, read_sections

DEFINITIONS = "(define-const kFineBits Int 15) ; = kFineBits of src/edgewise/contract.h\n"
CLAIM = ";; claim even: Twice a number\n;;   is even.\n(assert (not (= (mod (* 2 v) 2) 0)))\n"
WEAKENED = ";; weakened even: So is thrice.\n(assert (not (= (mod (* 3 v) 2) 0)))\n"
INTRODUCTION = "; Numbers.\n(declare-const v Int)\n"


class ClaimsTest(FolderTest):
    def setUp(self):
        super().setUp()
        self.claim(CLAIM + WEAKENED)

    def claim(self, claims, definitions=DEFINITIONS):
        self.file("contract.smt2", definitions)
        self.file("numbers.smt2", INTRODUCTION + claims)

    def run_prove(self, *arguments, **environment):
        return run(SCRIPTS / "prove", "--folder", self.folder, *arguments, **environment)


@unittest.skipUnless(shutil.which("z3"), "z3 is not installed")
class SolverTest(ClaimsTest):
    def test_proves_a_claim_and_refutes_its_weakened_form(self):
        result = self.run_prove("--json", self.folder / "out.json")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        written = json.loads((self.folder / "out.json").read_text())
        self.assertEqual([written[key] for key in ("claims", "proven", "premises_hold", "refuted")], [1, 1, 1, 1])

    def test_what_is_not_proven_fails(self):
        hard = ("(declare-const x Int) (declare-const y Int) (declare-const z Int)\n"
                "(assert (and (> x 2) (> y 2) (> z 2) (= (+ (* x x x x x) (* y y y y y)) (* z z z z z))))\n")
        for claims, said in ((CLAIM.replace("(* 2 v)", "(* 5 v)") + WEAKENED, "FALSE"), (CLAIM + WEAKENED.replace("(* 3 v)", "(* 4 v)"), "HOLDS"),
                             (CLAIM[:CLAIM.index("(assert")] + hard + WEAKENED, "UNDECIDED")):
            self.claim(claims)
            result = self.run_prove("--time-limit", 1)
            self.assertEqual(result.returncode, 1)
            self.assertIn(said, result.stdout)

    def test_a_claim_of_what_cannot_be_fails(self):
        impossible = "(assert (and (< v 0) (> v 0)))\n(assert (not"
        self.claim(CLAIM.replace("(assert (not", impossible) + WEAKENED)
        result = self.run_prove("--json", self.folder / "out.json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("EMPTY", result.stdout)
        written = json.loads((self.folder / "out.json").read_text())
        self.assertEqual((written["proven"], written["premises_hold"], written["refuted"]), (1, 0, 1))

    def test_a_mistake_in_a_file_is_told(self):
        for claim, told in ((CLAIM[:CLAIM.index("(assert")], "claim even asserts nothing\n"), (CLAIM.replace("mod", "mood"), "claim even: the solver says (error")):
            self.claim(claim + WEAKENED)
            result = self.run_prove()
            self.assertEqual(result.returncode, 2)
            self.assertIn(f"prove: numbers.smt2: {told}", result.stderr)


class ProveTest(ClaimsTest):
    def test_without_a_solver_it_says_so(self):
        tools = self.folder / "tools"
        tools.mkdir()
        (tools / "python3").symlink_to(sys.executable)
        result = self.run_prove(PATH=str(tools))
        self.assertEqual(result.returncode, 77)
        self.assertIn("z3 is not installed", result.stderr)

    def test_a_claim_without_a_weakened_form_is_refused(self):
        for claims, told in ((CLAIM, "claim even has no deliberately false variant"), (WEAKENED, "even has a false variant, but no claim"),
                             (CLAIM + CLAIM + WEAKENED, "even occurs twice")):
            self.claim(claims)
            with self.assertRaisesRegex(BadInput, told):
                read_sections(self.folder)

    def test_a_constant_that_drifts_from_its_source_is_refused(self):
        self.assertEqual(check_constants(self.folder, ROOT), 1)
        for old, new, told in (("Int 15", "Int 14", "kFineBits is 14 in the proofs, but kFineBits of src/edgewise/contract.h is 15"),
                               ("contract.h", "gone.h", "not there")):
            self.claim(CLAIM + WEAKENED, DEFINITIONS.replace(old, new))
            with self.assertRaisesRegex(BadInput, told):
                check_constants(self.folder, ROOT)

    def test_constants_are_computed_from_expressions(self):
        source = "constexpr int a = 3;\ninline constexpr std::int64_t b = std::int64_t{1} << a;\nconstexpr int c = (b - 1) / 2;"
        self.assertEqual([constant_of(name, source, "x.h") for name in "abc"], [3, 8, 3])
        with self.assertRaisesRegex(BadInput, "0 times"):
            constant_of("d", source, "x.h")
        with self.assertRaisesRegex(BadInput, "more than this reads"):
            constant_of("e", "constexpr int e = 1.5;", "x.h")

    def test_an_unknown_name_is_told(self):
        result = self.run_prove("--only", "odd")
        self.assertEqual((result.returncode, result.stderr),
                         (2, "prove: there is no claim odd; --list prints them\n"))


if __name__ == "__main__":
    unittest.main()
