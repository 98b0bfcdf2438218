"""What accuracy and stability say, as sentences and tables for the README and the summary."""
from accuracy_rows import FAMILIES
from tables import markdown


def number(value):
    return f"{float(f'{value:.3g}'):,.10g}"


def rate_text(measured):
    """As it stands in a table: where no error was seen, with the bound 3/N."""
    if measured.rate == 0 and measured.bound is not None:
        return f"0 (<{number(measured.bound)})"
    return number(measured.rate)


def main_scene(accuracy, family):
    """The one that speed was measured on, and that the family's chart shows."""
    return next((scene for scene in accuracy.of(family) if scene.timed), None)


def single(measured):
    """ns on one thread, of those that were timed."""
    return {m.method.name: (m.costs_ns[1], m) for m in measured if 1 in m.costs_ns}


def listed(names):
    names = [f"`{name}`" for name in names]
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def exact_sentence(accuracy):
    rates = [(m.snapped_rate, m.method.name) for scene in accuracy.of("coverage") for m in scene.measured if m.method.exact]
    names = list(dict.fromkeys(name for _, name in rates))
    scenes = len(accuracy.of("coverage"))
    if not rates:
        return "No exact method was judged."
    wrong = [name for name in names if any(rate > 0 for rate, of in rates if of == name)]
    if wrong:
        return f"**{listed(wrong)} promise exact coverage and err** given the snapped positions."
    return f"Given positions snapped to 1/256 px, {listed(names)} draw no wrong pixel in {scenes} scenes."


def speed_sentence(accuracy):
    scene = main_scene(accuracy, "coverage")
    if scene is None:
        return "Speed was not measured."
    costs = single(scene.measured)
    ours = min((costs[name] for name in costs if costs[name][1].method.ours), key=lambda c: c[0], default=None)
    others = [cost for cost in costs.values() if not cost[1].method.ours]
    if ours is None or not others:
        return "Speed was not measured."
    fastest = min(others, key=lambda c: c[0])
    right = min((c for c in others if c[1].rate <= ours[1].rate), key=lambda c: c[0], default=None)

    def said(cost):
        return f"`{cost[1].method.name}` ({cost[0]:.3g} ns per covered pixel, {number(cost[1].rate)} wrong per 10⁶)"

    text = (f"Against the positions before snapping, on {scene.name} and one thread: {said(ours)} is our fastest, "
            f"{said(fastest)} the fastest of the others")
    if right is None:
        return text + "."
    return text + (", and errs no more." if right is fastest else f", {said(right)} of those that err no more than ours.")


def scenes_with_errors(accuracy, family):
    """In how many scenes each method errs."""
    return {method.name: sum(m.rate > 0 for scene in accuracy.of(family) for m in scene.measured if m.method == method)
            for method in accuracy.methods[family]}


def family_sentence(accuracy, family):
    counts = scenes_with_errors(accuracy, family)
    scenes = len(accuracy.of(family))
    if not scenes or not counts:
        return ""

    def said(count, verb):
        names = [name for name in counts if counts[name] == count]
        return f"{listed(names)} {verb if len(names) > 1 else verb + 's'} in {count}"

    least, most = min(counts.values()), max(counts.values())
    return f"{family.capitalize()}: of {scenes} scenes, {said(least, 'err')}, {said(most, 'err')}."


def cube_sentence(accuracy):
    if not accuracy.cube:
        return ""
    def worst(found):
        return [found[key][1] for key in ("gaps", "double_hits")]

    rows = [(method.name, found) for method, found in accuracy.cube["methods"]]
    clean = [name for name, found in rows if worst(found["snapped"]) == [0, 0]]
    name, found = max(rows, key=lambda row: sum(worst(row[1])))
    gaps, doubles = worst(found)
    return (f"In {accuracy.cube['frames']:,} frames of the turning cube, given the snapped positions, "
            f"{listed(clean) or 'no method'} left no gap and hit no pixel twice. Against the positions before snapping "
            f"`{name}` is the worst, with up to {gaps:,.0f} gaps and up to {doubles:,.0f} double hits in a frame.")


def accuracy_sentences(accuracy):
    found = [exact_sentence(accuracy), speed_sentence(accuracy),
             *(family_sentence(accuracy, family) for family in FAMILIES if family != "coverage"), cube_sentence(accuracy)]
    return [sentence for sentence in found if sentence]


def method_table(accuracy, family):
    scene = main_scene(accuracy, family)
    header = ["method", "as in", "promise", f"on {scene.name}" if scene else "–", "scenes with errors"]
    at_main = {m.method.name: m for m in scene.measured} if scene else {}
    erring, scenes = scenes_with_errors(accuracy, family), len(accuracy.of(family))
    lines = [[f"**{method.name}**" if method.ours else method.name, method.source, method.promise,
              rate_text(at_main[method.name]) if method.name in at_main else "–", f"{erring[method.name]} of {scenes}"]
             for method in accuracy.methods[family]]
    return markdown(header, lines, "|---|---|---|--:|--:|")


def method_tables(accuracy):
    return "\n\n".join(f"**{name.capitalize()}**: {family.errors}\n\n{method_table(accuracy, name)}"
                       for name, family in FAMILIES.items() if accuracy.methods[name])


def fails_table(sweeps):
    """One line a sweep: who errs more than snapping does by itself, and from where."""
    lines = []
    for sweep in sweeps:
        places = {x: i for i, (x, _) in enumerate(sweep.curves[0].points)} if sweep.curves else {}
        failing = sorted((c for c in sweep.curves if c.starts_to_fail is not None),
                         key=lambda c: places.get(c.starts_to_fail, 0))
        never = [c.method for c in sweep.curves if c.starts_to_fail is None]
        by_place = {}
        for curve in failing:
            by_place.setdefault(curve.starts_to_fail, []).append(curve.method)
        unit = f" {sweep.x['unit']}" if sweep.x["unit"] else ""
        lines.append([sweep.name, sweep.x["name"],
                      "; ".join(f"**{number(x)}{unit if places.get(x) else f'{unit}, the first place,'}** {', '.join(names)}"
                                for x, names in by_place.items()) or "–",
                      ", ".join(never) or "–"])
    return markdown(["sweep", "along", "fails from", "errs no more than snapping does"], lines, "|---|---|---|---|")
