#!/usr/bin/env python3
"""Uses results/page.html in Chromium, as a reader would. usage: page_test.py FOLDER, for screenshots"""
import base64
import json
import socket
import struct
import subprocess
import sys
import time
import unittest
import urllib.error
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "results" / "page.html"
FOLDER = Path(sys.argv.pop(1))
KEYS = {"right": "\ue014", "tab": "\ue004"}


class Browser:
    """A WebDriver session."""

    def __init__(self, width, height, *arguments):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL)
        self.session = f"http://127.0.0.1:{port}/session"
        options = {"args": ["--headless=new", "--no-sandbox", f"--window-size={width},{height}", *arguments]}
        started = self.post("", {"capabilities": {"alwaysMatch": {"goog:chromeOptions": options}}}, attempts=100)
        self.session += "/" + started["sessionId"]

    def post(self, path, data, attempts=1):
        request = urllib.request.Request(self.session + path, json.dumps(data).encode(),
                                         {"Content-Type": "application/json"})
        for attempt in range(attempts):
            try:
                with urllib.request.urlopen(request) as answer:
                    return json.load(answer)["value"]
            except urllib.error.HTTPError as error:
                raise AssertionError(error.read().decode()) from error
            except urllib.error.URLError:  # it has not started yet
                if attempt + 1 == attempts:
                    raise
                time.sleep(0.1)

    def run(self, script, *arguments):
        return self.post("/execute/sync", {"script": script, "args": list(arguments)})

    def open(self):
        self.post("/url", {"url": PAGE.as_uri()})
        for _ in range(100):
            if self.run("return document.body.dataset.ready"):
                return
            time.sleep(0.1)
        raise AssertionError("the page does not start")

    def picture(self, name):
        with urllib.request.urlopen(self.session + "/screenshot") as answer:
            (FOLDER / name).write_bytes(base64.b64decode(json.load(answer)["value"]))

    def close(self):
        urllib.request.urlopen(urllib.request.Request(self.session, method="DELETE")).close()
        self.driver.terminate()
        self.driver.wait()


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(1200, 900)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.browser.open()

    def counts(self):
        return self.browser.run("return Object.fromEntries(['gaps', 'double_hits', 'wrong', 'covered'].map("
                                "id => [id, Number(document.getElementById(id).textContent.replace(',', ''))]))")

    def choose(self, method):
        self.browser.run("const select = document.querySelector('#method'); select.value = [...select.options].find("
                         "o => o.text === arguments[0]).value; select.dispatchEvent(new Event('input'))", method)

    def show(self, case):
        self.browser.run("[...document.querySelectorAll('#cases button')].find(b => b.textContent === arguments[0])"
                         ".click()", case)

    def drag(self, vertex, dx, dy):
        """By pixels of the screen, from the middle of the handle."""
        x, y = self.browser.run("const box = document.querySelectorAll('#handles circle')[arguments[0]]"
                                ".getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]", vertex)
        move = {"type": "pointerMove", "duration": 50, "origin": "viewport"}
        self.browser.post("/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [
            {**move, "x": round(x), "y": round(y)}, {"type": "pointerDown", "button": 0},
            {**move, "x": round(x + dx), "y": round(y + dy)}, {"type": "pointerUp", "button": 0}]}]})

    def vertex(self, index):
        return self.browser.run("return document.querySelectorAll('#handles circle')[arguments[0]].ariaLabel", index)

    def test_is_one_small_file(self):
        text = PAGE.read_text()
        self.assertLess(PAGE.stat().st_size, 1_500_000)
        self.assertNotIn("src=", text)
        self.assertNotIn("import ", text)

    def test_a_dragged_vertex_changes_the_counts(self):
        self.choose("float_lt")
        before = self.counts()
        self.assertGreater(before["gaps"], 10)  # the shared edge runs through samples
        cell = self.browser.run("return document.querySelector('#stage').clientWidth / 32")
        self.drag(1, -3.4 * cell, 0)
        self.assertEqual(self.vertex(1), "vertex B, x 21, y 2.5")
        after = self.counts()
        self.assertNotEqual(after["covered"], before["covered"])
        self.assertLess(after["gaps"], before["gaps"])

    def test_ties_are_decided_by_the_method(self):
        found = {}
        for method in ("float_le", "float_lt", "fixed_8", "tiled"):
            self.choose(method)
            found[method] = self.counts()
        self.assertGreater(found["float_le"]["double_hits"], 0)
        self.assertEqual(found["float_le"]["gaps"], 0)
        self.assertGreater(found["float_lt"]["gaps"], 0)
        self.assertEqual(found["float_lt"]["double_hits"], 0)
        for method in ("fixed_8", "tiled"):
            self.assertEqual({**found[method], "covered": 0}, dict.fromkeys(found[method], 0))

    def test_the_picture_has_the_hash_of_the_native_program(self):
        corners = ((3.5, 3.5), (24.5, 2.5), (8.5, 18.5)), ((29.5, 16.5), (8.5, 18.5), (24.5, 2.5))
        stream = FOLDER / "pair.tri"
        stream.write_bytes(struct.pack("<4s3I", b"TRI1", 32, 20, 2) + b"".join(
            struct.pack("<9fI", *(value for x, y in triangle for value in (x, y, 0.5)), 1 + i)
            for i, triangle in enumerate(corners)))
        native = subprocess.run([ROOT / "build" / "edgewise", "hash", stream], capture_output=True, text=True, check=True)
        self.assertEqual(self.browser.run("return document.querySelector('#hash').textContent"), native.stdout.split()[0])

    def test_arrow_keys_move_the_focused_vertex(self):
        self.browser.run("document.querySelector('#handles circle').focus()")
        press = [{"type": kind, "value": KEYS["right"]} for kind in ("keyDown", "keyUp")]
        self.browser.post("/actions", {"actions": [{"type": "key", "id": "keys", "actions": press}]})
        self.assertEqual(self.vertex(0), "vertex A, x 4, y 3.5")

    def test_the_classic_failures_have_the_errors_of_the_laboratory(self):
        facts = {scene["name"]: scene for scene in json.loads((ROOT / "results/facts/accuracy.json").read_text())["scenes"]
                 if scene["family"] == "coverage"}
        cases = self.browser.run("return [...document.querySelectorAll('#cases button')].map(b => b.textContent)")
        self.assertGreater(len(cases), 5)
        for case in cases:
            self.show(case)
            shown = self.counts()
            self.assertGreater(shown["gaps"] + shown["double_hits"] + shown["wrong"], 0, case)
            for method in facts[case]["methods"]:
                if method["name"].startswith("engine_"):  # not on the page
                    continue
                self.choose(method["name"])
                expected = method["float"]["missing"] + method["float"]["extra"]
                self.assertEqual(self.counts()["wrong"], expected, f"{case}, {method['name']}")

    def test_the_cube_tears_while_its_diagonal_runs_through_samples(self):
        self.browser.run("document.querySelector('#cube').click()")
        self.assertGreater(self.counts()["gaps"], 10)  # by float_lt
        self.browser.picture("cube.png")
        self.choose("tiled")
        self.assertEqual(self.counts()["gaps"], 0)
        self.browser.run("const turn = document.querySelector('#turn input'); turn.value = 7;"
                         "turn.dispatchEvent(new Event('input'))")
        self.choose("float_lt")
        self.assertLess(self.counts()["gaps"], 10)

    def test_phones_and_dark_colours(self):
        self.browser.picture("light.png")
        phone = Browser(360, 740, "--force-dark-mode")
        self.addCleanup(phone.close)
        phone.open()
        phone.post("/window/rect", {"width": 360, "height": 740})
        wide = "return document.documentElement.scrollWidth - document.documentElement.clientWidth"
        self.assertEqual(phone.run(wide), 0)
        phone.picture("phone.png")


if __name__ == "__main__":
    unittest.main()
