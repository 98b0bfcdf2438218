"""Builds the benchmark of two revisions and times both by turns. Judges the rows of two revisions by their paired rounds, or those
of two results."""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from statistics import geometric_mean
from typing import NamedTuple

import noise
from bench_rows import compared, read_bench
from program import ROOT, BadInput, git
from tables import number

BUILDS = ROOT / "build" / "compare"
PROGRAM = "edgewise_bench"
WORKING_TREE = "."
# In each round, a row's time is the median of REPETITIONS, each of at least MIN_TIME_S. Start-up takes about a second, so they
# cost little.
REPETITIONS, MIN_TIME_S = 5, 0.01
# A revision also moves code that it does not change, and that alone can make a row faster or slower. Each side is therefore linked
# anew for each round, behind a random number of bytes, and started with an environment of random size. (Curtsinger and Berger,
# "Stabilizer: Statistically Sound Performance Evaluation", 2013)
ROUNDS = 16
PAGE = 4096
LINES_OF_A_FAILURE = 20
SLOWER, FASTER, SAME = 1, -1, 0
VERDICTS = {SLOWER: "slower", FASTER: "faster", SAME: "no significant difference"}


class Revision(NamedTuple):
    commit: str  # empty: the working tree
    title: str
    source: Path
    build: Path


def revision(name):
    if name == WORKING_TREE:
        return Revision("", "the working tree", ROOT, BUILDS / "working-tree" / "build")
    commit = git("rev-parse", "--verify", "--quiet", "--end-of-options", name + "^{commit}")
    if not commit:
        raise BadInput(f"{name}: no such file, and no revision of this repository")
    source = BUILDS / commit[:12]
    return Revision(commit, git("log", "-1", "--format=%h %s", commit), source, source / "build")


def run(command, what, statuses=(0,), **options):
    """BadInput if the command ends with another status, after the last lines of its output. An interruption ends its children, too."""
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          start_new_session=True, **options) as process:
        try:
            output, _ = process.communicate()
        except BaseException:
            os.killpg(process.pid, signal.SIGTERM)  # Ninja then ends its compilers
            raise
    if process.returncode not in statuses:
        *lines, last = output.splitlines()[-LINES_OF_A_FAILURE:] or ["no message"]
        sys.stderr.writelines(line + "\n" for line in lines)
        raise BadInput(f"{what} ended with {process.returncode}: {last}")


def pad(of, size):
    """Writes the source that the revision's benchmark links first, so that it moves all other code."""
    (of.build / "padding.cpp").write_text(f'asm(".skip {size}");\n', encoding="utf-8")


def configure(of):
    print(f"Building {of.title}", flush=True)
    of.build.mkdir(parents=True, exist_ok=True)
    if of.commit:  # with an index of its own, by which git knows what an interrupted run left to do
        run(["git", "-C", ROOT, "--work-tree", of.source, "checkout", of.commit, "--", "."], "git checkout",
            env={**os.environ, "GIT_INDEX_FILE": of.build / "index"})
    pad(of, 1)  # CMake links its own checks with it
    generator = ["-G", "Ninja"] if shutil.which("ninja") and not (of.build / "CMakeCache.txt").exists() else []
    run(["cmake", "-S", of.source, "-B", of.build, *generator, "-DCMAKE_BUILD_TYPE=Release",
         f'-DCMAKE_EXE_LINKER_FLAGS="{of.build}/padding.cpp"'], f"the configuration of {of.title}")


def linked(of, path):
    """Builds the revision's benchmark with all of its code moved by a random number of bytes. Its copy stays when the next is built."""
    pad(of, random.randint(1, PAGE))
    (of.build / PROGRAM).unlink(missing_ok=True)
    run(["cmake", "--build", of.build, "--parallel", str(len(os.sched_getaffinity(0))), "--target", PROGRAM], f"the build of {of.title}")
    return shutil.copy(of.build / PROGRAM, path)


def timed(program, pattern):
    """{name: row} of one start of a program."""
    out = program.with_suffix(".json")
    run([f"./{program.name}", f"--benchmark_filter={pattern}", f"--benchmark_repetitions={REPETITIONS}",
         f"--benchmark_min_time={MIN_TIME_S}", f"--benchmark_out={out.name}", "--benchmark_out_format=json"],
        PROGRAM, (0, 1), cwd=program.parent,  # 1: a row drew other pixels
        env={**os.environ, "EDGEWISE_PADDING": "x" * random.randrange(PAGE)})
    return read_bench(out).rows


def add_round(side, found):
    """Adds a round's medians to the rows of a side. An error stays."""
    for name, row in found.items():
        whole = side.setdefault(name, replace(row, times_ms=[], rounds=True))
        whole.error = whole.error or row.error
        whole.times_ms += [] if row.error else [row.median_ms]


