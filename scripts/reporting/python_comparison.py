"""What `scripts/python_peers` compares: the pictures of python_drawers, then their times."""
import numpy as np

from program import BadInput
from python_drawers import DRAWERS, Drawer, Mesh, View

OURS = "edgewise"
THREADS = (1, 2)
BACKGROUND = 0
FOV_Y = 0.8  # radians
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
    import edgewise
    try:
        mesh = edgewise.Scene.read_obj(path).meshes()[0]
    except OSError as error:
        raise BadInput(error) from None
    if len(mesh.triangles) >= 1 << 24:
        raise BadInput(f"{path}: too many triangles")
    return Mesh(mesh.positions.astype(np.float32), mesh.triangles)


def view_of(mesh, size):
    """Sees the mesh from above, between its front and its right side; corners of its box may be out of view."""
    low, high = mesh.positions.min(0).astype(float), mesh.positions.max(0).astype(float)
    radius = np.linalg.norm(high - low) / 2
    away = 0.7 * radius / np.sin(FOV_Y / 2)
    z = -np.array([1.0, 1.5, 3.0]) / 3.5  # a unit vector, from the camera to the centre
    x = np.cross(z, [0.0, 1.0, 0.0])
    x /= np.linalg.norm(x)
    world_to_camera = np.eye(4)
    world_to_camera[:3, :3] = x, np.cross(z, x), z
    world_to_camera[:3, 3] = -world_to_camera[:3, :3] @ ((low + high) / 2 - away * z)
    focal = size[1] / 2 / np.tan(FOV_Y / 2)
    k = np.array([[focal, 0, size[0] / 2], [0, focal, size[1] / 2], [0, 0, 1]])
    return View(size, k, world_to_camera, 0.9 * (away - radius), 1.1 * (away + radius))


def around(mask):
    """Whether all eight neighbours are set, too. Pixels at the border have too few."""
    inside = np.zeros_like(mask)
    height, width = mask.shape
    inside[1:-1, 1:-1] = np.logical_and.reduce([mask[y:height - 2 + y, x:width - 2 + x] for y in range(3) for x in range(3)])
    return inside


def compared(ours, theirs):
    """How another picture differs from ours; each is (ids, distances)."""
    (our_ids, our_distances), (ids, distances) = ours, theirs
    differ = ids != our_ids
    same = ~differ & (our_ids != BACKGROUND)
    apart = abs(distances - our_distances)[same] / our_distances[same]
    return {"differ": int(differ.sum()), "holes": int(((ids == BACKGROUND) & around(our_ids != BACKGROUND)).sum()),
            "distance_p99": float(np.quantile(apart, 0.99)) if apart.size else 0.0}


def timed(drawers, mesh, view, rounds):
    """The milliseconds of each round: {drawer's name: {threads: {job: [...]}}}. Every other round goes the other way."""
    requests = {"load": (mesh, view, 1), "draw": (None, view, CALLS), "redraw": (None, view, CALLS, True)}
    found = {}
    for i in range(rounds):
        for drawer in drawers[::-1] if i % 2 else drawers:
            times = found.setdefault(drawer.name, {}).setdefault(drawer.threads, {job: [] for job in requests})
            for job, request in requests.items():
                times[job].append(round(drawer.drawn(*request), 4))
    return found


def comparison(meshes, sizes, rounds, tell):
    """What goes to python.json. BadInput if a package is missing or draws nothing."""
    try:
        drawers = [Drawer(name, threads) for threads in THREADS for name in DRAWERS]
    except RuntimeError as error:
        raise BadInput(error) from None
    pictures = []
    for name, mesh in meshes.items():
        for size in sizes:
            view = view_of(mesh, size)
            drawn = {(drawer.name, drawer.threads): drawer.drawn(mesh, view) for drawer in drawers}
            ours = drawn[OURS, THREADS[0]]
            if any((of[0] != drawn[name, THREADS[0]][0]).any() for (name, _), of in drawn.items()):
                raise BadInput(f"{name}: the number of threads changes the picture")
            peers = {other: compared(ours, drawn[other, THREADS[0]]) for other in DRAWERS if other != OURS}
            tell(f"{name}, {size[0]} × {size[1]}: " + ", ".join(f"{other} differs in {of['differ']:,} px" for other, of in peers.items()))
            pictures.append({"mesh": name, "triangles": len(mesh.triangles), "size": size, "covered": int((ours[0] != BACKGROUND).sum()),
                             "peers": peers, "ms": timed(drawers, mesh, view, rounds)})
    return {"versions": {drawer.name: drawer.version for drawer in drawers}, "pictures": pictures}
