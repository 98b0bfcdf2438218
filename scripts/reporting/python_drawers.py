"""Python packages that draw the ids and depths of the triangles that a camera sees, each in a process of its own. A drawer's load()
takes a mesh, draw() returns two arrays: those of its last call, self.arrays, or new ones if that is None. Ids count from 1 in the
lowest 24 bits, where background is 0. Depths have a scale of the drawer's own. Row 0 is the top.

Every drawer gets THREADS threads and cores, and the fastest settings that we found.
"""
import multiprocessing
import os
import re
import subprocess
import time
from collections import namedtuple
from concurrent.futures import ProcessPoolExecutor
from statistics import median

import numpy as np

from program import BadInput

THREADS = 2
FOV_Y = 0.8  # radians

Mesh = namedtuple("Mesh", "positions triangles")  # arrays of shape (n, 3), float32, and (m, 3), uint32
# The size is (width, height). `world_to_view` is that of the eye and the target, with x right, y up, and -z forward.
View = namedtuple("View", "size eye target world_to_view near far")


class Edgewise:
    def __init__(self):
        import edgewise
        self.edgewise, self.version = edgewise, "Edgewise"

    def load(self, mesh):
        self.scene = self.edgewise.Scene(mesh.positions, mesh.triangles)

    def draw(self, view):
        projection = self.edgewise.perspective(FOV_Y, view.size[0] / view.size[1], view.near, view.far)
        camera = self.edgewise.Camera(view.world_to_view, projection)
        self.arrays = self.scene.draw(camera, view.size, ids=True, first_id=1, background=0, threads=THREADS, onto=self.arrays, clear=True)
        return self.arrays


class Vtk:
    """Each triangle's colour is its id, without light, smoothing or multisampling; depth is the z-buffer. Debian's VTK draws through
    an X server only, here Xvfb, and Mesa's llvmpipe draws in this process."""

    def __init__(self):
        server = subprocess.Popen(["setpriv", "--pdeathsig", "TERM", "Xvfb", "-displayfd", "1", "-nolisten", "tcp"],  # ends with this process
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        os.environ["DISPLAY"] = ":" + server.stdout.readline().strip()
        import vtkmodules.all as vtk
        from vtkmodules.util import numpy_support
        self.vtk, self.numpy = vtk, numpy_support
        self.mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
        actor.SetMapper(self.mapper)
        actor.GetProperty().LightingOff()
        self.camera, renderer = vtk.vtkCamera(), vtk.vtkRenderer()
        renderer.SetActiveCamera(self.camera)
        renderer.AddActor(actor)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0)
        self.window.SwapBuffersOff()
        self.window.AddRenderer(renderer)
        self.window.Render()
        renderer, mesa = re.search(r"renderer string: +(.*)\nOpenGL version string: .*\) (.*)", self.window.ReportCapabilities()).groups()
        self.version = f"VTK {vtk.vtkVersion.GetVTKVersion()}, {renderer}, {mesa}"

    def load(self, mesh):
        count = len(mesh.triangles)
        colours = np.arange(1, count + 1, dtype="<u4").view(np.uint8).reshape(count, 4)[:, :3]
        # VTK keeps no reference to arrays that it does not copy.
        self.kept = mesh.positions, mesh.triangles.astype(np.int64), np.ascontiguousarray(colours)
        points, cells, mesh_of_vtk = self.vtk.vtkPoints(), self.vtk.vtkCellArray(), self.vtk.vtkPolyData()
        points.SetData(self.numpy.numpy_to_vtk(self.kept[0]))
        cells.SetData(3, self.numpy.numpy_to_vtkIdTypeArray(self.kept[1].reshape(-1)))
        mesh_of_vtk.SetPoints(points)
        mesh_of_vtk.SetPolys(cells)
        mesh_of_vtk.GetCellData().SetScalars(self.numpy.numpy_to_vtk(self.kept[2]))
        self.mapper.SetInputData(mesh_of_vtk)

    def draw(self, view):
        width, height = view.size
        self.camera.SetPosition(view.eye)
        self.camera.SetFocalPoint(view.target)
        self.camera.SetViewAngle(np.degrees(FOV_Y))
        self.camera.SetClippingRange(view.near, view.far)
        self.window.SetSize(width, height)
        self.window.Render()
        colours, depth = self.arrays = self.arrays or (self.vtk.vtkUnsignedCharArray(), self.vtk.vtkFloatArray())
        self.window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, colours)
        self.window.GetZbufferData(0, 0, width - 1, height - 1, depth)
        ids = self.numpy.vtk_to_numpy(colours).view("<u4")
        return ids.reshape(height, width)[::-1], self.numpy.vtk_to_numpy(depth).reshape(height, width)[::-1]


