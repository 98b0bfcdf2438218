#!/usr/bin/env python3
"""Runs `edgewise view` in a window under Xvfb, with key presses and mouse drags, and in a terminal under tmux. Compares
the pictures shown with those that the same keys give without a window.

usage: viewer_smoke_test.py EDGEWISE
Exits with 77, which ctest counts as skipped, if a required program is missing."""
import os
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PATIENCE_S = 60  # only a failure waits so long
SKIPPED = 77


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        result = condition()
        if result:
            return result
        time.sleep(0.02)
    raise AssertionError(f"waited {PATIENCE_S} s for {what}")


class Viewer(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))


class Window(Viewer):
    SIZE = "900x600"

    def setUp(self):
        super().setUp()
        read, write = os.pipe()
        server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1000x700x24", "-fbdir", self.folder,
                                   "-nolisten", "tcp"], pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        os.close(write)
        # libdbus, which SDL uses, keeps memory until exit; the leak sanitizer must ignore it.
        known_leaks = self.folder / "known_leaks"
        known_leaks.write_text("leak:libdbus-1.so\n")
        with os.fdopen(read) as display:
            self.environment = {**os.environ, "DISPLAY": ":" + display.readline().strip(), "SDL_VIDEODRIVER": "x11",
                                "LSAN_OPTIONS": f"suppressions={known_leaks}:print_suppressions=0"}
        self.saved = self.folder / "saved"
        self.program = subprocess.Popen(
            [EDGEWISE, "view", "cube", "--keys", "o", "--save-to", self.saved, "--size", self.SIZE],
            env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.program.communicate)
        self.addCleanup(self.program.kill)
        self.window = self.xdo("search", "--sync", "--onlyvisible", "--name", "edgewise: cube").split()[0]
        self.xdo("windowfocus", "--sync", self.window)

    def xdo(self, *words):
        return subprocess.run(["xdotool", *words], env=self.environment, check=True, capture_output=True, text=True,
                              timeout=PATIENCE_S).stdout

    def shown(self):
        """The window's width, height, and pixels, from the server's framebuffer, a file in the format of xwd."""
        words = self.xdo("getwindowgeometry", "--shell", self.window).split()
        place = {key: int(value) for key, value in (word.split("=") for word in words)}
        width, height = place["WIDTH"], place["HEIGHT"]
        data = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", data[:100])
        size, line, colours = header[0], header[12], header[19]
        rgb = bytearray(3 * width * height)
        for row in range(height):  # blue, green, red, unused
            pixels = data[size + 12 * colours + (place["Y"] + row) * line + 4 * place["X"]:][:4 * width]
            for channel in range(3):
                rgb[3 * width * row + channel:3 * width * (row + 1):3] = pixels[2 - channel::4]
        return width, height, bytes(rgb)

    def expect(self, keys, size=SIZE):
        """Waits until the window shows what these keys lead to without a window."""
        path = self.folder / "expected.ppm"
        subprocess.run([EDGEWISE, "view", "cube", "--size", size, "--keys", keys, "-o", path], check=True)
        width, height = map(int, size.split("x"))
        expected = width, height, path.read_bytes()[-3 * width * height:]
        wait_for(lambda: self.shown() == expected, f"what {keys} leads to at {size}")
        return expected

    def test_keys_mouse_sizes_and_files(self):
        # The key o hides the panel and its times, which differ. The help has none.
        home = self.expect("o")
        self.xdo("key", "1", "2")
        self.assertNotEqual(self.expect("o12"), home)
        self.xdo("key", "2", "1", "h")
        self.expect("h")
        self.xdo("key", "h", "o", "v", "Tab", "z", "BackSpace", "BackSpace")
        self.expect("ov<tab>z<backspace><backspace>")
        self.xdo("key", "v", "v", "7")
        self.expect("o7")
        self.xdo("key", "7")
        self.expect("o")

        # A drag turns the view, a held key moves the camera, and 0 resets both.
        self.xdo("mousemove", "--window", self.window, "300", "200", "mousedown", "1", "mousemove", "--window",
                 self.window, "360", "180", "mouseup", "1")
        wait_for(lambda: self.shown() != home, "the view to turn")
        self.xdo("key", "0")
        self.expect("o")
        self.xdo("keydown", "w")
        wait_for(lambda: self.shown() != home, "the camera to move")
        self.xdo("keyup", "w")
        self.xdo("key", "0")
        self.expect("o")

        for size in ("320x200", "801x503"):
            self.xdo("windowsize", "--sync", self.window, *size.split("x"))
            self.expect("o", size)

        self.xdo("key", "p")
        stream = wait_for(lambda: [*self.saved.glob("*.tri")], "files")[0]
        again = self.folder / "again.png"
        for command in (["render", stream, "-o", again], ["diff", again, stream.with_suffix(".png")], ["verify", stream],
                        ["accuracy", stream]):
            subprocess.run([EDGEWISE, *command], stdout=subprocess.DEVNULL, check=True)

        self.xdo("windowsize", "--sync", self.window, "900", "600")
        self.expect("o")
        self.xdo("key", "o", "h")
        self.expect("h")
        self.xdo("mousemove", "--window", self.window, "812", "583", "click", "1")  # the panel's button "quit"
        out, err = self.program.communicate(timeout=PATIENCE_S)
        self.assertEqual((self.program.returncode, err), (0, ""))
        self.assertEqual(out.split(), [str(stream.with_suffix(".png")), str(stream)])

    def test_interruption(self):
        self.program.send_signal(signal.SIGINT)
        self.assertEqual(self.program.wait(PATIENCE_S), 128 + signal.SIGINT)


