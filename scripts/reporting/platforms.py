"""The table of what `scripts/test --everywhere` found: lines of a platform, its result and a finding."""
import re

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
    findings = [line.split("\t", 2) for line in path.read_text(encoding="utf-8", errors="replace").splitlines()]
    lines = []
    for name, tried in TRIED.items():
        results, texts = {result for of, result, _ in findings if of == name}, [text for of, _, text in findings if of == name]
        hashes, tests, facts = (sum(int(match[1]) for text in texts if (match := pattern.search(text))) for pattern in FOUND)
        lines.append([name.replace("_", "-") + ("" if results == {"passed"} else ": **failed**"), tried,
                      *(f"{count:,}" if count else "–" for count in (hashes, tests)), "the same as on x86-64" if facts else "–"])
    return ["platform", "tried by", "hashes compared in all builds, none differs", "runs of the library's tests", "facts of small scenes, a file of each kind"], lines
