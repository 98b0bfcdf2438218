#!/usr/bin/env python3
"""results/MACHINE/report.html as a reader meets it: in a headless Chromium, from disk, on small results made up here and on
those of the repository.

Exit status 77, which ctest takes for "skipped", where what it needs is absent."""
import json
import os
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

DEBIAN_PYTHON = "/usr/bin/python3"
SKIPPED = 77
try:
    from PIL import Image
    from selenium import webdriver
    from selenium.webdriver import ActionChains, Keys
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError:
    # The python3 on the PATH may be one that Debian's packages don't reach.
    if os.path.exists(DEBIAN_PYTHON) and not sys.flags.isolated:
        os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, "-I", os.path.abspath(__file__), *sys.argv[1:]])
    print("skipped: selenium not installed (scripts/packages/report-test.txt)")
    sys.exit(SKIPPED)

sys.path.insert(0, str(Path(__file__).resolve().parent))
import scripts_test  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
SECTIONS = ("accuracy", "area", "ablation", "stability", "peers", "scaling")
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><text x="1" y="9">50% &amp; "#1"</text></svg>'
HOSTILE = "</script><script>hacked = 1</script><img src=x onerror=hacked=1>'\"&"

# Texts of one chart that lie on one another, by more than the space around letters.
OVERLAPS = """
const found = [];
for (const svg of document.querySelectorAll("main figure > svg")) {
  const texts = [...svg.querySelectorAll("text, tspan")].filter((t) => !t.querySelector("tspan") && t.textContent.trim()
    && !t.closest("[aria-label=tip]"));
  const boxes = texts.map((t) => [t.textContent, t.getBoundingClientRect()]);
  boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
    if (Math.min(p.right, q.right) - Math.max(p.left, q.left) > 2 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 4)
      found.push(`${svg.getAttribute("aria-label").slice(0, 40)}: ${a} / ${b}`);
  }));
}
return found;
"""


def report(*arguments):
    return scripts_test.run("report", *arguments)


def write_results(folder, bench, laboratory=None, sweeps=None):
    """All that a run leaves, with charts and one picture of errors."""
    for name in ("charts", "errors"):
        (folder / name).mkdir(parents=True)
    files = {"bench": bench, "machine": scripts_test.MACHINE, "accuracy": laboratory or scripts_test.accuracy(),
             "stability": sweeps or scripts_test.stability()}
    for name, data in files.items():
        (folder / f"{name}.json").write_text(json.dumps(data))
    for name in ("accuracy-coverage", "area", "ablation", "stability-nearer", "scenes", "against-ext", "scaling"):
        (folder / "charts" / f"{name}.svg").write_text(SVG)
    Image.new("RGB", (30, 20), "red").save(folder / "errors" / "coverage-knot-float_le.png")
    return folder


class Browser:
    def __init__(self, width=1280, height=900, phone=False):
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     f"--window-size={width},{height}"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        if phone:
            options.add_experimental_option("mobileEmulation", {"deviceMetrics": {"width": width, "height": height,
                                                                                  "pixelRatio": 2}})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)

    def close(self):
        self.driver.quit()

    def open(self, path, state=""):
        self.driver.get("about:blank")  # a new hash alone would load nothing
        self.driver.get(f"{path.resolve().as_uri()}#{state}")

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def titles(self, section):
        """Of the charts that a section shows."""
        return [title.text for title in self.all(f"[data-charts={section}] h3")]

    def choose(self, name, value):
        Select(self.all(f"select[name={name}]")[0]).select_by_value(value)

    def wait(self, condition):
        return WebDriverWait(self.driver, 10).until(lambda _: condition())

    def complaints(self):
        return self.driver.get_log("browser")


