"""Reads the accuracy and stability of methods: facts/accuracy.json and stability.json, and a machine's peers.json."""
import math
from typing import NamedTuple

from bench_rows import facts_of
from choice import parse_choices
from program import parsed


class Family(NamedTuple):
    """The wording of a family's figures."""
    errors: str  # the errors counted, with their unit
    trials: str  # the key of a scene's number of trials
    trial: str  # what is tried
    truth: str = "score"  # the key of the scores that are shown


FAMILIES = {
    "coverage": Family("Wrong samples of single triangles, hidden ones included, per 10⁶ edge crossings", "crossings", "edge crossings", "source"),
    # All methods draw the same snapped triangles, so the other truth adds the same to each.
    "visibility": Family("Pixels that show the wrong triangle, per 10⁶ covered", "covered", "covered pixels", "snapped"),
    "facing": Family("Misjudged faces per 10⁶ visible ones", "covered", "visible faces", "source"),
    "clipping": Family("Wrong pixels, those drawn where nothing should be included, per 10⁶ covered", "covered", "covered pixels"),
    "projection": Family("Samples of single triangles that differ from the exact projection of the scene's vertices, per 10⁶ edge crossings",
                         "crossings", "edge crossings"),
}


MESHES, OUR_GRID = "meshes", "vertices on our grid"  # kinds of scenes


class Method(NamedTuple):
    name: str
    source: str
    max_side_px: float = math.inf  # coverage: the integers of triangles with larger boxes overflow

    @property
    def ours(self):
        return self.source.startswith(("src/", "edgewise/", "frontend/"))


class Scene(NamedTuple):
    name: str
    trials: int
    rates: dict  # errors per 10⁶, by method's name
    pixels: dict  # by method's name; coverage only: pixels of a picture that show the wrong triangle, and those where something shows through
    largest_side_px: float  # of the triangles' boxes; coverage only
    kind: str  # coverage only: MESHES, OUR_GRID, or others


class Accuracy(NamedTuple):
    methods: dict  # by family, in the registry's order
    scenes: dict  # by family
    cube: dict  # of all frames of the turning cube: {method's name: (gaps, double hits)}
    frames: int  # of the cube
    flicker: dict  # {moving scene: {method's name: superfluous changes per 10⁶ true ones}}
    choices: tuple  # of choice.Panel


class Curve(NamedTuple):
    method: Method
    held: float  # the share of the sweep's places, easy ones first, before the first at which the method fails
    starts_to_fail: float | None
    trials: int  # the fewest at a place


class Sweep(NamedTuple):
    name: str
    family: str
    unit: str  # of its places, or their name where they have none
    ends: tuple  # the first and the last place
    why: str  # ours fail
    curves: list


def parse_scene(scene, family):
    scores = {of["name"]: of[family.truth] for of in scene["methods"]}
    return Scene(scene["name"], int(scene[family.trials]), {name: float(score["errors_per_million"]) for name, score in scores.items()},
                 {name: (score.get("wrong_pixels", 0), score.get("wrong_surface_pixels", 0)) for name, score in scores.items()},
                 scene.get("largest_side_px", 0.0), scene["kind"])


def parse_accuracy(data, peers):
    """`peers`: the methods of peers in the chart for choosing a method, by its scenes."""
    methods = {family: [Method(of["name"], of["source"], of.get("max_side_px", math.inf)) for of in data["methods"] if of["family"] == family]
               for family in FAMILIES}
    scenes = {name: [parse_scene(of, family) for of in data["scenes"] if of["family"] == name] for name, family in FAMILIES.items()}
    cube = data.get("turning_cube", {"methods": (), "frames": 0})
    flicker = {motion["name"]: {of["name"]: 1e6 * of["superfluous"] / motion["changes"] for of in motion["methods"]}
               for motion in data.get("motions", ())}
    faults = {of["name"]: (of["gaps"]["total"], of["double_hits"]["total"]) for of in cube["methods"]}
    choices = [{**of, "methods": of["methods"] + peers.get(of["name"], [])} for of in data.get("choices", ())]
    return Accuracy(methods, scenes, faults, cube["frames"], flicker, parse_choices(choices))


def parse_sweep(sweep):
    places = list(dict.fromkeys(place for of in sweep["curves"] for place, _ in of["points"]))
    first, *_, last = places

    def curve(of):
        fails = of["starts_to_fail"]
        return Curve(Method(of["method"], of["source"]), 1.0 if fails is None else places.index(fails) / len(places), fails, min(of["trials"]))

    unit = sweep["x"].get("unit") or sweep["x"]["name"]
    return Sweep(sweep["name"], sweep["family"], unit, (first, last), sweep["why"], [*map(curve, sweep["curves"])])


def read_facts(folder, name, parse):
    """parse() of what `edgewise NAME` wrote beside a machine's folder; empty if it wrote nothing."""
    path = facts_of(folder) / f"{name}.json"
    return parsed(path, parse, f"edgewise {name}") if path.exists() else {}


def read_accuracy(folder):
    """With the machine's peers."""
    def methods(data):
        return {of["name"]: of["methods"] for of in data.get("choices", ())}

    path = folder / "peers.json"
    peers = parsed(path, methods, "edgewise accuracy --peers") if path.exists() else {}
    return read_facts(folder, "accuracy", lambda data: parse_accuracy(data, peers))


def read_stability(folder):
    return read_facts(folder, "stability", lambda data: [*map(parse_sweep, data["sweeps"])])
