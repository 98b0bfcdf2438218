"""Reads accuracy.json and stability.json of a results folder, written by `edgewise accuracy` and `edgewise stability`."""
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from bench_rows import BadInput, read_json


@dataclass(frozen=True)
class Family:
    """The wording of a family's figures."""
    name: str
    errors: str  # the errors counted, with their unit
    trials: str  # the key of a scene's number of trials
    cost: str
    truths: tuple = ("score",)  # keys of the scores: the main truth first
    kinds: dict = field(default_factory=dict)  # kind of method: prefixes of its methods' names
    beyond: str = ""  # why a rate can exceed 10⁶ per 10⁶

    def beyond_note(self, rates):
        return f". {self.beyond}" if any(rate > 1e6 for rate in rates) else ""

    def kind(self, method):
        if method.ours:
            return "ours"
        return next((kind for kind, starts in self.kinds.items() if method.name.startswith(starts)), "other")


FAMILIES = {family.name: family for family in (
    Family("coverage", "wrong pixels per 10⁶ edge crossings", "crossings", "ns per covered pixel",
           ("float", "snapped"),
           {"floating point": ("float", "double"), "fixed point": ("fixed", "whole"), "scanline DDA": ("dda",)},
           "More than 10⁶: one crossing can cost many pixels, most where a triangle fills its bounding box"),
    Family("visibility", "pixels that show the wrong triangle, per 10⁶ covered", "covered", "ns per covered pixel",
           ("snapped",),  # all methods draw the same snapped triangles, so the other truth adds the same to each
           {"drawing in order": ("painter", "submission"),
            "depth buffer": ("float", "reversed", "unorm")}),
    Family("facing", "misjudged faces per 10⁶ visible ones", "covered", "ns per face",
           ("float", "snapped"),
           {"signed area": ("float_area",), "normal": ("normal",)}),
    Family("clipping", "wrong pixels per 10⁶ covered", "covered", "ns per covered pixel",
           beyond="More than 10⁶: pixels drawn where nothing should be count as well"),
)}


@dataclass(frozen=True)
class Method:
    name: str
    source: str
    promise: str
    exact: bool

    @property
    def ours(self):
        return self.source.startswith(("src/", "edgewise/", "frontend/"))


class Cost(NamedTuple):
    """The median, the fastest and the slowest repetition."""
    ns: float
    low: float
    high: float
    mtri: float  # 10⁶ triangles per second, median

    def overlaps(self, other):
        """Whether the order of the two is not settled."""
        return self.low <= other.high and other.low <= self.high


@dataclass(frozen=True)
class Measured:
    """One method on one scene."""
    method: Method
    rate: float  # errors per 10⁶
    bound: float | None  # 95 % upper bound per 10⁶, only where no error was seen
    snapped_rate: float | None  # the same against the snapped truth; coverage and facing only
    costs: dict  # by threads; empty where the scene is not timed
    gaps: int | None = None  # pixels; coverage only


@dataclass(frozen=True)
class Scene:
    name: str
    family: str
    summary: str
    trials: int
    measured: tuple

    @property
    def timed(self):
        return any(m.costs for m in self.measured)

    @property
    def single(self):
        """The measurements on one thread."""
        return [m for m in self.measured if 1 in m.costs]


@dataclass(frozen=True)
class Accuracy:
    machine: dict
    quick: bool
    methods: dict  # by family, in the registry's order
    scenes: tuple
    cube: dict | None  # {"frames", "methods": [(Method, {"gaps": (median, worst) per frame, "double_hits": …,
    # "total_gaps": over all frames, "total_double_hits", "snapped": the same against the snapped truth})]}

    def of(self, family):
        return [scene for scene in self.scenes if scene.family == family]

    def main_charts(self, family):
        """The first timed chart; of coverage two, since the vertices of the first scene already lie on the snapping grid."""
        return self.timed_charts(family)[:2 if family == "coverage" else 1]

    def timed_charts(self, family):
        """(name of the chart, scene) of each timed scene, the family's main scene first."""
        timed = [scene for scene in self.of(family) if scene.timed]
        return [(f"accuracy-{family}" + ("" if scene is timed[0] else f"-{scene.name}"), scene) for scene in timed]


@dataclass(frozen=True)
class Curve:
    method: str
    exact: bool
    points: tuple
    trials: tuple  # at each point
    starts_to_fail: float | None


