"""Scenes that the tests share."""
import numpy as np

import edgewise

SIZE = (97, 61)  # px; no multiple of a tile's side
ASPECT = SIZE[0] / SIZE[1]
CAMERA = edgewise.Camera(edgewise.look_at((0.4, 0.7, 4), (0, 0, 0)), edgewise.perspective(0.8, ASPECT, 0.1, 50))
MOVED = np.array([[1, 0, 0.5, 0.5], [0.25, 1, 0, 0.25], [0, 0, 1, -1], [0, 0, 0, 1.0]])


def triangles(count=60, seed=1):
    """Random triangles in the box from -1 to 1: positions, indices and colours."""
    random = np.random.default_rng(seed)
    positions = random.uniform(-1, 1, (3 * count, 3)).astype(np.float32)
    colours = random.integers(0, 1 << 24, count, dtype=np.uint32) | np.uint32(edgewise.BLACK)
    return positions, np.arange(3 * count, dtype=np.uint32).reshape(-1, 3), colours


def scene():
    """Two meshes, and three instances of them: 60 + 20 + 60 triangles."""
    made = edgewise.Scene()
    for count, seed in ((60, 1), (20, 2)):
        positions, indices, colours = triangles(count, seed)
        made.add_mesh(positions, indices, colours=colours)
    made.add_instance(0)
    made.add_instance(1, MOVED)
    made.add_instance(0, np.diag([0.5, -0.5, 0.5, 1]))
    return made


def stream(count=40):
    random = np.random.default_rng(3)
    vertices = random.uniform((-20, -20, 0), (SIZE[0] + 20, SIZE[1] + 20, 1), (count, 3, 3))
    return edgewise.Stream(vertices, SIZE, colours=random.integers(0, 256, (count, 3), dtype=np.uint8))


def in_pixels(to_clip, points, size=SIZE):
    """x and y in pixels, and z / w, of points, shape (..., 3), by a matrix from world to clip space."""
    clip = np.concatenate([points, np.ones((*points.shape[:-1], 1))], axis=-1) @ to_clip.T
    x, y, z = np.moveaxis(clip[..., :3] / clip[..., 3:], -1, 0)
    return np.stack([size[0] * (x + 1) / 2, size[1] * (1 - y) / 2], axis=-1), z


def same(a, b):
    return all(np.array_equal(p, q) for p, q in zip(a, b))
