"""Evaluates scripts/claims.toml: the sentences of README.md about results, on every machine's folder in results/ that has the rows."""
import re
import tomllib
from functools import cache

from bench_rows import gained, read_bench
from factors import cells, chosen, gains
from noise import median
from program import ROOT, read_json

SECTION = re.compile(r"^## What we found$(.*?)^<!-- results:", re.MULTILINE | re.DOTALL)
FACTS = "facts"  # the folder of errors, which are the same on every machine
# Random triangles, and squares of 4 px in two triangles: much is hidden, or most triangles are tiny.
STREAMS = {"large", "medium", "small", "micro", "sliver", "grid4"}


@cache
def of_machine(folder):
    """What an expression about times may use. Speed-ups are of whole frames."""
    bench = read_bench(folder)

    def frames(who, threads, target=None):
        """{scene: row} of a backend or peer. `target` limits the SIMD of ours."""
        return {scene: row for scene in bench.scenes if (row := bench.frame(who, scene, threads, target))}

    def bands(threads, are_streams):
        """{scene: the row of the fastest cell with SIMD in bands}: of STREAMS, or of all others."""
        rows = {}
        for cell, row in chosen(cells(bench), simd=True, traversal="bands", extra="", threads=threads).items():
            rows.setdefault(cell.scene, []).append(row)
        return {scene: min(rows[scene], key=lambda row: row.median_ms) for scene in (STREAMS if are_streams else rows.keys() - STREAMS)}

    def ratios(before, after):
        """The speed-ups, one per scene that was timed on both sides."""
        return [gained(row, after[scene]) for scene, row in before.items() if scene in after]

    def factor(name):
        """{where: Gain} of a factor with SIMD."""
        return {gain.where: gain for gain in gains(bench) if gain.factor == name}

    return {"frames": frames, "bands": bands, "ratios": ratios, "factor": factor}


@cache
def of_facts(folder):
    """What an expression about errors may use; {method: entry} of all frames of the turning cube, and of each scene of README's chart."""
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

    def by_method(of):
        return {entry["name"]: entry for entry in of["methods"]}

    return {"projected": projected, "cracks": cracks, "turning": by_method(accuracy["turning_cube"]),
            "choices": {choice["name"]: by_method(choice) for choice in accuracy["choices"]}}


def plain(text):
    """A page's text in one line, without links and emphasis."""
    return " ".join(re.sub(r"\]\([^)]*\)", "]", text).translate(str.maketrans("", "", "[]*`")).split())


def evaluated(claim, results):
    """{folder: {expression: value}} of a claim, for each folder that has what its expressions need."""
    found, are_facts = {}, claim["of"] == [FACTS]
    for path in sorted(results.glob("*/accuracy.json" if are_facts else "*/bench.json")):
        names = {"__builtins__": {}, "median": median, "min": min, "max": max, "sum": sum, **(of_facts if are_facts else of_machine)(path.parent)}
        try:
            found[path.parent.name] = {expression: eval(expression, names) for expression in claim["bounds"]}  # our own file's
        except (KeyError, ValueError):  # no such row, or the median of none
            pass
    return found


def faults(claim, found, page):
    """Why a claim does not hold, one line each. `page`: the text of README.md."""
    if plain(claim["says"]) not in page:
        yield "is not in README.md"
    if set(found) != set(claim["of"]):
        yield f"can be evaluated on {', '.join(found) or 'no folder'}, not on {', '.join(claim['of'])}"
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


def check():
    """Prints each claim and on how many folders of results it holds; returns the number of faults."""
    readme, toml = ((ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "scripts/claims.toml"))
    data = tomllib.loads(toml)
    machines = data["machines"]
    claims = [{"of": [machines[name] for name in machines if name in claim["says"]] or list(machines.values()), **claim} for claim in data["claim"]]
    told = [f"no claim: {sentence}" for sentence in unclaimed(SECTION.search(readme)[1], claims)]
    for claim in claims:
        found = evaluated(claim, ROOT / "results")
        print(f"{'facts' if claim['of'] == [FACTS] else len(found):>5}  {plain(claim['says'])[:90]}")
        told += [f"{claim['says'][:40]}: {fault}" for fault in faults(claim, found, plain(readme))]
    print("\n".join(told))
    return len(told)
