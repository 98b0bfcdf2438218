"""The examples of README and of the library's README do what they say, and pass mypy in its strictest mode."""
import re
import runpy
import subprocess
import sys
from pathlib import Path

import edgewise

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "tests" / "consumer"


def said(example, folder):
    (folder / "mesh.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nf 1 2 3 4\nf 1 3 2\n")
    done = subprocess.run([sys.executable, EXAMPLES / example], cwd=folder, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_the_example_draws_a_file(tmp_path):
    assert said("picture.py", tmp_path) == ""
    shown = edgewise.read_image(tmp_path / "mesh.png") != edgewise.BLACK
    assert shown.shape == (360, 640)
    assert 0 < shown.sum() < shown.size


def test_dasks_workers_draw_what_one_process_draws(tmp_path):
    printed = said("views.py", tmp_path).split()
    view_hash, scene = runpy.run_path(str(EXAMPLES / "views.py"))["view_hash"], edgewise.Scene.read_obj(tmp_path / "mesh.obj")
    assert printed == [f"{view_hash(i, scene):016x}" for i in range(200)] and len(set(printed)) > 150


def test_the_examples_pass_mypy(tmp_path):
    examples = {path.stem: path.read_text() for path in EXAMPLES.glob("*.py")}
    for readme in (ROOT / "README.md", *ROOT.glob("src/**/README.md")):
        for block in re.findall(r"^```python\n(.*?)^```", readme.read_text(), re.MULTILINE | re.DOTALL):
            examples[f"readme_{len(examples)}"] = block
    assert len(examples) > 3
    examples["wrong"] = "import edgewise\nscene = edgewise.Scene()\nscene.draw('camera', (4, 4))\nscene.light.no_such\n"
    for name, text in examples.items():
        (tmp_path / f"example_{name}.py").write_text(text)
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(Path(sys.prefix) / "mypy"), "."]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    errors = [line for line in done.stdout.splitlines() if "error:" in line]
    assert len(errors) == 2 and all(line.startswith("example_wrong.py") for line in errors), done.stdout + done.stderr
