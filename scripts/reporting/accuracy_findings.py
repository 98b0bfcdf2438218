"""Findings about accuracy, as sentences for the READMEs and the summary."""
from accuracy_rows import FAMILIES
from speedups import about, kernels
from stability_curves import tidy
from tables import enumerated, number, percent, short


def listed(names):
    return enumerated([f"`{name}`" for name in names])


def scenes_with_errors(accuracy, family):
    """The number of scenes in which each method errs."""
    return {method.name: sum(m.rate > 0 for scene in accuracy.of(family) for m in scene.measured if m.method == method)
            for method in accuracy.methods[family]}


def rates_together(accuracy, family):
    """Errors per 10⁶ of each method, its pooled scenes together."""
    rates = {}
    for method in accuracy.methods.get(family, ()):
        found = [(m.rate * scene.trials, scene.trials) for scene in accuracy.pooled(family)
                 for m in scene.measured if m.method == method and scene.in_range_of(method)]
        trials = sum(n for _, n in found)
        if trials:
            rates[method.name] = sum(errors for errors, _ in found) / trials
    return rates


def pooled_clause(accuracy, family):
    """"13 scenes pooled, 14M edge crossings, 23 % of them in `grid4`"."""
    scenes = accuracy.pooled(family)
    trials, largest = sum(scene.trials for scene in scenes), max(scenes, key=lambda scene: scene.trials)
    share = f", {percent(largest.trials / trials)} of them in `{largest.name}`" if len(scenes) > 1 else ""
    return f"{numbered(len(scenes), 'scene')} pooled, {short(trials)} {FAMILIES[family].counted}{share}"


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


def numbered(count, noun):
    return f"{count:,.0f} {noun}{'' if count == 1 else 's'}"


def before_snapping_clause(accuracy, name):
    """Says that a method errs less than ours against positions before snapping; empty otherwise."""
    rates = rates_together(accuracy, "coverage")
    ours = [rates[m.name] for m in accuracy.methods.get("coverage", ()) if m.ours and m.name in rates]
    if not ours or name not in rates or rates[name] >= min(ours):
        return ""
    return (f"Against the positions before snapping, `{name}` errs less than ours: {number(rates[name])} wrong pixels per 10⁶ "
            f"edge crossings against {number(min(ours))} ({pooled_clause(accuracy, 'coverage')}). Ours round vertices to 1/256 px.")


def fastest(measured):
    """The fastest by the median on one thread, and the methods too close to it to call."""
    first = min(measured, key=lambda m: m.costs[1].ns)
    return first, [m for m in measured if m is not first and m.costs[1].order(first.costs[1]) == 0]


def form(m, machine):
    """The form whose cost is shown: "with AVX-512" or "in scalar code". Results without forms timed ours alone with SIMD."""
    simd = m.simd is not None if m.forms else m.method.ours
    return f"with {kernels(machine.get('simd_best'))}" if simd else "in scalar code"


def compared(ours, other, machine):
    """"`tiled` with AVX-512 is 1.6× faster than `fixed_8` with AVX-512", marked if not settled."""
    ours_ns, other_ns = ours.costs[1].ns, other.costs[1].ns
    ratio, word = (other_ns / ours_ns, "faster") if ours_ns <= other_ns else (ours_ns / other_ns, "slower")
    open_question = "" if ours.costs[1].order(other.costs[1]) else " (not settled)"
    return (f"`{ours.method.name}` {form(ours, machine)} is {about(ratio)} {word} than `{other.method.name}` "
            f"{form(other, machine)}{open_question}")


def sides(scene):
    """The measurements of ours and of the others on one thread; None if either is missing."""
    ours, others = ([m for m in scene.single if m.method.ours == whose] for whose in (True, False))
    return (ours, others) if ours and others else None


def leader(measured, unit, role):
    """"`tiled` (1.3 ns, 0 wrong per 10⁶) is our fastest; `naive` is too close to call"."""
    first, close = fastest(measured)
    text = f"`{first.method.name}` ({first.costs[1].ns:.2g} {unit}, {number(first.rate)} wrong per 10⁶) is {role}"
    names = listed(m.method.name for m in close) if len(close) < 4 else f"{len(close)} others"
    return first, text + (f" ({names} too close to call)" if close else "")


def speed_sentence(scene, machine):
    """Empty if ours or the others were not timed."""
    if not (found := sides(scene)):
        return ""
    ours, others = found
    unit = FAMILIES[scene.family].cost
    first, text = leader(ours, unit, "our fastest")
    other, other_text = leader(others, unit, "the fastest other method")
    text = (f"On `{scene.name}` and one thread, against the positions before snapping: {text}; {other_text}. "
            f"{compared(first, other, machine)}.")
    right = [m for m in others if m.rate <= first.rate]
    if right and other not in right:
        text += f" {leader(right, unit, f'the fastest other method that errs no more than `{first.method.name}`')[1]}."
    return text


