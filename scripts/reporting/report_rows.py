"""The table of all benchmark rows in report.html, each compared with the same row of other results."""
from html import escape
from string import ascii_uppercase

from compare_rows import judge, other_work, spread
from noise import DRIFT, LEVEL
from speedups import about
from tables import number

NO_NUMBER = '<td class="number" data-value="">–</td>'


def words_cell(text, value=None):
    """The page sorts by `value`; cells without one come last."""
    return f'<td data-value="{"" if value is None else f"{value:.6g}"}">{escape(text)}</td>'


def number_cell(text, value):
    """The page sorts by `value`."""
    return f'<td class="number" data-value="{value:.6g}">{escape(text)}</td>'


def text_cell(text):
    return f"<td>{escape(text)}</td>"


def compared(row, other):
    """Two cells: the median there, and the speed-up of `row` over it."""
    there = other.find(row.name)
    if there is None:
        return NO_NUMBER + words_cell("–")
    time = number_cell(number(there.median_ms), there.median_ms)
    if not row.times_ms:
        return time + words_cell("–")
    if other_work(there, row):
        return time + words_cell("other work")
    ratio, verdict = judge(there, row, DRIFT)
    said = f"{about(max(ratio, 1 / ratio))} {'faster' if ratio < 1 else 'slower'}"
    if verdict == "no significant difference":
        said, ratio = verdict, 1.0
    elif verdict == "too few repetitions":
        said += f", {verdict}"
    return time + words_cell(said, 1 / ratio)


def line(row, others):
    times = (number_cell(number(row.median_ms), row.median_ms) + number_cell(f"{spread(row):.0f}", spread(row))
             if row.times_ms else words_cell(f"error: {row.error}") + NO_NUMBER)
    return ("<tr>" + text_cell(row.name) + text_cell(row.scene) + number_cell(str(row.threads), row.threads) + times
            + "".join(compared(row, other) for other in others) + "</tr>")


def rows_table(first, others):
    """The rows of the first result."""
    header = [("row", ""), ("scene", ""), ("threads", "number"), ("ms", "number"), ("± %", "number")]
    for letter, _ in zip(ascii_uppercase, others):
        header += [(f"{letter}, ms", "number"), (f"compared with {letter}", "")]
    names = "".join(f'<th scope="col" class="{kind}">{name}</th>' if kind else f'<th scope="col">{name}</th>'
                    for name, kind in header)
    lines = "\n".join(line(row, [other.bench for other in others]) for row in first.bench.rows.values())
    return f'<div class="wide"><table><thead><tr>{names}</tr></thead>\n<tbody>\n{lines}\n</tbody></table></div>'


def rows_section(first, others):
    text = ["Each row times one backend, another rasterizer or the front end on one scene, or on random triangles. Times are "
            "medians. “± %” is half the 95 % interval."]
    text += [f"{letter} is {other.name} ({other.description})." for letter, other in zip(ascii_uppercase, others)]
    if others:
        text.append(f"A row counts as faster or slower where a rank-sum test at the {LEVEL:.0%} level tells the repetitions of "
                    f"the two apart, and the medians differ by at least {DRIFT:.0%}. That is a weak test, since the machine "
                    "drifts between runs.")
    return (f"<p>{escape(' '.join(text))}</p>\n"
            '<p id="filter" hidden><label>Rows with all these words: <input type="search"></label> <output></output></p>\n'
            + rows_table(first, others))
