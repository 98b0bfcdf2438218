"""The table of mutants, and scripts/checks/mutations.py."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts" / folder) for folder in ("reporting", "checks")]
from bench_rows import BadInput  # noqa: E402
from mutations import Mutation, copy_tree, failed_tests, files_of, mutated, read_mutations  # noqa: E402

ENTRY = '[[mutation]]\nname = "{}"\nchange = "m"\nfile = "src/a.cpp"\ntests = "*"\nbefore = "x < y"\nafter = "x <= y"\n'


class MutateTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "src").mkdir()
        (self.folder / "src/a.cpp").write_text("return x < y;\n")

    def read(self, text):
        path = self.folder / "table.toml"
        path.write_text(text)
        return read_mutations(path)

    def test_every_mutant_of_the_table_applies(self):
        result = subprocess.run([ROOT / "scripts/mutate", "--check"], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_the_table_reaches_every_part(self):
        files = {m.file for m in read_mutations(ROOT / "tests/mutations.toml")}
        for part in ("contract.h", "naive.cpp", "tile_", "scanline_", "bins", "assemble.cpp", "one_by_one.cpp", "clip.cpp",
                     "shade.cpp", "oracle.cpp", "mask_coverage", "mask_quadrants", "mask_lists", "tile_masks",
                     "record_lanes", "chunks.h", "pieces.cpp", "noise.py"):
            self.assertTrue(any(part in file for file in files), part)

    def test_a_mutant_is_applied_once(self):
        mutation, = self.read(ENTRY.format("less"))
        self.assertEqual(mutated(mutation, self.folder), "return x <= y;\n")

    def test_text_that_is_gone_or_stands_twice_is_told(self):
        mutation, = self.read(ENTRY.format("less"))
        (self.folder / "src/a.cpp").write_text("return x > y;\n")
        with self.assertRaisesRegex(BadInput, "less: the text to replace occurs 0 times, not once, in src/a.cpp:\nx < y"):
            mutated(mutation, self.folder)
        (self.folder / "src/a.cpp").write_text("x < y, x < y;\n")
        with self.assertRaisesRegex(BadInput, "occurs 2 times"):
            mutated(mutation, self.folder)
        (self.folder / "src/a.cpp").unlink()
        with self.assertRaisesRegex(BadInput, "occurs 0 times"):
            mutated(mutation, self.folder)

    def test_a_replacement_by_itself_is_told(self):
        with self.assertRaisesRegex(BadInput, "less changes nothing"):
            mutated(Mutation("less", "m", "src/a.cpp", "*", "x < y", "x < y"), self.folder)

    def test_a_bad_table_is_told(self):
        for text, message in ((ENTRY.format("a") + ENTRY.format("a"), "twice: a"),
                              (ENTRY.format("a").replace("change", "summary"), "a must have exactly"),
                              (ENTRY.format("a") + 'sanitizer = "memory"\n', "a: sanitizer must be one of thread"),
                              ("", "mutation"), ("[[", "Invalid|Expected")):
            with self.assertRaisesRegex(BadInput, message):
                self.read(text)

    def test_an_unknown_name_is_told(self):
        result = subprocess.run([ROOT / "scripts/mutate", "--only", "nobody"], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr),
                         (2, "mutate: there is no mutant nobody; --list prints them\n"))

    def test_the_copy_follows_the_tree_and_keeps_what_is_the_same(self):
        tree = self.folder / "copy"
        (self.folder / "README.md").write_text("one")
        (self.folder / "elsewhere").write_text("no part of the tree")
        copy_tree(self.folder, tree)
        self.assertEqual({str(f) for f in files_of(tree)}, {"README.md", "src/a.cpp"})
        before = (tree / "README.md").stat().st_mtime_ns
        (self.folder / "src/a.cpp").unlink()
        (self.folder / "src/b.cpp").write_text("b")
        copy_tree(self.folder, tree)
        self.assertEqual({str(f) for f in files_of(tree)}, {"README.md", "src/b.cpp"})
        self.assertEqual((tree / "README.md").stat().st_mtime_ns, before)

    def test_failed_tests_are_read_from_what_googletest_says(self):
        said = ("[ RUN      ] A.One\n[       OK ] A.One (0 ms)\n[ RUN      ] A.Two/x\nno\n"
                "[  FAILED  ] A.Two/x, where GetParam() = \"x\" (3 ms)\n[  FAILED  ] 1 test, listed below:\n"
                "[  FAILED  ] A.Two/x, where GetParam() = \"x\"\n")
        self.assertEqual(failed_tests(said), ["A.Two/x"])
        self.assertEqual(failed_tests("[  FAILED  ] A.Three (3 ms)\n"), ["A.Three"])
        self.assertEqual(failed_tests("[ RUN      ] A.One\n[       OK ] A.One (0 ms)\n[ RUN      ] A.Four\n"), ["A.Four"])
        self.assertEqual(failed_tests(""), [])

    def test_failed_tests_are_read_from_what_unittest_says(self):
        said = ("..F.E\n======\nFAIL: test_one (__main__.NoiseTest.test_one)\n------\nAssertionError\n"
                "======\nERROR: test_two (__main__.NoiseTest.test_two)\n------\nFAILED (failures=1, errors=1)\n")
        self.assertEqual(failed_tests(said), ["test_one", "test_two"])

    def test_a_mutant_of_a_script_needs_no_build(self):
        mutation, = self.read(ENTRY.format("less"))
        self.assertFalse(mutation.in_script)
        mutation, = self.read(ENTRY.format("less").replace("a.cpp", "a.py"))
        self.assertTrue(mutation.in_script)


if __name__ == "__main__":
    unittest.main()
