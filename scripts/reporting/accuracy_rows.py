"""Reads the accuracy and stability of methods: facts/accuracy.json and stability.json, a machine's peers.json, and the times of
methods among the rows of its bench.json."""
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

from bench_rows import LABORATORY, facts_of
from choice import parse_choices
from program import parsed


class Family(NamedTuple):
    """The wording of a family's figures."""
    name: str
    errors: str  # the errors counted, with their unit
    trials: str  # the key of a scene's number of trials
    trial: str  # what is tried
    truth: str = "score"  # the key of the scores that are shown


FAMILIES = {family.name: family for family in (
    Family("coverage", "Wrong samples of single triangles, hidden ones included, per 10⁶ edge crossings", "crossings", "edge crossings", "source"),
    # All methods draw the same snapped triangles, so the other truth adds the same to each.
    Family("visibility", "Pixels that show the wrong triangle, per 10⁶ covered", "covered", "covered pixels", "snapped"),
    Family("facing", "Misjudged faces per 10⁶ visible ones", "covered", "visible faces", "source"),
    Family("clipping", "Wrong pixels, those drawn where nothing should be included, per 10⁶ covered", "covered", "covered pixels"),
    Family("projection", "Samples of single triangles that differ from the exact projection of the scene's vertices, per 10⁶ edge crossings",
           "crossings", "edge crossings"),
)}


SCALAR, SIMD = "scalar", "simd"
MESHES, OUR_GRID = "meshes", "vertices on our grid"  # kinds of scenes
UNLIMITED_PX = 4096  # the largest triangles for which any method promises anything


@dataclass(frozen=True)
class Method:
    name: str
    source: str
    max_side_px: float | None = None  # coverage: the integers of triangles with larger boxes overflow

    @property
    def ours(self):
        return self.source.startswith(("src/", "edgewise/", "frontend/"))


@dataclass(frozen=True)
class Measured:
    """One method on one scene."""
    method: Method
    rate: float  # errors per 10⁶
    forms: dict  # the rows on one thread of the forms SCALAR and SIMD; empty where the scene is not timed
    wrong: int  # coverage: pixels of a picture that show the wrong triangle
    through: int  # coverage: those where something shows through


@dataclass(frozen=True)
class Scene:
    name: str
    family: str
    trials: int
    measured: tuple
    largest_side_px: float = 0.0  # of the triangles' boxes; coverage only
    kind: str = MESHES  # coverage only: or OUR_GRID, or others

    def in_range_of(self, method):
        """Beyond its range a method's integers overflow, which is another fault than the one that is counted."""
        limit = method.max_side_px or UNLIMITED_PX
        return limit >= UNLIMITED_PX or self.largest_side_px <= limit

    def of(self, method):
        """The measurement of the method with this name, or None."""
        return next((m for m in self.measured if m.method.name == method), None)


@dataclass(frozen=True)
class Accuracy:
    methods: dict  # by family, in the registry's order
    scenes: tuple
    cube: dict = field(default_factory=dict)  # of all frames of the turning cube: {method's name: (gaps, double hits)}
    frames: int = 0  # of the cube
    flicker: dict = field(default_factory=dict)  # {moving scene: {method's name: superfluous changes per 10⁶ true ones}}
    choices: tuple = ()  # of choice.Panel

    def of(self, family):
        return [scene for scene in self.scenes if scene.family == family]


@dataclass(frozen=True)
class Curve:
    method: Method
    points: tuple
    starts_to_fail: float | None
    trials: int  # the fewest at a point


@dataclass(frozen=True)
class Sweep:
    name: str
    family: str
    x: dict
    curves: tuple
    why: str = ""  # ours fail


def parse_measured(entry, family, method, forms):
    score = entry[FAMILIES[family].truth]
    wrong, through = (int(score[key]) if family == "coverage" else 0 for key in ("wrong_pixels", "wrong_surface_pixels"))
    return Measured(method, float(score["errors_per_million"]), forms, wrong, through)


def times_of(bench):
    """{(family, scene, method): {SCALAR or SIMD: row}} on one thread"""
    found = {}
    for row in bench.sweep("method") if bench else ():
        if row.backend == LABORATORY and row.threads == 1:
            keys = row.keys
            found.setdefault((keys["family"], row.scene, keys["method"]), {})[SCALAR if keys["simd"] == SCALAR else SIMD] = row
    return found


def parse_accuracy(data, bench=None):
    times = times_of(bench)
    methods = {(m["family"], m["name"]): Method(m["name"], m["source"], m.get("max_side_px")) for m in data["methods"]}
    scenes = []
    for scene in data["scenes"]:
        family = FAMILIES[scene["family"]]
        triangles = int(scene["triangles"])
        measured = [parse_measured(entry, family.name, methods[family.name, entry["name"]],
                                   {form: row for form, row in times.get((family.name, scene["name"], entry["name"]), {}).items()
                                    if row.counters["triangles"] == triangles})  # else timed on a scene of another size
                    for entry in scene["methods"]]
        scenes.append(Scene(scene["name"], family.name, int(scene[family.trials]), tuple(measured), float(scene.get("largest_side_px", 0.0)),
                            scene["kind"]))
    by_family = {name: [method for (family, _), method in methods.items() if family == name] for name in FAMILIES}
    cube = data.get("turning_cube") or {"methods": (), "frames": 0}
    flicker = {motion["name"]: {entry["name"]: 1e6 * entry["superfluous"] / motion["changes"] for entry in motion["methods"]}
               for motion in data.get("motions", ())}
    return Accuracy(by_family, tuple(scenes), {of["name"]: (of["gaps"]["total"], of["double_hits"]["total"]) for of in cube["methods"]},
                    cube["frames"], flicker, parse_choices(data.get("choices", ())))


def with_peers(data, peers):
    """The methods of peers added to those of facts, in the chart for choosing a method."""
    found = {choice["name"]: choice["methods"] for choice in peers.get("choices", ())}
    return {**data, "choices": [{**choice, "methods": [*choice["methods"], *found.get(choice["name"], ())]} for choice in data.get("choices", ())]}


def parse_curve(entry):
    points = tuple((float(x), float(y)) for x, y in entry["points"])
    fails = entry["starts_to_fail"]
    return Curve(Method(entry["method"], entry["source"]), points, None if fails is None else float(fails), min(entry["trials"]))


def parse_stability(data):
    return tuple(Sweep(sweep["name"], FAMILIES[sweep["family"]].name, {"name": sweep["x"]["name"], "unit": sweep["x"].get("unit", "")},
                       tuple(map(parse_curve, sweep["curves"])), sweep["why"])
                 for sweep in data["sweeps"])


def read_accuracy(folder, bench):
    """The facts beside a machine's folder, with its peers and the times of its benchmark; None if accuracy was not measured."""
    path, peers = facts_of(folder) / "accuracy.json", folder / "peers.json"
    if not path.exists():
        return None

    def parse(data):
        if peers.exists():
            data = parsed(peers, partial(with_peers, data), "edgewise accuracy --peers")
        return parse_accuracy(data, bench)

    return parsed(path, parse, "edgewise accuracy")


def read_stability(folder):
    """No sweeps if stability was not tested."""
    path = facts_of(folder) / "stability.json"
    return parsed(path, parse_stability, "edgewise stability") if path.exists() else ()
