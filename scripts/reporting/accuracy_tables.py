"""The READMEs' tables of methods, and of the points at which they start to fail."""
from accuracy_findings import ours_fail_sentence, rates_together, scenes_with_errors
from accuracy_rows import FAMILIES
from tables import markdown, number, short


def rate_text(measured):
    """A rate in a table, with the bound 3/N if no error was seen."""
    if measured.rate == 0 and measured.bound is not None:
        return f"0 (<{number(measured.bound)})"
    return number(measured.rate)


def mtri_text(measured):
    """On one thread."""
    return number(measured.costs[1].mtri) if measured and 1 in measured.costs else "–"


def bold(method):
    return f"**{method.name}**" if method.ours else method.name


def method_table(accuracy, family):
    scene = next((scene for _, scene in accuracy.main_charts(family)), None)
    header = ["method", "as in", "promise", f"on {scene.name}" if scene else "–", "pooled",
              "scenes with errors"]
    at_main = {m.method.name: m for m in scene.measured} if scene else {}
    together = rates_together(accuracy, family)
    erring, scenes = scenes_with_errors(accuracy, family), len(accuracy.of(family))
    throughput = family == "coverage"  # the scenes of other families do not measure it
    if throughput:
        header.insert(4, "10⁶ triangles/s")
    lines = [[bold(method), method.source, method.promise,
              rate_text(at_main[method.name]) if method.name in at_main else "–",
              *([mtri_text(at_main.get(method.name))] if throughput else []),
              number(together[method.name]) if method.name in together else "–", f"{erring[method.name]} of {scenes}"]
             for method in accuracy.methods[family]]
    return markdown(header, lines, "|---|---|---|--:" + "|--:" * (len(header) - 4) + "|")


def method_tables(accuracy):
    def told(name, family):
        shown = [*rates_together(accuracy, name).values(),
                 *(m.rate for _, scene in accuracy.main_charts(name) for m in scene.measured)]
        return f"**{name.capitalize()}**: {family.errors}" + family.beyond_note(shown)

    return "\n\n".join(f"{told(name, family)}\n\n{method_table(accuracy, name)}"
                       for name, family in FAMILIES.items() if accuracy.methods[name])


def tenfold(curve):
    """The first point with ten times the errors of the sweep's first point."""
    first = curve.points[0][1]
    return next((x for x, y in curve.points if first and y >= 10 * first), None)


def fails_cell(curve):
    """The point at which a method starts to fail, in bold, and its most errors; the latter alone if it holds."""
    most = short(max(y for _, y in curve.points))
    start = curve.starts_to_fail
    if start is None:
        return most
    if start != curve.points[0][0]:
        return f"**{number(start)}**: {most}"
    rises = tenfold(curve)
    return f"**first**{'' if rises is None else f', ×10 at **{number(rises)}**'}: {most}"


def fails_table(sweeps, methods):
    """One family's sweeps side by side, one line per method; methods with equal cells share a line."""
    lines = {}
    for method in methods:
        found = [next((c for c in sweep.curves if c.method == method.name), None) for sweep in sweeps]
        cells = tuple("–" if curve is None else fails_cell(curve) for curve in found)
        lines.setdefault(cells, []).append(bold(method))
    header = ["method", *(f"{sweep.name.replace('_', ' ')}{', ' if sweep.x['unit'] else ''}{sweep.x['unit']}"
                          for sweep in sweeps)]
    return markdown(header, [[", ".join(names), *cells] for cells, names in lines.items()],
                    "|---" + "|--:" * len(sweeps) + "|")


def counted_in(sweeps):
    """The errors counted: "wrong pixels …; in `pan` superfluous changes …"."""
    by_name = {}
    for sweep in sweeps:
        by_name.setdefault(sweep.y["name"].replace("10^6", "10⁶"), []).append(f"`{sweep.name}`")
    (common, _), *rest = sorted(by_name.items(), key=lambda item: -len(item[1]))
    return "; ".join([common, *(f"in {' and '.join(names)} {what}" for what, names in rest)])


def fails_tables(sweeps, accuracy):
    own = ours_fail_sentence(sweeps, accuracy)
    text = [own] if own else []
    for family in FAMILIES:
        of = [sweep for sweep in sweeps if sweep.family == family and sweep.curves]
        most = [y for sweep in of for curve in sweep.curves for _, y in curve.points]
        if of:
            text.append(f"**{family.capitalize()}**: {counted_in(of)}{FAMILIES[family].beyond_note(most)}\n\n"
                        + fails_table(of, accuracy.methods[family]))
    return "\n\n".join(text)
