"""Estimated speed-ups on more cores."""
import re

from bench_rows import order
from speedups import about, mark
from tables import number


def scheduled(bench):
    """{(scene, backend): {cores: row}}, scene by scene."""
    found = {}
    for row in bench.sweep("cores"):
        found.setdefault((row.scene, row.backend), {})[int(row.keys["cores"])] = row
    scenes = list(dict.fromkeys(scene for scene, _ in found))
    return {key: dict(sorted(rows.items())) for key, rows in
            sorted(found.items(), key=lambda item: (scenes.index(item[0][0]), bench.backends.index(item[0][1])))
            if 1 in rows}


def allowed(rows):
    """{cores: estimated speed-up}: work over time of the same run, so that N cores never gain more than N."""
    return {cores: row.counters["work_ms"] / row.median_ms for cores, row in rows.items()}


def pair_measured(bench, scene, backend):
    """The rows of whole frames on one and on two threads; None if either is missing."""
    one, two = (bench.find(f"{backend}+frontend/{scene}/threads:{threads}") for threads in (1, 2))
    return (one, two) if one and two else None


def measured(bench, scene, backend):
    """{threads: speed-up over one thread} of whole frames."""
    pair = pair_measured(bench, scene, backend)
    return {1: 1.0, 2: pair[0].median_ms / pair[1].median_ms} if pair else {}


def quickest(bench):
    """For each scene the backend with the shortest estimated time on the most cores."""
    best = {}
    for (scene, backend), rows in scheduled(bench).items():
        time_ms = rows[max(rows)].median_ms
        if scene not in best or time_ms < best[scene][1]:
            best[scene] = backend, time_ms
    return {scene: backend for scene, (backend, _) in best.items()}


def serial_part(row):
    """The longest serial part, without the template arguments and namespaces that the compiler names."""
    text, nested = row.label, None
    while text != nested:
        nested, text = text, re.sub(r"<[^<>]*>|\([^()]*\)", "", text)
    return re.sub(r"\s+>", "", re.sub(r"(?:\w+::)+", "", text))


def scaling_table(bench):
    """Header and lines: one line per scene, for the backend with the shortest estimated time on the most cores."""
    found = scheduled(bench)
    all_cores = sorted({cores for rows in found.values() for cores in rows} - {1})
    shown = [cores for cores in all_cores if cores in (2, 8) or cores == all_cores[-1]]
    header = ["scene", "backend", "measured on 2", *(f"estimate for {cores}" for cores in shown), "longest serial part"]
    lines = []
    for scene, backend in quickest(bench).items():
        rows = found[scene, backend]
        last = rows[max(rows)]
        speed_up, two = allowed(rows), pair_measured(bench, scene, backend)
        path_ms = last.counters["path_ms"]
        part = f"{serial_part(last)}: {last.counters['longest_ms'] / path_ms:.0%} of the path" if path_ms > 0 else "–"
        lines.append([scene, backend, mark(two[0].median_ms / two[1].median_ms, order(*two) != 0) if two else "–",
                      *(about(speed_up[cores]) if cores in speed_up else "–" for cores in shown), part])
    return header, lines


def barrier_sentence(bench):
    rows = bench.sweep("cores")
    return ("The speed-ups are estimates: the recorded tasks of a frame, handed out to that many cores. They ignore shared "
            f"bandwidth, caches and clock rate. Each parallel section is charged {number(rows[0].counters['barrier_ms'] * 1e3)} µs "
            "for starting and waiting, as measured with two threads.")
