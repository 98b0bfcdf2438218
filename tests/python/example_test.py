"""README's example."""
import subprocess
import sys
from pathlib import Path

import edgewise

EXAMPLE = Path(__file__).resolve().parents[1] / "consumer" / "picture.py"


def test_the_example_draws_a_file(tmp_path):
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 3 2\n")
    done = subprocess.run([sys.executable, EXAMPLE], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "2 of 3 triangles are visible\n"
    shown = edgewise.read_image(tmp_path / "mesh.png") != edgewise.BLACK
    assert shown.shape == (360, 640)
    assert 0 < shown.sum() < shown.size
