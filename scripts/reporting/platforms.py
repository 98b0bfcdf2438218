"""Joins the findings of `scripts/test --everywhere`, lines of a platform, a result and a finding, to JSON on stdout."""
import fileinput
import json
import re

from program import main_guard, parsed

# By platform, in the order of the table: how it is tried.
TRIED = {
    "x86_64": "g++ and clang++, Release and Debug; every SIMD target of the processor; a C library without FMA, and one with wrong sines",
    "consumer": "programs built with `-O3 -march=native -ffast-math -ffp-contract=fast` that link the library",
    "aarch64": "QEMU, NEON and scalar code",
    "s390x": "QEMU, big-endian, scalar code",
    "riscv64": "QEMU, the library alone, scalar code; tests of the contract and of floating-point states only",
    "wasm32": "Node, the library alone, scalar code, compiled with and without SIMD128",
}
# The findings of each of the last columns, with their number.
FOUND = (re.compile(r"^(\d+) frames .*no hash differs"), re.compile(r"PASSED\s*\] (\d+) tests"), re.compile(r"^(\d+) bytes .*are those of x86-64"))


def platforms_table(path):
    found = parsed(path, lambda data: {name: data[name] for name in TRIED}, "scripts/test --everywhere")
    lines = []
    for name, tried in TRIED.items():
        hashes, tests, facts = (sum(int(match[1]) for text in found[name]["found"] if (match := pattern.search(text))) for pattern in FOUND)
        lines.append([name.replace("_", "-") + ("" if found[name]["result"] == "passed" else ": **failed**"), tried,
                      *(f"{count:,}" if count else "–" for count in (hashes, tests)), "the same as on x86-64" if facts else "–"])
    return ["platform", "tried by", "hashes compared, none differs", "tests of the library", "facts of small scenes, a file of each kind"], lines


def main():
    found = {}
    for line in fileinput.input(encoding="utf-8", errors="replace"):
        name, result, text = line.rstrip("\n").split("\t", 2)
        found.setdefault(name, {"result": result, "found": []})["found"].append(text)
    print(json.dumps(found, indent=1))
    return 0


if __name__ == "__main__":
    main_guard(main)
