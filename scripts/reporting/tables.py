"""Figures, comparisons and tables as text: Markdown for the READMEs, plain text for the terminal."""
from bench_rows import gained, order

# Of each SIMD target: its name in sentences, and the width of its vectors in bits.
VECTORS = {"sse4": ("SSE4", 128), "avx2": ("AVX2", 256), "avx512": ("AVX-512", 512), "neon": ("NEON", 128)}


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


def percent(share, digits=2):
    return f"{number(100 * share, digits)} %"


def milliseconds(row):
    if row is None:
        return "–"
    ms = row.median_ms
    return f"{ms:.3f}" if ms < 1 else f"{ms:.2f}" if ms < 10 else f"{ms:.1f}" if ms < 100 else f"{ms:,.0f}"


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
        found[order(ours, other)].append(gained(other, ours))
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


def gain(before, after):
    """The speed-up from one row to another, and whether it is settled."""
    return speed_up(gained(before, after)) + ("" if order(before, after) else " (not settled)")


def markdown(header, lines, alignment=None):
    text = ["| " + " | ".join(header) + " |", alignment or "|---|" + "--:|" * (len(header) - 2) + "---|"]
    text += ["| " + " | ".join(line) + " |" for line in lines]
    return "\n".join(text)


def plain(header, lines):
    widths = [max(len(line[i]) for line in [header, *lines]) for i in range(len(header))]
    last = len(header) - 1

    def aligned(line):
        return "  ".join(cell.ljust(w) if i in (0, last) else cell.rjust(w)
                         for i, (cell, w) in enumerate(zip(line, widths))).rstrip()

    return "\n".join(map(aligned, [header, *lines]))
