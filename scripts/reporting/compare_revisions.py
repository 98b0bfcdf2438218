"""Compares rows of two results; or builds the benchmark of two revisions, times both by turns, and judges each row by its paired
rounds."""
import math
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import geometric_mean

import noise
from bench_rows import read_bench
from program import ROOT, BadInput, git, write_json
from tables import number, percent

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


def other_work(before, after):
    keys = ("triangles", "covered_px", "width", "height")
    return any(before.counters.get(k) != after.counters.get(k) for k in keys)


@dataclass(frozen=True)
class Revision:
    commit: str  # empty: the working tree
    title: str

    @property
    def folder(self):
        return BUILDS / (self.commit[:12] or "working-tree")

    @property
    def build(self):
        return self.folder / "build"


def revision(name):
    """None if there is no such revision."""
    if name == WORKING_TREE:
        return Revision("", "the working tree")
    commit = git("rev-parse", "--verify", "--quiet", "--end-of-options", name + "^{commit}")
    return Revision(commit, git("log", "-1", "--format=%h %s", commit)) if commit else None


def finished(command, **options):
    """The ended process, with its output. An interruption ends its children, too."""
    try:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, errors="replace",
                                   start_new_session=True, **options)
    except OSError as error:
        raise BadInput(f"{command[0]}: {error.strerror}") from None
    with process:
        try:
            output, errors = process.communicate()
            return subprocess.CompletedProcess(command, process.returncode, output, errors)
        except BaseException:
            os.killpg(process.pid, signal.SIGTERM)  # Ninja then ends its compilers
            raise


def run(command, what):
    """Raises BadInput, after the last lines of the output, if the command fails."""
    done = finished(command, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        print(*done.stdout.splitlines()[-LINES_OF_A_FAILURE:], sep="\n", file=sys.stderr)
        raise BadInput(f"{what} failed; see above")


def extract(of):
    """The folder of the revision's sources, complete or not at all."""
    if of.folder.is_dir():
        return of.folder
    BUILDS.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="sources-", dir=BUILDS) as folder:
        partial, archive = Path(folder) / "sources", Path(folder) / "sources.tar"
        partial.mkdir()
        run(["git", "-C", ROOT, "archive", "--output", archive, of.commit], "git archive")
        run(["tar", "-xf", archive, "-C", partial], "tar")
        partial.rename(of.folder)
    return of.folder


def pad(folder, size):
    """Makes the object that the benchmark in this folder links first, so that it moves all other code."""
    (folder / "padding.cpp").write_text(f'asm(".skip {size}");\n', encoding="utf-8")
    run(["c++", "-c", folder / "padding.cpp", "-o", folder / "padding.o"], "the compiler")


def link(of, padding):
    """Builds the revision's benchmark with all of its code moved by so many bytes."""
    pad(of.build, padding)
    (of.build / PROGRAM).unlink(missing_ok=True)
    run(["cmake", "--build", of.build, "--parallel", str(len(os.sched_getaffinity(0))), "--target", PROGRAM], f"the build of {of.title}")


def build(of):
    source = extract(of) if of.commit else ROOT
    print(f"Building {of.title}", flush=True)
    configure = ["cmake", "-S", source, "-B", of.build, "-DCMAKE_BUILD_TYPE=Release", f'-DCMAKE_EXE_LINKER_FLAGS="{of.build}/padding.o"']
    if not (of.build / "CMakeCache.txt").is_file():
        configure += ["-G", "Ninja"] if shutil.which("ninja") else []
    of.build.mkdir(parents=True, exist_ok=True)
    pad(of.build, 1)  # CMake links its own checks with it
    run(configure, f"the configuration of {of.title}")
    link(of, 1)


@contextmanager
def copies(revisions, rounds):
    """Of each side a folder with a program for each round, with paths of one length, which no build changes; removed in the end."""
    with tempfile.TemporaryDirectory(prefix="rounds-", dir=BUILDS) as folder:
        sides = [Path(folder) / side for side in "ab"]
        for of, side in zip(revisions, sides):
            for i in range(rounds):
                show(f"linking {side.name}, {i + 1} of {rounds}")
                link(of, random.randint(1, PAGE))
                program(side, i).parent.mkdir(parents=True)
                shutil.copy(of.build / PROGRAM, program(side, i))
        yield sides


def program(side, i):
    return side / f"{i:04}" / PROGRAM


