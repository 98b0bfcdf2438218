"""The report as one HTML file: findings, the charts of the results folder, and tables."""
import re
from fnmatch import fnmatch
from html import escape
from pathlib import Path
from string import Template

from accuracy_rows import read_accuracy, read_stability
from accuracy_tables import fails_tables, method_tables
from bench_rows import BadInput, read_json
from cost_model import estimate_columns
from findings import findings
from needs import needs_table, read_needs, tutorials_table
from peers import peer_tables, with_ratios
from portable import OURS, portable_table, read_portable, sentence
from report_rows import rows_section
from tables import markdown, random_reads_sentence, scene_table, verify_sentence
from verification_summary import verification_table

SOURCE = Path(__file__).resolve().parents[1] / "web"

# Heading by id, and the names of the charts below it.
SECTIONS = {
    "accuracy": ("Speed against accuracy", ("frontier", "displacement", "accuracy-coverage*", "accuracy-*", "errors-*", "turning-cube")),
    "stability": ("Stability", ("stability-grid", "stability-*")),
    "speed": ("Speed of the backends", ("scenes", "area", "threads", "simd", "culling", "growth")),
    "needs": ("What scenes need", ()),
    "portable": ("Portable pixels", ("portable",)),
    "ablation": ("Ablation", ("ablation",)),
    "peers": ("Peers", ("against-*",)),
    "others": ("Other charts", ("*",)),
}


def read(path):
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}") from None


def shrunk(svg):
    """The same picture without metadata, comments and unused ids, and coordinates in steps of 1/100 pt."""
    svg = re.sub(r"<metadata>.*?</metadata>|<!--.*?-->", "", svg[svg.index("<svg"):], flags=re.DOTALL)
    svg = " ".join(svg.split()).replace("> <", "><")
    svg = re.sub(r"(scale\([^)]*\)|\.\d\d)\d*", r"\1", svg).replace("xlink:href", "href")
    svg = re.sub(r'style="[^"]*"', lambda style: style[0].replace("; ", ";").replace(": ", ":"), svg)
    short = {name: f"i{i}" for i, name in enumerate(dict.fromkeys(re.findall(r'(?:href="|url\()#([^")]+)', svg)))}
    svg = re.sub(r' id="([^"]+)"', lambda found: f' id="{short[found[1]]}"' if found[1] in short else "", svg)
    return re.sub(r'(href="|url\()#([^")]+)', lambda found: f"{found[1]}#{short[found[2]]}", svg)


def image(path, heading):
    """An SVG as an element of its own document: ids of different charts may be equal."""
    svg = read(path)
    if "<svg" not in svg:
        raise BadInput(f"{path}: not an SVG file")
    uri = "data:image/svg+xml," + shrunk(svg).replace("%", "%25").replace("#", "%23")
    # Apostrophes around it: SVG has many quotation marks, each of which would need an escape.
    uri = uri.replace("&", "&amp;").replace("'", "&#39;")
    words = f"{heading}: {path.stem.replace('-', ' ').replace('_', ' ')}"
    return f'<img alt="{escape(words)}" src=\'{uri}\'>'


def chart_groups(folder):
    """{section: paths of its charts}"""
    left = sorted(folder.glob("*.svg"))
    groups = {}
    for section, (_, patterns) in SECTIONS.items():
        for pattern in patterns:
            found = [path for path in left if fnmatch(path.stem, pattern)]
            left = [path for path in left if path not in found]
            groups.setdefault(section, []).extend(found)
    return groups


def inline_html(text):
    """HTML of Markdown that uses bold and code only."""
    text = re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", escape(text))
    return re.sub(r"`(.+?)`", r"<code>\1</code>", text)


def table_html(text):
    header, alignment, *lines = text.splitlines()
    numbers = [column.endswith(":") for column in alignment.strip("|").split("|")]

    def row(cells, tag):
        kinds = (' class="number"' if number else "" for number in numbers)
        return "<tr>" + "".join(f"<{tag}{kind}>{inline_html(cell)}</{tag}>"
                                for kind, cell in zip(kinds, cells[2:-2].split(" | "))) + "</tr>"

    body = "\n".join(row(cells, "td") for cells in lines)
    return f'<div class="wide"><table><thead>{row(header, "th")}</thead>\n<tbody>\n{body}\n</tbody></table></div>'


def html(text):
    """HTML of the Markdown in READMEs' generated blocks: paragraphs and tables."""
    return "\n".join(table_html(block) if block.startswith("| ") else f"<p>{inline_html(block)}</p>"
                     for block in text.strip().split("\n\n"))


def verification(folder):
    """Markdown; empty if nothing was verified for these results."""
    verify, (header, lines) = folder / "verify.json", verification_table(folder)
    return "\n\n".join([*([verify_sentence(read_json(verify))] if verify.exists() else []),
                        *([markdown(header, lines, "|---|---|---|")] if lines else [])])


def tables(bench, accuracy, sweeps, portable, needs):
    """{section: Markdown below its charts}"""
    found = {"peers": peer_tables(bench, markdown)}
    if OURS in portable:
        found["portable"] = f"{sentence(portable)}\n\n{markdown(*portable_table(portable))}"
    if needs:
        found["needs"] = "\n\n".join(markdown(*table) for table in (needs_table(needs), tutorials_table(needs)))
    if bench.scenes:
        found["speed"] = ("Median milliseconds per frame, backend alone, on 1 and on 2 threads:\n\n"
                          + markdown(*with_ratios(bench, *scene_table(bench, estimate_columns(bench)))))
    if accuracy:
        found["accuracy"] = method_tables(accuracy)
        if sweeps:
            found["stability"] = fails_tables(sweeps, accuracy)
    return found


def sections(folder, accuracy, first, others):
    """(id, heading, HTML) of each section that holds something."""
    if verified := verification(folder):
        yield "verification", "Verification", html(verified)
    below = tables(first.bench, accuracy, read_stability(folder), read_portable(folder),
                   read_needs(folder))
    for name, paths in chart_groups(folder / "charts").items():
        heading = SECTIONS[name][0]
        parts = [*(image(path, heading) for path in paths), *([html(below[name])] if name in below else [])]
        if parts:
            yield name, heading, "\n".join(parts)
    yield "rows", "All benchmark rows", rows_section(first, others)


def page(folder, first, others):
    """`folder` is that of the first result, whose charts and tables are shown; the others are compared with it."""
    accuracy = read_accuracy(folder)
    parts = list(sections(folder, accuracy, first, others))
    machine = f"{first.description}. {random_reads_sentence(first.bench)}".rstrip()
    return Template(read(SOURCE / "report.html")).substitute(
        name=escape(first.name), machine=escape(machine), style=read(SOURCE / "report.css"), script=read(SOURCE / "report.js"),
        findings="\n".join(f"<li>{inline_html(found)}</li>" for found in findings(first.bench, accuracy)),
        links="\n".join(f'<li><a href="#{name}">{heading}</a></li>' for name, heading, _ in parts),
        sections="\n".join(f'<section id="{name}"><h2>{heading}</h2>\n{body}\n</section>' for name, heading, body in parts))
