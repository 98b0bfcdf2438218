"""What scenes need, and what the tutorials' engines have: needs.json, what `edgewise needs --json` prints."""
from bench_rows import BadInput, read_json

PLANES = ("near plane", "far plane", "guard band")
FACING, VISIBILITY, DEPTH, FLOATS = "facing test", "visibility", "depth buffer", "float edges without a crack"
NO_CRACK, AS_TRUE = "subpixel bits without a crack", "subpixel bits, no worse than 8 bits"
EDGE_VALUES = "edge values"
STAGES = {"facing test": FACING, "visibility": VISIBILITY, "depth": DEPTH, "no crack": NO_CRACK, "no worse than 8 bits": AS_TRUE,
          "edge values": EDGE_VALUES}

# The tutorials' engines by stage: the question, and their answer.
TUTORIALS = (("Pico-8 software renderer", FLOATS, "float_le"), ("Pico-8 software renderer", VISIBILITY, "submission_order"),
             ("p5.js engine", "near plane", "clip"), ("p5.js engine", VISIBILITY, "painter_mean"),
             ("REALbasic engine", FACING, "normal_dot_eye"), ("Outlaw Triad trainer", FACING, "normal_z"),
             ("Outlaw Triad trainer", "near plane", "nothing"))
TUTORIAL_SCENES = ("cube", "cubes")
METHODS = ("submission_order", "painter_", "float_", "reversed_z", "contract31", "normal_", "snapped_area", "double_")


def read_needs(folder):
    """{scene: (entry, {question: its entry})}; empty if not measured."""
    path = folder / "needs.json"
    found = {}
    if path.exists():
        try:
            for entry in read_json(path):
                questions = {question["question"]: question for question in entry["questions"]}
                if not entry["frames"] > 0:
                    raise ValueError(f"scene {entry['scene']}")
                found[entry["scene"]] = (entry, questions)
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise BadInput(f"{path}: not what 'edgewise needs' prints: {type(error).__name__} {error}") from None
    return found


def titled(answer):
    return f"`{answer}`" if answer.startswith(METHODS) else answer


def answer(questions, start):
    """The cheapest answer to the question that begins so; a dash if it was not asked."""
    question = next((q for name, q in questions.items() if name.startswith(start)), None)
    return "–" if question is None else titled(question["answer"] or "none is enough")


def clipping(questions):
    if PLANES[0] not in questions:
        return "–"
    needed = [f"{questions[plane]['answer']} at the {plane}" for plane in PLANES if questions[plane]["answer"] != "nothing"]
    return ", ".join(needed) or "nothing"


def needs_table(found):
    """Header and lines, a line per stage: a line per scene would read as a pipeline, and answers don't combine."""
    stages = {"clipping": clipping, **{title: lambda questions, start=start: answer(questions, start) for title, start in STAGES.items()}}
    lines = []
    for stage, of in stages.items():
        scenes = {}
        for scene, (entry, questions) in found.items():
            frames = f" ({entry['frames']} frames)" if entry["frames"] > 1 else ""
            scenes.setdefault(of(questions), []).append(scene + frames)
        scenes.pop("–", None)
        lines.append([stage, "; ".join(f"{said}: {', '.join(names)}" for said, names in scenes.items())])
    return ["stage", "its cheapest sufficient answer, all other stages exact"], lines


def verdict(question, used):
    """Whether a tutorial's answer is enough, and whether a cheaper one would be."""
    if question is None:
        return "–"
    tried = next((a for a in question["answers"] if a["answer"] == used), None)
    if tried is None:
        raise BadInput(f"needs.json: no answer '{used}' to '{question['question']}'")
    if not tried["enough"]:
        witness = tried["witness"]
        count = witness["wrong_px"]
        return f"**not enough**: {count:,} {question['error']}{'' if count == 1 else 's'} in frame {witness['frame']}"
    return "enough" if question["answer"] == used else f"more than needed: {titled(question['answer'])}"


def tutorials_table(found):
    """Header and lines: what each tutorial's engine could have left out of these scenes, and what it lacks."""
    scenes = [scene for scene in TUTORIAL_SCENES if scene in found]
    header = ["engine", "stage", "its answer, all other stages exact", *(f"`{scene}`" for scene in scenes)]
    lines = [[engine, stage, titled(used), *(verdict(found[scene][1].get(stage), used) for scene in scenes)]
             for engine, stage, used in TUTORIALS]
    return header, lines if scenes else []
