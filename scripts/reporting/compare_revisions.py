"""Compares rows of two results; or builds the benchmark of two revisions, times both by turns, and judges each row by its paired
rounds. Checks that judge on one revision against itself."""
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import noise
from bench_rows import read_bench, records
from program import BadInput, parsed, write_json
from tables import percent

ROOT = Path(__file__).resolve().parents[2]
BUILDS = ROOT / "build" / "compare"
PROGRAM = "edgewise_bench"
WORKING_TREE = "."
# In each round, a row's time is the fastest of REPETITIONS, each of at least MIN_TIME_S: other load on the machine only adds
# time. Start-up takes about a second, so they cost little.
REPETITIONS, MIN_TIME_S = 5, 0.01
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


def git(*arguments):
    """Its output; None if it fails."""
    done = subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else None


def revision(name):
    """None if there is no such revision."""
    if name == WORKING_TREE:
        return Revision("", "the working tree")
    commit = git("rev-parse", "--verify", "--quiet", "--end-of-options", name + "^{commit}")
    return Revision(commit, git("log", "-1", "--format=%h %s", commit)) if commit else None


def finished(command, **options):
    """The ended process and its output. An interruption ends its children, too."""
    try:
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, text=True, errors="replace", start_new_session=True, **options)
    except OSError as error:
        raise BadInput(f"{command[0]}: {error.strerror}") from None
    with process:
        try:
            return process, *process.communicate()
        except BaseException:
            os.killpg(process.pid, signal.SIGTERM)  # Ninja then ends its compilers
            raise


def run(command, what):
    """Raises BadInput, after the last lines of the output, if the command fails."""
    done, output, _ = finished(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        print(*output.splitlines()[-LINES_OF_A_FAILURE:], sep="\n", file=sys.stderr)
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


def build(of):
    """The path of the revision's benchmark."""
    source, folder = extract(of) if of.commit else ROOT, of.folder / "build"
    print(f"Building {of.title}", flush=True)
    configure = ["cmake", "-S", source, "-B", folder, "-DCMAKE_BUILD_TYPE=Release"]
    if not (folder / "CMakeCache.txt").is_file():
        configure += ["-G", "Ninja"] if shutil.which("ninja") else []
    run(configure, f"the configuration of {of.title}")
    run(["cmake", "--build", folder, "--parallel", str(len(os.sched_getaffinity(0))), "--target", PROGRAM], f"the build of {of.title}")
    return folder / PROGRAM


@contextmanager
def copies(programs):
    """Copies that no build changes, with paths of one length, removed in the end."""
    BUILDS.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="rounds-", dir=BUILDS) as folder:
        paths = [Path(folder) / side for side in "ab"]
        for program, path in zip(programs, paths):
            path.mkdir()
            shutil.copy(program, path / PROGRAM)
        yield paths


