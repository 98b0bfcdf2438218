"""Reads the table of mutants (tests/mutations.toml), and applies one to a copy of the tree.

A mutant replaces text that occurs exactly once in its file, so that a stale entry is an error.
"""
import re
import shutil
import tomllib
from dataclasses import dataclass

from bench_rows import BadInput

COPIED = ("CMakeLists.txt", "README.md", "bench", "results", "scripts", "src", "tests")
KEYS = {"name", "change", "file", "tests", "before", "after"}
OPTIONAL = {"sanitizer": {"thread"}}  # keys that an entry may have, and the values allowed


@dataclass(frozen=True)
class Mutation:
    name: str
    change: str  # in words
    file: str
    tests: str  # GoogleTest filter of the tests to run first; for a script, a file name in tests/scripts without .py
    before: str
    after: str
    sanitizer: str = ""  # the build whose tests must catch it; "": the usual one

    @property
    def in_script(self):
        """Whether it changes Python, which needs no build."""
        return self.file.endswith(".py")


def read_mutations(path):
    try:
        entries = tomllib.loads(path.read_text())["mutation"]
    except (OSError, KeyError, tomllib.TOMLDecodeError) as error:
        raise BadInput(f"{path}: {error}") from error
    for entry in entries:
        if set(entry) - set(OPTIONAL) != KEYS:
            raise BadInput(f"{path}: {entry.get('name', 'an entry')} must have exactly {', '.join(sorted(KEYS))}")
        for key, allowed in OPTIONAL.items():
            if entry.get(key) not in (None, *allowed):
                raise BadInput(f"{path}: {entry['name']}: {key} must be one of {', '.join(sorted(allowed))}")
    mutations = [Mutation(**entry) for entry in entries]
    names = [m.name for m in mutations]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise BadInput(f"{path}: twice: {', '.join(twice)}")
    return mutations


def mutated(mutation, root):
    """The file's text with the mutation applied."""
    path = root / mutation.file
    text = path.read_text() if path.is_file() else ""
    count = text.count(mutation.before)
    if count != 1:
        raise BadInput(f"{mutation.name}: the text to replace occurs {count} times, not once, in {mutation.file}:\n"
                       f"{mutation.before}")
    if mutation.before == mutation.after:
        raise BadInput(f"{mutation.name} changes nothing")
    return text.replace(mutation.before, mutation.after)


def files_of(root):
    for top in COPIED:
        path = root / top
        for file in [path] if path.is_file() else sorted(path.rglob("*")):
            if file.is_file() and file.suffix != ".pyc":
                yield file.relative_to(root)


def copy_tree(root, tree):
    """Copies the files of `root` to `tree`. Equal files stay untouched, so that their objects stay valid."""
    wanted = set(files_of(root))
    for file in wanted:
        source, target = root / file, tree / file
        if not target.is_file() or source.read_bytes() != target.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)
    for file in set(files_of(tree)) - wanted:
        (tree / file).unlink()


def failed_tests(output):
    """Of GoogleTest's or unittest's output: the tests that failed, or GoogleTest's test that ran when the program died."""
    failed = list(dict.fromkeys(re.findall(r"^(?:\[  FAILED  \]|FAIL:|ERROR:) (\S+?)(?:,| \()", output, re.MULTILINE)))
    if failed:
        return failed
    started = re.findall(r"^\[ RUN      \] (\S+)", output, re.MULTILINE)
    return started[-1:]