def family_sentence(accuracy, family):
    """The methods with the fewest and with the most errors, with rates and numbers of scenes."""
    rates, erring = rates_together(accuracy, family.name), scenes_with_errors(accuracy, family.name)
    if not rates:
        return ""

    def said(rate, how):
        names = [name for name in rates if rates[name] == rate]
        counts = sorted({erring[name] for name in names})
        scenes = " to ".join(map(str, counts[:1] + counts[-1:] if len(counts) > 1 else counts))
        return f"{listed(names)} err{'' if len(names) > 1 else 's'} {how}, {number(rate)} (in {scenes} of {total})"

    total = len(accuracy.of(family.name))
    truth = {"float": ", against the positions before snapping", "snapped": ", given the snapped positions"}
    least, most = (said(pick(rates.values()), how) for pick, how in ((min, "least"), (max, "most")))
    return (f"{family.name.capitalize()} ({family.errors}; {pooled_clause(accuracy, family.name)}{truth.get(family.truths[0], '')}): "
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
            f"{listed(clean) or 'no method'} left no gap and hit no pixel twice. Against the positions before snapping, "
            f"`{name}` is the worst, with up to {gaps:,.0f} gaps and up to {doubles:,.0f} double hits per frame.")


OUR_DEPTH, PLAIN_DEPTHS = "contract31", ("unorm24", "float_z")


def depth_sentence(accuracy, sweeps):
    """Whether our depth errs more than a plain depth buffer in any scene or at any point of a sweep; empty if not judged."""
    scenes = [(scene.name, {m.method.name: m.rate for m in scene.measured}) for scene in accuracy.of("visibility")]
    points = [(f"{sweep.name} at {tidy(x)}", {curve.method: curve.points[i][1] for curve in sweep.curves})
              for sweep in sweeps if sweep.family == "visibility"
              for i, (x, _) in enumerate(sweep.curves[0].points if sweep.curves else ())]
    judged = [(where, rates) for where, rates in scenes + points if rates.keys() >= {OUR_DEPTH, *PLAIN_DEPTHS}]
    if not judged:
        return ""
    worse = [(rates[OUR_DEPTH] - rates[plain], where, rates, plain) for where, rates in judged for plain in PLAIN_DEPTHS
             if rates[OUR_DEPTH] > rates[plain]]
    said = f"In {len(scenes)} scenes and at {len(points)} points of the sweeps, our 31-bit depth (`{OUR_DEPTH}`)"
    if not worse:
        return f"{said} shows the wrong triangle at most as often as depth buffers of {listed(PLAIN_DEPTHS)}."
    _, where, rates, plain = max(worse, key=lambda found: found[0])
    return (f"{said} shows the wrong triangle more often than {listed(PLAIN_DEPTHS)} in {len({w[1] for w in worse})} of "
            f"{len(judged)}, most in {where}: {number(rates[OUR_DEPTH])} wrong pixels per 10⁶ against {number(rates[plain])} "
            f"(`{plain}`).")


def origin_sentence(sweeps):
    """From which distance to the origin on a matrix of floats draws wrong pixels, and ours; empty if not measured."""
    curves = {curve.method: curve for sweep in sweeps if sweep.name == "origin" for curve in sweep.curves}
    if not curves.keys() >= {"matrix_float", "near_guard"}:
        return ""

    def start(method):
        found = curves[method].starts_to_fail
        return f"first at a distance of {tidy(found)}" if found else f"at no distance up to {tidy(curves[method].points[-1][0])}"
    mostly = None
    for x, wrong in reversed(curves["matrix_float"].points):
        if wrong < 5e5:
            break
        mostly = x
    half = f", and most pixels wrong from {tidy(mostly)} on" if mostly else ""
    return (f"With camera and scene far from the origin, one 4×4 matrix of floats (`matrix_float`) draws wrong pixels "
            f"{start('matrix_float')}{half}; ours (`near_guard`) {start('near_guard')}.")


def most_errors(sweep, curve):
    worst = max(y for _, y in curve.points)
    return number(worst) + (" %" if sweep.y["name"].endswith("%") else "")


def ours_fail_sentence(sweeps, accuracy):
    """The sweeps in which ours err exactly as rounding to 1/256 px does, and those in which they err more."""
    names = {(family, m.name) for family, methods in accuracy.methods.items() for m in methods if m.ours}
    own = [(sweep, [curve for curve in sweep.curves if (sweep.family, curve.method) in names]) for sweep in sweeps]
    own = [(sweep, curves) for sweep, curves in own if curves]
    if not own:
        return ""
    alike = [(sweep, curves[0]) for sweep, curves in own
             if all(tuple(y for _, y in curve.points) == sweep.by_snapping for curve in curves)]
    rounding = [f"up to {most_errors(sweep, curve)} in `{sweep.name}` ({what(sweep)})" for sweep, curve in alike
                if max(sweep.by_snapping) > 0]
    more = [f"`{sweep.name}` ({sweep.summary}): `{curve.method}` from {tidy(curve.starts_to_fail)}, up to "
            f"{most_errors(sweep, curve)} {what(sweep)}"
            for sweep, curves in own for curve in curves if curve.starts_to_fail is not None]
    text = (f"In {len(alike)} of {len(own)} sweeps ours err exactly as much as rounding to 1/256 px does by itself: "
            + ("; ".join([*rounding, "0 in the others"]) if rounding else "0 in all") + ".")
    return text + (f" They err more in {'; '.join(more)}." if more else "")


def what(sweep):
    """The name of the errors that a sweep counts."""
    return sweep.y["name"].replace("10^6", "10⁶").removesuffix(", %")


def accuracy_sentences(accuracy):
    speeds = [speed_sentence(scene, accuracy.machine) for _, scene in accuracy.main_charts("coverage")]
    found = [exact_sentence(accuracy), before_snapping_clause(accuracy, "float_lt"),
             *(speeds if any(speeds) else ["Speed was not measured."]),
             *(family_sentence(accuracy, family) for family in FAMILIES.values()), cube_sentence(accuracy)]
    return [sentence for sentence in found if sentence]
