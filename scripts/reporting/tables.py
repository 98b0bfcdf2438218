"""Figures, comparisons and tables as text."""
from bisect import bisect

from bench_rows import gained, order

# Of each SIMD target: its name in sentences, and the width of its vectors in bits.
VECTORS = {"scalar": ("scalar code", 32), "sse4": ("SSE4", 128), "avx2": ("AVX2", 256), "avx512": ("AVX-512", 512), "neon": ("NEON", 128)}


def short(value, _=None):
    """1000 → 1k, 1e6 → 1M; small numbers as they are."""
    for limit, unit in ((1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(value) >= limit * 0.9995:
            return f"{value / limit:.3g}{unit}"
    return f"{value:.3g}"


def enumerated(words):
    """"a, b and c"."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def number(value, digits=3):
    return f"{float(f'{value:.{digits}g}'):,.10g}"


def milliseconds(row):
    """"–" for no row."""
    return f"{row.median_ms:,.{3 - bisect((1, 10, 100), row.median_ms)}f}" if row else "–"


def kernels(target):
    """"AVX-512", or "scalar code"."""
    return VECTORS[target][0]


def about(ratio):
    """With two digits, as many as the noise allows."""
    return f"{ratio:.2f}×" if ratio < 1.095 else f"{ratio:.1f}×" if ratio < 9.95 else f"{float(f'{ratio:.2g}'):,.0f}×"


def spread(ratios):
    return " to ".join(dict.fromkeys(map(about, (min(ratios), max(ratios)))))


def outcome(pairs):
    """"1.2× to 2.3× faster in 8, not settled in 6 of 14 scenes", of pairs of rows, ours first."""
    orders = [order(*pair) for pair in pairs]
    faster, slower = ([gained(other, ours) for (ours, other), found in zip(pairs, orders) if found == sign] for sign in (-1, 1))
    said = [f"{spread(faster)} faster in {len(faster)}"] if faster else []
    said += [f"{spread([1 / ratio for ratio in slower])} slower in {len(slower)}"] if slower else []
    said += [f"not settled in {orders.count(0)}"] if 0 in orders else []
    return f"{', '.join(said)} of {len(pairs)} {'scene' if len(pairs) == 1 else 'scenes'}"


def gain(before, after):
    """The speed-up from one row to another, and whether it is settled."""
    ratio = gained(before, after)
    return (about(ratio) if ratio >= 1 else f"{about(1 / ratio)} slower") + ("" if order(before, after) else " (not settled)")


def markdown(header, lines, alignment):
    first, *rest = (f"| {' | '.join(line)} |" for line in (header, *lines))
    return "\n".join([first, alignment, *rest])
