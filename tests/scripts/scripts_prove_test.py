"""scripts/prove and scripts/checks/proofs.py, on claims made here."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts" / folder) for folder in ("reporting", "checks")]
from program import BadInput  # noqa: E402
from proofs import check_constants, constant_of, read_sections  # noqa: E402

PROVE = ROOT / "scripts/prove"
DEFINITIONS = "(define-const kSub Int 256) ; = kSub of src/edgewise/contract.h\n"
CLAIM = ";; claim even: Twice a number\n;;   is even.\n(assert (not (= (mod (* 2 v) 2) 0)))\n"
WEAKENED = ";; weakened even: So is thrice.\n(assert (not (= (mod (* 3 v) 2) 0)))\n"
INTRODUCTION = "; Numbers.\n(declare-const v Int)\n"


class ProveTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.write(CLAIM + WEAKENED)

    def write(self, claims, definitions=DEFINITIONS):
        (self.folder / "contract.smt2").write_text(definitions)
        (self.folder / "numbers.smt2").write_text(INTRODUCTION + claims)

    def run_prove(self, *arguments, **environment):
        return subprocess.run([PROVE, "--folder", self.folder, *map(str, arguments)], capture_output=True, text=True,
                              check=False, env={**os.environ, **environment})

    def needs_solver(self):
        if not shutil.which("z3"):
            self.skipTest("z3 is not installed")

    def test_proves_a_claim_and_refutes_its_weakened_form(self):
        self.needs_solver()
        result = self.run_prove("--json", self.folder / "out.json")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        written = json.loads((self.folder / "out.json").read_text())
        self.assertEqual([written[key] for key in ("claims", "proven", "premises_hold", "refuted")], [1, 1, 1, 1])
        claim = written["list"][0]
        self.assertEqual((claim["text"], claim["result"]), ("Twice a number is even.", "proven"))
        self.assertTrue(claim["premises_hold"])
        self.assertEqual(claim["weakened"]["result"], "refuted")
        self.assertEqual(list(claim["weakened"]["counterexample"]), ["v"])

    def test_a_false_claim_fails(self):
        self.needs_solver()
        self.write(CLAIM.replace("(* 2 v)", "(* 5 v)") + WEAKENED)
        result = self.run_prove()
        self.assertEqual(result.returncode, 1)
        self.assertIn("FALSE", result.stdout)

    def test_a_weakened_form_that_holds_fails(self):
        self.needs_solver()
        self.write(CLAIM + WEAKENED.replace("(* 3 v)", "(* 4 v)"))
        result = self.run_prove()
        self.assertEqual(result.returncode, 1)
        self.assertIn("HOLDS", result.stdout)

    def test_a_claim_of_what_cannot_be_fails(self):
        self.needs_solver()
        impossible = "(assert (and (< v 0) (> v 0)))\n(assert (not"
        self.write(CLAIM.replace("(assert (not", impossible) + WEAKENED)
        result = self.run_prove("--json", self.folder / "out.json")
        self.assertEqual(result.returncode, 1)
        self.assertIn("EMPTY", result.stdout)
        written = json.loads((self.folder / "out.json").read_text())
        self.assertEqual((written["proven"], written["premises_hold"], written["refuted"]), (1, 0, 1))
        self.assertFalse(written["list"][0]["premises_hold"])

    def test_a_claim_that_asserts_nothing_is_refused(self):
        self.needs_solver()
        self.write(CLAIM[:CLAIM.index("(assert")] + WEAKENED)
        result = self.run_prove()
        self.assertEqual((result.returncode, result.stderr),
                         (2, "prove: numbers.smt2: claim even asserts nothing\n"))

    def test_no_answer_in_time_is_no_proof(self):
        self.needs_solver()
        hard = ("(declare-const x Int) (declare-const y Int) (declare-const z Int)\n"
                "(assert (and (> x 2) (> y 2) (> z 2) (= (+ (* x x x x x) (* y y y y y)) (* z z z z z))))\n")
        self.write(CLAIM[:CLAIM.index("(assert")] + hard + WEAKENED)
        result = self.run_prove("--time-limit", 1)
        self.assertEqual(result.returncode, 1)
        self.assertIn("UNDECIDED", result.stdout)

    def test_a_mistake_in_a_file_is_told(self):
        self.needs_solver()
        self.write(CLAIM.replace("mod", "mood") + WEAKENED)
        result = self.run_prove()
        self.assertEqual(result.returncode, 2)
        self.assertIn("numbers.smt2: claim even: the solver says (error", result.stderr)

    def test_without_a_solver_it_says_so(self):
        tools = self.folder / "bin"
        tools.mkdir()
        (tools / "python3").symlink_to(sys.executable)
        result = self.run_prove(PATH=str(tools))
        self.assertEqual(result.returncode, 77)
        self.assertIn("z3 is not installed", result.stderr)

    def test_a_claim_without_a_weakened_form_is_refused(self):
        self.write(CLAIM)
        with self.assertRaisesRegex(BadInput, "claim even has no deliberately false variant"):
            read_sections(self.folder)
        self.write(WEAKENED)
        with self.assertRaisesRegex(BadInput, "even has a false variant, but no claim"):
            read_sections(self.folder)
        self.write(CLAIM + CLAIM + WEAKENED)
        with self.assertRaisesRegex(BadInput, "even occurs twice"):
            read_sections(self.folder)

    def test_a_constant_that_drifts_from_its_source_is_refused(self):
        self.assertEqual(check_constants(self.folder, ROOT), 1)
        self.write(CLAIM + WEAKENED, DEFINITIONS.replace("256", "255"))
        with self.assertRaisesRegex(BadInput, "kSub is 255 in the proofs, but kSub of src/edgewise/contract.h is 256"):
            check_constants(self.folder, ROOT)
        self.write(CLAIM + WEAKENED, DEFINITIONS.replace("contract.h", "gone.h"))
        with self.assertRaisesRegex(BadInput, "not there"):
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
