"""Reads the files of a run, bench.json and machine.json: in build/results/MACHINE bench.json is Google Benchmark's, in results/MACHINE
it holds of each row only what reports use, as compact() writes it.

A row's name is DRAWER/scene/key:value…/threads:N. DRAWER is a backend, a peer (another project's rasterizer), "frontend",
BACKEND+frontend, "cell" for a whole frame of factors.py, "choice" for one of choice.py, "lab" for a method of the
laboratory, or "needs" for a pipeline of it.
"""
import os
from dataclasses import dataclass, field
from pathlib import Path

import noise
from program import parsed

COUNTERS = ("triangles", "width", "height", "covered_px", "overdraw", "depth_ties", "wrong_px")
DIGITS = 5  # of the times in results/: more than any noise, so that no verdict changes
GPU = "gpu"  # the peer that has no number of threads


@dataclass
class Row:
    name: str
    drawer: str  # without "+frontend"
    scene: str  # empty for sweeps over random triangles
    keys: dict
    times_ms: list = field(default_factory=list)
    counters: dict = field(default_factory=dict)
    error: str = ""
    rounds: bool = False  # its repetition i ran in the same round as repetition i of the run's other rows

    @property
    def median_ms(self):
        return noise.median(self.times_ms)

    @property
    def interval_ms(self):
        return noise.interval(self.times_ms)

    @property
    def threads(self):
        return int(self.keys.get("threads", "1"))


def compared(a, b):
    """The times of both rows, and whether they are pairs: those of the rounds that timed both."""
    rounds = min(len(a.times_ms), len(b.times_ms)) if a.rounds and b.rounds else None
    return a.times_ms[:rounds], b.times_ms[:rounds], rounds is not None


def order(a, b):
    """-1 where row a is faster than b, 1 where it is slower, 0 where their repetitions are too close to call."""
    return noise.settled(*noise.claim(*compared(b, a)))


def gained(before, after):
    """The speed-up from one row to another."""
    return noise.median_ratio(*compared(after, before))


def parse_name(name):
    who, *rest = name.split("/")
    scene = "/".join(part for part in rest if ":" not in part)
    return Row(name, who.removesuffix("+frontend"), scene, dict(part.split(":", 1) for part in rest if ":" in part))


@dataclass
class Bench:
    context: dict
    rows: dict  # by name

    @property
    def backends(self):
        return self.context.get("backends", "").split()

    @property
    def peers(self):
        return self.context.get("peers", "").split()

    def find(self, name):
        """The row, None if it was not timed."""
        row = self.rows.get(name)
        return row if row and row.times_ms else None

    def frame(self, who, scene, threads, target=None):
        """The row of a backend's or peer's whole frame, front end and backend; ours with the SIMD of `target`, by default the widest. A
        GPU's has one row, which is compared with ours on any number of threads."""
        limit = "" if target in (None, self.context["simd_target"]) else f"/target:{target}"
        return self.find(f"{who}+frontend/{scene}{limit}/threads:{1 if who == GPU else threads}")

    def sweep(self, key):
        """The timed rows that have this key."""
        return [r for r in self.rows.values() if key in r.keys and r.times_ms]

    @property
    def scenes(self):
        """The scenes of the main table, in the suite's order."""
        return list(dict.fromkeys(r.scene for r in self.rows.values() if r.scene and set(r.keys) == {"threads"}))


def facts_of(folder):
    """The folder of the facts beside a machine's folder."""
    return Path(os.path.normpath(Path(folder, "../facts")))


def records(folder, name):
    """The files NAME.json in results/, of all machines: this folder's first."""
    machines = folder.resolve().parent
    beside = sorted(machines.glob(f"*/{name}.json")) if machines.name == "results" else []
    return [*folder.glob(f"{name}.json"), *(path for path in beside if path.parent != folder.resolve())]


def joined(repetitions):
    """Rows as compact() writes them, of Google Benchmark's entries, one for each repetition."""
    rows = {}
    for entry in repetitions:
        if entry.get("run_type") == "aggregate":
            continue
        row = rows.setdefault(entry["name"], {"ms": []})
        if entry.get("error_occurred"):
            row["error"] = entry.get("error_message", "error")
            continue
        row["ms"].append(entry["real_time"])  # all our rows are in milliseconds
        row.update((key, entry[key]) for key in COUNTERS if key in entry)  # later rows say what differs
    return rows


def compact(bench):
    """What read_bench() reads, from its result: the times of all repetitions, since rows are compared round by round."""
    def rounded(value):
        return int(value) if value == int(value) else float(f"{value:.{DIGITS}g}")

    return {"context": bench.context,
            "rows": {name: {"ms": [rounded(ms) for ms in row.times_ms], **({"error": row.error} if row.error else {}),
                            **{key: rounded(value) for key, value in row.counters.items()}} for name, row in bench.rows.items()}}


def parse_bench(data):
    entries, context = data["rows"] if "rows" in data else joined(data["benchmarks"]), data.get("context", {})
    rounds = int(context.get("rounds", 0))  # of most rows; older runs shuffled all repetitions
    rows = {name: parse_name(name) for name in entries}
    for row, entry in zip(rows.values(), entries.values()):
        row.times_ms, row.error = [float(ms) for ms in entry["ms"]], entry.get("error", "")
        row.counters = {key: float(entry[key]) for key in COUNTERS if key in entry}
        row.rounds = 0 < rounds <= len(row.times_ms)
    return Bench(context, rows)


def read_bench(folder_or_file):
    path = Path(folder_or_file)
    return parsed(path / "bench.json" if path.is_dir() else path, parse_bench, "Google Benchmark' or 'scripts/publish")


def describe_machine(machine):
    """One line under every figure and table."""
    cores, usable = machine["cores"], machine["usable_cores"]
    part = "" if usable == cores else f"{usable} usable of "
    return (f"{machine['cpu_model']}, {part}{cores} core{'' if cores == 1 else 's'}, {machine['simd_best']}, {machine['memory_gib']} GiB; "
            f"{machine['os']}; {machine['compiler']}, {machine['build_type']}; commit {machine['commit']}")
