"""The tables of facts: what a viewer sees of methods, pixels that are not portable, and what scenes need."""
from accuracy_rows import MESHES, OUR_GRID, SINGLE
from bench_rows import facts_of
from program import BadInput, parsed
from tables import gain, milliseconds, number


def seen_table(accuracy):
    """Header and lines: the pixels of each coverage method that a viewer sees to be wrong, still and in motion; meshes, single triangles
    and scenes on our grid apart. Methods of the same figures share a line."""
    lines = {}
    for method in accuracy.methods["coverage"]:
        seen = [(scene, m.seen) for scene in accuracy.of("coverage") for m in scene.measured
                if m.method == method and m.seen and scene.in_range_of(method)]

        def total(kind, what):
            counts = [(getattr(counts, what), scene.name) for scene, counts in seen if scene.kind == kind]
            return total_text(counts) if counts else "–"

        if seen:
            figures = (total(MESHES, "wrong"), total(MESHES, "through"), total(MESHES, "slits"), total(SINGLE, "wrong"), total(OUR_GRID, "wrong"),
                       *(number(rates[method.name]) if method.name in rates else "–" for rates in accuracy.flicker.values()))
            lines.setdefault(figures, []).append(f"`{method.name}`")
    return (["method", "wrong pixels of meshes", "showing through", "slits", "wrong pixels of single triangles", "wrong pixels on our grid",
             *(f"flicker, `{name}`" for name in accuracy.flicker)],
            [[", ".join(names), *figures] for figures, names in lines.items()])


def method_times(accuracy):
    """Header and lines: the milliseconds of each coverage method on one thread, in scalar code and with SIMD, without the front end."""
    scenes = [scene for scene in accuracy.of("coverage") if any(m.scalar for m in scene.measured)]

    def cell(measured):
        return " / ".join(milliseconds(row) for row in (measured.scalar, measured.simd)) if measured else "–"

    timed = [method for method in accuracy.methods["coverage"] if any((m := scene.of(method.name)) and m.forms for scene in scenes)]
    return ["method", *(f"`{scene.name}`" for scene in scenes)], [[f"`{method.name}`", *(cell(scene.of(method.name)) for scene in scenes)] for method in timed]


def total_text(counts):
    """The sum of [(count, scene's name)]; and if over half of it is in one scene, the rest."""
    total = sum(count for count, _ in counts)
    most, scene = max(counts)
    return f"{total:,}" + (f"; {total - most:,} without {scene}" if 2 * most > total and len(counts) > 1 else "")


# Pixels that conformant rasterizers may draw differently.
SHOWN_BITS = (8, 6, 4)


def parse_portable(data):
    """{subpixel bits: {scene: entry}}"""
    found = {}
    for entry in data:
        if not 0 <= entry["unstable"] <= entry["pixels"]:
            raise ValueError(f"scene {entry['scene']}")
        found.setdefault(int(entry["subpixel_bits"]), {})[entry["scene"]] = entry
    if len({frozenset(scenes) for scenes in found.values()}) > 1:
        raise ValueError("not the same scenes for all subpixel bits")
    return found


def read_portable(folder):
    """Empty if not measured."""
    path = facts_of(folder) / "portable.json"
    return parsed(path, parse_portable, "edgewise portable") if path.exists() else {}


def portable_table(found):
    """Header and lines, a line per scene."""
    shown = [found[bits] for bits in SHOWN_BITS if bits in found]
    return (["scene", *(f"{bits} bits, %" for bits in SHOWN_BITS if bits in found)],
            [[scene, *(number(100 * of[scene]["unstable"] / of[scene]["pixels"], 2) for of in shown)] for scene in (shown[0] if shown else ())])


# What scenes need, and what the tutorials' engines have.
PLANES = ("near plane", "far plane", "guard band")
FACING, VISIBILITY, DEPTH, BITS = "facing test", "visibility", "depth buffer", "subpixel bits"
# Questions about edges, all else exact: the title of their line, and how the question begins.
EDGES = {"no crack or fold": "subpixel bits: no crack, no fold", "no worse than 8 bits": "subpixel bits, no worse than 8 bits",
         "edge values": "edge values"}
# Depth formats, as levels.
FORMATS = {"D16": "16 bits", "D24": "24 bits", "D32F": "float_z", "reversed D32F": "reversed_z", "ours": "contract31"}

# The tutorials' engines by stage: the question, and their answer.
TUTORIALS = (("Pico-8 software renderer", VISIBILITY, "submission_order"),
             ("p5.js engine", "near plane", "clip"), ("p5.js engine", VISIBILITY, "painter_mean"),
             ("REALbasic engine", FACING, "normal_dot_eye"), ("Outlaw Triad trainer", FACING, "normal_z"),
             ("Outlaw Triad trainer", "near plane", "nothing"))
TUTORIAL_SCENES = ("cube", "cubes")
METHODS = ("submission_order", "painter_", "float_", "reversed_z", "contract31", "normal_", "snapped_area", "double_")