class ModernGl:
    """The least that OpenGL does: one draw call, whose shader writes the triangle's number, and a read of both planes.
    Each triangle's last corner is a vertex of its own, which is faster than gl_PrimitiveID."""
    VERTEX = """#version 330
        uniform mat4 to_clip;
        in vec3 position;
        flat out uint number;
        void main() { number = uint(gl_VertexID + 1); gl_Position = to_clip * vec4(position, 1.0); }"""
    FRAGMENT = """#version 330
        flat in uint number;
        out uint id;
        void main() { id = number; }"""

    def __init__(self):
        import moderngl
        self.context = moderngl.create_context(standalone=True, backend="egl")
        self.context.gc_mode = "auto"  # frees a mesh's buffers with the mesh
        self.context.enable_only(moderngl.DEPTH_TEST)
        self.program = self.context.program(vertex_shader=self.VERTEX, fragment_shader=self.FRAGMENT)
        self.frame = None
        mesa = self.context.info["GL_VERSION"].partition(") ")[2]
        self.version = f"ModernGL {moderngl.__version__}, {self.context.info['GL_RENDERER']}, {mesa}"

    def load(self, mesh):
        count = len(mesh.triangles)
        positions = np.concatenate([mesh.positions[mesh.triangles[:, 2]], mesh.positions])
        triangles = np.column_stack([mesh.triangles[:, :2] + count, np.arange(count, dtype=np.uint32)])
        self.mesh = self.context.vertex_array(self.program, [(self.context.buffer(positions), "3f", "position")],
                                              self.context.buffer(triangles))

    def draw(self, view):
        width, height = view.size
        if self.frame is None or self.frame.size != view.size:
            self.frame = self.context.framebuffer(self.context.texture(view.size, 1, dtype="u4"), self.context.depth_texture(view.size))
            self.frame.use()
        scale, span = 1 / np.tan(FOV_Y / 2), view.far - view.near
        to_clip = np.array([[scale * height / width, 0, 0, 0], [0, scale, 0, 0],
                            [0, 0, -(view.far + view.near) / span, -2 * view.far * view.near / span], [0, 0, -1, 0]]) @ view.world_to_view
        self.program["to_clip"].write(to_clip.T.astype(np.float32).tobytes())
        self.frame.clear()
        self.mesh.render()
        ids, depth = self.arrays = self.arrays or (np.empty((height, width), "<u4"), np.empty((height, width), np.float32))
        self.frame.read_into(ids, components=1, dtype="u4")
        self.frame.read_into(depth, components=1, attachment=-1, dtype="f4")
        return ids[::-1], depth[::-1]


DRAWERS = {"edgewise": Edgewise, "vtk": Vtk, "moderngl": ModernGl}


def make(name):
    """Makes the drawer of this process, which Drawer started. Returns its version."""
    global here
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:THREADS])
    os.environ.update(LIBGL_ALWAYS_SOFTWARE="1", GALLIUM_DRIVER="llvmpipe", LP_NUM_THREADS=str(THREADS))
    here = DRAWERS[name]()
    if "llvmpipe" not in here.version and name != "edgewise":
        raise RuntimeError(f"{here.version} is not llvmpipe")
    return here.version


def drawn(mesh, view, calls=0, reuse=False):
    """The picture's ids or, of so many calls, the median of their milliseconds. With a mesh, it is loaded anew.
    reuse: draws into the arrays of the last call."""
    times, kept = [], []  # all arrays are kept, since the allocator would hand out those that were freed as new ones
    for _ in range(calls or 1):
        start = time.perf_counter()
        if mesh is not None:
            here.load(mesh)
        if not reuse:
            here.arrays = None
        kept.append(here.draw(view))
        times.append(1e3 * (time.perf_counter() - start))
    return median(times) if calls else kept[-1][0] & 0xFFFFFF


class Drawer:
    """A drawer in another process."""

    def __init__(self, name):
        self.name = name
        self.process = ProcessPoolExecutor(1, multiprocessing.get_context("spawn"))  # threads of this process are not copied
        self.version = self.answer(make, name)

    def answer(self, function, *arguments):
        try:
            return self.process.submit(function, *arguments).result()
        except Exception as error:  # whatever a package throws
            raise BadInput(f"{self.name}: {error}") from None

    def drawn(self, *request):
        return self.answer(drawn, *request)
