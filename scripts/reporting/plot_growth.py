"""Chart of cost against triangles, pixels and overdraw, with the exponents from step to step below."""
import math
import textwrap
from dataclasses import dataclass, replace

from bench_rows import gained, gained_interval, order
from plot_area import draw_curves
from plot_style import BAND, FAINT, INK, WIDTH_IN, Look, head_in, headline, plt, save
from tables import short

LINEAR = 0.1  # exponents within this distance of 1 are called linear


def pixels(row):
    width, height = row.keys["size"].split("x")
    return int(width) * int(height)


@dataclass(frozen=True)
class Quantity:
    key: str
    name: str
    x_of: object  # of a row

    def rows(self, bench):
        """The rows of each backend, by growing x."""
        found = {backend: [] for backend in bench.backends}
        for row in bench.sweep(self.key):
            if row.backend in found and not row.frontend:
                found[row.backend].append(row)
        return {backend: sorted(rows, key=self.x_of) for backend, rows in found.items() if rows}

    def label(self, x):
        return f"{math.isqrt(int(x))}²" if self.key == "size" else short(x)

    def scene(self, bench):
        """Describes the drawn scene."""
        row = bench.sweep(self.key)[0]
        if self.key == "size":
            return f"{row.scene} in square images"
        covered = sum(row.counters["covered_px"] for row in bench.sweep(self.key))
        area = covered / sum(row.counters["triangles"] for row in bench.sweep(self.key))
        return (f"triangles of about {short(float(f'{area:.1g}'))} px in an image of {row.counters['width']:.0f} × "
                f"{row.counters['height']:.0f}")


QUANTITIES = (Quantity("count", "triangles", lambda row: int(row.keys["count"])),
              Quantity("size", "pixels", pixels),
              Quantity("overdraw", "overdraw", lambda row: float(row.keys["overdraw"])))


@dataclass(frozen=True)
class Step:
    """From one row to the next: time grows like x to the power of `exponent`, which has the interval low to high."""
    start: float
    end: float
    exponent: float
    low: float
    high: float
    kind: str


def kind_of(exponent, growth, before, after):
    """`growth`: of x. Whether a time that grows with another power would be longer or shorter than that of `after`."""
    def against(power):
        return order(replace(before, times_ms=[ms * growth ** power for ms in before.times_ms]), after)

    if abs(exponent - 1) <= LINEAR:
        return "linear"
    return "less than linear" if against(1 - LINEAR) > 0 else "more than linear" if against(1 + LINEAR) < 0 else "not settled"


def steps(quantity, rows):
    found = []
    for before, after in zip(rows, rows[1:]):
        start, end = quantity.x_of(before), quantity.x_of(after)

        def exponent(ratio):
            return math.log(ratio) / math.log(end / start)

        middle = exponent(gained(after, before))
        low, high = map(exponent, gained_interval(after, before))
        found.append(Step(start, end, middle, low, high, kind_of(middle, end / start, before, after)))
    return found


def draw_steps(axes, quantity, rows, look):
    axes.axhspan(1 - LINEAR, 1 + LINEAR, color=BAND, zorder=0, linewidth=0)
    axes.axhline(1, color=FAINT, linewidth=1.0, zorder=1)
    for backend, found in rows.items():
        middle, exponents, bars = [], [], []
        for step in steps(quantity, found):
            middle.append(math.sqrt(step.start * step.end))
            exponents.append(step.exponent)
            bars.append((step.low, step.high))
        axes.vlines(middle, *zip(*bars), color=look.colour(backend), linewidth=5, alpha=0.2)
        axes.plot(middle, exponents, color=look.colour(backend), marker=look.marker(backend), linewidth=1.2,
                  markeredgecolor="white", markeredgewidth=0.6)
    axes.set_ylim(-0.25, 1.6)
    axes.set_yticks([0, 0.5, 1, 1.5], ["0", "½", "1", "1½"])


def label_x(axes, quantity, rows):
    places = sorted({quantity.x_of(row) for found in rows.values() for row in found})
    axes.set_xticks(places, [quantity.label(x) for x in places], fontsize=8, rotation=30 if quantity.key == "size" else 0)
    axes.tick_params(axis="x", which="minor", length=0)


def title(drawn):
    """The settled cases of growth beyond linear."""
    faster = [f"{backend} with {quantity.name}" for quantity, rows in drawn for backend, found in rows.items()
              if any(step.kind == "more than linear" for step in steps(quantity, found))]
    if faster:
        return f"Settled growth beyond linear: {faster[0]}" + (f", and {len(faster) - 1} more" if faster[1:] else "")
    return f"No settled growth beyond linear with {', '.join(quantity.name for quantity, _ in drawn)}"


def growth(bench, folder, caption):
    look = Look(bench.backends)
    drawn = [(quantity, rows) for quantity in QUANTITIES if (rows := {
        backend: found for backend, found in quantity.rows(bench).items() if len(found) > 1})]
    if not drawn:
        return None
    threads = next(iter(drawn[0][1].values()))[0].threads
    subtitle = (f"Backend alone, clear included, {threads} threads. Top: ms per frame, lower is better; bands are 95 % "
                "intervals. Bottom: the exponent from point to point, 1 is linear and 0 no growth; light bars are 95 % "
                "intervals.")
    figure, panels = plt.subplots(2, len(drawn), squeeze=False, sharex="col", figsize=(WIDTH_IN, 5.9 + head_in(subtitle)),
                                  height_ratios=(3, 2))
    height = figure.get_figheight()
    top = headline(figure, title(drawn), subtitle)
    look.legend(figure, top - 0.02 / height)
    figure.subplots_adjust(left=0.06, right=0.985, bottom=0.95 / height, top=top - 0.72 / height, wspace=0.2, hspace=0.08)
    for (quantity, rows), (above, below) in zip(drawn, panels.T):
        points = {backend: [(quantity.x_of(row), row, 1.0) for row in found] for backend, found in rows.items()}
        draw_curves(above, points, look)
        draw_steps(below, quantity, rows, look)
        label_x(below, quantity, rows)
        above.set_title(textwrap.fill(quantity.scene(bench), 34), fontsize=9, color=INK)
        below.set_xlabel({"count": "triangles", "size": "image, pixels", "overdraw": "overdraw"}[quantity.key])
        above.tick_params(axis="x", which="both", length=0)
    panels[0][0].set_ylabel("ms")
    panels[1][0].set_ylabel("exponent")
    save(figure, folder, "growth", caption)
    return "growth"
