"""Reads the JUnit files of test runs: GoogleTest's, and those of `ctest --output-junit`. Prints the last lines of scripts/test:
failed tests, skipped tests with their reasons, and the number of each. With --json, adds the tests up for results instead."""
import argparse
import json
import re
import sys
import textwrap
import xml.etree.ElementTree
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "reporting"))
from program import BadInput, main_guard  # noqa: E402

WIDTH = 100
NAMES_LISTED = 4
COUNTED = ("cases", "comparisons")  # properties that tests record
PASSED, FAILED, SKIPPED = "passed", "failed", "skipped"


@dataclass
class Test:
    suite: str  # empty in ctest's files
    name: str
    result: str
    reason: str = ""  # of a skipped test
    properties: dict = field(default_factory=dict)  # what RecordProperty() noted

    @property
    def full_name(self):
        return f"{self.suite}.{self.name}" if self.suite else self.name


def read_tests(path):
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except xml.etree.ElementTree.ParseError as error:
        raise BadInput(f"{path}: not a JUnit file: {error}") from None
    read = {"testsuites": gtest_case, "testsuite": ctest_case}.get(root.tag)
    if read is None:
        raise BadInput(f"{path}: not a JUnit file of GoogleTest or ctest")
    return [read(case) for case in root.iter("testcase")]


def gtest_case(case):
    test = Test(case.get("classname"), case.get("name"), PASSED,
                properties={p.get("name"): p.get("value") for p in case.iter("property")})
    if case.find("failure") is not None:
        test.result = FAILED
    elif case.get("result") == "skipped":
        _, _, reason = (case.findtext("skipped") or "").partition("\n")  # after FILE:LINE
        test.result, test.reason = SKIPPED, reason
    return test


def ctest_case(case):
    name, status, skipped = case.get("name"), case.get("status"), case.find("skipped")
    if status == "run":
        return Test("", name, PASSED)
    if status == "disabled":
        return Test("", name, SKIPPED, "disabled")
    # The file marks a test whose program is missing as skipped too, but ctest counts it as failed.
    if status == "notrun" and skipped is not None and skipped.get("message", "").startswith("SKIP_"):
        return Test("", name, SKIPPED, reason_in(case.findtext("system-out") or ""))
    return Test("", name, FAILED)


def reason_in(output):
    """The reason that GoogleTest prints on the line after "Skipped", and our Python tests after "skipped: "."""
    found = re.search(r": Skipped\n(.+)", output) or re.search(r"^skipped: (.+)", output, re.MULTILINE | re.IGNORECASE)
    return found.group(1) if found else ""


def totals(tests):
    count = Counter(test.result for test in tests)
    return {"tests": len(tests), FAILED: count[FAILED], SKIPPED: count[SKIPPED]}


def added_up(folder):
    """Of the shards tests-*.xml all tests, and what they counted; of the sanitizers' runs so far, the totals."""
    tests = [test for path in sorted(folder.glob("tests-*.xml")) for test in read_tests(path)]
    sanitized = [path for path in (folder / "address.xml", folder / "thread.xml") if path.exists() and path.stat().st_size]
    counted = {name: sum(int(test.properties.get(name, 0)) for test in tests) for name in COUNTED}
    return {"all": {**totals(tests), **counted}, "sanitized": [{"name": path.stem, **totals(read_tests(path))} for path in sanitized]}


def skipped_lines(tests):
    """One entry per reason."""
    by_reason = {}
    for test in tests:
        by_reason.setdefault(test.reason or "no reason given", []).append(test.full_name)
    for reason, names in by_reason.items():
        different = list(dict.fromkeys(names))
        listed = ", ".join(different[:NAMES_LISTED])
        if len(different) > NAMES_LISTED:
            listed += f" and {len(different) - NAMES_LISTED} more"
        yield f"Skipped {len(names)}, {reason}: {listed}"


def main():
    parser = argparse.ArgumentParser(prog="test_results", description=__doc__,
                                     epilog="Exit status: 0 no test failed, 1 some did, 2 bad input.")
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="JUnit files, one per run")
    parser.add_argument("--status", type=int, default=0, metavar="N", help="the runs' worst exit status")
    parser.add_argument("--json", action="store_true", help="instead, print the sums of `scripts/test --full`")
    options = parser.parse_args()
    if options.json:
        print(json.dumps(added_up(options.folder), indent=1))
        return 0
    # scripts/test creates each file empty, so an empty one belongs to a run that failed early. Where there are more shards
    # than tests, a run has none.
    runs = {path.stem: read_tests(path) if path.stat().st_size else [Test("", "the run ended without results; see above", FAILED)]
            for path in sorted(options.folder.glob("*.xml"))}
    if options.status and all(test.result != FAILED for run in runs.values() for test in run):
        runs["outside the tests"] = [Test("", f"exit status {options.status}; see above", FAILED)]
    tests = [test for run in runs.values() for test in run]
    failed = [f"Failed: {test.full_name} ({name})" for name, run in runs.items() for test in run if test.result == FAILED]
    lines = [*skipped_lines([test for test in tests if test.result == SKIPPED]), *failed]
    for line in lines:
        print(textwrap.fill(line, WIDTH, subsequent_indent="  "))
    count = Counter(test.result for test in tests)
    print(", ".join(f"{count[result]} {result}" for result in (PASSED, FAILED, SKIPPED)))
    return 1 if failed else 0


main_guard(main)
