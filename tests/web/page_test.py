#!/usr/bin/env python3
"""Uses a page in Chromium and Firefox, as a reader would. usage: page_test.py FOLDER, with page.html; for screenshots, too"""
import base64
import contextlib
import json
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDER = Path(sys.argv.pop(1)).resolve()
PAGE = FOLDER / "page.html"
WINDOW, PHONE = (1200, 900), (360, 740)  # CSS px


def until(found):
    for _ in range(300):
        if value := found():
            return value
        time.sleep(0.1)
    raise AssertionError("the browser or the page does not start")


class Browser:
    """Sends WebDriver's commands to a browser. Its processes end with close(), whether a session started or not."""

    def __init__(self):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.process = subprocess.Popen(self.command(), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                        start_new_session=True, env={**os.environ, "TMPDIR": self.profile.name})

    def close(self):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        self.profile.cleanup()

    def assert_running(self):
        assert self.process.poll() is None, f"{self.process.args[0]} ended: {self.process.returncode}"

    def run(self, script, *arguments):
        return self.send("ExecuteScript", script=script, args=list(arguments))

    def act(self, kind, device, *actions, **more):
        self.send("PerformActions", actions=[{"type": kind, "id": device, "actions": actions, **more}])

    def open(self):
        self.send("Navigate", url=PAGE.as_uri())
        until(lambda: self.run("return document.body.dataset.ready"))


