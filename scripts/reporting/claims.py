"""Evaluates scripts/claims.toml: the sentences of README.md about results, on every machine's folder in results/ that has the rows."""
import re
import tomllib
from pathlib import Path

from bench_rows import read_bench
from factors import cells, chosen, gains
from noise import median
from program import ROOT, BadInput, read_json

# Scenes that are meshes of one or a few objects, as people draw them.
MESHES = ("cube", "cubes", "sphere", "torus-knot", "terrain", "knots", "cow", "spot", "stanford-bunny", "suzanne", "teapot")
# Scenes in which much is hidden, or nearly all triangles are below 100 px.
HARD = ("large", "medium", "small", "micro", "sliver", "grid4")


class NotTimed(Exception):
    """The folder lacks the rows of an expression."""


def of_machine(bench):
    """What an expression about times may use."""
    def ratios(before, after, threads, scenes=None, target=None):
        """The speed-ups from one drawer's whole frames to another's, one per scene. `target` limits the SIMD of `after`."""
        limit = f"/target:{target}" if target not in (None, bench.context.get("simd_target")) else ""
        pairs = [(bench.frame(before, scene, threads), bench.find(f"{after}+frontend/{scene}{limit}/threads:{threads}"))
                 for scene in bench.scenes if scenes is None or scene in scenes]
        return timed(a.median_ms / b.median_ms for a, b in pairs if a and b)

    def scaling(who, threads):
        """The speed-ups from one thread to `threads`, one per scene."""
        pairs = [(bench.frame(who, scene, 1), bench.frame(who, scene, threads)) for scene in bench.scenes]
        return timed(a.median_ms / b.median_ms for a, b in pairs if a and b)

    def factor(*names):
        """The median speed-ups of these factors with SIMD, one per fill, traversal or kind of scene."""
        return timed(gain.median for gain in gains(bench) if gain.simd and gain.factor in names)

    def bands(threads, scenes):
        """The speed-ups of `tiled` over the fastest cell with SIMD in bands, one per scene."""
        found = {}
        for cell, row in chosen(cells(bench), simd=True, traversal="bands", threads=threads).items():
            found[cell.scene] = min(row.median_ms, found.get(cell.scene, row.median_ms))
        frames = {scene: bench.frame("tiled", scene, threads) for scene in found if scene in scenes}
        return timed(found[scene] / row.median_ms for scene, row in frames.items() if row)

    def timed(values):
        found = list(values)
        if not found:
            raise NotTimed
        return found

    return {"ratios": ratios, "scaling": scaling, "factor": factor, "bands": bands}


def of_facts(folder):
    """What an expression about errors may use."""
    accuracy = read_json(folder / "accuracy.json")

    def scores(family, method, but=()):
        return [(scene, entry) for scene in accuracy["scenes"] if scene["family"] == family and scene["name"] not in but
                for entry in scene["methods"] if entry["name"] == method]

    def projected(method):
        """Wrong samples per 10^6 crossings of the scenes that have a camera."""
        found = scores("projection", method)
        return 1e6 * sum(entry["score"]["errors"] for _, entry in found) / sum(scene["crossings"] for scene, _ in found)

    def cracks(method, kind, but=()):
        """Gaps or double hits in each coverage scene."""
        return {scene["name"]: entry["cracks"][kind] for scene, entry in scores("coverage", method, but) if "cracks" in entry}

    def turning(method, kind):
        """Gaps, double hits, missing or extra samples of all frames of the turning cube."""
        return next(entry[kind]["total"] for entry in accuracy["turning_cube"]["methods"] if entry["name"] == method)

    return {"projected": projected, "cracks": cracks, "turning": turning}


def plain(text):
    """A page's text in one line, without links and emphasis."""
    return " ".join(re.sub(r"\]\([^)]*\)", "]", text).translate(str.maketrans("", "", "[]*`")).split())


def values(claim, names):
    """{expression: value}"""
    common = {"__builtins__": {}, "MESHES": MESHES, "HARD": HARD, "median": median, "min": min, "max": max, "sum": sum}
    return {expression: eval(expression, common, names) for expression in claim["bounds"]}  # our own file's


def evaluated(claim, results):
    """{folder, or "facts": {expression: value}} of a claim."""
    if claim.get("of") == "facts":
        return {"facts": values(claim, of_facts(results / "facts"))}
    found = {}
    for path in sorted(results.glob("*/bench.json")):
        try:
            found[path.parent.name] = values(claim, of_machine(read_bench(path.parent)))
        except NotTimed:
            pass
    return found


def faults(claim, found, page):
    """Why a claim does not hold, one line each. `page`: the text of README.md."""
    if plain(claim["says"]) not in page:
        yield "is not in README.md"
    if claim.get("of") != "facts" and len(found) != claim["machines"]:
        yield f"was timed on {len(found)} machines, not on {claim['machines']}"
    if claim.get("machines") == 1 and "Zen" not in claim["says"]:
        yield "does not name its only machine"
    for where, by_expression in found.items():
        for expression, value in by_expression.items():
            low, high = claim["bounds"][expression]
            if not low <= value <= high:
                yield f"{where}: {expression} is {value:.4g}, not in [{low}, {high}]"


def read_claims(path):
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))["claim"]
    except (OSError, KeyError, tomllib.TOMLDecodeError) as error:
        raise BadInput(f"{path}: {error}") from None


def check(root=ROOT):
    """Prints each claim and on how many machines it holds; returns the number of faults."""
    page, count = plain(Path(root, "README.md").read_text(encoding="utf-8")), 0
    for claim in read_claims(root / "scripts/claims.toml"):
        found = evaluated(claim, root / "results")
        print(f"{len(found) if claim.get('of') != 'facts' else 'facts':>5}  {plain(claim['says'])[:90]}")
        for fault in faults(claim, found, page):
            print(f"       {fault}")
            count += 1
    return count