def parse_needs(data):
    """{scene: (entry, {question about edges: its entry}, {stage: {level: its entry}})}"""
    found = {}
    for entry in data:
        if not entry["frames"] > 0 or not (entry["minima"] or entry["closest"]):
            raise ValueError(f"scene {entry['scene']}")
        found[entry["scene"]] = (entry, {question["question"]: question for question in entry["edges"]},
                                 {curve["stage"]: {level["level"]: level for level in curve["levels"]} for curve in entry["curves"]})
    return found


def read_needs(folder):
    """Empty if not measured."""
    path = facts_of(folder) / "needs.json"
    return parsed(path, parse_needs, "edgewise needs") if path.exists() else {}


def titled(answer):
    return f"`{answer}`" if answer.startswith(METHODS) else answer


def named(scene, entry):
    return scene + (f" ({entry['frames']} frames)" if entry["frames"] > 1 else "")


def clipping(levels):
    needed = [f"{levels[plane]} at the {plane}" for plane in PLANES if levels.get(plane, "nothing") != "nothing"]
    return ", ".join(needed) or ("nothing" if PLANES[0] in levels else "–")


def over_exact(bench, scene, number):
    rows = [bench.find(f"needs/{scene}/pipeline:{which}/threads:1") for which in ("exact", number)]
    return gain(*rows) if all(rows) else "–"


def pipelines_table(found, bench):
    """Header and lines: of each scene its least precise pipelines, which were drawn and timed as a whole, the fastest first. Pipelines that
    differ in the facing test alone share a line, with the speed-up of the fastest."""
    lines = []
    for scene, (entry, _, _) in found.items():
        timed = [(bench.find(f"needs/{scene}/pipeline:{i}/threads:1"), i, levels) for i, levels in enumerate(entry["minima"], 1)]
        timed.sort(key=lambda row: (row[0] is None, row[0].median_ms if row[0] else 0))
        rows = [(levels, over_exact(bench, scene, i)) for _, i, levels in timed]
        if not rows:
            closest = entry["closest"]
            rows = [(closest["levels"], f"not right: {closest['worst_px']:,} wrong px in a frame")]
        merged = {}
        for levels, said in rows:
            key = clipping(levels), titled(levels.get(VISIBILITY, "–")), titled(levels.get(DEPTH, "–")), levels[BITS].split()[0]
            merged.setdefault(key, ([], said))[0].append(titled(levels.get(FACING, "–")))
        lines += [[named(scene, entry), clipped, " or ".join(tests), *rest, said] for (clipped, *rest), (tests, said) in merged.items()]
    return ["scene", "clipping", FACING, VISIBILITY, "depth", BITS, "speed-up over exact"], lines


def depth_table(found):
    """Header and lines: the formats that are enough for the near and far plane of scenes, all else exact. Scenes of the same answers share
    a line."""
    def cell(level):
        return "enough" if level["enough"] else f"{level['worst_px']:,} wrong px"

    lines = {}
    for scene, (entry, _, curves) in found.items():
        figures = (*(f"{entry[key]:.4g}" if key in entry else "–" for key in ("near_z", "far_z")),
                   *(cell(curves[DEPTH][level]) for level in FORMATS.values()))
        lines.setdefault(figures, []).append(named(scene, entry))
    return ["scene", "near", "far", *FORMATS], [[", ".join(names), *figures] for figures, names in lines.items()]


def edges_table(found):
    """Header and lines, a line per question."""
    lines = []
    for title, start in EDGES.items():
        scenes = {}
        for scene, (entry, questions, _) in found.items():
            question = next((q for name, q in questions.items() if name.startswith(start)), None)
            if question is not None:
                scenes.setdefault(titled(question["answer"] or "none is enough"), []).append(named(scene, entry))
        lines.append([title, "; ".join(f"{said}: {', '.join(names)}" for said, names in scenes.items())])
    return ["edges", "the least precise that is enough, all else exact"], lines


def verdict(curve, stage, used):
    """Whether a tutorial's level is enough, and whether a weaker one would be."""
    if curve is None:
        return "–"
    if used not in curve:
        raise BadInput(f"needs.json: no level '{used}' of '{stage}'")
    worst = curve[used]["worst_px"]
    if not curve[used]["enough"]:
        said = f"{worst:,} wrong pixel{'' if worst == 1 else 's'} in a frame"
        return f"as wrong as the exact one: {said}" if worst == [*curve.values()][-1]["worst_px"] else f"**not enough**: {said}"
    before = [*curve][:1 if stage == FACING else [*curve].index(used)]  # of facing tests, only the lack of one is weaker
    weaker = next((level for level in before if level != used and curve[level]["enough"]), None)
    return f"more than needed: {titled(weaker)}" if weaker else "enough"


def tutorials_table(found):
    """Header and lines: what each tutorial's engine could have left out of these scenes, and what it lacks."""
    scenes = [scene for scene in TUTORIAL_SCENES if scene in found]
    header = ["engine", "stage", "its answer, all other stages exact", *(f"`{scene}`" for scene in scenes)]
    lines = [[engine, stage, titled(used), *(verdict(found[scene][2].get(stage), stage, used) for scene in scenes)]
             for engine, stage, used in TUTORIALS]
    return header, lines if scenes else []
