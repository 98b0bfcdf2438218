"""Adds up what test runs wrote, for results: GoogleTest's JSON (with the properties "cases" and "comparisons" of its
tests), and ctest's JUnit files, one for each sanitizer and named after it."""
import argparse
import json
import re
import sys
import xml.etree.ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from bench_rows import BadInput, main_guard, read_json  # noqa: E402

RESULTS = ("tests", "failed", "skipped")
COUNTED = ("cases", "comparisons")  # what tests say that they covered
# Test suites whose cases are of one kind, so that they may be added up.
FAMILIES = {"properties": r"Properties|CoverageProperties", "lattices": r"EveryTriangle", "conformance": r"Conformance\w*",
            "hostile": r"HostileInput"}


def family_of(suite):
    """None of suites that are of no family. A parameterized suite is called INSTANCE/SUITE."""
    fixture = suite.rpartition("/")[2]
    return next((family for family, pattern in FAMILIES.items() if re.fullmatch(pattern, fixture)), None)


def gtest_totals(paths):
    """Of all tests, and of each family."""
    totals = dict.fromkeys(RESULTS, 0)
    families = {family: dict.fromkeys((*RESULTS, *COUNTED), 0) for family in FAMILIES}
    for path in paths:
        for suite in read_json(path)["testsuites"]:
            family = families.get(family_of(suite["name"]))
            for test in suite["testsuite"]:
                for sums in (totals, family) if family else (totals,):
                    sums["tests"] += 1
                    sums["failed"] += bool(test.get("failures"))
                    sums["skipped"] += test.get("result") == "SKIPPED"
                for name in COUNTED if family else ():
                    family[name] += int(test.get(name, 0))
    return totals, families


def junit_totals(path):
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
        return {"name": path.stem, "tests": int(root.get("tests")), "failed": int(root.get("failures")),
                "skipped": int(root.get("skipped")) + int(root.get("disabled"))}
    except (OSError, xml.etree.ElementTree.ParseError, TypeError) as error:
        raise BadInput(f"{path}: not what ctest --output-junit writes: {error}") from None


def main():
    parser = argparse.ArgumentParser(prog="collect_tests", description=__doc__)
    parser.add_argument("files", type=Path, nargs="+", metavar="FILE", help=".json of GoogleTest, .xml of ctest")
    files = parser.parse_args().files
    by_kind = {kind: [path for path in files if path.suffix == kind] for kind in (".json", ".xml")}
    totals, families = gtest_totals(by_kind[".json"])
    print(json.dumps({"all": totals, "families": families,
                      "sanitized": [junit_totals(path) for path in by_kind[".xml"]]}, indent=1))
    return 0


main_guard(main)
