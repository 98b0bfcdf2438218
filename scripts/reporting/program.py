"""What all scripts share: bad input, command lines, JSON files, and the project's READMEs."""
import argparse
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class BadInput(Exception):
    """One line for the user."""


def main_guard(main):
    """Runs main(); bad input becomes one line and exit status 2, as does a file that can't be opened."""
    try:
        sys.exit(main())
    except BrokenPipeError:
        sys.exit(141)
    except KeyboardInterrupt:
        sys.exit(130)
    except (BadInput, OSError) as error:
        said = f"{error.filename}: {error.strerror}" if getattr(error, "filename", None) else error
        print(f"{Path(sys.argv[0]).stem}: {said}", file=sys.stderr)
        sys.exit(2)


class Parser(argparse.ArgumentParser):
    """For a main() that main_guard() runs: a wrong command line is bad input. Options are not abbreviated."""

    def __init__(self, **settings):
        super().__init__(allow_abbrev=False, **settings)

    def error(self, message):
        raise BadInput(f"{message.replace('unrecognized arguments:', 'unknown argument')}; --help lists all")


def positive(kind):
    """The type of an option."""
    def number(text):
        if 0 < (value := kind(text)) < 1e6:
            return value
        raise argparse.ArgumentTypeError(f"{text} is not between 0 and a million")
    return number


def read_json(path):
    try:
        return json.loads(Path(path).read_text(encoding="utf-8"))
    except ValueError as error:
        raise BadInput(f"{path}: not JSON: {error}") from None


def parsed(path, parse, writer):
    """parse() of the file's JSON, which `writer` writes."""
    data = read_json(path)
    try:
        return parse(data)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise BadInput(f"{path}: not what '{writer}' writes: {type(error).__name__} {error}") from None


def write_bytes(path, content):
    """The new file replaces the old one in one step."""
    partial = path.with_name(f".{path.name}.partial")
    try:
        partial.write_bytes(content)
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def write_json(path, data):
    write_bytes(path, (json.dumps(data, indent=1) + "\n").encode())


def git(*arguments):
    """Its output; None if it fails."""
    done = subprocess.run(["git", "--no-optional-locks", "-C", ROOT, *arguments], capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else None


def commit():
    """Of the sources; ends in -dirty if they have changed, as in src/support/machine.cpp."""
    changes = git("status", "--porcelain", "--", ":/", ":(top,exclude)results")
    return (git("rev-parse", "--short=12", "HEAD") or "unknown") + ("-dirty" if changes else "")


def readmes(first):
    """`first`, the README of the root, then those of its folders, except builds and packages."""
    root = first.parent
    return [first, *(page for page in sorted(root.glob("*/**/README.md"))
                     if not any(part.startswith(("build", ".")) for part in page.relative_to(root).parts))]
