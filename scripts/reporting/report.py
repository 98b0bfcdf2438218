"""Makes the report of a results folder: one HTML file that shows its figures and lets readers filter and compare them."""
import subprocess
import sys
import tempfile
from pathlib import Path

from bench_rows import BadInput, main_guard
from json_file import write_text
from options import Parser
from report_bundle import Absent, bundle
from report_data import Result
from report_page import page

ROOT = Path(__file__).resolve().parents[2]
FILES = ("bench.json", "machine.json", "accuracy.json", "stability.json")


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, check=False)


def committed(ref, machine):
    """The results of a machine in a commit."""
    commit = git("rev-parse", "--verify", "--quiet", "--end-of-options", f"{ref}^{{commit}}")
    if commit.returncode:
        raise BadInput(f"{ref}: neither a results folder nor a commit")
    with tempfile.TemporaryDirectory() as folder:
        for name in FILES:
            found = git("show", f"{commit.stdout.decode().strip()}:results/{machine}/{name}")
            if found.returncode == 0:
                (Path(folder) / name).write_bytes(found.stdout)
        try:
            return Result(Path(folder), f"at {ref}")
        except BadInput as error:
            raise BadInput(f"{ref}: {str(error).replace(folder, f'results/{machine}')}") from None


def main():
    parser = Parser(
        prog="report", description=__doc__,
        epilog="Needs npm, and the npm registry when run for the first time. Exit status: 0 made, 2 bad input, 3 npm or its "
               "packages are missing.")
    parser.add_argument("results", type=Path, metavar="RESULTS", help="folder with bench.json, machine.json, …")
    parser.add_argument("--compare", action="append", default=[], metavar="FOLDER|COMMIT",
                        help="a results folder, or a commit that has results of the same machine, to compare with "
                             "(repeatable)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="where the report goes (RESULTS/report.html)")
    options = parser.parse_args()
    if not options.results.is_dir():
        raise BadInput(f"{options.results}: no such folder")
    results = [Result(options.results)]
    machine = results[0].bench.context.get("machine", options.results.resolve().name)
    results += [Result(Path(other)) if Path(other).is_dir() else committed(other, machine) for other in options.compare]
    path = options.out or options.results / "report.html"
    try:
        script = bundle()
    except Absent as error:
        print(f"report: {error}", file=sys.stderr)
        return 3
    write_text(path, page(options.results, results, script))
    print(f"{path}: {path.stat().st_size / 1e6:.1f} MB")
    return 0


main_guard(main)
