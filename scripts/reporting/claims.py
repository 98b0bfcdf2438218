"""Evaluates scripts/claims.toml: the sentences of README.md about results, on every machine's folder in results/ that has the rows."""
import re
import tomllib
from functools import cache
from pathlib import Path

from bench_rows import gained, read_bench
from factors import cells, chosen, gains
from noise import median
from program import ROOT, BadInput, read_json

SECTION = re.compile(r"^## What we found$(.*?)^<!-- results:", re.MULTILINE | re.DOTALL)
# Random triangles, and squares of 4 px in two triangles: much is hidden, or most triangles are tiny.
STREAMS = ("large", "medium", "small", "micro", "sliver", "grid4")


class NotTimed(Exception):
    """The folder lacks the rows of an expression."""


@cache
def of_machine(folder):
    """What an expression about times may use. Speed-ups are of whole frames."""
    bench = read_bench(folder)

    def ratios(before, after, threads, target=None):
        """The speed-ups from one drawer to another, one per scene. `target` limits the SIMD of `after`."""
        limit = f"/target:{target}" if target not in (None, bench.context.get("simd_target")) else ""
        return speed_ups((bench.frame(before, scene, threads), bench.find(f"{after}+frontend/{scene}{limit}/threads:{threads}"))
                         for scene in bench.scenes)

    def scaling(who, threads):
        """The speed-ups from one thread to `threads`, one per scene."""
        return speed_ups((bench.frame(who, scene, 1), bench.frame(who, scene, threads)) for scene in bench.scenes)

    def factor(name):
        """{where: Gain} of a factor with SIMD."""
        return timed({gain.where: gain for gain in gains(bench) if gain.factor == name})

    def bands(threads, are_streams):
        """The speed-ups of `tiled` over the fastest cell with SIMD in bands, one per scene: of STREAMS, or of all others."""
        fastest = {}
        for cell, row in chosen(cells(bench), simd=True, traversal="bands", threads=threads).items():
            fastest[cell.scene] = min(row, fastest.get(cell.scene, row), key=lambda row: row.median_ms)
        if not set(STREAMS) <= set(fastest):
            raise NotTimed
        return speed_ups((row, bench.frame("tiled", scene, threads)) for scene, row in fastest.items()
                         if (scene in STREAMS) == are_streams)

    def speed_ups(pairs):
        return timed([gained(before, after) for before, after in pairs if before and after])

    def timed(found):
        if not found:
            raise NotTimed
        return found

    return {"ratios": ratios, "scaling": scaling, "factor": factor, "bands": bands}


@cache
def of_facts(folder):
    """What an expression about errors may use."""
    accuracy = read_json(folder / "accuracy.json")

    def scores(family, method):
        return [(scene, entry) for scene in accuracy["scenes"] if scene["family"] == family
                for entry in scene["methods"] if entry["name"] == method]

    def projected(method):
        """Wrong samples per 10^6 crossings of the scenes that have a camera."""
        found = scores("projection", method)
        return 1e6 * sum(entry["score"]["errors"] for _, entry in found) / sum(scene["crossings"] for scene, _ in found)

    def cracks(method, kind):
        """{coverage scene: gaps or double hits at shared edges}"""
        return {scene["name"]: entry["cracks"][kind] for scene, entry in scores("coverage", method) if "cracks" in entry}

    def turning(method, kind):
        """Gaps or double hits of all frames of the turning cube."""
        return next(entry[kind]["total"] for entry in accuracy["turning_cube"]["methods"] if entry["name"] == method)

    def holes(scene, method):
        """Of all frames of a scene of README's chart."""
        return next(entry["holes"] for choice in accuracy["choices"] if choice["name"] == scene
                    for entry in choice["methods"] if entry["name"] == method)

    return {"projected": projected, "cracks": cracks, "turning": turning, "holes": holes}


def plain(text):
    """A page's text in one line, without links and emphasis."""
    return " ".join(re.sub(r"\]\([^)]*\)", "]", text).translate(str.maketrans("", "", "[]*`")).split())


def values(claim, names):
    """{expression: value}"""
    common = {"__builtins__": {}, "median": median, "min": min, "max": max, "sum": sum}
    return {expression: eval(expression, {**common, **names}) for expression in claim["bounds"]}  # our own file's


def evaluated(claim, results):
    """{folder: {expression: value}} of a claim."""
    if claim["of"] == "facts":
        return {"facts": values(claim, of_facts(results / "facts"))}
    found = {}
    for path in sorted(results.glob("*/bench.json")):
        try:
            found[path.parent.name] = values(claim, of_machine(path.parent))
        except NotTimed:
            pass
    return found


def faults(claim, found, page):
    """Why a claim does not hold, one line each. `page`: the text of README.md."""
    if plain(claim["says"]) not in page:
        yield "is not in README.md"
    if claim["of"] != "facts" and set(found) != set(claim["of"]):
        yield f"was timed on {', '.join(found) or 'no machine'}, not on {', '.join(claim['of']) or 'one that it names'}"
    for where, by_expression in found.items():
        for expression, value in by_expression.items():
            low, high = claim["bounds"][expression]
            if not low <= value <= high:
                yield f"{where}: {expression} is {value:.4g}, not in [{low}, {high}]"


def unclaimed(section, claims):
    """The sentences with a figure of this text that no claim has."""
    said = [plain(claim["says"]) for claim in claims]
    return [sentence for sentence in re.split(r"(?<=[.:])\s", plain(section))
            if re.search(r"\d[\d,.]*( million|×| in | holes)", sentence) and not any(sentence.strip("- ") in text for text in said)]


def read_claims(path):
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        machines = data["machines"]
        return [{"of": [machines[name] for name in machines if name in claim["says"]] or list(machines.values()), **claim}
                for claim in data["claim"]]
    except (OSError, KeyError, tomllib.TOMLDecodeError) as error:
        raise BadInput(f"{path}: {error}") from None


def check(root=ROOT):
    """Prints each claim and on how many machines it holds; returns the number of faults."""
    readme, claims = Path(root, "README.md").read_text(encoding="utf-8"), read_claims(root / "scripts/claims.toml")
    told = [f"no claim: {sentence}" for sentence in unclaimed(SECTION.search(readme)[1], claims)]
    for claim in claims:
        found = evaluated(claim, root / "results")
        print(f"{'facts' if claim['of'] == 'facts' else len(found):>5}  {plain(claim['says'])[:90]}")
        told += [f"{claim['says'][:40]}: {fault}" for fault in faults(claim, found, plain(readme))]
    print("\n".join(told))
    return len(told)
