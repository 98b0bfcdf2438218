"""The tables of facts: what a viewer sees of methods, pixels that are not portable, and what scenes need."""
from accuracy_rows import MESHES, OUR_GRID, SINGLE
from bench_rows import facts_of
from program import BadInput, parsed
from tables import gain, number


def pooled_text(rate):
    """A pooled rate; and if over half of its errors are in one scene, the rate without it."""
    return number(rate.rate) + (f"; {number(rate.without)} without {rate.mostly_on}" if rate.mostly_on else "")


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
# Questions about edges and float depths, all else exact: the title of their line, and how the question begins.
EDGES = {"no crack or fold": "subpixel bits: no crack, no fold", "no worse than 8 bits": "subpixel bits, no worse than 8 bits",
         "float depth": "float depth buffer", "edge values": "edge values"}

# The tutorials' engines by stage: the question, and their answer.
TUTORIALS = (("Pico-8 software renderer", VISIBILITY, "submission_order"),
             ("p5.js engine", "near plane", "clip"), ("p5.js engine", VISIBILITY, "painter_mean"),
             ("REALbasic engine", FACING, "normal_dot_eye"), ("Outlaw Triad trainer", FACING, "normal_z"),
             ("Outlaw Triad trainer", "near plane", "nothing"))
TUTORIAL_SCENES = ("cube", "cubes")
METHODS = ("submission_order", "painter_", "float_", "reversed_z", "contract31", "normal_", "snapped_area", "double_")


def parse_needs(data):
    """{scene: (entry, {question: its entry}, {stage of the least precise pipeline: its level})}"""
    found = {}
    for entry in data:
        questions = {question["question"]: question for question in entry["alone"] + entry["edges"]}
        if not entry["frames"] > 0:
            raise ValueError(f"scene {entry['scene']}")
        found[entry["scene"]] = (entry, questions, {stage["question"]: stage["answer"] for stage in entry["pipeline"]["stages"]})
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


def others(entry, levels):
    """What other orders of weakening lead to, as far as it differs."""
    def differing(other):
        parts = [f"{other[plane]} at the {plane}" for plane in PLANES if other.get(plane) != levels.get(plane)]
        parts += [titled(other[stage]) for stage in (FACING, VISIBILITY)
                  if other.get(stage) != levels.get(stage) and not (stage == VISIBILITY and DEPTH in other)]
        parts += [f"{DEPTH} of {other[DEPTH]}"] if other.get(DEPTH) != levels.get(DEPTH) and DEPTH in other else []
        return ", ".join(parts + ([f"{other[BITS]} of positions"] if other[BITS] != levels[BITS] else []))

    return "; ".join(map(differing, entry["pipeline"]["others"])) or "–"


def over_exact(bench, scene):
    rows = [bench.find(f"needs/{scene}/pipeline:{which}/threads:1") for which in ("exact", "least")]
    return gain(*rows) if all(rows) else "–"


def none_enough(entry):
    """What the exact pipeline draws wrong; "" if it draws every frame right."""
    first = entry["pipeline"]["stages"][0]
    if first["answer"] is not None:
        return ""
    witness = first["answers"][-1]["witness"]
    return f"none is enough: the exact one draws {witness['wrong_px']:,} wrong px in frame {witness['frame']}"


def pipelines_table(found, bench):
    """Header and lines, a line per scene: its pipeline was drawn and timed as a whole."""
    return (["scene", "clipping", FACING, VISIBILITY, "depth", f"{BITS}, at most 8", "speed-up over exact", "or, weakened in another order"],
            [[named(scene, entry), clipping(levels),
              *(titled(levels[stage]) if stage in levels else "–" for stage in (FACING, VISIBILITY, DEPTH)),
              levels.get(BITS, "–").split()[0], over_exact(bench, scene), none_enough(entry) or others(entry, levels)] for scene, (entry, _, levels) in found.items()])


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
    return ["edges and float depths", "the least precise that is enough, all else exact"], lines


def verdict(question, used):
    """Whether a tutorial's answer is enough, and whether a less precise one would be."""
    if question is None:
        return "–"
    tried = next((a for a in question["answers"] if a["answer"] == used), None)
    if tried is None:
        raise BadInput(f"needs.json: no answer '{used}' to '{question['question']}'")
    if not tried["enough"]:
        count, frame = (tried["witness"][key] for key in ("wrong_px", "frame"))
        said = f"{count:,} {question['error']}{'' if count == 1 else 's'} in frame {frame}"
        as_exact = tried["witness"] == question["answers"][-1].get("witness")
        return f"as wrong as the exact one: {said}" if as_exact else f"**not enough**: {said}"
    names = [a["answer"] for a in question["answers"]]
    more = question["answer"] is not None and names.index(question["answer"]) < names.index(used)
    return f"more than needed: {titled(question['answer'])}" if more else "enough"


def tutorials_table(found):
    """Header and lines: what each tutorial's engine could have left out of these scenes, and what it lacks."""
    scenes = [scene for scene in TUTORIAL_SCENES if scene in found]
    header = ["engine", "stage", "its answer, all other stages exact", *(f"`{scene}`" for scene in scenes)]
    lines = [[engine, stage, titled(used), *(verdict(found[scene][1].get(stage), used) for scene in scenes)]
             for engine, stage, used in TUTORIALS]
    return header, lines if scenes else []