def started(folder, *flags):
    """Runs the program of this folder there. Both sides have the same arguments, since their length can move the stack."""
    done, output, errors = finished([f"./{PROGRAM}", *flags], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if done.returncode not in (0, 1):  # 1: a row drew other pixels
        raise BadInput(f"{PROGRAM} ended with {done.returncode}: {(errors.strip().splitlines() or ['no message'])[-1]}")
    return output


def names(folder, pattern):
    """The rows that match. Programs differ in how they report that none does."""
    try:
        listed = started(folder, "--benchmark_list_tests=true", f"--benchmark_filter={pattern}")
    except BadInput:
        return []
    return [name for line in listed.splitlines() if re.fullmatch(r"\S+/\S+", name := line.strip())]


def timed(folder, pattern):
    """The benchmark's rows, from one start of the program."""
    out = folder / "round.json"
    out.unlink(missing_ok=True)
    started(folder, f"--benchmark_filter={pattern}", f"--benchmark_repetitions={REPETITIONS}",
            f"--benchmark_min_time={MIN_TIME_S}", f"--benchmark_out={out.name}", "--benchmark_out_format=json")
    return read_bench(out).rows


FASTER, SLOWER, SAME, FEW = "faster", "slower", "no significant difference", "too few repetitions"


@dataclass
class Row:
    """One row of both sides, with their times. Of rounds, the last round's rows hold the counters."""
    before: object
    after: object
    before_ms: list
    after_ms: list
    rounds: bool = True  # else the two were timed at different times
    least: float = 0.0  # smaller changes don't count

    @property
    def error(self):
        return self.before.error or self.after.error

    @property
    def ratio(self):
        return noise.median_ratio(self.before_ms, self.after_ms, self.rounds)

    @property
    def interval(self):
        return noise.ratio_interval(self.before_ms, self.after_ms, self.rounds)

    @property
    def verdict(self):
        if abs(self.ratio - 1) < self.least:
            return SAME
        order = noise.paired_order(self.before_ms, self.after_ms) if self.rounds else noise.order(self.after_ms, self.before_ms)
        few = not self.rounds and not noise.enough(len(self.before_ms), len(self.after_ms))
        return {-1: FASTER, 0: FEW if few else SAME, 1: SLOWER}[order]


def show(text):
    """A line on a terminal that the next one replaces; empty: removes it."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def time_rounds(folders, pattern, rounds, limit_s):
    """{name: Row} after `rounds`, or after as many as fit into `limit_s` where `rounds` is None."""
    rows, start = {}, time.monotonic()
    try:
        for done in count():
            spent = time.monotonic() - start
            fit = done * limit_s / spent if done else 0
            if rounds is None and done == 1 and fit < noise.fewest_rounds():
                raise BadInput(f"one round takes {spent:.0f} s, and {noise.fewest_rounds()} are the fewest that settle a row: "
                               f"--minutes {noise.fewest_rounds() * spent / 60 + 1:.0f} or fewer rows are needed")
            if done == rounds or rounds is None and done and done + 1 > fit:
                return rows
            show(f"round {done + 1}{f' of {rounds}' if rounds else ''}, {spent:.0f} s"
                 f"{'' if rounds else f' of {limit_s:.0f}'}")
            # Before, after, after, before: a steady drift of the machine favours neither side.
            sides = [None, None]
            for side in (0, 1) if done % 2 == 0 else (1, 0):
                sides[side] = timed(folders[side], pattern)
            for name in (name for name in sides[0] if name in sides[1]):
                row = rows.setdefault(name, Row(None, None, [], []))
                row.before, row.after = (side[name] for side in sides)
                if not row.error:
                    row.before_ms.append(min(row.before.times_ms))
                    row.after_ms.append(min(row.after.times_ms))
    finally:
        show("")


def line(name, row, width):
    low, high = row.interval
    return (f"  {name:<{width}} {noise.median(row.before_ms):>9.3f} → {noise.median(row.after_ms):>9.3f} ms "
            f"{row.ratio:>7.3f}  ({low:.3f} to {high:.3f})")


def print_names(title, found):
    if found:
        print(f"\n{title}", *(f"  {name}" for name in found), sep="\n")


def print_rows(rows, medians_of, verdicts=(SLOWER, FASTER, FEW, SAME)):
    groups = {verdict: {name: row for name, row in rows.items() if row.verdict == verdict} for verdict in (SLOWER, FASTER, FEW, SAME)}
    print(f"{len(rows)} rows: " + ", ".join(f"{len(group)} {verdict}" for verdict, group in groups.items() if group or verdict != FEW))
    print(f"Columns: medians of the {medians_of}, ratio (after / before), its {noise.CONFIDENCE:.0%} interval")
    width = max(map(len, rows), default=0)
    for verdict in verdicts:
        if group := groups[verdict]:
            print(f"\n{verdict.capitalize()}", *(line(name, row, width) for name, row in
                                                sorted(group.items(), key=lambda item: -item[1].ratio)), sep="\n")


def record(before, after, pattern, rounds, rows):
    def one(name, row):
        low, high = row.interval
        return {"name": name, "verdict": row.verdict, "ratio": row.ratio, "low": low, "high": high,
                "before_ms": row.before_ms, "after_ms": row.after_ms}

    return {"before": before.title, "after": after.title, "filter": pattern, "rounds": rounds, "level": noise.LEVEL,
            "confidence": noise.CONFIDENCE, "rows": [one(*item) for item in rows.items()]}


def compare_revisions(before, after, pattern, rounds, minutes, out):
    """Prints the verdicts; `rounds` or None, `out`: a path for JSON or None."""
    if out and not out.resolve().parent.is_dir():
        raise BadInput(f"cannot write {out}: there is no such folder")
    programs = {of: build(of) for of in dict.fromkeys((before, after))}
    with copies([programs[before], programs[after]]) as folders:
        listed = [names(folder, pattern) for folder in folders]
        shared = [name for name in listed[0] if name in listed[1]]
        if not shared:
            raise BadInput(f"no row of both revisions matches '{pattern}'")
        rows = time_rounds(folders, pattern, rounds, 60 * minutes)
    print(f"Before: {before.title}\nAfter:  {after.title}")
    done, judged = print_compared(rows, listed)
    if out:
        write_json(out, record(before, after, pattern, done, judged))
    return 0


def print_compared(rows, listed, verdicts=(SLOWER, FASTER, FEW, SAME)):
    """Prints rows and `listed` names of both sides. Returns the number of rounds and the judged rows."""
    failed = [f"{name}: {row.error}" for name, row in rows.items() if row.error]
    different = [name for name, row in rows.items() if not row.error and other_work(row.before, row.after)]
    judged = {name: row for name, row in rows.items() if not row.error and name not in different}
    done = max((len(row.before_ms) for row in rows.values() if row.rounds), default=0)
    if any(row.rounds and len(row.before_ms) < done for row in judged.values()):
        raise BadInput("some rounds failed, others did not: the programs draw different pixels from time to time")
    print(f"\n{done} rounds, before and after by turns; " if done else "", end="")
    print_rows(judged, "rounds" if done else "repetitions", verdicts)
    print_names("Not compared: other triangles, pixels or size", different)
    print_names("Not compared: error", failed)
    for side, other, title in ((0, 1, "Only before"), (1, 0, "Only after")):
        print_names(title, [name for name in listed[side] if name not in listed[other]])
    return done, judged


def interruptible(compare):
    """Runs compare(); Ctrl-C and SIGTERM end it without a result."""
    def end(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, end)
    try:
        return compare()
    except KeyboardInterrupt:
        print("compare: interrupted: no result", file=sys.stderr)
        return 130


PLANTED = 1.02


def differing(pairs):
    """(pairs that differ, pairs)"""
    found = [noise.paired_order(before, after) for before, after in pairs]
    return sum(map(bool, found)), len(found)


def in_blocks(pairs, rounds):
    return [(before[i:i + rounds], after[i:i + rounds]) for before, after in pairs for i in range(0, len(before) - rounds + 1, rounds)]


def parse_same(data):
    """[(milliseconds before, after)] of each row, and the number of rounds."""
    if data["before"] != data["after"]:
        raise ValueError("two different revisions")
    return [(row["before_ms"], row["after_ms"]) for row in data["rows"]], data["rounds"]


def noise_table(folder):
    """Header and lines from same.json, written by `scripts/compare REV REV --json`: false alarms, and how often a planted slowdown is found, of all machines; no lines if not measured."""
    lines = []
    for path in records(folder, "same*"):
        pairs, rounds = parsed(path, parse_same, "scripts/compare --json")
        found = sum(noise.paired_order(before, [PLANTED * ms for ms in after]) > 0 for before, after in pairs)
        alarms = ["{} of {}".format(*differing(of)) for of in (pairs, in_blocks(pairs, noise.fewest_rounds()))]
        lines.append([f"`{path.parent.name}`", str(rounds), *alarms, f"{found} of {len(pairs)}"])
    return ["machine", "rounds", "false alarms", f"false alarms in blocks of {noise.fewest_rounds()} rounds", f"{percent(PLANTED - 1)} slowdowns found"], lines