def started(side, i, *flags):
    """Runs a program of this side in its folder. Both sides have the same arguments, since their length can move the stack."""
    environment = {**os.environ, "EDGEWISE_PADDING": "x" * random.randrange(PAGE)}
    done = finished([f"./{program(side, i).relative_to(side)}", *flags], cwd=side, env=environment, stderr=subprocess.PIPE)
    if done.returncode not in (0, 1):  # 1: a row drew other pixels
        raise BadInput(f"{PROGRAM} ended with {done.returncode}: {(done.stderr.strip().splitlines() or ['no message'])[-1]}")
    return done.stdout


def names(side, pattern):
    """The rows that match. Programs differ in how they report that none does."""
    try:
        listed = started(side, 0, "--benchmark_list_tests=true", f"--benchmark_filter={pattern}")
    except BadInput:
        return []
    return [name for line in listed.splitlines() if re.fullmatch(r"\S+/\S+", name := line.strip())]


def timed(side, i, pattern):
    """The benchmark's results, from one start of a program."""
    out = side / "round.json"
    out.unlink(missing_ok=True)
    started(side, i, f"--benchmark_filter={pattern}", f"--benchmark_repetitions={REPETITIONS}",
            f"--benchmark_min_time={MIN_TIME_S}", f"--benchmark_out={out.name}", "--benchmark_out_format=json")
    return read_bench(out)


VERDICTS = SLOWER, FASTER, FEW, SAME = "slower", "faster", "too few repetitions", "no significant difference"


@dataclass
class Row:
    sides: list  # the rows before and after, with their counters; of rounds the last
    ms: tuple  # of each side, the time of each round
    rounds: bool = True  # else the two were timed at different times, with one repetition a round
    least: float = 0.0  # smaller changes don't count
    verdict: str = SAME

    @property
    def error(self):
        return self.sides[0].error or self.sides[1].error

    @property
    def ratio(self):
        return noise.median_ratio(*self.ms, self.rounds)

    @property
    def interval(self):
        return noise.ratio_interval(*self.ms, self.rounds)

    @property
    def claim(self):
        """noise.claim() that the times differ."""
        before_ms, after_ms = self.ms
        return noise.paired_claim(before_ms, after_ms) if self.rounds else noise.claim(after_ms, before_ms)

    def told(self, order):
        if abs(self.ratio - 1) < self.least:
            return SAME
        few = not self.rounds and not noise.enough(*map(len, self.ms))
        return {-1: FASTER, 0: FEW if few else SAME, 1: SLOWER}[order]


def judge(rows):
    """Sets the verdicts. Rows of rounds are judged as a family. Two results have too many rows with too few repetitions for that."""
    claims = [row.claim for row in rows]
    orders = noise.family(claims) if all(row.rounds for row in rows) else [noise.settled(*claim) for claim in claims]
    for row, order in zip(rows, orders):
        row.verdict = row.told(order)


