"""The last lines of scripts/test: failed tests, skipped tests with their reasons, and the number of each."""
import argparse
import sys
import textwrap
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "reporting"))
from bench_rows import main_guard  # noqa: E402
from junit import FAILED, PASSED, SKIPPED, Test, read_tests  # noqa: E402

WIDTH = 100
FAILURES_LISTED = 20
NAMES_LISTED = 4


def tests_of(path):
    """scripts/test creates each file empty, so an empty one belongs to a run that failed early."""
    if path.stat().st_size:
        return read_tests(path)  # no tests where there are more shards than tests
    return [Test("", "the run ended without results; see above", FAILED)]


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
    parser = argparse.ArgumentParser(prog="test_summary", description=__doc__,
                                     epilog="Exit status: 0 no test failed, 1 some did, 2 bad input.")
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="JUnit files, one per run")
    parser.add_argument("--status", type=int, default=0, metavar="N", help="the runs' worst exit status")
    options = parser.parse_args()
    runs = {path.stem: tests_of(path) for path in sorted(options.folder.glob("*.xml"))}
    if options.status and all(test.result != FAILED for run in runs.values() for test in run):
        runs["outside the tests"] = [Test("", f"exit status {options.status}; see above", FAILED)]
    tests = [test for run in runs.values() for test in run]
    failed = [f"Failed: {test.full_name} ({name})" for name, run in runs.items() for test in run if test.result == FAILED]
    lines = [*skipped_lines([test for test in tests if test.result == SKIPPED]), *failed[:FAILURES_LISTED]]
    if len(failed) > FAILURES_LISTED:
        lines.append(f"and {len(failed) - FAILURES_LISTED} more failed; see above")
    for line in lines:
        print(textwrap.fill(line, WIDTH, subsequent_indent="  "))
    count = Counter(test.result for test in tests)
    print(", ".join(f"{count[result]} {result}" for result in (PASSED, FAILED, SKIPPED)))
    return 1 if failed else 0


main_guard(main)
