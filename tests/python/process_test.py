"""Edgewise beside the rest of a process: exit, signals, threads, forks, floating-point modes, progress bars, and numpy."""
import ctypes
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import edgewise
from support import CAMERA, SIZE, same, scene, stream, triangles

VIEWS = 400

FOLDER = os.path.dirname(__file__)

# Loops of threads that the interpreter's end interrupts.
LOOPS = {
    "draw on 1 thread": "mine.draw(camera, size, ids=True)",
    "draw on several threads": "mine.draw(camera, size, ids=True, threads=2 + i)",
    "draw of one scene": "shared.draw(camera, size, ids=True)",
    "progress": "mine.draw([camera] * 2, size, progress=lambda views: time.sleep(1e-4))",
    "queries": "mine.barycentrics(frame, camera), edgewise.pixel_hash(frame), edgewise.visible_triangles(frame)",
    "files": "edgewise.write_image(file, frame.payload), edgewise.read_image(file)",
    "needs": "mine.needs(camera, size)",
}
PROGRAM = """
import sys, threading, time
sys.path.insert(0, sys.argv[1])
import edgewise
from support import triangles
positions, indices, colours = triangles(1500)
shared, size = edgewise.Scene(positions, indices), (320, 240)
camera = shared.camera(4 / 3)
frame = shared.draw(camera, size, ids=True)
def loop(i):
    mine, file = edgewise.Scene(positions, indices), f"{sys.argv[2]}/{i}.png"
    while True: LOOP
for i in range(3): threading.Thread(target=loop, args=(i,), daemon=True).start()
time.sleep(0.1)
sys.exit(3)
"""


@pytest.mark.parametrize("name", LOOPS)
def test_threads_that_draw_while_python_ends_change_nothing(name, tmp_path):
    for _ in range(3):
        done = subprocess.run([sys.executable, "-c", PROGRAM.replace("LOOP", LOOPS[name]), FOLDER, tmp_path],
                              capture_output=True, text=True, check=False, timeout=60)
        assert (done.returncode, done.stdout, done.stderr) == (3, "", "")


@pytest.mark.parametrize("version", ["2.0.0rc1", "2.2.4", "10.0"])
def test_numpy_2_needs_pybind11_2_12(version):
    program = f"import numpy; numpy.__version__ = {version!r}\nimport edgewise"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    built_with = edgewise._native.PYBIND11
    if built_with >= (2, 12):
        assert done.returncode == 0
    else:
        assert f"ImportError: edgewise was built with pybind11 {built_with[0]}.{built_with[1]}" in done.stderr
        assert f"numpy {version}: install numpy below 2, or build edgewise with pybind11 2.12" in done.stderr


def slow_scene(count=10000):
    return edgewise.Scene(*triangles(count)[:2])


class Alarm(Exception):
    pass


@pytest.fixture
def views():
    """A list. Once it holds something, a signal comes whose handler raises Alarm as Ctrl-C's raises KeyboardInterrupt."""
    def handler(*_):
        raise Alarm

    def send():
        while not counts:
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGALRM)
    counts, before = [], signal.signal(signal.SIGALRM, handler)
    threading.Thread(target=send, daemon=True).start()
    yield counts
    signal.signal(signal.SIGALRM, before)


@pytest.mark.parametrize("method, triangle_count, view_count, options", [("draw", 10_000, 10 * VIEWS, {"backend": "naive"}),
                                                                         ("needs", 100, VIEWS, {})])
def test_a_signal_ends_a_batch(views, method, triangle_count, view_count, options):
    drawn = slow_scene(triangle_count)
    expected = drawn.draw(CAMERA, SIZE)
    with pytest.raises(Alarm):  # append() runs no code of Python's, which would handle the signal
        getattr(drawn, method)([CAMERA] * view_count, SIZE, progress=views.append, **options)
    assert 0 < sum(views) < view_count and same(drawn.draw(CAMERA, SIZE), expected)