class Chromium(Browser):
    PATHS = {"ExecuteScript": "/execute/sync", "Navigate": "/url", "PerformActions": "/actions"}

    def command(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.session = f"http://127.0.0.1:{port}/session"
        return ["chromedriver", f"--port={port}"]

    def start(self):
        options = {"args": ["--headless=new", "--no-sandbox", f"--user-data-dir={self.profile.name}/chromium"]}
        wanted = {"alwaysMatch": {"goog:chromeOptions": options}}
        self.session += "/" + until(lambda: self.post("", capabilities=wanted))["sessionId"]

    def post(self, path, **data):
        request = urllib.request.Request(self.session + path, json.dumps(data).encode(),
                                         {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(error.read().decode()) from error
        except urllib.error.URLError:
            self.assert_running()
            return None  # it has not started yet

    def send(self, command, **data):
        return self.post(self.PATHS[command], **data)

    def devtools(self, command, **data):
        return self.post("/goog/cdp/execute", cmd=command, params=data)

    def look(self, dark=False, phone=False):
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.devtools("Emulation.setEmulatedMedia", features=[scheme])
        width, height = PHONE if phone else WINDOW
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height,
                      deviceScaleFactor=2 if phone else 1, mobile=phone)

    def picture(self, name):
        shot = self.devtools("Page.captureScreenshot")["data"]
        (FOLDER / f"chromium-{name}.png").write_bytes(base64.b64decode(shot))


class Firefox(Browser):
    """By Marionette: lengths and JSON on a socket."""

    def command(self):
        (Path(self.profile.name) / "user.js").write_text('user_pref("marionette.port", 0);')
        return ["firefox-esr", "--headless", "--marionette", "--remote-allow-system-access", "--profile",
                self.profile.name]

    def start(self):
        file = Path(self.profile.name) / "MarionetteActivePort"
        port = until(lambda: self.assert_running() or (file.exists() and file.read_text()))
        self.socket = socket.create_connection(("127.0.0.1", int(port)), timeout=60)
        self.answers = self.socket.makefile("rb")
        self.receive()  # its greeting
        self.send("NewSession")

    def close(self):
        super().close()
        if hasattr(self, "socket"):
            self.answers.close()
            self.socket.close()

    def receive(self):
        length = b""
        while (byte := self.answers.read(1)) != b":":
            assert byte, "firefox-esr ended"
            length += byte
        return json.loads(self.answers.read(int(length)))

    def send(self, command, by="WebDriver", **data):
        message = json.dumps([0, 0, f"{by}:{command}", data]).encode()
        self.socket.sendall(b"%d:%s" % (len(message), message))
        _, _, error, answer = self.receive()
        if error:
            raise AssertionError(error["message"])
        return answer.get("value")

    def look(self, dark=False, phone=False):
        # No window is as narrow as a phone, so the page is enlarged.
        zoom, (width, height) = (2, PHONE) if phone else (1, WINDOW)
        self.send("SetWindowRect", width=zoom * width, height=zoom * height)
        self.send("SetContext", by="Marionette", value="chrome")
        self.run("Services.prefs.setIntPref('layout.css.prefers-color-scheme.content-override', arguments[0]);"
                 "gBrowser.selectedBrowser.browsingContext.fullZoom = arguments[1]", 0 if dark else 1, zoom)
        self.send("SetContext", by="Marionette", value="content")

    def picture(self, name):
        (FOLDER / f"firefox-{name}.png").write_bytes(base64.b64decode(self.send("TakeScreenshot", full=False)))


class Page:
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.Browser()
        cls.addClassCleanup(cls.browser.close)
        cls.browser.start()

    def setUp(self):
        self.browser.look()
        self.browser.open()

    def counts(self):
        return self.browser.run("return Object.fromEntries(['gaps', 'double_hits', 'wrong', 'covered'].map("
                                "id => [id, Number(document.getElementById(id).textContent.replace(',', ''))]))")

    def choose(self, text, of="method"):
        self.browser.run("const select = document.getElementById(arguments[1]); select.value = [...select.options].find("
                         "o => o.text === arguments[0]).value; select.dispatchEvent(new Event('input'))", text, of)

    def chosen(self):
        return self.browser.run("return ['method', 'bits', 'ties'].map(id => document.getElementById(id)"
                                ".selectedOptions[0].text)")

    def show(self, case):
        self.browser.run("[...document.querySelectorAll('#cases button')].find(b => b.textContent === arguments[0])"
                         ".click()", case)

    def drag(self, vertex, dx, dy, by="mouse"):
        """By pixels of the screen, from the middle of the handle."""
        x, y = self.browser.run("const box = document.querySelectorAll('#handles circle')[arguments[0]]"
                                ".getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]", vertex)
        move = {"type": "pointerMove", "duration": 50, "origin": "viewport"}
        self.browser.act("pointer", by, {**move, "x": round(x), "y": round(y)}, {"type": "pointerDown", "button": 0},
                         *({**move, "x": round(x + dx * i / 8), "y": round(y + dy * i / 8)} for i in range(1, 9)),
                         {"type": "pointerUp", "button": 0},
                         parameters={"pointerType": by})

    def vertex(self, index):
        return self.browser.run("return document.querySelectorAll('#handles circle')[arguments[0]].ariaLabel", index)

    def test_is_one_small_file(self):
        text = PAGE.read_text()
        self.assertLess(PAGE.stat().st_size, 1_500_000)
        self.assertNotRegex(text, r"\b(src|href)=|url\(|\bfetch\(|\bimport[ (]")

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

    def test_subpixel_bits_and_the_tie_rule_choose_a_method(self):
        self.assertEqual(self.chosen(), ["float_lt", "none", "neither draws"])
        for choice, of, expected in (("both draw", "ties", ["float_le", "none", "both draw"]),
                                     ("top-left", "ties", ["float_top_left", "none", "top-left"]),
                                     ("8", "bits", ["scanline", "8", "top-left"]),
                                     ("16", "bits", ["fixed_16", "16", "top-left"]),
                                     ("0", "bits", ["whole_pixel", "0", "top-left"]),
                                     ("neither draws", "ties", ["float_lt", "none", "neither draws"])):
            self.choose(choice, of)
            self.assertEqual(self.chosen(), expected)
        self.choose("tiled")
        self.assertEqual(self.chosen(), ["tiled", "8", "top-left"])

    def test_the_hash_and_the_needs_are_those_of_the_native_program(self):
        corners = ((3.5, 3.5), (24.5, 2.5), (8.5, 18.5)), ((29.5, 16.5), (8.5, 18.5), (24.5, 2.5))
        stream = FOLDER / "pair.tri"
        stream.write_bytes(struct.pack("<4s3I", b"TRI1", 32, 20, 2) + b"".join(
            struct.pack("<9fI", *(value for x, y in triangle for value in (x, y, 0.5)), 1 + i)
            for i, triangle in enumerate(corners)))

        def native(*arguments):
            return subprocess.run([ROOT / "build" / "edgewise", *arguments, stream], capture_output=True, text=True,
                                  check=True).stdout

        found = self.browser.run("return document.querySelector('#hash').textContent")
        self.assertEqual(found, native("hash").split()[0])
        needs = until(lambda: self.browser.run(
            "return [...document.querySelectorAll('#needs[aria-busy=false] li')].map(item => "
            "[item.childNodes[1].data, item.querySelector('b').textContent])"))
        expected = json.loads(native("needs", "--json"))["edges"]
        self.assertEqual(needs, [[need["question"], need["answer"]] for need in expected])

    def test_arrow_keys_move_the_focused_vertex(self):
        self.browser.run("document.querySelector('#handles circle').focus()")
        self.browser.act("key", "keys", *({"type": kind, "value": "\ue014"} for kind in ("keyDown", "keyUp")))  # right
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
                self.choose(method["name"])
                self.assertEqual(self.counts()["wrong"], method["source"]["errors"], f"{case}, {method['name']}")

    def test_the_cube_tears_while_its_diagonal_runs_through_samples(self):
        self.browser.run("document.querySelector('#cube').click()")
        self.assertGreater(self.counts()["gaps"], 10)  # by float_lt
        self.browser.picture("cube")
        self.choose("tiled")
        self.assertEqual(self.counts()["gaps"], 0)
        self.browser.run("const turn = document.querySelector('#turn input'); turn.value = 7;"
                         "turn.dispatchEvent(new Event('input'))")
        self.choose("float_lt")
        self.assertLess(self.counts()["gaps"], 10)

    def test_follows_the_readers_colours(self):
        def brightness():
            """Of the paper, the ink, and a pixel that no triangle covers: red, green and blue added."""
            return self.browser.run(r"""
                const style = getComputedStyle(document.body), sum = (rgb) => rgb.reduce((a, b) => a + Number(b), 0);
                const pixel = document.querySelector('canvas').getContext('2d').getImageData(5, 5, 1, 1).data;
                return [...[style.backgroundColor, style.color].map((c) => sum(c.match(/\d+/g))),
                        sum([...pixel].slice(0, 3))];""")

        for dark in (False, True):
            self.browser.look(dark=dark)  # the open page must follow
            self.browser.picture("dark" if dark else "light")
            paper, ink, pixel = brightness()
            self.assertEqual([paper < 150, ink > 600, pixel < 150], [dark] * 3)
            self.assertEqual([paper > 600, ink < 150, pixel > 600], [not dark] * 3)

    def test_fits_a_phone(self):
        self.browser.look(phone=True)
        self.browser.picture("phone")
        window, page, stage = self.browser.run(
            "const { clientWidth, scrollWidth } = document.documentElement;"
            "return [innerWidth, scrollWidth - clientWidth, document.querySelector('#stage').clientWidth]")
        self.assertEqual((window, page), (PHONE[0], 0))
        self.assertGreater(stage, 0.8 * PHONE[0])
        self.drag(2, 0, -4 * stage / 32, by="touch")
        self.assertEqual(self.vertex(2), "vertex C, x 8.5, y 14.5")
        self.assertEqual(self.browser.run("return scrollY"), 0)


class InChromium(Page, unittest.TestCase):
    Browser = Chromium


class InFirefox(Page, unittest.TestCase):
    Browser = Firefox


if __name__ == "__main__":
    unittest.main()
