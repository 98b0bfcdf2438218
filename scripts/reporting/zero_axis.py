"""Log axes that show 0 as well."""
import math

from palette import BAND
from tables import short


class ZeroAxis:
    """Positions, in decades, of values ≥ 0 on a log axis that begins with a band for 0."""

    def __init__(self, values, band=0.18):
        """`band`: the width of the band, as a part of the log axis."""
        seen = [math.log10(v) for v in values if v > 0] or [0.0, 1.0]
        self.low, self.high = math.floor(min(seen)), max(seen)
        self.high = max(self.high, self.low + 1)
        decades = self.high - self.low
        self.end = self.low - 0.035 * decades  # of the band
        self.start = self.end - band * decades
        self.zero = (self.start + self.end) / 2
        self.limit = self.high + 0.04 * decades

    def at(self, value):
        return math.log10(value) if value > 0 else self.zero

    def ticks(self, zero):
        step = max(1, math.ceil((self.high - self.low) / 8))
        places = list(range(self.low, math.floor(self.high + 1e-9) + 1, step))
        return [self.zero, *places], [zero, *(short(10.0 ** k) for k in places)]

    def apply_x(self, axes, zero="0"):
        axes.set_xticks(*self.ticks(zero))
        axes.set_xlim(self.start, self.limit)
        axes.axvspan(self.start, self.end, color=BAND, zorder=0, linewidth=0)

    def apply_y(self, axes):
        axes.set_yticks(*self.ticks("0"))
        axes.set_ylim(self.start, self.limit)
        axes.axhspan(self.start, self.end, color=BAND, zorder=0, linewidth=0)
