"""Reads the results of test runs: the JUnit files that GoogleTest and `ctest --output-junit` write."""
import re
import xml.etree.ElementTree
from collections import Counter
from dataclasses import dataclass, field

from bench_rows import BadInput

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
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}") from None
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
