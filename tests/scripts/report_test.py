#!/usr/bin/env python3
"""scripts/report: report.html of small results made up here, and of those of the repository."""
import json
import re
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote
from xml.etree import ElementTree

sys.path.insert(0, str(Path(__file__).resolve().parent))
import scripts_test  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
VOID = {"meta", "img", "input"}
CHARTS = ("accuracy-coverage", "area", "ablation", "stability-nearer", "scenes", "against-ext", "added")
SVG = """<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="40" height="20">
 <metadata>removed</metadata>
 <g id="unused"><path id="dot" d="M 1.23456 2 L 3 4" style="fill: #ff0000; stroke: none"/></g>
 <g transform="scale(0.015625)"><use xlink:href="#dot"/><!-- it's 50% --></g>
 <desc>it's 50% &amp; "#1" &lt;</desc>
</svg>
"""
MARKUP = "</script><script>hacked = 1</script><img src=x onerror=hacked=1>'\"&"


class Page(HTMLParser):
    """The elements of a page; fails where an end tag has no start tag."""

    def __init__(self, text):
        super().__init__()
        self.open, self.elements, self.cells, self.text = [], [], [], ""
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)
        if tag == "tr":
            self.cells.append([])
        if tag in ("td", "th"):
            self.cells[-1].append("")

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        if "script" not in self.open and "style" not in self.open:
            self.text += data
        if self.open and ("td" in self.open or "th" in self.open):
            self.cells[-1][-1] += data

    def all(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]

    def row(self, name):
        return next(cells for cells in self.cells if cells[0] == name)

    def charts(self):
        """{text for readers that see no picture: the root element}"""
        start = "data:image/svg+xml,"
        assert all(image["src"].startswith(start) for image in self.all("img"))
        return {image["alt"]: ElementTree.fromstring(unquote(image["src"].removeprefix(start))) for image in self.all("img")}


def report(*arguments):
    return scripts_test.run("report", *arguments)


class ReportTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, name, bench, laboratory=None):
        """All that the report reads, with charts."""
        folder = self.folder / name
        (folder / "charts").mkdir(parents=True)
        timed, model = scripts_test.timed_and_model(bench)
        for file, data in (("bench", timed), ("model", model), ("machine", scripts_test.MACHINE), ("verify", scripts_test.VERIFY),
                           ("accuracy", laboratory or scripts_test.accuracy()), ("stability", scripts_test.stability())):
            (folder / f"{file}.json").write_text(json.dumps(data))
        for chart in CHARTS:
            (folder / "charts" / f"{chart}.svg").write_text(SVG)
        return folder

    def made(self, folder, *arguments):
        done = report(folder, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return Page((folder / "report.html").read_text())

    def test_the_first_screen_has_the_machine_the_findings_and_the_verification(self):
        text = self.made(self.write("results", scripts_test.bench_with_peer())).text
        places = [text.rindex(words) for words in ("Test CPU, 2 cores", "Gaps when the cube turns?", "Against ext (",
                                                   "no bit differs", "Speed against accuracy", "All benchmark rows")]
        self.assertEqual(places, sorted(places))
        self.assertNotIn("**", text)

    def test_every_chart_is_embedded_and_keeps_its_shapes(self):
        charts = self.made(self.write("results", scripts_test.bench_with_peer())).charts()
        self.assertEqual(sorted(words.partition(": ")[2] for words in charts), sorted(name.replace("-", " ") for name in CHARTS))
        self.assertIn("Other charts: added", charts)
        for chart in charts.values():
            path, use, text = (chart.find(f".//{{*}}{tag}") for tag in ("path", "use", "desc"))
            self.assertEqual((path.get("d"), path.get("style")), ("M 1.23 2 L 3 4", "fill:#ff0000;stroke:none"))
            self.assertEqual(use.get("href"), f"#{path.get('id')}")
            self.assertEqual(text.text, "it's 50% & \"#1\" <")
            self.assertIsNotNone(chart.find(".//*[@transform='scale(0.015625)']"))
            self.assertIsNone(chart.find(".//{*}metadata"))

    def test_one_file_that_needs_no_other_and_is_the_same_each_time(self):
        folder = self.write("results", scripts_test.bench_with_peer())
        page = self.made(folder)
        self.assertEqual(page.all("link"), [])
        targets = [value for _, attributes in page.elements for name, value in attributes.items()
                   if name in ("src", "href", "srcset", "action", "data")]
        self.assertTrue(targets)
        self.assertEqual([value for value in targets if not value.startswith(("data:", "#"))], [])
        ids = [attributes["id"] for _, attributes in page.elements if "id" in attributes]
        self.assertEqual(len(ids), len(set(ids)))
        self.assertEqual([value for value in targets if value.startswith("#") and value[1:] not in ids], [])
        text = (folder / "report.html").read_text()
        self.assertNotRegex(re.sub(r"src='[^']*'", "", text), r"https?:|@import|url\(|fetch\(")
        self.made(folder)
        self.assertEqual((folder / "report.html").read_text(), text)

    def test_all_rows_are_in_the_table_beside_those_of_other_results(self):
        bench = scripts_test.bench_with_peer()
        bench["benchmarks"].append({"name": "tiled/broken/threads:1", "error_occurred": True, "error_message": "no <memory>"})
        other = scripts_test.bench(tiled=(4.0, 4.1, 4.2, 4.05, 4.15))
        for row in other["benchmarks"]:
            if row["name"] == "slow/cube/threads:2":
                row["triangles"] = 13.0
        page = self.made(self.write("results", bench), "--compare", self.write("slower", other))
        names = {row["name"] for row in bench["benchmarks"]}
        self.assertEqual(names - {cells[0] for cells in page.cells}, set())
        self.assertEqual(page.row("tiled/cube/threads:1"), ["tiled/cube/threads:1", "cube", "1", "2.1", "5", "4.1", "2.0× faster"])
        self.assertEqual(page.row("slow/cube/threads:1")[-1], "no significant difference")
        self.assertEqual(page.row("slow/cube/threads:2")[-1], "other work")
        self.assertEqual(page.row("ext+frontend/cube/threads:1")[-2:], ["–", "–"])
        self.assertIn("error: no <memory>", page.row("tiled/broken/threads:1"))
        self.assertIn("A is test, commit abc", page.text)

    def test_names_are_text_and_never_more(self):
        def with_markup(data, name):
            return json.loads(json.dumps(data).replace(json.dumps(name), json.dumps(MARKUP)))

        bench = with_markup(scripts_test.bench_with_peer(), "test")
        bench["benchmarks"] += scripts_test.entries(f"tiled/{MARKUP.replace('/', '')}/threads:1", [1.0])
        folder = self.write("with_markup", bench, with_markup(scripts_test.accuracy(), "float_le"))
        (folder / "machine.json").write_text(json.dumps({**scripts_test.MACHINE, "cpu_model": MARKUP}))
        (folder / "charts" / "<img src=x>.svg").write_text(SVG)
        page = self.made(folder, "--compare", folder)
        self.assertEqual(len(page.all("script")), 1)
        self.assertEqual(len(page.charts()), len(CHARTS) + 1)
        for words in (f"measured on {MARKUP}, commit", f"{MARKUP}, 2 cores", f"A is {MARKUP}, commit"):
            self.assertIn(words, page.text)
        self.assertIn([MARKUP], [cells[:1] for cells in page.cells])
        self.assertIn(MARKUP.replace("/", ""), [cells[1] for cells in page.cells])

    def test_bad_input_is_told_and_leaves_no_file(self):
        bad = self.write("bad", scripts_test.bench())
        for name, text in (("bench.json", "{"), ("accuracy.json", '{"methods": 3}'), ("machine.json", None),
                           ("charts/area.svg", "no picture")):
            before = (bad / name).read_text()
            (bad / name).unlink() if text is None else (bad / name).write_text(text)
            done = report(bad)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
            self.assertIn(name, done.stderr)
            (bad / name).write_text(before)
        self.assertIn("neither a results folder nor a commit", report(bad, "--compare", "no-such-commit").stderr)
        done = report(self.folder / "nope")
        self.assertEqual((done.returncode, done.stderr), (2, f"report: {self.folder / 'nope'}: no such folder\n"))
        done = report(bad, "--comare", bad)
        self.assertEqual((done.returncode, done.stderr),
                         (2, "report: unknown argument '--comare'; did you mean --compare? --help lists all\n"))
        self.assertEqual(list(bad.glob("report*")), [])

    def test_results_with_little_in_them(self):
        folder = self.folder / "little"
        folder.mkdir()
        (folder / "bench.json").write_text(json.dumps({"context": {"backends": "tiled"},
                                                       "benchmarks": scripts_test.entries("tiled/cube/threads:1", [1.0])}))
        (folder / "machine.json").write_text("{}")
        page = self.made(folder)
        self.assertEqual(page.all("img"), [])
        self.assertEqual(page.row("tiled/cube/threads:1")[3], "1")

    def test_committed_results(self):
        results = sorted(path.parent for path in ROOT.glob("results/*/bench.json"))
        for folder in results:
            out = self.folder / "report.html"
            done = report(folder, *(f"--compare={other}" for other in results if other != folder), "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLess(out.stat().st_size, 4e6)
            charts = Page(out.read_text()).charts()
            self.assertEqual(len(charts), len(list(folder.glob("charts/*.svg"))))
            self.assertNotIn("Other charts", {words.partition(":")[0] for words in charts})


if __name__ == "__main__":
    unittest.main()
