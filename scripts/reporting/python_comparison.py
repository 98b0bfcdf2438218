"""What `scripts/python_peers` compares: the pictures of python_drawers, then their times."""
import edgewise
import numpy as np

from program import BadInput
from python_drawers import DRAWERS, FOV_Y, THREADS, Drawer, Mesh, View

OURS = "edgewise"
BACKGROUND = 0
CALLS = 3  # whose median is the time of a round


def grid(columns, rows, surface):
    """Two triangles per cell of a surface(u, v) with 0 <= u, v <= 1."""
    v, u = np.meshgrid(np.linspace(0, 1, rows + 1), np.linspace(0, 1, columns + 1), indexing="ij")
    a = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    b, c, d = a + 1, a + columns + 1, a + columns + 2
    return Mesh(np.stack(surface(u, v), -1).reshape(-1, 3).astype(np.float32),
                np.stack([a, b, c, b, d, c], -1).reshape(-1, 3).astype(np.uint32))


def ball(u, v):
    around, down = 2 * np.pi * u, np.pi * v
    return np.cos(around) * np.sin(down), np.cos(down), np.sin(around) * np.sin(down)


def hills(u, v):
    return 4 * u, 0.3 * np.sin(11 * u) * np.cos(7 * v) + 0.05 * np.sin(60 * u + 40 * v), 4 * v


BUILT_IN = {"sphere": (192, 128, ball), "terrain": (512, 512, hills)}


def read_obj(path):
    mesh = edgewise.Scene.read_obj(path).meshes()[0]
    if len(mesh.triangles) >= 1 << 24:
        raise BadInput(f"{path}: too many triangles for ids of 24 bits")
    return Mesh(mesh.positions.astype(np.float32), mesh.triangles)


def view_of(mesh, size):
    """Sees the mesh from above, between its front and its right side; corners of its box may be out of view."""
    low, high = mesh.positions.min(0).astype(float), mesh.positions.max(0).astype(float)
    radius = np.linalg.norm(high - low) / 2
    away = 0.7 * radius / np.sin(FOV_Y / 2)
    target = (low + high) / 2
    eye = target + away * np.array([1.0, 1.5, 3.0]) / 3.5
    return View(size, eye, target, edgewise.look_at(eye, target), 0.9 * (away - radius), 1.1 * (away + radius))


def compared(ours, theirs):
    """How another picture's ids differ from ours."""
    inside = np.lib.stride_tricks.sliding_window_view(np.pad(ours != BACKGROUND, 1), (3, 3)).all((2, 3))  # with all eight neighbours
    return {"differ": int((theirs != ours).sum()), "holes": int((inside & (theirs == BACKGROUND)).sum())}


def timed(drawers, mesh, view, rounds):
    """The milliseconds of each round: {drawer's name: {threads: {job: [...]}}}. Every other round goes the other way."""
    requests = {"load": (mesh, view, 1), "draw": (None, view, CALLS), "redraw": (None, view, CALLS, True)}
    times = {name: {job: [] for job in requests} for name in drawers}
    for i in range(rounds):
        for name in reversed(drawers) if i % 2 else drawers:
            for job, request in requests.items():
                times[name][job].append(round(drawers[name].drawn(*request), 4))
    return {name: {THREADS: of} for name, of in times.items()}


def comparison(meshes, sizes, rounds):
    """What goes to python.json. BadInput if a package is missing, or fails."""
    drawers = {name: Drawer(name) for name in DRAWERS}
    pictures = []
    for name, mesh in meshes.items():
        for size in sizes:
            view = view_of(mesh, size)
            drawn = {other: drawer.drawn(mesh, view) for other, drawer in drawers.items()}
            ours = drawn.pop(OURS)
            peers = {other: compared(ours, theirs) for other, theirs in drawn.items()}
            print(f"{name}, {size[0]} × {size[1]}: " + ", ".join(f"{other} differs in {of['differ']:,} px" for other, of in peers.items()))
            pictures.append({"mesh": name, "triangles": len(mesh.triangles), "size": size, "covered": int((ours != BACKGROUND).sum()),
                             "peers": peers, "ms": timed(drawers, mesh, view, rounds)})
    return {"versions": {name: drawer.version for name, drawer in drawers.items()}, "pictures": pictures}
