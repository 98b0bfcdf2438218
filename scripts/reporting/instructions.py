"""Reads the instructions of frames on stdin, lines "COUNT SCENE TARGET PART", and prints them as JSON. Of a frame that is counted
twice the second counts: the first also allocates."""
import json
import sys

from program import main_guard, parsed
from tables import spread

BACKENDS = ("scanline", "tiled")
def read_counts(lines):
    """{scene: {part: {target: instructions}}}"""
    counts = {}
    for line in lines:
        count, scene, target, part = line.split()
        counts.setdefault(scene, {}).setdefault(part, {})[target] = int(count)
    return counts


def instructions_sentence(path):
    """How many times as many instructions scalar code has as NEON's, from scene to scene."""
    def told(counts):
        ratios = {part: [of[part]["scalar"] / of[part]["neon"] for of in counts.values()] for part in ("frontend", *BACKENDS)}
        return ", ".join(f"{spread(found)} in {'the front end' if part == 'frontend' else f'`{part}`'}" for part, found in ratios.items())

    return f"Instructions of scalar code over those of NEON code: {parsed(path, told, 'scripts/test --everywhere')}."


def main():
    print(json.dumps(read_counts(sys.stdin), indent=1))
    return 0


if __name__ == "__main__":
    main_guard(main)
