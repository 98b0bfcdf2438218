"""Adds up the JUnit files of test runs, for results: GoogleTest's (with the properties "cases" and "comparisons" of its
tests), and those of ctest, one for each sanitizer and named after it."""
import argparse
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "reporting"))
from bench_rows import main_guard  # noqa: E402
from junit import read_tests, totals  # noqa: E402

COUNTED = ("cases", "comparisons")  # properties that tests record
# Test suites with cases of one kind, which can be added up.
FAMILIES = {"properties": r"Properties|CoverageProperties", "lattices": r"EveryTriangle", "conformance": r"Conformance\w*",
            "invalid_input": r"InvalidInput"}


def members(tests, pattern):
    """A parameterized suite is called INSTANCE/SUITE."""
    return [test for test in tests if re.fullmatch(pattern, test.suite.rpartition("/")[2])]


def family_totals(tests):
    return {**totals(tests), **{name: sum(int(test.properties.get(name, 0)) for test in tests) for name in COUNTED}}


def main():
    parser = argparse.ArgumentParser(prog="collect_tests", description=__doc__)
    parser.add_argument("--gtest", type=Path, nargs="*", default=[], metavar="FILE", help="written by GoogleTest")
    parser.add_argument("--sanitized", type=Path, nargs="*", default=[], metavar="FILE", help="written by ctest")
    options = parser.parse_args()
    tests = [test for path in options.gtest for test in read_tests(path)]
    families = {family: family_totals(members(tests, pattern)) for family, pattern in FAMILIES.items()}
    print(json.dumps({"all": totals(tests), "families": families,
                      "sanitized": [{"name": path.stem, **totals(read_tests(path))} for path in options.sanitized]},
                     indent=1))
    return 0


main_guard(main)
