"""The READMEs' tables of methods, and of the points at which they start to fail."""
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
    scene = next((scene for _, scene in accuracy.timed_charts(family)), None)
    header = ["method", "as in", "promise", f"on {scene.name}" if scene else "–", "pooled",
              "scenes with errors"]
    at_main = {m.method.name: m for m in scene.measured} if scene else {}
    together, erring, scenes = accuracy.rates(family), accuracy.scenes_with_errors(family), len(accuracy.of(family))
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
    return "\n\n".join(f"**{name.capitalize()}**: {family.errors}\n\n{method_table(accuracy, name)}"
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
    common = common_errors(sweeps)

    def title(sweep):
        words = ", ".join(filter(None, (sweep.name.replace("_", " "), sweep.x["unit"])))
        return words if errors_of(sweep) == common else f"{words} ({errors_of(sweep)})"

    return markdown(["method", *map(title, sweeps)], [[", ".join(names), *cells] for cells, names in lines.items()],
                    "|---" + "|--:" * len(sweeps) + "|")


def errors_of(sweep):
    return sweep.y["name"].replace("10^6", "10⁶")


def common_errors(sweeps):
    """What most of a family's sweeps count."""
    counted = [errors_of(sweep) for sweep in sweeps]
    return max(counted, key=counted.count)


def fails_tables(sweeps, accuracy):
    text = []
    for family in FAMILIES:
        of = [sweep for sweep in sweeps if sweep.family == family and sweep.curves]
        if of:
            text.append(f"**{family.capitalize()}**: {common_errors(of)}\n\n{fails_table(of, accuracy.methods[family])}")
    return "\n\n".join(text)
