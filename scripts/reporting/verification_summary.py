"""The verification summary: one table of the methods that `scripts/test --full` ran, their extent and their findings."""
from pathlib import Path

from bench_rows import records, source_of
from program import Parser, main_guard, read_json
from tables import enumerated, kernels, markdown, plain, short


def none_or(count, what, plural=None):
    """"no difference", or their number in bold."""
    return f"no {what}" if count == 0 else f"**{how_many(count, what, plural)}**"


def how_many(count, what, plural=None):
    return f"{count:,} {what if count == 1 else plural or what + 's'}"


def all_of(done, all_there, what):
    return f"all {what}" if done == all_there else f"**{done:,} of {all_there:,} {what}**"


def prove_lines(data):
    claims = data["claims"]
    yield ["Proofs, for all inputs", f"{how_many(claims, 'claim')}, each with a deliberately false variant",
           f"{all_of(data['proven'], claims, 'proven')}; {all_of(data['premises_hold'], claims, 'premises satisfiable')}; "
           f"{all_of(data['refuted'], claims, 'false variants refuted')}"]


def mutate_lines(data):
    yield ["Mutation testing", how_many(data["mutations"], "mutant") + ", one at a time",
           all_of(data["caught"], data["mutations"], "caught")]


def test_lines(data):
    tests, skipped, cases, comparisons = (data["all"][key] for key in ("tests", "skipped", "cases", "comparisons"))
    yield ["Tests at full size", f"{how_many(tests, 'test')}{f', {skipped:,} of them skipped' if skipped else ''}; "
           f"{short(cases)} random or exhaustive cases, {short(comparisons)} comparisons",
           none_or(data["all"]["failed"], "failure")]
    if runs := data["sanitized"]:
        yield [f"Again with the sanitizers ({', '.join(run['name'] for run in runs)})",
               how_many(sum(run["tests"] for run in runs), "test"), none_or(sum(run["failed"] for run in runs), "failure")]


def fuzz_lines(data):
    targets = data["targets"]
    yield ["Fuzzing", f"{how_many(len(targets), 'target')}, {short(sum(target['executions'] for target in targets))} executions in "
           f"{data['cpu_hours']:.1f} CPU hours",
           none_or(sum(len(target["crashes"]) for target in targets), "crash", "crashes")]


def random_lines(data):
    targets = enumerated([kernels(target) for target in data["simd_targets"]])
    yield ["Random pictures", f"{short(data['cases'])} pictures in {targets}, {short(data['pixels'])} pixels compared",
           none_or(data["differences"], "difference")]


def compared(verify):
    """The extent of `edgewise verify`, and how many pixels differ."""
    scenes = verify["scenes"]
    frames = sum(scene["configurations"] for scene in scenes)
    oracles = [scene.get("oracle", {}) for scene in scenes]
    differing = sum(of.get("differing_pixels", 0) + of.get("written_outside", 0) for of in (*scenes, *oracles))
    return f"{frames:,} frames of {len(scenes)} scenes, and {sum(of.get('configurations', 0) for of in oracles):,} small ones with an oracle", differing


def verify_lines(data):
    extent, differing = compared(data)
    yield ["Backends compared, bit for bit", extent, none_or(differing, "pixel differs", "pixels differ")]


LINES = {"verify": verify_lines, "tests": test_lines, "prove": prove_lines, "mutate": mutate_lines, "fuzz": fuzz_lines, "random": random_lines}


def verification_table(folder):
    """Header and lines; no lines if nothing was run. What was not run on this machine is taken from another one's results."""
    lines = []
    for name, lines_of in LINES.items():
        paths = records(folder, name)
        # Of random pictures all: each machine runs its own SIMD targets.
        for path in paths if name == "random" else paths[:1]:
            data = read_json(path)
            where = f" ({source_of(path, data)})" if path.parent != folder else ""
            lines += [[method, extent + where, found] for method, extent, found in lines_of(data)]
    return ["method", "extent", "found"], lines


def verification_markdown(folder):
    header, lines = verification_table(folder)
    return markdown(header, lines, "|---|---|---|") if lines else "None of this was run for these results."


def main():
    parser = Parser(prog="verification_summary", description=__doc__)
    parser.add_argument("folder", type=Path, help="results/MACHINE")
    print(plain(*verification_table(parser.parse_args().folder)))
    return 0


if __name__ == "__main__":
    main_guard(main)