def show(text):
    """A line on a terminal that the next one replaces; empty: removes it."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def time_rounds(sides, pattern, fewest, rounds, limit_s):
    """{name: Row} after `rounds`; where it is None, after as many of ROUNDS as fit into `limit_s`."""
    rows, start = {}, time.monotonic()
    for i in range(rounds or ROUNDS):
        spent = time.monotonic() - start
        fit = i * limit_s / spent if i and rounds is None else math.inf
        if i == 1 and fit < fewest:
            raise BadInput(f"one round takes {spent:.0f} s, and {fewest} are the fewest that settle so many rows: "
                           f"--minutes {fewest * spent / 60 + 1:.0f} or fewer rows are needed")
        if i + 1 > fit:
            break
        show(f"round {i + 1} of {rounds or ROUNDS}, {spent:.0f} s{'' if rounds else f' of {limit_s:.0f}'}")
        # Before, after, after, before: a steady drift of the machine favours neither side.
        results = {side: timed(sides[side], i, pattern) for side in ((0, 1) if i % 2 == 0 else (1, 0))}
        for name in (name for name in results[0].rows if name in results[1].rows):
            now = [results[side].rows[name] for side in (0, 1)]
            row = rows.setdefault(name, Row(now, ([], [])))
            if bool(row.error) != any(side.error for side in now):
                raise BadInput(f"{name}: some rounds failed, others did not: the programs draw different pixels from time to time")
            row.sides = now
            for ms, new in zip(row.ms, () if row.error else now):
                ms.append(new.median_ms)
    show("")
    return rows


def line(name, row, width):
    low, high = row.interval
    before_ms, after_ms = map(noise.median, row.ms)
    return (f"  {name:<{width}} {before_ms:>8.3f} → {after_ms:>8.3f} ms "
            f"{row.ratio:>6.3f}  ({low:.3f} to {high:.3f})")


def print_rows(rows, medians_of, verdicts):
    groups = {verdict: {name: row for name, row in rows.items() if row.verdict == verdict} for verdict in VERDICTS}
    print(f"{len(rows)} rows: " + ", ".join(f"{len(group)} {verdict}" for verdict, group in groups.items() if group or verdict != FEW))
    print(f"Columns: medians of the {medians_of}, ratio (after / before), its {noise.CONFIDENCE:.0%} interval")
    width = max(map(len, rows), default=0)
    for verdict in verdicts:
        if group := groups[verdict]:
            print(f"\n{verdict.capitalize()}", *(line(name, row, width) for name, row in
                                                sorted(group.items(), key=lambda item: -item[1].ratio)), sep="\n")


def record(before, after, pattern, rounds, rows):
    return {"before": before.title, "after": after.title, "filter": pattern, "rounds": rounds, "layouts": True, "level": noise.LEVEL,
            "confidence": noise.CONFIDENCE,
            "rows": [{"name": name, "verdict": row.verdict, "ratio": row.ratio, **dict(zip(("low", "high"), row.interval)),
                      **dict(zip(("before_ms", "after_ms"), row.ms))} for name, row in rows.items()]}


def compare_revisions(before, after, pattern, rounds, minutes, out):
    """Prints the verdicts; `rounds` or None, `out`: a path for JSON or None."""
    if out and not out.resolve().parent.is_dir():
        raise BadInput(f"cannot write {out}: there is no such folder")
    for of in dict.fromkeys((before, after)):
        build(of)
    with copies((before, after), rounds or ROUNDS) as sides:
        listed = [names(side, pattern) for side in sides]
        shared = [name for name in listed[0] if name in listed[1]]
        if not shared:
            raise BadInput(f"no row of both revisions matches '{pattern}'")
        fewest = noise.fewest_rounds(noise.LEVEL / len(shared))
        if (rounds or ROUNDS) < fewest:
            raise BadInput(f"{rounds or ROUNDS} rounds settle nothing; {fewest} are the fewest for {len(shared)} rows")
        rows = time_rounds(sides, pattern, fewest, rounds, 60 * minutes)
    print(f"Before: {before.title}\nAfter:  {after.title}")
    done, judged = print_compared(rows, listed)
    if out:
        write_json(out, record(before, after, pattern, done, judged))
    return 0


def means(ratios):
    """A line of the geometric means of {row: ratio}: of the rows whose names begin alike, up to the first "/", whole frames
    included, and of all."""
    groups = {}
    for name, ratio in ratios.items():
        groups.setdefault(name.split("/")[0].removesuffix("+frontend"), []).append(ratio)
    told = [f"{name} {geometric_mean(of):.3f}" for name, of in (*sorted(groups.items()), ("all", ratios.values()))]
    return "Geometric means of the ratios: " + ", ".join(told)


def print_compared(rows, listed, verdicts=VERDICTS):
    """Prints rows and `listed` names of both sides. Returns the number of rounds and the judged rows."""
    failed = [f"{name}: {row.error}" for name, row in rows.items() if row.error]
    different = [name for name, row in rows.items() if not row.error and other_work(*row.sides)]
    judged = {name: row for name, row in rows.items() if not row.error and name not in different}
    judge(judged.values())
    done = max((len(row.ms[0]) for row in rows.values() if row.rounds), default=0)
    print(f"\n{done} rounds, before and after by turns; " if done else "", end="")
    print_rows(judged, "rounds" if done else "repetitions", verdicts)
    if judged and done:
        print(f"\nThe chance that any of these changes is false: at most {percent(noise.LEVEL)}.")
    elif judged:
        print(f"\nIf nothing changed, at most {number(noise.LEVEL * len(judged), 2)} rows in {len(judged)} would be told as changed.")
    before, after = listed
    for title, names_of in (("Not compared: other triangles, pixels or size", different), ("Not compared: error", failed),
                            ("Only before", [name for name in before if name not in after]),
                            ("Only after", [name for name in after if name not in before])):
        if names_of:
            print(f"\n{title}", *(f"  {name}" for name in names_of), sep="\n")
    if judged:
        print("\n" + means({name: row.ratio for name, row in judged.items()}))
    return done, judged


def interruptible(compare):
    """Runs compare(); Ctrl-C and SIGTERM end it without a result."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return compare()
    except KeyboardInterrupt:
        show("")
        print("compare: interrupted: no result", file=sys.stderr)
        return 130
