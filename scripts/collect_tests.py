"""Adds up what test runs wrote, for results: GoogleTest's JSON (with the properties "cases" and "comparisons" of its
tests), and ctest's JUnit files, one for each sanitizer and named after it."""
import argparse
import json
import sys
import xml.etree.ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from bench_rows import BadInput, main_guard, read_json  # noqa: E402

COUNTED = ("cases", "comparisons")  # what tests say that they covered


def gtest_totals(paths):
    totals = dict.fromkeys(("tests", "failed", "skipped", *COUNTED), 0)
    for path in paths:
        for suite in read_json(path)["testsuites"]:
            for test in suite["testsuite"]:
                totals["tests"] += 1
                totals["failed"] += bool(test.get("failures"))
                totals["skipped"] += test.get("result") == "SKIPPED"
                for name in COUNTED:
                    totals[name] += int(test.get(name, 0))
    return totals


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
    print(json.dumps({"all": gtest_totals(by_kind[".json"]),
                      "sanitized": [junit_totals(path) for path in by_kind[".xml"]]}, indent=1))
    return 0


main_guard(main)
