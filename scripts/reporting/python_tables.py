"""The tables of `scripts/python_peers`."""
from bench_rows import Row, records, source_of
from program import parsed
from tables import by_order, gain, markdown, milliseconds, number, outcome

OURS, PEERS = "edgewise", {"vtk": "VTK", "moderngl": "ModernGL"}
JOBS = {"draw": "draw", "load": "load and draw"}
NOT_MEASURED = "No other Python package was measured here; `scripts/run --peers` does."


def parse_python(data):
    """The data, and [(picture, {(drawer, threads, job): row})]."""
    def rows(picture):
        found = {(name, int(threads), job): Row(f"{name}/{job}", name, False, picture["mesh"], {"threads": threads}, times[job], rounds=True)
                 for name, of in picture["ms"].items() for threads, times in of.items() for job in JOBS}
        if any(not found[name, threads, job].times_ms or picture["peers"][peer]["differ"] < 0
               for peer in PEERS for name in (OURS, peer) for threads in (1, 2) for job in JOBS):
            raise ValueError(picture["mesh"])
        return found

    return data, [(picture, rows(picture)) for picture in data["pictures"]]


def read_python(folder):
    """Its source, versions and pictures; of another machine if there is none here, None if there is none at all."""
    for path in records(folder, "python"):
        data, pictures = parsed(path, parse_python, "scripts/python_peers")
        return source_of(path, data), data["versions"], pictures
    return None


def titled(picture):
    width, height = picture["size"]
    return [f"{picture['mesh']}, {width} × {height}", f"{picture['triangles']:,}"]


def times_table(pictures):
    """Header and lines, a line per picture and job; two figures in a cell are for one and for two threads."""
    lines = []
    for picture, rows in pictures:
        for job, title in JOBS.items():
            def cell(told, *names):
                return " / ".join(told(*(rows[name, threads, job] for name in names)) for threads in (1, 2))

            lines.append([*titled(picture), title, cell(milliseconds, OURS),
                          *(text for peer in PEERS for text in (cell(milliseconds, peer), cell(gain, peer, OURS)))])
    return ["picture", "triangles", "call", "Edgewise, ms", *(text for name in PEERS.values() for text in (f"{name}, ms", "speed-up"))], lines


def pixels_table(pictures):
    """Header and lines, a line per picture and peer."""
    lines = [[*titled(picture), name, f"{picture['covered']:,}", f"{of['differ']:,}", f"{of['holes']:,}",
              number(of["farthest_px"], 2) if of["differ"] else "–", f"{of['ours_hold']:,} / {of['theirs_hold']:,}", number(of["distance_p99"], 2)]
             for picture, _ in pictures for peer, name in PEERS.items() for of in [picture["peers"][peer]]]
    return ["picture", "triangles", "peer", "px that show the mesh", "px with another id", "holes", "px from an edge, at most",
            "centre only in Edgewise's / the peer's triangle", "distances, 99th percentile of the differences"], lines


def python_tables(found):
    if found is None:
        return NOT_MEASURED
    source, versions, pictures = found
    (times_header, times), (header, lines) = times_table(pictures), pixels_table(pictures)
    return "\n".join([f"{' and '.join(versions[peer] for peer in PEERS)}, on 1 / 2 threads ({source}):", "",
                      markdown(times_header, times, "|---|--:|---|" + "--:|" * (len(times_header) - 3)), "",
                      markdown(header, lines, "|---|--:|---|" + "--:|" * (len(header) - 3))])


def python_brief(found):
    """A sentence of speed-ups on two threads."""
    if found is None:
        return NOT_MEASURED
    source, _, pictures = found
    told = [f"against {name} {outcome(by_order([(rows[OURS, 2, 'draw'], rows[peer, 2, 'draw']) for _, rows in pictures]))}"
            for peer, name in PEERS.items()]
    return f"Ids and depths by `draw` on 2 threads: {'; '.join(told)} (a scene is a mesh at one size; both on llvmpipe; {source}; [more](results/README.md#python-packages))."
