"""Adds up the lines of `edgewise verify --random --json FILE`, one per shard, to one line on stdout."""
import json
import sys

from program import BadInput, main_guard, read_json

ADDED = ("cases", "frames", "triangles", "pixels", "oracle_frames", "frontend_lists", "differences", "seconds", "findings")


def added(lines):
    """One record of runs on several machines, each with its own SIMD targets."""
    total = {**lines[0], **{key: [line[key] for line in lines] for key in ("shard", "cpu_model")},
             "simd_targets": list(dict.fromkeys(target for line in lines for target in line["simd_targets"]))}
    for line in lines[1:]:
        total.update({key: total[key] + line[key] for key in ADDED})
    return total


def main():
    try:
        lines = [read_json(path) for path in sys.argv[1:]]
        runs = {(line["seed"], line["commit"], line["shard"].partition("/")[2]) for line in lines}
        if len(runs) > 1 or len({line["shard"] for line in lines}) < len(lines):
            raise BadInput("only different shards of one seed, number of shards and commit add up")
        print(json.dumps(added(lines)))
    except (AttributeError, LookupError, TypeError, ValueError) as error:
        raise BadInput(f"not lines of `edgewise verify --random`: {error!r}") from None
    return 0


if __name__ == "__main__":
    main_guard(main)
