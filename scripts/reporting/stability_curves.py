"""The curves of a stability sweep: methods that share one, the point of failure, and the axes."""
from accuracy_rows import Method
from tables import short
from zero_axis import ZeroAxis


class Plain:
    """Places on an axis without logarithm."""

    def __init__(self, values):
        self.low, self.high = min(values), max(values)

    @staticmethod
    def at(value):
        return value


def axis_of_errors(*sweeps):
    """One axis for the same sweep of one or more results."""
    ys = [y for sweep in sweeps for curve in sweep.curves for _, y in curve.points]
    return ZeroAxis(ys) if sweeps[0].y["log"] else Plain(ys)


def runs_down(sweep):
    """Whether x falls from easy to hard."""
    first = sweep.curves[0].points
    return first[0][0] > first[-1][0]


def known_methods(accuracy):
    """{(family, name): method}; accuracy may be None."""
    return {(family, m.name): m for family, found in accuracy.methods.items() for m in found} if accuracy else {}


def groups_of(sweep, methods):
    """Methods whose curves are the same, as one: (methods, curve), in the registry's order."""
    groups = {}
    for curve in sweep.curves:
        members, _ = groups.setdefault((curve.points, curve.starts_to_fail), ([], curve))
        members.append(methods.get((sweep.family, curve.method)) or Method(curve.method, "", "", curve.exact))
    return list(groups.values())


# Lengths of dashes and gaps, in widths of the line; given out within a kind of method.
DASHES = ((), (5, 1.5), (1.5, 1.2), (5, 1.5, 1, 1.5), (8, 2), (3, 1, 1, 1, 1, 1))


def kinds_and_dashes(groups, family):
    """(kind, dash) of each group, so that no two lines look alike."""
    found, used = [], {}
    for members, _ in groups:
        kind = "ours" if any(member.ours for member in members) else family.kind(members[0])
        found.append((kind, DASHES[used.get(kind, 0) % len(DASHES)]))
        used[kind] = used.get(kind, 0) + 1
    return found


def wrapped(names, width=30):
    lines = [""]
    for name in names:
        if lines[-1] and len(lines[-1]) + len(name) > width:
            lines.append("")
        lines[-1] += name + ", "
    return "\n".join(line.strip() for line in lines).rstrip(",")


def tidy(value):
    if value == 0 or 1e-3 <= abs(value) < 1000:
        return f"{value:.3g}"
    if abs(value) >= 1000:
        return short(value)
    digits, power = f"{value:.0e}".split("e")
    raised = str(int(power)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return ("" if digits == "1" else digits + "·") + "10" + raised


def names_of(members):
    """Ours, then the others."""
    return wrapped([m.name for m in members if m.ours]), wrapped([m.name for m in members if not m.ours])


def line_count(text):
    return text.count("\n") + 1 if text else 0


def place_of_failure(curve):
    """The index of the first point at which a method fails."""
    return next((i for i, (x, _) in enumerate(curve.points) if x == curve.starts_to_fail), len(curve.points))


def where(curve, sweep):
    """"at 182 px"."""
    return f"at {tidy(curve.starts_to_fail)} {sweep.x['unit']}".rstrip()


def summary(groups):
    """The sweep's finding: "ours hold; fixed_8_int32 breaks at 182"."""
    own, others = ([(place_of_failure(curve), tidy(curve.starts_to_fail), m.name) for members, curve in groups for m in members
                    if m.ours == whose and curve.starts_to_fail is not None] for whose in (True, False))
    breaking = [found for found in others if found[0] > 0]
    return (f"ours {f'break at {min(own)[1]}' if own else 'hold'}; "
            + (f"{min(breaking)[2]} breaks at {min(breaking)[1]}" if breaking else f"{len(others)} others fail at once"))


def failing(curve, sweep):
    if curve.starts_to_fail is None:
        return "errs no more than snapping" if max(sweep.by_snapping) > 0 else "holds"
    return f"fails {where(curve, sweep)}"


def origin_sentence(sweeps):
    """README's sentence on the sweep `origin`; empty where its data don't hold it."""
    curves = {curve.method: curve for sweep in sweeps if sweep.name == "origin" for curve in sweep.curves}
    one, *holding = (curves.get(name) for name in ("matrix_float", "near_guard", "matrix_relative"))
    if not one or not one.starts_to_fail or not all(curve and curve.starts_to_fail is None for curve in holding):
        return ""
    return (f"Far from the origin, one float 4×4 matrix (`matrix_float`) fails from a distance of {tidy(one.starts_to_fail)}; "
            f"ours and camera-relative matrices hold up to {tidy(holding[0].points[-1][0])}.")


def trials_note(sweep):
    trials = [n for curve in sweep.curves for n in curve.trials if n]
    if not trials or not sweep.y["log"]:
        return ""
    low, high = short(min(trials)), short(max(trials))
    return f" 0: no error in {low if low == high else f'{low} to {high}'} trials per point; the 95 % upper bound is 3/N."
