"""What scripts/python_peers compares: our drawer draws what its camera sees, and differences between pictures are counted."""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "reporting"))
from python_comparison import BACKGROUND, ball, compared, grid, view_of  # noqa: E402
from python_drawers import FOV_Y, Drawer  # noqa: E402

SIZE = (80, 60)


def picture_of(mesh):
    return Drawer("edgewise").drawn(mesh, view_of(mesh, SIZE))


def test_each_pixel_shows_a_triangle_near_it():
    mesh = grid(12, 6, ball)
    view, ids = view_of(mesh, SIZE), picture_of(mesh)
    shown = ids != BACKGROUND
    assert shown.sum() > 500
    middles = mesh.positions[mesh.triangles[ids[shown] - 1]].mean(1) @ view.world_to_view[:3, :3].T + view.world_to_view[:3, 3]
    seen = middles[:, :2] / middles[:, 2:] * (SIZE[1] / 2 / np.tan(FOV_Y / 2)) * (-1, 1) + np.array(SIZE) / 2
    assert (abs(seen - np.argwhere(shown)[:, ::-1] - 0.5) < 11).all()


def test_differences_are_counted_with_holes():
    mesh = grid(12, 6, ball)
    ours = picture_of(mesh)
    ids = ours.copy()
    assert compared(ours, ids) == {"differ": 0, "holes": 0}
    ids[30, 40] = BACKGROUND  # inside
    left = np.argmax(ids[30] != BACKGROUND)
    ids[30, left] = BACKGROUND  # at the edge, so no hole
    ids[30, left - 2] = 1  # outside
    assert compared(ours, ids) == {"differ": 3, "holes": 1}