@dataclass(frozen=True)
class Sweep:
    name: str
    family: str
    summary: str
    x: dict
    y: dict
    curves: tuple
    by_snapping: tuple  # at each point: the errors of rounding to 1/256 px alone


def parse_cost(speed, key):
    ns, ms = float(speed[key]), speed["ms"]
    median = float(ms["median"])
    return Cost(ns, ns * float(ms["min"]) / median, ns * float(ms["max"]) / median, float(speed["mtri_per_s"]))


def parse_measured(entry, family, method):
    scores = [entry[truth] for truth in FAMILIES[family].truths]
    cost = "ns_per_face" if family == "facing" else "ns_per_covered_pixel"
    costs = {int(speed["threads"]): parse_cost(speed, cost) for speed in entry.get("speed") or () if cost in speed}
    bound = scores[0].get("bound_per_million")
    return Measured(method, float(scores[0]["errors_per_million"]), None if bound is None else float(bound),
                    float(scores[1]["errors_per_million"]) if len(scores) > 1 else None, costs,
                    int(scores[0]["gaps"]) if family == "coverage" else None)


def parse_cube(data, methods):
    cube = data.get("turning_cube")
    if not cube:
        return None

    def worst_of(entry):
        counts = ("gaps", "double_hits")
        return {**{key: (float(entry[key]["median"]), float(entry[key]["worst"])) for key in counts},
                **{f"total_{key}": int(entry[key]["total"]) for key in counts}}

    rows = [(methods["coverage", entry["name"]], {**worst_of(entry), "snapped": worst_of(entry["snapped"])})
            for entry in cube["methods"]]
    return {"frames": int(cube["frames"]), "methods": rows}


def without_engine(data):
    """Leaves out the methods that are our engine with other numbers: a comparison of their own."""
    engine = {method["name"] for method in data["methods"] if method.get("engine")}
    if not engine:
        return data

    def others(holder):
        return {**holder, "methods": [method for method in holder["methods"] if method["name"] not in engine]}
    cube = data.get("turning_cube")
    return {**others(data), "scenes": [others(scene) for scene in data["scenes"]],
            **({"turning_cube": others(cube)} if cube else {})}


def parse_accuracy(data):
    data = without_engine(data)
    methods = {(m["family"], m["name"]): Method(m["name"], m["source"], m["promise"], bool(m["exact"]))
               for m in data["methods"]}
    scenes = []
    for scene in data["scenes"]:
        family = FAMILIES[scene["family"]]
        scenes.append(Scene(scene["name"], family.name, scene["summary"], int(scene[family.trials]),
                            tuple(parse_measured(entry, family.name, methods[family.name, entry["name"]])
                                  for entry in scene["methods"])))
    by_family = {name: [method for (family, _), method in methods.items() if family == name] for name in FAMILIES}
    return Accuracy(data["machine"], bool(data["quick"]), by_family, tuple(scenes), parse_cube(data, methods))


def parse_curve(entry):
    points = tuple((float(x), float(y)) for x, y in entry["points"])
    trials = tuple(int(n) for n in entry["trials"])
    fails = entry["starts_to_fail"]
    return Curve(entry["method"], bool(entry["exact"]), points, trials, None if fails is None else float(fails))


def parse_stability(data):
    axes = ("name", "log")
    return tuple(Sweep(sweep["name"], FAMILIES[sweep["family"]].name, sweep["summary"],
                       {"unit": sweep["x"].get("unit", ""), **{key: sweep["x"][key] for key in axes}},
                       {key: sweep["y"][key] for key in axes}, tuple(map(parse_curve, sweep["curves"])),
                       tuple(float(y) for _, y in sweep["by_snapping"]))
                 for sweep in data["sweeps"])


def parsed(path, parse, what):
    data = read_json(path)
    try:
        return parse(data)
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise BadInput(f"{path}: not {what}: {type(error).__name__} {error}") from None


def read_accuracy(folder):
    """None if accuracy was not measured."""
    path = Path(folder) / "accuracy.json"
    return parsed(path, parse_accuracy, "what 'edgewise accuracy' writes") if path.exists() else None


def read_stability(folder):
    """No sweeps if stability was not tested."""
    path = Path(folder) / "stability.json"
    return parsed(path, parse_stability, "what 'edgewise stability' writes") if path.exists() else ()
