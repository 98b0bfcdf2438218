"""No include points up: which folder may include which others (the rooms of README's map)."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# A public header belongs to the room that implements it. Those not named here belong to no room.
ROOM_OF = {"backend.h": "raster", "barycentrics.h": "queries", "builtin.h": "scene", "camera.h": "scene", "draw.h": "draw.cpp",
           "execution.h": "core", "framebuffer.h": "raster",
           "frontend.h": "frontend", "hash.h": "raster", "image.h": "files", "obj_file.h": "files", "scene.h": "scene",
           "simd_target.h": "core", "tri_file.h": "scene", "visible.h": "queries",
           **dict.fromkeys(["contract.h", "cxx20.h", "edgewise.h", "limits.h", "screen_triangle.h"])}  # of no room
# A room, or one public header of a room.
BELOW = {
    "src/core": [],
    "src/scene": ["core"],
    "src/frontend": ["core", "edgewise/scene.h"],
    "src/raster": ["core"],
    "src/queries": ["core", "edgewise/scene.h", "frontend", "edgewise/framebuffer.h"],
    "src/image": ["core", "edgewise/framebuffer.h", "edgewise/image.h"],
    "src/files": ["core", "scene", "image", "edgewise/frontend.h", "edgewise/framebuffer.h"],
    "src/draw.cpp": ["core", "scene", "frontend", "raster"],
    "src/c_api.cpp": ["core", "scene", "frontend", "raster", "draw.cpp", "queries"],
    "src/python": ["core", "scene", "image", "files", "frontend", "raster", "draw.cpp", "queries", "lab"],
    "src/lab": ["core", "scene", "frontend", "raster", "draw.cpp"],
    "src/support": ["core", "scene", "image", "files", "edgewise/backend.h", "edgewise/frontend.h"],
    "src/viewer": ["core", "scene", "image", "files", "frontend", "raster", "lab", "support"],
    "src/web": ["core", "scene", "frontend", "raster", "lab"],
    "bench": ["core", "scene", "image", "files", "frontend", "raster", "draw.cpp", "lab", "support"],
    "src/cli": ["core", "scene", "image", "files", "frontend", "raster", "draw.cpp", "lab", "support", "viewer"],
    "src/program": ["core", "cli", "viewer"],
}
PUBLIC_BELOW = {  # what the public headers of a room include
    "scene": [], "files": ["edgewise/scene.h", "edgewise/framebuffer.h"], "frontend": ["edgewise/scene.h"],
    "queries": ["edgewise/scene.h", "edgewise/frontend.h", "edgewise/framebuffer.h"],
    "draw.cpp": ["edgewise/backend.h", "edgewise/frontend.h", "edgewise/scene.h"],
}
FILLS = ["kernels.h", "frame_lanes-inl.h", "tile_store-inl.h"]  # shared by the rooms of fills
ROOMS_BELOW = {  # inside src/raster: rooms and headers
    "simd": [],
    "binning": ["simd"],
    "spans": ["simd", "binning", *FILLS],
    "edges": ["simd", "binning", *FILLS],
}


def included(source):
    return re.findall(r'^#include "([^"]+\.h)"', source.read_text(), re.MULTILINE)


def sources(place):
    paths = [ROOT / place, *(ROOT / place).rglob("*")]
    return [path for path in paths if path.suffix in (".h", ".cpp")]


def room_of(header):
    """None for a public header that belongs to no room."""
    layer, name = header.split("/", 1)
    return ROOM_OF.get(name) if layer == "edgewise" else layer


class Layers(unittest.TestCase):
    def check(self, source, room, below):
        for header in included(source):
            if header not in below:
                self.assertIn(room_of(header), {*below, room, None}, f"{source.relative_to(ROOT)} includes {header}")

    def test_everything_has_its_layer(self):
        self.assertEqual({path.name for path in (ROOT / "src/edgewise").glob("*.h")}, set(ROOM_OF))
        self.assertEqual({path.name for path in (ROOT / "src").iterdir()} - {"package", "edgewise", "CMakeLists.txt"},
                         {Path(place).name for place in BELOW} - {"bench"})

    def test_no_include_points_up(self):
        for place, below in BELOW.items():
            for source in sources(place):
                self.check(source, Path(place).name, below)

    def test_no_public_include_points_up(self):
        for source in sources("src/edgewise"):
            room = ROOM_OF.get(source.name)
            self.check(source, room, ["core", *PUBLIC_BELOW.get(room, [])])

    def test_rooms_of_raster_know_only_lower_ones(self):
        for room, below in ROOMS_BELOW.items():
            for source in sources(f"src/raster/{room}"):
                for header in included(source):
                    layer, *path = header.split("/")
                    if layer == "raster":
                        self.assertIn(path[0], {*below, room}, f"{source.relative_to(ROOT)} includes {header}")


if __name__ == "__main__":
    unittest.main()
