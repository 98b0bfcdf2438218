"""scripts/mutate: its table, and what it says of small sources with a cmake that makes a test of them."""
import json
import shutil
import unittest

from support import SCRIPTS, FolderTest, run

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


class MutateTest(FolderTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(SCRIPTS, self.folder / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        self.file("src/a.cpp", SOURCE)
        self.tool("cmake", CMAKE)

    def mutate(self, table, *arguments):
        self.file("tests/mutations.toml", table)
        result = self.with_tools(self.folder / "scripts/mutate", *arguments)
        self.assertEqual((self.folder / "src/a.cpp").read_text(), SOURCE)
        return result

    def assert_refused(self, table, message, *arguments):
        result = self.mutate(table, *arguments)
        self.assertEqual((result.returncode, result.stderr), (2, f"mutate: {message}\n"))

    def test_every_mutant_of_the_table_applies(self):
        result = run(SCRIPTS / "mutate", "--list")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertGreater(len(result.stdout.splitlines()), 50)

    def test_a_mutant_is_caught_or_survives(self):
        result = self.mutate(TABLE, "--json", self.folder / "out.json")
        self.assertEqual((result.returncode, result.stdout.splitlines()[-1]), (0, "1 of 1 mutants caught"), result.stderr)
        table = TABLE + 'two = ["a.cpp", "one = 1", "one = 2"]\nbroken = ["a.cpp", "bool", "error"]\n'
        result = self.mutate(table, "--json", self.folder / "out.json")
        self.assertEqual((result.returncode, result.stdout.splitlines()[-1]),
                         (1, "1 of 3 mutants caught; not caught: two, broken"), result.stderr)
        self.assertIn("survived        two\n", result.stdout)
        self.assertIn("does not build  broken\n", result.stdout)
        self.assertEqual(json.loads((self.folder / "out.json").read_text())["not_caught"], ["two", "broken"])
        result = self.mutate(table, "or_equal")
        self.assertEqual((result.returncode, result.stdout.splitlines()[-1]), (0, "1 of 1 mutants caught"))

    def test_hashes_run_on_an_emulated_processor(self):
        self.tool("cmake", CMAKE.replace("few", "edgewise_hashes"))
        self.tool("qemu-s390x", '#!/bin/bash\n[[ $5 == --few ]] && exec "$3"\n')
        result = self.mutate(TABLE.replace("few", "edgewise_hashes").replace("*", "--few"))
        self.assertEqual((result.returncode, result.stdout.splitlines()[-1]), (0, "1 of 1 mutants caught"), result.stderr)

    def test_tests_that_fail_without_a_mutation_are_told(self):
        self.tool("cmake", CMAKE.replace("<=", "<"))
        self.assert_refused(TABLE, f"without a mutation, few fails; see {self.folder}/build/mutations/tests.log")

    def test_a_mutant_that_no_longer_applies_is_told(self):
        for code, message in (("x > y", "or_equal: x > y occurs 0 times, not once, in src/a.cpp"),
                              ("int", "or_equal: int occurs 3 times, not once, in src/a.cpp"),
                              ("on", "or_equal: on occurs 0 times, not once, in src/a.cpp")):
            self.assert_refused(TABLE.replace("x < y", code), message)
        self.assert_refused(TABLE.replace("a.cpp", "b.cpp"), "or_equal: 0 files match b.cpp, not one")

    def test_a_bad_table_is_told(self):
        for table in ("[[", TABLE.replace("program", "p"), TABLE.replace(', "x <= y"', ""), 'program = "few"\n'):
            result = self.mutate(table)
            self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1), result.stderr)
            self.assertIn("mutations.toml: ", result.stderr)

    def test_an_unknown_name_is_told(self):
        self.assert_refused(TABLE, "there is no mutant nobody; --list prints them", "nobody")


if __name__ == "__main__":
    unittest.main()
