"""What the tests of scripts share: a folder for each test, and runs of scripts with programs made up in place of others."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
sys.path[:0] = [str(SCRIPTS / folder) for folder in ("reporting", "checks")]  # for tests that import support before those
# The committed results that README is filled from: what they hold was judged by tests of the programs that wrote it.
RESULTS = ROOT / re.search(r"<!-- results: (\S+) -->", (ROOT / "README.md").read_text())[1]
os.environ["PYTHONDONTWRITEBYTECODE"] = "1"  # for the scripts that tests start


def run(*command, directory=None, **environment):
    """The ended process, with its output."""
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, cwd=directory, env={**os.environ, **environment})


def copied_results(folder):
    """The JSON files of RESULTS and of the facts, below another folder. Returns that of RESULTS."""
    for source in (RESULTS, RESULTS.parent / "facts"):
        shutil.copytree(source, folder / source.name, ignore=shutil.ignore_patterns("*.svg", "*.png"))
    return folder / RESULTS.name


def google_benchmark(published):
    """A bench.json of results/ as Google Benchmark wrote it."""
    entries = [{"name": name, "run_name": name, "run_type": "iteration", "real_time": ms, "time_unit": "ms",
                **{key: value for key, value in row.items() if key != "ms"}} for name, row in published["rows"].items() for ms in row["ms"]]
    return {"context": published["context"], "benchmarks": entries}


def read(path):
    return json.loads(path.read_text())


class FolderTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.environment = {"PATH": f"{self.folder}/tools:{os.environ['PATH']}"}

    def fails(self, result, *words):
        """The script ended as scripts do on bad input."""
        self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1), result.stdout + result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def file(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def tool(self, name, text):
        """A program that with_tools() finds before others of this name."""
        self.file(f"tools/{name}", text).chmod(0o755)

    def with_tools(self, *command, **environment):
        return run(*command, **{**self.environment, **environment})


class CopyTest(FolderTest):
    """With a copy of the scripts, which take the test's folder for the project's."""

    def setUp(self):
        super().setUp()
        shutil.copytree(SCRIPTS, self.folder / "scripts", ignore=shutil.ignore_patterns("__pycache__", "README.md"))

    def script(self, name, *arguments, **environment):
        return self.with_tools(self.folder / "scripts" / name, *arguments, **environment)

    def git(self, *words):
        result = run("git", "-C", self.folder, "-c", "user.name=t", "-c", "user.email=t@t", *words)
        self.assertEqual(result.returncode, 0, result.stderr)
