"""Reads the accuracy and stability of methods: facts/accuracy.json and stability.json, a machine's peers.json, and the times of
methods among the rows of its bench.json."""
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

from bench_rows import LABORATORY, Row, facts_of
from program import parsed


class Family(NamedTuple):
    """The wording of a family's figures."""
    name: str
    errors: str  # the errors counted, with their unit
    trials: str  # the key of a scene's number of trials
    trial: str  # what is tried
    truth: str = "score"  # the key of the scores that are shown
    beyond: str = ""  # why a rate can exceed 10⁶ per 10⁶


FAMILIES = {family.name: family for family in (
    Family("coverage", "wrong samples of single triangles, hidden ones included, per 10⁶ edge crossings", "crossings", "edge crossings", "source",
           "More than 10⁶: one crossing can cost many pixels, most where a triangle fills its bounding box."),
    # All methods draw the same snapped triangles, so the other truth adds the same to each.
    Family("visibility", "pixels that show the wrong triangle, per 10⁶ covered", "covered", "covered pixels", "snapped"),
    Family("facing", "misjudged faces per 10⁶ visible ones", "covered", "visible faces", "source"),
    Family("clipping", "wrong pixels per 10⁶ covered", "covered", "covered pixels",
           beyond="More than 10⁶: pixels drawn where nothing should be count as well."),
    Family("projection", "samples of single triangles that differ from the exact projection of the scene's vertices, per 10⁶ edge crossings",
           "crossings", "edge crossings"),
)}


PEERS = ("llvmpipe", "softpipe", "lavapipe", "swiftshader", "gpu")
SCALAR = "scalar"  # the name of the form without SIMD
LEAST_SHARE = 0.01  # of the trials of a family's largest scene
MESHES, SINGLE, OUR_GRID = "meshes", "single triangles", "vertices on our grid"  # kinds of scenes
UNLIMITED_PX = 4096  # the largest triangles for which any method promises anything


@dataclass(frozen=True)
class Method:
    name: str
    source: str
    max_side_px: float | None = None  # coverage: triangles with larger boxes overflow
    engine: bool = False  # our SIMD engine with one kind of numbers
    other_bits: bool = False  # projection: one of many subpixel bits

    @property
    def limit_px(self):
        """Beyond triangles of this size the method's integers overflow; None if every triangle on a screen is in range."""
        return self.max_side_px if self.max_side_px and self.max_side_px < UNLIMITED_PX else None

    @property
    def peer(self):
        """Another project's rasterizer; the source is its version."""
        return self.name.startswith(PEERS)

    @property
    def apart(self):
        """Whether only the main chart shows it, not the charts of methods."""
        return self.engine or self.peer or self.other_bits

    @property
    def ours(self):
        return self.source.startswith(("src/", "edgewise/", "frontend/"))


class Cost(NamedTuple):
    """The times of a method on a scene."""
    row: Row
    items: int  # covered pixels, or faces

    @property
    def ns(self):
        """Median, per item."""
        return 1e6 * self.row.median_ms / self.items


class Cracks(NamedTuple):
    """Samples where triangles meet: at edges that two share, drawn by neither, or by both neighbours; and at T-junctions."""
    gaps: int
    double_hits: int
    t_junctions: int

    @property
    def at_shared_edges(self):
        return self.gaps + self.double_hits


class Seen(NamedTuple):
    """Pixels of a picture that show the wrong triangle; those where something shows through; and background one pixel wide between
    triangles of meshes, which the exact picture may have, too."""
    wrong: int
    through: int
    slits: int | None = None  # None in older measurements of peers


class Pooled(NamedTuple):
    """A rate per 10⁶ over several scenes; and over half of its errors are in one, that scene and the rate without it."""
    rate: float
    mostly_on: str | None = None
    without: float | None = None


def pooled(found, scale=1.0):
    """Of [(errors, trials, scene's name)]; `scale` makes their quotient a rate per 10⁶."""
    errors, trials = (sum(one[i] for one in found) for i in (0, 1))
    for most, tried, name in found:
        if 2 * most > errors and trials > tried:
            return Pooled(scale * errors / trials, name, scale * (errors - most) / (trials - tried))
    return Pooled(scale * errors / trials)


@dataclass(frozen=True)
class Measured:
    """One method on one scene."""
    method: Method
    rate: float  # errors per 10⁶
    cracks: Cracks | None = None  # coverage only; None in older measurements of peers
    forms: dict = field(default_factory=dict)  # costs by (SIMD target, threads); empty where the scene is not timed
    seen: Seen | None = None  # coverage only

    @property
    def scalar(self):
        """The cost of the scalar form on one thread, or None."""
        return self.forms.get((SCALAR, 1))

    @property
    def simd(self):
        """The cost of the SIMD form on one thread, or None."""
        return next((cost for (target, threads), cost in self.forms.items() if target != SCALAR and threads == 1), None)


