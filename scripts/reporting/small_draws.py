"""The cost of two threads in a small draw, and the peak memory."""
from tables import number, short


def small_draw_sentences(bench):
    """The cost of a second thread in small draws: its time over half the time on one thread."""
    sentences = []
    for title, pattern in (("The 12 triangles of `cube` at {size}", "{backend}/cube/tiny:256x256/threads:{threads}"),
                           ("The same at {size}", "{backend}/cube/threads:{threads}")):
        parts, size = [], ""
        for backend in bench.backends:
            one, two = (bench.find(pattern.format(backend=backend, threads=threads)) for threads in (1, 2))
            if not one or not two:
                continue
            size = f"{one.counters['width']:.0f} × {one.counters['height']:.0f}"
            one_us, two_us = (1e3 * row.median_ms for row in (one, two))
            parts.append(f"`{backend}` {number(one_us)} µs on one thread, {number(two_us)} on two "
                         f"({number(one_us / 2)} would be ideal)")
        if parts:
            sentences.append(f"{title.format(size=size)}: " + ", ".join(parts) + ".")
    return sentences


def memory_sentence(bench):
    """The peak memory of front end, frame and backend, in the first frame."""
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
    return (f"Peak memory, in the first frame, with the frame and without the scene: {a_pixel:.1f} bytes per pixel "
            f"(`{fewest.scene}`), plus {a_triangle:.0f} bytes per triangle (`{most.backend}` on `{most.scene}`, "
            f"{short(most.counters['triangles'])} triangles). Of the 100 bytes per triangle plus 16 per pixel that `edgewise/backend.h` allows, no scene needs more than "
            f"{share(worst):.0%} (`{worst.backend}` on `{worst.scene}`).")
