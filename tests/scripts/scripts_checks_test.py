"""scripts/prove, on claims made here, and scripts/mutate, on a small source with a cmake that makes a test of it."""
import shutil
import sys
import unittest

from support import SCRIPTS, CopyTest, FolderTest, read, run

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
            result = self.prove(claims, "--time-limit", 3, "--json", self.folder / "out.json")
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


SOURCE = "bool less(int x, int y) {\n  return x\n      < y;\n}\nint one = 1;\n"
TABLE = '[group]\nprogram = "few"\ntests = "*"\nor_equal = ["a.cpp", "x < y", "x <= y"]\n'
# The test fails if a.cpp has a <=, and the build if it has an error.
CMAKE = """#!/bin/bash
[[ $1 == --build ]] || exec mkdir -p "$4"
source=$2/../tree/src/a.cpp
! grep -q error "$source" || exit 1
printf '#!/bin/bash\\n! grep -q "<=" %s\\n' "$source" >"$2/few"
chmod +x "$2/few"
"""


class MutateTest(CopyTest):
    def setUp(self):
        super().setUp()
        self.file("src/a.cpp", SOURCE)
        self.table = self.file("tests/mutations.toml", TABLE)
        self.tool("cmake", CMAKE)

    def mutate(self, table, *arguments):
        self.table.write_text(table)
        result = self.script("mutate", *arguments)
        self.assertEqual((self.folder / "src/a.cpp").read_text(), SOURCE)
        return result

    def assert_verdict(self, result, status, last_line):
        self.assertEqual((result.returncode, result.stdout.splitlines()[-1:]), (status, [last_line]), result.stderr)

    def test_every_mutant_of_the_table_applies(self):
        result = run(SCRIPTS / "mutate", "--list")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(len(result.stdout.splitlines()), 50)

    def test_a_mutant_is_caught_or_survives(self):
        table = TABLE + 'two = ["a.cpp", "one = 1", "one = 2"]\nbroken = ["a.cpp", "bool", "error"]\n'
        result = self.mutate(table, "--json", self.folder / "out.json")
        self.assert_verdict(result, 1, "1 of 3 mutants caught; not caught: two, broken")
        self.assertIn("survived        two\n", result.stdout)
        self.assertIn("does not build  broken\n", result.stdout)
        self.assertEqual(read(self.folder / "out.json")["not_caught"], ["two", "broken"])
        self.assert_verdict(self.mutate(table, "or_equal"), 0, "1 of 1 mutants caught")

    def test_hashes_run_on_an_emulated_processor(self):
        self.tool("cmake", CMAKE.replace("few", "edgewise_hashes"))
        self.tool("qemu-s390x", '#!/bin/bash\n[[ $5 == --few ]] && exec "$3"\n')
        self.assert_verdict(self.mutate(TABLE.replace("few", "edgewise_hashes").replace("*", "--few")), 0, "1 of 1 mutants caught")

    def test_what_cannot_be_tried_is_told_in_one_line(self):
        for table, told, *names in ((TABLE.replace("x < y", "int"), "or_equal: int occurs 3 times, not once, in src/a.cpp"),
                                    (TABLE.replace("x < y", "on"), "or_equal: on occurs 0 times, not once, in src/a.cpp"),
                                    (TABLE.replace("a.cpp", "b.cpp"), "or_equal: 0 files match b.cpp, not one"),
                                    (TABLE, "there is no mutant nobody; --list prints them", "nobody"),
                                    ("[[", self.table), ('program = "few"\n', self.table),
                                    (TABLE.replace("program", "p"), self.table), (TABLE.replace(', "x <= y"', ""), self.table),
                                    (TABLE.replace("few", "gone"), "without a mutation, gone fails; see ")):
            self.fails(self.mutate(table, *names), f"mutate: {told}")


if __name__ == "__main__":
    unittest.main()
