"""The examples of README and of the library's README."""
import runpy
import subprocess
import sys
from pathlib import Path

import edgewise

EXAMPLES = Path(__file__).resolve().parents[1] / "consumer"


def said(example, folder):
    (folder / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\nf 1 3 2\n")
    done = subprocess.run([sys.executable, EXAMPLES / example], cwd=folder, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_the_example_draws_a_file(tmp_path):
    assert said("picture.py", tmp_path) == "2 of 3 triangles are visible\n"
    shown = edgewise.read_image(tmp_path / "mesh.png") != edgewise.BLACK
    assert shown.shape == (360, 640)
    assert 0 < shown.sum() < shown.size


def test_dasks_workers_draw_what_one_process_draws(tmp_path):
    printed = said("views.py", tmp_path).split()
    view_hash, scene = runpy.run_path(str(EXAMPLES / "views.py"))["view_hash"], edgewise.Scene.read_obj(tmp_path / "mesh.obj")
    assert printed == [f"{view_hash(i, scene):016x}" for i in range(200)] and len(set(printed)) > 150
