"""scripts/mutate: its table, and what it says of small sources with a cmake that makes a test of them."""
import shutil
import unittest

from support import SCRIPTS, FolderTest, read, run

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
        self.table = self.file("tests/mutations.toml", TABLE)
        self.tool("cmake", CMAKE)

    def mutate(self, table, *arguments):
        self.table.write_text(table)
        result = self.with_tools(self.folder / "scripts/mutate", *arguments)
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
        for table, told, *names in ((TABLE.replace("x < y", "x > y"), "or_equal: x > y occurs 0 times, not once, in src/a.cpp"),
                                    (TABLE.replace("x < y", "int"), "or_equal: int occurs 3 times, not once, in src/a.cpp"),
                                    (TABLE.replace("x < y", "on"), "or_equal: on occurs 0 times, not once, in src/a.cpp"),
                                    (TABLE.replace("a.cpp", "b.cpp"), "or_equal: 0 files match b.cpp, not one"),
                                    (TABLE, "there is no mutant nobody; --list prints them", "nobody"),
                                    ("[[", self.table), ('program = "few"\n', self.table),
                                    (TABLE.replace("program", "p"), self.table), (TABLE.replace(', "x <= y"', ""), self.table),
                                    (TABLE.replace("few", "gone"), "without a mutation, gone fails; see ")):
            self.fails(self.mutate(table, *names), f"mutate: {told}")


if __name__ == "__main__":
    unittest.main()
