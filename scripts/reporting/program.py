"""What all scripts share: bad input, command lines, JSON files, and the project's READMEs."""
import argparse
import difflib
import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class BadInput(Exception):
    """One line for the user."""


def main_guard(main):
    """Runs main(); bad input becomes one line and exit status 2."""
    try:
        sys.exit(main())
    except BadInput as error:
        print(f"{Path(sys.argv[0]).stem}: {error}", file=sys.stderr)
        sys.exit(2)
    except BrokenPipeError:
        sys.exit(141)


class Parser(argparse.ArgumentParser):
    """Reports a wrong command line in one line with exit status 2, and suggests the nearest option."""

    def __init__(self, **settings):
        super().__init__(allow_abbrev=False, **settings)

    def parse_args(self, args=None, namespace=None):
        args = sys.argv[1:] if args is None else args
        for arg in args:
            name = arg.partition("=")[0]
            if re.match(r"--?[A-Za-z]", name) and name not in self._option_string_actions:
                near = difflib.get_close_matches(name, self._option_string_actions, 1)
                self.error(f"unknown argument '{arg}'" + (f"; did you mean {near[0]}?" if near else ""))
        return super().parse_args(args, namespace)

    def error(self, message):
        print(f"{self.prog}: {message}{'' if message.endswith('?') else ';'} --help lists all", file=sys.stderr)
        sys.exit(2)


def positive(kind):
    """The type of an option."""
    def number(text):
        if not 0 < (value := kind(text)) < 1e6:
            raise ValueError
        return value

    number.__name__ = f"positive {kind.__name__}"
    return number


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}") from None
    except ValueError as error:
        raise BadInput(f"{path}: not JSON: {error}") from None


def parsed(path, parse, writer):
    """parse() of the file's JSON, which `writer` writes."""
    data = read_json(path)
    try:
        return parse(data)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise BadInput(f"{path}: not what '{writer}' writes: {type(error).__name__} {error}") from None


def replaced(target, write):
    """`write` makes another file, which then replaces `target` in one step."""
    partial = target.with_name(f".{target.name}.partial")
    try:
        write(partial)
        partial.replace(target)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise BadInput(f"cannot write {target}: {error.filename}: {error.strerror}") from None


def write_text(path, text):
    replaced(path, lambda partial: partial.write_text(text, encoding="utf-8"))


def write_json(path, data):
    write_text(path, json.dumps(data, indent=1) + "\n")


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
