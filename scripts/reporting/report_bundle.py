"""The script of report.html: scripts/web/ and the packages that it imports, in one file."""
import filecmp
import shutil
import subprocess
from pathlib import Path

from bench_rows import BadInput

ROOT = Path(__file__).resolve().parents[2]
SOURCE, WORK = ROOT / "scripts/web", ROOT / "build/report"
NETWORK_ERRORS = ("ENOTFOUND", "EAI_AGAIN", "ETIMEDOUT", "ENETUNREACH", "EHOSTUNREACH", "ECONNREFUSED", "ECONNRESET")


class Absent(Exception):
    """npm or its packages are not on this machine and cannot be fetched."""


def bundle():
    """Its path. The packages come from the npm registry once, and then from build/report/."""
    if shutil.which("npm") is None:
        raise Absent("npm is not installed, so there is no report.html, only the static charts (scripts/run --report "
                     "installs it)")
    WORK.mkdir(parents=True, exist_ok=True)
    for path in (*SOURCE.glob("*.js"), *SOURCE.glob("*.json")):
        shutil.copyfile(path, WORK / path.name)
    lock, installed = WORK / "package-lock.json", WORK / "installed.json"
    if not installed.exists() or not filecmp.cmp(lock, installed, shallow=False):
        install()
        shutil.copyfile(lock, installed)
    built = subprocess.run(["node", "build.js"], cwd=WORK, check=False)
    if built.returncode:
        raise BadInput("the script of the page could not be built; see above")
    return WORK / "bundle.js"


def install():
    done = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error",
                           "--fetch-retries=1", "--fetch-retry-mintimeout=1000"],
                          cwd=WORK, capture_output=True, text=True, check=False)
    if done.returncode:
        said = done.stderr.strip()
        reason = ("No network: npm cannot reach its registry" if any(name in said for name in NETWORK_ERRORS)
                  else "npm could not fetch its packages")
        raise Absent(f"{reason}, so there is no report.html, only the static charts. npm said:\n{said}")
