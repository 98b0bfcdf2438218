"""Tables of results, as Markdown for the READMEs and as plain text for the terminal."""
from bench_rows import order
from speedups import about

THREADS = (1, 2)
NORMAL_Z = "normal_z"  # the Outlaw Triad trainer's facing test


def short(value, _=None):
    """1000 → 1k, 1e6 → 1M; small numbers as they are."""
    for limit, unit in ((1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= limit * 0.9995:
            return f"{value / limit:.3g}{unit}"
    return f"{value:.3g}"


def enumerated(words):
    """"a, b and c"."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def number(value, digits=3):
    return f"{float(f'{value:.{digits}g}'):,.10g}"


def percent(share, digits=2):
    return f"{number(100 * share, digits)} %"


def milliseconds(row):
    if row is None:
        return "–"
    ms = row.median_ms
    return f"{ms:.3f}" if ms < 1 else f"{ms:.2f}" if ms < 10 else f"{ms:.1f}" if ms < 100 else f"{ms:,.0f}"


def random_reads(bench):
    """[(where, "140 ns (130 to 168)")]: whether other processes filled the last-level cache; empty if not measured."""
    rows = [(title, bench.random_reads.get(where)) for where, title in
            (("half_last_cache", "half the last-level cache"), ("memory", "a far larger buffer"))]
    return [(title, "{1:.0f} ns ({0:.0f} to {2:.0f})".format(*(ms * 1e6 / row.counters["reads"] for ms in
                                                              (row.low_ms, row.median_ms, row.high_ms))))
            for title, row in rows if row]


def fastest(bench, scene):
    """The fastest backend on the most threads, with its speed-up over the next; several if the order is not settled."""
    rows = [row for b in bench.backends if (row := bench.find(f"{b}/{scene}/threads:{max(THREADS)}"))]
    if len(rows) < 2:
        return "–"
    first, *others = sorted(rows, key=lambda row: row.median_ms)
    close = [row.backend for row in others if order(first, row) == 0]
    return " or ".join([first.backend, *close]) if close else \
        f"{first.backend}, {about(others[0].median_ms / first.median_ms)}"


def scene_facts(bench, scene):
    """Triangles submitted, and overdraw."""
    front = bench.find(f"frontend/{scene}/threads:1")
    raster = next((row for b in bench.backends if (row := bench.find(f"{b}/{scene}/threads:1"))), None)
    triangles = f"{front.counters['triangles']:,.0f}" if front else "–"
    overdraw = f"{raster.counters['overdraw']:.2f}" if raster else "–"
    return triangles, overdraw


def scene_table(bench, more=()):
    """Header and lines: a line per scene, with a backend's ms on 1 and on 2 threads in one cell. `more` are columns before
    the last: (title, scene → cell)."""
    header = ["scene", "triangles", "overdraw", *(f"{b}, ms" for b in bench.backends), *(title for title, _ in more), "fastest"]
    lines = []
    for scene in bench.scenes:
        times = [" / ".join(milliseconds(bench.find(f"{b}/{scene}/threads:{n}")) for n in THREADS) for b in bench.backends]
        lines.append([scene, *scene_facts(bench, scene), *times, *(cell(scene) for _, cell in more), fastest(bench, scene)])
    return header, lines


def speed_table(bench):
    """Header and lines: whole frames of ours and of peers, one line per scene; bold: the settled fastest of ours."""
    lines = []
    for scene in bench.scenes:
        ours = {backend: row for backend in bench.backends if (row := bench.frame(backend, scene, max(THREADS)))}

        def cell(row):
            best = all(order(row, other) < 0 for other in ours.values() if other is not row)
            return f"**{milliseconds(row)}**" if best and len(ours) > 1 else milliseconds(row)

        lines.append([scene, scene_facts(bench, scene)[0],
                      *(cell(ours[backend]) if backend in ours else "–" for backend in bench.backends),
                      *(milliseconds(bench.frame(peer, scene, max(THREADS))) for peer in bench.peers)])
    return ["scene", "triangles", *bench.backends, *bench.peers], lines


def markdown(header, lines, alignment=None):
    text = ["| " + " | ".join(header) + " |", alignment or "|---|" + "--:|" * (len(header) - 2) + "---|"]
    text += ["| " + " | ".join(line) + " |" for line in lines]
    return "\n".join(text)


def plain(header, lines):
    widths = [max(len(line[i]) for line in [header, *lines]) for i in range(len(header))]
    last = len(header) - 1

    def aligned(line):
        return "  ".join(cell.ljust(w) if i in (0, last) else cell.rjust(w)
                         for i, (cell, w) in enumerate(zip(line, widths))).rstrip()

    return "\n".join(map(aligned, [header, *lines]))


def culling_rows(bench, mode):
    """{scene: {backend: (row of a whole frame with all its faces, row in this culling mode)}}"""
    rows = {(row.scene, row.backend, row.keys["cull"]): row for row in bench.sweep("cull")}
    found = {}
    for (scene, backend, kept), all_faces in rows.items():
        if kept == "none" and (culled := rows.get((scene, backend, mode))):
            found.setdefault(scene, {})[backend] = all_faces, culled
    return found


def pixels_wrong(bench, scene):
    """The number of wrong pixels after the test of normals."""
    wrong = next(row.counters["wrong_px"] for row in bench.sweep("cull")
                 if row.scene == scene and row.keys["cull"] == NORMAL_Z)
    return f"{wrong:,.0f} px wrong"


def differing_pixels(verify):
    return sum(scene["differing_pixels"] + scene.get("written_outside", 0)
               + scene.get("oracle", {}).get("differing_pixels", 0) for scene in verify["scenes"])


def verify_sentence(verify):
    frames = sum(scene["configurations"] for scene in verify["scenes"])
    oracle = sum(scene.get("oracle", {}).get("configurations", 0) for scene in verify["scenes"])
    differing = differing_pixels(verify)
    return (f"{frames:,} frames of {len(verify['scenes'])} scenes, and {oracle:,} small ones with an oracle, were compared bit for bit: "
            + ("**no bit differs**." if differing == 0 else f"**{differing:,} pixels differ**."))
