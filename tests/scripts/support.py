"""What the tests of scripts share: a folder for each test, and runs of scripts with programs made up in place of others."""
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
os.environ["PYTHONDONTWRITEBYTECODE"] = "1"  # for the scripts that tests start


def run(*command, directory=None, **environment):
    """The ended process, with its output."""
    return subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, cwd=directory, env={**os.environ, **environment})


class FolderTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.environment = {"PATH": f"{self.folder}/tools:{os.environ['PATH']}"}

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
