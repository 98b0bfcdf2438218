"""False alarms and detection rate of noise.py, measured on one program against itself: same.json, written by
`scripts/compare REV REV --json`."""
from bench_rows import BadInput, read_json, records
from noise import fewest_rounds, paired_order
from tables import percent

PLANTED = 1.02


def count(pairs):
    """(pairs that differ, pairs)"""
    found = [paired_order(before, after) for before, after in pairs]
    return sum(map(bool, found)), len(found)


def in_blocks(pairs, rounds):
    return [(before[i:i + rounds], after[i:i + rounds]) for before, after in pairs for i in range(0, len(before) - rounds + 1, rounds)]


def read_same(path):
    """[(milliseconds before, after)] of each row, and the number of rounds."""
    data = read_json(path)
    try:
        if data["before"] != data["after"]:
            raise BadInput(f"{path}: two different revisions")
        return [(row["before_ms"], row["after_ms"]) for row in data["rows"]], data["rounds"]
    except (KeyError, TypeError) as error:
        raise BadInput(f"{path}: not what 'scripts/compare --json' writes: {type(error).__name__} {error}") from None


def noise_table(folder):
    """Header and lines: false alarms, and how often a planted slowdown is found, of all machines; no lines if not measured."""
    lines = []
    for path in records(folder, "same*"):
        pairs, rounds = read_same(path)
        found = sum(paired_order(before, [PLANTED * ms for ms in after]) > 0 for before, after in pairs)
        alarms = ["{} of {}".format(*count(of)) for of in (pairs, in_blocks(pairs, fewest_rounds()))]
        lines.append([f"`{path.parent.name}`", str(rounds), *alarms, f"{found} of {len(pairs)}"])
    return ["machine", "rounds", "false alarms", f"false alarms in blocks of {fewest_rounds()} rounds", f"{percent(PLANTED - 1)} slowdowns found"], lines