def test_progress_counts_the_views():
    drawn, seen = slow_scene(), []
    frames = drawn.draw([CAMERA] * VIEWS, SIZE, progress=seen.append)
    assert sum(seen) == VIEWS and len(seen) > 1 and min(seen) > 0
    assert same(frames, drawn.draw([CAMERA] * VIEWS, SIZE, progress=None))
    assert drawn.draw(CAMERA, SIZE, progress=seen.append) and seen[-1] == 1
    drawn, cameras = scene(), [CAMERA] * 5
    frames = drawn.draw(cameras, SIZE, ids=True)
    for draws, call in ((5, lambda: drawn.barycentrics(frames, cameras, progress=seen.append)),
                        (15, lambda: drawn.amodal_masks(iter(cameras), SIZE, progress=seen.append)),
                        (15, lambda: drawn.visible_fraction(tuple(frames), iter(cameras), progress=seen.append))):
        seen.clear()
        call()
        assert sum(seen) == draws

    def fail(views):
        raise LookupError(views)
    for method in scene().draw, scene().needs:
        with pytest.raises(LookupError):
            method([CAMERA] * 2, SIZE, progress=fail)


def test_progress_and_other_threads_may_use_the_scene_between_views():
    drawn, inner = slow_scene(), []
    expected = drawn.draw(CAMERA, SIZE)

    def progress(_):
        inner.append(drawn.draw(CAMERA, SIZE))
        other = threading.Thread(target=lambda: inner.append(drawn.draw(CAMERA, SIZE, threads=2)))
        other.start()
        other.join()
    frames = drawn.draw([CAMERA] * VIEWS, SIZE, progress=progress)
    assert len(inner) > 2 and all(same(frame, expected) for frame in inner)
    assert all(same((frames.payload[i], frames.depth[i]), expected) for i in range(VIEWS))


def hash_of(drawn, threads=2):
    return edgewise.pixel_hash(drawn.draw(CAMERA, SIZE, ids=True, threads=threads))


def test_a_forked_child_draws_while_a_thread_of_its_parent_draws():
    idle, busy, done = slow_scene(20_000), slow_scene(20_000), threading.Event()
    expected = hash_of(idle)

    def draw():
        while not done.is_set():
            busy.draw([CAMERA] * 4, SIZE, threads=2)
    thread = threading.Thread(target=draw)
    thread.start()
    try:
        for _ in range(10):
            for drawn in (lambda: idle, lambda: busy, lambda: slow_scene(20_000)):
                child = os.fork()
                if child == 0:
                    signal.alarm(60)
                    os._exit(hash_of(drawn()) != expected)
                assert os.waitpid(child, 0)[1] == 0  # the number of SIGALRM if it hangs
    finally:
        done.set()
        thread.join()


# A process of its own, in which no other test has drawn. It lets oneTBB have 8 threads, so that a child that used oneTBB would
# start those that its parent did not need.
FORKING = """
import ctypes, os, signal, sys
sys.path.insert(0, sys.argv[1])
from support import CAMERA, SIZE, triangles
import edgewise, edgewise.lab
ctypes.CDLL("libtbb.so.12")._ZN3tbb6detail2r16createERNS0_2d114global_controlE((ctypes.c_size_t * 3)(8))
drawn = edgewise.Scene(*triangles(3000)[:2])
works = {"draw": lambda threads: drawn.draw(CAMERA, SIZE, threads=threads), "needs": lambda threads: drawn.needs(CAMERA, SIZE, threads=threads)}
works[sys.argv[2]](2)
child = os.fork()
if child == 0:
    signal.alarm(60)
    works[sys.argv[3]](6)
    os._exit(len(os.listdir("/proc/self/task")))
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


# _native and _lab have a copy of the library each.
@pytest.mark.parametrize("parent, child", [("needs", "draw"), ("draw", "needs"), ("draw", "draw")])
def test_a_child_has_one_thread_whichever_extension_its_parent_used(parent, child):
    command = [sys.executable, "-c", FORKING, FOLDER, parent, child]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "1\n"


@pytest.mark.skipif(os.uname().machine != "x86_64", reason="the numbers are those of x86-64")
@pytest.mark.parametrize("mode", [0x400, 0x800, 0xC00])
def test_the_rounding_mode_changes_nothing_and_is_kept(mode):
    libm = ctypes.CDLL("libm.so.6")
    drawn, triangle_stream = scene(), stream()

    def numbers():
        uv, distance = drawn.barycentrics(drawn.draw(CAMERA, SIZE, ids=True), CAMERA)
        return [hash_of(drawn), edgewise.pixel_hash(triangle_stream.draw()), uv, distance, edgewise.perspective(0.7, 1.3, 0.1, 9),
                repr(triangle_stream.needs())]
    expected = numbers()
    libm.fesetround(mode)
    try:
        found = numbers()
        assert libm.fegetround() == mode
    finally:
        libm.fesetround(0)
    assert all(map(np.array_equal, found, expected))
