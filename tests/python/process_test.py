"""Edgewise beside the rest of a process: its exit, signals, other threads, progress bars, and numpy."""
import os
import signal
import subprocess
import sys
import threading
import time

import pytest

import edgewise
from support import CAMERA, SIZE, same, scene, triangles

VIEWS = 400

# Loops of threads that the interpreter's end interrupts.
LOOPS = {
    "draw on 1 thread": "mine.draw(camera, size, ids=True)",
    "draw on 2 threads": "mine.draw(camera, size, ids=True, threads=2)",
    "draw on 3 threads": "mine.draw(camera, size, ids=True, threads=3)",
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
        done = subprocess.run([sys.executable, "-c", PROGRAM.replace("LOOP", LOOPS[name]), __file__.rpartition("/")[0], tmp_path],
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
    positions, indices, _ = triangles(count)
    return edgewise.Scene(positions, indices)


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


# append() runs no code of Python's, which would handle the signal.
def test_a_signal_ends_a_batch_of_draws(views):
    drawn = slow_scene()
    expected = drawn.draw(CAMERA, SIZE)
    with pytest.raises(Alarm):
        drawn.draw([CAMERA] * 10 * VIEWS, SIZE, backend="naive", progress=views.append)
    assert 0 < sum(views) < 10 * VIEWS and same(drawn.draw(CAMERA, SIZE), expected)


def test_a_signal_ends_needs(views):
    drawn = slow_scene(100)
    with pytest.raises(Alarm):
        drawn.needs([CAMERA] * VIEWS, SIZE, progress=views.append)
    assert 0 < sum(views) < VIEWS and list(drawn.first_ids()) == [0, 100]


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