class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.results = write_results(cls.folder / "results", scripts_test.bench_with_peer())
        cls.slower = write_results(cls.folder / "slower", scripts_test.bench(tiled=(4.0, 4.1, 4.2)))
        made = report(cls.results, "--compare", cls.slower)
        if made.returncode == 3:
            raise unittest.SkipTest(made.stderr)
        assert made.returncode == 0, made.stderr
        cls.page = cls.results / "report.html"
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.open(self.page)

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])

    def test_one_file_without_others_the_same_each_time(self):
        text = self.page.read_text()
        attributes = re.findall(r'\b(?:src|href|srcset|action|data)="([^"]*)"', text)
        self.assertTrue(attributes)
        self.assertEqual([value for value in attributes if not value.startswith(("data:", "#"))], [])
        self.assertNotIn("@import", text)
        again = self.folder / "again.html"
        self.assertEqual(report(self.results, "--compare", self.slower, "--out", again).returncode, 0)
        self.assertEqual(again.read_text(), text)

    def test_every_section_has_charts_and_their_figures(self):
        self.assertIn("fails at 0.1 px", self.stability_of("visibility"))
        for section in SECTIONS:
            charts = self.browser.all(f"[data-charts={section}] figure > svg")
            self.assertTrue(charts, section)
            for chart in charts:
                self.assertTrue(chart.find_elements(By.CSS_SELECTOR, "path, circle, rect"), section)
                self.assertIn("The figures stand in the table below", chart.get_attribute("aria-label"))
            self.assertEqual(len(self.browser.all(f"[data-charts={section}] figure > details")), len(charts), section)
        figures = self.browser.all("[data-charts=area] figure table")[0].get_attribute("textContent")
        for figure in ("slow", "10,000", "10.1"):  # ns at 1e6 covered pixels are ms
            self.assertIn(figure, figures)
        self.assertIn("slow × tiled at", self.browser.all("[data-charts=area] figcaption")[0].text)

    def stability_of(self, family):
        self.browser.choose("family", family)
        return self.browser.all("[data-charts=stability]")[0].text

    def test_filters(self):
        browser = self.browser
        self.assertEqual(browser.titles("area"), ["1 thread", "2 threads"])
        browser.choose("threads", "2")
        self.assertEqual(browser.titles("area"), ["2 threads"])
        self.assertIn("coverage: knot", browser.titles("accuracy"))
        browser.choose("family", "facing")
        self.assertIn("facing: knot", browser.titles("accuracy"))
        times = "[data-charts=peers] figure:first-child tbody tr"
        rows = len(browser.all(times))
        browser.choose("scene", "large")
        self.assertLess(len(browser.all(times)), rows)
        self.assertEqual(browser.titles("scaling"), [])
        browser.choose("scene", "cube")
        self.assertEqual(browser.titles("scaling"), ["cube"])
        self.assertIn("family=facing", browser.driver.current_url)
        browser.open(self.page, "threads=1&family=clipping")  # as a link leads there
        self.assertEqual(browser.titles("area"), ["1 thread"])
        self.assertIn("clipping: knot", browser.titles("accuracy"))

    def test_compares_two_results(self):
        browser = self.browser
        lines = len(browser.all("[data-charts=area] figure:first-child svg [aria-label=line] path"))
        self.assertNotIn("tiled/cube/threads:1", browser.all("[data-charts=changes]")[0].text)
        browser.choose("other", "1")
        self.assertIn("Compared with test, commit abc", browser.all("#machine")[0].text)
        self.assertIn("tiled/cube/threads:1", browser.all("[data-charts=changes]")[0].text)
        self.assertIn("faster", browser.all("[data-charts=changes]")[0].text)
        self.assertEqual(len(browser.all("[data-charts=area] figure:first-child svg [aria-label=line] path")), 2 * lines)
        browser.choose("result", "1")
        browser.choose("other", "0")
        self.assertIn("slower", browser.all("[data-charts=changes] tbody")[0].text)

    def test_the_findings_are_those_of_the_chosen_result(self):
        def shown():
            return [item.text for item in self.browser.all("header > ul li") if item.is_displayed()]

        cube = ("Gaps when the cube turns? In 9 frames of the tutorials' cube float_le leaves 16 gaps and draws 8 pixels "
                "twice; ours do neither.")
        self.assertEqual([text if text == cube else text.partition(",")[0] for text in shown()],
                         [cube, "Against ext (Ext 1.2): on 2 threads"])
        self.assertEqual([item.text for item in self.browser.all("header > ul strong")][:2],
                         ["Gaps when the cube turns?", "Against ext"])
        self.browser.choose("result", "1")  # without a peer
        self.assertEqual(shown(), [cube])

    def test_links_lead_to_headings_below_the_filters(self):
        browser = self.browser

        def assert_visible(name):
            heading, filters = browser.script(
                "return [`#${arguments[0]}`, 'form'].map((s) => document.querySelector(s).getBoundingClientRect())", name)
            self.assertGreaterEqual(heading["top"], filters["bottom"], name)
            self.assertLess(heading["bottom"], browser.script("return innerHeight"), name)

        browser.open(self.page, "stability")
        browser.wait(lambda: browser.script("return scrollY") > 0)
        assert_visible("stability")
        for rows in (1, 2):
            browser.wait(lambda: browser.script("return document.querySelector('form').offsetHeight") > 50 * rows)
            for link in browser.all("nav a"):
                browser.script("scrollTo(0, 0)")
                link.click()
                assert_visible(link.get_attribute("hash")[1:])
            browser.script("document.querySelector('form').style.maxWidth = '20rem'")

    def mark_of(self, name):
        """The mark of a method: where the browser looks for it."""
        label = next(text for text in self.browser.all("[data-charts=accuracy] g.labels text") if text.text == name)
        marks = self.browser.all("[data-charts=accuracy] figure > svg g[aria-label=dot] path")
        return min(marks, key=lambda mark: abs(mark.rect["x"] - label.rect["x"]) + abs(mark.rect["y"] - label.rect["y"]))

    def test_pointing_tells_and_a_click_opens_the_picture(self):
        browser = self.browser
        mark = self.mark_of("float_le")
        browser.script("arguments[0].scrollIntoView({block: 'center'})", mark)
        ActionChains(browser.driver).move_to_element(mark).perform()
        told = browser.wait(lambda: browser.all("[data-charts=accuracy] g[aria-label=tip] text"))[0]
        for words in ("float_le, 1 thread", "a book", "as told", "5,000 wrong pixels", "1.5 ns"):
            self.assertIn(words, told.get_attribute("textContent"))
        ActionChains(browser.driver).move_to_element(mark).click().perform()
        picture = browser.wait(lambda: browser.all("dialog[open] img"))[0]
        self.assertIn("float_le on knot", picture.get_attribute("alt"))
        browser.wait(lambda: browser.script("return arguments[0].naturalWidth", picture) == 30)
        ActionChains(browser.driver).send_keys(Keys.ESCAPE).perform()
        browser.wait(lambda: not browser.all("dialog[open]"))

    def test_keyboard_alone_reaches_filters_and_pictures(self):
        browser = self.browser
        reached = []
        for _ in range(60):
            ActionChains(browser.driver).send_keys(Keys.TAB).perform()
            focused = browser.driver.switch_to.active_element
            reached.append(focused.get_attribute("name") or focused.get_attribute("aria-label") or "")
            if "show the picture" in reached[-1]:
                break
        for name in ("result", "other", "threads", "family", "scene", "speedScene"):
            self.assertIn(name, reached)
        ActionChains(browser.driver).send_keys(Keys.ENTER).perform()
        browser.wait(lambda: browser.all("dialog[open] img"))

    def test_names_are_text_and_never_more(self):
        bench = json.loads(json.dumps(scripts_test.bench_with_peer()).replace('"machine": "test"',
                                                                              f'"machine": {json.dumps(HOSTILE)}'))
        laboratory = json.loads(json.dumps(scripts_test.accuracy()).replace('"float_le"', json.dumps(HOSTILE))
                                .replace('"many faces"', json.dumps(HOSTILE)))
        folder = write_results(self.folder / "hostile", bench, laboratory)
        self.assertEqual(report(folder).returncode, 0)
        self.browser.open(folder / "report.html")
        self.assertIsNone(self.browser.script("return window.hacked ?? null"))
        self.assertIn(HOSTILE, self.browser.all("h1")[0].text)
        self.assertIn(HOSTILE, self.browser.all("[data-charts=accuracy]")[0].text)
        self.assertEqual(len(self.browser.all("script")), 2)

    def test_dark_and_print(self):
        def colour():
            return self.browser.script("return getComputedStyle(document.body).backgroundColor")

        def media(**features):
            self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", features)

        self.addCleanup(media)
        self.assertEqual(colour(), "rgb(255, 255, 255)")
        dark = {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}
        media(**dark)
        self.assertNotEqual(colour(), "rgb(255, 255, 255)")
        media(media="print", **dark)
        self.assertEqual(colour(), "rgb(255, 255, 255)")
        self.assertFalse(self.browser.all("form")[0].is_displayed())
        self.assertTrue(self.browser.all("[data-charts=area] svg")[0].is_displayed())

    def test_without_javascript_the_static_charts_stand_there(self):
        browser = Browser()
        self.addCleanup(browser.close)
        browser.driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
        browser.open(self.page)
        images = browser.all("main img")
        self.assertEqual(len(images), 7)
        for image in images:
            browser.script("arguments[0].scrollIntoView()", image)
            browser.wait(lambda: browser.script("return arguments[0].naturalWidth", image) == 40)
            self.assertTrue(image.is_displayed())
        self.assertFalse(browser.all("form")[0].is_displayed())
        self.assertIn("10.1", browser.all("main table")[0].text)

    def test_a_wrong_command_line_is_told_before_npm_runs(self):
        tools = self.folder / "no-npm"
        tools.mkdir()
        (tools / "npm").write_text("#!/bin/sh\necho npm ran >&2\nexit 1\n")
        (tools / "npm").chmod(0o755)
        path = {"PATH": f"{tools}:{os.environ['PATH']}"}
        made = scripts_test.run("report", self.folder / "nope", environment=path)
        self.assertEqual((made.returncode, made.stderr), (2, f"report: {self.folder / 'nope'}: no such folder\n"))
        made = scripts_test.run("report", self.results, "--comare", self.slower, environment=path)
        self.assertEqual(made.returncode, 2)
        self.assertEqual(made.stderr, "report: unknown argument '--comare'; did you mean --compare? --help lists all\n")

    def test_bad_input_is_told_and_leaves_no_file(self):
        bad = write_results(self.folder / "bad", scripts_test.bench())
        for name, text in (("bench", "{"), ("accuracy", '{"methods": 3}'), ("machine", None)):
            path = bad / f"{name}.json"
            before = path.read_text()
            path.unlink() if text is None else path.write_text(text)
            made = report(bad)
            self.assertEqual((made.returncode, len(made.stderr.splitlines())), (2, 1), made.stderr)
            self.assertIn(f"{name}.json", made.stderr)
            path.write_text(before)
        self.assertIn("neither a results folder nor a commit", report(bad, "--compare", "no-such-commit").stderr)
        (bad / "errors" / "coverage-knot-float_le.png").write_text("no picture")
        self.assertIn("not a picture", report(bad).stderr)
        self.assertEqual(list(bad.glob("report*")), [])

    def test_results_with_little_in_them(self):
        folder = self.folder / "little"
        folder.mkdir()
        (folder / "bench.json").write_text(json.dumps({"context": {"backends": "tiled"},
                                                       "benchmarks": scripts_test.entries("tiled/cube/threads:1", [1.0])}))
        (folder / "machine.json").write_text("{}")
        self.assertEqual(report(folder).returncode, 0)
        self.browser.open(folder / "report.html")
        self.assertEqual(len(self.browser.all("main svg.clickable, main figure > svg")), 1)
        self.assertIn("hold nothing of this", self.browser.all("[data-charts=ablation]")[0].text)


