"""What scripts/python_peers compares: our drawer draws what its camera sees, and differences between pictures are counted."""
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts" / "reporting"))
from program import BadInput  # noqa: E402
from python_comparison import BACKGROUND, ball, compared, corners, from_edges, grid, read_obj, view_of  # noqa: E402
from python_drawers import Edgewise, Mesh, View, drawn  # noqa: E402

SIZE = (80, 60)
SNAPPED = 0.004  # px: the most by which rounding to 1/256 px moves an edge, and more


def picture_of(mesh):
    return drawn(Edgewise(1), mesh, view_of(mesh, SIZE), 0)


def centres(mask):
    return np.argwhere(mask)[:, ::-1] + 0.5


def test_each_pixel_shows_a_triangle_around_its_centre_at_its_distance():
    mesh = grid(12, 6, ball)
    view, (ids, distances) = view_of(mesh, SIZE), picture_of(mesh)
    shown = ids != BACKGROUND
    assert shown.sum() > 500
    away, inside = from_edges(centres(shown), corners(mesh, view, ids[shown]))
    assert (inside | (away < SNAPPED)).all() and inside.sum() > 500
    nearest = np.linalg.norm(view.world_to_camera[:3, 3]) - 1
    assert nearest - 1e-6 < distances[shown].min() < nearest + 0.1


def test_differences_are_counted_with_holes_and_how_far_they_are_from_an_edge():
    mesh = Mesh(np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0], [9, 9, 9], [9, 9, 8], [9, 8, 9]], np.float32),
                np.array([[0, 1, 2], [3, 4, 5]], np.uint32))
    view = View(SIZE, np.array([[60, 0, 40], [0, 60, 30], [0, 0, 1.0]]), np.diag([1, -1, -1, 1.0]), 1, 9)
    view.world_to_camera[2, 3] = 4
    ours = drawn(Edgewise(1), mesh, view, 0)
    ids, distances = (plane.copy() for plane in ours)
    same = {"differ": 0, "holes": 0, "farthest_px": 0.0, "ours_hold": 0, "theirs_hold": 0, "distance_p99": 0.0}
    assert compared(mesh, view, ours, (ids, distances)) == same
    ids[30, 40] = BACKGROUND  # inside
    row = 40
    left = np.argmax(ids[row] == 0)
    ids[row, left] = BACKGROUND  # at the edge, so no hole
    ids[row, left - 2] = 0  # outside
    distances *= 1.5
    found = compared(mesh, view, ours, (ids, distances))
    assert {**found, "farthest_px": 0} == {"differ": 3, "holes": 1, "farthest_px": 0, "ours_hold": 2, "theirs_hold": 0, "distance_p99": pytest.approx(0.5)}
    (top, _), (bottom, _) = sorted(corners(mesh, view, np.array([0]))[0][:, ::-1].tolist())[::2]
    assert 5 < found["farthest_px"] < (bottom - top) / 2


def test_faces_of_a_file_become_fans(tmp_path):
    path = tmp_path / "mesh.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nvn 0 0 1\nv 1 1 0\nv 0 1 0.5\nf 1/1/1 2 3//1 4\nf -1 -2 1\n")
    mesh = read_obj(path)
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [3, 2, 0]]
    assert mesh.positions[3].tolist() == [0, 1, 0.5]
    for text in ("", "v 0 0 0\nf 1 2 3\n", "v 0 0 0\nf 1 1 -2\n"):
        path.write_text(text)
        with pytest.raises(BadInput):
            read_obj(path)
