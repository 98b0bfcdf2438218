"""The verification summary: one table of the methods that `scripts/test --full` ran, their extent and their findings."""
import sys
from pathlib import Path

from bench_rows import records
from program import main_guard, read_json
from shards import added
from tables import enumerated, short

RECORDS = ("verify", "tests", "prove", "mutate", "fuzz", "random")


def none_or(count, what, plural):
    """"no failure", or their number in bold."""
    return f"**{count:,} {what if count == 1 else plural}**" if count else f"no {what}"


def all_of(done, all_there, what):
    return f"all {what}" if done == all_there else f"**{done:,} of {all_there:,} {what}**"


def compared(verify):
    """The extent of `edgewise verify`, and how many pixels differ."""
    scenes = verify["scenes"]
    frames = sum(scene["configurations"] for scene in scenes)
    differing = sum(of.get("differing_pixels", 0) + of.get("written_outside", 0) for scene in scenes for of in (scene, scene.get("oracle", {})))
    return f"{frames:,} frames of {len(scenes)} scenes, and small ones with an oracle", differing


def lines_of(record, data):
    """Each a method, its extent and its finding."""
    match record:
        case "verify":
            extent, differing = compared(data)
            yield "Backends compared, bit for bit", extent, none_or(differing, "pixel differs", "pixels differ")
        case "tests":
            found = data["all"]
            yield ("Tests at full size", f"{found['tests']:,} tests, {short(found['cases'])} random or exhaustive cases",
                   none_or(found["failed"], "failure", "failures") + f"; {found['skipped']:,} skipped" * bool(found["skipped"]))
            if runs := data["sanitized"]:
                yield (f"Again with the sanitizers ({', '.join(run['name'] for run in runs)})", f"{sum(run['tests'] for run in runs):,} tests",
                       none_or(sum(run["failed"] for run in runs), "failure", "failures"))
        case "prove":
            found = {"proven": "proven", "premises_hold": "premises satisfiable", "refuted": "false variants refuted"}
            yield ("Proofs, for all inputs", f"{data['claims']:,} claims, each with a deliberately false variant",
                   "; ".join(all_of(data[key], data["claims"], what) for key, what in found.items()))
        case "mutate":
            yield "Mutation testing", f"{data['mutations']:,} mutants, one at a time", all_of(data["caught"], data["mutations"], "caught")
        case "fuzz":
            executions, crashes = (sum(counts) for counts in zip(*((of["executions"], len(of["crashes"])) for of in data["targets"])))
            yield ("Fuzzing", f"{short(executions)} executions in {data['cpu_hours']:.1f} CPU hours",
                   none_or(crashes, "crash", "crashes"))
        case "random":
            yield ("Random pictures", f"{short(data['cases'])} pictures, {short(data['pixels'])} pixels compared",
                   none_or(data["differences"], "difference", "differences"))


def verification_table(folder):
    """Header and lines; no lines if nothing was run. What was not run on this machine is taken from another one's results."""
    found = {record: [read_json(path) for path in records(folder, record)] for record in RECORDS}
    return ["method", "extent", "found"], [[*line] for record, runs in found.items() if runs
                                           for line in lines_of(record, added(runs) if record == "random" else runs[0])]


def elsewhere(folder):
    """A sentence that names the records of other machines, with their commits if they hold any."""
    paths = [path for record in RECORDS for path in records(folder, record)[:None if record == "random" else 1] if path.parent != folder]
    told = [f"{path.stem} ({read_json(path).get('commit', path.parent.name)})" for path in paths]
    return f"These records are of other machines and commits: {enumerated(told)}." if told else ""


def main():
    folder = Path(sys.argv[1])  # results/MACHINE
    header, lines = verification_table(folder)
    widths = [max(map(len, column)) for column in zip(header, *lines)]
    print(*("  ".join(map(str.ljust, line, widths)).rstrip() for line in (header, *lines)), elsewhere(folder), sep="\n")


if __name__ == "__main__":
    main_guard(main)
