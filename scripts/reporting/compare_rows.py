"""Compares one row of two results: faster, slower, or within noise."""


def judge(before, after, least):
    """Ratio of medians, and whether the repetitions of the two leave a gap between them."""
    ratio = after.median_ms / before.median_ms
    apart = after.low_ms > before.high_ms or after.high_ms < before.low_ms
    repeated = len(before.times_ms) > 1 and len(after.times_ms) > 1
    if apart and repeated and abs(ratio - 1) >= least:
        return ratio, "slower" if ratio > 1 else "faster"
    return ratio, "within noise" if repeated or abs(ratio - 1) < least else "one draw only"


def spread(row):
    """Half the range of the repetitions, in per cent of the median."""
    return 50 * (row.high_ms - row.low_ms) / row.median_ms


def other_work(before, after):
    keys = ("triangles", "covered_px", "width", "height")
    return any(before.counters.get(k) != after.counters.get(k) for k in keys)
