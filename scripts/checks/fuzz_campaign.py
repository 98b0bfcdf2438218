"""Runs the fuzz targets of a build folder side by side, and reports coverage and crashes. See scripts/fuzz."""
import argparse
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FUZZ = ROOT / "tests" / "fuzz"
SECONDS_A_RUN = 20  # longer is a hang
# A target's input, its most bytes, and the sources whose coverage is reported.
TARGETS = {
    "obj": ("any bytes as an .obj file", 1024, ("src/scene/obj_file.cpp", "src/scene/polygon.cpp")),
    "tri": ("any bytes as a .tri file", 1000, ("src/scene/tri_file.cpp", "src/frontend/stream.cpp",
                                               "src/frontend/clip.cpp", "src/frontend/one_by_one.cpp")),
    "options": ("any bytes as a command line", 400, ("src/cli/run.cpp", "src/support/options.cpp", "src/core/nearest_name.cpp",
                                                     "src/support/printable.cpp")),
    "triangles": ("any bytes as triangles, all backends against each other", 600, ("src/raster/",)),
}


class Target:
    def __init__(self, name, build):
        self.name, self.program = name, build / f"fuzz_{name}"
        self.what, self.max_bytes, self.sources = TARGETS[name]
        self.found, self.crashes = build / "found" / name, build / "crashes" / name
        self.log = build / f"fuzz_{name}.log"
        self.profile = build / f"fuzz_{name}.profraw"  # each run leaves one
        self.seeds = [FUZZ / kind / name for kind in ("corpus", "regressions")]
        for folder in (self.found, self.crashes):
            folder.mkdir(parents=True, exist_ok=True)

    def command(self, *arguments):
        dictionary = FUZZ / f"{self.name}.dict"
        words = [f"-dict={dictionary}"] if dictionary.exists() else []
        return [str(self.program), *map(str, arguments), *words, f"-max_len={self.max_bytes}",
                f"-timeout={SECONDS_A_RUN}", "-rss_limit_mb=2048", f"-artifact_prefix={self.crashes}/"]

    def run(self, *arguments):
        """Its output and exit status."""
        done = subprocess.run(self.command(*arguments), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              stdin=subprocess.DEVNULL, errors="replace", check=False,
                              env={**os.environ, "LLVM_PROFILE_FILE": str(self.profile)})
        self.log.write_text(done.stdout)
        return done.stdout, done.returncode

    def corpus(self):
        return [folder for folder in (self.found, *self.seeds) if folder.is_dir()]

    def fuzz(self, seconds):
        """Until the time is up, continuing after each crash."""
        before, end = set(self.crashes.iterdir()), time.monotonic() + seconds
        executions = 0
        while (left := round(end - time.monotonic())) > 0:
            text, status = self.run(*self.corpus(), f"-max_total_time={left}", "-print_final_stats=1")
            executions += int(last(r"stat::number_of_executed_units: (\d+)", text) or last(r"^#(\d+)\s", text) or 0)
            if status != 0 and set(self.crashes.iterdir()) == before:
                fail(f"{self.name} failed without a crash; see {self.log}")
            if status == 0 or len(set(self.crashes.iterdir()) - before) >= 10:
                break
        reproducers = sorted(set(self.crashes.iterdir()) - before)
        return {"name": self.name, "what": self.what, "seconds": round(seconds + time.monotonic() - end, 1), "executions": executions,
                **self.coverage(), "inputs": sum(len(list(folder.iterdir())) for folder in self.corpus()),
                "crashes": [str(path.relative_to(ROOT)) for path in reproducers]}

    def coverage(self):
        """Lines of the target's sources that the inputs reach so far, and all of them."""
        self.run(*self.corpus(), "-runs=0")
        profile = self.log.with_suffix(".profdata")
        subprocess.run(["llvm-profdata-16", "merge", "-o", profile, self.profile], check=True)
        report = subprocess.run(["llvm-cov-16", "export", "-summary-only", "-instr-profile", profile, self.program],
                                check=True, stdout=subprocess.PIPE).stdout
        files = [file for file in json.loads(report)["data"][0]["files"]
                 if os.path.relpath(file["filename"], ROOT).startswith(self.sources)]  # system headers lie elsewhere
        return {name: sum(file["summary"]["lines"][key] for file in files)
                for name, key in (("lines_reached", "covered"), ("lines", "count"))}

    def keep(self):
        """Adds inputs with new coverage to the corpus; returns their number."""
        corpus = self.seeds[0]
        before = len(list(corpus.iterdir()))
        # Edges only, not their counts: the corpus must stay small.
        _, status = self.run(corpus, *self.corpus(), "-set_cover_merge=1", "-use_counters=0")
        if status != 0:
            fail(f"{self.name} could not be merged; see {self.log}")
        return len(list(corpus.iterdir())) - before


