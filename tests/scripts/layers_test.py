"""No include points up: which folder may include which others (the rooms of README's map)."""
import re
import unittest

from support import ROOT

# A public header belongs to the room that implements it. All rooms may include those of the room "edgewise".
ROOM_OF = {"backend.h": "raster", "barycentrics.h": "queries", "builtin.h": "scene", "camera.h": "scene", "draw.h": "draw.cpp",
           "execution.h": "core", "framebuffer.h": "raster",
           "frontend.h": "frontend", "hash.h": "raster", "image.h": "files", "obj_file.h": "files", "scene.h": "scene",
           "simd_target.h": "core", "tri_file.h": "scene", "visible.h": "queries",
           **dict.fromkeys(["contract.h", "cxx20.h", "edgewise.h", "limits.h", "screen_triangle.h"], "edgewise")}
FILLS = ["raster/kernels.h", "raster/frame_lanes-inl.h", "raster/tile_store-inl.h"]  # shared by the rooms of fills
BELOW = {  # rooms, or one header of a room
    "edgewise": ["core"],
    "core": [],
    "scene": ["core"],
    "frontend": ["core", "edgewise/scene.h"],
    "raster/simd": ["core"],
    "raster/binning": ["core", "raster/simd"],
    "raster/spans": ["core", "raster/simd", "raster/binning", *FILLS],
    "raster/edges": ["core", "raster/simd", "raster/binning", *FILLS],
    "raster": ["core"],
    "queries": ["core", "edgewise/scene.h", "frontend", "edgewise/framebuffer.h"],
    "image": ["core", "edgewise/framebuffer.h", "edgewise/image.h"],
    "files": ["core", "scene", "image", "edgewise/frontend.h", "edgewise/framebuffer.h"],
    "draw.cpp": ["core", "scene", "frontend", "raster"],
    "c_api.cpp": ["core", "scene", "frontend", "raster", "draw.cpp", "queries"],
    "python": ["core", "scene", "image", "files", "frontend", "raster", "draw.cpp", "queries", "lab"],
    "lab": ["core", "scene", "frontend", "raster", "draw.cpp"],
    "support": ["core", "scene", "image", "files", "edgewise/backend.h", "edgewise/frontend.h"],
    "viewer": ["core", "scene", "image", "files", "frontend", "raster", "lab", "support"],
    "web": ["core", "scene", "frontend", "raster", "lab"],
    "bench": ["core", "scene", "image", "files", "frontend", "raster", "draw.cpp", "lab", "support"],
    "cli": ["core", "scene", "image", "files", "frontend", "raster", "draw.cpp", "lab", "support", "viewer"],
    "program": ["core", "cli", "viewer"],
}


def inside(path, room):
    return f"{path}/".startswith(f"{room}/")


def room_of(path):
    """Of a source below src/, or of a header as it is included: the innermost room."""
    if path.startswith("edgewise/"):
        return ROOM_OF[path.removeprefix("edgewise/")]
    return max((room for room in BELOW if inside(path, room)), key=len, default=path)


class Layers(unittest.TestCase):
    def test_no_include_points_up(self):
        for source in [*ROOT.glob("src/**/*.*"), *ROOT.glob("bench/**/*.*")]:
            if source.suffix in (".h", ".cpp"):
                path = source.relative_to(ROOT).as_posix().removeprefix("src/")
                room = room_of(path)
                allowed = ["edgewise", room, *BELOW[room]]
                for header in re.findall(r'^#include "([^"]+\.h)"', source.read_text(), re.MULTILINE):
                    self.assertTrue(header in allowed or any(inside(room_of(header), one) for one in allowed), f"{path} includes {header}")


if __name__ == "__main__":
    unittest.main()
