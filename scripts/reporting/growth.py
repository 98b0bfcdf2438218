"""Growth of cost with triangles, pixels and overdraw, as exponents from step to step."""
import math
import re
from dataclasses import dataclass

from noise import order, ratio_interval
from tables import short

LINEAR = 0.1  # exponents within this distance of 1 are called linear
FRAME_BYTES, RECORD_BYTES = 8, 40  # per pixel, per triangle


def pixels(row):
    width, height = row.keys["size"].split("x")
    return int(width) * int(height)


@dataclass(frozen=True)
class Quantity:
    key: str
    name: str
    x_of: object  # of a row
    item_bytes: int  # memory per item that each frame passes over once; 0: none

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


QUANTITIES = (Quantity("count", "triangles", lambda row: int(row.keys["count"]), RECORD_BYTES),
              Quantity("size", "pixels", pixels, FRAME_BYTES),
              Quantity("overdraw", "overdraw", lambda row: float(row.keys["overdraw"]), 0))


@dataclass(frozen=True)
class Step:
    """From one row to the next: time grows like x to the power of `exponent`, which has the interval low to high."""
    start: float
    end: float
    exponent: float
    low: float
    high: float
    kind: str


def kind_of(exponent, growth, before_ms, after_ms):
    """`growth`: of x. Whether a time that grows with another power would be longer or shorter than `after_ms`."""
    def against(power):
        return order([ms * growth ** power for ms in before_ms], after_ms)

    if abs(exponent - 1) <= LINEAR:
        return "linear"
    return "less than linear" if against(1 - LINEAR) > 0 else "more than linear" if against(1 + LINEAR) < 0 else "not settled"


def steps(quantity, rows):
    found = []
    for before, after in zip(rows, rows[1:]):
        start, end = quantity.x_of(before), quantity.x_of(after)

        def exponent(ratio):
            return math.log(ratio) / math.log(end / start)

        middle = exponent(after.median_ms / before.median_ms)
        low, high = map(exponent, ratio_interval(before.times_ms, after.times_ms))
        found.append(Step(start, end, middle, low, high, kind_of(middle, end / start, before.times_ms, after.times_ms)))
    return found


def cache_bytes(machine, level):
    """None if the machine does not report it."""
    match = re.fullmatch(r"(\d+)K", str(machine.get("caches", {}).get(level, "")))
    return int(match.group(1)) * 1024 if match else None
