"""The findings of `scripts/python_peers`, in sentences."""
from bench_rows import Row, records, source_of
from program import parsed
from tables import outcome, short

OURS, PEERS = "edgewise", ("vtk", "moderngl")
JOBS = {"draw": "a draw into new arrays", "redraw": "a draw into reused arrays", "load": "load and draw"}
NOT_MEASURED = "No other Python package was measured here; `scripts/run --full --peers` does."


def timed(picture, name, job):
    """The row of a job on two threads. Older files have one thread, too."""
    return Row(f"{name}/{job}", name, False, picture["mesh"], {"threads": "2"}, picture["ms"][name]["2"][job], rounds=True)


def against(peer, data):
    """How much faster ours is, and how the peer's pictures differ from ours."""
    pictures = data["pictures"]
    jobs = [job for job in JOBS if all(job in picture["ms"][OURS]["2"] for picture in pictures)]  # older files have no "redraw"
    faster = [f"{JOBS[job]} is {outcome([(timed(of, OURS, job), timed(of, peer, job)) for of in pictures])}" for job in jobs]
    covered = sum(picture["covered"] for picture in pictures)
    differ, holes = (sum(picture["peers"][peer][key] for picture in pictures) for key in ("differ", "holes"))
    return (f"- Against {data['versions'][peer]}, {'; '.join(faster)}. "
            f"Of {short(covered)} pixels {differ:,} show another triangle, {holes or 'none'} of them a hole.")


def python_lines(folder):
    """A line for each peer; of another machine if there is none here."""
    path = next(iter(records(folder, "python")), None)
    if path is None:
        return NOT_MEASURED

    def told(data):
        peers = "\n".join(against(peer, data) for peer in PEERS)
        return f"{peers}\n\nOn 2 threads; {source_of(path, data)}. A scene is a mesh at one size."

    return parsed(path, told, "scripts/python_peers")
