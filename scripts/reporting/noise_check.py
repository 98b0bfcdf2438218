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
    """(the command and its rounds, pairs of milliseconds before and after)"""
    data = read_json(path)
    try:
        if data["before"] != data["after"]:
            raise BadInput(f"{path}: two different revisions")
        command = f"`scripts/compare HEAD HEAD --filter '{data['filter']}'`, {data['rounds']} rounds"
        return command, [(row["before_ms"], row["after_ms"]) for row in data["rows"]]
    except (KeyError, TypeError) as error:
        raise BadInput(f"{path}: not what 'scripts/compare --json' writes: {type(error).__name__} {error}") from None


def noise_check(folder):
    """False alarms, and how often a planted slowdown is found; empty if not measured. What was not measured on this machine
    is taken from another one's results."""
    paths = records(folder, "same*")
    if not paths:
        return ""
    machine = paths[0].parent
    runs = [read_same(path) for path in paths if path.parent == machine]
    pairs = [pair for _, found in runs for pair in found]
    alarms, rows = count(pairs)
    in_few, few = count(in_blocks(pairs, fewest_rounds()))
    found = sum(paired_order(before, [PLANTED * ms for ms in after]) > 0 for before, after in pairs)
    where = "" if machine == folder else f"On `{machine.name}`: "
    return (f"{where}{'; '.join(command for command, _ in runs)}: false alarms in {alarms} of {rows} rows, and in {in_few} of {few} "
            f"tests of {fewest_rounds()} rounds each. With {percent(PLANTED - 1)} added to the times of one side, {found} of {rows} rows are found "
            "slower.")
