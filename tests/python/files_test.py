"""Files, and what the program says of the same input. EDGEWISE_PROGRAM is the program."""
import json
import os
import re
import subprocess

import numpy as np
import pytest

import edgewise
import edgewise.lab
from support import ASPECT, CAMERA, SIZE, same, scene, stream

WIDTH, HEIGHT = SIZE
OBJ = "v -1 -1 0\nv 1 -1 0.2\nv 1 1 0\nv -1 1 -0.2\nv 0 0 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"


def program(*arguments, status=0):
    if "EDGEWISE_PROGRAM" not in os.environ:
        pytest.skip("EDGEWISE_PROGRAM is not set")
    done = subprocess.run([os.environ["EDGEWISE_PROGRAM"], *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode == status, done.stderr
    return done.stdout


@pytest.fixture
def obj(tmp_path):
    path = tmp_path / "pyramid.obj"
    path.write_text(OBJ)
    return path


@pytest.fixture
def tri(tmp_path):
    path = tmp_path / "stream.tri"
    stream().write_tri(path)
    return path


@pytest.mark.parametrize("extension", ["png", "ppm"])
def test_pictures_come_back(tmp_path, extension):
    colours = scene().draw(CAMERA, SIZE).payload
    path = tmp_path / f"picture.{extension}"
    edgewise.write_image(path, colours)
    assert np.array_equal(edgewise.read_image(str(path)), colours)
    bytes_of = np.ascontiguousarray(colours).view(np.uint8).reshape(HEIGHT, WIDTH, 4)
    for channels in (3, 4):
        edgewise.write_image(path, bytes_of[..., :channels])
        assert np.array_equal(edgewise.read_image(path), colours)


@pytest.mark.parametrize("exact, magic, size", [(False, b"TRI1", 40), (True, b"TRI2", 76)])
def test_a_stream_comes_back_and_is_drawn_as_by_the_program(tmp_path, exact, magic, size):
    path, vertices = tmp_path / "a.tri", stream().vertices.astype(np.float64) + exact * 2.0**-30
    drawn = edgewise.Stream(vertices, SIZE, colours=stream().colours, exact=exact)
    drawn.write_tri(path)
    assert path.read_bytes()[:4] == magic and path.stat().st_size == 16 + size * len(vertices)
    again = edgewise.Stream.read_tri(path)
    assert again.size == SIZE and np.array_equal(again.vertices, vertices) and np.array_equal(again.colours, drawn.colours)
    for bits in (8, 15):
        frame = drawn.draw(subpixel_bits=bits)
        assert same(frame, again.draw(subpixel_bits=bits))
        assert program("hash", path, "--subpixel-bits", bits).split()[0] == f"{edgewise.pixel_hash(frame):016x}"
    program("render", path, "--payload", "id", "-o", tmp_path / "ids.png")
    assert np.array_equal(edgewise.read_image(tmp_path / "ids.png"), edgewise.id_colours(drawn.draw(ids=True).payload))


def test_an_obj_file_is_drawn_as_by_the_program(obj, tmp_path):
    drawn = edgewise.Scene.read_obj(obj)
    assert list(drawn.first_ids()) == [0, 4]
    colours = drawn.draw(drawn.camera(ASPECT), SIZE, cull="back").payload
    program("render", obj, "--size", f"{WIDTH}x{HEIGHT}", "-o", tmp_path / "program.png")
    difference = edgewise.diff(tmp_path / "program.png", colours)
    assert difference.differing <= 3  # the program's camera is rounded to float
    assert (colours != edgewise.BLACK).sum() > 500


def test_objects_give_masks(obj):
    obj.write_bytes(OBJ.replace("f 1", "o front #1\ng all\nf 1", 1).replace("f 3", "o r\u00fcck\ng\nf 3").encode() +
                    b"o \xff\nf 4 1 5\n")
    drawn = edgewise.Scene.read_obj(obj)
    objects = drawn.objects()
    assert {name: list(ids) for name, ids in objects.items()} == {
        "all": [0, 1], "front #1": [0, 1], "r\u00fcck": [2, 3], "\udcff": [4]}
    drawn.add_instance(0, np.diag([0.5, 0.5, 0.5, 1.0]))
    assert list(drawn.objects()["front #1"]) == [0, 1, 5, 6]
    frame = drawn.draw(drawn.camera(ASPECT), SIZE, ids=True)
    mask = np.isin(frame.payload, objects["front #1"])
    assert mask.any() and np.array_equal(mask, frame.payload <= 1)
    assert scene().objects() == {}


def test_what_an_obj_file_lacks_is_a_warning_also_if_its_name_is_not_utf8(obj):
    obj.write_bytes(b"mtllib caf\xe9.mtl\nusemtl red\n" + OBJ.encode())
    with pytest.warns(UserWarning, match="caf"):
        edgewise.Scene.read_obj(obj)


READERS = {"obj": edgewise.Scene.read_obj, "tri": edgewise.Stream.read_tri, "png": edgewise.read_image, "pfm": edgewise.read_pfm}


@pytest.mark.parametrize("extension", READERS)
def test_a_file_that_cannot_be_read_is_an_os_error(tmp_path, extension):
    path, read = tmp_path / f"file.{extension}", READERS[extension]
    with pytest.raises(FileNotFoundError, match=f"file.{extension}") as missing:
        read(path)
    assert missing.value.filename == str(path)
    with pytest.raises(IsADirectoryError):
        read(tmp_path)
    os.mkfifo(path)
    with pytest.raises(OSError, match="not a regular file"):  # without opening it, which would wait for a writer
        read(path)
    path.unlink()
    path.write_bytes(b"?")
    with pytest.raises(OSError, match=f"file.{extension}"):
        read(path)


# The same number stands for another pipe each time.
def test_a_pipe_is_read_when_its_descriptor_is_named():
    for z in (1, 2):
        pipe, end = os.pipe()
        os.write(end, OBJ.encode() + f"v 0 0 {z}\nf 1 2 6\n".encode())
        os.close(end)
        assert edgewise.Scene.read_obj(f"/dev/fd/{pipe}").bounds()[1][2] == z
        os.close(pipe)


def test_16_bit_grey_comes_back(tmp_path):
    grey, path = np.arange(65536, dtype=np.uint16).reshape(256, 256), tmp_path / "grey.png"
    edgewise.write_image(path, grey)
    back = edgewise.read_image(path)
    assert back.dtype == np.uint16 and np.array_equal(back, grey)
    difference = edgewise.diff(path, grey + np.uint16(1))
    assert (difference.differing, difference.largest, difference.scale) == (65536, 65535, 65535)  # 65535 + 1 is 0


def test_8_bits_equal_the_same_values_of_16():
    deep = np.arange(256, dtype=np.uint16)[None] * np.uint16(257)
    colours = np.repeat(np.arange(256, dtype=np.uint8)[None, :, None], 3, axis=-1)
    assert edgewise.diff(deep, colours).differing == 0
    deep[0, 7] ^= 1
    difference = edgewise.diff(deep, colours)
    assert (difference.differing, difference.largest, difference.first) == (1, 1, (7, 0))


@pytest.mark.parametrize("dtype", "?bBhilqLQefdFOSUm")
def test_other_types_are_no_pictures(tmp_path, dtype):
    array = np.zeros((2, 5), dtype)
    with pytest.raises(ValueError, match=re.escape(f"not {array.dtype} of shape (2, 5)")):
        edgewise.write_image(tmp_path / "a.png", array)
    said = "cannot be compared" if array.dtype.kind == "f" else re.escape(f"not {array.dtype} of shape (2, 5)")
    with pytest.raises(ValueError, match=said):
        edgewise.diff(np.zeros((2, 5), np.uint32), array)
    assert list(tmp_path.iterdir()) == []


def test_floats_of_three_channels(tmp_path):
    path = tmp_path / "a.pfm"
    values = np.arange(12, dtype=np.float32).reshape(2, 2, 3) / 8
    path.write_bytes(b"PF\n2 2\n-1.0\n" + values[::-1].astype("<f4").tobytes())
    assert np.array_equal(edgewise.read_pfm(path), values)
    assert edgewise.diff(path, values).differing == 0 and edgewise.diff(path, np.full_like(values, np.nan)).largest == np.inf


def test_a_png_without_its_end_is_a_warning(tmp_path):
    path = tmp_path / "a.png"
    edgewise.write_image(path, np.zeros((2, 2), np.uint32))
    path.write_bytes(path.read_bytes()[:-12])
    with pytest.warns(UserWarning, match="ends after its pixels") as warned:
        edgewise.read_image(path)
        edgewise.diff(path, path)
    assert [w.filename for w in warned] == [__file__] * 3


def test_a_file_that_cannot_be_written_is_an_os_error(tmp_path):
    colours, depth = np.zeros((2, 2), np.uint32), np.zeros((2, 2), np.float32)
    for write in (lambda: edgewise.write_image(tmp_path / "a.gif", colours), lambda: edgewise.write_image(tmp_path / "no/a.png", colours),
                  lambda: edgewise.write_pfm(tmp_path / "no/a.pfm", depth), lambda: stream().write_tri(tmp_path / "no/a.tri")):
        with pytest.raises(OSError, match=str(tmp_path)):
            write()
    with pytest.raises(FileNotFoundError):
        edgewise.write_image(tmp_path / "no/a.png", colours)
    with pytest.raises(ValueError, match="uint32"):
        edgewise.write_pfm(tmp_path / "a.pfm", colours)
    with pytest.raises(ValueError, match="size"):
        edgewise.Stream(np.zeros((1, 3, 3)), (0, 5)).write_tri(tmp_path / "a.tri")
    assert list(tmp_path.iterdir()) == []


def test_diff_says_what_the_program_says(tmp_path):
    a = scene().draw(CAMERA, SIZE).payload
    b = a.copy()
    b[7, 5] ^= 0x30
    b[9, 2] ^= 0x10000
    mask = np.zeros((HEIGHT, WIDTH), bool)
    mask[9] = True
    paths = [tmp_path / name for name in ("a.png", "b.ppm", "mask.png")]
    for path, picture in zip(paths, (a, b, np.where(mask, np.uint32(0xFF0000FF), np.uint32(edgewise.BLACK)))):
        edgewise.write_image(path, picture)
    for chosen in (None, mask):
        of_arrays, of_files = edgewise.diff(a, b, chosen), edgewise.diff(*paths[:2], None if chosen is None else paths[2])
        assert of_arrays[:-2] == of_files[:-2] and np.array_equal(of_arrays.picture, of_files.picture)
        said = json.loads(program("diff", *paths[:2], "--json", *(() if chosen is None else ("--mask", paths[2])), status=1))
        assert (said["differing"], said["largest"], said["scale"], tuple(said["first"])) == \
            (of_arrays.differing, of_arrays.largest, of_arrays.scale, of_arrays.first)
        assert (said.get("masked", 0), said.get("differing_in_mask", 0)) == (of_arrays.masked, of_arrays.differing_in_mask)
    assert edgewise.diff(a, b).first == (5, 7) and edgewise.diff(a, b).differing == 2
    assert edgewise.diff(a, b, mask)[:1] == (1,) and edgewise.diff(a, b, mask).masked == WIDTH
    colours = edgewise.read_image(paths[2])
    for picture in (colours, colours[..., None].view(np.uint8), colours[..., None].view(np.uint8)[..., :3]):
        assert edgewise.diff(a, b, picture)[:-2] == edgewise.diff(a, b, mask)[:-2]
    assert edgewise.diff(a, a).first is None and edgewise.diff(a, a).differing == 0
    assert edgewise.diff(a, a ^ np.uint32(0x07000000)).differing_in_alpha == WIDTH * HEIGHT


def test_depth_maps_come_back_and_are_compared(tmp_path):
    a = edgewise.depth01(scene().draw(CAMERA, SIZE).depth)
    b = a.copy()
    b[3, 4] -= 0.25
    edgewise.write_pfm(tmp_path / "a.pfm", a)
    assert np.array_equal(edgewise.read_pfm(tmp_path / "a.pfm"), a.astype(np.float32))
    difference = edgewise.diff(tmp_path / "a.pfm", b)
    assert (difference.differing, difference.first, difference.scale) == (1, (4, 3), 1)
    assert difference.largest == pytest.approx(0.25, abs=1e-6)
    assert edgewise.diff(a, b, np.ones(a.shape)).differing_in_mask == 1


def test_options_reach_the_library(tri):
    drawn, sides = stream(), ("back", "front")
    sets = [{}, {"bits": 4}, {"ulps": 1000}, {"guard_band": 5}, {"depth": "d16_unorm"}, *({"cull": side} for side in sides)]
    found = [drawn.portable(**options).reasons.tobytes() for options in sets]
    assert all(found.count(one) == 1 for one in found)
    assert drawn.needs(displacement=0) != drawn.needs() != drawn.needs(displacement=10**6)
    assert drawn.needs(cull="back") != drawn.needs(cull="front")
    for side in sides:
        with pytest.raises(ValueError, match="does not cover"):
            drawn.barycentrics(drawn.draw(ids=True), cull=side)


def test_needs_of_a_stream_are_the_programs(tri):
    found = stream().needs(threads=2)
    said = json.loads(program("needs", tri, "--json", "--threads", 2))
    assert found.frames == said["frames"] == 1 and found.reach == {}
    assert list(found.minima) == said["minima"] and found.closest == (said.get("closest") and tuple(said["closest"].values()))
    assert len(found.edges) == len(said["edges"])
    for ours, q in zip(found.edges, said["edges"]):
        assert (ours.name, ours.answer, ours.proof, ours.error) == (q["question"], q["answer"], q.get("proof"), q["error"])
        for answer, a in zip(ours.answers, q["answers"]):
            w = a.get("witness")
            assert answer.name == a["answer"] and answer.witness == (
                w and (w["frame"], w["x_px"], w["y_px"], tuple(w["right"]), tuple(w["drawn"])))
    keys = "level", "mean_px", "worst_px", "hidden_px", "farthest_px"
    assert {stage: [level[:-1] for level in levels] for stage, levels in found.curves.items()} == {
        curve["stage"]: [tuple(level[key] for key in keys) for level in curve["levels"]] for curve in said["curves"]}
    assert len(found.edge_value_bits) == 17


def test_portable_pixels_of_a_stream_are_the_programs(tri):
    found = stream().portable(bits=4, depth="d16_unorm")
    said = json.loads(program("portable", tri, "--bits", 4, "--depth", "d16_unorm", "--json"))
    assert found.reasons.shape == (HEIGHT, WIDTH) and found.reasons.dtype == np.uint8
    assert {reason: found.counts[reason] for reason in edgewise.lab.UNSTABLE[1:]} == said["reasons"]
    assert sum(found.counts.values()) == WIDTH * HEIGHT
    assert found.counts["edge"] == (found.reasons == edgewise.lab.UNSTABLE.index("edge")).sum() > 0


def test_the_laboratory_says_of_a_scene_what_the_program_says(obj):
    drawn = edgewise.Scene.read_obj(obj)
    needs = drawn.needs([drawn.camera(48 / 32)] * 2, (48, 32), cull="back", threads=2)
    assert needs.frames == 2 and set(needs.reach) == {"near plane", "far plane", "guard band"}
    assert list(needs.minima) == json.loads(program("needs", obj, "--json", "--size", "48x32"))["minima"]
    camera = drawn.camera(ASPECT)
    found = drawn.portable(camera, SIZE, cull="back")
    said = json.loads(program("portable", obj, "--size", f"{WIDTH}x{HEIGHT}", "--json"))
    assert abs(found.counts["edge"] - said["reasons"]["edge"]) <= 2  # the program's camera is rounded to float
    ids = drawn.draw(camera, SIZE, ids=True, cull="back").payload
    masked = edgewise.diff(edgewise.id_colours(ids), edgewise.id_colours(ids + 1), found.reasons)
    unstable = found.reasons.size - found.counts["portable"]
    assert (masked.masked, masked.differing_in_mask) == (unstable, unstable) and unstable > 0
