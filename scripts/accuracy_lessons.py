"""What accuracy teaches, as sentences for the README and the summary."""
from accuracy_rows import FAMILIES
from tables import number


def listed(names):
    names = [f"`{name}`" for name in names]
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def scenes_with_errors(accuracy, family):
    """In how many scenes each method errs."""
    return {method.name: sum(m.rate > 0 for scene in accuracy.of(family) for m in scene.measured if m.method == method)
            for method in accuracy.methods[family]}


def rates_together(accuracy, family):
    """Errors per 10⁶ of each method, all scenes taken together."""
    rates = {}
    for method in accuracy.methods[family]:
        found = [(m.rate * scene.trials, scene.trials) for scene in accuracy.of(family)
                 for m in scene.measured if m.method == method]
        trials = sum(n for _, n in found)
        if trials:
            rates[method.name] = sum(errors for errors, _ in found) / trials
    return rates


def exact_sentence(accuracy):
    rates = [(m.snapped_rate, m.method.name) for scene in accuracy.of("coverage") for m in scene.measured if m.method.exact]
    names = list(dict.fromkeys(name for _, name in rates))
    scenes = len(accuracy.of("coverage"))
    if not rates:
        return "No exact method was judged."
    wrong = [name for name in names if any(rate > 0 for rate, of in rates if of == name)]
    if wrong:
        return f"**{listed(wrong)} promise exact coverage and err** given the snapped positions."
    return f"Given positions snapped to 1/256 px, {listed(names)} cover no wrong pixel in {scenes} scenes."


def fastest(measured):
    """By the median on one thread; and those that the spread does not tell from it."""
    first = min(measured, key=lambda m: m.costs[1].ns)
    return first, [m for m in measured if m is not first and m.costs[1].overlaps(first.costs[1])]


def leader(measured, unit, role):
    """"`tiled` (1.3 ns, 0 wrong per 10⁶), level with `naive`, is our fastest": a name has a rival if ranges overlap."""
    first, level = fastest(measured)
    text = f"`{first.method.name}` ({first.costs[1].ns:.3g} {unit}, {number(first.rate)} wrong per 10⁶) {role}"
    return first, text + (f", level with {listed(m.method.name for m in level)}" if level else "")


def speed_sentence(scene):
    """Empty where ours or the others were not timed."""
    unit = FAMILIES[scene.family].cost
    ours, others = ([m for m in scene.single if m.method.ours == whose] for whose in (True, False))
    if not ours or not others:
        return ""
    first, text = leader(ours, unit, "is our fastest")
    rival, rival_text = leader(others, unit, "the fastest of the others")
    text = f"On `{scene.name}` and one thread, against the positions before snapping: {text}; {rival_text}; "
    if first.costs[1].overlaps(rival.costs[1]):
        text += "which of the two is faster is not settled"
    else:
        quick, slow = sorted((first, rival), key=lambda m: m.costs[1].ns)
        text += f"`{quick.method.name}` takes {quick.costs[1].ns / slow.costs[1].ns:.2f} times as long as `{slow.method.name}`"
    right = [m for m in others if m.rate <= first.rate]
    if right and rival not in right:
        text += f". Of the others that err no more than `{first.method.name}`, {leader(right, unit, 'is the fastest')[1]}"
    return text + "."


def family_sentence(accuracy, family):
    """Who errs least, and who most: by how much, and in how many scenes."""
    rates, erring = rates_together(accuracy, family.name), scenes_with_errors(accuracy, family.name)
    if not rates:
        return ""

    def said(rate, how):
        names = [name for name in rates if rates[name] == rate]
        counts = sorted({erring[name] for name in names})
        scenes = " to ".join(map(str, counts[:1] + counts[-1:] if len(counts) > 1 else counts))
        return f"{listed(names)} err{'' if len(names) > 1 else 's'} {how}, {number(rate)} (in {scenes})"

    least, most = (said(pick(rates.values()), how) for pick, how in ((min, "least"), (max, "most")))
    return (f"{family.name.capitalize()} ({family.errors}, {len(accuracy.of(family.name))} scenes taken together): "
            f"{least}; {most}.")


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
    speeds = [speed_sentence(scene) for _, scene in accuracy.main_charts("coverage")]
    found = [exact_sentence(accuracy), *(speeds if any(speeds) else ["Speed was not measured."]),
             *(family_sentence(accuracy, family) for family in FAMILIES.values()), cube_sentence(accuracy)]
    return [sentence for sentence in found if sentence]
