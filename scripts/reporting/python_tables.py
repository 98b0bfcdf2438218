"""The findings of `scripts/python_peers`, in sentences."""
from bench_rows import Row, records
from program import parsed
from tables import outcome, short

OURS, PEERS = "edgewise", ("vtk", "moderngl")
JOBS = {"draw": "a draw into new arrays", "redraw": "a draw into reused arrays", "load": "load and draw"}


def timed(picture, name, job):
    """The row of a job on two threads."""
    return Row(f"{name}/{job}", name, picture["mesh"], {"threads": "2"}, picture["ms"][name]["2"][job], rounds=True)


def against(peer, data):
    """How much faster ours is, and how the peer's pictures differ from ours."""
    pictures = data["pictures"]
    faster = [f"{what} is {outcome([(timed(of, OURS, job), timed(of, peer, job)) for of in pictures])}" for job, what in JOBS.items()]
    covered = sum(picture["covered"] for picture in pictures)
    differ, holes = (sum(picture["peers"][peer][key] for picture in pictures) for key in ("differ", "holes"))
    return (f"- Against {data['versions'][peer]}, {'; '.join(faster)}. "
            f"Of {short(covered)} pixels {differ:,} show another triangle, {holes or 'none'} of them a hole.")


def python_lines(folder):
    """A line for each peer; of another machine if there is none here."""
    path = next(iter(records(folder, "python")), None)
    if path is None:
        return "No other Python package was measured here; `scripts/run --full --peers` does."

    def told(data):
        source = f"On 2 threads; `{path.parent.name}`, commit {data['commit']}. A scene is a mesh at one size."
        return "\n".join([*(against(peer, data) for peer in PEERS), "", source])

    return parsed(path, told, "scripts/python_peers")
