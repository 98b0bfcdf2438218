"""The findings of `scripts/python_peers`, in sentences."""
from bench_rows import Row, records, source_of
from program import parsed
from tables import by_order, outcome, short

OURS, PEERS = "edgewise", {"vtk": "VTK", "moderngl": "ModernGL"}
JOBS = {"draw": "a draw into new arrays", "redraw": "a draw into reused arrays", "load": "load and draw"}
NOT_MEASURED = "No other Python package was measured here; `scripts/run --full --peers` does."


def parse_python(data):
    """The data, and [(picture, {(drawer, threads, job): row})]."""
    def rows(picture):
        jobs = [job for job in JOBS if job in picture["ms"][OURS]["2"]]  # older files have no "redraw"
        found = {(name, int(threads), job): Row(f"{name}/{job}", name, False, picture["mesh"], {"threads": threads}, times[job], rounds=True)
                 for name, of in picture["ms"].items() for threads, times in of.items() for job in jobs}
        if any(not found[name, threads, job].times_ms or picture["peers"][peer]["differ"] < 0
               for peer in PEERS for name in (OURS, peer) for threads in (1, 2) for job in jobs):
            raise ValueError(picture["mesh"])
        return found

    return data, [(picture, rows(picture)) for picture in data["pictures"]]


def read_python(folder):
    """Its source, versions and pictures; of another machine if there is none here, None if there is none at all."""
    for path in records(folder, "python"):
        data, pictures = parsed(path, parse_python, "scripts/python_peers")
        return source_of(path, data), data["versions"], pictures
    return None


def faster(pictures, peer, job):
    """By how much ours are faster on two threads, and in how many pictures."""
    return outcome(by_order([(rows[OURS, 2, job], rows[peer, 2, job]) for _, rows in pictures]))


def pixels(pictures, peer):
    """How the peer's pictures differ from ours."""
    covered = sum(picture["covered"] for picture, _ in pictures)
    differ, holes = (sum(picture["peers"][peer][key] for picture, _ in pictures) for key in ("differ", "holes"))
    return f"Of {short(covered)} pixels {differ:,} show another triangle, {holes or 'none'} of them a hole"


def python_lines(found):
    """A line for each peer."""
    if found is None:
        return NOT_MEASURED
    source, versions, pictures = found
    jobs = [job for job in JOBS if all((OURS, 2, job) in rows for _, rows in pictures)]
    return "\n".join(f"- Against {versions[peer]}, {'; '.join(f'{JOBS[job]} is {faster(pictures, peer, job)}' for job in jobs)}. "
                     f"{pixels(pictures, peer)}." for peer in PEERS) + f"\n\nOn 2 threads; {source}. A scene is a mesh at one size."
