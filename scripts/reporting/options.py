"""Command lines of the Python scripts."""
import argparse
import difflib
import re
import sys


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
