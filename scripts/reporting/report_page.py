"""The report as one HTML file: text, static charts for readers without JavaScript, figures, pictures, and the script."""
import base64
import io
import json
import re
from html import escape
from pathlib import Path
from string import Template
from urllib.parse import quote

from PIL import Image

from accuracy_rows import FAMILIES
from bench_rows import BadInput
from findings import findings
from palette import VERDICTS, backend_looks, kind_looks
from peers import pairs, peer_table
from report_data import families, results_data
from scaling import scaling_table
from tables import scene_table

SOURCE = Path(__file__).resolve().parents[1] / "web"

# (id, heading, description)
SECTIONS = (
    ("accuracy", "Speed against accuracy", "Errors and time of each method. The dashed line joins the methods that no other "
     "beats in both on one thread; hollow marks err given the snapped positions, too; bars reach from the fastest "
     "repetition to the slowest."),
    ("area", "Cost against triangle area", "Random triangles of one area that together cover the same number of pixels. "
     "Lower is better. Rings: settled crossings of two curves. Bands: fastest to slowest repetition."),
    ("ablation", "Ablation: what each optimization gains", "Each line adds one optimization; all but the last run on one "
     "thread. Figures: speed-up over the line above. Black: faster; red: slower; grey: not settled. Grey ticks: the cost "
     "model's estimate."),
    ("stability", "Stability: the points at which methods start to fail", "Each chart leads from easy on the left to hard on the right. "
     "A hollow mark shows the first failure of a method. Methods with equal curves share one line."),
    ("peers", "Peers and cost model", "Milliseconds per frame beside an estimate for reading, drawing and writing, and the "
     "speed-up of ours over other projects' rasterizers."),
    ("scaling", "Scaling: estimated speed-up on more cores", "Whole frames, front end included: the speed-up estimated from "
     "recorded tasks and barriers (line), and as measured on two threads (ring). Dotted: ideal. The estimate ignores shared "
     "bandwidth, caches and clock rate. Text: the longest serial part on the most cores, for the backend estimated to be "
     "fastest."),
)
CHANGES = ("changes", "What changed", "Rows that became faster or slower between two results: all repetitions of one lie on one "
           "side of all of the other's. Choose one under “Compare with” above.")


def png(path):
    """A data URI with a palette of up to 256 colours: most pictures have fewer."""
    try:
        with Image.open(path) as image:
            small = image.convert("RGB").quantize(256, dither=Image.Dither.NONE)
            buffer = io.BytesIO()
            small.save(buffer, "PNG", optimize=True)
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror or 'not a picture'}") from None
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode()


def svg(path):
    """A data URI."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}") from None
    return "data:image/svg+xml," + quote(" ".join(text.split()), safe=" =:/,.;()?!'*+-[]@$|^~")


def pictures(folder):
    """The close-ups: {name: index}, and the distinct pictures; methods with equal errors share one."""
    named, different = {}, {}
    for path in sorted(folder.glob("*.png")):
        data = png(path)
        named[path.stem] = different.setdefault(data, len(different))
    return {"named": named, "images": list(different)}


def static_chart(path, heading):
    words = escape(f"{heading}: {path.stem.replace('-', ' ').replace('_', ' ')}")
    return f'<img src="{svg(path)}" alt="{words}" loading="lazy">'


def static_table(caption, header, lines):
    def row(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    body = "".join(row(line, "td") for line in lines)
    return (f'<div class="wide"><table><caption>{escape(caption)}</caption><thead>{row(header, "th")}</thead>'
            f"<tbody>{body}</tbody></table></div>")


def static_charts(result):
    """{section: names of its static charts}."""
    accuracy = result.accuracy
    timed = [name for family in FAMILIES for name, _ in accuracy.timed_charts(family)] if accuracy else []
    return {"accuracy": [*timed, *(f"errors-{family}" for family in FAMILIES)], "area": ["area"], "ablation": ["ablation"],
            "stability": [f"stability-{sweep.name}" for sweep in result.sweeps],
            "peers": ["scenes", *(f"against-{peer}" for peer in result.bench.peers)], "scaling": ["scaling"]}


def static_tables(bench):
    """{section: its figures without JavaScript}."""
    peers = [static_table(f"ms per frame: {peer} and ours", *peer_table(bench, peer))
             for peer in dict.fromkeys(peer for peer, _, _ in pairs(bench))]
    return {"peers": static_table("ms per frame, backend alone", *scene_table(bench)) + "".join(peers),
            "scaling": static_table("Estimated speed-up on more cores", *scaling_table(bench)) if bench.sweep("cores") else ""}


def section(name, heading, shows, static):
    return (f'<section aria-labelledby="{name}"><h2 id="{name}">{heading}</h2>\n<p>{shows}</p>\n'
            f'<div class="charts js-only" data-charts="{name}"></div>\n<noscript>{static}</noscript></section>')


def html(markdown):
    """HTML of a finding, which uses bold and code only."""
    text = re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", escape(markdown))
    return re.sub(r"`(.+?)`", r"<code>\1</code>", text)


def finding_list(result, hidden):
    items = "".join(f"<li>{html(found)}</li>" for found in findings(result.bench, result.accuracy))
    return f'<ul data-findings{" hidden" if hidden else ""}>{items}</ul>'


def embedded(data):
    """JSON that can't end the element that it stands in."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def page(folder, results, script):
    """`folder` is that of the first result, whose pictures and static charts are shown; `script` is the path of what
    scripts/web/build.js made."""
    first = results[0]
    try:
        template, style = ((SOURCE / name).read_text(encoding="utf-8") for name in ("page.html", "page.css"))
        bundle = script.read_text(encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{error.filename}: {error.strerror}") from None
    backends = dict.fromkeys(backend for result in results for backend in result.bench.backends)
    looks = {"backends": backend_looks(list(backends)), "verdicts": VERDICTS,
             "kinds": {name: kind_looks(family) for name, family in FAMILIES.items()}}
    found = results_data(results)
    data = {"looks": looks, "families": families(), "results": found, "pictures": pictures(folder / "errors")}
    charts, tables = static_charts(first), static_tables(first.bench)

    def static_part(name, heading):
        paths = (folder / "charts" / f"{chart}.svg" for chart in charts.get(name, ()))
        return "\n".join([*(static_chart(path, heading) for path in paths if path.exists()), tables.get(name, "")])

    shown = (*SECTIONS, CHANGES) if len(results) > 1 else SECTIONS
    return Template(template).substitute(
        name=escape(first.name), findings="\n".join(finding_list(result, result is not first) for result in results),
        machine=escape(found[0]["machine"]), style=style.rstrip(), data=embedded(data),
        script=bundle.rstrip().replace("</script", "<\\/script"),
        links="".join(f'<li><a href="#{name}">{heading.partition(":")[0]}</a></li>' for name, heading, _ in shown),
        sections="\n".join(section(name, heading, shows, static_part(name, heading))
                           for name, heading, shows in shown))
