"""Forks and floating-point modes of the process that imports the package."""
import ctypes
import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
from support import CAMERA, SIZE, scene, stream, triangles

import edgewise


def hash_of(drawn, threads=2):
    return edgewise.pixel_hash(drawn.draw(CAMERA, SIZE, ids=True, threads=threads))


def status_of_child(check):
    """0 if the child finds check() true, the number of SIGALRM if it hangs."""
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        os._exit(0 if check() else 1)
    return os.waitpid(child, 0)[1]


def many():
    positions, indices, _ = triangles(20_000)
    return edgewise.Scene(positions, indices)


def test_a_forked_child_draws_while_a_thread_of_its_parent_draws():
    idle, busy, done = many(), many(), threading.Event()
    expected = hash_of(idle)

    def draw():
        while not done.is_set():
            busy.draw([CAMERA] * 4, SIZE, threads=2)
    thread = threading.Thread(target=draw)
    thread.start()
    try:
        for _ in range(10):
            for drawn in (lambda: idle, lambda: busy, many):
                assert status_of_child(lambda: hash_of(drawn()) == expected) == 0
    finally:
        done.set()
        thread.join()


# A process of its own, in which no other test has drawn. It lets oneTBB have 8 threads, so that a child that used oneTBB would
# start those that its parent did not need.
PROGRAM = """
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
    command = [sys.executable, "-c", PROGRAM, os.path.dirname(__file__), parent, child]
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
