"""The verification summary: one table of the methods that `scripts/test --full` ran, their extent and their findings."""
from pathlib import Path

from bench_rows import records, source_of
from program import Parser, main_guard, read_json
from tables import enumerated, kernels, plain, short

RECORDS = ("verify", "tests", "prove", "mutate", "fuzz", "random")


def none_or(count, what, plural):
    """"no failure", or their number in bold."""
    return f"**{count:,} {what if count == 1 else plural}**" if count else f"no {what}"


def all_of(done, all_there, what):
    return f"all {what}" if done == all_there else f"**{done:,} of {all_there:,} {what}**"


def compared(verify):
    """The extent of `edgewise verify`, and how many pixels differ."""
    scenes = verify["scenes"]
    oracles = [scene.get("oracle", {}) for scene in scenes]
    frames, small = (sum(of.get("configurations", 0) for of in judged) for judged in (scenes, oracles))
    differing = sum(of.get("differing_pixels", 0) + of.get("written_outside", 0) for of in (*scenes, *oracles))
    return f"{frames:,} frames of {len(scenes)} scenes, and {small:,} small ones with an oracle", differing


def lines_of(record, data):
    """Each a method, its extent and its finding."""
    match record:
        case "verify":
            extent, differing = compared(data)
            yield "Backends compared, bit for bit", extent, none_or(differing, "pixel differs", "pixels differ")
        case "tests":
            tests, skipped, cases, comparisons, failed = (data["all"][key] for key in ("tests", "skipped", "cases", "comparisons", "failed"))
            yield ("Tests at full size", f"{tests:,} tests{f', {skipped:,} of them skipped' if skipped else ''}; {short(cases)} random or "
                   f"exhaustive cases, {short(comparisons)} comparisons", none_or(failed, "failure", "failures"))
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
            targets = data["targets"]
            executions, crashes = sum(of["executions"] for of in targets), sum(len(of["crashes"]) for of in targets)
            yield ("Fuzzing", f"{len(targets)} targets, {short(executions)} executions in {data['cpu_hours']:.1f} CPU hours",
                   none_or(crashes, "crash", "crashes"))
        case "random":
            targets = enumerated([kernels(target) for target in data["simd_targets"]])
            yield ("Random pictures", f"{short(data['cases'])} pictures in {targets}, {short(data['pixels'])} pixels compared",
                   none_or(data["differences"], "difference", "differences"))


def verification_table(folder):
    """Header and lines; no lines if nothing was run. What was not run on this machine is taken from another one's results."""
    lines = []
    for record in RECORDS:
        paths = records(folder, record)
        # Of random pictures all: each machine runs its own SIMD targets.
        for path in paths if record == "random" else paths[:1]:
            data = read_json(path)
            where = f" ({source_of(path, data)})" if path.parent != folder else ""
            lines += [[method, extent + where, found] for method, extent, found in lines_of(record, data)]
    return ["method", "extent", "found"], lines


def main():
    parser = Parser(prog="verification_summary", description=__doc__)
    parser.add_argument("folder", type=Path, help="results/MACHINE")
    print(plain(*verification_table(parser.parse_args().folder)))
    return 0


if __name__ == "__main__":
    main_guard(main)
