"""The examples pass mypy in its strictest mode, with the package's own annotations."""
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_the_examples_pass_mypy(tmp_path):
    examples = {path.stem: path.read_text() for path in (ROOT / "tests" / "consumer").glob("*.py")}
    for readme in (ROOT / "README.md", *ROOT.glob("src/**/README.md")):
        for i, block in enumerate(re.findall(r"^```python\n(.*?)^```", readme.read_text(), re.MULTILINE | re.DOTALL)):
            examples[f"{readme.parent.name.replace('-', '_')}_{i}"] = block
    assert len(examples) > 4
    examples["wrong"] = "import edgewise\nscene = edgewise.Scene()\nscene.draw('camera', (4, 4))\nscene.light.no_such\n"
    for name, text in examples.items():
        (tmp_path / f"example_{name}.py").write_text(text)
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(Path(sys.prefix) / "mypy"), "."]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    errors = [line for line in done.stdout.splitlines() if "error:" in line]
    assert len(errors) == 2 and all(line.startswith("example_wrong.py") for line in errors), done.stdout + done.stderr
