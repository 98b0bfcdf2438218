"""Compares one row of two results that were made at different times."""
import noise


def judge(before, after, least):
    """The ratio of medians, and the verdict. Both rows need enough repetitions, and changes below `least` don't count."""
    ratio = after.median_ms / before.median_ms
    if abs(ratio - 1) >= least:
        if settled := noise.order(after.times_ms, before.times_ms):
            return ratio, "slower" if settled > 0 else "faster"
        if not noise.enough(len(before.times_ms), len(after.times_ms)):
            return ratio, "too few repetitions"
    return ratio, "no significant difference"


def spread(row):
    """Half the 95 % interval, in per cent of the median."""
    low, high = row.interval_ms
    return 50 * (high - low) / row.median_ms


def other_work(before, after):
    keys = ("triangles", "covered_px", "width", "height")
    return any(before.counters.get(k) != after.counters.get(k) for k in keys)