def compare_revisions(before, after, pattern, rounds):
    """Prints the verdicts on the rows that match."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # ends all as Ctrl-C does
    for of in dict.fromkeys((before, after)):
        configure(of)
    sides = {}, {}
    with tempfile.TemporaryDirectory(prefix="rounds-", dir=BUILDS) as folder:
        programs = [[linked(of, Path(folder, f"{side}{i:04}")) for side, of in zip("ab", (before, after))] for i in range(rounds)]
        print(f"Timing {rounds} rounds", flush=True)
        for i in range(rounds):
            # Before, after, after, before: a steady drift of the machine favours neither side.
            for side in (0, 1) if i % 2 == 0 else (1, 0):
                add_round(sides[side], timed(programs[i][side], pattern))
            shared = sides[0].keys() & sides[1].keys()
            if not shared:
                raise BadInput(f"no row of both revisions matches '{pattern}'")
            fewest = noise.fewest_rounds(noise.LEVEL / len(shared))
            if rounds < fewest:
                raise BadInput(f"{rounds} rounds settle nothing; {fewest} are the fewest for {len(shared)} rows")
    print(f"Before: {before.title}\nAfter:  {after.title}\n\n{rounds} rounds, before and after by turns; ", end="")
    print_compared(*sides, VERDICTS)


def obstacle(before, after):
    """Why two rows cannot be compared; None stands for a missing one."""
    if before is None or after is None:
        return "only after" if after else "only before"
    if before.error or after.error:
        return f"error, {before.error or after.error}"
    other_work = any(before.counters.get(key) != after.counters.get(key) for key in ("triangles", "covered_px", "width", "height"))
    return "other triangles, pixels or size" if other_work else None


def judged(times):
    """The verdict on each pair of rows, as of bench_rows.compared(), and how many are false. Rounds are judged as a family. Two
    results have too many rows with too few repetitions for that."""
    claims = [noise.claim(*of) for of in times]
    if all(are_rounds for *_, are_rounds in times):
        return noise.family(claims), f"The chance that any of these changes is false: at most {100 * noise.LEVEL:g} %."
    return ([noise.settled(*claim) for claim in claims],
            f"If nothing changed, at most {number(noise.LEVEL * len(times), 2)} rows in {len(times)} would be told as changed.")


def line(name, times, width):
    before_ms, after_ms, _ = times
    low, high = noise.ratio_interval(*times)
    return (f"  {name:<{width}} {noise.median(before_ms):>8.3f} → {noise.median(after_ms):>8.3f} ms "
            f"{noise.median_ratio(*times):>6.3f}  ({low:.3f} to {high:.3f})")


def print_compared(before, after, shown, least=0.0):
    """Prints the verdicts on the rows of two sides, and lists the rows of those in `shown`. Changes below `least` don't count."""
    obstacles = {name: obstacle(before.get(name), after.get(name)) for name in {**before, **after}}
    times = {name: compared(before[name], after[name]) for name, why in obstacles.items() if not why}
    ratios = {name: noise.median_ratio(*of) for name, of in times.items()}
    orders, doubt = judged(times.values())
    groups = {verdict: [] for verdict in VERDICTS}
    for name, order in zip(times, orders):
        groups[order if abs(ratios[name] - 1) >= least else SAME].append(name)
    print(f"{len(times)} rows: " + ", ".join(f"{len(group)} {VERDICTS[verdict]}" for verdict, group in groups.items()))
    print(f"Columns: medians, ratio (after / before), its {noise.CONFIDENCE:.0%} interval")
    for verdict in shown:
        if group := sorted(groups[verdict], key=ratios.get, reverse=True):
            print(f"\n{VERDICTS[verdict].capitalize()}", *(line(name, times[name], max(map(len, times))) for name in group), sep="\n")
    if excluded := [f"  {why}: {name}" for name, why in obstacles.items() if why]:
        print("\nNot compared", *sorted(excluded), sep="\n")
    if times:
        print(f"\n{doubt}\n\n{means(ratios)}")


def means(ratios):
    """A line of the geometric means of {row: ratio}: of the rows whose names begin alike, up to the first "/", whole frames
    included, and of all."""
    groups = {}
    for name, ratio in ratios.items():
        groups.setdefault(name.split("/")[0].removesuffix("+frontend"), []).append(ratio)
    told = [f"{name} {geometric_mean(of):.3f}" for name, of in (*sorted(groups.items()), ("all", ratios.values()))]
    return "Geometric means of the ratios: " + ", ".join(told)
