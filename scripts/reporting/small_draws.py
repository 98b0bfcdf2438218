"""The cost of two threads in a small draw, and the peak memory."""
from bench_rows import order
from speedups import mark
from tables import number

SMALL = {"256 × 256": "cube/tiny:256x256", "1920 × 1080": "cube"}


def small_draws_table(bench):
    """Header and lines; no lines if no such row was timed."""
    lines = []
    for size, work in SMALL.items():
        for backend in bench.backends:
            rows = [bench.find(f"{backend}/{work}/threads:{threads}") for threads in (1, 2)]
            if all(rows):
                one_us, two_us = (1e3 * row.median_ms for row in rows)
                lines.append([size, f"`{backend}`", number(one_us), number(two_us), mark(one_us / two_us, order(*rows))])
    return ["size", "backend", "1 thread, µs", "2 threads, µs", "speed-up"], lines


def memory_sentence(bench):
    """The peak memory of front end, frame and backend, in the first frame; empty if not measured."""
    rows = [row for row in bench.rows.values() if "peak_bytes" in row.counters and set(row.keys) == {"threads"}]
    if not rows:
        return ""

    def pixels(row):
        return row.counters["width"] * row.counters["height"]

    def share(row):
        return row.counters["peak_bytes"] / (100 * row.counters["triangles"] + 16 * pixels(row))

    fewest = min(rows, key=lambda row: (row.counters["triangles"], -row.counters["peak_bytes"]))
    most = max(rows, key=lambda row: (row.counters["triangles"], row.counters["peak_bytes"]))
    a_pixel = fewest.counters["peak_bytes"] / pixels(fewest)
    a_triangle = (most.counters["peak_bytes"] - a_pixel * pixels(most)) / most.counters["triangles"]
    worst = max(rows, key=share)
    return (f"The first frame takes {a_pixel:.1f} bytes per pixel plus {a_triangle:.0f} per triangle, at most {share(worst):.0%} of what "
            f"`edgewise/backend.h` allows (`{worst.backend}` on `{worst.scene}`).")
