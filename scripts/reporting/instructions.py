"""Reads the instructions of frames on stdin, lines "COUNT SCENE TARGET PART", and prints them as JSON. Of a frame that is counted
twice the second counts: the first also allocates."""
import json
import sys

from program import main_guard, parsed
from tables import about, short

BACKENDS = ("scanline", "tiled")
HEADER = ["scene", "front end", *(f"`{name}` alone" for name in BACKENDS), *(f"frame with `{name}`" for name in BACKENDS)]


def read_counts(lines):
    """{scene: {part: {target: instructions}}}"""
    counts = {}
    for line in lines:
        count, scene, target, part = line.split()
        counts.setdefault(scene, {}).setdefault(part, {})[target] = int(count)
    return counts


def instructions_table(path):
    """NEON's instructions, and how many times as many scalar code has."""
    def told(parts):
        neon, scalar = (sum(part[target] for part in parts) for target in ("neon", "scalar"))
        return f"{short(neon)}, {about(scalar / neon)}"

    def lines(counts):
        return [[scene, *(told([of[part]]) for part in ("frontend", *BACKENDS)), *(told([of["frontend"], of[name]]) for name in BACKENDS)]
                for scene, of in counts.items()]

    return HEADER, parsed(path, lines, "scripts/test --everywhere")


def main():
    print(json.dumps(read_counts(sys.stdin), indent=1))
    return 0


if __name__ == "__main__":
    main_guard(main)