class CommittedResults(unittest.TestCase):
    """What the repository holds: names are longer there, and stand nearer to one another."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        results = next((path.parent for path in sorted(ROOT.glob("results/*/bench.json"))), None)
        if results is None:
            raise unittest.SkipTest("no results in the repository")
        cls.page = cls.folder / "report.html"
        made = report(results, "--out", cls.page)
        if made.returncode == 3:
            raise unittest.SkipTest(made.stderr)
        assert made.returncode == 0, made.stderr

    def test_size(self):
        self.assertLess(self.page.stat().st_size, 8e6)

    def test_the_first_screen_has_the_findings(self):
        browser = Browser()
        self.addCleanup(browser.close)
        browser.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                       {"width": 1280, "height": 800, "deviceScaleFactor": 1, "mobile": False})
        browser.open(self.page)
        findings = browser.all("header > ul li")
        self.assertGreater(len(findings), 1)
        self.assertLess(findings[-1].rect["y"] + findings[-1].rect["height"], 800)

    def test_nothing_overlaps_or_is_wider_than_the_screen(self):
        for width, phone in ((1280, False), (390, True)):
            browser = Browser(width, 844, phone)
            self.addCleanup(browser.close)
            for family in ("coverage", "visibility", "facing", "clipping"):
                for threads in ("", "1", "2"):
                    browser.open(self.page, f"family={family}&threads={threads}")
                    self.assertEqual(browser.script(OVERLAPS), [], (width, family, threads))
                    scroll, inner = browser.script("return [document.documentElement.scrollWidth, innerWidth]")
                    self.assertLessEqual(scroll, inner, (width, family, threads))
            self.assertEqual(browser.complaints(), [])


if __name__ == "__main__":
    missing = [tool for tool in ("chromium", "chromedriver") if shutil.which(tool) is None]
    missing += [tool for tool in ("npm",) if shutil.which(tool) is None]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (scripts/packages/report.txt, report-test.txt)")
        sys.exit(SKIPPED)
    program = unittest.main(exit=False)
    everything_skipped = program.result.wasSuccessful() and program.result.testsRun == 0
    sys.exit(SKIPPED if everything_skipped else not program.result.wasSuccessful())