class NoDisplay(Viewer):
    def test_is_said(self):
        nowhere = {key: value for key, value in os.environ.items()
                   if key not in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")}
        result = subprocess.run([EDGEWISE, "view"], env=nowhere, capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(result.returncode, 2)
        self.assertIn("--terminal", result.stderr)


class Terminal(Viewer):
    def setUp(self):
        super().setUp()
        self.server = ["tmux", "-S", str(self.folder / "tmux"), "-f", "/dev/null"]
        subprocess.run([*self.server, "new-session", "-d", "-x", "90", "-y", "30",
                        f"PS1='ready> ' EDGEWISE={shlex.quote(EDGEWISE)} bash --norc --noprofile"], check=True)
        self.addCleanup(subprocess.run, [*self.server, "kill-server"])
        self.seen("ready>")
        self.type("echo be''fore; stty -g", "Enter")
        self.seen("before")
        self.mode = wait_for(self.line_after("before"), "stty")

    def type(self, *words):
        subprocess.run([*self.server, "send-keys", *words], check=True)

    def text(self, *flags):
        return subprocess.run([*self.server, "capture-pane", "-pJ", *flags], check=True, capture_output=True,
                              text=True).stdout

    def seen(self, words):
        wait_for(lambda: words in self.text(), words)

    def line_after(self, words):
        def find():
            lines = self.text().splitlines()
            return words in lines and lines[lines.index(words) + 1]
        return find

    def start(self, command, first):
        # Where a typed line ends in the last column, tmux joins the next one to it: its length may not depend on a path.
        self.type(f'"$EDGEWISE" {command} --terminal; echo status $?; stty -g', "Enter")
        self.seen(first)

    def resize(self, columns, rows):
        subprocess.run([*self.server, "resize-window", "-x", str(columns), "-y", str(rows)], check=True)

    def expect_all_as_before(self, status):
        self.seen(f"status {status}")
        self.seen("before")
        self.assertEqual(wait_for(self.line_after(f"status {status}"), f"stty in:\n{self.text()}"), self.mode)
        self.assertIn("cursor 1", subprocess.run([*self.server, "display-message", "-p", "cursor #{cursor_flag}"],
                                                 check=True, capture_output=True, text=True).stdout)
        self.type("clear; echo be''fore", "Enter")
        wait_for(lambda: "status" not in self.text(), "a clear screen")

    def test_keys_sizes_and_ends(self):
        self.start("demo outlaw-triad", "1/4 A quad is kept")
        self.type("5")
        self.seen("2/4 [r] rotates")
        self.type("C-c")
        self.expect_all_as_before(130)
        self.start("view cube", "[h] help")
        self.seen("tiled")
        colours = self.text("-e")
        self.assertIn("\u2580", colours)
        self.assertIn("38;2;", colours)
        for keys, words in ((("b", "b"), "float_lt"), (("BSpace",), "float_le"), (("h",), "edgewise view --help"),
                            (("h",), "gaps: 0")):
            self.type(*keys)
            self.seen(words)
        self.resize(24, 8)
        wait_for(lambda: "float_le" in self.text() and "gaps" not in self.text(), "a narrow screen")
        self.resize(90, 30)
        self.seen("gaps: 0")
        self.type("Escape")
        self.expect_all_as_before(0)


if __name__ == "__main__":
    EDGEWISE = sys.argv.pop(1)
    missing = [tool for tool in ("Xvfb", "xdotool", "tmux") if shutil.which(tool) is None]
    if "without SDL2" in subprocess.run([EDGEWISE, "view"], env={**os.environ, "SDL_VIDEODRIVER": "none"},
                                        capture_output=True, text=True).stderr:
        missing.append("SDL2 and Dear ImGui, when this was built,")
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (scripts/packages.txt: viewer, test)")
        sys.exit(SKIPPED)
    unittest.main()