@dataclass(frozen=True)
class Scene:
    name: str
    family: str
    trials: int
    measured: tuple
    apart: tuple = ()  # the measurements of methods that are `apart`; coverage only
    shared_crossings: int = 0  # of edges that triangles share with sample rows or columns; coverage only
    largest_side_px: float = 0.0  # of the triangles' boxes; coverage only
    kind: str = MESHES  # coverage only: or OUR_GRID, or single triangles, or small scenes

    def in_range_of(self, method):
        """Beyond its range a method's integers overflow, which is another fault than the one that is counted."""
        return method.limit_px is None or self.largest_side_px <= method.limit_px

    def of(self, method):
        """The measurement of the method with this name, or None."""
        return next((m for m in (*self.measured, *self.apart) if m.method.name == method), None)


@dataclass(frozen=True)
class Accuracy:
    methods: dict  # by family, in the registry's order
    scenes: tuple
    cube: dict | None  # {"frames", "methods": [(Method, gaps, double hits, wrong samples)]}: of all frames
    flicker: dict = field(default_factory=dict)  # {moving scene: {method's name: superfluous changes per 10⁶ true ones}}

    def of(self, family):
        return [scene for scene in self.scenes if scene.family == family]

    def pooled(self, family):
        """The scenes that count in rates of the whole family: in smaller ones a single trial decides, and vertices on our grid favour
        ours."""
        scenes = [scene for scene in self.of(family) if scene.kind != OUR_GRID]
        return [scene for scene in scenes if scene.trials >= LEAST_SHARE * max(s.trials for s in scenes)]

    def rate(self, family, method):
        """Pooled errors per 10⁶, of the pooled scenes within the method's range; None if it was not measured there."""
        found = [(m.rate * scene.trials, scene.trials, scene.name) for scene in self.pooled(family)
                 if scene.in_range_of(method) and (m := scene.of(method.name))]
        return pooled(found) if any(trials for _, trials, _ in found) else None

    def scenes_with_errors(self, family):
        """{method's name: the number of scenes in which it errs}"""
        return {method.name: sum(m.rate > 0 for scene in self.of(family) for m in scene.measured if m.method == method)
                for method in self.methods[family]}


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
    cracks = Cracks(*(int(entry["cracks"][key]) for key in Cracks._fields)) if "cracks" in entry else None
    seen = Seen(*(int(score[key]) for key in ("wrong_pixels", "wrong_surface_pixels")), score.get("slits")) if cracks else None
    return Measured(method, float(score["errors_per_million"]), cracks, forms, seen)


def parse_cube(data, methods):
    cube = data.get("turning_cube")
    if not cube:
        return None

    found = [(methods["coverage", entry["name"]], {key: int(entry[key]["total"]) for key in ("gaps", "double_hits", "extra", "missing")})
             for entry in cube["methods"]]
    return {"frames": int(cube["frames"]), "methods": [(method, of["gaps"], of["double_hits"], of["extra"] + of["missing"])
                                                       for method, of in found if not method.apart]}


def times_of(bench):
    """{(family, scene, method): {(SIMD target, threads): row}}"""
    found = {}
    for row in bench.sweep("method") if bench else ():
        if row.backend == LABORATORY:
            keys = row.keys
            found.setdefault((keys["family"], row.scene, keys["method"]), {})[keys["simd"], row.threads] = row
    return found


def parse_accuracy(data, bench=None):
    times = times_of(bench)
    methods = {(m["family"], m["name"]): Method(m["name"], m["source"], m.get("max_side_px"), bool(m.get("engine")), bool(m.get("other_bits")))
               for m in data["methods"]}
    scenes = []
    for scene in data["scenes"]:
        family = FAMILIES[scene["family"]]
        triangles = int(scene["triangles"])
        items = triangles if family.name == "facing" else int(scene["covered"])
        measured = [parse_measured(entry, family.name, methods[family.name, entry["name"]],
                                   {form: Cost(row, items) for form, row in
                                    times.get((family.name, scene["name"], entry["name"]), {}).items()
                                    if row.counters["triangles"] == triangles})  # else timed on a scene of another size
                    for entry in scene["methods"]]
        scenes.append(Scene(scene["name"], family.name, int(scene[family.trials]),
                            tuple(m for m in measured if not m.method.apart), tuple(m for m in measured if m.method.apart),
                            int(scene.get("shared_crossings", 0)), float(scene.get("largest_side_px", 0.0)), scene["kind"]))
    by_family = {name: [method for (family, _), method in methods.items() if family == name and not method.apart]
                 for name in FAMILIES}
    flicker = {motion["name"]: {entry["name"]: 1e6 * entry["superfluous"] / motion["changes"] for entry in motion["methods"]}
               for motion in data.get("motions", ())}
    return Accuracy(by_family, tuple(scenes), parse_cube(data, methods), flicker)


def with_peers(data, peers):
    """The methods and measurements of peers added to those of facts, scene by scene."""
    found = {(scene["family"], scene["name"]): scene["methods"] for scene in peers["scenes"]}
    scenes = [{**scene, "methods": [*scene["methods"], *found.get((scene["family"], scene["name"]), ())]} for scene in data["scenes"]]
    return {**data, "methods": [*data["methods"], *peers["methods"]], "scenes": scenes}


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
