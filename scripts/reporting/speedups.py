"""Comparisons in words: the faster side, the speed-up, and whether the repetitions settle it."""
from bench_rows import order

# Of each SIMD target: its name in sentences, and the width of its vectors in bits.
VECTORS = {"sse4": ("SSE4", 128), "avx2": ("AVX2", 256), "avx512": ("AVX-512", 512)}


def kernels(target):
    """"AVX-512", or "scalar code"."""
    return VECTORS[target][0] if target in VECTORS else "scalar code" if target == "scalar" else target or "unknown SIMD"


def with_width(target):
    """"AVX-512, 512 bits"."""
    return f"{kernels(target)}, {VECTORS[target][1]} bits" if target in VECTORS else kernels(target)


def about(ratio):
    """With two digits, as many as the noise allows."""
    return f"{ratio:.2f}×" if ratio < 1.095 else f"{ratio:.1f}×" if ratio < 9.95 else f"{float(f'{ratio:.2g}'):,.0f}×"


def spread(ratios):
    ends = list(dict.fromkeys(map(about, (min(ratios), max(ratios)))))
    return " to ".join(ends)


def by_order(compared):
    """{order(): speed-ups} of pairs of rows, ours first."""
    found = {-1: [], 1: [], 0: []}
    for ours, other in compared:
        found[order(ours, other)].append(other.median_ms / ours.median_ms)
    return found


def outcome(found):
    """"1.2× to 2.3× faster in 8, not settled in 6 of 14 scenes"; `found` as of by_order()."""
    said = [f"{spread(found[-1])} faster in {len(found[-1])}"] if found[-1] else []
    said += [f"{spread([1 / ratio for ratio in found[1]])} slower in {len(found[1])}"] if found[1] else []
    said += [f"not settled in {len(found[0])}"] if found[0] else []
    scenes = sum(map(len, found.values()))
    return f"{', '.join(said)} of {scenes} {'scene' if scenes == 1 else 'scenes'}"


def speed_up(ratio):
    """A speed-up in a table, "2.6× slower" if below 1."""
    return about(ratio) if ratio >= 1 else f"{about(1 / ratio)} slower"


def mark(ratio, settled):
    return speed_up(ratio) + ("" if settled else " (not settled)")