def commit():
    """Of the sources; ends in -dirty if they have changed, as in src/support/machine.cpp."""
    def git(*arguments):
        return subprocess.run(["git", "--no-optional-locks", "-C", ROOT, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True, check=False).stdout.strip()

    changes = git("status", "--porcelain", "--", ":/", ":(top,exclude)results")
    return git("rev-parse", "--short=12", "HEAD") + ("-dirty" if changes else "") or "unknown"


def fail(what):
    print(f"fuzz: {what}", file=sys.stderr)
    sys.exit(2)


def read_record(path, now):
    """The results to which this run of commit `now` adds, by target; none if the file does not exist."""
    if path is None:
        return {}
    if now == "unknown" or now.endswith("-dirty"):
        fail(f"only results of one commit add up; the sources are of {now}")
    if not path.exists():
        return {}
    try:
        record = json.loads(path.read_text())
        known = [(row["name"], row["seconds"], row["executions"], row["crashes"]) for row in record["targets"]]
        of = record["commit"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        fail(f"{path} is not a record of fuzzing: {error!r}")
    if of != now:
        fail(f"{path} is of commit {of}, and this is {now}")
    return {name: {"seconds": seconds, "executions": executions, "crashes": crashes} for name, seconds, executions, crashes in known}


def added(row, before):
    """A target's results after those of earlier runs. Its coverage is that of the inputs that this run has."""
    return {**row, **{key: round(before[key] + row[key], 1) if key == "seconds" else before[key] + row[key] for key in before}}


def last(pattern, text):
    found = re.findall(pattern, text, re.MULTILINE)
    return found[-1] if found else None


def main():
    parser = argparse.ArgumentParser(prog="fuzz", description=__doc__)
    parser.add_argument("build", type=Path)
    parser.add_argument("--minutes", type=float, required=True)
    record = parser.add_mutually_exclusive_group()
    record.add_argument("--json", type=Path)
    record.add_argument("--resume", type=Path)
    parser.add_argument("--keep", action="store_true")
    options = parser.parse_args()
    if options.keep and options.resume:
        parser.error("--keep changes the sources, so the results of further runs could not be added: leave out --resume")

    now = commit()
    before = read_record(options.resume, now)
    targets = [Target(name, options.build) for name in TARGETS]
    slots = min(len(targets), len(os.sched_getaffinity(0)))
    seconds = max(1, round(60 * options.minutes * slots / len(targets)))
    rows = []
    with concurrent.futures.ThreadPoolExecutor(slots) as pool:
        for row in pool.map(lambda target: target.fuzz(seconds), targets):
            rows.append(row)
            print(f"{row['name']:<10} {row['executions']:>10,} executions, {row['lines_reached']:,} of "
                  f"{row['lines']:,} lines, {row['inputs']:,} inputs, {len(row['crashes'])} crashes", flush=True)
            for path in row["crashes"]:
                print(f"  {path}")
    if options.keep:
        for target in targets:
            print(f"{target.name:<10} {target.keep()} inputs kept in {target.seeds[0].relative_to(ROOT)}/")
    if out := options.resume or options.json:
        total = [added(row, before.get(row["name"], {})) for row in rows]
        cpu_hours = round(sum(row["seconds"] for row in total) / 3600, 2)  # each target runs on one core
        partial = out.with_name(out.name + ".partial")
        partial.write_text(json.dumps({"commit": now, "cpu_hours": cpu_hours, "targets": total}, indent=2) + "\n")
        os.replace(partial, out)
    if any(row["crashes"] for row in rows):
        print("Crashes found: build-fuzz/fuzz_TARGET FILE reproduces one; after the fix, add FILE to "
              "tests/fuzz/regressions/TARGET/ under a name that says what it broke.", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
