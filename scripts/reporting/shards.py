"""Adds up the lines of `edgewise verify --random --json FILE`, one per shard, to one line on stdout."""
import json
import sys
from pathlib import Path

from program import BadInput, main_guard, read_json

ADDED = ("cases", "frames", "triangles", "pixels", "oracle_frames", "frontend_lists", "differences", "seconds", "findings")


def added(lines):
    if len({(line["seed"], line["commit"], line["shard"].partition("/")[2]) for line in lines}) > 1:
        raise BadInput("only shards of one seed, number of shards and commit add up")
    if len({line["shard"] for line in lines}) < len(lines):
        raise BadInput("a shard is there twice")
    total = {**lines[0], **{key: [line[key] for line in lines] for key in ("shard", "cpu_model")},
             "simd_targets": list(dict.fromkeys(target for line in lines for target in line["simd_targets"]))}
    for line in lines[1:]:
        total.update({key: total[key] + line[key] for key in ADDED})
    return total


def main():
    if not sys.argv[1:] or sys.argv[1].startswith("-"):
        raise BadInput("usage: shards.py FILE…")
    try:
        print(json.dumps(added([read_json(Path(name)) for name in sys.argv[1:]])))
    except (KeyError, TypeError, AttributeError) as error:
        raise BadInput(f"not a line of `edgewise verify --random`: {error!r}") from None
    return 0


if __name__ == "__main__":
    main_guard(main)
